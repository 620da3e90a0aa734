// SPDX-License-Identifier: MIT
// The view of voxels against rays that try every cube: what is drawn is what they meet, though the shader
// leaps over what is empty.
#include <algorithm>
#include <cmath>
#include <vector>

#include "conelight/thesis/settings.h"
#include "gl/pass.h"
#include "io/generated_shapes.h"
#include "scene/gpu_scene.h"
#include "support/view_rig.h"
#include "support/views_rig.h"
#include "thesis/render/volume.h"
#include "voxels/surface_voxels.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kViewPixels;

// Patches of all directions and colours, far apart: most of the grid is empty.
// Not every seed will do: corners of patches that a coarse cell holds nothing of but a millionth are not
// drawn (kLeastOpacity of voxel_view.comp.glsl), though a ray meets their cube.
Scene scatteredPatches() {
    constexpr std::uint32_t kSeed = 1;
    Scene scene;
    for (int i = 0; i < 24; ++i) {
        const auto hash = [i](std::uint32_t k) {
            return io::shapes::unitFloat(io::shapes::hash(static_cast<std::uint32_t>(i), k, kSeed));
        };
        const glm::vec3 place(2 * hash(0) - 1, 2 * hash(1) - 1, 2 * hash(2) - 1);
        const glm::vec3 u = 0.1f * glm::normalize(glm::vec3(hash(3), hash(4), hash(5)) - 0.5f);
        const glm::vec3 v = glm::normalize(glm::cross(u, glm::vec3(hash(6), hash(7), 0.3f))) * 0.15f;
        Material material = diffuseMaterial({0.1f + 0.8f * hash(8), 0.1f + 0.8f * hash(9), 0.5f});
        material.doubleSided = true;
        addInstance(scene, quadMesh(place, u, v), material);
    }
    Camera camera;
    camera.eye = {1.6f, 0.9f, 2.5f};
    camera.target = {0, 0, 0};
    camera.fovY = 0.9f;
    scene.cameras.push_back(camera);
    return scene;
}

// What rays may meet, m.
struct Cubes {
    glm::dvec3 origin;
    double voxelSize;
    glm::ivec3 end;  // of the grid, in voxels
    int level;
    std::vector<glm::dvec3> lows, highs;

    Cubes(const glm::vec3& gridOrigin, float edge, const glm::ivec3& gridEnd, int cubeLevel)
        : origin(gridOrigin), voxelSize(static_cast<double>(edge)), end(gridEnd), level(cubeLevel) {}

    // The cube that holds the voxel.
    void add(const glm::ivec3& voxel) {
        const glm::ivec3 low = voxel >> level << level;
        const glm::ivec3 high = glm::min(low + (1 << level), end);
        lows.push_back(origin + voxelSize * glm::dvec3(low));
        highs.push_back(origin + voxelSize * glm::dvec3(high));
    }
    // Distance along `ray` to the nearest; none: infinity. All are tried: nothing is skipped.
    double meet(const glm::dvec3& eye, const glm::dvec3& ray) const {
        double nearest = INFINITY;
        for (std::size_t i = 0; i < lows.size(); ++i) {
            const glm::dvec3 a = (lows[i] - eye) / ray, b = (highs[i] - eye) / ray;
            const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
            const double in = std::max({enter.x, enter.y, enter.z});
            if (in < std::min({leave.x, leave.y, leave.z}) && in > 0) nearest = std::min(nearest, in);
        }
        return nearest;
    }
};

constexpr Mode kModes[] = {Mode::Traced, Mode::Cones, thesis::kMode};

class VoxelViewRaysTest : public ViewsTest {
  protected:
    // The cubes of a level of what the mode shows: 2^level voxels on edge, cut at the end of the grid.
    Cubes cubesOf(ViewRig& rig, const Settings& settings, int level) {
        return settings.mode == thesis::kMode ? cubesOfThesis(rig, settings.voxels, level)
                                              : cubesOfSurfaces(rig, settings, level);
    }

  private:
    Cubes cubesOfThesis(ViewRig& rig, const VoxelSettings& voxelSettings, int level) {
        thesis::ThesisVolumeOptions options;
        options.size = voxelSettings.size;
        options.padding = voxelSettings.padding;
        options.shadows = false;
        thesis::ThesisVolume volume;
        rig.draw(device());
        volume.build(device(), {rig.gpuScene, rig.lights}, options);
        const auto n = static_cast<int>(volume.grid().size);
        std::vector<glm::vec4> texels(static_cast<std::size_t>(n) * n * n);
        volume.texture().read(0, GL_RGBA, GL_FLOAT, texels.data(), texels.size() * sizeof(glm::vec4));
        Cubes cubes{volume.grid().origin, volume.grid().voxelSize, glm::ivec3(n), level};
        for (int i = 0; i < n * n * n; ++i)
            if (texels[static_cast<std::size_t>(i)].a > 0) cubes.add({i % n, i / n % n, i / (n * n)});
        return cubes;
    }
    Cubes cubesOfSurfaces(ViewRig& rig, const Settings& settings, int level) {
        voxels::SurfaceVoxels surface;
        surface.build(device(), rig.gpuScene, settings.voxels);
        const voxels::VoxelGrid& grid = surface.grid();
        // The volume of mode cones has whole texels at its border.
        const glm::ivec3 end = settings.mode == Mode::Cones ? 2 * grid.size : grid.size;
        std::vector<glm::uvec4> words(grid.brickCount());
        surface.brickWords().read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, words.data(),
                                  words.size() * sizeof(glm::uvec4));
        Cubes cubes{grid.origin, grid.voxelSize, end, level};
        for (std::size_t i = 0; i < words.size(); ++i) {
            const int b = static_cast<int>(i);
            const glm::ivec3 n = grid.bricks(), brick(b % n.x, b / n.x % n.y, b / (n.x * n.y));
            for (std::uint32_t bit = 0; bit < 64; ++bit)
                if (((bit < 32 ? words[i].x : words[i].y) >> (bit % 32) & 1) != 0)
                    cubes.add(voxels::voxelOfBit(brick, bit));
        }
        return cubes;
    }
};

// What is drawn is what a ray meets that tries every cube, though rays leap over what is empty.
TEST_F(VoxelViewRaysTest, RaysThatLeapMeetWhatRaysMeetThatDoNot) {
    Scene scene = scatteredPatches();
    Camera& camera = scene.cameras[0];
    Settings settings = viewSettings(Mode::Traced, Component::Voxels);
    settings.voxels.size = 64;
    settings.light.shadowSize = 0;
    settings.traced.bounces = 0;
    settings.view.voxelShape = VoxelShape::Cubes;
    ViewRig rig(scene, camera, kPixels, kPixels);
    rig.draw(device());
    const glm::dvec3 eye(camera.eye), forward = glm::normalize(glm::dvec3(camera.target) - eye);
    for (const Mode mode : kModes)
        for (const int look : {0, 1, 2, 3, 4, 5}) {
            // Two looks by parallel rays.
            const bool parallel = look > 3;
            const int level = look % 4;
            camera.orthographicHeight = parallel ? 2.2f : 0;
            SCOPED_TRACE(testing::Message()
                         << "mode " << mode.name() << " level " << level << (parallel ? " parallel" : ""));
            settings.mode = mode;
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            const Cubes cubes = cubesOf(rig, settings, level);
            const Image image = draw(scene, settings);
            int met = 0, wrong = 0;
            for (int y = 0; y < kPixels; ++y)
                for (int x = 0; x < kPixels; ++x) {
                    const glm::dvec3 at =
                        pixelOnPlane(camera, {kPixels, kPixels}, {x, y}, forward, glm::dot(forward, eye) + 1);
                    const glm::dvec3 ray = parallel ? forward : at - eye;
                    const bool meets = std::isfinite(cubes.meet(at - ray, ray));
                    const bool drawn =
                        image.pixels[static_cast<std::size_t>((kPixels - 1 - y) * kPixels + x)].a > 0;
                    met += meets;
                    wrong += meets != drawn;
                }
            EXPECT_GT(met, 100);
            EXPECT_LT(met, kPixels * kPixels * 3 / 4);
            EXPECT_LE(wrong, 4);  // rays along an edge
        }
}

}  // namespace
}  // namespace conelight::test
