// SPDX-License-Identifier: MIT
// Films along key frames and round the scene, presets from files, baking by command, and what is said of a
// black picture.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "support/gl_fixture.h"
#include "support/program.h"

namespace conelight::test {
namespace {

const std::string kSmall = " --size 48x32 --voxels 32 ";

CommandResult render(const std::string& more, const std::string& environment = "") {
    return conelight("render builtin:cornell" + kSmall + more, environment);
}

std::string file(const std::string& name) {
    const std::string path = scratchPath("film_" + name);
    std::filesystem::remove_all(path);
    return path;
}

// Three keys, one second apart and two.
std::string keys() {
    const std::string path = file("path.json");
    std::ofstream(path) << R"({
  "conelight": "camera path",
  "keys": [
    {"time": 0, "eye": [0, 0.5, 1.94], "target": [0, 0.5, 0]},
    {"time": 1, "eye": [0.5, 0.75, 1.5], "target": [0, 0.4, 0], "fov": 40},
    {"time": 3, "eye": [-0.5, 0.5, 1.75], "target": [0.2, 0.5, 0]}
  ]
})";
    return path;
}

class FilmTest : public GlTest {};

TEST_F(FilmTest, FramesAreStillsAlongThePathBitForBit) {
    const std::string path = keys();
    const std::string frames = scratchPath("film_a%02d.exr"), again = scratchPath("film_b%02d.exr");
    const CommandResult film =
        render("--mode traced --quality draft --path " + path + " --frames 4 -o " + frames);
    ASSERT_EQ(film.status, 0) << film.output;
    const CommandResult byCommand =
        render("--mode traced --quality draft --exec 'path load " + path + "; record " + again + " 4 path'");
    ASSERT_EQ(byCommand.status, 0) << byCommand.output;
    for (int i = 0; i < 4; ++i) {
        const std::string number = "0" + std::to_string(i) + ".exr", still = file("still.exr");
        ASSERT_EQ(render("--mode traced --quality draft --exec 'path load " + path + "; path at " +
                         std::to_string(i) + "' -o " + still)
                      .status,
                  0);
        const std::string frame = bytesOf(scratchPath("film_a" + number));
        EXPECT_FALSE(frame.empty());
        EXPECT_TRUE(frame == bytesOf(still)) << i;
        EXPECT_TRUE(frame == bytesOf(scratchPath("film_b" + number))) << i;
    }
    EXPECT_TRUE(bytesOf(scratchPath("film_a00.exr")) != bytesOf(scratchPath("film_a02.exr")));
    EXPECT_FALSE(std::filesystem::exists(scratchPath("film_a04.exr")));
    // A key is the camera that the options would give.
    const std::string key = file("key.exr");
    ASSERT_EQ(
        render("--mode traced --quality draft --eye 0.5,0.75,1.5 --target 0,0.4,0 --fov 40 -o " + key).status,
        0);
    EXPECT_TRUE(bytesOf(scratchPath("film_a01.exr")) == bytesOf(key));
}

TEST_F(FilmTest, FilmsHaveTheLengthOfThePathOrTheFramesAskedFor) {
    const std::string folder = file("bin");
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/ffmpeg") << "#!/bin/sh\nfor f; do :; done\ncat > \"$f\"\n";
    std::filesystem::permissions(folder + "/ffmpeg", std::filesystem::perms::owner_all);
    const std::string environment = "PATH=" + folder + ":$PATH", film = file("film.mp4");
    const std::size_t frame = 48 * 32 * 3;
    ASSERT_EQ(render("--mode phong --path " + keys() + " -o " + film, environment).status, 0);
    EXPECT_EQ(std::filesystem::file_size(film), 91 * frame);  // 3 s, both ends
    ASSERT_EQ(render("--mode phong --turntable --frames 5 -o " + film, environment).status, 0);
    EXPECT_EQ(std::filesystem::file_size(film), 5 * frame);
}

TEST_F(FilmTest, FfmpegWritesFilmsThatPlay) {
    if (runCommand("ffprobe -version").status != 0)
        GTEST_SKIP() << "no ffmpeg (scripts/install_packages --film)";
    const std::string film = file("plays.mp4");
    const CommandResult written = render("--mode phong --turntable --frames 5 -o " + film);
    ASSERT_EQ(written.status, 0) << written.output;
    const CommandResult probed = runCommand(
        "ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,nb_read_frames -of "
        "csv=p=0 " +
        film);
    EXPECT_EQ(probed.output.substr(0, probed.output.find_last_not_of('\n') + 1), "h264,48,32,5");
}

TEST_F(FilmTest, WhatDoesNotFitIsRefused) {
    const std::string path = keys(), film = file("never.mp4");
    expectOneLine(render("--frames 3 -o " + file("a.png")), 2, "--frames: belongs to --path");
    expectOneLine(render("-o " + film), 2, "a film needs --path FILE or --turntable");
    expectOneLine(render("--path " + path + " -o " + file("a.png")), 2, "frame%04d.png");
    expectOneLine(render("--path " + path), 2, "no --output");
    expectOneLine(render("--turntable --path " + path + " -o " + film), 2, "one would be right");
    expectOneLine(render("--turntable --stats " + file("a.json") + " -o " + film), 2,
                  "--stats: is of one picture");
    expectOneLine(render("--path /nonexistent.json -o " + film), 3, "/nonexistent.json");
    std::ofstream(path) << "{\"conelight\": \"camera path\",\n\"keys\": [7]}";
    expectOneLine(render("--path " + path + " -o " + film), 3, path + ":2: key 0 is no object");
    EXPECT_FALSE(std::filesystem::exists(film));
}

TEST_F(FilmTest, APresetDrawsWhatItsSettingsDraw) {
    const std::string preset = file("preset.json"), a = file("a.exr"), b = file("b.exr");
    const std::string settings =
        "--mode cones --set cones.bounces=1 --set image.exposure=1 --set cones.step=0.5";
    ASSERT_EQ(render(settings + " --component indirect --exec 'preset save " + preset + "' -o " + a).status,
              0);
    ASSERT_EQ(conelight("render builtin:cornell --size 48x32 --preset " + preset + " -o " + b).status, 0);
    EXPECT_TRUE(bytesOf(a) == bytesOf(b));
    // Options come after it.
    const std::string c = file("c.exr");
    ASSERT_EQ(render(settings + " --set cones.bounces=2 --component indirect -o " + a).status, 0);
    ASSERT_EQ(
        conelight("render builtin:cornell --size 48x32 --preset " + preset + " --set cones.bounces=2 -o " + c)
            .status,
        0);
    EXPECT_TRUE(bytesOf(a) == bytesOf(c));
    std::ofstream(preset) << "{\"conelight\": \"preset\",\n\"settings\": {\n\"cones.setp\": 1}}";
    expectOneLine(render("--preset " + preset + " -o " + file("never.png")), 3, preset + ":3: ");
    expectOneLine(conelight("bench builtin:cornell --frames 1 --preset " + preset), 3, "cones.setp");
    expectOneLine(conelight("compare builtin:cornell --preset " + preset), 3, "cones.setp");
}

TEST_F(FilmTest, TheConsoleBakesWhatTheOptionBakes) {
    const std::string options =
        "--mode radiosity --patch 0.8 --subdivide 0 --gather-rays 16 --visibility-rays 16 ";
    const std::string a = file("a.glb"), b = file("b.glb");
    ASSERT_EQ(render(options + "--bake " + a).status, 0);
    const CommandResult baked = render(options + "--exec 'bake " + b + "'");
    ASSERT_EQ(baked.status, 0) << baked.output;
    EXPECT_GT(bytesOf(a).size(), 1000u);
    EXPECT_TRUE(bytesOf(a) == bytesOf(b));
    expectOneLine(render("--exec 'bake " + b + "'"), 2, "is there already");
    // The scene as it was edited, not as it was read.
    ASSERT_EQ(render(options + "--exec 'material red color 0 0 1; bake " + b + " overwrite'").status, 0);
    EXPECT_TRUE(bytesOf(a) != bytesOf(b));
    std::ofstream(file("c.bin")) << "another's";
    expectOneLine(render(options + "--bake " + file("c.gltf")), 2, "film_c.bin");
    EXPECT_EQ(bytesOf(scratchPath("film_c.bin")), "another's");
}

TEST_F(FilmTest, ABlackPictureSaysWhy) {
    const std::pair<const char*, const char*> cases[] = {
        {"--exec 'list lights; mode phong' --set image.exposure=-20", "exposure: "},
        {"--eye 0,1,50 --target 0,1,100", "camera: nothing is in view"},
        {"--exec 'material lamp emission 0'", "light: every lamp is off or dark"},
        {"--component direct --exec 'material white double_sided on' --eye -0.166,0.3,-0.129 --target "
         "-0.166,0.3,0",
         "camera: it is inside or right at tall block"},
    };
    for (const auto& [options, reason] : cases) {
        const CommandResult result =
            render(std::string(options) + " --quality draft -o " + file("black.png"));
        EXPECT_EQ(result.status, 0) << result.output;
        EXPECT_NE(result.output.find(std::string("conelight: the picture is black: ") + reason),
                  std::string::npos)
            << options << "\n"
            << result.output;
    }
    // What is offered helps, and then nothing is said.
    const CommandResult dark = render("--quality draft --set image.exposure=-20 -o " + file("black.png"));
    const std::size_t at = dark.output.find("--set image.exposure=");
    ASSERT_NE(at, std::string::npos) << dark.output;
    const std::string remedy = dark.output.substr(at, dark.output.find(')', at) - at);
    EXPECT_EQ(render("--quality draft " + remedy + " -o " + file("bright.png")).output, "");
    EXPECT_EQ(render("--quality draft -o " + file("plain.png")).output, "");
}

// Every command of the page, in its order, in an empty folder; what it says the program prints is printed.
TEST_F(FilmTest, TheFirstTenMinutesWorkAsWritten) {
    const std::string folder = file("first");
    std::filesystem::create_directories(folder);
    std::ifstream page(std::string(CONELIGHT_SOURCE_DIR) + "/docs/guide/first_ten_minutes.md");
    ASSERT_TRUE(page);
    std::string line, output;
    int commands = 0, expectations = 0;
    while (std::getline(page, line)) {
        if (line.rfind("    conelight: ", 0) == 0) {
            const std::string shown = line.substr(4, line.find(" ...") - 4);
            EXPECT_NE(output.find(shown), std::string::npos) << line << "\nin\n" << output;
            ++expectations;
        }
        if (line.rfind("    conelight ", 0) != 0 || line.rfind("    conelight view", 0) == 0) continue;
        const CommandResult result = runCommand("cd '" + folder + "' && '" + CONELIGHT_PROGRAM + "'" +
                                                line.substr(13) + " </dev/null");
        EXPECT_EQ(result.status, 0) << line << "\n" << result.output;
        output = result.output;
        ++commands;
    }
    EXPECT_GE(commands, 10);
    EXPECT_GE(expectations, 4);
    for (const char* name : {"first.png", "room.glb", "lit.glb", "look.json", "way.json", "walk00.png"})
        EXPECT_TRUE(std::filesystem::exists(folder + "/" + name)) << name;
}

}  // namespace
}  // namespace conelight::test
