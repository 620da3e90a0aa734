// SPDX-License-Identifier: MIT
// Changes of the scene in place: the picture after them is the one that a fresh renderer draws of the changed
// scene, bit for bit; what is undone brings the first picture back; what is refused changes nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"

#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "support/environments.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 48;
constexpr std::size_t kBox = 6;  // instances 0 to 5 are the walls

Settings smallSettings(Mode mode) {
    Settings settings;
    settings.mode = mode;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    settings.light.areaSamples = 4;
    return settings;
}

glm::mat4 placed(const glm::vec3& position, float size = 0.2f) {
    return glm::scale(glm::translate(glm::mat4(1), position), glm::vec3(size));
}

// A room of edge 2 with a lamp, two boxes, the second glowing, and two lights. Walls keep the bounds.
Scene roomScene() {
    Material wall;
    wall.baseColor = glm::vec4(glm::vec3(0.7f), 1);
    Scene scene = closedBox(wall);
    scene.cameras.clear();
    scene.materials[0].baseColor = {0.8f, 0.1f, 0.1f, 1};
    Material box;
    box.baseColor = glm::vec4(0.2f, 0.3f, 0.9f, 1);
    addInstance(scene, boxMesh(), box, placed({-0.3f, -0.8f, -0.2f}));
    box.emission = {2, 1, 0.5f};
    addInstance(scene, boxMesh(), box, placed({0.5f, -0.75f, 0.1f}, 0.13f));
    scene.lights.push_back({.intensity = glm::vec3(1.5f), .position = {0.2f, 0.8f, 0.3f}});
    scene.lights.push_back({.type = LightType::Directional,
                            .intensity = glm::vec3(0.4f),
                            .direction = glm::normalize(glm::vec3(0.3f, -1, -0.2f))});
    scene.cameras.push_back({.eye = {0.3f, 0.2f, 0.95f}, .target = {-0.1f, -0.4f, -1}, .fovY = 1.3f});
    return scene;
}

// Twists it about the vertical, and stretches its upper end.
void bend(Mesh& mesh) {
    for (glm::vec3& p : mesh.positions)
        p = glm::vec3(glm::rotate(glm::mat4(1), 0.5f * p.y, {0, 1, 0}) * glm::vec4(p, 1)) *
            glm::vec3(1.0f, p.y > 0 ? 1.3f : 1.0f, 1.0f);
}

Image drawnBy(Renderer& renderer, const Scene& scene, Mode mode) {
    renderer.render(scene.cameras.front(), kPixels, kPixels, smallSettings(mode));
    return renderer.readImage();
}

Image drawnAfresh(const Scene& scene, Mode mode) {
    Renderer renderer;
    renderer.setScene(scene);
    return drawnBy(renderer, scene, mode);
}

bool sameBits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof a.pixels[0]) == 0;
}

// One kind of change, made in a Scene and in a Renderer.
struct Change {
    const char* name;
    std::function<void(Scene&)> edit;
    std::function<void(Renderer&, const Scene&)> apply;
};

std::vector<Change> otherChanges() {
    const auto instance = [](std::size_t index) {
        return [index](Renderer& r, const Scene& s) { r.setInstance(index, s.instances[index]); };
    };
    const auto lights = [](Renderer& r, const Scene& s) { r.setLights(s.lights); };
    return {
        {"box moves",
         [](Scene& s) {
             s.instances[kBox].worldFromObject = placed({0.2f, -0.4f, -0.5f});
         },
         instance(kBox)},
        {"box vanishes", [](Scene& s) { s.instances[kBox].visible = false; }, instance(kBox)},
        {"box casts no shadow", [](Scene& s) { s.instances[kBox].castsShadow = false; }, instance(kBox)},
        {"box is not voxelized", [](Scene& s) { s.instances[kBox].voxelized = false; }, instance(kBox)},
        {"wall mirrored", [](Scene& s) { s.instances[0].worldFromObject[1][1] = -1; }, instance(0)},
        {"box of another material", [](Scene& s) { s.instances[kBox].material = 0; }, instance(kBox)},
        {"lamp moves",
         [](Scene& s) {
             s.instances[kBox + 1].worldFromObject = placed({0, 0, -0.5f}, 0.1f);
         },
         instance(kBox + 1)},
        {"box painted",
         [](Scene& s) {
             s.materials[kBox].baseColor = {0.9f, 0.8f, 0.1f, 1};
         },
         [](Renderer& r, const Scene& s) { r.setMaterial(kBox, s.materials[kBox]); }},
        {"box lit from within",
         [](Scene& s) {
             s.materials[kBox].emission = {0, 30, 0};
         },
         [](Renderer& r, const Scene& s) { r.setMaterial(kBox, s.materials[kBox]); }},
        {"lamp off",
         [](Scene& s) {
             s.materials[kBox + 1].emission = {0, 0, 0};
         },
         [](Renderer& r, const Scene& s) { r.setMaterial(kBox + 1, s.materials[kBox + 1]); }},
        {"light moves", [](Scene& s) { s.lights[0].position.x = -0.6f; },
         [](Renderer& r, const Scene& s) { r.setLight(0, s.lights[0]); }},
        {"light off", [](Scene& s) { s.lights[0].enabled = false; },
         [](Renderer& r, const Scene& s) { r.setLight(0, s.lights[0]); }},
        {"lights added",
         [](Scene& s) {
             for (int i = 0; i < 5; ++i) {
                 s.lights.push_back(s.lights[0]);
                 s.lights.back().position.z -= 0.2f * static_cast<float>(i);
             }
         },
         lights},
        {"lights removed", [](Scene& s) { s.lights.clear(); }, lights},
        {"sky", [](Scene& s) { s.sky = glm::vec3(0.5f, 0.6f, 0.9f); },
         [](Renderer& r, const Scene& s) { r.setSky(s.sky); }},
        {"environment",
         [](Scene& s) {
             s.environment = Environment{"", sunnyEnvironment(32), 0.5f, 2};
         },
         [](Renderer& r, const Scene& s) { r.setEnvironment(s.environment); }},
    };
}

std::vector<Change> changes() {
    std::vector<Change> all = otherChanges();
    for (const std::size_t index : {kBox, kBox + 1})
        all.push_back({index == kBox ? "box bends" : "lamp bends",
                       [index](Scene& s) { bend(s.meshes[index]); },
                       [index](Renderer& r, const Scene& s) { r.setMesh(index, s.meshes[index]); }});
    return all;
}

class SceneChanges : public GlTest {};

TEST_F(SceneChanges, ThePictureIsThatOfAFreshRenderer) {
    for (const Mode mode : {Mode::Phong, thesis::kMode, Mode::Cones}) {
        const Scene first = roomScene();
        Renderer renderer;
        renderer.setScene(first);
        const Image before = drawnBy(renderer, first, mode);
        for (const Change& change : changes()) {
            Scene scene = first;
            change.edit(scene);
            change.apply(renderer, scene);
            EXPECT_TRUE(sameBits(drawnBy(renderer, scene, mode), drawnAfresh(scene, mode)))
                << change.name << ", mode " << mode.name();
            change.apply(renderer, first);
            EXPECT_TRUE(sameBits(drawnBy(renderer, first, mode), before))
                << change.name << " and back, mode " << mode.name();
        }
    }
}

// What comes and goes: the pictures are those of scenes that have it or have it not.
TEST_F(SceneChanges, WhatComesAndGoesLeavesNothingBehind) {
    for (const Mode mode : {Mode::Phong, Mode::Cones}) {
        const Scene first = roomScene();
        Renderer renderer;
        renderer.setScene(first);
        const Image before = drawnBy(renderer, first, mode);
        Scene scene = first;
        Material paint;
        paint.baseColor = {0.1f, 0.8f, 0.2f, 1};
        addInstance(scene, sphereMesh(12, 8), paint, placed({0.1f, -0.3f, -0.4f}));
        EXPECT_EQ(renderer.addMesh(scene.meshes.back()), scene.meshes.size() - 1);
        EXPECT_EQ(renderer.addMaterial(scene.materials.back()), scene.materials.size() - 1);
        EXPECT_EQ(renderer.addInstance(scene.instances.back()), scene.instances.size() - 1);
        EXPECT_TRUE(sameBits(drawnBy(renderer, scene, mode), drawnAfresh(scene, mode))) << mode.name();
        EXPECT_FALSE(sameBits(drawnBy(renderer, scene, mode), before)) << mode.name();
        renderer.removeInstance(scene.instances.size() - 1);
        EXPECT_TRUE(sameBits(drawnBy(renderer, first, mode), before)) << mode.name();
        // The place is free for another, of the same mesh.
        scene.instances.back().worldFromObject = placed({-0.2f, 0.3f, -0.4f}, 0.1f);
        EXPECT_EQ(renderer.addInstance(scene.instances.back()), scene.instances.size() - 1);
        EXPECT_TRUE(sameBits(drawnBy(renderer, scene, mode), drawnAfresh(scene, mode))) << mode.name();
    }
}

// Textures one after another, each on a material that comes after it; the first one in a scene without any.
TEST_F(SceneChanges, TexturesThatCome) {
    for (const Mode mode : {Mode::Phong, Mode::Cones}) {
        Scene scene = roomScene();
        scene.textures.clear();
        for (Material& material : scene.materials) material.baseColorTexture.texture = -1;
        Renderer renderer;
        renderer.setScene(scene);
        for (int i = 0; i < 4; ++i) {
            const Image before = drawnBy(renderer, scene, mode);
            Texture texture;
            texture.width = texture.height = 2;
            for (int k = 0; k < 4; ++k)
                for (const int value : {i % 2 == 0 ? 250 : 20, 60 * k, 40 * i, 255})
                    texture.rgba.push_back(static_cast<std::uint8_t>(value));
            scene.textures.push_back(texture);
            Material paint;
            paint.baseColorTexture.texture = i;
            const float x = -0.3f + 0.2f * static_cast<float>(i);
            addInstance(scene, sphereMesh(12, 8), paint, placed({x, -0.3f, -0.4f}, 0.2f));
            scene.meshes.back().uvs.assign(scene.meshes.back().positions.size(), {0.3f, 0.7f});
            EXPECT_EQ(renderer.addTexture(texture), scene.textures.size() - 1);
            renderer.addMesh(scene.meshes.back());
            renderer.addMaterial(scene.materials.back());
            renderer.addInstance(scene.instances.back());
            const Image after = drawnBy(renderer, scene, mode);
            EXPECT_TRUE(sameBits(after, drawnAfresh(scene, mode))) << i << ", " << mode.name();
            EXPECT_FALSE(sameBits(after, before)) << i << ", " << mode.name();
        }
    }
}

// The other way round: the changes above are seen at all.
TEST_F(SceneChanges, AreSeen) {
    const Scene first = roomScene();
    const Image before = drawnAfresh(first, Mode::Cones);
    for (const Change& change : changes()) {
        // The room is closed.
        if (std::strcmp(change.name, "sky") == 0 || std::strcmp(change.name, "environment") == 0) continue;
        Scene scene = first;
        change.edit(scene);
        EXPECT_FALSE(sameBits(drawnAfresh(scene, Mode::Cones), before)) << change.name;
    }
}

TEST_F(SceneChanges, RefusedOnesChangeNothing) {
    Renderer renderer;
    EXPECT_THROW(renderer.setInstance(0, {}), Error);
    EXPECT_THROW(renderer.setSky(glm::vec3(0)), Error);
    const Scene scene = roomScene();
    renderer.setScene(scene);
    const Image before = drawnBy(renderer, scene, Mode::Cones);
    const auto refused = [&](const char* words, const std::function<void()>& call) {
        try {
            call();
            ADD_FAILURE() << "not refused: " << words;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    Instance instance = scene.instances[kBox];
    refused("instance 8 of 8", [&] { renderer.setInstance(8, instance); });
    instance.worldFromObject[3][1] = NAN;
    refused("not finite", [&] { renderer.setInstance(kBox, instance); });
    instance = scene.instances[kBox];
    instance.mesh = 0;
    refused("mesh it has", [&] { renderer.setInstance(kBox, instance); });
    instance.mesh = 6;
    instance.material = 99;
    Mesh mesh = scene.meshes[kBox];
    mesh.positions.pop_back();
    mesh.normals.clear();
    mesh.indices = {0, 1, 2};
    refused("as many as it has", [&] { renderer.setMesh(kBox, mesh); });
    mesh = scene.meshes[kBox];
    mesh.positions[0].x = NAN;
    refused("not finite", [&] { renderer.setMesh(kBox, mesh); });
    refused("mesh 8 of 8", [&] { renderer.setMesh(8, mesh); });
    refused("material 99", [&] { renderer.setInstance(kBox, instance); });
    Material material;
    material.baseColorTexture.texture = 3;
    refused("texture 3", [&] { renderer.setMaterial(0, material); });
    refused("material 20", [&] { renderer.setMaterial(20, {}); });
    Light light;
    light.intensity.x = INFINITY;
    refused("not finite", [&] { renderer.setLight(0, light); });
    refused("light 2 of 2", [&] { renderer.setLight(2, {}); });
    refused("not finite", [&] { renderer.setSky({0, NAN, 0}); });
    refused("texture 3", [&] { renderer.addMaterial(material); });
    refused("do not belong together", [&] { renderer.addTexture(Texture{}); });
    refused("not finite", [&] { renderer.addMesh(mesh); });
    refused("material 99", [&] { renderer.addInstance(instance); });
    refused("instance 8 of 8", [&] { renderer.removeInstance(8); });
    refused("removeInstance before it", [&] { renderer.removeMesh(0); });
    refused("setRegion", [&] { renderer.setRegion({glm::vec3(0), {1, 1, INFINITY}}); });
    refused("setRegion", [&] { renderer.setRegion({glm::vec3(1), glm::vec3(1)}); });
    EXPECT_TRUE(sameBits(drawnBy(renderer, scene, Mode::Cones), before));
    renderer.removeInstance(kBox);
    refused("was removed", [&] { renderer.removeInstance(kBox); });
    refused("was removed", [&] { renderer.setInstance(kBox, scene.instances[kBox]); });
    renderer.removeMesh(kBox);
    refused("was removed", [&] { renderer.removeMesh(kBox); });
    refused("was removed", [&] { renderer.setMesh(kBox, scene.meshes[kBox]); });
    refused("was removed", [&] { renderer.addInstance(scene.instances[kBox]); });
}

// Windows that are minimised ask for 0 x 0 pixels; cameras that see nothing are refused, not drawn black.
TEST_F(SceneChanges, PicturesOfNothing) {
    const Scene scene = roomScene();
    Renderer renderer;
    renderer.setScene(scene);
    const Image before = drawnBy(renderer, scene, Mode::Phong);
    const Settings settings = smallSettings(Mode::Phong);
    renderer.render(scene.cameras.front(), 0, 0, settings);
    renderer.render(scene.cameras.front(), kPixels, 0, settings);
    EXPECT_TRUE(sameBits(renderer.readImage(), before));
    EXPECT_THROW(renderer.render(scene.cameras.front(), -1, kPixels, settings), Error);
    std::vector<Camera> blind(5, scene.cameras.front());
    blind[0].eye.x = NAN;
    blind[1].up.y = INFINITY;
    blind[2].fovY = 0;
    blind[3].zNear = blind[3].zFar;
    blind[4].lensDiameter = NAN;
    for (const Camera& camera : blind)
        EXPECT_THROW(renderer.render(camera, kPixels, kPixels, settings), Error) << &camera - blind.data();
    EXPECT_TRUE(sameBits(renderer.readImage(), before));
}

// What leaves the grid and comes back finds the same voxels: the grid is where it was.
TEST_F(SceneChanges, TheGridStaysWhenThingsLeaveIt) {
    const Scene scene = roomScene();
    Renderer renderer;
    renderer.setScene(scene);
    const Image before = drawnBy(renderer, scene, Mode::Cones);
    Instance box = scene.instances[kBox];
    for (const float distance : {1.2f, 3.0f, 1e3f, 1e30f}) {
        box.worldFromObject = placed({distance, 0, 0});
        renderer.setInstance(kBox, box);
        for (const glm::vec4& pixel : drawnBy(renderer, scene, Mode::Cones).pixels)
            ASSERT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z)) << distance;
    }
    renderer.setInstance(kBox, scene.instances[kBox]);
    EXPECT_TRUE(sameBits(drawnBy(renderer, scene, Mode::Cones), before));
}

}  // namespace
}  // namespace conelight::test
