// SPDX-License-Identifier: MIT
// Films along key frames and round the scene, presets from files, baking by command, and what is said of a
// black picture.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/gl_fixture.h"
#include "support/moving_scene.h"
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

TEST_F(FilmTest, FramesOfAClipAreStillsOfItsPoses) {
    const std::string moving = risingBlock("film_moving.gltf"),
                      placed = risingBlock("film_placed.gltf", {0, 0.25f, 0});
    // In mode traced light is carried from frame to frame: like a still, not bit for bit.
    for (const char* mode : {"cones", "reference --spp 4"}) {
        const std::string options = kSmall + "--aa 0 --mode " + mode + " -o ";
        const CommandResult film = conelight("render '" + moving + "' --animate rise --fps 2" + options +
                                             scratchPath("film_c%02d.png"));
        ASSERT_EQ(film.status, 0) << film.output;
        EXPECT_EQ(film.output.find("left out"), std::string::npos) << film.output;
        const std::string still = file("posed.png");
        ASSERT_EQ(conelight("render '" + placed + "'" + options + still).status, 0);
        EXPECT_TRUE(pixelsOf(scratchPath("film_c01.png")) == pixelsOf(still)) << mode;
        EXPECT_TRUE(pixelsOf(scratchPath("film_c00.png")) != pixelsOf(still)) << mode;
        EXPECT_TRUE(std::filesystem::exists(scratchPath("film_c02.png")));
        EXPECT_FALSE(std::filesystem::exists(scratchPath("film_c03.png")));
    }
    // A part of it, numbered as in the whole.
    ASSERT_EQ(conelight("render '" + moving + "' --animate 0 --fps 2 --frames 1-1 --mode cones --aa 0" +
                        kSmall + "-o " + scratchPath("film_d%02d.png"))
                  .status,
              0);
    EXPECT_FALSE(std::filesystem::exists(scratchPath("film_d00.png")));
    const std::string still = file("cones.png");
    ASSERT_EQ(conelight("render '" + placed + "' --mode cones --aa 0" + kSmall + "-o " + still).status, 0);
    EXPECT_TRUE(pixelsOf(scratchPath("film_d01.png")) == pixelsOf(still));
}

// Hours of the path go to the generated sky and to the town; a scene with neither is refused.
TEST_F(FilmTest, AKeySetsTheHourOfTheDay) {
    const std::string path = file("day.json");
    std::ofstream(path) << R"({"conelight": "camera path", "keys": [
        {"hour": 9, "eye": [20, 3, 1], "target": [0, 2, 0]},
        {"hour": 23, "eye": [20, 3, 1], "target": [0, 2, 0]}]})";
    const std::string eye = " --eye 20,3,1 --target 0,2,0 --fov 45", look = " --mode phong --aa 0" + kSmall;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"builtin:furnace --environment 'builtin:sky?day=100&hour=", "'"},
        {"'builtin:town?size=180&hour=", "' --component emission"}};
    for (const auto& [scene, end] : cases) {
        const CommandResult film = conelight("render " + scene + "3" + end + look + "--path " + path +
                                             " --frames 3 -o " + scratchPath("film_day%02d.exr"));
        ASSERT_EQ(film.status, 0) << film.output;
        for (const auto& [frame, hour] : {std::pair("00", "9"), std::pair("02", "23")}) {
            const std::string still = file("hour.exr");
            ASSERT_EQ(conelight("render " + scene + hour + end + look + eye + " -o " + still).status, 0);
            EXPECT_TRUE(pixelsOf(scratchPath(std::string("film_day") + frame + ".exr")) == pixelsOf(still))
                << scene << hour;
        }
        EXPECT_TRUE(pixelsOf(scratchPath("film_day00.exr")) != pixelsOf(scratchPath("film_day02.exr")));
    }
    expectOneLine(conelight("render builtin:furnace" + look + "--path " + path + " -o " +
                            scratchPath("film_day%02d.exr")),
                  2, "builtin:sky");
}

TEST_F(FilmTest, PartsOfAFilmAreItsFrames) {
    const std::string path = keys();
    for (const std::string& how : {"--path " + path, std::string("--turntable")}) {
        const std::string all = scratchPath("film_f%02d.png"), part = scratchPath("film_g%02d.png");
        ASSERT_EQ(render("--mode phong --frames 5 " + how + " -o " + all).status, 0);
        const std::string outside = file("g01.png");
        const CommandResult parted = render("--mode phong --frames 2-3/5 " + how + " -o " + part);
        ASSERT_EQ(parted.status, 0) << parted.output;
        for (const char* number : {"02.png", "03.png"})
            EXPECT_EQ(bytesOf(scratchPath("film_g" + std::string(number))),
                      bytesOf(scratchPath("film_f" + std::string(number))))
                << how;
        EXPECT_NE(bytesOf(scratchPath("film_g02.png")), bytesOf(scratchPath("film_g03.png")));
        EXPECT_FALSE(std::filesystem::exists(outside));
    }
    expectOneLine(render("--turntable --frames 118-130 -o " + scratchPath("film_h%02d.png")), 2,
                  "120 frames");
    expectOneLine(render("--turntable --frames 3-5/5 -o " + scratchPath("film_h%02d.png")), 2, "FIRST-LAST");
}

TEST_F(FilmTest, FramesHaveLayersOfTheirOwn) {
    const std::string path = keys();
    const CommandResult film = render("--mode phong --frames 1-2/4 --aov albedo,depth --path " + path +
                                      " -o " + scratchPath("film_n%02d.exr"));
    ASSERT_EQ(film.status, 0) << film.output;
    const std::string still = file("still_layers.exr");
    ASSERT_EQ(render("--mode phong --aov albedo,depth --exec 'path load " + path + "; path at 1' -o " + still)
                  .status,
              0);
    const std::vector<float> frame = pixelsOf(scratchPath("film_n01.exr"));
    EXPECT_EQ(frame.size(), 3u * 3u * 48u * 32u);
    EXPECT_TRUE(frame == pixelsOf(still));
    EXPECT_TRUE(frame != pixelsOf(scratchPath("film_n02.exr")));
    for (const char* name : {"film_n%02d.png", "film_n.mp4"})
        expectOneLine(render("--turntable --frames 2 --aov depth -o " + scratchPath(name)), 2,
                      "frame%04d.exr");
}

TEST_F(FilmTest, APartOfAClipLooksThroughItsCamera) {
    const std::string moving = risingBlock("film_flight.gltf", {}, "front");
    const std::string options = kSmall + "--aa 0 --mode phong --animate rise --fps 2 -o ";
    ASSERT_EQ(conelight("render '" + moving + "'" + options + scratchPath("film_k%02d.png")).status, 0);
    ASSERT_EQ(
        conelight("render '" + moving + "' --frames 1-1" + options + scratchPath("film_l%02d.png")).status,
        0);
    EXPECT_NE(bytesOf(scratchPath("film_k01.png")), bytesOf(scratchPath("film_k00.png")));
    EXPECT_EQ(bytesOf(scratchPath("film_k01.png")), bytesOf(scratchPath("film_l01.png")));
}

TEST_F(FilmTest, MovingVerticesAreDrawnWhereTheyAre) {
    const std::string growing = growingBlock("film_growing.gltf"),
                      placed = risingBlock("film_raised.gltf", {0, 0.25f, 0});
    // In mode traced, what the cache has learnt at rest is carried on: it is near the still, no more.
    for (const auto& [mode, bar] :
         {std::pair<std::string, double>{"reference --spp 16", 0.01}, {"cones", 0.01}, {"traced", 0.03}}) {
        const std::string options = kSmall + "--aa 0 --mode " + mode + " -o ";
        const CommandResult film = conelight("render '" + growing + "' --animate rise --fps 2" + options +
                                             scratchPath("film_m%02d.exr"));
        ASSERT_EQ(film.status, 0) << film.output;
        EXPECT_EQ(film.output.find("left out"), std::string::npos) << film.output;
        const std::string still = file("raised.exr");
        ASSERT_EQ(conelight("render '" + placed + "'" + options + still).status, 0);
        const std::vector<float> wanted = pixelsOf(still), posed = pixelsOf(scratchPath("film_m01.exr")),
                                 rest = pixelsOf(scratchPath("film_m00.exr"));
        ASSERT_EQ(posed.size(), wanted.size());
        double off = 0, moved = 0, sum = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            off += std::abs(double(posed[i]) - double(wanted[i]));
            moved += std::abs(double(rest[i]) - double(wanted[i]));
            sum += double(wanted[i]);
        }
        EXPECT_LT(off / sum, bar) << mode;
        EXPECT_GT(moved / sum, 0.05) << mode;
    }
}

TEST_F(FilmTest, ClipsThatAreNotThereAreRefused) {
    const std::string moving = risingBlock("film_refused.gltf");
    const auto film = [&](const std::string& more) {
        return conelight("render '" + moving + "'" + kSmall + "-o " + scratchPath("film_e%02d.png ") + more);
    };
    expectOneLine(film("--animate fall"), 2, "rise");
    expectOneLine(film("--animate rise --frames 3-1"), 2, "FIRST-LAST");
    expectOneLine(film("--animate rise --frames x"), 2, "--frames");
    expectOneLine(film("--animate rise --frames 0-1/3"), 2, "--fps");
    const CommandResult info = conelight("info '" + moving + "'");
    EXPECT_NE(info.output.find("rise: 1 s"), std::string::npos) << info.output;
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
    expectOneLine(render("-o " + film), 2, "a film needs --path FILE, --turntable or --animate CLIP");
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
    for (const CommandResult& seen : {render("--quality draft " + remedy + " -o " + file("bright.png")),
                                      render("--quality draft -o " + file("plain.png"))})
        EXPECT_EQ(seen.output.rfind("written ", 0), 0u) << seen.output;
}

// Smaller, coarser and with fewer rays: what is tested is that it works.
std::string asTested(std::string command) {
    for (const auto& [written, tested] :
         {std::pair("--size [0-9]+x[0-9]+", "--size 48x36 --voxels 32"),
          std::pair("--quality high", "--quality draft"), std::pair("--patch [0-9.]+", "--patch 0.3"),
          std::pair("--(gather|visibility)-rays [0-9]+", "--$1-rays 16")})
        command = std::regex_replace(command, std::regex(written), tested);
    return command;
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
                                                asTested(line.substr(13)) + " </dev/null");
        EXPECT_EQ(result.status, 0) << line << "\n" << result.output;
        output = result.output;
        ++commands;
    }
    EXPECT_GE(commands, 10);
    EXPECT_GE(expectations, 4);
    for (const char* name :
         {"first.png", "room.glb", "poster.png", "lit.glb", "look.json", "way.json", "walk00.png"})
        EXPECT_TRUE(std::filesystem::exists(folder + "/" + name)) << name;
}

}  // namespace
}  // namespace conelight::test
