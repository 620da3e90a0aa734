// SPDX-License-Identifier: MIT
// The figure of builtin:atrium: where it goes, that it stands on the floor, and that it is there only when asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "io/animation.h"

namespace conelight {
namespace {

constexpr const char* kWithFigure = "builtin:atrium?triangles=10000&figure=1";

// Over all vertices of the parts whose names start with "figure".
Aabb figureBounds(const Scene& scene) {
    Aabb bounds;
    for (const Instance& part : scene.instances) {
        if (part.name.rfind("figure", 0) != 0) continue;
        for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(part.mesh)].positions)
            bounds.grow(glm::vec3(part.worldFromObject * glm::vec4(p, 1)));
    }
    return bounds;
}

TEST(GeneratedFigure, CrossesTheCourtyardOnItsFeet) {
    io::SceneAnimation animation;
    const Scene rest = io::loadAnimatedScene(kWithFigure, {}, animation);
    ASSERT_EQ(animation.clips.size(), 1u);
    EXPECT_EQ(animation.clips[0].name, "walk");
    Scene posed = rest;
    float first = 0;
    for (int i = 0; i <= 40; ++i) {
        const float seconds = 0.1f * static_cast<float>(i);
        io::poseScene(animation, 0, seconds, rest, posed);
        const Aabb bounds = figureBounds(posed);
        EXPECT_NEAR(bounds.min.y, -0.15f, 0.06f) << seconds;  // the courtyard's floor
        EXPECT_NEAR(bounds.extent().y, 1.75f, 0.1f) << seconds;
        if (i == 0) first = bounds.center().x;
        EXPECT_NEAR(bounds.center().x - first, 1.2f * seconds, 0.12f) << seconds;
    }
    for (const Instance& part : rest.instances) EXPECT_EQ(part.dynamic, part.name.rfind("figure", 0) == 0);
}

TEST(GeneratedFigure, IsThereOnlyWhenAskedFor) {
    io::SceneAnimation animation;
    const Scene without = io::loadAnimatedScene("builtin:atrium?triangles=10000", {}, animation);
    EXPECT_TRUE(animation.clips.empty());
    const Scene with = io::loadScene(kWithFigure, {});
    ASSERT_EQ(with.instances.size(), without.instances.size() + 7);
    for (std::size_t i = 0; i < without.instances.size(); ++i)
        EXPECT_TRUE(with.instances[i] == without.instances[i]) << i;
}

}  // namespace
}  // namespace conelight
