// SPDX-License-Identifier: MIT
// `conelight render --mode radiosity` from outside: against the path tracer, baked and drawn again.
#include <cmath>
#include <filesystem>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

// Few patches and rays: seconds, and still close.
const std::string kCoarse =
    " --mode radiosity --patch 0.3 --subdivide 2 --gather-rays 256 --visibility-rays 64";

TEST(RadiosityMode, MeetsABarAgainstThePathTracer) {
    const CommandResult result = conelight(
        "compare builtin:furnace --modes radiosity --against reference --size 24x18 --spp 256 --components "
        "full --max-relrmse 0.05 --max-bias 0.02");
    EXPECT_EQ(result.status, 0) << result.output;
}

TEST(RadiosityMode, ABakedFileShowsTheSamePictureInAnyMode) {
    const std::string baked = scratchPath("baked.glb"), first = scratchPath("first.exr"),
                      again = scratchPath("again.exr");
    CommandResult result =
        conelight("render builtin:cornell -o '" + first + "' --size 48x36 --bake '" + baked + "'" + kCoarse);
    ASSERT_EQ(result.status, 0) << result.output;
    result = conelight("render '" + baked + "' -o '" + again + "' --size 48x36 --mode phong");
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(result.output.find("studio"), std::string::npos) << result.output;
    const io::FloatImage a = io::readExr(first), b = io::readExr(again);
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        difference += std::fabs(static_cast<double>(a.pixels[i] - b.pixels[i]));
        sum += static_cast<double>(a.pixels[i]);
    }
    EXPECT_LT(difference, 1e-3 * sum);
    EXPECT_GT(sum, 0);
}

TEST(RadiosityMode, WrongBakeNamesAndForeignOptionsAreRefused) {
    const std::string out = scratchPath("refused.exr");
    EXPECT_EQ(conelight("render builtin:furnace -o '" + out + "' --mode radiosity --bake x.txt").status, 2);
    EXPECT_EQ(conelight("render builtin:furnace -o '" + out + "' --mode cones --bake x.glb").status, 2);
    EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace conelight::test
