// SPDX-License-Identifier: MIT
// `conelight render --mode beams` and `compare --modes beams` from outside.
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

constexpr const char* kNoGl = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent";

TEST(BeamsMode, NeedsNoOpenGlAndSaysWhatItDid) {
    const std::string out = scratchPath("hall.exr"), stats = scratchPath("hall.json");
    const CommandResult result =
        conelight("render builtin:mirror-hall -o '" + out +
                      "' --mode beams --size 48x36 --aov direct,specular --stats '" + stats + "'",
                  kNoGl);
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json json = nlohmann::json::parse(bytesOf(stats));
    EXPECT_EQ(json["mode"], "beams");
    EXPECT_GT(json["beams"]["beams"].get<int>(), 10);
    EXPECT_EQ(json["beams"]["lamp_beams"], 2);
    const io::FloatImage image = io::readExr(out);
    ASSERT_EQ(image.layers.size(), 2u);
    double mirrored = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        EXPECT_NEAR(image.layers[0].pixels[i] + image.layers[1].pixels[i], image.pixels[i],
                    1e-5f * (1 + image.pixels[i]));
        mirrored += static_cast<double>(image.layers[1].pixels[i]);
    }
    EXPECT_GT(mirrored, 0);
}

TEST(BeamsMode, BouncesCountMirrors) {
    const auto beams = [](const std::string& more) {
        const std::string stats = scratchPath("bounces.json");
        EXPECT_EQ(conelight("render builtin:mirror-hall -o '" + scratchPath("bounces.png") +
                            "' --mode beams --size 16x12 --stats '" + stats + "' " + more)
                      .status,
                  0);
        return nlohmann::json::parse(bytesOf(stats))["beams"]["beams"].get<int>();
    };
    EXPECT_EQ(beams("--bounces 0"), 1);
    EXPECT_GT(beams("--bounces 1"), 1);
    EXPECT_GT(beams("--bounces all"), beams("--bounces 1"));
}

TEST(BeamsMode, RefusalsAreOneLine) {
    const std::string to = " --size 16x12 -o '" + scratchPath("refused.png") + "' ";
    expectOneLine(conelight("render builtin:glass --mode beams" + to), 3, "lets light through");
    expectOneLine(conelight("render builtin:mirror-hall --mode beams --spp 4" + to), 2, "--spp");
    expectOneLine(conelight("render builtin:mirror-hall --mode beams --component albedo" + to), 2, "beams");
    expectOneLine(conelight("render builtin:cornell --mode reference --lamp-points 2" + to), 2,
                  "--lamp-points");
    expectOneLine(conelight("render builtin:cornell --mode reference --paths some" + to), 2, "--paths");
}

// The bar: equal to the path tracer with the same light, within one percent.
TEST(BeamsMode, ComparesWithThePathTracer) {
    const std::string json = scratchPath("compared.json");
    const CommandResult result = conelight(
        "compare builtin:mirror-hall --modes beams --paths mirrors --spp 256 --size 48x36 "
        "--max-relrmse 0.01 --json '" +
            json + "'",
        kNoGl);
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(nlohmann::json::parse(bytesOf(json))["scenes"][0]["variants"][0]["mode"], "beams");
}

}  // namespace
}  // namespace conelight::test
