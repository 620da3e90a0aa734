// SPDX-License-Identifier: MIT
// `conelight bake`: what it writes and says, and what it refuses.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

TEST(BakeTest, WritesProbesAndTellsTheirError) {
    const std::string folder = scratchPath("probes"), errors = scratchPath("errors.json");
    std::filesystem::remove_all(folder);
    std::filesystem::remove(errors);
    const std::string command =
        "bake builtin:cornell --spacing 0.26 --samples 64 --check-size 24x24 --check-spp 32 -o '" + folder +
        "' --json '" + errors + "'";
    const CommandResult result = conelight(command);
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json probes = nlohmann::json::parse(bytesOf(folder + "/probes.json"));
    const nlohmann::json& counts = probes["grid"]["counts"];
    const int x = counts[0], y = counts[1], z = counts[2];
    EXPECT_EQ(probes["probes"].size(), static_cast<std::size_t>(x * y * z));
    EXPECT_EQ(probes["probes"][0]["sh"].size(), 9u);
    const io::FloatImage irradiance = io::readExr(folder + "/probes_irradiance.exr");
    EXPECT_EQ(irradiance.width, 10 * x * z);
    EXPECT_EQ(irradiance.height, 10 * y);
    EXPECT_EQ(io::readExr(folder + "/probes_distance.exr").height, 18 * y);
    const nlohmann::json said = nlohmann::json::parse(bytesOf(errors));
    ASSERT_EQ(said["errors"].size(), 2u);
    EXPECT_GT(said["errors"][0]["full_rel_rmse"], 0.0);
    EXPECT_LT(said["errors"][0]["full_rel_rmse"], 0.5);

    const std::string before = bytesOf(folder + "/probes.json");
    const CommandResult again = conelight(command);
    EXPECT_EQ(again.status, 2) << again.output;
    EXPECT_EQ(bytesOf(folder + "/probes.json"), before);
    std::filesystem::remove_all(folder);
    std::filesystem::remove(errors);
    EXPECT_EQ(conelight(command).status, 0);
    EXPECT_EQ(bytesOf(folder + "/probes.json"), before);  // the same bits
}

TEST(BakeTest, WritesLightMapsAndTellsTheirError) {
    const std::string folder = scratchPath("lightmaps"), errors = scratchPath("map_errors.json");
    std::filesystem::remove_all(folder);
    std::filesystem::remove(errors);
    const std::string command =
        "bake builtin:cornell --lightmaps --texel 0.08 --samples 64 --check-size 24x24 --check-spp 32 "
        "--direct --directional -o '" +
        folder + "' --json '" + errors + "'";
    const CommandResult result = conelight(command);
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("8 objects in 1 map"), std::string::npos) << result.output;
    const nlohmann::json described = nlohmann::json::parse(bytesOf(folder + "/lightmaps.json"));
    EXPECT_EQ(described["light"], "all");
    ASSERT_EQ(described["maps"].size(), 1u);
    ASSERT_EQ(described["instances"].size(), 8u);
    const int width = described["maps"][0]["size"][0], height = described["maps"][0]["size"][1];
    const io::FloatImage irradiance = io::readExr(folder + "/lightmap_0.exr");
    EXPECT_EQ(irradiance.width, width);
    EXPECT_EQ(irradiance.height, height);
    EXPECT_EQ(io::readExr(folder + "/lightmap_0_direction.exr").width, width);
    // Other files hold the same light.
    const io::FloatImage hdr = io::readImage(folder + "/lightmap_0.hdr");
    const io::ByteImage png = io::readByteImage(folder + "/lightmap_0.png");
    const float range = described["maps"][0]["png"]["range"];
    ASSERT_EQ(hdr.pixels.size(), irradiance.pixels.size());
    ASSERT_EQ(png.pixels.size(), irradiance.pixels.size());
    for (std::size_t i = 0; i < irradiance.pixels.size(); i += 3) {
        const float largest =
            std::max({irradiance.pixels[i], irradiance.pixels[i + 1], irradiance.pixels[i + 2]});
        for (std::size_t k = i; k < i + 3; ++k) {
            EXPECT_NEAR(hdr.pixels[k], irradiance.pixels[k], 0.01f * largest + 1e-6f);
            EXPECT_NEAR(static_cast<float>(png.pixels[k]) / 255.0f * range, irradiance.pixels[k],
                        range / 200.0f);
        }
    }
    // The scene is whole, and carries where its maps are.
    const std::string glb = bytesOf(folder + "/scene.glb");
    EXPECT_NE(glb.find("TEXCOORD_1"), std::string::npos);
    EXPECT_NE(glb.find("\"lightmap\":{\"map\":0"), std::string::npos);
    const CommandResult info = conelight("info builtin:cornell"),
                        again = conelight("info '" + folder + "/scene.glb'");
    const auto triangles = [](const std::string& text) {
        const std::size_t at = text.find("triangles");
        return text.substr(at, text.find('\n', at) - at);
    };
    EXPECT_EQ(triangles(info.output), triangles(again.output));
    const nlohmann::json said = nlohmann::json::parse(bytesOf(errors));
    ASSERT_EQ(said["errors"].size(), 2u);
    EXPECT_GT(said["errors"][0]["diffuse_rel_rmse"], 0.0);
    EXPECT_LT(said["errors"][0]["diffuse_block_rel_rmse"], 0.3);

    const std::string before = bytesOf(folder + "/lightmap_0.exr");
    EXPECT_EQ(conelight(command).status, 2);  // nothing is written over
    std::filesystem::remove_all(folder);
    std::filesystem::remove(errors);
    EXPECT_EQ(conelight(command).status, 0);
    EXPECT_EQ(bytesOf(folder + "/lightmap_0.exr"), before);  // the same bits
    EXPECT_EQ(bytesOf(folder + "/scene.glb"), glb);
}

TEST(BakeTest, StoppedItGoesOnToTheSameBits) {
    const std::string whole = scratchPath("whole"), folder = scratchPath("stopped");
    for (const std::string& one : {whole, folder}) std::filesystem::remove_all(one);
    const std::string command =
        "bake builtin:cornell --no-check --lightmaps --texel 0.1 --direct --samples 1024";
    // Its folder says that it may be stopped.
    const CommandResult stopped = runCommand(
        std::string("'") + CONELIGHT_PROGRAM + "' " + command + " -o '" + folder +
        "' 2>&1 & bake=$!; while [ ! -d '" + folder +
        "' ] && kill -0 $bake; do sleep 0.02; done; sleep 0.1; kill -INT $bake; wait $bake; echo status $?");
    EXPECT_NE(stopped.output.find("goes on from"), std::string::npos) << stopped.output;
    EXPECT_NE(stopped.output.find("status 130"), std::string::npos) << stopped.output;
    ASSERT_TRUE(std::filesystem::exists(folder + "/bake.partial"));
    EXPECT_FALSE(std::filesystem::exists(folder + "/lightmaps.json"));
    const CommandResult again = conelight(command + " -o '" + folder + "'");
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_NE(again.output.find("going on from"), std::string::npos) << again.output;
    EXPECT_FALSE(std::filesystem::exists(folder + "/bake.partial"));
    ASSERT_EQ(conelight(command + " -o '" + whole + "'").status, 0);
    for (const auto& file : std::filesystem::directory_iterator(whole))
        EXPECT_EQ(bytesOf(file.path().string()),
                  bytesOf((std::filesystem::path(folder) / file.path().filename()).string()))
            << file.path();
}

TEST(BakeTest, WrongUseIsOneLineAndWritesNothing) {
    const std::string folder = scratchPath("none");
    std::filesystem::remove_all(folder);
    for (const char* wrong :
         {"--spacing -1", "--spacing 1e-5", "--samples 2", "--bounces 0", "--bounces x", "--check-size 3",
          "--check-spp 0", "--texel 0.1", "--lightmaps --texel -1", "--lightmaps --texel 1e-4",
          "--lightmaps --map-size 8", "--lightmaps --spacing 1", "--directional"}) {
        const CommandResult result =
            conelight("bake builtin:cornell " + std::string(wrong) + " -o '" + folder + "'");
        EXPECT_EQ(result.status, 2) << wrong << ": " << result.output;
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
        EXPECT_FALSE(std::filesystem::exists(folder + "/probes.json")) << wrong;
        EXPECT_FALSE(std::filesystem::exists(folder + "/lightmaps.json")) << wrong;
    }
    EXPECT_EQ(conelight("bake /nowhere.glb -o '" + folder + "'").status, 3);
}

}  // namespace
}  // namespace conelight::test
