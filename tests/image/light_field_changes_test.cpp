// SPDX-License-Identifier: MIT
// LightField: a scene that changes. What comes and goes leaves the rest of the light settled; a region keeps the
// grid from large grounds; budgets.
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "gl/object.h"
#include "gl/pass.h"
#include "support/light_field_rig.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

class LightFieldChanges : public LightFieldRig {
  protected:
    std::vector<glm::vec4> freshly(const Scene& scene, const Settings& settings, HostPicture& host) {
        LightField fresh;
        fresh.setScene(scene);
        fresh.setSettings(settings);
        fresh.update();
        return diffuseOf(fresh, host);
    }
    // The room without its last box.
    Scene withoutBox() const {
        Scene scene = scene_;
        scene.meshes.pop_back();
        scene.materials.pop_back();
        scene.instances.pop_back();
        return scene;
    }
    // Of moving pictures, with all updates of the room.
    void settle(LightField& field, Settings settings) const {
        settings.traced.budgeted = true;
        field.setScene(scene_);
        field.setSettings(settings);
        while (field.update() < settings.traced.cacheUpdates) continue;
    }
    // The last box goes on by a fiftieth of the room a frame, with one update each, in light that had settled.
    Scene moveBox(LightField& field, const Settings& settings) const {
        settle(field, settings);
        Scene scene = scene_;
        for (int frame = 0; frame < 8; ++frame) {
            scene.instances.back().worldFromObject[3].x -= 0.04f;
            field.setInstance(scene.instances.size() - 1, scene.instances.back());
            field.update();
        }
        return scene;
    }
    static void addBoxOf(LightField& field, const Scene& scene) {
        Instance instance = scene.instances.back();
        instance.mesh = static_cast<int>(field.addMesh(scene.meshes.back()));
        instance.material = static_cast<int>(field.addMaterial(scene.materials.back()));
        EXPECT_EQ(field.addInstance(instance), scene.instances.size() - 1);
    }
};

// By 32 updates of few rays each, noise is left in both: 3 % as for meshes that bend.
TEST_F(LightFieldChanges, WhatIsAddedIsLitAsInAFreshScene) {
    const Settings settings = hostSettings();
    HostPicture with(scene_, lens());
    drawn(with);
    LightField field;
    field.setScene(withoutBox());
    field.setSettings(settings);
    field.update();
    const std::vector<glm::vec4> without = diffuseOf(field, with);
    addBoxOf(field, scene_);
    field.update();
    const std::vector<glm::vec4> expected = freshly(scene_, settings, with);
    EXPECT_LT(hostDifference(diffuseOf(field, with), expected), 0.03);
    EXPECT_GT(hostDifference(without, expected), 0.045);  // the box is seen at all
    field.removeInstance(scene_.instances.size() - 1);
    field.update();
    EXPECT_LT(hostDifference(diffuseOf(field, with), without), 0.03);
}

// One update after a box has come: far from it the light is what it was, with the noise of few rays (means begin
// anew). A fresh scene is far too dark by then.
TEST_F(LightFieldChanges, SettledLightStays) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;  // the cache as it is
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> settled = freshly(scene_, settings, host);
    settings.traced.budgeted = true;
    LightField field;
    settle(field, settings);
    Instance small = scene_.instances.back();
    small.worldFromObject =
        glm::translate(glm::mat4(1), {0.8f, -0.9f, -0.8f}) * glm::scale(glm::mat4(1), glm::vec3(0.05f));
    field.addInstance(small);
    field.update();
    EXPECT_LT(hostDifference(diffuseOf(field, host), settled), 0.15);
    EXPECT_NEAR(hostMean(diffuseOf(field, host)) / hostMean(settled), 1, 0.04);
    LightField fresh;
    fresh.setScene(scene_);
    fresh.setSettings(settings);
    fresh.update();
    EXPECT_LT(hostMean(diffuseOf(fresh, host)) / hostMean(settled), 0.8);
}

// A moving picture is as a settled one of its scene but for what few updates err. Where all faces forget all they have at each move, frames are 17 % off.
TEST_F(LightFieldChanges, LightStaysWhileThingsMove) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;  // the cache as it is
    HostPicture host(scene_, lens());
    drawn(host);
    LightField field;
    const Scene scene = moveBox(field, settings);
    const std::vector<glm::vec4> shown = diffuseOf(field, host);
    const std::vector<glm::vec4> expected = freshly(scene, settings, host);
    EXPECT_LT(hostDifference(shown, expected), 0.15);
    EXPECT_NEAR(hostMean(shown) / hostMean(expected), 1, 0.04);
    EXPECT_GT(hostDifference(freshly(scene_, settings, host), expected), 0.2);  // the box is seen to move
}

// Forty small things tremble in two corners of the room. Were they taken as one, all faces would forget what they have.
TEST_F(LightFieldChanges, LightStaysWhereCrowdsAreNot) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;  // the cache as it is
    Instance small = scene_.instances.back();
    const auto placed = [](int i, float height) {
        const float corner = i % 2 == 0 ? 0.8f : -0.8f, along = 0.004f * static_cast<float>(i);
        const glm::vec3 at(corner + along, -0.9f + height, corner - along);
        return glm::translate(glm::mat4(1), at) * glm::scale(glm::mat4(1), glm::vec3(0.01f));
    };
    const std::size_t first = scene_.instances.size();
    for (int i = 0; i < 40; ++i) {
        small.worldFromObject = placed(i, 0);
        scene_.instances.push_back(small);
    }
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> settled = freshly(scene_, settings, host);
    LightField field;
    settle(field, settings);
    for (int frame = 1; frame <= 8; ++frame) {
        for (int i = 0; i < 40; ++i) {
            small.worldFromObject = placed(i, 0.01f * static_cast<float>(frame % 2));
            field.setInstance(first + static_cast<std::size_t>(i), small);
        }
        field.update();
    }
    const double error = hostDifference(diffuseOf(field, host), settled);
    RecordProperty("error", std::to_string(error));
    EXPECT_LT(error, 0.06);  // 0.086 where all are one sphere
}

// In a room that a lamp lights, another one flickers, and is made bright for good; that lamp is carried about, slowly and
// fast. Faces have one update a frame. Where all of them forget all they have, errors are in brackets.
TEST_F(LightFieldChanges, LightStaysWhileLampsChange) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;  // the cache as it is
    HostPicture host(scene_, lens());
    drawn(host);
    scene_.lights.push_back({.intensity = glm::vec3(0.02f), .position = glm::vec3(-0.8f)});
    const auto errorAfter = [&](const char* name,
                                const std::function<void(std::vector<Light>&, int)>& change) {
        LightField field;
        settle(field, settings);
        Scene scene = scene_;
        for (int frame = 1; frame <= 8; ++frame) {
            change(scene.lights, frame);
            field.setLights(scene.lights);
            field.update();
        }
        const double error = hostDifference(diffuseOf(field, host), freshly(scene, settings, host));
        RecordProperty(name, std::to_string(error));
        return error;
    };
    const auto flicker = [](std::vector<Light>& lights, int frame) {
        lights[1].intensity = glm::vec3(frame % 2 != 0 ? 0.03f : 0.02f);
    };
    const auto walk = [](std::vector<Light>& lights, int) { lights[0].position.x -= 0.01f; };
    const auto run = [](std::vector<Light>& lights, int) { lights[0].position.x -= 0.1f; };
    const auto goOn = [](std::vector<Light>& lights, int) { lights[1].intensity = glm::vec3(1); };
    EXPECT_LT(errorAfter("flicker", flicker), 0.06);  // (0.089)
    EXPECT_LT(errorAfter("walk", walk), 0.06);        // (0.077)
    EXPECT_LT(errorAfter("run", run), 0.12);          // (0.099)
    EXPECT_LT(errorAfter("on", goOn), 0.12);          // (0.096)
}

// The only lamp is dimmed, and changes its colour: after one update light is that of a fresh scene, faces' and pixels' alike,
// with the noise that it had. Where all faces and pixels forget, errors are in brackets.
TEST_F(LightFieldChanges, LightIsScaledWithItsLamp) {
    HostPicture host(scene_, lens());
    drawn(host);
    const glm::vec3 scale(0.2f, 0.5f, 3);
    for (const int rays : {0, 2}) {
        Settings settings = hostSettings();
        settings.traced.pixelRays = rays;
        LightField field;
        settle(field, settings);
        std::vector<glm::vec4> settled = diffuseOf(field, host);
        Scene scene = scene_;
        scene.lights[0].intensity *= scale;
        field.setLights(scene.lights);
        field.update();
        const double error = hostDifference(diffuseOf(field, host), freshly(scene, settings, host));
        for (glm::vec4& pixel : settled) pixel *= glm::vec4(scale, 1);
        const double change = hostDifference(diffuseOf(field, host), settled);
        RecordProperty("error" + std::to_string(rays), std::to_string(error));
        RecordProperty("change" + std::to_string(rays), std::to_string(change));
        EXPECT_LT(error, 0.07);  // (0.70, 0.45)
        EXPECT_LT(change, 0.05);
    }
}

// The sky outside a closed room is dimmed, or one of two lamps: what others light keeps what it has.
TEST_F(LightFieldChanges, OtherLightIsNotScaled) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;  // the cache as it is
    HostPicture host(scene_, lens());
    drawn(host);
    scene_.sky = glm::vec3(0.5f);
    scene_.lights.push_back({.intensity = glm::vec3(0.02f), .position = glm::vec3(-0.8f)});
    const auto meanAfter = [&](const std::function<void(LightField&, Scene&)>& change) {
        LightField field;
        settle(field, settings);
        const double settled = hostMean(diffuseOf(field, host));
        Scene scene = scene_;
        change(field, scene);
        field.update();
        return hostMean(diffuseOf(field, host)) / settled;
    };
    EXPECT_NEAR(meanAfter([](LightField& field, Scene&) { field.setSky(glm::vec3(0.25f)); }), 1, 0.02);
    EXPECT_NEAR(meanAfter([](LightField& field, Scene& scene) {
                    scene.lights[1].intensity *= 0.25f;
                    field.setLights(scene.lights);
                }),
                1, 0.02);
}

// When things stand still again, twice as many updates as elsewhere leave the light of a fresh scene: nothing of the way.
TEST_F(LightFieldChanges, NothingIsLeftOfAWay) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;
    HostPicture host(scene_, lens());
    drawn(host);
    LightField field;
    const Scene scene = moveBox(field, settings);
    int updates = 1;
    while (field.update() < settings.traced.cacheUpdates) ++updates;
    EXPECT_GT(updates, settings.traced.cacheUpdates);
    const std::vector<glm::vec4> expected = freshly(scene, settings, host);
    // Noise of other light samples, by driver: 0.049 and 0.052 were seen.
    EXPECT_LT(hostDifference(diffuseOf(field, host), expected), 0.06);
    EXPECT_NEAR(hostMean(diffuseOf(field, host)) / hostMean(expected), 1, 0.01);
}

// Nor of one that a lamp has gone, in small steps or in one. Means are 1.2 and 0.9 % apart, 0.6 and 0.9 % where all
// faces forget.
TEST_F(LightFieldChanges, NothingIsLeftOfALampsWay) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;
    HostPicture host(scene_, lens());
    drawn(host);
    const Scene start = scene_;
    for (const float step : {0.03f, 0.8f}) {
        scene_ = start;
        LightField field;
        settle(field, settings);
        const std::vector<glm::vec4> before = diffuseOf(field, host);
        for (int frame = 0; frame < (step < 0.1f ? 20 : 1); ++frame) {
            scene_.lights[0].position.x -= step;
            field.setLights(scene_.lights);
            field.update();
        }
        while (field.update() < settings.traced.cacheUpdates) continue;
        LightField fresh;
        settle(fresh, settings);
        const std::vector<glm::vec4> expected = diffuseOf(fresh, host);
        EXPECT_LT(hostDifference(diffuseOf(field, host), expected), 0.03) << step;
        EXPECT_NEAR(hostMean(diffuseOf(field, host)) / hostMean(expected), 1, 0.02) << step;
        EXPECT_GT(hostDifference(before, expected), 0.1) << step;
    }
}

// When the lamps go out, a view's means let go of their light: a plain mean would keep a tenth of it after so many frames.
TEST_F(LightFieldChanges, OldLightLeavesTheMeans) {
    Settings settings = hostSettings();
    settings.traced.budgeted = true;
    settings.traced.passes = 64;
    HostPicture host(scene_, lens());
    drawn(host);
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    const int view = field.addView();
    const auto after = [&](int frames) {
        GatheredLight light;
        for (int i = 0; i < frames; ++i) {
            field.update({.updates = 4});
            light = field.gather(view, host.surfaces());
        }
        return hostMean(pixelsOf(light.diffuse));
    };
    const double lit = after(16);
    EXPECT_GT(lit, 0);
    field.setLights({});
    EXPECT_LT(after(16), 0.04 * lit);
}

TEST_F(LightFieldChanges, NothingIsLeftBehind) {
    Settings settings = hostSettings();
    settings.traced.budgeted = true;
    settings.voxels.size = 16;
    HostPicture host(scene_, lens());
    drawn(host);
    LightField field;
    field.setScene(withoutBox());
    field.setSettings(settings);
    const int view = field.addView();
    const auto turns = [&](int count) {
        for (int i = 0; i < count; ++i) {
            Instance instance = scene_.instances.back();
            const std::size_t mesh = field.addMesh(i % 2 == 0 ? sphereMesh(6 + i % 5, 5) : boxMesh());
            instance.mesh = static_cast<int>(mesh);
            instance.material = -1;
            const std::size_t index = field.addInstance(instance);
            field.update();
            field.gather(view, host.surfaces());
            field.removeInstance(index);
            field.removeMesh(mesh);
        }
        field.update();
        return gl::liveObjects().size();
    };
    const std::size_t objects = turns(20);
    EXPECT_EQ(turns(40), objects);
}

// A scene may begin with nothing.
TEST_F(LightFieldChanges, ASceneMayBeginEmpty) {
    const Settings settings = hostSettings();
    HostPicture host(scene_, lens());
    drawn(host);
    LightField field;
    field.setScene({});
    field.setSettings(settings);
    for (const Mesh& mesh : scene_.meshes) field.addMesh(mesh);
    for (const Material& material : scene_.materials) field.addMaterial(material);
    for (const Instance& instance : scene_.instances) field.addInstance(instance);
    field.setLights(scene_.lights);
    field.update();
    EXPECT_EQ(diffuseOf(field, host), freshly(scene_, settings, host));
    EXPECT_EQ(field.scene().instances.size(), scene_.instances.size());
}

// The room on a ground of 200 m. In the region, or with a ground that is no part of the light, the grid is that of
// the room alone; without either a voxel is as large as the room.
TEST_F(LightFieldChanges, ALargeGroundCoarsensNothing) {
    const Settings settings = hostSettings();
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> alone = freshly(scene_, settings, host);
    Scene wide = scene_;
    addInstance(wide, quadMesh({-100, -1.2f, 100}, {200, 0, 0}, {0, 0, -200}),
                diffuseMaterial(glm::vec3(0.5f)));
    EXPECT_GT(hostDifference(freshly(wide, settings, host), alone), 0.1);
    LightField field;
    field.setSettings(settings);
    field.setRegion(scene_.bounds());
    field.setScene(wide);
    field.update();
    EXPECT_LT(hostDifference(diffuseOf(field, host), alone), 1e-3);
    field.setRegion({});
    field.update();
    EXPECT_GT(hostDifference(diffuseOf(field, host), alone), 0.1);
    wide.instances.back().voxelized = false;
    EXPECT_LT(hostDifference(freshly(wide, settings, host), alone), 1e-3);
}

// However little time there is, light gets on; and with enough it is finished by one call, on a GPU once a call has told
// what faces cost. How far it gets, the machine says.
TEST_F(LightFieldChanges, ABudgetOfTimeIsKept) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;
    settings.voxels.size = 16;
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> settled = freshly(scene_, settings, host);
    settings.traced.budgeted = true;
    const int all = settings.traced.cacheUpdates;
    LightField fast;
    fast.setScene(scene_);
    fast.setSettings(settings);
    const int first = fast.update({.updates = 1000, .milliseconds = 1e9});
    EXPECT_EQ(gl::isSoftwareDriver() ? first : fast.update({.updates = 1000, .milliseconds = 1e9}), all);
    EXPECT_LT(hostDifference(diffuseOf(fast, host), settled), 0.03);
    LightField slow;
    slow.setScene(scene_);
    slow.setSettings(settings);
    EXPECT_LT(slow.update({.updates = 1000, .milliseconds = 1e-3}), all);
    int calls = 1;
    while (slow.update({.updates = 1000, .milliseconds = 1e-3}) < all && calls < 10000) ++calls;
    EXPECT_GT(calls, all);
    EXPECT_LT(calls, 10000);
    EXPECT_LT(hostDifference(diffuseOf(slow, host), settled), 0.1);
    EXPECT_NEAR(hostMean(diffuseOf(slow, host)) / hostMean(settled), 1, 0.02);
    // A call with time for many faces does many, also after one that was slow
    slow.setLights(scene_.lights);
    EXPECT_GE(slow.update({.updates = 1000, .milliseconds = 1e9}), all);
    // The other limits hold as well
    LightField one;
    one.setScene(scene_);
    one.setSettings(settings);
    EXPECT_EQ(one.update({.updates = 1, .milliseconds = 1e9}), 1);
    EXPECT_EQ(one.update({.updates = 2, .milliseconds = 1e9}), 3);
    EXPECT_THROW(one.update({.milliseconds = -1}), Error);
}

// While a box goes on, by one update and no rays of pixels a frame: how much what stands still comes and goes from frame
// to frame, as the standard deviation over the mean, and how far it is from settled light.
TEST_F(LightFieldChanges, ThingsMoveAtABudget) {
    Settings settings = realtimeSettings(Quality::Draft);
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    while (field.update() < settings.traced.cacheUpdates) continue;
    const int view = field.addView();
    HostPicture host(scene_, lens());
    std::vector<std::vector<glm::vec4>> frames;
    std::vector<char> stands(kHostWidth * kHostHeight, 1);  // walls, in all frames
    const std::size_t box = scene_.instances.size() - 1;
    for (int frame = 0; frame < 12; ++frame) {
        scene_.instances[box].worldFromObject[3].x -= 0.02f;
        field.setInstance(box, scene_.instances[box]);
        field.update();
        drawn(host);
        frames.push_back(pixelsOf(field.gather(view, host.surfaces()).diffuse));
        std::vector<std::uint32_t> seen(stands.size());
        glGetTextureImage(host.surfaces().instances, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                          static_cast<GLsizei>(4 * seen.size()), seen.data());
        for (std::size_t i = 0; i < seen.size(); ++i) stands[i] = stands[i] != 0 && seen[i] < kHostMetal;
    }
    const auto isWall = [&](std::size_t i) { return stands[i] != 0; };
    // Of neighbouring frames: what moves changes the light itself as well.
    double flicker = 0;
    constexpr std::size_t kFirst = 5;
    for (std::size_t k = kFirst; k < frames.size(); ++k)
        flicker += hostDifference(frames[k], frames[k - 1], isWall) / std::sqrt(2.0);
    flicker /= static_cast<double>(frames.size() - kFirst);
    settings.traced.budgeted = false;
    const double error = hostDifference(frames.back(), freshly(scene_, settings, host), isWall);
    std::printf("flicker %.2f %%, error %.1f %%\n", 100 * flicker, 100 * error);
    EXPECT_LT(flicker, 0.009);
    EXPECT_LT(error, 0.06);
}

}  // namespace
}  // namespace conelight::test
