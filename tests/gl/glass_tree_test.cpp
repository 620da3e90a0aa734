// SPDX-License-Identifier: MIT
// Rays against the tree over the triangles of glass (lib/glass_tree.glsl) against a search of all triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "gl/pass.h"
#include "io/generated.h"
#include "scene/glass_tree.h"
#include "scene/gpu_scene.h"
#include "shared/caustics.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

struct TestRay {
    glm::vec4 origin;
    glm::vec4 direction;  // w: most metres
};

class GlassTreeTest : public GlTest {
  protected:
    // Rays through and beside balls, blocks and panes: what they meet differs from ray to ray, and so does the number of
    // nodes that they pass.
    static std::vector<TestRay> raysOf(const scene::GpuScene& scene, std::size_t count) {
        std::mt19937 random(7);
        const auto uniform = [&](float low, float high) {
            return low + (high - low) * static_cast<float>(random()) * 0x1p-32f;
        };
        const Aabb room = scene.bounds();
        const auto anywhere = [&] {
            return glm::mix(room.min, room.max, glm::vec3(uniform(0, 1), uniform(0, 1), uniform(0, 1)));
        };
        std::vector<TestRay> rays;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 from = anywhere(), to = anywhere();
            const float most = i % 4 == 0 ? glm::distance(from, to) : 1e9f;
            rays.push_back({{from, 0}, {glm::normalize(to - from), most}});
        }
        return rays;
    }
    static std::vector<glm::dvec3> cornersOf(const Scene& scene) {
        std::vector<glm::dvec3> corners;
        for (const Instance& instance : scene.instances) {
            if (!(scene.materials[static_cast<std::size_t>(instance.material)].transmission > 0)) continue;
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            for (const std::uint32_t v : mesh.indices)
                corners.emplace_back(instance.worldFromObject * glm::vec4(mesh.positions[v], 1));
        }
        return corners;
    }
    // Distances at which a ray meets triangles, nearest first. False: some are met at an edge, or where the ray ends.
    static bool meetings(const std::vector<glm::dvec3>& corners, const TestRay& ray,
                         std::vector<double>& found) {
        const glm::dvec3 origin(ray.origin), direction(ray.direction);
        const double most = static_cast<double>(ray.direction.w);
        bool clear = true;
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            const glm::dvec3 edge1 = corners[i + 1] - corners[i], edge2 = corners[i + 2] - corners[i];
            const glm::dvec3 p = glm::cross(direction, edge2), from = origin - corners[i];
            const glm::dvec3 q = glm::cross(from, edge1);
            const double per = 1 / glm::dot(edge1, p);
            const double u = glm::dot(from, p) * per, v = glm::dot(direction, q) * per,
                         t = glm::dot(edge2, q) * per;
            const double inside = std::min({u, v, 1 - u - v});
            if (!(inside > -1e-3) || !(t > -1e-3) || t > most + 1e-3) continue;
            clear = clear && inside > 1e-3 && t > 1e-3 && t < most - 1e-3;
            found.push_back(t);
        }
        std::sort(found.begin(), found.end());
        return clear;
    }
    // What a kernel says of each ray, in `result`.
    std::vector<glm::vec4> ask(const scene::GpuScene& scene, const std::vector<TestRay>& rays,
                               const std::string& statement) {
        scene::GlassTree tree;
        tree.update(scene, false);
        addShader("test/glass.comp.glsl", R"(#version 450 core
layout(local_size_x = 64) in;
#define GLASS 1
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// What needs them.
#include "lib/glass_tree.glsl"
layout(std430) buffer Data { vec4 data[]; };
void main() {
    uint i = 2u * linearIndex();
    if (i >= uint(data.length())) return;
    vec3 origin = data[i].xyz, direction = data[i + 1u].xyz;
    float end = data[i + 1u].w;
    vec4 result = vec4(0.0);
    )" + statement + R"(
    data[i] = result;
}
)");
        gl::Buffer buffer(rays, "rays");
        const gl::Buffer noCaustics(std::vector<gpu::CausticConstants>(1), "no caustics");
        gl::Inputs inputs;
        inputs.add(scene).uniform("CausticBlock", noCaustics).storage("Data", buffer);
        tree.declare(inputs);
        programs().compute("test/glass.comp.glsl").dispatchLinear(inputs, rays.size());
        gl::barrier(gl::Access::ShaderStorage);
        return buffer.read<glm::vec4>(2 * rays.size());
    }

    // Of rays that meet no edge: where they meet triangles, and what a kernel says.
    struct Answer {
        std::vector<double> met;
        glm::dvec4 told;
    };
    std::vector<Answer> answersOf(const std::string& statement) {
        const Scene scene = io::generateScene("glass");
        const scene::GpuScene gpuScene(scene);
        const std::vector<TestRay> rays = raysOf(gpuScene, 20000);
        const std::vector<glm::dvec3> corners = cornersOf(scene);
        const std::vector<glm::vec4> told = ask(gpuScene, rays, statement);
        std::vector<Answer> answers;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            Answer answer{{}, glm::dvec4(told[2 * i])};
            if (meetings(corners, rays[i], answer.met)) answers.push_back(answer);
        }
        return answers;
    }
};

// The nearest triangle, whatever the rays beside it meet.
TEST_F(GlassTreeTest, RaysMeetTheNearestTriangle) {
    int wrong = 0, met = 0;
    for (const Answer& answer : answersOf(R"(
    GlassHit hit = nearestGlass(origin, direction, end, -1, false);
    result = vec4(hit.triangle >= 0 ? hit.t : -1.0, 0.0, 0.0, 0.0);)")) {
        met += answer.met.empty() ? 0 : 1;
        const double t = answer.met.empty() ? -1 : answer.met[0];
        if (!(std::abs(answer.told.x - t) < 1e-4)) ++wrong;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(met, 3000);
}

// All triangles on its way, one after the other.
TEST_F(GlassTreeTest, RaysMeetEveryTriangle) {
    int wrong = 0, several = 0;
    for (const Answer& answer : answersOf(R"(
    GlassWalk walk = GlassWalk(0u, 0u, 0u);
    do {
        GlassHit hit = nextGlass(walk, GlassRay(origin, direction, 0.0, end), false);
        result += hit.triangle >= 0 ? vec4(1.0, hit.t, 0.0, 0.0) : vec4(0.0);
    } while (walk.node != GLASS_END || walk.first < walk.last);)")) {
        several += answer.met.size() > 2 ? 1 : 0;
        const double sum = std::accumulate(answer.met.begin(), answer.met.end(), 0.0);
        if (answer.told.x != static_cast<double>(answer.met.size()) ||
            !(std::abs(answer.told.y - sum) < 1e-3))
            ++wrong;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(several, 300);
}

}  // namespace
}  // namespace conelight::test
