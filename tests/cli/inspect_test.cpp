// SPDX-License-Identifier: MIT
// `conelight inspect` and the console's `inspect`: the same numbers in text and JSON, bad pixels.
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace conelight::test {
namespace {

const std::string kSmall = " --size 48x32 --voxels 32 --set traced.passes=2 ";

class InspectCliTest : public GlTest {};

TEST_F(InspectCliTest, JsonHoldsPathsThatAddUp) {
    const std::string file = scratchPath("inspect.json"), picture = scratchPath("inspect.png");
    const CommandResult result = conelight("inspect builtin:cornell --pixel 24,20 --json '" + file +
                                           "' -o '" + picture + "'" + kSmall);
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("pixel 24,20  mode traced"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("cosine ray"), std::string::npos);
    EXPECT_FALSE(bytesOf(picture).empty());
    const nlohmann::json json = nlohmann::json::parse(bytesOf(file));
    double sum = 0;
    std::size_t steps = 0;
    for (const nlohmann::json& path : json["paths"]) {
        steps += path["steps"].size();
        if (path["kind"] == "cosine ray" || path["kind"] == "light ray")
            sum += path["weight"][0].get<double>() * path["radiance"][0].get<double>();
    }
    EXPECT_GT(steps, 8u);
    EXPECT_NEAR(sum, json["diffuse"]["value"][0].get<double>(), 1e-4 * sum);
}

TEST_F(InspectCliTest, CommandPrintsTheSame) {
    const CommandResult direct =
        conelight("inspect builtin:cornell --mode cones --steps --pixel 10,12" + kSmall);
    ASSERT_EQ(direct.status, 0) << direct.output;
    const CommandResult command =
        conelight("render builtin:cornell --mode cones --exec 'inspect 10 12 steps'" + kSmall);
    EXPECT_EQ(command.status, 0);
    EXPECT_EQ(command.output, direct.output);
    EXPECT_NE(direct.output.find("diffuse cone"), std::string::npos);
    EXPECT_NE(direct.output.find("sample"), std::string::npos);
}

TEST_F(InspectCliTest, BadPixelsAreOneLine) {
    for (const char* pixel : {"48,0", "-1,3", "3", "3,4,5", "a,b"})
        expectOneLine(conelight("inspect builtin:cornell --pixel=" + std::string(pixel) + kSmall), 2,
                      "--pixel");
    expectOneLine(conelight("inspect builtin:cornell --pixel 1,1 --mode reference" + kSmall), 2,
                  "keeps no cones or rays");
    expectOneLine(conelight("render builtin:cornell --exec 'inspect 99 99'" + kSmall), 2, "inspectPixel");
}

}  // namespace
}  // namespace conelight::test
