// SPDX-License-Identifier: MIT
// `--mode hybrid` from outside: rendered, measured, refused; what says that something moves.
#include <cmath>

#include "support/program.h"

namespace conelight::test {
namespace {

const std::string kSmall =
    " --mode hybrid --voxels 32 --size 32x24 --patch 0.3 --subdivide 0 --gather-rays 64";

TEST(HybridMode, SaysWhenNothingMoves) {
    const std::string out = scratchPath("still.exr");
    const CommandResult still = conelight("render builtin:cornell -o '" + out + "'" + kSmall);
    EXPECT_EQ(still.status, 0) << still.output;
    EXPECT_NE(still.output.find("nothing in the scene is dynamic"), std::string::npos) << still.output;
    const CommandResult moving = conelight("render 'builtin:cornell?block=1' -o '" + out + "'" + kSmall);
    EXPECT_EQ(moving.status, 0) << moving.output;
    EXPECT_EQ(moving.output.find("dynamic"), std::string::npos) << moving.output;
    for (const float value : pixelsOf(out)) ASSERT_TRUE(std::isfinite(value));
}

// What the console says of objects reaches the bake: with the block marked as still all light is baked.
TEST(HybridMode, ObjectsAreMarkedByTheConsole) {
    const std::string out = scratchPath("marked.exr");
    const CommandResult result = conelight("render 'builtin:cornell?block=1' -o '" + out + "'" + kSmall +
                                           " --exec 'moving \"moving block\" off'");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("nothing in the scene is dynamic"), std::string::npos) << result.output;
}

TEST(HybridMode, OptionsOfTheBakeAreItsOwn) {
    const std::string out = scratchPath("refused.exr");
    EXPECT_EQ(conelight("render builtin:cornell -o '" + out + "' --mode cones --patch 0.3").status, 2);
    EXPECT_EQ(conelight("render builtin:cornell -o '" + out + "' --mode hybrid --specular").status, 2);
    EXPECT_EQ(conelight("render builtin:cornell -o '" + out + "' --mode hybrid --bake x.glb").status, 2);
}

TEST(HybridMode, InfoCountsWhatMoves) {
    EXPECT_NE(conelight("info 'builtin:cornell?block=1'").output.find("9, 1 dynamic"), std::string::npos);
}

TEST(HybridMode, BenchMovesAnObjectThatWasNotMarked) {
    const CommandResult result =
        conelight("bench builtin:furnace --modes hybrid --moving walls --voxels 32 --size 32x24 --frames 1");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("mode hybrid"), std::string::npos) << result.output;
    EXPECT_EQ(result.output.find("nothing in the scene is dynamic"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace conelight::test
