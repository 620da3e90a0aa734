// SPDX-License-Identifier: MIT
// The console: words, errors that name the mistake, completion, history, order of commands and requests.
#include "console/console.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "console_test_support.h"

namespace conelight::program {
namespace {

using test::ConsoleRig;

std::string words(const std::string& text) {
    std::string all;
    for (const Statement& statement : parseStatements(text)) {
        all += fmt::format("{}:", statement.line);
        for (const std::string& word : statement.words) all += "[" + word + "]";
        if (!statement.error.empty()) all += "!";
    }
    return all;
}

TEST(Statements, QuotesSeparatorsAndComments) {
    EXPECT_EQ(words(""), "");
    EXPECT_EQ(words(" ; ;\n#nothing\n"), "");
    EXPECT_EQ(words("a b;c"), "1:[a][b]1:[c]");
    EXPECT_EQ(words("a \"b ; c\" # d ; e\nf"), "1:[a][b ; c]2:[f]");
    EXPECT_EQ(words("toggle 'my box'"), "1:[toggle][my box]");
    EXPECT_EQ(words("x \"a\\\"b\\\\\" '\\'"), "1:[x][a\"b\\][\\]");
    EXPECT_EQ(words("x a#b"), "1:[x][a#b]");
    EXPECT_EQ(words("x \"\""), "1:[x][]");
    EXPECT_EQ(words("a\r\nb"), "1:[a]2:[b]");
    EXPECT_EQ(words("a 'b\nc"), "1:[a][b]!2:[c]");
}

TEST(Statements, QuotedReadsBack) {
    for (const std::string word : {"a", "", "my box", "#1", "a;b", "say \"hi\"", "back\\slash", "it's"}) {
        const auto statements = parseStatements("x " + quoted(word));
        ASSERT_EQ(statements.size(), 1u) << word;
        ASSERT_EQ(statements[0].words.size(), 2u) << word;
        EXPECT_EQ(statements[0].words[1], word);
    }
}

TEST(ConsoleErrors, NameTheMistakeAndWhatWouldBeRight) {
    const std::pair<const char*, const char*> cases[] = {
        {"togle box", "unknown command 'togle'; toggle would be right"},
        {"TOGGLE box", "toggle would be right"},
        {"zzzzzz", "unknown command 'zzzzzz'; `help` lists all"},
        {"toggle", "toggle: takes 1 argument, got 0; toggle OBJECT would be right"},
        {"toggle box lid", "got 2"},
        {"toggle boxx", "there is no object 'boxx'; box would be right"},
        {"toggle qqqqqq", "box, lid would be right"},
        {"scale box big", "FACTOR: 'big' is not a number"},
        {"scale box 0", "0.0001 to 10000"},
        {"translate box w 1", "AXIS: 'w' is not usable; x, y or z"},
        {"sf 1 2", "got 2; sf, or shininess_falloff [VALUE]"},
        {"set voxel.size 64", "voxels.size"},
        {"set voxels.size", "set voxels.size VALUE"},
        {"set voxels.size 63", "multiple of 4"},
        {"get voxel.size", "voxels.size"},
        {"mode conez", "there is no mode 'conez'"},
        {"camera nobody", "there is no camera 'nobody'; main"},
        {"camera eye 1 2", "takes 3 numbers, got 2; camera eye X Y Z"},
        {"camera eye 0 0 0", "same point"},
        {"camera fov 200", "1 to 170 deg"},
        {"light lampe on", "lamp would be right"},
        {"light lamp bright 3", "there is no property 'bright'"},
        {"light lamp intensity 1 2", "takes 3 numbers, got 2"},
        {"light lamp size 1 1", "a point light has none"},
        {"light lamp flux -1", "0 to 1e+09 W would be right"},
        {"light add bulb", "point, spot, directional, rect, disk or sphere"},
        {"material whit roughness 1", "white would be right"},
        {"material white rough 1", "roughness would be right"},
        {"material white roughness 2", "0 to 1"},
        {"material white transmission 2", "0 to 1"},
        {"material white attenuation_color 0", "0.0001 to 1"},
        {"select nobody", "there is no object, light or material 'nobody'"},
        {"echo \"open", "never closed"},
        {"undo", "nothing to undo"},
        {"redo", "nothing to redo"},
        {"source /nonexistent.txt", "/nonexistent.txt"},
        {"screenshot picture.tiff", ".png"},
        {"screenshot /nonexistent/a.png", "/nonexistent"},
        {"record film.txt 3", ".mp4"},
        {"quit 300", "0 to 125"},
        {"save scene.obj", ".txt"},
        {"help togle", "toggle would be right"},
    };
    for (const auto& [line, part] : cases) {
        ConsoleRig rig;
        rig.run(line);
        ASSERT_EQ(rig.lines.size(), 1u) << line;
        EXPECT_TRUE(rig.lines[0].isError) << line;
        EXPECT_NE(rig.lines[0].text.find(part), std::string::npos) << line << " -> " << rig.lines[0].text;
        EXPECT_EQ(rig.session.undoSteps(), 0u) << line;
        EXPECT_FALSE(rig.session.hasRequests()) << line;
    }
}

TEST(Console, ScriptsNameTheirLineAndStopWhenAsked) {
    ConsoleRig rig;
    rig.console.submit("echo one\n\ntogle\necho two", "job.txt");
    rig.console.runQueued();
    EXPECT_EQ(rig.lines.size(), 3u);
    EXPECT_EQ(rig.error().rfind("job.txt:3: ", 0), 0u) << rig.error();
    rig.lines.clear();
    rig.console.setStopOnError(true);
    rig.console.submit("togle; echo never", "--exec");
    rig.console.runQueued();
    EXPECT_EQ(rig.lines.size(), 1u);
    ASSERT_TRUE(rig.console.firstError());
    EXPECT_EQ(rig.console.firstError()->kind(), ErrorKind::Usage);
}

TEST(Console, CommandsWaitForTheWorkTheyAskedFor) {
    ConsoleRig rig;
    rig.run("wait 2; mode phong");
    EXPECT_EQ(rig.session.mode(), "thesis");
    rig.console.frameDone();
    rig.console.runQueued();
    EXPECT_EQ(rig.session.mode(), "thesis");
    rig.console.frameDone();
    rig.console.runQueued();
    EXPECT_EQ(rig.session.mode(), "phong");
    const std::string file = testing::TempDir() + "/shot.png";
    rig.run("screenshot '" + file + "'; mode cones");
    EXPECT_EQ(rig.session.mode(), "phong");
    EXPECT_EQ(rig.session.takeRequest()->file, file);
    rig.console.runQueued();
    EXPECT_EQ(rig.session.mode(), "cones");
    rig.run("quit 3");
    EXPECT_EQ(rig.session.takeRequest()->status, 3);
}

TEST(Console, SourceRunsInPlaceAndEndsCircles) {
    const std::string file = testing::TempDir() + "/inner.conelight";
    std::ofstream(file) << "# a script\nimage\nset image.exposure 2; echo inner\n";
    ConsoleRig rig;
    rig.run("source '" + file + "'; echo outer");
    ASSERT_EQ(rig.lines.size(), 3u);
    EXPECT_NE(rig.lines[0].text.find(file + ":2: unknown command"), std::string::npos);
    EXPECT_EQ(rig.lines[1].text, "inner");
    EXPECT_EQ(rig.lines[2].text, "outer");
    EXPECT_EQ(getSetting(rig.session.settings(), "image.exposure"), "2");
    std::ofstream(file) << "source '" << file << "'\n";
    rig.lines.clear();
    rig.run("source '" + file + "'");
    ASSERT_EQ(rig.lines.size(), 1u);
    EXPECT_NE(rig.lines[0].text.find("16 deep"), std::string::npos) << rig.lines[0].text;
}

TEST(Console, SurroundingsAndFluxAreSetAndTakenBack) {
    ConsoleRig rig;
    rig.run("light lamp flux 12.566371; environment 'builtin:sky?hour=9' 30 2");
    EXPECT_EQ(rig.error(), "");
    EXPECT_NEAR(rig.session.scene().lights[0].intensity.g, 1, 1e-6f);
    ASSERT_TRUE(rig.session.scene().environment.used());
    EXPECT_NEAR(rig.session.scene().environment.rotation, 0.5235988f, 1e-6f);
    EXPECT_EQ(rig.session.scene().environment.strength, 2);
    // Another sky takes the first one's sun away with it.
    ASSERT_EQ(rig.session.scene().lights.size(), 2u);
    rig.run("environment builtin:sky");
    EXPECT_EQ(rig.session.scene().lights.size(), 2u);
    rig.run("environment none");
    EXPECT_EQ(rig.session.scene().lights.size(), 1u);
    EXPECT_FALSE(rig.session.scene().environment.used());
    rig.run("undo");
    EXPECT_TRUE(rig.session.scene().environment.used());
    EXPECT_EQ(rig.session.scene().lights.size(), 2u);
    rig.run("light lamp falloff 1 0 1; light lamp flux 1");
    EXPECT_NE(rig.error().find("no physical unit"), std::string::npos) << rig.error();
}

TEST(Console, MaterialsBecomeGlass) {
    ConsoleRig rig;
    rig.run(
        "material blue transmission 0.9; material blue thickness 0.5; material blue attenuation_color 0.2 1 "
        "0.5;"
        "material blue attenuation_distance 3");
    EXPECT_EQ(rig.error(), "");
    const Material& glass = rig.session.scene().materials[1];
    EXPECT_EQ(glass.transmission, 0.9f);
    EXPECT_EQ(glass.thickness, 0.5f);
    EXPECT_EQ(glass.attenuationColor, glm::vec3(0.2f, 1, 0.5f));
    EXPECT_EQ(glass.attenuationDistance, 3.0f);
    rig.run("material blue");
    bool told = false;
    for (const auto& line : rig.lines)
        told |= line.text.find("transmission 0.9  thickness 0.5 m") != std::string::npos;
    EXPECT_TRUE(told);
    for (int i = 0; i < 4; ++i) rig.run("undo");
    EXPECT_EQ(rig.session.scene().materials[1].transmission, 0.0f);
}

TEST(Console, MaterialsGetCoatAndSheen) {
    ConsoleRig rig;
    rig.run(
        "material blue coat 0.75; material blue coat_roughness 0.1; material blue sheen 0.2 0.3 0.4;"
        "material blue sheen_roughness 0.5");
    EXPECT_EQ(rig.error(), "");
    const Material& m = rig.session.scene().materials[1];
    EXPECT_EQ(m.coat, 0.75f);
    EXPECT_EQ(m.coatRoughness, 0.1f);
    EXPECT_EQ(m.sheenColor, glm::vec3(0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.sheenRoughness, 0.5f);
    const auto tells = [&](const char* what) {
        rig.lines.clear();
        rig.run("material blue");
        return std::any_of(rig.lines.begin(), rig.lines.end(),
                           [&](const auto& line) { return line.text.find(what) != std::string::npos; });
    };
    EXPECT_TRUE(tells("coat 0.75  coat_roughness 0.1"));
    EXPECT_FALSE(tells("not shown"));
    rig.run("material blue transmission 1");
    EXPECT_TRUE(tells("not shown"));
    for (int i = 0; i < 5; ++i) rig.run("undo");
    EXPECT_EQ(rig.session.scene().materials[1].coat, 0.0f);
    rig.run("material blue coat 2");
    EXPECT_NE(rig.error().find("0 to 1"), std::string::npos);
}

TEST(Console, EditsCanBeTakenBack) {
    ConsoleRig rig;
    rig.run(
        "set image.exposure=1; material blue roughness 0.3; light add spot extra; light extra angles 10 20;"
        "sky 1 2 3; camera fov 60; translate lid x 4; light lamp delete");
    EXPECT_EQ(rig.error(), "");
    EXPECT_EQ(rig.session.undoSteps(), 8u);
    EXPECT_EQ(rig.session.scene().lights.size(), 1u);
    EXPECT_NEAR(rig.session.scene().lights[0].outerAngle, 0.34906585f, 1e-6f);
    EXPECT_EQ(rig.session.scene().sky, glm::vec3(1, 2, 3));
    EXPECT_EQ(rig.session.scene().materials[1].roughness, 0.3f);
    for (int i = 0; i < 8; ++i) rig.run("undo");
    EXPECT_EQ(rig.session.scene().lights.size(), 1u);
    EXPECT_EQ(rig.session.scene().lights[0].name, "lamp");
    EXPECT_EQ(rig.session.scene().sky, glm::vec3(0));
    EXPECT_EQ(rig.session.scene().materials[1].roughness, 1.0f);
    EXPECT_EQ(rig.session.camera().fovY, Camera{}.fovY);
    EXPECT_EQ(getSetting(rig.session.settings(), "image.exposure"), "0");
    rig.run("redo; get image.exposure");
    EXPECT_NE(rig.lines[rig.lines.size() - 2].text.find("image.exposure = 1"), std::string::npos);
}

TEST(Console, ResetGoesBackToTheStart) {
    ConsoleRig rig;
    rig.run("set image.exposure 1; set thesis.phong false; reset image.; get image.exposure");
    EXPECT_EQ(getSetting(rig.session.settings(), "image.exposure"), "0");
    EXPECT_EQ(getSetting(rig.session.settings(), "thesis.phong"), "false");
    rig.run("reset");
    EXPECT_EQ(getSetting(rig.session.settings(), "thesis.phong"), "true");
    EXPECT_EQ(rig.session.mode(), "thesis");
}

TEST(Console, CameraOrbitsAndFrames) {
    ConsoleRig rig;
    rig.run("camera orbit 90");
    EXPECT_NEAR(rig.session.camera().eye.x, 3, 1e-5f);
    EXPECT_NEAR(rig.session.camera().eye.z, 0, 1e-5f);
    rig.run("camera orbit 0 30");
    EXPECT_NEAR(rig.session.camera().eye.y, 1.5f, 1e-5f);
    rig.run("camera orbit 0 500");
    EXPECT_NEAR(rig.session.camera().eye.y, 3 * std::sin(1.5533430f), 1e-4f);
    rig.run("camera frame lid");
    EXPECT_EQ(rig.session.camera().target, glm::vec3(0, 0, -2));
    rig.run("camera main");
    EXPECT_EQ(rig.session.camera().eye, glm::vec3(0, 0, 3));
}

TEST(Console, ObjectsLookAtAPointAndGoBackToTheOrigin) {
    ConsoleRig rig;
    const auto placed = [&] { return rig.session.scene().instances[1].worldFromObject; };
    rig.run("scale lid 0.5");
    rig.run("look_at lid 4 0 -2");  // from (0, 0, -2): along +x
    EXPECT_EQ(rig.error(), "");
    EXPECT_NEAR(glm::distance(glm::vec3(placed()[2]), glm::vec3(0.5f, 0, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::vec3(placed()[1]), glm::vec3(0, 0.5f, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::determinant(glm::mat3(placed())), 0.125, 1e-6);  // not mirrored
    EXPECT_EQ(glm::vec3(placed()[3]), glm::vec3(0, 0, -2));
    rig.run("look_at lid 0 9 -2");  // straight up: some turn, of the same size
    EXPECT_NEAR(glm::distance(glm::vec3(placed()[2]), glm::vec3(0, 0.5f, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::determinant(glm::mat3(placed())), 0.125, 1e-6);
    rig.run("reset_place lid");
    EXPECT_EQ(placed(), glm::mat4(1));
    rig.run("undo");
    EXPECT_NE(placed(), glm::mat4(1));
    rig.run("look_at nobody 0 0 0");
    EXPECT_NE(rig.error().find("nobody"), std::string::npos);
}

TEST(Console, HelpKnowsEveryCommandAndAlias) {
    ConsoleRig rig;
    rig.run("help");
    std::string all;
    for (const ConsoleLine& line : rig.lines) all += line.text + "\n";
    for (const std::string& word : commandWords()) {
        rig.lines.clear();
        rig.run("help " + word);
        ASSERT_GE(rig.lines.size(), 2u) << word;
        EXPECT_EQ(rig.error(), "");
        EXPECT_NE(all.find("  " + commandsNamed(word).front()->usage()), std::string::npos) << word;
    }
}

std::string joined(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& one : list) text += (text.empty() ? "" : " ") + one;
    return text;
}

TEST(Completion, OffersWhatFits) {
    ConsoleRig rig;
    const std::pair<const char*, const char*> cases[] = {
        {"tog", "toggle"},
        {"toggle ", "box lid"},
        {"toggle b", "box"},
        {"echo x; toggle l", "lid"},
        {"mode th", "thesis"},
        {"set image.s", "image.srgb"},
        {"set image.srgb ", "true false"},
        {"set image.tone_map ", "none reinhard aces agx neutral"},
        {"set cones.max_distance ", "auto"},
        {"translate box ", "x y z"},
        {"camera m", "main"},
        {"light la", "lamp"},
        {"light lamp int", "intensity"},
        {"material bl", "blue"},
        {"open builtin:cornell-p", "builtin:cornell-point"},
        {"setmat box sh", "shininess"},
        {"help tog", "toggle"},
        {"toggle box ", ""},
        {"nothing ", ""},
    };
    for (const auto& [text, expected] : cases) {
        const Completion completion = rig.console.complete(text, std::string(text).size());
        EXPECT_EQ(joined(completion.candidates), expected) << text;
    }
    const Completion middle = rig.console.complete("toggle b x", 8);
    EXPECT_EQ(middle.begin, 7u);
    EXPECT_EQ(middle.end, 8u);
    EXPECT_EQ(rig.console.complete("vox_s", 5).common, "vox_s");
}

TEST(Completion, QuotesNamesWithSpacesAndListsFiles) {
    ConsoleRig rig;
    Instance named = rig.session.scene().instances[0];
    named.name = "my box";
    rig.session.setInstances({{0, named}}, "name");
    EXPECT_EQ(joined(rig.console.complete("toggle my", 9).candidates), "\"my box\"");
    const std::string folder = testing::TempDir() + "/completion";
    std::filesystem::create_directories(folder + "/inner");
    std::ofstream(folder + "/in.txt") << "x";
    const std::string text = "load " + folder + "/in";
    EXPECT_EQ(joined(rig.console.complete(text, text.size()).candidates),
              folder + "/in.txt " + folder + "/inner/");
}

TEST(History, WalksThroughWhatBeginsAlike) {
    History history;
    for (const char* line : {"mode phong", "echo a", "mode cones", "mode cones"}) history.add(line);
    EXPECT_EQ(history.lines().size(), 3u);
    EXPECT_EQ(history.back("mo"), "mode cones");
    EXPECT_EQ(history.back("mode cones"), "mode phong");
    EXPECT_EQ(history.back("mode phong"), "mode phong");
    EXPECT_EQ(history.forward("mode phong"), "mode cones");
    EXPECT_EQ(history.forward("mode cones"), "mo");
    EXPECT_EQ(history.back(""), "mode cones");
    EXPECT_EQ(history.back("mode cones"), "echo a");
}

}  // namespace
}  // namespace conelight::program
