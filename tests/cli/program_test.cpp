// SPDX-License-Identifier: MIT
// The program from outside: exit statuses, one-line errors, files written whole, pictures that repeat bit by
// bit.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

std::string path(const std::string& name) { return scratchPath(name); }

CommandResult render(const std::string& scene, const std::string& output, const std::string& more = "",
                     const std::string& environment = "") {
    return conelight("render '" + scene + "' -o '" + output + "' --size 64x48 --voxels 32 " + more,
                     environment);
}

class ProgramTest : public GlTest {};

TEST_F(ProgramTest, EveryCommandHasHelp) {
    for (const char* command : {"", "render", "compare", "bench", "score", "score leak", "score shift",
                                "score flicker", "score convergence", "figures", "info", "settings",
                                "commands", "convert", "shaders", "completion", "manual"}) {
        const CommandResult result = conelight(std::string(command) + " --help");
        EXPECT_EQ(result.status, 0) << command;
        EXPECT_NE(result.output.find("Usage"), std::string::npos) << result.output;
    }
}

TEST_F(ProgramTest, WrongUsageIsOneLineAndStatus2) {
    const std::string out = path("never.png");
    expectOneLine(conelight("render"), 2, "required");
    expectOneLine(conelight("paint x"), 2, "--help");
    expectOneLine(render("builtin:cornell", out, "--size 0x7"), 2, "--size");
    expectOneLine(render("builtin:cornell", out, "--mode cube"), 2, "mode");
    expectOneLine(render("builtin:cornell", out, "--set voxel.size=8"), 2, "voxels.size");
    expectOneLine(render("builtin:cornell", out, "--set voxels.size=3"), 2, "8 to 512");
    expectOneLine(render("builtin:cornell", out, "--camera nobody"), 2, "nobody");
    expectOneLine(render("builtin:cornell", path("never.bmp2")), 2, ".png");
    expectOneLine(render("builtin:nowhere", out), 2, "nowhere");
    expectOneLine(render("builtin:cornell", out, "--aov albedo"), 2, ".exr");
    expectOneLine(render("builtin:cornell", out, "--environment builtin:moon"), 2, "sky, studio");
    expectOneLine(render("builtin:cornell", out, "--environment 'builtin:sky?hour=25'"), 2, "hour");
    expectOneLine(render("builtin:cornell", out, "--split-sun"), 2, "--environment");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ProgramTest, MistypedWordsAreNamedWithTheNearest) {
    expectOneLine(conelight("rendr builtin:cornell"), 2, "no command 'rendr'; render would be right");
    expectOneLine(conelight("score leek"), 2, "score: there is no command 'leek'; leak would be right");
    expectOneLine(conelight("render builtin:cornell --mod phong"), 2,
                  "render: there is no option '--mod'; --mode");
    expectOneLine(conelight("render --voxel=9 builtin:cornell"), 2, "'--voxel'; --voxels would be right");
    expectOneLine(conelight("render builtin:cornell --quux"), 2, "`conelight render --help`");
    expectOneLine(conelight("settings exposre"), 2, "no key contains 'exposre'; exposure would be right");
    EXPECT_NE(conelight("settings exposure").output.find("image.exposure"), std::string::npos);
}

// One line when it is done; on a terminal (that of `script`) one before it says what it does, and counts
// seconds.
TEST_F(ProgramTest, RenderSaysWhatItWroteAndOnATerminalWhatItDoes) {
    const std::string out = path("said.png"), json = path("said.json");
    const CommandResult piped = render("builtin:cornell", out, "--mode phong --stats '" + json + "'");
    const std::string begin = "written " + out + " (64 x 48 pixels), " + json + ", ";
    EXPECT_EQ(piped.output.rfind(begin, 0), 0u) << piped.output;
    EXPECT_EQ(std::count(piped.output.begin(), piped.output.end(), '\n'), 1) << piped.output;
    EXPECT_EQ(piped.output.substr(piped.output.size() - 3), " s\n");
    if (runCommand("command -v script").status != 0) GTEST_SKIP() << "script is not installed (bsdutils)";
    const std::string command = std::string(CONELIGHT_PROGRAM) + " render builtin:cornell -o " + out +
                                " --size 320x240 --voxels 64 --quality converged";
    const std::string shown = runCommand("script -qec '" + command + "' /dev/null </dev/null").output;
    for (const char* part : {"loading builtin:cornell", "rendering full", "rendering full, ", "written "})
        EXPECT_NE(shown.find(part), std::string::npos) << part << " in " << shown;
}

TEST_F(ProgramTest, BadInputIsOneLineAndStatus3) {
    const std::string out = path("never.png");
    expectOneLine(render("/nonexistent/scene.glb", out), 3, "/nonexistent/scene.glb");
    std::ofstream(path("broken.glb")) << "glTF but not really";
    expectOneLine(render(path("broken.glb"), out), 3, "broken.glb");
    expectOneLine(render("builtin:cornell", out, "--environment /nonexistent/sky.hdr"), 3,
                  "/nonexistent/sky.hdr");
    io::writeHdr(path("square.hdr"), {8, 8, 3, std::vector<float>(8 * 8 * 3, 1.0f), {}, {}});
    expectOneLine(render("builtin:cornell", out, "--environment '" + path("square.hdr") + "'"), 3,
                  "twice as wide as high");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ProgramTest, UnwritablePlaceIsFoundBeforeTheWork) {
    expectOneLine(render("builtin:cornell", "/nonexistent/folder/x.png"), 1, "/nonexistent/folder");
}

TEST_F(ProgramTest, NoOpenGlIsStatus4) {
    expectOneLine(
        render("builtin:cornell", path("never.png"), "", "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent"), 4,
        "OpenGL");
}

// Whatever number of threads the driver has.
TEST_F(ProgramTest, SameCommandSameBytes) {
    for (const char* mode : {"phong", "thesis", "cones", "hybrid", "traced"}) {
        const std::string a = path(std::string(mode) + "-a.exr");
        const std::string b = path(std::string(mode) + "-b.exr");
        const std::string options = std::string(
                                        "--aa 0 --set traced.passes=2 --set traced.cache_updates=4 "
                                        "--mode ") +
                                    mode + (mode == std::string("hybrid") ? " --subdivide 1" : "");
        ASSERT_EQ(render("builtin:cornell?block=1", a, options, "LP_NUM_THREADS=2").status, 0);
        for (const char* threads : {"0", "1", "8"}) {
            ASSERT_EQ(render("builtin:cornell?block=1", b, options, std::string("LP_NUM_THREADS=") + threads)
                          .status,
                      0);
            EXPECT_EQ(bytesOf(a), bytesOf(b)) << mode << " with " << threads << " threads";
        }
        const io::FloatImage image = io::readExr(a);
        EXPECT_EQ(image.width, 64);
        EXPECT_EQ(image.height, 48);
        for (const float value : image.pixels) ASSERT_TRUE(std::isfinite(value)) << mode;
    }
}

TEST_F(ProgramTest, PictureIsRightWayRound) {
    // The Cornell box: red wall on the left, green on the right.
    ASSERT_EQ(render("builtin:cornell", path("c.png"), "--component albedo").status, 0);
    const io::ByteImage image = io::readByteImage(path("c.png"));
    const auto at = [&](int x, int y) {
        return &image.pixels[static_cast<std::size_t>(image.channels * (y * image.width + x))];
    };
    EXPECT_GT(at(12, 24)[0], at(12, 24)[1] + 40);
    EXPECT_GT(at(51, 24)[1], at(51, 24)[0] + 40);
}

TEST_F(ProgramTest, AovsBecomeLayersOfTheExr) {
    ASSERT_EQ(render("builtin:cornell", path("l.exr"), "--aov albedo,normal").status, 0);
    const io::FloatImage image = io::readExr(path("l.exr"));
    ASSERT_EQ(image.layers.size(), 2u);
    EXPECT_EQ(image.layers[0].name, "albedo");
    EXPECT_EQ(image.layers[1].name, "normal");
}

// And programs: the second start builds none, where the driver can give them as bytes.
TEST_F(ProgramTest, StatsNamePassesLookupsMemoryAndPrograms) {
    const std::string command =
        "XDG_CACHE_HOME='" + path("cache") + "' " + CONELIGHT_PROGRAM +
        " render builtin:cornell --size 64x48 --voxels 32 --mode cones --overwrite -o '" + path("s.png") +
        "' --stats '" + path("s.json") + "' --program-cache ";
    const auto stats = [&](const char* use) {
        EXPECT_EQ(runCommand(command + use).status, 0);
        return nlohmann::json::parse(bytesOf(path("s.json")));
    };
    const nlohmann::json json = stats("on");
    EXPECT_GT(json["passes"].size(), 2u);
    EXPECT_GT(json["lookups_per_pixel"]["diffuse"].get<double>(), 1.0);
    EXPECT_GT(json["memory_bytes"]["total"].get<double>(), 1e5);
    const int built = json["programs"]["built"];
    EXPECT_GT(built, 5);
    if (!std::filesystem::exists(path("cache"))) GTEST_SKIP() << "the driver does not give programs as bytes";
    const std::string picture = bytesOf(path("s.png"));
    const nlohmann::json second = stats("on");
    EXPECT_EQ(second["programs"]["built"], 0);
    EXPECT_EQ(second["programs"]["loaded"], built);
    EXPECT_EQ(bytesOf(path("s.png")), picture);
    EXPECT_EQ(stats("off")["programs"]["built"], built);
}

TEST_F(ProgramTest, BenchJsonHasTheDocumentedShape) {
    ASSERT_EQ(
        conelight("bench builtin:cornell --frames 2 --modes cones,phong --size 64x48 --voxels 32 --json '" +
                  path("b.json") + "'")
            .status,
        0);
    const nlohmann::json json = nlohmann::json::parse(bytesOf(path("b.json")));
    EXPECT_EQ(json["version"], 1);
    ASSERT_EQ(json["runs"].size(), 2u);
    for (const char* key : {"scene", "mode", "quality", "voxels", "size", "dynamic", "frame", "passes",
                            "lookups_per_pixel", "memory_bytes"})
        EXPECT_TRUE(json["runs"][0].contains(key)) << key;
    for (const char* key : {"median", "min", "max"})
        EXPECT_GT(json["runs"][0]["frame"]["cpu_ms"][key].get<double>(), 0.0);
}

TEST_F(ProgramTest, BenchPlaysAClip) {
    const std::string bench =
        "bench 'builtin:atrium?triangles=10000&figure=1' --modes phong --frames 2 "
        "--size 24x16 --set light.shadow_size=64 ";
    const auto shadows = [&](const std::string& clip) {
        EXPECT_EQ(conelight(bench + clip + " --json '" + path("clip.json") + "'").status, 0);
        const nlohmann::json run = nlohmann::json::parse(bytesOf(path("clip.json")))["runs"][0];
        EXPECT_EQ(run["clip"].is_null(), clip.empty());
        return std::any_of(run["passes"].begin(), run["passes"].end(), [](const nlohmann::json& pass) {
            return pass["name"].get<std::string>().find("shadow") != std::string::npos;
        });
    };
    EXPECT_TRUE(shadows("--animate walk"));  // what moves casts shadows anew in each frame
    EXPECT_FALSE(shadows(""));
    expectOneLine(conelight(bench + "--animate run"), 2, "--animate");
    expectOneLine(conelight(bench + "--animate walk --moving water"), 2, "--moving");
}

// Costs are of frames along the way: maps about the eye are drawn where the camera moves. Hours go with the frames.
TEST_F(ProgramTest, BenchFliesAlongAPath) {
    const std::string bench = "bench builtin:plain --path " + path("way.json");
    const auto film = [&](const std::string& keys) {
        std::ofstream(path("way.json")) << R"({"conelight": "camera path", "keys": [)" << keys << "]}";
        const CommandResult result =
            conelight(bench + " --modes phong --frames 3 --size 24x16 --set light.shadow_size=64 " +
                      "--environment builtin:sky --split-sun --json " + path("way_costs.json"));
        EXPECT_EQ(result.status, 0) << result.output;
        return nlohmann::json::parse(bytesOf(path("way_costs.json")))["runs"][0];
    };
    const auto drawsCascades = [](const nlohmann::json& run) {
        return std::any_of(run["passes"].begin(), run["passes"].end(), [](const nlohmann::json& pass) {
            return pass["name"] == "shadow cascades" && pass["mean_cpu_ms"] > 0;
        });
    };
    const std::string here = R"("eye": [0, 2, 0], "target": [0, 2, -9]})";
    const nlohmann::json still = film("{" + here + ",{" + here);
    EXPECT_FALSE(drawsCascades(still)) << still;
    EXPECT_TRUE(still["film"]["frames"][0]["hour"].is_null());
    EXPECT_TRUE(drawsCascades(film("{" + here + R"(,{"eye": [40, 2, 0], "target": [0, 2, -9]})")));

    const nlohmann::json day = film(R"({"hour": 10, )" + here + R"(,{"hour": 14, )" + here)["film"]["frames"];
    ASSERT_EQ(day.size(), 3u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(day[std::size_t(i)]["hour"], 10 + 2 * i);
        EXPECT_GT(day[std::size_t(i)]["cpu_ms"], 0);
    }
    expectOneLine(conelight(bench), 2, "hour of the day");
    expectOneLine(conelight(bench + " --moving 0"), 2, "--moving");
    expectOneLine(conelight(bench + ".no"), 3, "way.json.no");
}

// The texts are those of the profile that was asked for, and the JSON file says how often each compute program ran.
TEST_F(ProgramTest, BenchWritesTheShadersThatFramesNeed) {
    const std::string bench = "bench builtin:cornell --frames 1 --size 16x16 --voxels 16 --shaders '";
    for (const char* profile : {"processor", "gpu"}) {
        ASSERT_EQ(
            conelight(bench + path(profile) + "' --json '" + path("d.json") + "' --execution " + profile)
                .status,
            0);
        const nlohmann::json told = nlohmann::json::parse(bytesOf(path("d.json")))["runs"][0]["dispatches"];
        std::uint64_t ofPixels = 0;
        for (const nlohmann::json& one : told) {
            const std::string program = one["program"];
            EXPECT_TRUE(std::filesystem::exists(path(profile) + "/" + program + ".comp.glsl")) << program;
            if (one["pass"] == "diffuse rays") ofPixels += one["invocations"].get<std::uint64_t>();
        }
        EXPECT_EQ(ofPixels, 16u * 16u);
        std::size_t files = 0, early = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path(profile))) {
            if (!entry.is_regular_file()) continue;
            ++files;
            early += bytesOf(entry.path().string()).find("#define EXECUTION_GPU 1") != std::string::npos;
        }
        EXPECT_GT(files, 10u);
        EXPECT_EQ(early > 0, std::string(profile) == "gpu");
    }
    std::ofstream(path("file")) << "x";
    const CommandResult unwritable = conelight(bench + path("file") + "'");
    EXPECT_EQ(unwritable.status, 1);
    EXPECT_NE(unwritable.output.find("cannot be written"), std::string::npos) << unwritable.output;
    expectOneLine(conelight(bench + path("none") + "' --execution sideways"), 2, "--execution");
}

TEST_F(ProgramTest, InfoDescribesScenesAndDevice) {
    const CommandResult device = conelight("info");
    EXPECT_EQ(device.status, 0);
    EXPECT_NE(device.output.find("OpenGL 4."), std::string::npos) << device.output;
    const CommandResult scene = conelight("info builtin:cornell");
    EXPECT_EQ(scene.status, 0);
    EXPECT_NE(scene.output.find("triangles"), std::string::npos) << scene.output;
    EXPECT_EQ(conelight("info builtin:").status, 0);
    EXPECT_EQ(scene.output.find("objects"), std::string::npos);
    const CommandResult objects = conelight("info builtin:town --objects");
    EXPECT_NE(objects.output.find("objects    "), std::string::npos) << objects.output;
    EXPECT_NE(objects.output.find("\n  fountain\n"), std::string::npos) << objects.output;
    EXPECT_NE(objects.output.find(" instances\n"), std::string::npos) << objects.output;
    expectOneLine(conelight("info --objects"), 2, "--objects");
}

TEST_F(ProgramTest, InterruptLeavesNoHalfFile) {
    const std::string out = path("interrupted.exr");
    const CommandResult result =
        runCommand("timeout --preserve-status -s INT 1 '" + std::string(CONELIGHT_PROGRAM) +
                   "' render 'builtin:atrium?triangles=2000000' -o '" + out +
                   "' --size 2000x1500 --voxels 64 --mode phong");
    // A fast machine may be done within the second, or writing; then the picture is whole.
    if (result.status == 0 || std::filesystem::exists(out)) {
        EXPECT_EQ(io::readExr(out).width, 2000) << result.output;
    }
    EXPECT_TRUE(result.status == 0 || result.status == 130) << result.status << ": " << result.output;
}

}  // namespace
}  // namespace conelight::test
