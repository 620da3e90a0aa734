// SPDX-License-Identifier: MIT
// Metals in mode `traced`: metal in metal and highlights against the path tracer, exact mirrors, lobes only
// where their instances are.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "io/generated.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kTracedPixels;

using TracedMirrorsTest = TracedModeTest;

// Two metal walls face each other; each shows what the other shows of a lit room.
TEST_F(TracedMirrorsTest, MetalSeenInMetalIsTheTruth) {
    for (const bool lamp : {false, true}) {
        Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
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
        Settings settings = tracedSettings(Quality::Converged, Component::Indirect);
        settings.light.emissiveQuads = false;
        settings.voxels.size = 64;
        const Image image = draw(scene, settings);
        EXPECT_LT(indirectError(image, truth), 0.15) << lamp;
        EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1.0, 0.03) << lamp;
    }
}

// Two metal balls under a lamp show each other's highlights, small and bright, where the truth has them:
// about the balls' own normals, not those of their voxels, and only of the part of the lamp that is in sight.
TEST_F(TracedMirrorsTest, MetalBallsShowEachOthersHighlights) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    Material metal = diffuseMaterial(glm::vec3(0.9f, 0.7f, 0.4f));
    metal.metallic = 1;
    metal.roughness = 0.13f;
    for (const float x : {-0.48f, 0.48f})
        addInstance(scene, sphereMesh(48, 24), metal,
                    glm::scale(glm::translate(glm::mat4(1), {x, -0.6f, -0.1f}), glm::vec3(0.35f)));
    // 1.5 mm below the ceiling, its edges within voxels.
    addInstance(scene, quadMesh({-0.43f, 0.9985f, -0.27f}, {0.81f, 0, 0}, {0, 0, 0.55f}),
                diffuseMaterial(glm::vec3(0), glm::vec3(6)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, -0.45f, 0.95f};
    camera.target = {0, -0.6f, -0.1f};
    camera.fovY = 0.8f;
    reference::PathTracerSettings path;
    path.samplesPerPixel = 256;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(camera, kPixels, kPixels, path);
    Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    settings.traced.specularRays = 16;  // few rays show highlights wider than they are
    settings.voxels.size = 64;
    const Image image = draw(scene, settings);
    const double error = indirectError(image, truth);
    RecordProperty("error", std::to_string(error));
    EXPECT_LT(error, 0.13);  // 0.10; about the normals of voxels 0.17
    EXPECT_NEAR(meanOf(image) / meanOf(truth.indirect), 1.0, 0.04);
}

// Half as wide as a voxel, the stripes of a wall are one colour to voxels; the mirror shows each of them.
TEST_F(TracedMirrorsTest, ExactMirrorsShowTextures) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0)));
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
    Material metal = diffuseMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0.02f;
    addInstance(scene, quadMesh({-0.9f, -0.9f, -0.95f}, {1.8f, 0, 0}, {0, 1.8f, 0}), metal);
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.8f};
    camera.target = {0, 0, -1};
    camera.fovY = 0.14f;  // 8 stripes, 6 pixels each
    Settings settings = tracedSettings(Quality::Draft);
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

// Below the least roughness of a lobe the edge of a patch is as sharp in an exact mirror as straight ahead; at it,
// pixels of 4 mm show what the lobe spreads over 8 mm.
TEST_F(TracedMirrorsTest, ExactMirrorsWithoutRoughnessAreSharp) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0)));
    Material metal = diffuseMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0;
    addInstance(scene, quadMesh({-0.9f, -0.9f, -0.95f}, {1.8f, 0, 0}, {0, 1.8f, 0}), metal);
    const auto mirror = scene.materials.size() - 1;
    addInstance(scene, quadMesh({0.5f, -0.5f, 0.99f}, {-0.5f, 0, 0}, {0, 1, 0}),
                diffuseMaterial(glm::vec3(0), glm::vec3(1)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.8f};
    camera.target = {0, 0, -1};
    camera.fovY = 0.05f;
    Settings settings = tracedSettings(Quality::Draft);
    settings.voxels.size = 16;
    settings.light.emissiveQuads = false;
    settings.traced.exactMirrors = true;
    settings.traced.filterLevels = 0;
    const auto between = [&] {
        const Image image = draw(scene, settings);
        int count = 0;
        for (int x = 0; x < kPixels; ++x) {
            const float shown = image.pixels[static_cast<std::size_t>(kPixels / 2 * kPixels + x)].g;
            count += shown > 0.05f && shown < 0.95f ? 1 : 0;
        }
        return count;
    };
    EXPECT_LE(between(), 1);
    scene.materials[mirror].roughness = 0.045f;
    EXPECT_GE(between(), 2);
}

// A floor that is seen at a grazing angle mirrors a step of 10 cm on the wall behind where it is: rays start on the floor.
// From 5 % of a voxel above it the step would be four pixels off.
TEST_F(TracedMirrorsTest, GrazedFloorsMirrorThingsWhereTheyAre) {
    constexpr float kFloor = -0.99f, kWall = -0.99f, kEye = 0.1f, kStep = 0.1f;
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0)));
    Material metal = diffuseMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0;
    addInstance(scene, quadMesh({-0.9f, kFloor, 0.98f}, {1.8f, 0, 0}, {0, 0, kWall - 0.98f}), metal);
    addInstance(scene, quadMesh({-0.9f, kFloor + kStep, kWall}, {1.8f, 0, 0}, {0, 1.5f, 0}),
                diffuseMaterial(glm::vec3(0), glm::vec3(1)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, kFloor + kEye, 0.95f};
    // Where the ray to the step meets the floor: in the middle of the picture.
    camera.target = {0, kFloor, camera.eye.z - (camera.eye.z - kWall) * kEye / (kEye + kStep)};
    camera.fovY = 0.05f;
    Settings settings = tracedSettings(Quality::Draft);
    settings.voxels.size = 16;
    settings.light.emissiveQuads = false;
    settings.traced.exactMirrors = true;
    settings.traced.filterLevels = 0;
    const Image image = draw(scene, settings);
    int lit = 0;  // the mirrored wall is above the step: in the lower half of the picture
    for (int y = 0; y < kPixels; ++y)
        lit += image.pixels[static_cast<std::size_t>(y * kPixels + kPixels / 2)].g > 0.5f ? 1 : 0;
    EXPECT_NEAR(lit, kPixels / 2, 1);
}

// The middle of each picture is on the edge between a metal floor and a wall, where rounding puts it. Rays from there show the
// room, which shines: they do not start behind the wall.
TEST_F(TracedMirrorsTest, PixelsInCornersMirrorTheRoom) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0), glm::vec3(1)));
    Material metal = diffuseMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0.25f;
    addInstance(scene, quadMesh({-1, -0.9f, 1}, {2, 0, 0}, {0, 0, -2}), metal);
    Settings settings = tracedSettings(Quality::Interactive, Component::Specular);
    settings.light.emissiveQuads = false;
    settings.traced.filterLevels = 0;
    Renderer renderer;
    renderer.setScene(scene);
    constexpr int kViews = 24;
    int floors = 0;
    for (int i = 0; i < kViews; ++i) {
        Camera camera;
        camera.eye = {0.3f, 0.2f, 0.7f};
        camera.target = {-1, -0.9f, -0.8f + 1.3f * static_cast<float>(i) / kViews};
        camera.fovY = 0.5f;
        renderer.render(camera, 5, 5, settings);
        const float own = renderer.readImage().pixels[12].g;
        floors += own > 0 ? 1 : 0;  // the others show the wall
        EXPECT_TRUE(own == 0 || own > 0.7f) << i << ": " << own;
    }
    EXPECT_GT(floors, kViews / 8);
}

// Vertex normals may turn the mirrored direction into the surface. It shows nothing there, as in the path tracer.
TEST_F(TracedMirrorsTest, NormalsThatMirrorIntoTheSurfaceShowNothing) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0), glm::vec3(1)));
    Material metal = diffuseMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0.1f;
    Mesh floor = quadMesh({-0.9f, -0.9f, 0.9f}, {1.8f, 0, 0}, {0, 0, -1.8f});
    floor.normals.assign(floor.normals.size(), glm::normalize(glm::vec3(0, 1, -0.4f)));
    addInstance(scene, floor, metal);
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, -0.5f, 0.85f};
    camera.target = {0, -0.9f, 0};
    camera.fovY = 0.2f;
    Settings settings = tracedSettings(Quality::Draft, Component::Specular);
    settings.light.emissiveQuads = false;
    settings.traced.passes = 16;  // one pass is the mean of 64 directions, of which one or two may be above
    EXPECT_LT(meanOf(draw(scene, settings)), 0.02);
    reference::PathTracerSettings path;
    path.samplesPerPixel = 4;
    path.emissiveQuads = false;
    EXPECT_LT(meanOf(reference::PathTracer(scene).render(camera, kPixels, kPixels, path).full), 0.02);
}

// A masked surface has holes in a mirror, and an instance that moved is where it is now.
TEST_F(TracedMirrorsTest, ExactMirrorsShowHolesAndWhatMoved) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0)));
    Texture half;
    half.width = half.height = 2;
    half.rgba = {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0};
    half.filter = TextureFilter::Nearest;
    scene.textures.push_back(std::move(half));
    Material sheet = diffuseMaterial(glm::vec3(0), glm::vec3(1));
    sheet.baseColorTexture.texture = 0;
    sheet.alphaMode = AlphaMode::Mask;
    Material metal = diffuseMaterial(glm::vec3(1));
    metal.metallic = 1;
    metal.roughness = 0.02f;
    addInstance(scene, quadMesh({-1, -1, -0.95f}, {2, 0, 0}, {0, 2, 0}), metal);
    const std::size_t moving =
        addInstance(scene, quadMesh({0.5f, -0.5f, 0.9f}, {-1, 0, 0}, {0, 1, 0}), sheet);
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.8f};
    camera.target = {0, 0, -1};
    camera.fovY = 0.6f;
    Settings settings = tracedSettings(Quality::Draft);
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

// Pixels with lobes are looked for, and their picture is read, only about the instances that may have them. A
// ball that is elsewhere than in the picture before leaves nothing behind, and the whole picture, which is
// drawn at once where lookups are counted, is the same but for rounding.
TEST_F(TracedMirrorsTest, LobesAreWhereTheirInstancesAre) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    scene.materials[static_cast<std::size_t>(scene.instances[2].material)].emission = glm::vec3(1);
    Material metal = diffuseMaterial(glm::vec3(0.9f, 0.7f, 0.4f));
    metal.metallic = 1;
    metal.roughness = 0.2f;
    addInstance(scene, sphereMesh(32, 16), metal,
                glm::scale(glm::translate(glm::mat4(1), {0, 0, -0.6f}), glm::vec3(0.15f)));
    Camera& camera = scene.cameras.at(0);
    camera.eye = {0, 0, 0.9f};
    camera.fovY = 1.2f;
    for (const Quality quality : {Quality::Draft, Quality::Interactive}) {
        const Settings settings = tracedSettings(quality);
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

}  // namespace
}  // namespace conelight::test
