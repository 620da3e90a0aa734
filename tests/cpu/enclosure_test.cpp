// SPDX-License-Identifier: MIT
// First pictures of rooms: from inside, where there is light; of stages, through the side that is missing; things are
// framed from outside.
#include <gtest/gtest.h>

#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "conelight/scene.h"
#include "io/generated.h"
#include "reference/path_tracer.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

glm::mat4 placed(const glm::vec3& at, const glm::vec3& half) {
    return glm::scale(glm::translate(glm::mat4(1), at), half);
}

// A room of 5 x 3 x 4 m within walls, floor and ceiling, which are boxes, without a camera; the walls that are named by
// bits are missing: 1 at +x, 2 at -x, 4 at +z, 8 at -z.
Scene room(int missing = 0) {
    Scene scene;
    const Material grey = diffuseMaterial(glm::vec3(0.6f));
    addInstance(scene, boxMesh(), grey, placed({0, -0.1f, 0}, {2.7f, 0.1f, 2.2f}));
    addInstance(scene, boxMesh(), grey, placed({0, 3.1f, 0}, {2.7f, 0.1f, 2.2f}));
    for (int side = 0; side < 4; ++side) {
        const float s = side % 2 == 0 ? 1.0f : -1.0f;
        if ((missing & (1 << side)) != 0) continue;
        addInstance(scene, boxMesh(), grey,
                    side < 2 ? placed({2.6f * s, 1.5f, 0}, {0.1f, 1.5f, 2.2f})
                             : placed({0, 1.5f, 2.1f * s}, {2.7f, 1.5f, 0.1f}));
    }
    return scene;
}

// On a table in a corner.
void furnish(Scene& scene) {
    const Material red = diffuseMaterial({0.7f, 0.1f, 0.1f});
    addInstance(scene, boxMesh(), red, placed({1.6f, 0.7f, -1.2f}, {0.6f, 0.04f, 0.4f}));
    for (int i = 0; i < 6; ++i)
        addInstance(scene, sphereMesh(16, 8), red,
                    placed({1.2f + 0.15f * static_cast<float>(i), 0.9f, -1.2f}, glm::vec3(0.1f)));
}

void addLamp(Scene& scene, const glm::vec3& at) {
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = at;
    lamp.intensity = glm::vec3(5);
    scene.lights.push_back(lamp);
}

bool isIn(const glm::vec3& p, const glm::vec3& low, const glm::vec3& high) {
    return glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high));
}

bool isInRoom(const Camera& camera) { return isIn(camera.eye, {-2.5f, 0, -2}, {2.5f, 3, 2}); }

float brightness(const Scene& scene) {
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 16;
    settings.filter = reference::PixelFilter::Center;
    const Image picture = reference::PathTracer(scene).render(scene.cameras.front(), 16, 12, settings).full;
    float sum = 0;
    for (const glm::vec4& pixel : picture.pixels) sum += pixel.g;
    return sum / static_cast<float>(picture.pixels.size());
}

}  // namespace

TEST(EnclosureTest, RoomsWithALampAreSeenFromInside) {
    Scene scene = room();
    addLamp(scene, {0, 2.7f, 0});
    completeScene(scene);
    const Camera& camera = scene.cameras.at(0);
    EXPECT_TRUE(isInRoom(camera));
    EXPECT_GT(camera.eye.y, 1.2f);
    EXPECT_LT(camera.eye.y, 2.1f);
    EXPECT_EQ(scene.lights.size(), 1u);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("in its room"), std::string::npos);
    // From a corner or a wall, to the other side.
    EXPECT_GT(glm::distance(camera.eye, camera.target), 2.5f);
}

// What has no lamp gets one, in the room.
TEST(EnclosureTest, FurnishedRoomsWithoutLightGetALampInside) {
    Scene scene = room();
    furnish(scene);
    completeScene(scene);
    EXPECT_TRUE(isInRoom(scene.cameras.at(0)));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[1].name, "room light");
    EXPECT_TRUE(isIn(scene.lights[1].position, {-1, 2, -1}, {1, 3, 1}));
    EXPECT_GT(brightness(scene), 0.05f);
}

// Without anything in it and without light, a room is a box.
TEST(EnclosureTest, ThingsAreFramedFromOutside) {
    Scene shell, box = room(), lit = room(), lantern;
    for (const float radius : {1.0f, 0.98f})
        addInstance(shell, sphereMesh(32, 16), {}, placed({}, glm::vec3(radius)));
    addLamp(lit, {0, 6, 0});
    // A bulb in a glass.
    Material glass;
    glass.transmission = 1;
    addInstance(lantern, sphereMesh(32, 16), glass);
    addInstance(lantern, sphereMesh(16, 8), diffuseMaterial({}, glm::vec3(9)), placed({}, glm::vec3(0.1f)));
    for (Scene* scene : {&shell, &box, &lit, &lantern}) {
        completeScene(*scene);
        const Aabb bounds = scene->bounds();
        EXPECT_EQ(scene->cameras.at(0).name, "framed");
        EXPECT_FALSE(isIn(scene->cameras[0].eye, bounds.min, bounds.max));
    }
}

TEST(EnclosureTest, StagesAreSeenThroughTheSideThatIsMissing) {
    const glm::vec3 sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int side = 0; side < 4; ++side) {
        Scene scene = room(1 << side);
        addLamp(scene, {0, 2.7f, 0});
        completeScene(scene);
        const Camera& camera = scene.cameras.at(0);
        EXPECT_FALSE(isInRoom(camera)) << side;
        EXPECT_GT(glm::dot(glm::normalize(camera.eye - camera.target), sides[side]), 0.95f) << side;
    }
}

// Two rooms side by side: the lit one is seen, whichever it is.
TEST(EnclosureTest, OfSeveralRoomsTheLitOneIsSeen) {
    for (const float lit : {-1.0f, 1.0f}) {
        Scene scene = room();
        addInstance(scene, boxMesh(), {}, placed({0, 1.5f, 0}, {0.1f, 1.5f, 2}));
        addLamp(scene, {1.2f * lit, 2.5f, 0});
        completeScene(scene);
        EXPECT_TRUE(isInRoom(scene.cameras.at(0)));
        EXPECT_GT(scene.cameras[0].eye.x * lit, 0);
        EXPECT_GT(brightness(scene), 0.05f);
    }
}

// Points, sheets, and what is larger than floats can tell.
TEST(EnclosureTest, ScenesOfAnySizeGetACamera) {
    for (const float size : {0.0f, 1e-30f, 1e-3f, 1e9f, 1e25f, 3e38f})
        for (const float depth : {0.0f, 1.0f}) {
            Scene scene;
            addInstance(scene, boxMesh(), {}, glm::scale(glm::mat4(1), {size, size, size * depth}));
            completeScene(scene);
            ASSERT_EQ(scene.cameras.size(), 1u) << size << " " << depth;
            if (size > 1e9f) continue;
            EXPECT_FALSE(glm::any(glm::isnan(scene.cameras[0].eye + scene.cameras[0].target)))
                << size << " " << depth;
        }
}

// Rooms of many kinds without their cameras: lamps that glow, windows, corners, pillars, one lamp at the end of a passage.
TEST(EnclosureTest, FirstPicturesOfGeneratedRoomsAreNotBlack) {
    for (const char* name : {"study", "parlour", "bathroom", "cellar", "counter", "attic", "sunroom",
                             "atrium?triangles=20000", "corridor", "tunnel", "leak", "glossy", "lobby"}) {
        Scene scene = io::generateScene(name);
        scene.cameras.clear();
        completeScene(scene);
        const Aabb bounds = scene.bounds();
        EXPECT_EQ(scene.cameras.at(0).name, "inside") << name;
        EXPECT_TRUE(isIn(scene.cameras[0].eye, bounds.min, bounds.max)) << name;
        EXPECT_GT(brightness(scene), 1e-3f) << name;
    }
    for (const char* name : {"garden", "cafe", "street", "yard", "greenhouse"}) {
        Scene scene = io::generateScene(name);
        scene.cameras.clear();
        completeScene(scene);
        EXPECT_EQ(scene.cameras.at(0).name, "framed") << name;
        EXPECT_GT(brightness(scene), 1e-3f) << name;
    }
}

}  // namespace conelight::test
