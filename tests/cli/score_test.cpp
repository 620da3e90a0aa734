// SPDX-License-Identifier: MIT
// `conelight score` on cases whose score is known.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/moving_scene.h"
#include "support/program.h"

namespace conelight::test {
namespace {

class ScoreTest : public GlTest {};

nlohmann::json scored(const std::string& arguments) {
    const std::string file = scratchPath("score.json");
    std::filesystem::remove(file);
    const CommandResult result = conelight("score " + arguments + " --json '" + file + "'");
    EXPECT_EQ(result.status, 0) << result.output;
    return nlohmann::json::parse(bytesOf(file));
}

TEST_F(ScoreTest, ShiftIsZeroWithoutAGridAndNotZeroWithOne) {
    const nlohmann::json json =
        scored("shift builtin:cornell-point --modes phong,thesis,cones --shifts 2 --size 48x48 --voxels 32");
    ASSERT_EQ(json["runs"].size(), 3u);
    EXPECT_EQ(json["runs"][0]["full"]["worst"], 0.0);
    // The thesis's cones see opacity averaged over voxels, which depends on where those lie.
    EXPECT_GT(json["runs"][1]["full"]["worst"].get<double>(), 0.005);
    EXPECT_GT(json["runs"][2]["indirect"]["mean"].get<double>(), 0.001);
    EXPECT_GE(json["runs"][1]["full"]["worst"], json["runs"][1]["full"]["mean"]);
}

TEST_F(ScoreTest, ShiftIsTheSameTwice) {
    const std::string arguments = "shift builtin:cornell-point --shifts 1 --size 32x32 --voxels 16";
    EXPECT_EQ(scored(arguments)["runs"], scored(arguments)["runs"]);
}

TEST_F(ScoreTest, ModesThatMakeEveryFrameAnewSettleInOne) {
    const nlohmann::json json =
        scored("convergence builtin:cornell --modes phong,cones --frames 3 --size 32x32 --voxels 16 --max 1");
    for (const auto& run : json["runs"]) {
        EXPECT_EQ(run["frames"], 1) << run;
        EXPECT_EQ(run["errors"].size(), 3u);
        EXPECT_EQ(run["light"], "lamp");
    }
    ASSERT_EQ(json["runs"].size(), 4u);  // both modes, on and off
    EXPECT_EQ(json["runs"][0]["goes"], "on");
    EXPECT_EQ(json["runs"][1]["goes"], "off");
}

// Neither a slow rise nor a ghost: the picture follows a light that goes on within 16 frames, and not in the first. The only
// lamp goes off at once: all light is scaled by 0.
TEST_F(ScoreTest, TracedFollowsALightWithin16Frames) {
    const nlohmann::json json =
        scored("convergence builtin:cornell --modes traced --quality interactive --size 64x64 --voxels 64");
    ASSERT_EQ(json["runs"].size(), 2u);
    for (const auto& run : json["runs"]) {
        ASSERT_TRUE(run["frames"].is_number()) << run;
        if (run["goes"] == "off") {
            EXPECT_EQ(run["frames"].get<int>(), 1) << run;
            EXPECT_LT(run["errors"].front().get<double>(), 0.01) << run;
            continue;
        }
        EXPECT_GT(run["frames"].get<int>(), 1) << run;
        EXPECT_LE(run["frames"].get<int>(), 16) << run;
        EXPECT_LT(run["errors"].back().get<double>(), 0.5 * run["errors"].front().get<double>());
    }
}

TEST_F(ScoreTest, LeakIsZeroForShadowMapsAndNotForTheThesis) {
    const nlohmann::json json = scored(
        "leak --modes phong,thesis --vary voxels.size=32 --angles 0,30 --size 32x32 --spp 2 --dark dark");
    ASSERT_EQ(json["runs"].size(), 4u);
    for (const auto& run : json["runs"]) {
        EXPECT_EQ(run["dark_pixels"], 32 * 32);
        EXPECT_GT(run["lit_mean"].get<double>(), 0.0);
        if (run["variant"].get<std::string>().rfind("phong", 0) == 0)
            EXPECT_LT(run["leak"].get<double>(), 1e-3) << run;
        else
            EXPECT_GT(run["leak"].get<double>(), 0.01) << run;
    }
    EXPECT_EQ(json["runs"][0]["angle"], 0.0);
    EXPECT_EQ(json["runs"][2]["angle"], 30.0);
}

TEST_F(ScoreTest, ThePathTracerDoesNotFlickerAgainstItself) {
    const nlohmann::json json = scored(
        "flicker builtin:cornell-point --modes reference,phong --frames 3 --size 32x32 --spp 8 --path "
        "orbit=3");
    // The picture is the mean of the halves, so its errors against them are opposite: no product is positive.
    EXPECT_EQ(json["runs"][0]["flicker"], 0.0);
    EXPECT_GT(json["runs"][1]["pixels_followed"].get<double>(), 0.5);
}

// All frames of a camera path are drawn; those of the stations, and their neighbours, are path-traced.
TEST_F(ScoreTest, AWalkIsJudgedAtItsStations) {
    const std::string path = scratchPath("walk.json");
    std::ofstream(path) << R"({"conelight": "camera path", "keys": [
        {"eye": [0, 0.5, 1.4], "target": [0, 0.5, 0]}, {"eye": [0.06, 0.5, 1.3], "target": [0, 0.5, 0]}]})";
    const std::string walk =
        "flicker builtin:cornell --modes reference,traced --quality draft --size 24x24 "
        "--voxels 16 --spp 4 --frames 8 --path " +
        path;
    const nlohmann::json runs = scored(walk + " --stations 2 --component full,indirect")["runs"];
    ASSERT_EQ(runs.size(), 4u);  // two modes, each in two components
    for (const auto& run : runs) {
        EXPECT_EQ(run["unsteadiness"].size(), 6u);
        ASSERT_EQ(run["stations"].size(), 2u);
        EXPECT_EQ(run["stations"][0]["frame"], 1);
        EXPECT_EQ(run["stations"][1]["frame"], 6);
        EXPECT_LT(run["stations"][1]["eye"][2], run["stations"][0]["eye"][2]);
        EXPECT_GE(run["jump"]["ratio"], 1);
    }
    EXPECT_EQ(runs[0]["block_rel_rmse"],
              0.0);  // the path tracer against itself: errors of both halves cancel
    EXPECT_EQ(runs[0]["bias"], 0.0);
    EXPECT_EQ(runs[3]["component"], "indirect");
    EXPECT_GT(runs[3]["block_rel_rmse"].get<double>(), 0.0);
    EXPECT_NE(runs[2]["bias"], runs[3]["bias"]);
    expectOneLine(conelight("score " + walk + " --stations 7"), 2, "--stations: 7");
    expectOneLine(conelight("score flicker builtin:cornell --path " + path + ".no"), 3, "walk.json.no");
}

// What a clip moves, from its start to its end: light of the figure's surroundings follows it.
TEST_F(ScoreTest, AClipIsAPath) {
    const nlohmann::json json = scored(
        "flicker 'builtin:atrium?triangles=10000&figure=1' --path clip=walk "
        "--frames 3 --modes phong --component full --size 32x24 --spp 1");
    EXPECT_GT(json["runs"][0]["unsteadiness"][0].get<double>(), 0.001);
}

// Shapes that a clip bends change as well.
TEST_F(ScoreTest, AClipOfShapesIsAPath) {
    const nlohmann::json json =
        scored("flicker " + growingBlock("growing.gltf") +
               " --path clip=rise --frames 3 --modes phong --component full --size 24x24 "
               "--spp 1");
    EXPECT_GT(json["runs"][0]["unsteadiness"][0].get<double>(), 0.001);
}

// A light that moves changes the picture; one that stays where it is leaves it.
TEST_F(ScoreTest, ALightIsAPath) {
    const auto unsteadiness = [&](const char* travel) {
        const nlohmann::json json =
            scored(std::string("flicker builtin:cornell-point --path light=lamp:") + travel +
                   " --frames 3 --modes phong --component full --size 24x24 --spp 1");
        return json["runs"][0]["unsteadiness"][0].get<double>();
    };
    EXPECT_GT(unsteadiness("0.3,0,0"), 0.001);
    EXPECT_LT(unsteadiness("0,0,0"), 1e-6);
}

// A light, or what emits, is darker in each second frame.
TEST_F(ScoreTest, DimmingIsAPath) {
    const auto unsteadiness = [&](const char* scene, const char* part) {
        const nlohmann::json json =
            scored(std::string("flicker builtin:") + scene + " --path dim=lamp:" + part +
                   " --frames 3 --modes phong --component full --size 24x24 --spp 1");
        return json["runs"][0]["unsteadiness"][0].get<double>();
    };
    for (const char* scene : {"cornell-point", "cornell"}) {
        EXPECT_GT(unsteadiness(scene, "0.5"), 0.2) << scene;
        EXPECT_LT(unsteadiness(scene, "0"), 1e-6) << scene;
    }
}

TEST_F(ScoreTest, AThresholdThatIsExceededIsStatus1) {
    const std::string shift =
        "score shift builtin:cornell-point --modes thesis --shifts 1 --size 32x32 "
        "--voxels 16 --max ";
    EXPECT_EQ(conelight(shift + "10").status, 0);
    const CommandResult result = conelight(shift + "1e-9");
    EXPECT_EQ(result.status, 1) << result.output;
    EXPECT_NE(result.output.find("1 of 1 above 1e-09"), std::string::npos) << result.output;
}

TEST_F(ScoreTest, WrongUsageIsOneLineAndStatus2) {
    expectOneLine(conelight("score"), 2, "required");
    expectOneLine(conelight("score shift builtin:cornell --modes cube"), 2, "cube");
    expectOneLine(conelight("score shift builtin:cornell --modes reference"), 2, "reference");
    expectOneLine(conelight("score shift builtin:cornell --vary voxels.sise=8"), 2, "voxels.size");
    expectOneLine(conelight("score shift builtin:cornell --vary voxels.size"), 2, "KEY=A,B");
    expectOneLine(conelight("score convergence builtin:cornell --light nobody"), 2, "lamp");
    expectOneLine(conelight("score convergence builtin:cornell --within x"), 2, "--within");
    expectOneLine(conelight("score flicker builtin:cornell --path zoom=3"), 2, "orbit");
    expectOneLine(conelight("score flicker builtin:cornell --path object=nobody:1,0,0"), 2,
                  "info SCENE --objects");
    expectOneLine(conelight("score flicker builtin:cornell --path light=nobody:1,0,0"), 2,
                  "no light 'nobody'");
    expectOneLine(conelight("score flicker builtin:cornell --path light=nobody"), 2, "light=NAME:X,Y,Z");
    expectOneLine(conelight("score flicker builtin:cornell --path dim=nobody:0.5"), 2,
                  "nothing that emits 'nobody'");
    expectOneLine(conelight("score flicker builtin:cornell --path dim=lamp:2"), 2, "dim=NAME:PART");
    expectOneLine(conelight("score flicker builtin:cornell --path clip=walk"), 2, "clip");
    expectOneLine(conelight("score leak --angles 10,x"), 2, "--angles");
    expectOneLine(conelight("score leak --dark nobody --size 16x16"), 2, "nobody");
}

}  // namespace
}  // namespace conelight::test
