// SPDX-License-Identifier: MIT
// Parallel rays on the CPU: beams and textures against the path tracer, and how a camera goes from one projection to the
// other, nearer, round, along the axes and along a path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cpu/io_test_support.h"
#include "io/generated.h"
#include "reference/beam_tracer.h"
#include "reference/path_tracer.h"
#include "reference/sampler.h"
#include "session/camera_path.h"
#include "session/inspection_lines.h"
#include "session/projection.h"
#include "session/silhouette.h"
#include "support/truth_rig.h"
#include "viewer/camera_control.h"

namespace conelight::test {
namespace {

using namespace reference;

Camera parallel(const glm::vec3& eye, const glm::vec3& target, float height) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.orthographicHeight = height;
    return camera;
}

TEST(Orthographic, BeamsEqualThePathTracer) {
    Scene scene = io::generateScene("mirror-hall");
    Camera& camera = scene.cameras.at(0);
    camera.orthographicHeight = 0.6f * camera.heightAt(glm::distance(camera.eye, camera.target));
    PathTracerSettings settings;
    settings.paths = Paths::Mirrors;
    settings.samplesPerPixel = 128;
    const PathTracedPicture truth = PathTracer(scene).render(camera, 48, 36, settings);
    BeamSettings beams;
    beams.filter = PixelFilter::Center;
    const BeamPicture drawn = traceBeams(scene, camera, 48, 36, beams);
    EXPECT_GT(drawn.stats.beams, 5u);
    EXPECT_GT(meanOf(drawn.direct), 0);
    EXPECT_GT(meanOf(drawn.mirrored), 0);
    EXPECT_LT(relRmse(drawn.direct, truth.direct), 0.001);
    EXPECT_LT(relRmse(drawn.full, truth.full), 0.01);
}

// A pixel covers two texels of noise and a half: its mean, whichever the filter.
TEST(Orthographic, TexturesAreTheirMeanOverAPixel) {
    Scene scene;
    Texture noise;
    noise.width = noise.height = 64;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
        const auto grey = static_cast<std::uint8_t>(mixBits(i + 1) >> 24);
        noise.rgba.insert(noise.rgba.end(), {grey, grey, grey, 255});
    }
    scene.textures.push_back(noise);
    Material material = diffuseMaterial();
    material.baseColorTexture.texture = 0;
    Mesh floor = quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    floor.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    addInstance(scene, floor, material);
    Light sun;
    sun.type = LightType::Directional;
    scene.lights.push_back(sun);
    const auto picture = [&](PixelFilter filter) {
        PathTracerSettings settings;
        settings.samplesPerPixel = 1024;
        settings.bounces = 0;
        settings.filter = filter;
        return PathTracer(scene).render(parallel({0.2f, 2, 0.3f}, {0, 0, 0}, 1.2f), 16, 16, settings).full;
    };
    EXPECT_LT(relRmse(picture(PixelFilter::Center), picture(PixelFilter::Box)), 0.02);
}

TEST(Orthographic, AProjectionInPlaceOfTheOtherKeepsWhatIsAtTheTarget) {
    Camera camera;
    camera.eye = {2, 3, 4};
    camera.target = {0.5f, 1, -1};
    camera.fovY = 0.6f;
    const Camera before = camera;
    const glm::vec3 up(cameraAxes(camera).up), top = camera.target + 0.7f * up;
    const auto place = program::pictureOf(camera, 1.5f, top);
    program::switchProjection(camera);
    EXPECT_TRUE(camera.isOrthographic());
    EXPECT_EQ(camera.eye, before.eye);
    EXPECT_NEAR(glm::distance(*program::pictureOf(camera, 1.5f, top), *place), 0, 1e-5f);
    program::dolly(camera, 0.5f);
    EXPECT_EQ(camera.eye, before.eye) << "nothing is cut off before the target";
    EXPECT_NEAR(2 * (0.5f - place->y), 0.5f - program::pictureOf(camera, 1.5f, top)->y, 1e-5f);
    program::switchProjection(camera);
    EXPECT_FALSE(camera.isOrthographic());
    EXPECT_NEAR(glm::distance(camera.eye, camera.target), 0.5f * glm::distance(before.eye, before.target),
                1e-4f);
    EXPECT_NEAR(2 * (0.5f - place->y), 0.5f - program::pictureOf(camera, 1.5f, top)->y, 1e-5f);
    // Farther away the eye steps back with what is seen.
    program::switchProjection(camera);
    program::dolly(camera, 8);
    EXPECT_NEAR(glm::distance(camera.eye, camera.target), 4 * glm::distance(before.eye, before.target),
                1e-3f);
}

TEST(Orthographic, RaysMeetThePointsThatThePictureHasThere) {
    const Camera camera = parallel({2, 3, 4}, {0.5f, 1, -1}, 3);
    for (const glm::vec3 point : {glm::vec3(0, 0, 0), {1, -2, 0.5f}, {0.2f, 1.7f, -3}}) {
        const auto part = program::pictureOf(camera, 1.5f, point);
        ASSERT_TRUE(part);
        const glm::vec2 ndc(2 * part->x - 1, 1 - 2 * part->y);
        for (const program::ViewRay& ray :
             {program::viewRay(camera, 1.5f, ndc), program::viewRayTo(camera, point)}) {
            const glm::vec3 to = point - ray.origin;
            EXPECT_NEAR(glm::length(to - glm::dot(to, ray.direction) * ray.direction), 0, 1e-5f);
        }
    }
    EXPECT_FALSE(program::pictureOf(camera, 1.5f, {4, 6, 9})) << "behind the eye";
}

// A square is as large near and far, and the nearer one hides the other.
TEST(Orthographic, OutlinesDoNotShrinkWithTheDistance) {
    Scene scene;
    addInstance(scene, quadMesh({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}), Material{});
    addInstance(scene, quadMesh({-0.5f, -0.5f, -5}, {1, 0, 0}, {0, 1, 0}), Material{});
    const Camera camera = parallel({0, 0, 2}, {0, 0, 0}, 2);
    for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1}, {1, 0}}) {
        const program::Silhouette shape = program::silhouetteOf(scene, order, camera, 40, 40);
        const std::uint32_t nearer = order[0] == 0 ? 1 : 2;
        // And a pixel for a corner.
        EXPECT_NEAR(static_cast<double>(std::count(shape.object.begin(), shape.object.end(), nearer)), 400,
                    2);
        EXPECT_NEAR(static_cast<double>(std::count(shape.object.begin(), shape.object.end(), 0u)), 1200, 2);
    }
}

// From straight above the picture turns on from where it is.
TEST(Orthographic, AViewFromStraightAboveTurnsFromThere) {
    for (const float side : {-1.0f, 1.0f}) {
        Camera camera = parallel({0, -3 * side, 0}, {0, 0, 0}, 2);
        camera.up = {0, 0, side};
        const glm::vec3 right(cameraAxes(camera).right);
        program::orbit(camera, {0, side * -0.01f});
        EXPECT_GT(glm::dot(glm::vec3(cameraAxes(camera).right), right), 0.99f) << side;
        EXPECT_NEAR(glm::length(camera.eye), 3, 1e-4f);
    }
}

TEST(Orthographic, PathsGoByTheLogarithmOfTheHeight) {
    program::CameraPath path;
    path.add(0, parallel({0, 0, 5}, {0, 0, 0}, 1));
    path.add(2, parallel({0, 0, 5}, {0, 0, 0}, 4));
    EXPECT_NEAR(path.at(1).orthographicHeight, 2, 1e-4f);
    Camera perspective;
    perspective.eye = {0, 0, 5};
    path.add(4, perspective);
    EXPECT_EQ(path.at(2).orthographicHeight, 4);
    EXPECT_EQ(path.at(3).orthographicHeight, 0);
    const std::string file = (folderOf("orthographic") / "path.json").string();
    program::writeCameraPath(file, path, true);
    const program::CameraPath read = program::readCameraPath(file);
    ASSERT_EQ(read.keys().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(read.keys()[i].camera.orthographicHeight, path.keys()[i].camera.orthographicHeight);
}

}  // namespace
}  // namespace conelight::test
