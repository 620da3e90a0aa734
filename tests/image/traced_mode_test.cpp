// SPDX-License-Identifier: MIT
// Pictures of mode `traced` against what must be so: furnaces (matt and metal), bounces, parts that add up,
// the same bits every time, means over frames, a moving camera, thin walls under the filter.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/renderer.h"
#include "io/generated.h"
#include "reference/path_tracer.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 48;

Settings smallSettings(Quality quality, Component component = Component::Full) {
    Settings settings;
    settings.mode = Mode::Traced;
    settings.component = component;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    settings.light.areaSamples = 4;
    applyQuality(settings.traced, quality);
    settings.traced.cacheRays = std::min(settings.traced.cacheRays, 2);
    settings.traced.passes = std::min(settings.traced.passes, 8);
    return settings;
}

// relRMSE of indirect light, the truth's own noise left out by its halves.
double indirectError(const Image& image, const reference::PathTracedPicture& truth) {
    double square = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::dvec3 a(image.pixels[i] - truth.indirectA.pixels[i]);
        const glm::dvec3 b(image.pixels[i] - truth.indirectB.pixels[i]);
        square += glm::dot(a, b) / (3.0 * kPixels * kPixels);
    }
    return std::sqrt(std::max(square, 0.0)) / meanOf(truth.indirect);
}

class TracedModeTest : public GlTest {
  protected:
    static Image draw(Renderer& renderer, const Scene& scene, const Settings& settings) {
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        return renderer.readImage();
    }
    static Image draw(const Scene& scene, const Settings& settings) {
        Renderer renderer;
        renderer.setScene(scene);
        return draw(renderer, scene, settings);
    }
    // A room 2 wide with a wall from side to side that is much thinner than a voxel; light on one side only,
    // seen from above through the missing ceiling... of both floors.
    static Scene dividedRoom();
};

Scene TracedModeTest::dividedRoom() {
    Scene scene = closedBox(mattMaterial(glm::vec3(0.7f)));
    // Two faces 0.02 apart: a third of a voxel of 2.1 m / 32.
    addInstance(scene, quadMesh({0.01f, -1, -1}, {0, 2, 0}, {0, 0, 2}), mattMaterial(glm::vec3(0.7f)));
    addInstance(scene, quadMesh({-0.01f, -1, -1}, {0, 0, 2}, {0, 2, 0}), mattMaterial(glm::vec3(0.7f)));
    Light light;
    light.type = LightType::Point;
    light.position = {0.5f, 0.5f, 0};
    light.intensity = glm::vec3(1);
    scene.lights.push_back(light);
    return scene;
}

// Every ray of a closed box ends at a wall that shows e + rho L: L = e / (1 - rho) after all bounces.
TEST_F(TracedModeTest, FurnaceIsEvenAtEveryQuality) {
    const Scene scene = closedBox(mattMaterial(glm::vec3(0.5f), glm::vec3(1)));
    for (const Quality quality : {Quality::Draft, Quality::Interactive, Quality::High, Quality::Converged}) {
        Settings settings = smallSettings(quality);
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
        Scene scene = closedBox(mattMaterial(glm::vec3(0.5f), glm::vec3(1)));
        Material metal;
        metal.baseColor = glm::vec4(1);
        metal.metallic = 1;
        metal.roughness = roughness;
        metal.doubleSided = true;  // the wall behind it sees it as well
        addInstance(scene, quadMesh({-0.4f, -0.4f, -0.6f}, {0.8f, 0, 0}, {0, 0.8f, 0}), metal);
        Settings settings = smallSettings(Quality::Converged);
        settings.light.emissiveQuads = false;
        const Image image = draw(scene, settings);
        EXPECT_NEAR(meanOf(image), 2.0, 0.02) << roughness;
    }
}

// The edges of a box run through the middles of the pixels on the diagonals. A ray that starts on such an
// edge lies on two walls, and must meet the other one.
TEST_F(TracedModeTest, CornersLoseNoLight) {
    Scene scene = closedBox(mattMaterial(glm::vec3(0.5f), glm::vec3(1)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.9f};
    camera.target = {0, 0, -1};
    Settings settings = smallSettings(Quality::Interactive);
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

// Two metal walls face each other; each shows what the other shows of a lit room.
TEST_F(TracedModeTest, MetalSeenInMetalIsTheTruth) {
    for (const bool lamp : {false, true}) {
        Scene scene = closedBox(mattMaterial(glm::vec3(0.5f)));
        const auto wall = [&](std::size_t i) -> Material& {
            return scene.materials[static_cast<std::size_t>(scene.instances[i].material)];
        };
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
            wall(i).baseColor = glm::vec4(0.9f, 0.9f, 0.9f, 1);
            wall(i).metallic = 1;
            wall(i).specular = 1;
            // A smaller highlight of a point would be noise in the truth.
            wall(i).roughness = lamp ? 0.3f : 0.1f;
        }
        wall(4).baseColor = glm::vec4(0.8f, 0.1f, 0.1f, 1);
        wall(3).baseColor = glm::vec4(0.1f, 0.1f, 0.6f, 1);
        if (lamp) {
            Light light;
            light.type = LightType::Point;
            light.position = {0, 0.2f, -0.3f};
            light.intensity = glm::vec3(1);
            scene.lights.push_back(light);
        } else {
            wall(2).emission = glm::vec3(1);
        }
        Camera& camera = scene.cameras.at(0);
        camera.eye = {-0.6f, 0, 0.6f};
        camera.target = {1, 0, -0.2f};
        camera.fovY = 1.0f;
        reference::PathTracerSettings path;
        path.samplesPerPixel = 256;
        path.emissiveQuads = false;
        const reference::PathTracedPicture truth =
            reference::PathTracer(scene).render(camera, kPixels, kPixels, path);
        Settings settings = smallSettings(Quality::Converged, Component::Indirect);
        settings.light.emissiveQuads = false;
        settings.voxels.size = 64;
        const Image image = draw(scene, settings);
        EXPECT_LT(indirectError(image, truth), 0.15) << lamp;
        EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1.0, 0.03) << lamp;
    }
}

// Two metal balls under a lamp show each other's highlights, small and bright, where the truth has them:
// about the balls' own normals, not those of their voxels, and only of the part of the lamp that is in sight.
TEST_F(TracedModeTest, MetalBallsShowEachOthersHighlights) {
    Scene scene = closedBox(mattMaterial(glm::vec3(0.5f)));
    Material metal = mattMaterial(glm::vec3(0.9f, 0.7f, 0.4f));
    metal.metallic = 1;
    metal.roughness = 0.13f;
    for (const float x : {-0.48f, 0.48f})
        addInstance(scene, sphereMesh(48, 24), metal,
                    glm::scale(glm::translate(glm::mat4(1), {x, -0.6f, -0.1f}), glm::vec3(0.35f)));
    // 1.5 mm below the ceiling, its edges within voxels.
    addInstance(scene, quadMesh({-0.43f, 0.9985f, -0.27f}, {0.81f, 0, 0}, {0, 0, 0.55f}),
                mattMaterial(glm::vec3(0), glm::vec3(6)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, -0.45f, 0.95f};
    camera.target = {0, -0.6f, -0.1f};
    camera.fovY = 0.8f;
    reference::PathTracerSettings path;
    path.samplesPerPixel = 256;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(camera, kPixels, kPixels, path);
    Settings settings = smallSettings(Quality::Interactive, Component::Indirect);
    settings.traced.specularRays = 16;  // few rays show highlights wider than they are
    settings.voxels.size = 64;
    const Image image = draw(scene, settings);
    const double error = indirectError(image, truth);
    RecordProperty("error", std::to_string(error));
    EXPECT_LT(error, 0.13);  // 0.10; about the normals of voxels 0.17
    EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1.0, 0.04);
}

// Half as wide as a voxel, the stripes of a wall are one colour to voxels; the mirror shows each of them.
TEST_F(TracedModeTest, ExactMirrorsShowTextures) {
    Scene scene = closedBox(mattMaterial(glm::vec3(0)));
    Texture stripes;
    stripes.width = stripes.height = 64;
    for (int i = 0; i < 64 * 64; ++i) {
        const bool red = i / 2 % 2 == 0;
        stripes.rgba.insert(stripes.rgba.end(), {static_cast<std::uint8_t>(red ? 255 : 0),
                                                 static_cast<std::uint8_t>(red ? 0 : 255), 0, 255});
    }
    scene.textures.push_back(std::move(stripes));
    Material& wall = scene.materials[static_cast<std::size_t>(scene.instances[5].material)];
    wall.emission = glm::vec3(1);
    wall.emissiveTexture.texture = 0;
    Material metal = mattMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0.02f;
    addInstance(scene, quadMesh({-0.9f, -0.9f, -0.95f}, {1.8f, 0, 0}, {0, 1.8f, 0}), metal);
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.8f};
    camera.target = {0, 0, -1};
    camera.fovY = 0.14f;  // 8 stripes, 6 pixels each
    Settings settings = smallSettings(Quality::Draft);
    settings.voxels.size = 16;
    settings.light.emissiveQuads = false;
    const auto contrast = [&] {
        const Image image = draw(scene, settings);
        double sum = 0;
        for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(std::abs(pixel.r - pixel.g));
        return sum / (kPixels * kPixels);
    };
    EXPECT_LT(contrast(), 0.3);
    settings.traced.exactMirrors = true;
    EXPECT_GT(contrast(), 0.6);
}

// A masked surface has holes in a mirror, and an instance that moved is where it is now.
TEST_F(TracedModeTest, ExactMirrorsShowHolesAndWhatMoved) {
    Scene scene = closedBox(mattMaterial(glm::vec3(0)));
    Texture half;
    half.width = half.height = 2;
    half.rgba = {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0};
    half.filter = TextureFilter::Nearest;
    scene.textures.push_back(std::move(half));
    Material sheet = mattMaterial(glm::vec3(0), glm::vec3(1));
    sheet.baseColorTexture.texture = 0;
    sheet.alphaMode = AlphaMode::Mask;
    Material metal = mattMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0.02f;
    addInstance(scene, quadMesh({-1, -1, -0.95f}, {2, 0, 0}, {0, 2, 0}), metal);
    const std::size_t moving =
        addInstance(scene, quadMesh({0.5f, -0.5f, 0.9f}, {-1, 0, 0}, {0, 1, 0}), sheet);
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.8f};
    camera.target = {0, 0, -1};
    camera.fovY = 0.6f;
    Settings settings = smallSettings(Quality::Draft);
    settings.light.emissiveQuads = false;
    settings.traced.exactMirrors = true;
    settings.traced.filterLevels = 0;
    Renderer renderer;
    renderer.setScene(scene);
    // Pixels left and right of the middle show one half of the sheet each.
    const auto halves = [&](const Image& image) {
        const auto at = [&](int x) {
            return image.pixels[static_cast<std::size_t>(kPixels / 2 * kPixels + x)].x;
        };
        return glm::vec2(at(kPixels / 2 - 6), at(kPixels / 2 + 6));
    };
    const glm::vec2 before = halves(draw(renderer, scene, settings));
    EXPECT_NEAR(std::max(before.x, before.y), 1.0f, 0.05f);
    EXPECT_NEAR(std::min(before.x, before.y), 0.0f, 0.05f);
    // By half its width: the opaque half is now where the holes were.
    scene.instances[moving].worldFromObject =
        glm::translate(glm::mat4(1), {before.x < before.y ? -0.5f : 0.5f, 0, 0});
    renderer.setInstance(moving, scene.instances[moving]);
    const glm::vec2 after = halves(draw(renderer, scene, settings));
    EXPECT_NEAR(after.x, before.y, 0.05f);
    EXPECT_NEAR(after.y, before.x, 0.05f);
}

// Front and back of a thin lamp alternate among the bright faces: no pixel's rays find the back alone.
TEST_F(TracedModeTest, RaysToBrightFacesDoNotKeepStepWithVoxels) {
    const Scene scene = io::generateScene("lobby");
    Settings settings;
    settings.mode = Mode::Traced;
    settings.component = Component::Diffuse;
    settings.voxels.size = 128;
    applyQuality(settings.traced, Quality::Converged);
    settings.traced.cacheUpdates = 6;
    settings.traced.filterLevels = 0;
    constexpr int kSize = 64;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kSize, kSize, settings);
    const Image image = renderer.readImage();
    // Neighbours on the floor, an even surface.
    double square = 0, sum = 0;
    int count = 0;
    for (int y = kSize - 12; y < kSize; ++y)
        for (int x = 20; x < 44; ++x, ++count) {
            const auto at = static_cast<std::size_t>(y * kSize + x);
            const double p = static_cast<double>(image.pixels[at].y);
            square += 0.5 * std::pow(p - static_cast<double>(image.pixels[at + 1].y), 2);
            sum += p;
        }
    EXPECT_GT(sum, 0);
    EXPECT_LT(std::sqrt(square / count) / (sum / count), 0.15);  // 0.19 when they did
}

TEST_F(TracedModeTest, SameBitsTwice) {
    const Scene scene = io::generateScene("cornell");
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        const Settings settings = smallSettings(quality);
        Renderer renderer;
        renderer.setScene(scene);
        const Image first = draw(renderer, scene, settings);
        EXPECT_EQ(first.pixels, draw(renderer, scene, settings).pixels);
        EXPECT_EQ(first.pixels, draw(scene, settings).pixels);
    }
}

// Pixels with lobes are looked for, and their picture is read, only about the instances that may have them. A
// ball that is elsewhere than in the picture before leaves nothing behind, and the whole picture, which is
// drawn at once where lookups are counted, is the same but for rounding.
TEST_F(TracedModeTest, LobesAreWhereTheirInstancesAre) {
    Scene scene = closedBox(mattMaterial(glm::vec3(0.5f)));
    scene.materials[static_cast<std::size_t>(scene.instances[2].material)].emission = glm::vec3(1);
    Material metal = mattMaterial(glm::vec3(0.9f, 0.7f, 0.4f));
    metal.metallic = 1;
    metal.roughness = 0.2f;
    addInstance(scene, sphereMesh(32, 16), metal,
                glm::scale(glm::translate(glm::mat4(1), {0, 0, -0.6f}), glm::vec3(0.15f)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.9f};
    camera.fovY = 1.2f;
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        const Settings settings = smallSettings(quality);
        Renderer renderer;
        renderer.setScene(scene);
        Image fresh;
        for (const float x : {-0.5f, 0.4f, 0.0f}) {
            camera.target = {x, 0.5f * x, -0.6f};
            const Image image = draw(renderer, scene, settings);
            fresh = draw(scene, settings);
            EXPECT_EQ(image.pixels, fresh.pixels) << x;
        }
        // The ball is in the middle, and reflects what the walls do not show.
        Settings rough = settings;
        rough.traced.specularLimit = 0;
        constexpr std::size_t kMiddle = std::size_t{kPixels} * kPixels / 2 + kPixels / 2;
        EXPECT_GT(glm::length(fresh.pixels[kMiddle] - draw(scene, rough).pixels[kMiddle]), 1e-3f);
        renderer.setProfiling(false, true);
        const Image whole = draw(renderer, scene, settings);
        for (std::size_t i = 0; i < whole.pixels.size(); ++i)
            ASSERT_LT(glm::length(whole.pixels[i] - fresh.pixels[i]),
                      1e-5f * glm::length(whole.pixels[i]) + 1e-9f)
                << i;
    }
}

// What was drawn before, with other settings, leaves nothing in a picture.
TEST_F(TracedModeTest, QualitiesDoNotMix) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    draw(renderer, scene, smallSettings(Quality::Interactive));
    const Settings draft = smallSettings(Quality::Draft);
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
            const Image image = draw(renderer, scene, smallSettings(quality, part));
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

// Furnace of albedo 1/2 and emission 1: n bounces show 2 - 2^-n.
TEST_F(TracedModeTest, BouncesAddUpOneByOne) {
    const Scene scene = closedBox(mattMaterial(glm::vec3(0.5f), glm::vec3(1)));
    Renderer renderer;
    renderer.setScene(scene);
    for (const int rays : {0, 2}) {
        for (const int bounces : {0, 1, 2, 3, 6}) {
            Settings settings = smallSettings(Quality::Interactive);
            settings.light.emissiveQuads = false;
            settings.traced.pixelRays = rays;
            settings.traced.bounces = bounces;
            EXPECT_NEAR(meanOf(draw(renderer, scene, settings)), 2.0 - std::pow(0.5, bounces), 0.01)
                << rays << " rays, " << bounces << " bounces";
        }
    }
}

// Independent passes: the error of the mean falls as 1 / sqrt(n), so n = 4 -> 64 by a factor of 4.
TEST_F(TracedModeTest, MoreFramesLessNoise) {
    const Scene scene = io::generateScene("cornell-point");
    Renderer renderer;
    renderer.setScene(scene);
    Settings settings = smallSettings(Quality::Interactive, Component::Diffuse);
    settings.traced.filterLevels = 0;
    const auto noise = [&](int passes) {
        settings.traced.passes = passes;
        return draw(renderer, scene, settings);
    };
    const Image truth = noise(512);
    const double few = relRmse(noise(4), truth);
    const double many = relRmse(noise(64), truth);
    EXPECT_GT(few / many, 3.0);
    EXPECT_LT(many, 0.2);
}

// What the cache shows after few updates is shared between neighbours of one plane: 13.5 % off without that.
// After many it is each face's own.
TEST_F(TracedModeTest, FewUpdatesOfTheCacheShowLittleNoise) {
    const Scene scene = io::generateScene("cornell-point");
    Settings settings = smallSettings(Quality::Draft, Component::Diffuse);
    const auto after = [&](int updates) {
        settings.traced.cacheUpdates = updates;
        return draw(scene, settings);
    };
    const Image settled = after(250);
    EXPECT_LT(relRmse(after(12), settled), 0.1);
    EXPECT_LT(relRmse(after(48), settled), 0.06);
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

// A camera that moves over a still scene, frame by frame with reuse, ends up near a picture made at rest.
TEST_F(TracedModeTest, MovingCameraLeavesNoGhosts) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    Settings settings = smallSettings(Quality::Interactive, Component::Diffuse);
    draw(renderer, scene, settings);  // settles the cache
    Camera camera = scene.cameras.at(0);
    settings.traced.budgeted = true;
    for (int frame = 0; frame < 16; ++frame) {
        camera.eye.x += 0.03f;
        renderer.render(camera, kPixels, kPixels, settings);
    }
    const Image moving = renderer.readImage();
    settings.traced.budgeted = false;
    settings.traced.passes = 128;
    settings.traced.filterLevels = 0;
    renderer.render(camera, kPixels, kPixels, settings);
    const Image rest = renderer.readImage();
    // As good as a camera at rest for as many frames, within what resampling blurs.
    Renderer other;
    other.setScene(scene);
    settings.traced.passes = 8;
    settings.traced.filterLevels = 2;
    other.render(camera, kPixels, kPixels, settings);
    EXPECT_LT(relRmse(moving, rest), 1.5 * relRmse(other.readImage(), rest));
    EXPECT_NEAR(meanOf(moving) / meanOf(rest), 1.0, 0.02);
}

// The dark half of a divided room stays dark, under the filter, too.
TEST_F(TracedModeTest, FilterDoesNotCrossThinWalls) {
    Scene scene = dividedRoom();
    scene.cameras.clear();
    Camera camera;  // sees the edge of the wall, the floor on both sides of it
    camera.eye = {0, 0.95f, 0.9f};
    camera.target = {0, -1, -0.2f};
    camera.fovY = 1.2f;
    scene.cameras.push_back(camera);
    const auto leak = [&](const Image& image) {
        double dark = 0, lit = 0;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x)
                (x < kPixels / 2 - 1 ? dark : lit) +=
                    static_cast<double>(image.pixels[static_cast<std::size_t>(y * kPixels + x)].y);
        return dark / lit;
    };
    Settings settings = smallSettings(Quality::Interactive, Component::Indirect);
    settings.traced.filterLevels = 0;
    const double plain = leak(draw(scene, settings));
    settings.traced.filterLevels = 3;
    const double filtered = leak(draw(scene, settings));
    EXPECT_LT(plain, 0.02);
    EXPECT_LT(filtered, plain + 0.005);
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
    Material stone = mattMaterial(glm::vec3(0.7f));
    Scene scene;
    addInstance(scene, quadMesh({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}), mattMaterial(glm::vec3(0.5f)));
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
        const Settings settings = smallSettings(quality, Component::Indirect);
        const double single = meanOf(draw(scene, settings));
        Scene other = scene;
        for (Material& material : other.materials) material.doubleSided = true;
        EXPECT_NEAR(meanOf(draw(other, settings)) / single, 1.0, 0.03) << static_cast<int>(quality);
    }
}

// Pixels that `isDot(own, sorted 3x3)` says so of.
template <class IsDot>
int dotsIn(const Image& image, IsDot isDot) {
    int dots = 0;
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            std::array<float, 9> around;
            for (int i = 0; i < 9; ++i) {
                const int at = (y + i / 3 - 1) * image.width + x + i % 3 - 1;
                around[static_cast<std::size_t>(i)] = image.pixels[static_cast<std::size_t>(at)].x;
            }
            const float own = around[4];
            std::sort(around.begin(), around.end());
            dots += isDot(own, around) ? 1 : 0;
        }
    return dots;
}

// Of the light that a metal floor and metal things send to walls few rays find much. It must arrive without
// speckles, pixels far brighter than those about them, and all of it.
TEST_F(TracedModeTest, MetalsThrowNoSpecklesOnWalls) {
    const Scene scene = io::generateScene("glossy");
    Settings settings = smallSettings(Quality::Interactive, Component::Diffuse);
    const Image image = draw(scene, settings);
    // Six of nine are of the same surface.
    const int speckles = dotsIn(image, [](float own, const std::array<float, 9>& around) {
        return around[3] > 0 && own > 1.5f * around[8 - 1];
    });
    EXPECT_LE(speckles, 4);
    settings.component = Component::Full;
    reference::PathTracerSettings truth;
    truth.samplesPerPixel = 64;
    const double expected =
        meanOf(reference::PathTracer(scene).render(scene.cameras.at(0), kPixels, kPixels, truth).full);
    EXPECT_NEAR(meanOf(draw(scene, settings)) / expected, 1.0, 0.03);
}

// A lamp far away whose edges lie between voxels. Of what it sends no part is left to rays by the cosine
// alone: the few that meet it would each be a white dot.
TEST_F(TracedModeTest, FarLampsThrowNoDotsOnFloors) {
    const Scene scene = io::generateScene("tunnel");
    Settings settings = smallSettings(Quality::Converged, Component::Diffuse);
    settings.voxels.size = 128;  // of these the lamp's near edge meets a side
    settings.traced.passes = 16;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.at(0), 160, 160, settings);
    const int dots = dotsIn(renderer.readImage(), [](float own, const std::array<float, 9>& around) {
        return around[3] > 0 && own > 1.5f * around[8 - 1];
    });
    EXPECT_LE(dots, 2);
}

// A room lit by one lamp that rays must find: where few did, a pixel is darker than all about it, and the
// filter must share nonetheless.
TEST_F(TracedModeTest, FewRaysLeaveNoDarkDots) {
    const Image image =
        draw(io::generateScene("lobby"), smallSettings(Quality::Interactive, Component::Diffuse));
    EXPECT_LE(
        dotsIn(image, [](float own,
                         const std::array<float, 9>& around) { return own > 0 && own < 0.8f * around[1]; }),
        2);
}

// A room lit by small lamps alone, noisy, and how much differs from place to place: a filter whose tolerance
// does not depend on it is 16 % off.
TEST_F(TracedModeTest, FilterKnowsHowMuchNoiseThereIs) {
    const Scene scene = io::generateScene("lounge");
    Settings settings = smallSettings(Quality::Interactive, Component::Diffuse);
    settings.voxels.size = 64;
    settings.traced.passes = 16;
    Renderer renderer;
    renderer.setScene(scene);
    const auto picture = [&] {
        renderer.render(scene.cameras.at(0), 160, 160, settings);
        return renderer.readImage();
    };
    const Image filtered = picture();
    settings.traced.filterLevels = 0;
    const Image plain = picture();
    settings.traced.passes = 512;
    const Image truth = picture();
    EXPECT_LT(relRmse(filtered, truth), 0.145);
    EXPECT_GT(relRmse(plain, truth), 0.3);
    EXPECT_NEAR(meanOf(filtered) / meanOf(truth), 1.0, 0.02);
}

TEST_F(TracedModeTest, EveryComponentIsFinite) {
    const Scene scene = io::generateScene("spheres");
    Renderer renderer;
    renderer.setScene(scene);
    for (const Component part : {Component::Full, Component::Indirect, Component::Specular,
                                 Component::Occlusion, Component::Voxels}) {
        const Image image = draw(renderer, scene, smallSettings(Quality::Interactive, part));
        EXPECT_GT(meanOf(image), 0.0);  // NaN where one pixel is not finite
    }
}

}  // namespace
}  // namespace conelight::test
