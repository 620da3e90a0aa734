// SPDX-License-Identifier: MIT
// Commands that keep things: camera paths, presets, qualities, bakes; and `why`.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "conelight/quality.h"
#include "console_test_support.h"
#include "cpu/io_test_support.h"
#include "io/generated.h"
#include "io/scene_file.h"

namespace conelight::program {
namespace {

using test::ConsoleRig;

std::string fresh(const std::string& name) {
    const std::filesystem::path file = test::folderOf("console_session") / name;
    std::filesystem::remove_all(file);
    return file.string();
}

std::string settingsOf(const Session& session) {
    std::string text = session.mode();
    for (const SettingInfo& info : settingInfos()) text += " " + getSetting(session.settings(), info.key);
    return text;
}

TEST(ConsoleSteps, WhatOnlyAsksEndsNoStepOfUndo) {
    ConsoleRig rig;
    const auto drag = [&](const char* value) { rig.session.setSetting("image.exposure", value, "exposure"); };
    drag("0.1");
    rig.run("echo one; get image.exposure; set image.exposure");
    drag("0.2");
    EXPECT_EQ(rig.session.undoSteps(), 1u);
    rig.run("set voxels.padding 0.5");
    drag("0.3");
    EXPECT_EQ(rig.session.undoSteps(), 3u);
    rig.run("undo");
    drag("0.4");
    EXPECT_EQ(rig.session.undoSteps(), 3u) << "the one that was undone is gone";
    rig.run("set image.exposure 0.5");
    drag("0.6");
    EXPECT_EQ(rig.session.undoSteps(), 5u);
}

TEST(PathCommand, KeysAreAddedListedSavedAndLoaded) {
    ConsoleRig rig;
    const std::string file = fresh("path.json");
    rig.run("camera eye 0 0 3; path add; camera eye 3 0 0; path add; camera eye 0 3 1; path add 5");
    EXPECT_EQ(rig.error(), "");
    ASSERT_EQ(rig.session.cameraPath().keys().size(), 3u);
    EXPECT_EQ(rig.session.cameraPath().keys()[1].seconds, 1);
    EXPECT_EQ(rig.session.cameraPath().keys()[2].seconds, 5);
    EXPECT_EQ(rig.session.cameraPath().keys()[2].camera.eye, glm::vec3(0, 3, 1));
    rig.run("path save " + file);
    rig.lines.clear();
    rig.run("path save " + file);  // there already
    EXPECT_NE(rig.error().find("is there already"), std::string::npos) << rig.error();
    rig.lines.clear();
    rig.run("path save " + file + " overwrite; path clear; path list");
    EXPECT_EQ(rig.error(), "");
    EXPECT_TRUE(rig.session.cameraPath().empty());
    rig.run("path load " + file + "; path remove 1; path list");
    EXPECT_EQ(rig.error(), "");
    ASSERT_EQ(rig.session.cameraPath().keys().size(), 2u);
    EXPECT_NE(rig.lines.back().text.find("5.000 s  eye 0 3 1"), std::string::npos) << rig.lines.back().text;
    rig.run("undo; undo");  // remove, load
    EXPECT_TRUE(rig.session.cameraPath().empty());
    rig.run("redo");
    EXPECT_EQ(rig.session.cameraPath().keys().size(), 3u);
}

TEST(PathCommand, KeysMoveBetweenTheirNeighbours) {
    ConsoleRig rig;
    rig.run("path add 0; path add 1; path add 5; path move 1 3.5");
    EXPECT_EQ(rig.error(), "");
    EXPECT_EQ(rig.session.cameraPath().keys()[1].seconds, 3.5);
    rig.run("path move 2 9; path move 0 0.5; undo");
    EXPECT_EQ(rig.session.cameraPath().start(), 0);
    EXPECT_EQ(rig.session.cameraPath().end(), 9);
    for (const char* time : {"0", "9", "10", "-1", "x"}) {
        rig.lines.clear();
        rig.run(std::string("path move 1 ") + time);
        EXPECT_NE(rig.error(), "") << time;
        EXPECT_EQ(rig.session.cameraPath().keys()[1].seconds, 3.5);
    }
    // A drag stops before its neighbours, and is one step.
    EXPECT_EQ(rig.session.cameraPath().freeTime(1, 20, 0.1), 8.9);
    EXPECT_EQ(rig.session.cameraPath().freeTime(1, -4, 0.1), 0.1);
    EXPECT_EQ(rig.session.cameraPath().freeTime(2, 20, 0.1), 20);
    const std::size_t steps = rig.session.undoSteps();
    for (const double seconds : {4.0, 5.0, 6.0}) {
        CameraPath path = rig.session.cameraPath();
        path.move(1, seconds);
        rig.session.setCameraPath(path, "path move", "path move 1");
    }
    EXPECT_EQ(rig.session.undoSteps(), steps + 1);
}

TEST(PathCommand, TheViewGoesThere) {
    ConsoleRig rig;
    rig.run("camera eye 0 0 3; path add; camera eye 3 0 0; path add");
    rig.run("path at 0.5");
    EXPECT_EQ(rig.error(), "");
    EXPECT_EQ(rig.session.camera().eye, rig.session.cameraPath().at(0.5).eye);
    EXPECT_NEAR(rig.session.camera().eye.x, 1.5, 1e-4);
    rig.run("undo");
    EXPECT_EQ(rig.session.camera().eye, glm::vec3(3, 0, 0));
    // Playing follows drawn frames and holds what comes behind it.
    rig.run("path at 0; path play 0.001; camera fov 30");
    EXPECT_TRUE(rig.session.playing());
    EXPECT_FALSE(rig.console.idle());
    EXPECT_EQ(rig.session.camera().eye, glm::vec3(0, 0, 3));
    for (int frame = 0; frame < 1000000 && rig.session.playing(); ++frame) rig.session.frameDrawn(1);
    EXPECT_FALSE(rig.session.playing());
    EXPECT_EQ(rig.session.camera().eye, glm::vec3(3, 0, 0));
    rig.console.runQueued();
    EXPECT_NEAR(glm::degrees(rig.session.camera().fovY), 30, 1e-4);
    // Flying ends it.
    rig.run("path play 1000");
    Camera flown = rig.session.camera();
    flown.eye.y += 1;
    rig.session.moveCamera(flown);
    EXPECT_FALSE(rig.session.playing());
    EXPECT_EQ(rig.session.camera().eye.y, flown.eye.y);
}

TEST(PathCommand, MistakesAreNamed) {
    for (const char* line :
         {"path at 1", "path play", "path save x.json", "path remove 0", "path move 0 1", "path add x",
          "path add -1", "path add 1 2", "path fly", "path load /nonexistent.json", "record a.mp4 3 path"}) {
        ConsoleRig rig;
        rig.run(line);
        ASSERT_EQ(rig.lines.size(), 1u) << line;
        EXPECT_TRUE(rig.lines[0].isError) << line;
        EXPECT_FALSE(rig.session.hasRequests()) << line;
    }
    EXPECT_FALSE(std::filesystem::exists("x.json"));
}

TEST(PresetCommand, BringsEverySettingBack) {
    const std::string file = fresh("a.json");
    ConsoleRig rig;
    // A preset of a group, and one of its members set to its default again.
    rig.run(
        "mode traced; quality high; set traced.pixel_rays 1; set image.exposure 2.5; set voxels.size 64; "
        "set thesis.diffuse.aperture 0.5; component indirect");
    const std::string before = settingsOf(rig.session);
    rig.run("preset save " + file);
    EXPECT_EQ(rig.error(), "");
    ConsoleRig other;
    other.run("set image.tone_map none; set light.shadow_size 64; preset load " + file);
    EXPECT_EQ(other.error(), "");
    EXPECT_EQ(settingsOf(other.session), before);
    other.run("undo");
    EXPECT_EQ(getSetting(other.session.settings(), "image.tone_map"), "none");
    EXPECT_EQ(other.session.mode(), "thesis");
    // It says what differs, and no more.
    const auto json = nlohmann::json::parse(std::ifstream(file));
    EXPECT_EQ(json["settings"]["mode"], "traced");
    EXPECT_EQ(json["settings"]["image.exposure"], 2.5);
    EXPECT_FALSE(json["settings"].contains("light.shadow_size"));
    // Modes of the CPU too.
    rig.run("mode reference; preset save " + file + " overwrite; mode phong; preset load " + file);
    EXPECT_EQ(rig.session.mode(), "reference");
}

TEST(PresetCommand, ListsPresetsOnly) {
    const std::filesystem::path folder = fresh("list");
    std::filesystem::create_directories(folder);
    ConsoleRig rig;
    rig.run("preset save " + (folder / "b.json").string() + "; preset save " + (folder / "a.json").string());
    rig.run("path add; path save " + (folder / "path.json").string());
    std::ofstream(folder / "broken.json") << "{";
    rig.lines.clear();
    rig.run("preset list " + folder.string());
    ASSERT_EQ(rig.lines.size(), 2u);
    EXPECT_EQ(rig.lines[0].text, (folder / "a.json").string());
    EXPECT_EQ(rig.lines[1].text, (folder / "b.json").string());
    rig.lines.clear();
    rig.run("preset list /nonexistent");
    EXPECT_NE(rig.error().find("/nonexistent"), std::string::npos);
}

TEST(PresetCommand, BadFilesAreRefusedWithTheirLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"{\n\"conelight\": \"preset\",\n\"settings\": {\n\"traced.qualty\": 1}}", ":4: "},
        {"{\n\"conelight\": \"preset\",\n\"settings\": {\n\"traced.qualty\": 1}}", "traced.quality"},
        {"{\"conelight\": \"preset\",\n\"settings\": {\"mode\": \"rays\"}}", ":2: there is no mode 'rays'"},
        {"{\"conelight\": \"preset\",\n\"settings\": {\n\"voxels.size\":\n 7}}", ":3: "},
        {"{\"conelight\": \"preset\",\n\"settings\": {\n\"voxels.size\": [7]}}",
         ":3: voxels.size: [7] is no value"},
        {"{\"conelight\": \"preset\",\n\"settings\": 3}", ":2: settings: "},
        {"{\"conelight\": \"preset\",\n\n\"values\": 3}", ":3: there is no field 'values'"},
        {"{\"conelight\": \"camera path\"}", "is no preset"},
    };
    for (const auto& [text, expected] : cases) {
        const std::string file = fresh("bad.json");
        std::ofstream(file) << text;
        ConsoleRig rig;
        const std::string before = settingsOf(rig.session);
        rig.run("preset load " + file);
        EXPECT_NE(rig.error().find(file + ":"), std::string::npos) << text << "\n" << rig.error();
        EXPECT_NE(rig.error().find(expected), std::string::npos) << text << "\n" << rig.error();
        EXPECT_EQ(settingsOf(rig.session), before);
    }
}

TEST(QualityCommand, SetsWhatTheTableSays) {
    ConsoleRig rig;
    for (const QualityInfo& info : qualityInfos()) {
        rig.run("quality " + info.name);
        const TracedSettings& traced = rig.session.settings().traced;
        EXPECT_EQ(qualityOf(traced), info.quality);
        EXPECT_EQ(2 * traced.pixelRays * traced.passes, info.raysPerPixel) << info.name;
        EXPECT_EQ(getSetting(rig.session.settings(), "traced.quality"), info.name);
    }
    EXPECT_EQ(qualityInfos().size(), settingChoices("traced.quality").size());
    EXPECT_EQ(rig.error(), "");
    rig.run("quality best");
    EXPECT_NE(rig.error().find("draft, interactive, high or converged"), std::string::npos) << rig.error();
}

TEST(BakeCommand, AsksAndRefusesWhatIsThere) {
    ConsoleRig rig;
    const std::string file = fresh("lit.glb");
    rig.run("bake " + file);
    const std::optional<Request> request = rig.session.takeRequest();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->kind, RequestKind::Bake);
    EXPECT_EQ(request->file, file);
    std::ofstream(file) << "not ours";
    rig.run("bake " + file);
    EXPECT_NE(rig.error().find("is there already"), std::string::npos) << rig.error();
    EXPECT_FALSE(rig.session.hasRequests());
    rig.run("bake " + file + " overwrite");
    EXPECT_TRUE(rig.session.hasRequests());
    rig.lines.clear();
    ConsoleRig wrong;
    wrong.run("bake lit.obj");
    EXPECT_NE(wrong.error().find(".glb"), std::string::npos);
}

TEST(SaveCommand, LeavesABufferOfAnotherFileAlone) {
    ConsoleRig rig;
    const std::string file = fresh("room.gltf"), buffer = fresh("room.bin");
    const auto read = [&] {
        std::ostringstream text;
        text << std::ifstream(buffer).rdbuf();
        return text.str();
    };
    std::ofstream(buffer) << "somebody's";
    const std::string before = read();
    rig.run("save " + file);
    EXPECT_NE(rig.error().find("room.bin"), std::string::npos) << rig.error();
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(read(), before);
    rig.lines.clear();
    rig.run("save " + file + " overwrite");
    EXPECT_EQ(rig.error(), "");
    EXPECT_NE(read(), before);
    EXPECT_EQ(io::loadScene(file).instances.size(), 2u);
}

// Each of the four, and that none is told of a scene that has none of them.
TEST(Why, NamesTheCause) {
    const auto reasons = [](const std::string& commands) {
        Session session;
        session.open("builtin:cornell", false);
        std::string text;
        Console console(session, [&](const ConsoleLine& line) { text += line.text + "\n"; });
        console.setStopOnError(true);
        console.submit(commands);
        console.runQueued();
        text.clear();
        console.submit("why");
        console.runQueued();
        EXPECT_FALSE(console.firstError()) << console.firstError()->what();
        return text;
    };
    EXPECT_EQ(reasons("echo as it is").rfind("nothing found", 0), 0u) << reasons("echo as it is");
    EXPECT_EQ(reasons("set image.exposure -20").rfind("exposure: ", 0), 0u);
    EXPECT_EQ(reasons("camera target 0 1 100; camera eye 0 1 50").rfind("camera: nothing is in view", 0), 0u);
}

TEST(Why, ALampThatIsOffOrInsideAndACameraInsideABox) {
    const auto reasons = [](ConsoleRig& rig, const std::string& commands) {
        rig.run(commands);
        EXPECT_EQ(rig.error(), "");
        rig.lines.clear();
        rig.run("why");
        return rig.lines.at(0).text;
    };
    {
        ConsoleRig rig;
        EXPECT_EQ(reasons(rig, "light lamp intensity 0").rfind("light: every lamp is off", 0), 0u);
    }
    {
        ConsoleRig rig;
        EXPECT_EQ(reasons(rig, "light lamp delete").rfind("light: every lamp is off", 0), 0u);
    }
    {
        ConsoleRig rig;  // the view is of the box's front, the lamp behind the lid
        EXPECT_EQ(reasons(rig, "light lamp position 0 0 -20").rfind("light: every lamp shines away", 0), 0u);
    }
    {
        ConsoleRig rig;  // both boxes are seen through their own backs only where that is drawn
        const std::string text =
            reasons(rig, "material white double_sided on; camera target 0 0 -0.2; camera eye 0 0 0");
        EXPECT_EQ(text.rfind("camera: it is inside or right at box", 0), 0u) << text;
    }
    {
        ConsoleRig rig;
        EXPECT_EQ(reasons(rig, "toggle box; toggle lid").rfind("objects: none is visible", 0), 0u);
    }
    {
        ConsoleRig rig;
        EXPECT_EQ(reasons(rig, "objs").rfind("objects: drawing them is off", 0), 0u);
    }
}

TEST(Why, NothingIsVoxelized) {
    Scene scene = test::consoleScene();
    for (Instance& one : scene.instances) one.voxelized = false;
    Session session(scene, "boxes.txt", ConsoleRig::settings(), "", Camera{"main"});
    std::string text;
    Console console(session, [&](const ConsoleLine& line) { text += line.text + "\n"; });
    console.submit("component indirect; why");
    console.runQueued();
    EXPECT_EQ(text.rfind("voxels: no visible object is voxelized", 0), 0u) << text;
}

}  // namespace
}  // namespace conelight::program
