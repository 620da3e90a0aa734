// SPDX-License-Identifier: MIT
// Commands from outside: --exec and --script draw what options draw, bit by bit; errors, exit statuses,
// films, saved scenes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/image_file.h"
#include "support/gl_fixture.h"
#include "support/program.h"

namespace conelight::test {
namespace {

std::string path(const std::string& name) { return scratchDir() + "/" + name; }

const std::string kSmall = " --size 48x32 --voxels 32 ";

CommandResult render(const std::string& more, const std::string& scene = "builtin:cornell") {
    return conelight("render '" + scene + "'" + kSmall + more);
}

class ConsoleCliTest : public GlTest {};

TEST_F(ConsoleCliTest, ExecEqualsTheOptionsBitForBit) {
    const std::pair<const char*, const char*> cases[] = {
        {"--mode thesis --set thesis.side_cones=true --set thesis.diffuse.aperture=0.5",
         "--exec 'mode thesis; side_cones; da 0.5'"},
        {"--mode cones --component indirect --set cones.bounces=1 --sky 0.5,0.25,0",
         "--exec 'mode cones; set cones.bounces 1; component indirect' --exec 'sky 0.5 0.25 0'"},
        {"--environment builtin:studio --rotate 30 --environment-strength 2",
         "--exec 'environment builtin:studio 30 2'"},
        {"--environment builtin:sky?hour=9",
         "--exec 'environment builtin:sky; environment builtin:sky?hour=9'"},
        {"--mode phong --eye 0.2,1,3 --target 0,1,0 --fov 50",
         "--exec 'camera eye 0.2 1 3; camera target 0 1 0; camera fov 50; mode phong'"},
        {"--mode thesis --component voxels --set thesis.voxel_level=1",
         "--exec 'mode thesis; objs; voxs; lod 1'"},
    };
    for (const auto& [options, commands] : cases) {
        for (const char* name : {"a.exr", "b.exr"}) std::filesystem::remove(path(name));
        const CommandResult a = render(std::string(options) + " -o " + path("a.exr"));
        const CommandResult b = render(std::string(commands) + " -o " + path("b.exr"));
        ASSERT_EQ(a.status, 0) << a.output;
        ASSERT_EQ(b.status, 0) << b.output;
        EXPECT_TRUE(pixelsOf(path("a.exr")) == pixelsOf(path("b.exr"))) << commands;
    }
}

// What a mode is, is said in one place: README has the program's words.
TEST_F(ConsoleCliTest, ModesAreAsReadmeSays) {
    const std::string output = render("--exec 'list modes' -o " + path("modes.png")).output;
    std::istringstream lines(output.substr(0, output.find("written ")));
    std::ostringstream readme;
    readme << std::ifstream(CONELIGHT_SOURCE_DIR "/README.md").rdbuf();
    int modes = 0;
    for (std::string mode, about; lines >> mode && std::getline(lines >> std::ws, about); ++modes)
        EXPECT_NE(readme.str().find("| `" + mode + "` | " + about), std::string::npos)
            << mode << ": " << about;
    EXPECT_EQ(modes, 8);
}

TEST_F(ConsoleCliTest, ScreenshotsShowTheStateAtTheirPlace) {
    std::ofstream(path("script.txt")) << "# two pictures\nmode phong\nscreenshot '" << path("p.exr")
                                      << "'\nmode cones # the second\nscreenshot '" << path("c.exr") << "'\n";
    const CommandResult result = render("--script " + path("script.txt"));
    EXPECT_EQ(result.status, 0) << result.output;
    for (const char* mode : {"phong", "cones"}) {
        ASSERT_EQ(render(std::string("--mode ") + mode + " -o " + path("o.exr")).status, 0);
        EXPECT_EQ(bytesOf(path("o.exr")), bytesOf(path(mode[0] == 'p' ? "p.exr" : "c.exr"))) << mode;
    }
}

TEST_F(ConsoleCliTest, ErrorsEndTheRunWithTheirStatusAndWriteNothing) {
    const auto expect = [](const CommandResult& result, int status, const std::string& part) {
        EXPECT_EQ(result.status, status) << result.output;
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
        EXPECT_EQ(result.output.rfind("conelight: ", 0), 0u) << result.output;
        EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    };
    const std::string out = path("never.png");
    expect(render("--exec 'mode phong; togle x' -o " + out), 2, "--exec:1: unknown command 'togle'; toggle");
    expect(render("--exec 'load /nonexistent.glb' -o " + out), 3, "/nonexistent.glb");
    expect(render("--script /nonexistent.txt -o " + out), 3, "/nonexistent.txt");
    const CommandResult quit = render("--exec 'quit 7; togle' -o " + out);
    EXPECT_EQ(quit.status, 7);
    EXPECT_EQ(quit.output, "");
    expect(render(""), 2, "--output");
    expect(conelight("bench builtin:cornell --frames 1" + kSmall + "--exec 'screenshot " + out + "'"), 2,
           "only `render` draws");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ConsoleCliTest, FramesBecomeNumberedPicturesAndATurntableTurns) {
    const CommandResult result =
        render("--exec 'mode phong; record " + path("turn%02d.png") + " 3 turntable; wait 2; avgf'");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("last 5 frames"), std::string::npos) << result.output;
    for (const char* name : {"turn00.png", "turn01.png", "turn02.png"})
        EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
    EXPECT_NE(bytesOf(path("turn00.png")), bytesOf(path("turn01.png")));
    EXPECT_NE(bytesOf(path("turn01.png")), bytesOf(path("turn02.png")));
}

// Stands for ffmpeg: keeps what it is given. Its last argument is the file.
TEST_F(ConsoleCliTest, FilmsGoThroughFfmpegWhole) {
    const std::string folder = path("bin");
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/ffmpeg") << "#!/bin/sh\nfor f; do :; done\ncat > \"$f\"\n";
    std::filesystem::permissions(folder + "/ffmpeg", std::filesystem::perms::owner_all);
    const std::string film = path("film.mp4");
    const std::string call = "render builtin:cornell" + kSmall + "--exec 'mode phong; record " + film + " 2'";
    const CommandResult result = conelight(call, "PATH=" + folder + ":$PATH");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(std::filesystem::file_size(film), 2u * 48 * 32 * 3);
    // One that fails leaves no film, and is not the end of the program but an error.
    std::filesystem::remove(film);
    std::ofstream(folder + "/ffmpeg") << "#!/bin/sh\nexit 1\n";
    const CommandResult failed = conelight(call, "PATH=" + folder + ":$PATH");
    EXPECT_EQ(failed.status, 1) << failed.output;
    EXPECT_NE(failed.output.find("ffmpeg"), std::string::npos) << failed.output;
    EXPECT_FALSE(std::filesystem::exists(film));
}

TEST_F(ConsoleCliTest, SavedScenesDrawTheSamePicture) {
    const std::string file = path("saved.txt");
    for (const std::string& old : {file, path("saved_meshes")}) std::filesystem::remove_all(old);
    const CommandResult saved = render(
        "--mode cones --exec 'camera orbit 15; light add point fill; light fill position 0 1 1; "
        "set image.exposure 0.5; save " +
        file + "' -o " + path("before.exr"));
    ASSERT_EQ(saved.status, 0) << saved.output;
    ASSERT_EQ(render("-o " + path("after.exr"), file).status, 0);
    const io::FloatImage a = io::readExr(path("before.exr")), b = io::readExr(path("after.exr"));
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        difference += std::abs(double(a.pixels[i]) - double(b.pixels[i]));
        sum += std::abs(double(a.pixels[i]));
    }
    // Positions come back rounded to floats' decimals; a voxel may get its share of a triangle otherwise.
    EXPECT_LT(difference, 0.005 * sum);
    const CommandResult again = conelight("convert builtin:cornell " + file);
    EXPECT_EQ(again.status, 2);
    EXPECT_NE(again.output.find("is there already"), std::string::npos) << again.output;
    EXPECT_EQ(conelight("convert builtin:cornell " + file + " --force").status, 0);
}

TEST_F(ConsoleCliTest, BenchMeasuresTheEditedState) {
    const CommandResult result = conelight("bench builtin:cornell --modes cones --frames 1" + kSmall +
                                           "--exec 'set voxels.size 64' --json " + path("bench.json"));
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json bench = nlohmann::json::parse(bytesOf(path("bench.json")))["runs"][0];
    EXPECT_EQ(bench["voxels"], 64);
    EXPECT_EQ(bench["frame"]["waits"]["max"], 0);  // all stands still
    EXPECT_EQ(conelight("bench builtin:cornell --modes cones --frames 1 --exec 'mode phong'").status, 2);
}

}  // namespace
}  // namespace conelight::test
