// SPDX-License-Identifier: MIT
// Finished pictures of mode `traced`: what more rays must average away.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/generated.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

// Indirect light as the best quality has it, all passes.
class TracedStillsTest : public TracedModeTest {
  protected:
    static Settings convergedSettings(int voxels) {
        Settings settings;
        settings.mode = Mode::Traced;
        settings.component = Component::Indirect;
        settings.voxels.size = voxels;
        applyQuality(settings.traced, Quality::Converged);
        return settings;
    }
    static Image drawn(const Scene& scene, int width, int height, const Settings& settings) {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.front(), width, height, settings);
        return renderer.readImage();
    }
    // The light of pixels that are far brighter than all but one around them, over the mean of all.
    static double lightOfDots(const Image& image) {
        const double mean = meanOf(image);
        double sum = 0;
        dotsIn(image, [&](double own, const std::array<float, 9>& around) {
            const bool isDot = own > 2.5 * static_cast<double>(around[7]) && own > 4 * mean;
            if (isDot) sum += own / mean;
            return isDot;
        });
        return sum;
    }
};

// A draw of light samples errs by some of what it stands for. Passes aim at draws of their own, so means of squares of a
// furnace, in which all is alike, come closer to each other the more there are.
TEST_F(TracedStillsTest, PassesAimAtDrawsOfTheirOwn) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    Settings settings = convergedSettings(64);
    settings.traced.filterLevels = 0;
    constexpr int kPixels = 96, kSquare = 16, kSquares = kPixels / kSquare;
    const Image image = drawn(scene, kPixels, kPixels, settings);
    std::array<double, kSquares * kSquares> means{};
    double mean = 0;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
            const auto square = static_cast<std::size_t>(y / kSquare * kSquares + x / kSquare);
            const double own = image.pixels[static_cast<std::size_t>(y * kPixels + x)].g;
            means[square] += own / (kSquare * kSquare);
            mean += own / (kPixels * kPixels);
        }
    double squares = 0;
    for (const double one : means) squares += std::pow(one - mean, 2) / static_cast<double>(means.size());
    EXPECT_GT(mean, 0);
    EXPECT_LT(std::sqrt(squares) / mean, 0.0015);  // 0.0025 where all aim at one
}

// A bulb of few voxels above tools of steel. Now and then a ray from the thin rim of a lobe meets the rim of the bulb, which
// few rays are aimed at: that one ray may not show.
TEST_F(TracedStillsTest, RimsOfBulbsThrowNoDotsOnTools) {
    const Scene scene = io::generateScene("workshop");
    Settings settings = convergedSettings(128);
    settings.light.smallLamps = false;  // the bulb shines by its voxels
    settings.traced.cacheUpdates = 12;
    settings.traced.cacheRays = 2;
    const double ofDots = lightOfDots(drawn(scene, 96, 72, settings));
    RecordProperty("dots", std::to_string(ofDots));
    EXPECT_LT(ofDots, 80);  // 137 where no ray is bounded
}

// The bulb is a light. Few rays from a tool meet its highlight on the bench, which is steel: none of them may show.
TEST_F(TracedStillsTest, HighlightsOfBulbsThrowNoDotsOnTools) {
    const Scene scene = io::generateScene("workshop");
    Settings settings = convergedSettings(128);
    applyQuality(settings.traced, Quality::Interactive);
    settings.traced.cacheUpdates = 10;
    const double ofDots = lightOfDots(drawn(scene, 120, 90, settings));
    RecordProperty("dots", std::to_string(ofDots));
    EXPECT_LT(ofDots, 160);  // 218 where aimed rays alone are bounded
}

// Light of the sky falls through two skylights, which few cosine-sampled rays find. Rays are guided there, and the mean of
// many is the same.
TEST_F(TracedStillsTest, RoomsFindTheirSkylights) {
    const Scene scene = io::generateScene("loft?sun=0");
    Settings settings = convergedSettings(64);
    applyQuality(settings.traced, Quality::Interactive);
    settings.traced.filterLevels = 0;
    const Image few = drawn(scene, 64, 48, settings);
    settings.traced.passes = 256;
    const Image many = drawn(scene, 64, 48, settings);
    double error = 0;
    for (std::size_t i = 0; i < few.pixels.size(); ++i)
        error += static_cast<double>(glm::length(few.pixels[i] - many.pixels[i])) / std::sqrt(3.0);
    error /= static_cast<double>(few.pixels.size());
    EXPECT_LT(error / meanOf(many), 0.24);  // 0.33 with cosine-sampled rays alone
    EXPECT_NEAR(meanOf(few) / meanOf(many), 1.0, 0.02);
}

}  // namespace
}  // namespace conelight::test
