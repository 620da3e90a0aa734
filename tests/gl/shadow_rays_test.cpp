// SPDX-License-Identifier: MIT
// Rays that ask whether triangles are in their way (lib/ray_query.glsl, BLOCKING_TRIANGLES) against rays of the path tracer.
#include <gtest/gtest.h>

#include <random>

#include "gl/pass.h"
#include "io/scene_file.h"
#include "reference/ray_scene.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "voxels/octant_words.h"
#include "voxels/surface_voxels.h"

namespace conelight::test {
namespace {

struct TestRay {
    glm::vec4 origin;     // w: its length
    glm::vec4 direction;  // grid coordinates, as the origin
};

class ShadowRaysTest : public GlTest {
  protected:
    void expectAgreement(const std::string& name) { expectAgreement(io::loadScene("builtin:" + name), 4); }
    void expectAgreement(const Scene& scene, int mostWrong) {
        const scene::GpuScene gpuScene(scene);
        voxels::SurfaceVoxels surface;
        surface.build(device(), gpuScene, VoxelSettings{96});
        voxels::OctantWords octants;
        octants.build(device(), surface);
        std::mt19937 random(7);
        const auto anywhere = [&] {
            const auto next = [&] { return 0.02f + 0.96f * static_cast<float>(random()) * 0x1p-32f; };
            return glm::vec3(surface.grid().size) * glm::vec3(next(), next(), next());
        };
        std::vector<TestRay> rays;
        for (int i = 0; i < 200000; ++i) {
            const glm::vec3 from = anywhere(), way = anywhere() - from;
            rays.push_back({{from, glm::length(way)}, {glm::normalize(way), 0}});
        }
        const std::vector<glm::vec4> told = ask(gpuScene, surface, octants, rays);
        const reference::RayScene triangles(scene);
        int wrong = 0, blocked = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const reference::Ray same{surface.grid().worldFromGrid(rays[i].origin), rays[i].direction, 0,
                                      rays[i].origin.w * surface.grid().voxelSize};
            const bool meets = triangles.occluded(reference::RayKind::Shadow, same);
            blocked += meets ? 1 : 0;
            wrong += meets != (told[2 * i].x == 0.0f) ? 1 : 0;
        }
        // Edges are met or not by rounding.
        EXPECT_LE(wrong, mostWrong) << "of " << rays.size();
        EXPECT_GT(blocked, 2000);
    }

  private:
    std::vector<glm::vec4> ask(const scene::GpuScene& scene, const voxels::SurfaceVoxels& surface,
                               const voxels::OctantWords& octants, const std::vector<TestRay>& rays) {
        addShader("test/shadow_rays.comp.glsl", R"(#version 450 core
#define NEAR_TRIANGLES 1
#define BLOCKING_TRIANGLES 1
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// What needs them.
#include "lib/ray_query.glsl"
layout(std430) buffer Data { vec4 data[]; };
void main() {
    uint i = 2u * linearIndex();
    if (i >= uint(data.length())) return;
    Ray ray = Ray(data[i].xyz, data[i + 1u].xyz, data[i].w, vec3(0.0));
    data[i] = vec4(reachesEnd(ray, true) ? 1.0 : 0.0);
}
)");
        gl::Buffer buffer(rays, "rays");
        gl::Inputs inputs;
        inputs.add(scene).add(surface).add(octants).storage("Data", buffer);
        surface.declareTriangles(inputs);
        programs().compute("test/shadow_rays.comp.glsl").dispatchLinear(inputs, rays.size());
        gl::barrier(gl::Access::ShaderStorage);
        return buffer.read<glm::vec4>(2 * rays.size());
    }
};

TEST_F(ShadowRaysTest, MeetWhatPathsMeetInAStudy) { expectAgreement("study"); }
TEST_F(ShadowRaysTest, MeetWhatPathsMeetAmongHuts) { expectAgreement("lamps?count=100"); }
TEST_F(ShadowRaysTest, MeetWhatPathsMeetInAYard) { expectAgreement("yard"); }

// Sheets behind one another, several in a voxel, half of each cut away by its texture.
TEST_F(ShadowRaysTest, PassTheHolesOfSheets) {
    Scene scene;
    Texture cut;
    cut.width = cut.height = 64;
    cut.srgb = false;
    for (int i = 0; i < 64 * 64; ++i)
        for (const int value : {255, 255, 255, i % 64 < 32 ? 255 : 0})
            cut.rgba.push_back(static_cast<std::uint8_t>(value));
    scene.textures.push_back(cut);
    Material sheet;
    sheet.doubleSided = true;
    sheet.alphaMode = AlphaMode::Mask;
    sheet.baseColorTexture.texture = 0;
    std::mt19937 random(3);
    const auto next = [&] { return static_cast<float>(random()) * 0x1p-31f - 1; };
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 u = 0.3f * glm::normalize(glm::vec3(next(), next(), next()));
        const glm::vec3 v = 0.3f * glm::normalize(glm::cross(u, glm::vec3(next(), next(), next())));
        addInstance(scene, quadMesh(glm::vec3(next(), next(), next()), u, v), sheet);
        scene.meshes.back().uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    }
    // Where textures are cut, filters decide.
    expectAgreement(scene, 20);
}

}  // namespace
}  // namespace conelight::test
