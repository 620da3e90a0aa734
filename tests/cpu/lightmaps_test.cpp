// SPDX-License-Identifier: MIT
// Light maps: charts that cover nothing twice, texels and their points, seams, furnaces, direct light, the picture that
// they light, files.
#include "reference/lightmaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "conelight/error.h"
#include "io/image_file.h"
#include "io/lightmap_files.h"
#include "io/scene_file.h"
#include "reference/lightmap_seams.h"
#include "reference/lightmap_texels.h"
#include "reference/metrics.h"
#include "reference/path_tracer.h"
#include "reference/probes.h"

namespace conelight::test {
namespace {

using namespace reference;

// A sphere of rings, with shared vertices and smooth normals.
Mesh ball(int rings) {
    Mesh mesh;
    mesh.name = "ball";
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= columns; ++j) {
            const float theta = glm::pi<float>() * static_cast<float>(i) / static_cast<float>(rings);
            const float phi =
                2 * glm::pi<float>() * static_cast<float>(j % columns) / static_cast<float>(columns);
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi));
            mesh.positions.push_back(n);
            mesh.normals.push_back(n);
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (columns + 1) + j); };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < columns; ++j)
            for (const std::uint32_t v :
                 {at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)})
                mesh.indices.push_back(v);
    return mesh;
}

Mesh quad() {
    Mesh mesh;
    mesh.name = "quad";
    mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Scene sceneOf(Mesh mesh) {
    Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back().baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1);
    scene.instances.push_back({.name = "it", .mesh = 0, .material = 0});
    return scene;
}

// How often each texel's middle lies strictly within a triangle.
std::vector<int> coverOf(const ChartedMesh& mesh) {
    std::vector<int> counts(static_cast<std::size_t>(mesh.size.x * mesh.size.y));
    for (std::size_t i = 0; i < mesh.mesh.indices.size(); i += 3) {
        std::array<glm::dvec2, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.uvs[mesh.mesh.indices[i + k]];
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
        const double area = cross(p[1] - p[0], p[2] - p[0]);
        if (std::abs(area) < 1e-9) continue;
        for (int y = 0; y < mesh.size.y; ++y)
            for (int x = 0; x < mesh.size.x; ++x) {
                const glm::dvec2 at(x + 0.5, y + 0.5);
                bool within = true;
                for (std::size_t k = 0; k < 3; ++k)
                    within = within && cross(p[(k + 1) % 3] - p[k], at - p[k]) / area > 1e-4;
                counts[static_cast<std::size_t>(x + mesh.size.x * y)] += within ? 1 : 0;
            }
    }
    return counts;
}

TEST(LightmapsTest, ChartsCoverNothingTwice) {
    for (const float texel : {0.3f, 0.04f}) {
        const Mesh mesh = ball(24);
        const ChartedMesh charted = chartMesh(mesh, glm::mat4(1), texel, 2048, "ball");
        ASSERT_EQ(charted.mesh.triangleCount(), mesh.triangleCount());
        for (const int count : coverOf(charted)) EXPECT_LE(count, 1);
        EXPECT_GE(charted.charts, 6u);
        EXPECT_LE(charted.charts, 40u);
        EXPECT_FALSE(charted.seams.empty());
        for (std::size_t i = 0; i < mesh.indices.size(); ++i)
            EXPECT_EQ(charted.mesh.positions[charted.mesh.indices[i]], mesh.positions[mesh.indices[i]]);
        // Charts are two texels apart.
        std::vector<int> owner(static_cast<std::size_t>(charted.size.x * charted.size.y), -1);
        const TexelCover cover(charted);
        for (const std::uint32_t texelIndex : cover.texels()) {
            std::uint32_t triangle = 0;
            glm::vec2 b(0);
            cover.pointOf(texelIndex, glm::vec2(0.5f), triangle, b);
            owner[texelIndex] = static_cast<int>(charted.chartOf[triangle]);
        }
        for (int y = 0; y < charted.size.y; ++y)
            for (int x = 1; x < charted.size.x; ++x) {
                const auto at = static_cast<std::size_t>(x + charted.size.x * y);
                if (owner[at] >= 0 && owner[at - 1] >= 0) {
                    EXPECT_EQ(owner[at], owner[at - 1]) << x << ", " << y;
                }
            }
    }
}

// A ramp that winds up over itself lies on its plane more than once: it must come apart.
TEST(LightmapsTest, ARampOverItselfComesApart) {
    Mesh mesh;
    for (int i = 0; i <= 72; ++i) {
        const float phi = glm::pi<float>() * static_cast<float>(i) / 12;
        for (const float radius : {1.0f, 2.0f})
            mesh.positions.emplace_back(radius * std::cos(phi), 0.05f * static_cast<float>(i),
                                        -radius * std::sin(phi));
    }
    mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
    for (std::uint32_t i = 0; i < 144; i += 2)
        for (const std::uint32_t v : {i, i + 1, i + 2, i + 2, i + 1, i + 3}) mesh.indices.push_back(v);
    const ChartedMesh charted = chartMesh(mesh, glm::mat4(1), 0.1f, 2048, "ramp");
    EXPECT_GE(charted.charts, 3u);  // three turns
    for (const int count : coverOf(charted)) EXPECT_LE(count, 1);
}

TEST(LightmapsTest, PointsLieInTheirTexels) {
    const ChartedMesh charted = chartMesh(ball(16), glm::mat4(1), 0.1f, 2048, "ball");
    const TexelCover cover(charted);
    ASSERT_GT(cover.texels().size(), 1000u);
    std::size_t within = 0;
    for (const std::uint32_t texel : cover.texels()) {
        std::uint32_t triangle = 0;
        glm::vec2 b(0);
        cover.pointOf(texel, glm::vec2(0.25f, 0.75f), triangle, b);
        EXPECT_GE(std::min({b.x, b.y, 1 - b.x - b.y}), -1e-5f);
        glm::vec2 at(0);
        const std::array<float, 3> weight = {1 - b.x - b.y, b.x, b.y};
        for (std::size_t k = 0; k < 3; ++k)
            at += weight[k] * charted.uvs[charted.mesh.indices[3 * static_cast<std::size_t>(triangle) + k]];
        const auto width = static_cast<std::uint32_t>(charted.size.x);
        const glm::vec2 wanted(static_cast<float>(texel % width) + 0.25f,
                               static_cast<float>(texel / width) + 0.75f);
        within += glm::distance(at, wanted) < 1e-3f ? 1 : 0;
        EXPECT_LT(glm::distance(at, wanted), 1.5f);
    }
    EXPECT_GT(within, cover.texels().size() / 2);
}

TEST(LightmapsTest, StitchedSeamsAgree) {
    const ChartedMesh charted = chartMesh(ball(16), glm::mat4(1), 0.1f, 2048, "ball");
    std::vector<glm::vec3> texels(static_cast<std::size_t>(charted.size.x * charted.size.y));
    // Every chart another brightness, and noise.
    const TexelCover cover(charted);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = glm::vec3(1);
    for (const std::uint32_t texel : cover.texels()) {
        std::uint32_t triangle = 0;
        glm::vec2 b(0);
        cover.pointOf(texel, glm::vec2(0.5f), triangle, b);
        texels[texel] = glm::vec3(1 + 0.2f * static_cast<float>(charted.chartOf[triangle] % 3));
    }
    const auto step = [&](const std::vector<glm::vec3>& map) {
        double sum = 0;
        for (const Seam& seam : charted.seams)
            for (const float t : {0.1f, 0.5f, 0.8f})
                sum += static_cast<double>(
                    std::abs(bilinear(map, charted.size, glm::mix(seam.one[0], seam.one[1], t)).g -
                             bilinear(map, charted.size, glm::mix(seam.other[0], seam.other[1], t)).g));
        return sum / static_cast<double>(3 * charted.seams.size());
    };
    std::vector<glm::vec3> stitched = texels;
    stitchSeams(stitched, charted.size, charted.seams);
    EXPECT_GT(step(texels), 0.05);
    EXPECT_LT(step(stitched), 0.2 * step(texels));
    double moved = 0;
    for (std::size_t i = 0; i < texels.size(); ++i)
        moved += static_cast<double>(std::abs(stitched[i].g - texels[i].g));
    EXPECT_LT(moved / static_cast<double>(texels.size()), 0.05);  // only at seams
}

TEST(LightmapsTest, AFurnaceGivesTheSameEverywhere) {
    const Scene scene = io::loadScene("builtin:furnace?albedo=0.5&emission=1");
    const LightmapLayout layout = layOutLightmaps(scene, scene.bounds().extent().x / 6, 512);
    const std::vector<Lightmap> maps = bakeLightmaps(scene, layout, {.samples = 1024});
    ASSERT_EQ(maps.size(), 1u);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const TexelCover cover(layout.meshes[static_cast<std::size_t>(scene.instances[i].mesh)]);
        ASSERT_FALSE(cover.texels().empty());
    }
    std::size_t lit = 0;
    for (const glm::vec3& texel : maps[0].irradiance) {
        if (texel == glm::vec3(0)) continue;
        ++lit;
        EXPECT_NEAR(texel.r / glm::pi<float>(), 2, 0.2);
    }
    EXPECT_GT(lit, maps[0].irradiance.size() / 2);
}

TEST(LightmapsTest, DirectLightIsThatOfLights) {
    Scene scene = sceneOf(quad());
    scene.instances[0].worldFromObject[0][0] = -3;  // mirrored, and larger
    Light& sun = scene.lights.emplace_back();
    sun.name = "sun";
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(1, -2, 0));
    sun.intensity = glm::vec3(3, 2, 1);
    const LightmapLayout layout = layOutLightmaps(scene, 0.5f, 64);
    const std::vector<Lightmap> maps =
        bakeLightmaps(scene, layout, {.samples = 16, .direct = true, .directions = true});
    ASSERT_EQ(maps.size(), 1u);
    const float cosine = -sun.direction.y;
    RayHit hit;
    for (hit.triangle = 0; hit.triangle < 2; ++hit.triangle) {
        hit.barycentric = {0.3f, 0.4f};
        EXPECT_EQ(irradianceAt(scene, layout, maps, hit, {0, 1, 0}, false), glm::vec3(0));
    }
    std::size_t lit = 0;
    for (std::size_t i = 0; i < maps[0].direct.size(); ++i) {
        if (maps[0].direct[i] == glm::vec3(0)) continue;
        ++lit;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(maps[0].direct[i][c], sun.intensity[c] * cosine, 1e-4f);
        EXPECT_NEAR(glm::distance(maps[0].direction[i], -sun.direction), 0, 1e-4f);
    }
    EXPECT_GE(lit, 12u * 4);  // 6 m and 2 m in texels of half a metre
    // A normal that is turned to the light gets more, one that is turned away less.
    std::vector<Lightmap> shown = maps;
    shown[0].irradiance = shown[0].direct;
    hit.triangle = 0;
    const float straight = irradianceAt(scene, layout, shown, hit, {0, 1, 0}, true).r;
    EXPECT_GT(irradianceAt(scene, layout, shown, hit, -sun.direction, true).r, 1.02f * straight);
    EXPECT_LT(irradianceAt(scene, layout, shown, hit, glm::normalize(glm::vec3(1, 2, 0)), true).r, straight);
}

// A sun of a few texels of the surroundings' picture is found by every point that sees it.
TEST(LightmapsTest, ASmallSunIsFoundEverywhere) {
    Scene scene = sceneOf(quad());
    auto image = std::make_shared<EnvironmentImage>();
    image->width = 512;  // of 64 directions by the cosine none would meet its sun
    image->height = 256;
    image->radiance.assign(512 * 256, glm::vec3(0.1f));
    image->radiance[512 * 40 + 100] = glm::vec3(1e5f);
    scene.environment.image = image;
    scene.environment.file = "sun";
    const LightmapLayout layout = layOutLightmaps(scene, 0.25f, 64);
    const std::vector<Lightmap> maps = bakeLightmaps(scene, layout, {.samples = 64});
    const float wanted = maps[0].irradiance[static_cast<std::size_t>(4 + 4 * maps[0].size.x)].g;
    EXPECT_GT(wanted, 2.0f);  // the rest of the sky alone gives 0.3
    const TexelCover cover(layout.meshes[0]);
    for (const std::uint32_t texel : cover.texels()) {
        const auto width = static_cast<std::uint32_t>(layout.meshes[0].size.x);
        const std::uint32_t at = static_cast<std::uint32_t>(layout.places[0].offset.x) + texel % width +
                                 (static_cast<std::uint32_t>(layout.places[0].offset.y) + texel / width) *
                                     static_cast<std::uint32_t>(maps[0].size.x);
        EXPECT_NEAR(maps[0].irradiance[at].g, wanted, 0.4f * wanted);
    }
    const ProbeGrid grid = fitProbeGrid(scene.bounds(), 1);
    const ProbeVolume volume = bakeProbes(scene, grid, {.samples = 64});
    const float up = irradianceOf(volume.probes[0].harmonics, {0, 1, 0}).g;
    for (const Probe& probe : volume.probes)
        EXPECT_NEAR(irradianceOf(probe.harmonics, {0, 1, 0}).g, up, 0.4f * up);
    EXPECT_NEAR(up, wanted, 0.4f * wanted);
}

TEST(LightmapsTest, ThePictureIsThatOfThePathTracer) {
    const Scene scene = io::loadScene("builtin:cornell");
    const LightmapLayout layout = layOutLightmaps(scene, scene.bounds().extent().x / 24, 1024);
    const std::vector<Lightmap> maps = bakeLightmaps(scene, layout, {.samples = 256});
    PathTracerSettings settings;
    settings.samplesPerPixel = 256;
    settings.seed = 7;
    const PathTracedPicture truth = PathTracer(scene).render(scene.cameras[0], 48, 48, settings);
    const BakedPicture picture = drawWithLightmaps(scene, layout, maps, false, scene.cameras[0], truth);
    MetricOptions numbers;
    numbers.flip = false;
    const Metrics diffuse = compareImages(picture.diffuse, truth.diffuse, numbers);
    EXPECT_LT(std::abs(diffuse.bias), 0.02);
    EXPECT_LT(diffuse.blockRelRmse, 0.08);

    // The same bits on any number of threads, others for another seed.
    for (const int threads : {1, 3}) {
        LightmapSettings small{.samples = 16};
        small.threads = threads;
        const std::vector<Lightmap> one = bakeLightmaps(scene, layout, small);
        small.threads = 2;
        const std::vector<Lightmap> two = bakeLightmaps(scene, layout, small);
        ASSERT_EQ(one.size(), two.size());
        EXPECT_EQ(one[0].irradiance, two[0].irradiance);
        small.seed = 2;
        EXPECT_NE(bakeLightmaps(scene, layout, small)[0].irradiance, two[0].irradiance);
    }
}

TEST(LightmapsTest, ABakeThatWasStoppedGoesOnToTheSameBits) {
    const Scene scene = io::loadScene("builtin:cornell");
    const LightmapLayout layout = layOutLightmaps(scene, scene.bounds().extent().x / 12, 512);
    const LightmapSettings settings{.samples = 16, .direct = true, .threads = 2};
    const std::vector<Lightmap> whole = bakeLightmaps(scene, layout, settings);
    PartialBake partial;
    EXPECT_TRUE(bakeLightmaps(
                    scene, layout, settings, [](double) { return false; }, &partial)
                    .empty());
    const double none = partial.share();
    bakeLightmaps(scene, layout, settings, {}, &partial);
    EXPECT_EQ(partial.share(), 1);
    EXPECT_LT(none, 1);
    // Half of it is lost: every second result.
    std::vector<std::uint8_t> bytes = partial.saved();
    std::uint64_t head[2];
    std::memcpy(head, bytes.data(), sizeof(head));
    std::vector<std::uint8_t> half(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(16 + head[0]));
    for (std::size_t i = 0; i < head[0]; ++i) {
        half[16 + i] = i % 2 == 0 ? 1 : 0;
        const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(16 + head[0] + i * head[1]);
        if (i % 2 == 0) half.insert(half.end(), from, from + static_cast<std::ptrdiff_t>(head[1]));
    }
    PartialBake restored;
    ASSERT_TRUE(restored.restore(half));
    EXPECT_NEAR(restored.share(), 0.5, 0.01);
    const std::vector<Lightmap> again = bakeLightmaps(scene, layout, settings, {}, &restored);
    ASSERT_EQ(again.size(), whole.size());
    EXPECT_EQ(again[0].irradiance, whole[0].irradiance);
    EXPECT_EQ(again[0].direct, whole[0].direct);
    EXPECT_EQ(again[0].direction, whole[0].direction);
    // What is damaged is not taken.
    PartialBake damaged;
    for (const std::size_t length : {std::size_t(0), std::size_t(15), std::size_t(16), half.size() - 1})
        EXPECT_FALSE(damaged.restore({half.data(), length})) << length;
    half[7] = 0xff;
    EXPECT_FALSE(damaged.restore(half));
}

// What stands on a floor must not darken the floor beside it through shared texels.
TEST(LightmapsTest, WhatIsCoveredDarkensNothing) {
    Scene scene = sceneOf(quad());
    scene.sky = glm::vec3(1);
    scene.meshes[0].positions = {{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}};
    Mesh plate = quad();  // lies on the floor, faces down
    plate.normals.assign(4, {0, -1, 0});
    plate.indices = {0, 2, 1, 0, 3, 2};
    scene.meshes.push_back(plate);
    scene.materials[0].doubleSided = true;
    scene.materials[0].baseColor = glm::vec4(0, 0, 0, 1);
    scene.instances.push_back({.name = "plate", .mesh = 1, .material = 0});
    scene.instances[1].worldFromObject[3][1] = 1e-4f;
    const LightmapLayout layout = layOutLightmaps(scene, 0.3f, 256);
    const std::vector<Lightmap> maps = bakeLightmaps(scene, layout, {.samples = 64});
    for (float x = 1.05f; x < 4; x += 0.1f) {  // beside the plate, on the second triangle
        RayHit hit;
        hit.triangle = 0;  // (-4,-4) (-4,4) (4,4)
        const float z = x + 0.02f;
        hit.barycentric = {(z + 4) / 8 - (x + 4) / 8, (x + 4) / 8};
        EXPECT_NEAR(irradianceAt(scene, layout, maps, hit, {0, 1, 0}, false).g, glm::pi<float>(), 0.02f) << x;
    }
}

TEST(LightmapsTest, ManyInstancesTakeSeveralMaps) {
    Scene scene = sceneOf(quad());
    for (int i = 1; i < 30; ++i) {
        scene.instances.push_back(scene.instances[0]);
        scene.instances.back().worldFromObject[3][0] = 3.0f * static_cast<float>(i);
    }
    scene.instances[7].visible = false;
    const LightmapLayout layout = layOutLightmaps(scene, 0.1f, 64);
    ASSERT_GE(layout.sizes.size(), 4u);
    EXPECT_EQ(layout.places[7].map, -1);
    std::set<std::array<int, 3>> taken;
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
        if (i == 7) continue;
        const LightmapPlace& place = layout.places[i];
        ASSERT_GE(place.map, 0);
        EXPECT_TRUE(taken.insert({place.map, place.offset.x, place.offset.y}).second);
        const glm::ivec2 end = place.offset + layout.meshes[0].size;
        EXPECT_LE(end.x, layout.sizes[static_cast<std::size_t>(place.map)].x);
        EXPECT_LE(end.y, layout.sizes[static_cast<std::size_t>(place.map)].y);
    }
    for (const glm::ivec2& size : layout.sizes) EXPECT_LE(std::max(size.x, size.y), 64);
}

TEST(LightmapsTest, WrongUseIsAnError) {
    const Scene scene = sceneOf(quad());
    EXPECT_THROW(layOutLightmaps(scene, 0, 64), Error);
    EXPECT_THROW(layOutLightmaps(scene, NAN, 64), Error);
    EXPECT_THROW(layOutLightmaps(scene, 1, 8), Error);
    EXPECT_THROW(layOutLightmaps(scene, 1e-3f, 64), Error);  // 2,000 texels
    EXPECT_THROW(layOutLightmaps(Scene{}, 1, 64), Error);
    const LightmapLayout layout = layOutLightmaps(scene, 0.5f, 64);
    EXPECT_THROW(bakeLightmaps(scene, layout, {.samples = 1}), Error);
    EXPECT_THROW(bakeLightmaps(scene, layout, {.bounces = 0}), Error);
    EXPECT_TRUE(bakeLightmaps(scene, layout, {}, [](double) { return false; }).empty());
    // Degenerate triangles and empty meshes do no harm.
    Scene odd = sceneOf(quad());
    odd.meshes[0].indices = {0, 0, 0, 0, 1, 2, 1, 1, 2};
    odd.meshes.emplace_back().name = "empty";
    odd.instances.push_back({.name = "nothing", .mesh = 1, .material = 0});
    const LightmapLayout oddLayout = layOutLightmaps(odd, 0.5f, 64);
    EXPECT_EQ(oddLayout.places[1].map, -1);
    EXPECT_EQ(bakeLightmaps(odd, oddLayout, {.samples = 16}).size(), 1u);
}

}  // namespace
}  // namespace conelight::test
