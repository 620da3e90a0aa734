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

TEST(BakeTest, WrongUseIsOneLineAndWritesNothing) {
    const std::string folder = scratchPath("none");
    std::filesystem::remove_all(folder);
    for (const char* wrong : {"--spacing -1", "--spacing 1e-5", "--samples 2", "--bounces 0", "--bounces x",
                              "--check-size 3", "--check-spp 0"}) {
        const CommandResult result =
            conelight("bake builtin:cornell " + std::string(wrong) + " -o '" + folder + "'");
        EXPECT_EQ(result.status, 2) << wrong << ": " << result.output;
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
        EXPECT_FALSE(std::filesystem::exists(folder + "/probes.json")) << wrong;
    }
    EXPECT_EQ(conelight("bake /nowhere.glb -o '" + folder + "'").status, 3);
}

}  // namespace
}  // namespace conelight::test
