// SPDX-License-Identifier: MIT
// `conelight study cones` on two small scenes: what it finds is better than what it is measured against, is
// drawn as predicted, and comes back from its files.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace conelight::test {
namespace {

class StudyTest : public GlTest {};

const nlohmann::json& rowOf(const nlohmann::json& study, const std::string& name) {
    for (const nlohmann::json& row : study["sets"])
        if (row["name"] == name) return row;
    throw std::runtime_error("no row " + name);
}

TEST_F(StudyTest, FindsConesThatErrLessThanDerivedOnes) {
    const std::string file = scratchPath("study.json"), folder = scratchPath("sets");
    std::filesystem::remove(file);
    const CommandResult result = conelight(
        "study cones builtin:cornell-point builtin:colours --coarse --counts 6,9 --spp 64 --size 48x48 "
        "--voxels 64 -o '" +
        folder + "' --json '" + file + "'");
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json study = nlohmann::json::parse(bytesOf(file));
    EXPECT_EQ(rowOf(study, "derived 6")["ratio_to_six"], 1.0);
    EXPECT_LT(rowOf(study, "found 6")["ratio_to_six"], 1.0);
    EXPECT_LT(rowOf(study, "found 9")["ratio_to_six"], rowOf(study, "derived 9")["ratio_to_six"]);
    EXPECT_GT(rowOf(study, "found 9")["held_out_ratio_to_six"], 0.0);
    // The thesis's single cone sees one spot of the hemisphere.
    EXPECT_GT(rowOf(study, "thesis 1")["ratio_to_six"], 2.0);
    EXPECT_EQ(rowOf(study, "found 9")["rel_rmse"].size(), 2u);

    const std::string picture = scratchPath("own.png");
    const CommandResult drawn =
        conelight("render builtin:cornell-point --mode cones --size 32x32 --voxels 32 --cone-set '" + folder +
                  "/found_9.json' -o '" + picture + "'");
    EXPECT_EQ(drawn.status, 0) << drawn.output;
    EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST_F(StudyTest, WrongUseIsOneLine) {
    const CommandResult counts = conelight("study cones builtin:cornell --counts 3");
    EXPECT_EQ(counts.status, 2);
    EXPECT_NE(counts.output.find("--counts: 3 is not usable"), std::string::npos) << counts.output;
    const CommandResult file = conelight("render builtin:cornell --cone-set /nowhere.json -o /tmp/x.png");
    EXPECT_EQ(file.status, 3) << file.output;
    EXPECT_EQ(conelight("study").status, 2);
}

}  // namespace
}  // namespace conelight::test
