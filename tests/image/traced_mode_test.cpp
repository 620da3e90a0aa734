// SPDX-License-Identifier: MIT
// Pictures of mode `traced` against what must be so: furnaces (diffuse and metal), bounces, parts that add
// up, the same bits every time, memory, solids with two sides.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "io/generated.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kTracedPixels;

// Every ray of a closed box ends at a wall that shows e + rho L: L = e / (1 - rho) after all bounces.
TEST_F(TracedModeTest, FurnaceIsEvenAtEveryQuality) {
    const Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    for (const Quality quality : {Quality::Draft, Quality::Interactive, Quality::High, Quality::Converged}) {
        Settings settings = tracedSettings(quality);
        settings.light.emissiveQuads = false;  // the walls shine by their voxels
        const Image image = draw(scene, settings);
        EXPECT_NEAR(meanOf(image), 2.0, 0.004) << static_cast<int>(quality);
        double square = 0;
        for (const glm::vec4& p : image.pixels) square += std::pow(static_cast<double>(p.x) / 2 - 1, 2);
        EXPECT_LT(std::sqrt(square / (kPixels * kPixels)), 0.03) << static_cast<int>(quality);
    }
}

// White metal takes nothing away: a plate in a furnace of radiance 2 cannot be seen.
TEST_F(TracedModeTest, WhiteMetalVanishesInTheFurnace) {
    for (const float roughness : {0.05f, 0.3f, 0.8f}) {
        Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
        Material metal;
        metal.baseColor = glm::vec4(1);
        metal.metallic = 1;
        metal.roughness = roughness;
        metal.doubleSided = true;  // the wall behind it sees it as well
        addInstance(scene, quadMesh({-0.4f, -0.4f, -0.6f}, {0.8f, 0, 0}, {0, 0.8f, 0}), metal);
        Settings settings = tracedSettings(Quality::Converged);
        settings.light.emissiveQuads = false;
        const Image image = draw(scene, settings);
        EXPECT_NEAR(meanOf(image), 2.0, 0.02) << roughness;
    }
}

// The edges of a box run through the middles of the pixels on the diagonals. A ray that starts on such an
// edge lies on two walls, and must meet the other one.
TEST_F(TracedModeTest, CornersLoseNoLight) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.9f};
    camera.target = {0, 0, -1};
    Settings settings = tracedSettings(Quality::Interactive);
    settings.light.emissiveQuads = false;
    settings.traced.filterLevels = 0;
    const Image image = draw(scene, settings);
    double sum = 0;
    for (int i = 0; i < kPixels; ++i)
        for (const int x : {i, kPixels - 1 - i})
            sum += static_cast<double>(image.pixels[static_cast<std::size_t>(i * kPixels + x)].x);
    // Half of the light of each was lost, on some of them.
    EXPECT_NEAR(sum / (2 * kPixels), 2.0, 0.04);
}

TEST_F(TracedModeTest, SameBitsTwice) {
    const Scene scene = io::generateScene("cornell");
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        const Settings settings = tracedSettings(quality);
        Renderer renderer;
        renderer.setScene(scene);
        const Image first = draw(renderer, scene, settings);
        EXPECT_EQ(first.pixels, draw(renderer, scene, settings).pixels);
        EXPECT_EQ(first.pixels, draw(scene, settings).pixels);
    }
}

// Grids with too many bins keep faces in the order in which they are stored; they ended with an error.
TEST_F(TracedModeTest, FinestGridIsAsBrightAsACoarseOne) {
    const Scene scene = io::generateScene("cornell");
    Settings settings = tracedSettings(Quality::Draft);
    settings.traced.cacheUpdates = 1;
    settings.traced.cacheRays = 1;
    const auto brightness = [&](int voxels) {
        settings.voxels.size = voxels;
        const Image image = draw(scene, settings);
        double sum = 0;
        for (const glm::vec4& p : image.pixels) sum += p.g;
        return sum;
    };
    const double coarse = brightness(128);
    EXPECT_NEAR(brightness(512) / coarse, 1, 0.05);
}

// What was drawn before, with other settings, leaves nothing in a picture.
TEST_F(TracedModeTest, QualitiesDoNotMix) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    draw(renderer, scene, tracedSettings(Quality::Interactive));
    const Settings draft = tracedSettings(Quality::Draft);
    EXPECT_EQ(draw(renderer, scene, draft).pixels, draw(scene, draft).pixels);
    Settings coarse = draft;
    coarse.voxels.size = 16;
    draw(renderer, scene, coarse);
    EXPECT_EQ(draw(renderer, scene, draft).pixels, draw(scene, draft).pixels);
    // Nor another scene.
    const Scene other = io::generateScene("leak");
    renderer.setScene(other);
    EXPECT_EQ(draw(renderer, other, draft).pixels, draw(other, draft).pixels);
}

TEST_F(TracedModeTest, PartsAddUp) {
    const Scene scene = io::generateScene("glossy");
    Renderer renderer;
    renderer.setScene(scene);
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        Image sum, full;
        for (const Component part :
             {Component::Full, Component::Direct, Component::Diffuse, Component::Specular}) {
            const Image image = draw(renderer, scene, tracedSettings(quality, part));
            if (part == Component::Full) {
                full = image;
                sum = image;
                for (glm::vec4& p : sum.pixels) p = glm::vec4(0);
                continue;
            }
            for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
        }
        for (std::size_t i = 0; i < sum.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(sum.pixels[i][c], full.pixels[i][c], 1e-5f + 1e-4f * full.pixels[i][c]);
    }
}

// A part alone, also one that needs no voxels, is the same whether they were made for a picture before or
// not.
TEST_F(TracedModeTest, PartsAreTheSameInAFreshRenderer) {
    const Scene scene = io::generateScene("glossy");
    Renderer used;
    used.setScene(scene);
    draw(used, scene, tracedSettings(Quality::Draft));
    for (const Component part : {Component::Direct, Component::Diffuse, Component::Specular}) {
        const Settings settings = tracedSettings(Quality::Draft, part);
        EXPECT_EQ(draw(scene, settings).pixels, draw(used, scene, settings).pixels) << static_cast<int>(part);
    }
}

// Furnace of albedo 1/2 and emission 1: n bounces show 2 - 2^-n.
TEST_F(TracedModeTest, BouncesAddUpOneByOne) {
    const Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    Renderer renderer;
    renderer.setScene(scene);
    for (const int rays : {0, 2}) {
        for (const int bounces : {0, 1, 2, 3, 6}) {
            Settings settings = tracedSettings(Quality::Interactive);
            settings.light.emissiveQuads = false;
            settings.traced.pixelRays = rays;
            settings.traced.bounces = bounces;
            EXPECT_NEAR(meanOf(draw(renderer, scene, settings)), 2.0 - std::pow(0.5, bounces), 0.01)
                << rays << " rays, " << bounces << " bounces";
        }
    }
}

// What does not grow with the picture: voxels, light, shadow maps, the scene.
TEST_F(TracedModeTest, VoxelsAndLightTakeLittleMemory) {
    const Scene scene = io::generateScene("cornell");
    Settings settings;
    settings.mode = Mode::Traced;
    applyQuality(settings.traced, Quality::Draft);
    settings.traced.cacheUpdates = 1;
    settings.voxels.size = 128;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.at(0), 1, 1, settings);
    std::size_t bytes = 0;
    for (const MemoryStats& object : renderer.stats().memory) bytes += object.bytes;
    RecordProperty("bytes", std::to_string(bytes));
    EXPECT_LE(bytes, 32'000'000u);
    EXPECT_GT(bytes, 10'000'000u);
}

// Nobody sees the inside of a solid: making its material two-sided changes nothing. Ribs of half a voxel, so
// that plane pieces are not where the surface is.
TEST_F(TracedModeTest, SolidsMayBeTwoSided) {
    constexpr int kRibs = 28;
    Mesh column;
    for (int i = 0; i < 2 * kRibs; ++i) {
        const auto at = [](int k, float y) {
            const float angle = glm::pi<float>() * static_cast<float>(k) / kRibs;
            const float radius = k % 2 == 0 ? 0.45f : 0.41f;
            return glm::vec3(radius * std::sin(angle), y, radius * std::cos(angle));
        };
        const glm::vec3 low = at(i, -1);
        const Mesh rib = quadMesh(low, at(i + 1, -1) - low, {0, 1.6f, 0});
        const auto first = static_cast<std::uint32_t>(column.positions.size());
        column.positions.insert(column.positions.end(), rib.positions.begin(), rib.positions.end());
        column.normals.insert(column.normals.end(), rib.normals.begin(), rib.normals.end());
        column.uvs.insert(column.uvs.end(), rib.uvs.begin(), rib.uvs.end());
        for (const std::uint32_t index : rib.indices) column.indices.push_back(first + index);
    }
    Material stone = diffuseMaterial(glm::vec3(0.7f));
    Scene scene;
    addInstance(scene, quadMesh({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial(glm::vec3(0.5f)));
    addInstance(scene, quadMesh({-0.5f, 0.6f, 0.5f}, {1, 0, 0}, {0, 0, -1}), stone);
    addInstance(scene, quadMesh({-0.5f, 0.6f, -0.5f}, {1, 0, 0}, {0, 0, 1}), stone);
    addInstance(scene, column, stone);
    scene.sky = glm::vec3(1);
    Camera camera;
    camera.eye = {0, 0, 1.6f};
    camera.target = {0, -0.2f, 0};
    camera.fovY = 0.6f;
    scene.cameras.push_back(camera);
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        const Settings settings = tracedSettings(quality, Component::Indirect);
        const double single = meanOf(draw(scene, settings));
        Scene other = scene;
        for (Material& material : other.materials) material.doubleSided = true;
        EXPECT_NEAR(meanOf(draw(other, settings)) / single, 1.0, 0.03) << static_cast<int>(quality);
    }
}

TEST_F(TracedModeTest, EveryComponentIsFinite) {
    const Scene scene = io::generateScene("spheres");
    Renderer renderer;
    renderer.setScene(scene);
    for (const Component part : {Component::Full, Component::Indirect, Component::Specular,
                                 Component::Occlusion, Component::Voxels}) {
        const Image image = draw(renderer, scene, tracedSettings(Quality::Interactive, part));
        EXPECT_GT(meanOf(image), 0.0);  // NaN where one pixel is not finite
    }
}

}  // namespace
}  // namespace conelight::test
