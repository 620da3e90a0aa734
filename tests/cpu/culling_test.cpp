// SPDX-License-Identifier: MIT
// Which boxes a view leaves out: those outside one of its planes, and no box of which it may see something.
#include "scene/culling.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace conelight::test {
namespace {

// Reversed depth without a far plane, as cameras of the renderer have it.
glm::mat4 viewOf(const glm::vec3& eye, const glm::vec3& target) {
    const float f = 1 / std::tan(0.5f);
    glm::mat4 clip(0);
    clip[0][0] = clip[1][1] = f;
    clip[2][3] = -1;
    clip[3][2] = 0.01f;
    return clip * glm::lookAt(eye, target, glm::vec3(0, 1, 0));
}

Aabb boxAbout(const glm::vec3& middle, float half) {
    Aabb box;
    box.grow(middle - half);
    box.grow(middle + half);
    return box;
}

TEST(Culling, LeavesOutWhatIsBesideOrBehind) {
    const glm::mat4 view = viewOf({0, 0, 0}, {0, 0, -1});
    EXPECT_FALSE(scene::isOutside(view, boxAbout({0, 0, -5}, 1)));
    EXPECT_FALSE(scene::isOutside(view, boxAbout({0, 0, -5000}, 1)));
    EXPECT_FALSE(scene::isOutside(view, boxAbout({0, 0, 0}, 1)));  // about the eye
    EXPECT_TRUE(scene::isOutside(view, boxAbout({0, 0, 5}, 1)));
    for (const glm::vec3& aside :
         {glm::vec3(9, 0, 0), glm::vec3(-9, 0, 0), glm::vec3(0, 9, 0), glm::vec3(0, -9, 0)})
        EXPECT_TRUE(scene::isOutside(view, boxAbout(aside + glm::vec3(0, 0, -5), 1)));
}

TEST(Culling, KeepsEveryBoxThatHasAPointInThePicture) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-10, 10), size(0.01f, 3), part(-1, 1);
    const glm::mat4 view = viewOf({1, 2, 3}, {0, 1, -4});
    int kept = 0;
    for (int i = 0; i < 20000; ++i) {
        const Aabb box = boxAbout({place(random), place(random), place(random)}, size(random));
        const glm::vec3 within =
            box.center() + 0.5f * box.extent() * glm::vec3(part(random), part(random), part(random));
        const glm::vec4 p = view * glm::vec4(within, 1);
        if (p.w <= 0 || std::abs(p.x) > p.w || std::abs(p.y) > p.w || p.z > p.w) continue;
        ++kept;
        ASSERT_FALSE(scene::isOutside(view, box)) << i;
    }
    EXPECT_GT(kept, 100);
}

}  // namespace
}  // namespace conelight::test
