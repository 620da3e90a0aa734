// SPDX-License-Identifier: MIT
// What is added to scenes that lack it: a camera that they fill, light in a studio or under a ceiling, a ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/scene.h"
#include "conelight/studio.h"
#include "io/environment_file.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

Scene box() {
    Scene scene;
    addInstance(scene, boxMesh(), diffuseMaterial());
    return scene;
}

// Largest part of the picture's half that the visible triangles above `least` reach, across and upwards.
glm::vec2 reachOf(const Scene& scene, const Camera& camera, float least) {
    const glm::mat4 clip = glm::perspective(camera.fovY, 1.0f, camera.zNear, camera.zFar) *
                           glm::lookAt(camera.eye, camera.target, camera.up);
    glm::vec2 reach(0);
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
            const glm::vec4 world = instance.worldFromObject * glm::vec4(position, 1);
            const glm::vec4 p = clip * world;
            if (world.y > least) reach = glm::max(reach, glm::abs(glm::vec2(p)) / p.w);
        }
    return reach;
}

bool hasGround(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [](const Instance& one) { return one.name == kStudioGroundName; });
}

}  // namespace

TEST(CompletionTest, CompletedScenesCanBeSeen) {
    Scene scene = box();
    scene.lights.emplace_back();
    completeScene(scene);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.notes.size(), 1u);
    // Nothing more the second time.
    completeScene(scene);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.notes.size(), 1u);
    // A light that is off or dark is none.
    for (const bool dark : {true, false}) {
        scene = box();
        scene.lights.emplace_back().enabled = dark;
        if (dark) scene.lights[0].intensity = glm::vec3(0);
        if (!dark) scene.lights[0].enabled = false;
        completeScene(scene);
        EXPECT_EQ(scene.lights.size(), 2u);
        EXPECT_TRUE(hasGround(scene));
        EXPECT_NO_THROW(scene.validate());
    }
    Scene empty;
    completeScene(empty);
    EXPECT_EQ(empty.cameras.size(), 1u);
    EXPECT_TRUE(empty.lights.empty());
    EXPECT_TRUE(empty.instances.empty());
}

// It is made once, and renderers know it again.
TEST(CompletionTest, ScenesShareTheStudiosPicture) {
    Scene one = box(), other = box();
    other.cameras.emplace_back();
    other.cameras[0].eye = {3, 1, 0};
    completeScene(one);
    completeScene(other);
    EXPECT_EQ(one.environment.image, other.environment.image);
    EXPECT_NE(one.environment.rotation, other.environment.rotation);
}

TEST(CompletionTest, SkyOrEmissionAreLightEnough) {
    for (const bool sky : {true, false}) {
        Scene scene = box();
        if (sky)
            scene.sky = glm::vec3(0.1f);
        else
            scene.materials[0].emission = glm::vec3(0, 1, 0);
        completeScene(scene);
        EXPECT_TRUE(scene.lights.empty());
        EXPECT_FALSE(hasGround(scene));
    }
    // A texture that glows in a few places only is no lamp; one that glows all over is.
    for (const std::uint8_t level : {std::uint8_t{5}, std::uint8_t{200}}) {
        Scene scene = box();
        scene.materials[0].emission = glm::vec3(1);
        scene.materials[0].emissiveTexture.texture = static_cast<int>(scene.textures.size());
        Texture marks;
        marks.width = marks.height = 1;
        marks.rgba = {level, level, level, 255};
        scene.textures.push_back(marks);
        completeScene(scene);
        EXPECT_EQ(scene.lights.size(), level < 64 ? 1u : 0u);
    }
}

// Where nothing stands on it, the ground reflects what the surroundings below the horizon are: its rim is not seen. A
// white surface that faces the lamp gets bright, but not more than a display shows.
TEST(CompletionTest, TheGroundIsAsBrightAsTheSurroundings) {
    Scene scene = box();
    completeScene(scene);
    const Light& lamp = scene.lights.at(0);
    ASSERT_EQ(lamp.type, LightType::Rect);
    // Its solid angle, seen from the ground: area over squared distance, within a few percent for a lamp so small.
    const float distance = glm::distance(lamp.position, scene.bounds().center());
    const float area = 4 * glm::length(glm::cross(lamp.halfU, lamp.halfV));
    const float lampOnFacing = lamp.intensity.g * area / (distance * distance);
    ASSERT_TRUE(scene.environment.used());
    const EnvironmentImage& image = *scene.environment.image;
    double fromAbove = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 d = environmentDirection(
                {(float(x) + 0.5f) / float(image.width), (float(y) + 0.5f) / float(image.height)});
            const float cell =
                2 * glm::pi<float>() / float(image.width) * glm::pi<float>() / float(image.height);
            if (d.y > 0)
                fromAbove +=
                    static_cast<double>(image.radiance[static_cast<std::size_t>(y * image.width + x)].g *
                                        d.y * cell * std::sqrt(1 - d.y * d.y));
        }
    const Material& ground = scene.materials.back();
    EXPECT_EQ(ground.name, kStudioGroundName);
    const double lit = fromAbove - static_cast<double>(lampOnFacing * lamp.direction.y);
    const double reflected =
        static_cast<double>(ground.baseColor.g) / static_cast<double>(glm::pi<float>()) * lit;
    EXPECT_NEAR(reflected / static_cast<double>(image.radiance.back().g), 1, 0.04);
    EXPECT_GT(lampOnFacing / glm::pi<float>(), 0.6f);
    EXPECT_LT((lampOnFacing + static_cast<float>(fromAbove)) / glm::pi<float>(), 1.0f);
    // Whoever reads the file's name gets the same picture.
    EXPECT_EQ(io::loadEnvironment(scene.environment.file).environment.image->radiance, image.radiance);
}

TEST(CompletionTest, TheLampStandsBesideTheEyeAndAboveIt) {
    for (const float turn : {0.0f, 1.0f, 4.0f}) {
        Scene scene = box();
        Camera& camera = scene.cameras.emplace_back();
        camera.eye = {3 * std::sin(turn), 1, 3 * std::cos(turn)};
        completeScene(scene);
        const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(ahead, camera.up));
        const glm::vec3& along = scene.lights.at(0).direction;
        EXPECT_NEAR(glm::length(along), 1.0f, 1e-5f);
        EXPECT_GT(glm::dot(along, ahead), 0.3f);
        EXPECT_GT(glm::dot(along, right), 0.2f);
        EXPECT_LT(along.y, -0.7f);
        // What the picture's middle was before the turn is ahead.
        const float heading = scene.environment.rotation;
        EXPECT_NEAR(-std::sin(heading), glm::normalize(glm::vec2(ahead.x, ahead.z)).x, 1e-4f);
        EXPECT_NEAR(-std::cos(heading), glm::normalize(glm::vec2(ahead.x, ahead.z)).y, 1e-4f);
    }
}

TEST(CompletionTest, WhatIsAddedSuitsTheShape) {
    // A room that is closed gets its light within and no ground: its box, turned inside out.
    Scene scene = box(), room = scene;
    for (std::size_t i = 0; i < room.meshes.back().indices.size(); i += 3)
        std::swap(room.meshes.back().indices[i], room.meshes.back().indices[i + 1]);
    const Aabb bounds = scene.bounds();
    completeScene(scene);
    completeScene(room);
    ASSERT_EQ(scene.lights.size(), 1u);
    ASSERT_EQ(room.lights.size(), 2u);
    EXPECT_EQ(room.lights[1].type, LightType::Point);
    EXPECT_LT(glm::length(room.lights[1].position), 1);
    EXPECT_FALSE(hasGround(room));
    // The ground lies below the lowest point, beside it.
    const float ground = scene.bounds().min.y;
    EXPECT_LT(ground, bounds.min.y);
    EXPECT_GT(ground, bounds.min.y - 0.01f * bounds.extent().y);
    EXPECT_GT(scene.bounds().extent().x, 1.4f * bounds.extent().x);
    // Who asks for none has none, and is told.
    Scene bare = box();
    completeScene(bare, {.ground = false});
    EXPECT_FALSE(hasGround(bare));
    EXPECT_NE(scene.notes.back().find("ground"), std::string::npos);
    EXPECT_EQ(bare.notes.back().find("ground"), std::string::npos);
    // A floor of its own is ground enough.
    Scene floored = box();
    addInstance(floored, quadMesh({0, -1, 0}, {0, 0, 3}, {3, 0, 0}), diffuseMaterial());
    completeScene(floored);
    EXPECT_FALSE(hasGround(floored));
    EXPECT_EQ(floored.lights.size(), 1u);
    // A sheet is seen from the side that it faces.
    for (const float turned : {1.0f, -1.0f}) {
        Scene sheet;
        addInstance(sheet, quadMesh({0, 0, 0}, {turned, 0, 0}, {0, 1, 0}), diffuseMaterial());
        completeScene(sheet);
        EXPECT_GT(turned * sheet.cameras.at(0).eye.z, 0.5f);
    }
    // From below no ground is in the way, and the lamp is there too.
    Scene ceiling;
    addInstance(ceiling, quadMesh({0, 0, 0}, {1, 0, 0}, {0, 0, 1}), diffuseMaterial());
    completeScene(ceiling);
    ASSERT_LT(ceiling.cameras.at(0).eye.y, 0);
    EXPECT_FALSE(hasGround(ceiling));
    EXPECT_GT(ceiling.lights.at(0).direction.y, 0);
}

TEST(CompletionTest, ScenesFillThePicture) {
    // A rod askew, far from the origin: its bounds are much larger than what is seen of it.
    Scene rod;
    addInstance(rod, boxMesh(), diffuseMaterial());
    rod.instances[0].worldFromObject = glm::translate(glm::mat4(1), glm::vec3(50, 20, -30)) *
                                       glm::rotate(glm::mat4(1), 0.8f, glm::vec3(0, 0, 1)) *
                                       glm::scale(glm::mat4(1), glm::vec3(2, 0.1f, 0.1f));
    // Walls on a wide ground: the walls are what is looked at.
    Scene hut = box();
    addInstance(hut, quadMesh({0, -1, 0}, {0, 0, 40}, {40, 0, 0}), diffuseMaterial());
    for (Scene* scene : {&rod, &hut}) {
        completeScene(*scene, {.ground = false});
        const glm::vec2 reach = reachOf(*scene, scene->cameras.at(0), -0.5f);
        EXPECT_LT(std::max(reach.x, reach.y), 0.95f);
        EXPECT_GT(std::max(reach.x, reach.y), 0.8f);
    }
}

}  // namespace conelight::test
