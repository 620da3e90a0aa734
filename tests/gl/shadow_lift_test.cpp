// SPDX-License-Identifier: MIT
// Shadows on positions that are not exact, those of voxels (the lift of lib/shadow.glsl): where they lie, and
// that a surface does not hide itself.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "conelight/scene.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr int kPlaces = 512;
constexpr float kHalf = 2;  // places reach from x = -kHalf to kHalf

struct ShadowLift : public GlTest {
    // Per place along x, at height y: 1 where the light is seen.
    std::vector<float> seen(const Scene& scene, const std::string& visibility, const std::string& lift,
                            float y) {
        addShader("test/lift.comp.glsl", R"(#version 450
layout(local_size_x = 64) in;
#define SHADOW_FILTER -1
#include "lib/light_table.glsl"
#include "lib/shadow.glsl"
layout(std430) writeonly buffer Out { float seen[]; };
void main() {
    float part = (float(gl_GlobalInvocationID.x) + 0.5) / PLACES;
    vec3 p = vec3(mix(-HALF, HALF, part), HEIGHT, 0.013);
    seen[gl_GlobalInvocationID.x] = VISIBILITY(lightOfTable(0u), p, vec3(0.0, 1.0, 0.0), LIFT);
})");
        scene::GpuScene gpu(scene);
        light::Lights lights;
        lights.update(device(), gpu, {.settings = {.shadowSize = 256}});
        const gl::Buffer out(kPlaces * sizeof(float), "out");
        programs()
            .get({{"test/lift.comp.glsl"},
                  {{"PLACES", std::to_string(kPlaces) + ".0"},
                   {"HALF", std::to_string(kHalf)},
                   {"HEIGHT", std::to_string(y)},
                   {"VISIBILITY", visibility},
                   {"LIFT", lift}}})
            .dispatch(gl::Inputs().add(gpu).add(lights).storage("Out", out), kPlaces);
        gl::barrier(gl::Access::ShaderStorage);
        return out.read<float>(kPlaces);
    }
};

TEST_F(ShadowLift, ShadowsOfVoxelsLieWhereThoseOfSurfacesDo) {
    struct {
        const char* visibility;
        Light light;
    } const cases[] = {
        {"shadowVisibilityDirectional",
         {.type = LightType::Directional, .direction = glm::normalize(glm::vec3(1, -1, 0.1f))}},
        {"shadowVisibilityPoint", {.type = LightType::Point, .position = {-3, 3, 0.1f}}},
        {"shadowVisibilitySpot",
         {.type = LightType::Spot,
          .position = {-3, 3, 0.1f},
          .direction = glm::normalize(glm::vec3(1, -1, 0)),
          .outerAngle = 0.7f}},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(one.visibility);
        Scene scene;
        addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), {});
        addInstance(scene, quadMesh({-1.5f, 1, 1}, {0.8f, 0, 0}, {0, 0, -2}), {.doubleSided = true});
        scene.lights.push_back(one.light);
        const std::vector<float> exact = seen(scene, one.visibility, "vec2(0.0)", 0);
        int dark = 0;
        for (const float lit : exact) dark += lit < 0.5f ? 1 : 0;
        ASSERT_GT(dark, kPlaces / 20);
        ASSERT_LT(dark, kPlaces / 2);
        // A texel is 2 to 5 places wide. Moved along the normal, edges were 3 texels and, with a carpet's
        // height, 30 places off.
        for (const char* lift : {"kShadowVoxelLift", "kShadowVoxelLift + vec2(0.0, 0.3)"}) {
            const std::vector<float> voxels = seen(scene, one.visibility, lift, 0);
            int unlike = 0;
            for (int i = 0; i < kPlaces; ++i) unlike += exact[i] != voxels[i] ? 1 : 0;
            EXPECT_LE(unlike, 6) << lift;
        }
        // A little below its surface, as planes of voxels may be: the surface does not hide it. Not so where
        // it lies along a map's axes, as under the lower side of a point's cube: nothing is moved there.
        if (one.light.type == LightType::Point) continue;
        const std::vector<float> below = seen(scene, one.visibility, "kShadowVoxelLift", -0.02f);
        int hidden = 0;
        for (int i = 0; i < kPlaces; ++i) hidden += below[i] < 0.5f ? 1 : 0;
        EXPECT_NEAR(hidden, dark, 12);
        const std::vector<float> deep = seen(scene, one.visibility, "vec2(0.0)", -0.2f);
        for (const float lit : deep) EXPECT_EQ(lit, 0.0f);
    }
}

}  // namespace
}  // namespace conelight::test
