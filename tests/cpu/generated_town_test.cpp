// SPDX-License-Identifier: MIT
// builtin:town: how large it is, that its meshes are shared, what the hour does to its light.
#include "io/generated.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace conelight {
namespace {

const Camera& cameraNamed(const Scene& scene, const char* name) {
    return *std::find_if(scene.cameras.begin(), scene.cameras.end(),
                         [&](const Camera& c) { return c.name == name; });
}

TEST(GeneratedTown, IsMillionsOfTrianglesByInstances) {
    const Scene scene = io::generateScene("town?size=1000");
    EXPECT_GE(scene.triangleCount(), 5'000'000u);
    EXPECT_LE(scene.triangleCount(), 10'000'000u);
    EXPECT_LE(scene.meshes.size(), 80u);
    EXPECT_LE(scene.instances.size(), 30'000u);
    const glm::vec3 extent = scene.bounds().extent();
    EXPECT_NEAR(extent.x, 900, 1);  // 15 blocks of 60 m
    EXPECT_EQ(extent.x, extent.z);
    std::size_t vertices = 0;
    for (const Mesh& mesh : scene.meshes) {
        vertices += mesh.positions.size();
        if (!mesh.colors.empty()) {
            EXPECT_EQ(mesh.colors.size(), mesh.positions.size()) << mesh.name;
        }
    }
    EXPECT_LT(vertices, 200'000u);
}

TEST(GeneratedTown, HourDrivesSunSkyAndLamps) {
    const auto lamps = [](const Scene& scene) {
        return std::count_if(scene.lights.begin(), scene.lights.end(),
                             [](const Light& light) { return light.type == LightType::Point; });
    };
    const auto glows = [](const Scene& scene) {
        return std::any_of(scene.materials.begin(), scene.materials.end(),
                           [](const Material& m) { return m.emission != glm::vec3(0); });
    };
    const Scene noon = io::generateScene("town");
    EXPECT_EQ(lamps(noon), 0);
    EXPECT_EQ(noon.lights.size(), 1u);  // the sun
    EXPECT_FALSE(glows(noon));
    const Scene night = io::generateScene("town?hour=23");
    EXPECT_EQ(std::size_t(lamps(night)), night.lights.size());
    EXPECT_GE(lamps(night), 10);
    EXPECT_LE(lamps(night), 28);  // each with shadows of full size
    EXPECT_TRUE(glows(night));
    EXPECT_GT(lamps(io::generateScene("town?hour=23&lit=90")), lamps(night));
    EXPECT_EQ(lamps(io::generateScene("town?hour=23&lamps=0")), 0);
    // One of them hangs in the room of the camera of that name.
    const glm::vec3 eye = cameraNamed(night, "room").eye;
    EXPECT_TRUE(std::any_of(night.lights.begin(), night.lights.end(),
                            [&](const Light& light) { return glm::distance(light.position, eye) < 4; }));
    const auto seen = [](const Scene& scene) {
        return scene.environment.strength * scene.environment.image->radiance[512].y;
    };
    EXPECT_GT(seen(noon), 30 * seen(night));
}

}  // namespace
}  // namespace conelight
