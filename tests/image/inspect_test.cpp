// SPDX-License-Identifier: MIT
// Renderer::inspectPixel against the picture that it explains: paths with their weights add up to what was
// gathered, what was gathered is the picture's pixel; steps add up to their path; rays end at the walls.
#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "io/generated.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 40;
const glm::ivec2 kPlaces[] = {{20, 36}, {3, 20}, {20, 4}, {13, 24}};

Settings settingsOf(Mode mode, Component component) {
    Settings settings;
    settings.mode = mode;
    settings.component = component;
    settings.voxels.size = 32;
    settings.light.shadowSize = 128;
    settings.light.areaSamples = 4;
    settings.cones.bounces = 1;
    settings.traced.passes = 4;
    settings.traced.filterLevels = 0;  // the filter mixes pixels; an inspection is one pixel's
    settings.traced.cacheUpdates = 6;
    return settings;
}

// Diffuse and glossy surfaces, direct light, red and green walls.
Scene roomWithGloss() {
    Scene scene = closedBox(diffuseMaterial({0.7f, 0.6f, 0.5f}));
    Material gloss;
    gloss.baseColor = {0.8f, 0.7f, 0.3f, 1};
    gloss.metallic = 0.5f;
    gloss.roughness = 0.3f;
    scene.materials.push_back(gloss);
    scene.instances[2].material = static_cast<int>(scene.materials.size()) - 1;  // the floor
    Light light;
    light.type = LightType::Point;
    light.position = {0.3f, 0.6f, -0.2f};
    light.intensity = glm::vec3(2);
    scene.lights.push_back(light);
    return scene;
}

glm::vec3 sumOf(const PixelInspection& pixel, PathPart part) {
    glm::vec3 sum(0);
    for (const InspectedPath& path : pixel.paths)
        if (partOf(path.kind) == part) sum += path.weight * path.radiance;
    return sum;
}

// Relative to the largest channel.
void expectClose(const glm::vec3& a, const glm::vec3& b, float tolerance, const char* what) {
    const float scale = std::max({b.x, b.y, b.z, 1e-3f});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / scale, b[c] / scale, tolerance) << what << " " << c;
}

class InspectTest : public GlTest {
  protected:
    // Paths -> value -> picture, at several pixels. `tolerance`: rounding of the pictures between.
    static void expectExplained(const Scene& scene, const Settings& settings, float tolerance) {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        const Image before = renderer.readImage();
        bool anyPath = false;
        for (const glm::ivec2& place : kPlaces) {
            SCOPED_TRACE(testing::Message() << place.x << "," << place.y);
            const PixelInspection pixel = renderer.inspectPixel(place.x, place.y);
            EXPECT_TRUE(pixel.seen);
            EXPECT_TRUE(pixel.complete);
            EXPECT_EQ(pixel.picture, before.pixels[static_cast<std::size_t>(place.y * kPixels + place.x)]);
            anyPath = anyPath || !pixel.paths.empty();
            expectClose(sumOf(pixel, PathPart::Diffuse), pixel.diffuse.value, 1e-4f, "diffuse paths");
            bool ownLobe = false;
            for (const InspectedPath& path : pixel.paths)
                ownLobe = ownLobe || partOf(path.kind) == PathPart::Specular;
            if (ownLobe)
                expectClose(sumOf(pixel, PathPart::Specular), pixel.specular.value, 1e-4f, "specular paths");
            expectClose(pixel.diffuse.shown() + pixel.specular.shown(), glm::vec3(pixel.picture), tolerance,
                        "picture");
        }
        EXPECT_TRUE(anyPath);
        EXPECT_EQ(renderer.readImage().pixels, before.pixels);  // looking changes nothing
    }
};

TEST_F(InspectTest, ConesAddUpToThePicture) {
    for (const VolumeDirections directions : {VolumeDirections::Six, VolumeDirections::Isotropic}) {
        Settings settings = settingsOf(Mode::Cones, Component::Indirect);
        settings.cones.directional = directions;
        expectExplained(roomWithGloss(), settings, 2e-3f);  // gathered pictures are halves
    }
}

TEST_F(InspectTest, RaysAddUpToThePicture) {
    expectExplained(roomWithGloss(), settingsOf(Mode::Traced, Component::Indirect),
                    4e-3f);  // halves, 4 means
}

TEST_F(InspectTest, FacesOfTheCacheAddUpToThePicture) {
    Settings settings = settingsOf(Mode::Traced, Component::Diffuse);
    settings.traced.pixelRays = 0;
    Renderer renderer;
    const Scene scene = roomWithGloss();
    renderer.setScene(scene);
    renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
    const PixelInspection pixel = renderer.inspectPixel(3, 20);
    ASSERT_FALSE(pixel.paths.empty());
    for (const InspectedPath& path : pixel.paths) {
        if (path.kind != PathKind::CacheFace) continue;
        ASSERT_TRUE(path.face);
        EXPECT_GE(path.face->updates, 4);         // 6, rounded down to a power of two
        EXPECT_LT(path.distance, 2 * 2.2f / 32);  // one of the eight voxels about the point
    }
    expectClose(sumOf(pixel, PathPart::Diffuse), pixel.diffuse.value, 1e-4f, "faces");
    expectClose(pixel.diffuse.shown(), glm::vec3(pixel.picture), 1e-4f, "picture");
}

TEST_F(InspectTest, ThesisConesAddUpToThePicture) {
    for (const bool published : {false, true}) {
        Scene scene = roomWithGloss();
        for (Material& material : scene.materials) setPbrFromPhong(material, PhongMaterial{});
        Settings settings = settingsOf(thesis::kMode, Component::Indirect);
        settings.groups.of<thesis::ThesisSettings>().published = published;
        expectExplained(scene, settings, 1e-4f);
    }
}

TEST_F(InspectTest, OcclusionAddsUpInEveryMode) {
    for (const Mode mode : {Mode::Cones, Mode::Traced, thesis::kMode}) {
        Settings settings = settingsOf(mode, Component::Occlusion);
        settings.traced.filterLevels = 1;
        Renderer renderer;
        const Scene scene = roomWithGloss();
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        const PixelInspection pixel = renderer.inspectPixel(20, 36);
        ASSERT_TRUE(pixel.occlusion.used) << mode.name();
        expectClose(sumOf(pixel, PathPart::Occlusion), pixel.occlusion.value, 1e-4f, "paths");
        // The traced picture is filtered over its neighbours.
        expectClose(pixel.occlusion.value, glm::vec3(pixel.picture), mode == Mode::Traced ? 0.1f : 2e-3f,
                    "picture");
    }
}

TEST_F(InspectTest, StepsAddUpToTheirCone) {
    for (const Mode mode : {Mode::Cones, thesis::kMode}) {
        Renderer renderer;
        const Scene scene = roomWithGloss();  // its sky is black
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settingsOf(mode, Component::Full));
        const PixelInspection pixel = renderer.inspectPixel(3, 20);
        int cones = 0;
        for (const InspectedPath& path : pixel.paths) {
            if (path.kind != PathKind::DiffuseCone) continue;
            ++cones;
            ASSERT_GT(path.steps.size(), 2u);
            glm::vec3 radiance(0);
            float opacity = 0, last = -1;
            for (const InspectedStep& step : path.steps) {
                radiance += step.radiance;
                opacity += step.opacity;
                EXPECT_GT(step.distance, last);
                last = step.distance;
                EXPECT_NEAR(glm::length(step.position - path.origin), step.distance, 1e-4f);
                EXPECT_NEAR(step.total, opacity, 1e-4f);
            }
            EXPECT_LE(opacity, 1.0f + 1e-4f);
            // A full cone of mode cones is divided by its opacity.
            if (path.end == PathEnd::Full && mode == Mode::Cones) radiance /= opacity;
            expectClose(radiance, path.radiance, 1e-3f, "steps");
        }
        EXPECT_EQ(cones, mode == Mode::Cones ? 6 : 5);
    }
}

// From a wall of a box of edge 2 every ray meets another wall, at the distance that the box says.
TEST_F(InspectTest, RaysEndAtTheWalls) {
    Renderer renderer;
    const Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    renderer.setScene(scene);
    renderer.render(scene.cameras.at(0), kPixels, kPixels, settingsOf(Mode::Traced, Component::Full));
    const PixelInspection pixel = renderer.inspectPixel(20, 20);
    int rays = 0;
    for (const InspectedPath& path : pixel.paths) {
        if (path.kind != PathKind::CosineRay || path.end == PathEnd::Unused) continue;
        ++rays;
        ASSERT_EQ(path.end, PathEnd::Face);
        glm::vec3 toWall(1e9f);
        for (int axis = 0; axis < 3; ++axis)
            if (std::fabs(path.direction[axis]) > 1e-6f)
                toWall[axis] =
                    ((path.direction[axis] > 0 ? 1.0f : -1.0f) - path.origin[axis]) / path.direction[axis];
        EXPECT_NEAR(path.distance, std::min({toWall.x, toWall.y, toWall.z}), 0.02f);
        ASSERT_TRUE(path.face);
        EXPECT_LT(glm::dot(path.face->normal, path.direction), 0);
        EXPECT_NEAR(path.face->albedo.x, 0.5f, 0.01f);
        EXPECT_GT(path.face->updates, 0);
        ASSERT_GE(path.steps.size(), 2u);
        EXPECT_EQ(path.steps.back().kind, StepKind::Hit);
        EXPECT_NEAR(path.steps.back().distance, path.distance, 1e-4f);
        EXPECT_NE(path.steps.front().kind, StepKind::Hit);
    }
    EXPECT_GE(rays, 4);
}

// Metal gathers no diffuse light, so no such rays are told.
TEST_F(InspectTest, MetalsHaveRaysIntoTheirLobeAlone) {
    Renderer renderer;
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f), glm::vec3(1)));
    for (Material& material : scene.materials) {
        material.metallic = 1;
        material.roughness = 0.3f;
    }
    renderer.setScene(scene);
    renderer.render(scene.cameras.at(0), kPixels, kPixels, settingsOf(Mode::Traced, Component::Full));
    const PixelInspection pixel = renderer.inspectPixel(20, 20);
    int intoLobe = 0;
    for (const InspectedPath& path : pixel.paths) {
        EXPECT_NE(path.kind, PathKind::CosineRay);
        EXPECT_NE(path.kind, PathKind::LightRay);
        intoLobe += path.kind == PathKind::SpecularRay ? 1 : 0;
    }
    EXPECT_GE(intoLobe, 4);
}

TEST_F(InspectTest, OtherComponentsAndModesAnswerToo) {
    const Scene scene = roomWithGloss();
    Renderer renderer;
    EXPECT_THROW(renderer.inspectPixel(0, 0), Error);
    renderer.setScene(scene);
    for (const Component component : {Component::Albedo, Component::Voxels, Component::ShadowMap}) {
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settingsOf(Mode::Cones, component));
        const Image before = renderer.readImage();
        EXPECT_FALSE(renderer.inspectPixel(20, 20).paths.empty());
        EXPECT_EQ(renderer.readImage().pixels, before.pixels);
    }
    renderer.render(scene.cameras.at(0), kPixels, kPixels, settingsOf(Mode::Phong, Component::Full));
    EXPECT_TRUE(renderer.inspectPixel(20, 20).paths.empty());
    EXPECT_THROW(renderer.inspectPixel(kPixels, 0), Error);
    EXPECT_THROW(renderer.inspectPixel(0, -1), Error);
}

}  // namespace
}  // namespace conelight::test
