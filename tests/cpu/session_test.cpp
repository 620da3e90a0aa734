// SPDX-License-Identifier: MIT
// Session: every change can be undone and raises the counter of what changed, and of that alone; picking sees
// what is drawn.
#include "session/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "cpu/io_test_support.h"
#include "io/scene_write.h"
#include "session/picker.h"

namespace conelight::program {
namespace {

// A unit square in the plane z = 0 that faces +z, twice: moved to z = 1 and turned, and at z = -1.
Scene twoSquares() {
    Scene scene;
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    scene.materials.resize(2);
    scene.materials[0].name = "front";
    scene.materials[1].name = "back";
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), {0, 0, 1}), 0.5f, {0, 1, 0});
    scene.instances.push_back({"near", 0, 0, turned});
    scene.instances.push_back({"far", 0, -1, glm::translate(glm::mat4(1), {0, 0, -1})});
    scene.lights.emplace_back();
    scene.lights[0].name = "lamp";
    scene.cameras.push_back(Camera{"main"});
    return scene;
}

Session session() {
    Scene scene = twoSquares();
    const Camera camera = scene.cameras.front();
    return {std::move(scene), "two.scene", Settings{}, "", camera};
}

// The counters that differ, by name.
std::string changed(const Revisions& a, const Revisions& b) {
    std::string names;
    const auto add = [&](std::uint64_t x, std::uint64_t y, const char* name) {
        if (x != y) names += (names.empty() ? "" : " ") + std::string(name);
    };
    add(a.scene, b.scene, "scene");
    add(a.transforms, b.transforms, "transforms");
    add(a.instances, b.instances, "instances");
    add(a.materials, b.materials, "materials");
    add(a.lights, b.lights, "lights");
    add(a.sky, b.sky, "sky");
    add(a.cameras, b.cameras, "cameras");
    add(a.settings, b.settings, "settings");
    add(a.camera, b.camera, "camera");
    add(a.flags, b.flags, "flags");
    add(a.selection, b.selection, "selection");
    add(a.voxels, b.voxels, "voxels");
    return names;
}

// All that undo brings back, as text.
std::string stateOf(const Session& s) {
    std::string text = s.mode();
    for (const SettingInfo& info : settingInfos()) text += " " + getSetting(s.settings(), info.key);
    const auto number = [&](float value) { text += " " + std::to_string(value); };
    for (const Instance& instance : s.scene().instances) {
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) number(instance.worldFromObject[c][r]);
        text += instance.visible ? " v" : " -";
        text += std::to_string(instance.material);
    }
    for (const Material& material : s.scene().materials) number(material.roughness);
    for (const Light& light : s.scene().lights) number(light.intensity.x);
    number(static_cast<float>(s.scene().cameras.size()));
    number(s.scene().sky.x);
    number(s.camera().eye.x);
    text += s.flags().drawVoxels ? " voxels" : "";
    return text;
}

TEST(Session, UnsavedIsASceneOtherThanTheFile) {
    Session s = session();
    EXPECT_FALSE(s.unsaved());
    s.setSetting("image.exposure", "2");
    EXPECT_FALSE(s.unsaved()) << "settings are not of the scene";
    s.setSky(glm::vec3(1), "sky");
    EXPECT_TRUE(s.unsaved());
    s.markSaved();
    s.setSetting("image.exposure", "3");
    EXPECT_FALSE(s.unsaved());
    s.undo();
    s.undo();
    EXPECT_TRUE(s.unsaved()) << "the file has the sky";
    s.redo();
    EXPECT_FALSE(s.unsaved());
    // One step by the same key, begun before it was saved.
    s.setSky(glm::vec3(2), "sky", "sky");
    s.markSaved();
    s.setSky(glm::vec3(3), "sky", "sky");
    EXPECT_TRUE(s.unsaved());
    s.undo();
    s.setSky(glm::vec3(4), "sky");
    EXPECT_TRUE(s.unsaved()) << "another step in the place of the saved one";
    // Forgotten steps count.
    s.markSaved();
    for (int i = 0; i < 1100; ++i) s.setSky(glm::vec3(static_cast<float>(i)), "sky");
    while (s.undo()) {
    }
    EXPECT_TRUE(s.unsaved());
}

// A change of a session, and the counters that it raises.
struct Case {
    const char* counters;
    std::function<void()> change;
};

// One of each kind, in this order: one builds on those above it.
std::vector<Case> casesOf(Session& s) {
    return {
        {"settings", [&] { s.setSetting("image.exposure", "2"); }},
        {"settings", [&] { s.setMode("thesis"); }},
        {"settings", [&] { s.setMode("reference"); }},
        {"camera",
         [&] {
             Camera c = s.camera();
             c.eye.x = 2;
             s.jumpCamera(c, "jump");
         }},
        {"flags",
         [&] {
             ViewFlags f = s.flags();
             f.drawVoxels = true;
             s.setFlags(f, "voxels");
         }},
        {"transforms",
         [&] {
             Instance i = s.scene().instances[0];
             i.worldFromObject[3].x = 7;
             s.setInstances({{0, i}}, "move");
         }},
        {"instances",
         [&] {
             Instance i = s.scene().instances[1];
             i.visible = false;
             s.setInstances({{1, i}}, "hide");
         }},
        {"materials",
         [&] {
             Material m = s.scene().materials[1];
             m.roughness = 0.25f;
             s.setMaterials({{1, m}}, "roughness");
         }},
        {"instances materials", [&] { EXPECT_EQ(s.materialOf(1), 2u); }},
        {"lights", [&] { s.setLights({}, "dark"); }},
        {"cameras", [&] { s.setCameras({}, "no cameras"); }},
        {"sky", [&] { s.setSky(glm::vec3(1), "sky"); }},
    };
}

TEST(Session, EveryChangeIsCountedAloneAndUndone) {
    Session s = session();
    const std::vector<Case> cases = casesOf(s);
    std::vector<std::string> states = {stateOf(s)};
    for (const Case& one : cases) {
        const Revisions before = s.revisions();
        one.change();
        EXPECT_EQ(changed(before, s.revisions()), one.counters);
        states.push_back(stateOf(s));
        EXPECT_NE(states[states.size() - 2], states.back()) << one.counters;
    }
    ASSERT_EQ(s.undoSteps(), cases.size());
    EXPECT_TRUE(s.unsaved());
    for (std::size_t i = cases.size(); i-- > 0;) {
        const Revisions before = s.revisions();
        ASSERT_TRUE(s.undo());
        EXPECT_EQ(changed(before, s.revisions()), cases[i].counters);
        EXPECT_EQ(stateOf(s), states[i]);
    }
    EXPECT_FALSE(s.undo());
    EXPECT_FALSE(s.unsaved()) << "as it was opened";
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_TRUE(s.redo());
        EXPECT_EQ(stateOf(s), states[i + 1]);
    }
    EXPECT_FALSE(s.redo());
}

TEST(Session, SameValueIsNoStepAndANewChangeEndsRedo) {
    Session s = session();
    s.setSetting("image.exposure", getSetting(s.settings(), "image.exposure"));
    s.setMode(s.mode());
    s.jumpCamera(s.camera(), "nowhere");
    s.setFlags(s.flags(), "same");
    EXPECT_EQ(s.undoSteps(), 0u);
    s.setSetting("image.exposure", "1");
    s.undo();
    EXPECT_EQ(s.redoSteps(), 1u);
    s.setSetting("voxels.size", "64");
    EXPECT_EQ(s.redoSteps(), 0u);
}

TEST(Session, DragsBecomeOneStepUntilSealed) {
    Session s = session();
    for (const char* value : {"0.1", "0.2", "0.3"}) s.setSetting("image.exposure", value, "exposure");
    s.seal();
    for (const char* value : {"0.4", "0.5"}) s.setSetting("image.exposure", value, "exposure");
    s.setSetting("voxels.padding", "0.5", "padding");
    EXPECT_EQ(s.undoSteps(), 3u);
    s.undo();
    s.undo();
    EXPECT_EQ(getSetting(s.settings(), "image.exposure"), "0.3");
    s.undo();
    EXPECT_EQ(getSetting(s.settings(), "image.exposure"), "0");
}

TEST(Session, AFailedChangeLeavesEverything) {
    Session s = session();
    const std::string before = stateOf(s);
    EXPECT_THROW(s.setSetting("image.exposure", "bright"), Error);
    EXPECT_THROW(s.setSetting("image.exposures", "1"), Error);
    EXPECT_THROW(s.setMode("conez"), Error);
    EXPECT_THROW(s.open("/nonexistent/x.glb", false), Error);
    EXPECT_EQ(stateOf(s), before);
    EXPECT_EQ(s.path(), "two.scene");
    EXPECT_EQ(s.undoSteps(), 0u);
}

TEST(Session, OpenKeepsTheViewWhenAsked) {
    Session s = session();
    s.setSetting("image.exposure", "3");
    Camera camera = s.camera();
    camera.eye = {4, 5, 6};
    s.jumpCamera(camera, "there");
    s.open("builtin:cornell", true);
    EXPECT_EQ(s.camera().eye, glm::vec3(4, 5, 6));
    EXPECT_EQ(getSetting(s.settings(), "image.exposure"), "3");
    EXPECT_EQ(s.undoSteps(), 0u);
    s.open("builtin:cornell", false);
    EXPECT_NE(s.camera().eye, glm::vec3(4, 5, 6));
    EXPECT_EQ(getSetting(s.settings(), "image.exposure"), "0");
}

// A mode that somebody chose stays, unless the next file names its own.
TEST(Session, AChosenModeStaysForScenesThatNameNone) {
    Session s = session();
    s.open("builtin:cornell", false);
    const std::string first = s.mode();
    s.setMode("phong");
    s.open("builtin:cornell", false);
    EXPECT_EQ(s.mode(), "phong");
    EXPECT_EQ(s.shownSettings().mode, Mode::Phong);
    s.setMode("reference");
    s.open("builtin:cornell", false);
    EXPECT_EQ(s.mode(), "reference");
    s.setMode("phong");
    OpenedScene own;
    own.scene = twoSquares();
    own.scene.settings = {{"mode", "cones"}};
    const std::string path = (test::folderOf("session") / "own.glb").string();
    io::writeScene(path, own.scene, true);
    const std::vector<std::string> notes = s.open(path, false);
    EXPECT_EQ(s.mode(), "cones");
    ASSERT_FALSE(notes.empty());
    EXPECT_EQ(notes.back(), "mode cones, as the file says; `mode phong` goes back");
    s.open("builtin:cornell", false);
    EXPECT_EQ(s.mode(), "phong") << "the choice holds";
    s.undo();
    EXPECT_NE(first, "phong");
}

TEST(Session, VoxelFlagsChangeWhatIsShown) {
    Session s = session();
    s.setMode("phong");
    ViewFlags flags;
    flags.drawVoxels = true;
    s.setFlags(flags, "voxels");
    EXPECT_EQ(s.shownMode(), "thesis");
    EXPECT_TRUE(s.shownSettings().view.voxels);
    EXPECT_EQ(s.shownSettings().component, Component::Full);
    flags.drawObjects = false;
    s.setFlags(flags, "voxels alone");
    EXPECT_FALSE(s.shownSettings().view.voxels);
    EXPECT_EQ(s.shownSettings().component, Component::Voxels);
    EXPECT_EQ(s.settings().component, Component::Full);
    flags = {};
    flags.localizedLod = true;
    s.setFlags(flags, "lod");
    EXPECT_EQ(s.shownSettings().component, Component::Voxels);
    EXPECT_EQ(s.shownSettings().view.voxelShape, VoxelShape::Surfaces);
    s.setMode("cones");
    EXPECT_EQ(s.shownMode(), "thesis");
    flags = {};
    flags.drawVoxels = true;
    s.setFlags(flags, "voxels");
    EXPECT_EQ(s.shownMode(), "cones");
}

TEST(Session, WireframeFlagsChangeWhatIsShown) {
    Session s = session();
    ViewFlags flags;
    flags.wireframeOverlay = true;
    s.setFlags(flags, "overlay");
    EXPECT_EQ(s.shownSettings().view.wireframe, Wireframe::Over);
    flags.wireframeObjects = true;
    s.setFlags(flags, "objects");
    EXPECT_EQ(s.shownSettings().view.wireframe, Wireframe::Alone);
    flags.drawVoxels = flags.wireframeVoxels = true;
    s.setFlags(flags, "all");
    EXPECT_EQ(s.shownSettings().view.wireframe, Wireframe::Over);
    EXPECT_EQ(s.shownSettings().component, Component::Voxels);
    EXPECT_EQ(s.shownSettings().view.voxelShape, VoxelShape::Edges);
    flags.drawObjects = false;
    s.setFlags(flags, "no objects");
    EXPECT_EQ(s.shownSettings().view.wireframe, Wireframe::Off);
    EXPECT_EQ(s.settings().view.wireframe, Wireframe::Off);
}

TEST(Session, StartSettingsFollowTheModeUnlessTouched) {
    Scene scene = twoSquares();
    scene.format = "thesis";
    const Camera camera = scene.cameras.front();
    const Settings start = startSettings(scene);
    Session s(std::move(scene), "t.txt", start, "", camera);
    s.setMode("thesis");
    EXPECT_EQ(getSetting(s.settings(), "image.tone_map"), "none");
    s.setSetting("image.srgb", "true");
    s.setMode("cones");
    EXPECT_EQ(getSetting(s.settings(), "image.tone_map"), "aces");
    EXPECT_EQ(getSetting(s.settings(), "image.srgb"), "true");
    EXPECT_EQ(getSetting(s.settings(), "image.exposure"), "auto");
}

TEST(Picker, MeetsTurnedAndMovedSurfaces) {
    Session s = session();
    Picker picker;
    const auto pick = picker.along(s, {0.1f, 0.2f, 5}, {0, 0, -1});
    ASSERT_TRUE(pick);
    EXPECT_EQ(pick->object, "near");
    EXPECT_EQ(pick->material, 0);
    // Plane through (0,0,1) turned by 0.5 rad about y: z = 1 - x tan 0.5.
    EXPECT_NEAR(pick->position.z, 1 - 0.1f * std::tan(0.5f), 1e-5f);
    EXPECT_NEAR(pick->distance, 5 - pick->position.z, 1e-5f);
    EXPECT_NEAR(pick->normal.x, std::sin(0.5f), 1e-5f);
    EXPECT_NEAR(pick->normal.z, std::cos(0.5f), 1e-5f);
}

TEST(Picker, FollowsEditsAndPassesWhatIsNotDrawn) {
    Session s = session();
    Picker picker;
    ASSERT_EQ(picker.along(s, {0, 0, 5}, {0, 0, -1})->object, "near");
    Instance hidden = s.scene().instances[0];
    hidden.visible = false;
    s.setInstances({{0, hidden}}, "hide");
    ASSERT_EQ(picker.along(s, {0, 0, 5}, {0, 0, -1})->object, "far");
    EXPECT_NEAR(picker.along(s, {0, 0, 5}, {0, 0, -1})->distance, 6, 1e-5f);
    Instance moved = s.scene().instances[1];
    moved.worldFromObject[3].x = 10;
    s.setInstances({{1, moved}}, "move");
    EXPECT_FALSE(picker.along(s, {0, 0, 5}, {0, 0, -1}));
    EXPECT_TRUE(picker.along(s, {10, 0, 5}, {0, 0, -1}));
    // From behind: single-sided surfaces are not there.
    EXPECT_FALSE(picker.along(s, {10, 0, -5}, {0, 0, 1}));
}

TEST(Picker, PixelsAndRaysAgree) {
    Session s = session();
    Picker picker;
    // Camera at (0,0,3), 45 degrees: the picture's centre meets the turned square at z = 1.
    const auto centre = picker.atPixel(s, 101, 51, 50, 25);
    ASSERT_TRUE(centre);
    EXPECT_NEAR(centre->position.x, 0, 1e-5f);
    EXPECT_NEAR(centre->distance, 2, 1e-5f);
    // 12 pixels to the left: tan(22.5 deg) * 12 / 25.5 per metre.
    const auto left = picker.atPixel(s, 101, 51, 50 - 5, 25);
    ASSERT_TRUE(left);
    const glm::vec3 d = left->position - s.camera().eye;
    EXPECT_NEAR(d.x / d.z, std::tan(0.39269908f) * 5 / 25.5f, 1e-5f);
    EXPECT_FALSE(picker.atPixel(s, 101, 51, 0, 0));
}

}  // namespace
}  // namespace conelight::program
