// SPDX-License-Identifier: MIT
// Noise of mode `traced` and its filter: means over frames, a moving camera, thin walls under the filter,
// speckles and dots that few rays would leave.
#include <algorithm>
#include <cmath>

#include "io/generated.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kTracedPixels;

using TracedNoiseTest = TracedModeTest;

// A room 2 wide with a wall from side to side that is much thinner than a voxel; light on one side only,
// seen from above through the missing ceiling... of both floors.
Scene dividedRoom() {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.7f)));
    // Two faces 0.02 apart: a third of a voxel of 2.1 m / 32.
    addInstance(scene, quadMesh({0.01f, -1, -1}, {0, 2, 0}, {0, 0, 2}), diffuseMaterial(glm::vec3(0.7f)));
    addInstance(scene, quadMesh({-0.01f, -1, -1}, {0, 0, 2}, {0, 2, 0}), diffuseMaterial(glm::vec3(0.7f)));
    Light light;
    light.type = LightType::Point;
    light.position = {0.5f, 0.5f, 0};
    light.intensity = glm::vec3(1);
    scene.lights.push_back(light);
    return scene;
}

// Front and back of a thin lamp alternate among the light samples: no pixel's rays find the back alone.
TEST_F(TracedNoiseTest, LightSampledRaysDoNotKeepStepWithVoxels) {
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

// Independent passes: the error of the mean falls as 1 / sqrt(n), so n = 4 -> 64 by a factor of 4.
TEST_F(TracedNoiseTest, MoreFramesLessNoise) {
    const Scene scene = io::generateScene("cornell-point");
    Renderer renderer;
    renderer.setScene(scene);
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
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

// Pixels at the places of a square of 8x8 have evenly spread parts of one sequence. The mean of a square of a wall in even
// light, one pass: independent pixels would be off by an eighth of what one pixel is, with 64 squares give or take a tenth.
// Returns how far off it is, in those eighths.
double errorOfSquares(const Scene& scene, Settings settings) {
    Camera camera = scene.cameras.at(0);
    camera.fovY = 0.2f;  // the back wall alone
    Renderer renderer;
    renderer.setScene(scene);
    settings.traced.filterLevels = 0;
    constexpr int kSize = 64;
    const auto picture = [&](int passes) {
        settings.traced.passes = passes;
        renderer.render(camera, kSize, kSize, settings);
        return renderer.readImage();
    };
    const Image one = picture(1), truth = picture(256);
    const auto squares = [](const Image& image) {
        Image means{kSize / 8, kSize / 8, std::vector<glm::vec4>(kSize * kSize / 64, glm::vec4(0))};
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                means.pixels[static_cast<std::size_t>(y / 8 * (kSize / 8) + x / 8)] +=
                    image.pixels[static_cast<std::size_t>(y * kSize + x)] / 64.0f;
        return means;
    };
    return 8 * relRmse(squares(one), squares(truth)) / relRmse(one, truth);
}

TEST_F(TracedNoiseTest, NeighboursComplementEachOther) {
    const Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
    EXPECT_LT(errorOfSquares(io::generateScene("cornell-point"), settings), 0.75);
}

TEST_F(TracedNoiseTest, LobesOfNeighboursComplementEachOther) {
    Scene scene = io::generateScene("cornell-point");
    for (Material& material : scene.materials) {
        material.metallic = 1;
        material.roughness = 0.5f;
    }
    Settings settings = tracedSettings(Quality::Interactive, Component::Specular);
    settings.traced.bounces = 4;  // rays end where they hit: only the first direction is drawn
    EXPECT_LT(errorOfSquares(scene, settings), 0.75);
}

// What the cache shows after few updates is shared between neighbours of one plane: 13.5 % off without that.
// After many it is each face's own.
TEST_F(TracedNoiseTest, FewUpdatesOfTheCacheShowLittleNoise) {
    const Scene scene = io::generateScene("cornell-point");
    Settings settings = tracedSettings(Quality::Draft, Component::Diffuse);
    const auto after = [&](int updates) {
        settings.traced.cacheUpdates = updates;
        return draw(scene, settings);
    };
    const Image settled = after(250);
    EXPECT_LT(relRmse(after(12), settled), 0.1);
    EXPECT_LT(relRmse(after(48), settled), 0.06);
}

// A box goes on in a corner, frame by frame. Each frame has rays of its own, and means far from it are of as many passes as
// in a still scene. A mean of four passes has 0.4 of the noise of one.
TEST_F(TracedNoiseTest, FarFromWhatMovesMeansAreLong) {
    Scene scene = io::generateScene("cornell-point");
    addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.5f)),
                glm::scale(glm::translate(glm::mat4(1), {0.3f, 0.06f, 0.3f}), glm::vec3(0.05f)));
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
    settings.traced.filterLevels = 0;
    Renderer renderer;
    renderer.setScene(scene);
    draw(renderer, scene, settings);  // settles the cache
    settings.traced.budgeted = true;
    const auto step = [&] {
        scene.instances.back().worldFromObject[3].x -= 0.01f;
        renderer.setInstance(scene.instances.size() - 1, scene.instances.back());
        return draw(renderer, scene, settings);
    };
    step();
    Image last;
    for (int frame = 0; frame < 12; ++frame) last = step();
    Settings rest = settings;
    rest.traced.budgeted = false;
    const Image one = [&] {
        rest.traced.passes = 1;
        return draw(scene, rest);
    }();
    rest.traced.passes = 256;
    const Image truth = draw(scene, rest);
    EXPECT_LT(relRmse(last, truth), 0.3 * relRmse(one, truth));
}

// Ten moving frames in which the last thing of a scene goes by `step` m each; the last one, and what it should show.
struct MovedPictures {
    Image moving, truth;
};
MovedPictures moveLast(Scene scene, Settings settings, const glm::vec3& step) {
    settings.traced.cacheUpdates = 32;  // of 16, faces that are too bright by chance hide what moved
    Renderer renderer;
    renderer.setScene(scene);
    const auto drawn = [&](Renderer& by) {
        by.render(scene.cameras.at(0), kPixels, kPixels, settings);
        return by.readImage();
    };
    drawn(renderer);
    settings.traced.budgeted = true;
    MovedPictures pictures;
    for (int frame = 0; frame < 10; ++frame) {
        scene.instances.back().worldFromObject[3] += glm::vec4(step, 0);
        renderer.setInstance(scene.instances.size() - 1, scene.instances.back());
        pictures.moving = drawn(renderer);
    }
    settings.traced.budgeted = false;
    settings.traced.passes = 32;
    Renderer other;
    other.setScene(scene);
    pictures.truth = drawn(other);
    return pictures;
}

// A thing moves over a floor of rough metal, which stands still and so keeps its means. The noise of one pass would be 1.
TEST_F(TracedNoiseTest, LobesKeepTheirMeansWhileThingsMove) {
    const MovedPictures pictures =
        moveLast(io::generateScene("glossy"), tracedSettings(Quality::Interactive, Component::Specular),
                 {-0.05f, 0, 0});
    EXPECT_LT(relRmse(pictures.moving, pictures.truth), 0.6);
}

// A bright ball rolls over a mirror that is not quite smooth: no trail stays behind it. Long means would be off by 0.4. Faces
// that are new may be thrice as bright by chance, where the mirror's light meets few rays: so the median of three ways counts.
TEST_F(TracedNoiseTest, LobesForgetWhatMovedInThem) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.1f)));
    Material steel = diffuseMaterial(glm::vec3(0.8f));
    steel.metallic = 1;
    steel.roughness = 0.15f;
    addInstance(scene, quadMesh({-0.95f, -0.95f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}), steel);
    scene.lights.push_back({.intensity = glm::vec3(1), .position = {0, 0.9f, 0.5f}});
    addInstance(scene, sphereMesh(24, 16), diffuseMaterial(glm::vec3(0.9f)),
                glm::scale(glm::translate(glm::mat4(1), {0.6f, -0.6f, -0.2f}), glm::vec3(0.2f)));
    std::vector<double> errors;
    for (const float step : {-0.064f, -0.062f, -0.06f}) {
        const MovedPictures pictures =
            moveLast(scene, tracedSettings(Quality::Interactive, Component::Specular), {step, 0, 0});
        errors.push_back(relRmse(pictures.moving, pictures.truth));
    }
    std::ranges::sort(errors);
    EXPECT_LT(errors[1], 0.3) << errors[0] << ", " << errors[2];
}

// A camera that moves over a still scene, frame by frame with reuse, ends up near a picture made at rest.
TEST_F(TracedNoiseTest, MovingCameraLeavesNoGhosts) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
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
TEST_F(TracedNoiseTest, FilterDoesNotCrossThinWalls) {
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
    Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    settings.traced.filterLevels = 0;
    const double plain = leak(draw(scene, settings));
    settings.traced.filterLevels = 3;
    const double filtered = leak(draw(scene, settings));
    EXPECT_LT(plain, 0.02);
    EXPECT_LT(filtered, plain + 0.005);
}

// Of the light that a metal floor and metal things send to walls few rays find much. It must arrive without
// speckles, pixels far brighter than those about them, and all of it.
TEST_F(TracedNoiseTest, MetalsThrowNoSpecklesOnWalls) {
    const Scene scene = io::generateScene("glossy");
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
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

// Pixels that are brighter than all of the truth about them, by this part of its mean.
int specksOf(const Image& image, const Image& truth, float part) {
    const auto at = [](const Image& of, int x, int y) {
        return of.pixels[static_cast<std::size_t>(y * of.width + x)].y;
    };
    const float least = part * static_cast<float>(meanOf(truth));
    int specks = 0;
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            float most = 0;
            for (int i = 0; i < 9; ++i) most = std::max(most, at(truth, x + i % 3 - 1, y + i / 3 - 1));
            specks += at(image, x, y) > most + least ? 1 : 0;
        }
    return specks;
}

// Few rays of a floor's lobe find the highlight of a ball: it is widened by what of the ball one of them stands for.
TEST_F(TracedNoiseTest, HighlightsOfBallsThrowNoSpecksOnFloors) {
    const Scene scene = io::generateScene("glossy");
    Settings settings = tracedSettings(Quality::Interactive, Component::Specular);
    settings.voxels.size = 128;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), 160, 120, settings);
    const Image image = renderer.readImage();
    settings.traced.passes *= 16;
    renderer.render(scene.cameras.front(), 160, 120, settings);
    EXPECT_LE(specksOf(image, renderer.readImage(), 0.2f), 100);
}

// A disk that is met aslant is an ellipse. If its long axis counted for both, lobes that few rays meet were blurred too much:
// this floor would show the lamp in the vase with 0.89 of its light, not 0.94.
TEST_F(TracedNoiseTest, FloorsShowHighlightsOfVases) {
    const Scene scene = io::generateScene("glossy");
    Camera camera = scene.cameras.front();
    camera.target = camera.eye + glm::vec3(0.0717f, -0.4843f, -0.8720f);
    camera.fovY = 0.052f;  // the highlight alone
    Settings settings = tracedSettings(Quality::Interactive, Component::Specular);
    settings.voxels.size = 128;
    settings.traced.filterLevels = 0;
    constexpr int kSize = 32;
    Renderer renderer;
    renderer.setScene(scene);
    const auto picture = [&](int passes) {
        settings.traced.passes = passes;
        renderer.render(camera, kSize, kSize, settings);
        return renderer.readImage();
    };
    const Image few = picture(16), many = picture(256);
    const double mean = meanOf(many);
    double ofFew = 0, ofMany = 0;
    for (std::size_t i = 0; i < many.pixels.size(); ++i) {
        if (static_cast<double>(many.pixels[i].y) < mean) continue;
        ofFew += static_cast<double>(few.pixels[i].y);
        ofMany += static_cast<double>(many.pixels[i].y);
    }
    EXPECT_GT(ofFew / ofMany, 0.92);
}

// A lamp far away whose edges lie between voxels. No part of its light is left to cosine-sampled rays
// alone: the few that meet it would each be a white dot.
TEST_F(TracedNoiseTest, FarLampsThrowNoDotsOnFloors) {
    const Scene scene = io::generateScene("tunnel");
    Settings settings = tracedSettings(Quality::Converged, Component::Diffuse);
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

// A bulb of less than a voxel above sheets of rough steel. Few rays of a lobe would find it, each a white dot: so some are
// aimed at it, also where rays meet triangles (the smoother sheet). All of its light arrives.
TEST_F(TracedNoiseTest, SmallLampsThrowNoDotsOnSteel) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.3f)));
    for (const float roughness : {0.3f, 0.5f}) {
        Material steel = diffuseMaterial(glm::vec3(0.6f));
        steel.metallic = 1;
        steel.roughness = roughness;
        addInstance(scene,
                    quadMesh({roughness < 0.4f ? -0.95f : 0.05f, -0.8f, 0.9f}, {0.9f, 0, 0}, {0, 0, -1.8f}),
                    steel);
    }
    addInstance(scene, sphereMesh(16, 12), diffuseMaterial(glm::vec3(0), glm::vec3(150)),
                glm::scale(glm::translate(glm::mat4(1), {0.02f, 0.55f, -0.4f}), glm::vec3(0.035f)));
    Settings settings = tracedSettings(Quality::Interactive, Component::Specular);
    settings.traced.filterLevels = 0;
    const Image image = draw(scene, settings);
    settings.traced.passes *= 32;
    const Image truth = draw(scene, settings);
    EXPECT_LT(relRmse(image, truth), 2.0);
    EXPECT_NEAR(meanOf(image) / meanOf(truth), 1.0, 0.03);
}

// A closed room with a lamp, in a house whose outside shines: most of all light is there. Few rays are wasted on it, wherever
// the cells of light samples come to lie, which is elsewhere after each update.
TEST_F(TracedNoiseTest, LightOutsideLeavesRoomsQuiet) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.6f)));
    addInstance(scene, sphereMesh(16, 12), diffuseMaterial(glm::vec3(0), glm::vec3(20)),
                glm::scale(glm::translate(glm::mat4(1), {0.2f, 0.5f, -0.4f}), glm::vec3(0.1f)));
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
    settings.voxels.size = 96;
    settings.traced.filterLevels = 0;
    settings.light.emissiveQuads = false;  // rays find all that shines
    for (const bool shines : {false, true}) {
        if (shines)
            addInstance(scene, boxMesh(), diffuseMaterial(glm::vec3(0.5f), glm::vec3(5)),
                        glm::scale(glm::mat4(1), glm::vec3(1.2f)));
        settings.traced.passes = 512;
        const Image truth = draw(scene, settings);
        settings.traced.passes = 16;
        for (const int updates : {32, 34, 36}) {
            settings.traced.cacheUpdates = updates;
            const Image image = draw(scene, settings);
            EXPECT_LT(relRmse(image, truth), 0.35) << updates << (shines ? ", with its outside" : ", alone");
            EXPECT_NEAR(meanOf(image) / meanOf(truth), 1.0, 0.02) << updates;
        }
    }
}

// A room lit by one lamp that rays must find: where few did, a pixel is darker than all about it, and the
// filter must share nonetheless.
TEST_F(TracedNoiseTest, FewRaysLeaveNoDarkDots) {
    const Image image =
        draw(io::generateScene("lobby"), tracedSettings(Quality::Interactive, Component::Diffuse));
    EXPECT_LE(
        dotsIn(image, [](float own,
                         const std::array<float, 9>& around) { return own > 0 && own < 0.8f * around[1]; }),
        2);
}

// A room lit by small lamps alone, noisy, and how much differs from place to place: a filter whose tolerance
// does not depend on it is 16 % off.
TEST_F(TracedNoiseTest, FilterKnowsHowMuchNoiseThereIs) {
    const Scene scene = io::generateScene("lounge");
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
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
    settings.traced.passes = 256;
    const Image truth = picture();
    EXPECT_LT(relRmse(filtered, truth), 0.145);
    EXPECT_GT(relRmse(plain, truth), 0.3);
    EXPECT_NEAR(meanOf(filtered) / meanOf(truth), 1.0, 0.02);
}

}  // namespace
}  // namespace conelight::test
