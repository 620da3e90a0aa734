// SPDX-License-Identifier: MIT
// Baked light on the CPU: what bakeIndirect holds, what Scene::validate refuses, what BakedLookup finds, and how
// often a StaticBake bakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

#include "conelight/error.h"

#include <glm/gtc/constants.hpp>
#include "io/generated.h"
#include "light/baked_lookup.h"
#include "reference/radiosity.h"
#include "static_bake.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

using reference::bakeIndirect;

reference::RadiositySettings quick() {
    reference::RadiositySettings s;
    s.patchRays = 64;
    s.gatherRays = 64;
    s.maxSubdivision = 0;
    s.patchSize = 0.5f;
    return s;
}

// Walls are flat emitters: of e / (1 - a), which arrives, e comes straight from them.
TEST(BakedLight, FurnaceHoldsTheGeometricSum) {
    const BakedLight baked = bakeIndirect(closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1))), quick());
    ASSERT_FALSE(baked.irradiance.empty());
    for (const glm::vec3& e : baked.irradiance) EXPECT_NEAR(e.g / glm::pi<float>(), 1, 0.01);
}

// Before the first bounce there is no light but what comes straight from the lamp.
TEST(BakedLight, LeavesOutWhatComesStraightFromLights) {
    Scene scene = io::generateScene("cornell-point");
    reference::RadiositySettings settings = quick();
    settings.bounces = 0;
    for (const glm::vec3& e : bakeIndirect(scene, settings).irradiance) EXPECT_EQ(e, glm::vec3(0));
    // A flat emitter is such a light, unless it is said to be none: then it is found without a bounce.
    settings.bounces = 1;
    scene = io::generateScene("cornell");
    for (Material& material : scene.materials) material.baseColor = glm::vec4(0, 0, 0, 1);
    for (const glm::vec3& e : bakeIndirect(scene, settings).irradiance) EXPECT_EQ(e, glm::vec3(0));
    settings.emissiveQuads = false;
    float most = 0;
    for (const glm::vec3& e : bakeIndirect(scene, settings).irradiance) most = std::max(most, e.r);
    EXPECT_GT(most, 1);
}

TEST(BakedLight, LeavesOutWhatMoves) {
    const Scene scene = io::generateScene("cornell?block=1"), without = io::generateScene("cornell");
    const BakedLight a = bakeIndirect(scene, quick()), b = bakeIndirect(without, quick());
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.irradiance, b.irradiance);
    for (const BakedLight::Surface& surface : a.surfaces)
        EXPECT_FALSE(scene.instances[static_cast<std::size_t>(surface.instance)].dynamic);
}

TEST(BakedLight, BadOnesAreRefused) {
    Scene scene = closedBox(diffuseMaterial());
    BakedLight good;
    good.surfaces = {{0, false, glm::mat4(1)}};
    good.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    good.irradiance.assign(3, glm::vec3(1));
    good.surfaceOf.assign(3, 0);
    good.indices = {0, 1, 2};
    const auto validate = [&](const std::function<void(BakedLight&)>& change) {
        BakedLight baked = good;
        change(baked);
        scene.baked = std::make_shared<const BakedLight>(baked);
        scene.validate();
    };
    EXPECT_NO_THROW(validate([](BakedLight&) {}));
    EXPECT_THROW(validate([](BakedLight& b) { b.irradiance.pop_back(); }), Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.surfaceOf.push_back(0); }), Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.irradiance[1].g = -1; }), Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.irradiance[1].g = std::numeric_limits<float>::quiet_NaN(); }),
                 Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.positions[2].x = std::numeric_limits<float>::infinity(); }),
                 Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.surfaceOf[0] = 1; }), Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.indices[0] = 3; }), Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.indices.push_back(0); }), Error);
    EXPECT_THROW(validate([](BakedLight& b) { b.surfaces[0].instance = 6; }), Error);
}

// A floor and a wall that meet at x = 8; light grows by 1 per voxel along z.
TEST(BakedLookup, TakesTheSurfaceThatLooksTheSameWay) {
    voxels::VoxelGrid grid;
    grid.size = glm::ivec3(16);
    BakedLight baked;
    const auto addQuad = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, float red) {
        const auto first = static_cast<std::uint32_t>(baked.positions.size());
        for (const glm::vec3& p : {corner, corner + u, corner + u + v, corner + v}) {
            baked.positions.push_back(p);
            baked.irradiance.emplace_back(red, p.z, 0);
        }
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) baked.indices.push_back(first + i);
    };
    addQuad({0, 4, 0}, {0, 0, 16}, {8, 0, 0}, 1);   // looks up
    addQuad({8, 4, 0}, {0, 0, 16}, {0, 12, 0}, 2);  // looks towards -x
    const light::BakedLookup lookup(baked, grid);
    const auto at = [&](const glm::vec3& p, const glm::vec3& n) {
        return lookup.irradiance(p, n).value_or(glm::vec3(-1));
    };
    EXPECT_NEAR(at({7.5f, 4.2f, 5}, {0, 1, 0}).r, 1, 1e-5);
    EXPECT_NEAR(at({7.5f, 4.2f, 5}, {0, 1, 0}).g, 5, 1e-4);
    EXPECT_NEAR(at({7.8f, 4.2f, 5}, {-1, 0, 0}).r, 2, 1e-5);
    EXPECT_EQ(at({4, 4, 5}, {0, -1, 0}).r, -1);  // from below
    EXPECT_EQ(at({4, 8, 5}, {0, 1, 0}).r, -1);   // too far away
    EXPECT_EQ(at({4, 40, 5}, {0, 1, 0}).r, -1);  // out of the grid
}

TEST(StaticBake, BakesAgainOnlyForWhatDoesNotMove) {
    Scene scene = io::generateScene("cornell?block=1");
    program::StaticBake bake;
    const auto first = bake.of(scene, quick());
    scene.instances.back().worldFromObject[3].x -= 0.3f;  // the block
    EXPECT_EQ(bake.of(scene, quick()), first);
    EXPECT_EQ(bake.bakes(), 1u);
    scene.instances.front().worldFromObject[3].y -= 0.1f;  // the floor
    EXPECT_NE(bake.of(scene, quick()), first);
    scene.materials.front().baseColor.r = 0.1f;
    bake.of(scene, quick());
    EXPECT_EQ(bake.bakes(), 3u);
    // A bake that was stopped is made again.
    scene.sky = glm::vec3(1);
    bake.of(scene, quick(), [](const auto&) { return false; });
    bake.of(scene, quick());
    EXPECT_EQ(bake.bakes(), 5u);
}

}  // namespace
}  // namespace conelight::test
