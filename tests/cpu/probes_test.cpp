// SPDX-License-Identifier: MIT
// Light probes: harmonics against integrals, a furnace, walls, the picture lit by them, the atlas of their maps.
#include "reference/probes.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "conelight/error.h"
#include "io/probe_files.h"
#include "io/scene_file.h"
#include "math/octahedral.h"
#include "reference/metrics.h"
#include "reference/path_tracer.h"

namespace conelight::test {
namespace {

using namespace reference;

// A sum over the sphere, weighted by solid angle.
template <class Visit>
void overSphere(Visit visit) {
    constexpr int kRows = 200, kColumns = 400;
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kColumns; ++j) {
            const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / kRows;
            const float phi = 2 * glm::pi<float>() * (static_cast<float>(j) + 0.5f) / kColumns;
            const float r = std::sqrt(1 - z * z);
            visit(glm::vec3(r * std::cos(phi), r * std::sin(phi), z),
                  4 * glm::pi<float>() / (kRows * kColumns));
        }
}

TEST(ProbesTest, HarmonicsAreOrthonormal) {
    std::array<std::array<double, 9>, 9> products{};
    overSphere([&](const glm::vec3& d, float solidAngle) {
        const std::array<float, 9> basis = harmonicsAt(d);
        for (std::size_t i = 0; i < 9; ++i)
            for (std::size_t j = 0; j < 9; ++j)
                products[i][j] += static_cast<double>(basis[i] * basis[j] * solidAngle);
    });
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t j = 0; j < 9; ++j)
            EXPECT_NEAR(products[i][j], i == j ? 1 : 0, 2e-3) << i << ", " << j;
}

TEST(ProbesTest, HarmonicsGiveIrradianceOfASmoothSky) {
    // Radiance 1 + 0.5 y has band 0 and 1 alone: E(n) = pi + pi / 3 n.y.
    std::array<glm::vec3, 9> harmonics{};
    overSphere([&](const glm::vec3& d, float solidAngle) {
        const std::array<float, 9> basis = harmonicsAt(d);
        for (std::size_t k = 0; k < 9; ++k)
            harmonics[k] += glm::vec3((1 + 0.5f * d.y) * basis[k] * solidAngle);
    });
    for (const glm::vec3& n :
         {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(0.6f, 0.8f, 0)})
        EXPECT_NEAR(irradianceOf(harmonics, n).g, glm::pi<float>() + glm::pi<float>() / 3 * n.y, 0.01f);
}

TEST(ProbesTest, AFurnaceGivesTheSameEverywhere) {
    // Radiance is 2 everywhere. Its walls are one closed mesh, no flat quads: all of it is indirect light.
    const Scene scene = io::loadScene("builtin:furnace?albedo=0.5&emission=1");
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), scene.bounds().extent().x / 3);
    const ProbeVolume volume = bakeProbes(scene, grid, {.samples = 4096});
    ASSERT_EQ(volume.probes.size(), grid.size());
    for (const Probe& probe : volume.probes) {
        ASSERT_TRUE(probe.active);
        for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1)})
            EXPECT_NEAR(irradianceOf(probe.harmonics, n).r / glm::pi<float>(), 2, 0.1);
        for (const glm::vec3& texel : probe.irradiance) EXPECT_NEAR(texel.g / glm::pi<float>(), 2, 0.12);
    }
    const glm::vec3 point = scene.bounds().min + 0.3f * scene.bounds().extent();
    for (const ProbeKind kind : {ProbeKind::Harmonics, ProbeKind::Octahedral})
        EXPECT_NEAR(irradianceAt(volume, kind, point, {0, 1, 0}).b / glm::pi<float>(), 2, 0.1);
}

TEST(ProbesTest, ProbesLeaveWallsOrAreOff) {
    const Scene scene = io::loadScene("builtin:cornell");
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), scene.bounds().extent().x / 8);
    const ProbeVolume volume = bakeProbes(scene, grid, {.samples = 16});
    int moved = 0, off = 0;
    for (std::size_t i = 0; i < volume.probes.size(); ++i) {
        const int n = static_cast<int>(i);
        const glm::ivec3 at(n % grid.counts.x, n / grid.counts.x % grid.counts.y,
                            n / (grid.counts.x * grid.counts.y));
        const glm::vec3 away = glm::abs(volume.probes[i].position - grid.place(at)) / grid.spacing;
        EXPECT_LE(std::max({away.x, away.y, away.z}), 0.451f);
        off += volume.probes[i].active ? 0 : 1;
        moved += volume.probes[i].active && away != glm::vec3(0) ? 1 : 0;
    }
    EXPECT_GT(moved, 0);
    EXPECT_GT(off, 0);  // the blocks are two probes wide
    EXPECT_LT(off, static_cast<int>(grid.size()) / 10);
}

TEST(ProbesTest, ThePictureIsNearThePathTracers) {
    const Scene scene = io::loadScene("builtin:cornell");
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), scene.bounds().extent().x / 8);
    const ProbeVolume volume = bakeProbes(scene, grid, {.samples = 256});
    const Camera camera = scene.cameras.empty() ? frameCamera(scene.bounds()) : scene.cameras.front();
    const PathTracedPicture truth = PathTracer(scene).render(camera, 48, 48, {.samplesPerPixel = 256});
    for (const ProbeKind kind : {ProbeKind::Harmonics, ProbeKind::Octahedral}) {
        const BakedPicture picture = drawWithProbes(scene, volume, kind, camera, truth);
        const Metrics diffuse = compareImages(picture.diffuse, truth.diffuse, {.flip = false});
        EXPECT_LT(diffuse.relRmse, 0.28);
        EXPECT_NEAR(diffuse.bias, 0, 0.08);
        EXPECT_LT(compareImages(picture.full, truth.full, {.flip = false}).relRmse, 0.08);
    }
}

TEST(ProbesTest, ThoseNearSurfacesDoForLookupsAtSurfaces) {
    const Scene scene = io::loadScene("builtin:cornell");
    // With a fine grid the middle of the room is far from all surfaces.
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), scene.bounds().extent().x / 20);
    const ProbeVolume all = bakeProbes(scene, grid, {.samples = 16});
    ProbeSettings settings{.samples = 16};
    settings.nearSurfaces = true;
    const ProbeVolume near = bakeProbes(scene, grid, settings);
    std::size_t activeOfAll = 0, activeNear = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        activeOfAll += all.probes[i].active ? 1 : 0;
        activeNear += near.probes[i].active ? 1 : 0;
        if (near.probes[i].active) {
            EXPECT_EQ(near.probes[i].harmonics, all.probes[i].harmonics);
        }
    }
    EXPECT_LT(activeNear, activeOfAll * 4 / 5);
    EXPECT_GT(activeNear, activeOfAll / 5);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            glm::vec3 middle(0);
            for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.indices[i + k]] / 3.0f;
            const glm::vec3 point(instance.worldFromObject * glm::vec4(middle, 1));
            const glm::vec3 normal = mesh.normals[mesh.indices[i]];
            EXPECT_EQ(irradianceAt(near, ProbeKind::Octahedral, point, normal),
                      irradianceAt(all, ProbeKind::Octahedral, point, normal));
        }
    }
}

TEST(ProbesTest, TheSameBitsOnOneThreadAndOnThree) {
    const Scene scene = io::loadScene("builtin:cornell-point");
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), scene.bounds().extent().x / 5);
    const ProbeVolume one = bakeProbes(scene, grid, {.samples = 32, .threads = 1});
    const ProbeVolume three = bakeProbes(scene, grid, {.samples = 32, .threads = 3});
    ASSERT_EQ(one.probes.size(), three.probes.size());
    for (std::size_t i = 0; i < one.probes.size(); ++i) {
        EXPECT_EQ(one.probes[i].position, three.probes[i].position);
        EXPECT_EQ(one.probes[i].harmonics, three.probes[i].harmonics);
        EXPECT_EQ(one.probes[i].irradiance, three.probes[i].irradiance);
        EXPECT_EQ(one.probes[i].distance, three.probes[i].distance);
    }
}

TEST(ProbesTest, WrongValuesAreRefused) {
    const Aabb bounds{.min = glm::vec3(0), .max = glm::vec3(1)};
    EXPECT_THROW(fitProbeGrid(bounds, 0), Error);
    EXPECT_THROW(fitProbeGrid(bounds, -1), Error);
    EXPECT_THROW(fitProbeGrid(bounds, 1e-3f), Error);  // 10^9 probes
    EXPECT_THROW(fitProbeGrid(Aabb{}, 1), Error);
    const Scene scene = io::loadScene("builtin:cornell");
    EXPECT_THROW(bakeProbes(scene, fitProbeGrid(bounds, 1), {.samples = 1}), Error);
    EXPECT_THROW(bakeProbes(scene, fitProbeGrid(bounds, 1), {.bounces = 0}), Error);
}

TEST(ProbesTest, ACancelledBakeIsEmpty) {
    const Scene scene = io::loadScene("builtin:cornell");
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), scene.bounds().extent().x / 2);
    EXPECT_TRUE(bakeProbes(scene, grid, {.samples = 16}, [](double) { return false; }).probes.empty());
}

// A filter that reads across the border of a tile must find what lies beyond the edge of the octahedral square.
TEST(ProbesTest, BordersOfTilesContinueTheMap) {
    const glm::ivec3 counts(2, 1, 2);
    constexpr int kSide = 4;
    std::vector<float> texels;
    for (int i = 0; i < 4 * kSide * kSide; ++i) texels.push_back(static_cast<float>(i));
    const io::FloatImage atlas = io::probeAtlas(counts, kSide, 1, texels);
    ASSERT_EQ(atlas.width, 4 * (kSide + 2));
    ASSERT_EQ(atlas.height, kSide + 2);
    const auto at = [&](int probe, int x, int y) {
        return atlas
            .pixels[static_cast<std::size_t>(3 * (probe * (kSide + 2) + x + 1 + atlas.width * (y + 1)))];
    };
    const auto texel = [&](int probe, int x, int y) {
        return texels[static_cast<std::size_t>(probe * kSide * kSide + x + kSide * y)];
    };
    for (int probe = 0; probe < 4; ++probe)
        for (int i = 0; i < kSide; ++i) {
            EXPECT_EQ(at(probe, i, 1), texel(probe, i, 1));
            EXPECT_EQ(at(probe, -1, i), texel(probe, 0, kSide - 1 - i));
            EXPECT_EQ(at(probe, kSide, i), texel(probe, kSide - 1, kSide - 1 - i));
            EXPECT_EQ(at(probe, i, -1), texel(probe, kSide - 1 - i, 0));
            EXPECT_EQ(at(probe, i, kSide), texel(probe, kSide - 1 - i, kSide - 1));
        }
    EXPECT_EQ(at(3, -1, -1), texel(3, kSide - 1, kSide - 1));
}

}  // namespace
}  // namespace conelight::test
