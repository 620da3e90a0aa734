// SPDX-License-Identifier: MIT
// `conelight render --mode reference` from outside.
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

// No GL in any of these: the fixture of GL tests is not needed.
TEST(ReferenceMode, NeedsNoOpenGl) {
    const std::string out = scratchPath("furnace.exr");
    const CommandResult result =
        conelight("render builtin:furnace -o '" + out + "' --mode reference --size 16x12 --spp 64",
                  "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent");
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(result.output.rfind("written ", 0), 0u) << result.output;  // no progress in a pipe
    // Radiance emission / (1 - albedo) = 2 everywhere; 12,288 paths.
    double sum = 0;
    const io::FloatImage image = io::readExr(out);
    for (const float value : image.pixels) sum += static_cast<double>(value);
    EXPECT_NEAR(sum / static_cast<double>(image.pixels.size()), 2.0, 0.02);
}

TEST(ReferenceMode, LayersAddUp) {
    const std::string out = scratchPath("layers.exr");
    ASSERT_EQ(conelight("render builtin:cornell -o '" + out +
                        "' --mode reference --size 24x18 --spp 16 --aov "
                        "direct,indirect,half_a,half_b,bounce1,bounce2")
                  .status,
              0);
    const io::FloatImage image = io::readExr(out);
    const auto layer = [&](const std::string& name) -> const std::vector<float>& {
        for (const io::ImageLayer& one : image.layers)
            if (one.name == name) return one.pixels;
        ADD_FAILURE() << "no layer " << name;
        return image.pixels;
    };
    double bounces = 0, indirect = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float scale = 1e-5f * (1 + image.pixels[i]);
        EXPECT_NEAR(layer("direct")[i] + layer("indirect")[i], image.pixels[i], scale);
        EXPECT_NEAR(0.5f * (layer("half_a")[i] + layer("half_b")[i]), image.pixels[i], scale);
        bounces += static_cast<double>(layer("bounce1")[i] + layer("bounce2")[i]);
        indirect += static_cast<double>(layer("indirect")[i]);
    }
    EXPECT_GT(bounces, 0.3 * indirect);
    EXPECT_LT(bounces, indirect);
}

// The picture with less noise is nearer to a better one; its file says what was done.
TEST(ReferenceMode, DenoiseTakesOutNoise) {
    const auto render = [](const std::string& name, const std::string& more) {
        const std::string out = scratchPath(name);
        const CommandResult result = conelight("render builtin:cornell -o '" + out +
                                               "' --mode reference --filter center --size 48x36 " + more);
        EXPECT_EQ(result.status, 0) << result.output;
        return io::readExr(out);
    };
    const std::string stats = scratchPath("denoise.json");
    const io::FloatImage truth = render("denoise_truth.exr", "--spp 512 --seed 9");
    const io::FloatImage noisy = render("denoise_noisy.exr", "--spp 16");
    const io::FloatImage clean = render("denoise_clean.exr", "--spp 16 --denoise --stats '" + stats + "'");
    const auto error = [&](const io::FloatImage& image) {
        double sum = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i)
            sum += std::pow(static_cast<double>(image.pixels[i] - truth.pixels[i]), 2);
        return sum;
    };
    EXPECT_LT(error(clean), 0.25 * error(noisy));
    const nlohmann::json said = nlohmann::json::parse(bytesOf(stats));
    EXPECT_EQ(said["denoiser"], "own");
    EXPECT_EQ(said["samples_per_pixel"], 16);
    std::string denoiser;
    for (const auto& [name, text] : clean.attributes)
        if (name.find("Denoiser") != std::string::npos) denoiser = text;
    EXPECT_EQ(denoiser, "own");
}

TEST(ReferenceMode, DenoiseIsRefusedWhereItMeansNothing) {
    for (const char* words : {"--mode cones --denoise", "--mode reference --denoise=best"}) {
        const CommandResult result =
            conelight(std::string("render builtin:cornell -o '") + scratchPath("no.exr") + "' " + words);
        EXPECT_EQ(result.status, 2) << result.output;
        EXPECT_NE(result.output.find("--denoise"), std::string::npos) << result.output;
    }
    EXPECT_EQ(conelight("compare builtin:cornell --denoise").status, 2);  // a truth is never denoised
}

TEST(ReferenceMode, SameSeedSameBytesAndAnotherSeedAnotherPicture) {
    const auto render = [](const std::string& name, const std::string& more) {
        const std::string out = scratchPath(name);
        EXPECT_EQ(
            conelight("render builtin:cornell -o '" + out + "' --mode reference --size 16x12 --spp 4 " + more)
                .status,
            0);
        return bytesOf(out);
    };
    EXPECT_EQ(render("a.exr", ""), render("b.exr", "--seed 1"));
    EXPECT_NE(render("a.exr", ""), render("c.exr", "--seed 2"));
    EXPECT_NE(render("a.exr", ""), render("d.exr", "--filter center"));
    EXPECT_NE(render("a.exr", ""), render("e.exr", "--bounces 0"));
}

TEST(ReferenceMode, NoiseEndsItAndTheStatisticsSayHow) {
    const std::string stats = scratchPath("stats.json");
    ASSERT_EQ(conelight("render builtin:cornell-point -o '" + scratchPath("n.exr") +
                        "' --mode reference --size 24x18 --noise 5% --stats '" + stats + "'")
                  .status,
              0);
    const nlohmann::json json = nlohmann::json::parse(bytesOf(stats));
    EXPECT_LE(json["noise"].get<double>(), 0.05);
    EXPECT_GT(json["samples_per_pixel"].get<int>(), 1);
    EXPECT_LT(json["samples_per_pixel"].get<int>(), 65536);
    for (const char* key : {"rays", "rays_per_second", "cpu_seconds", "wall_seconds"})
        EXPECT_GT(json[key].get<double>(), 0.0) << key;
    EXPECT_EQ(json["mode"], "reference");
}

TEST(ReferenceMode, InterruptWritesWhatThereIs) {
    const std::string out = scratchPath("stopped.exr");
    std::filesystem::remove(out);
    // Before its first pass there is nothing to write: a busy machine is given longer.
    CommandResult result;
    for (int seconds = 2; seconds <= 1024 && !std::filesystem::exists(out); seconds *= 2) {
        result = runCommand("timeout --preserve-status -s INT " + std::to_string(seconds) + " '" +
                            std::string(CONELIGHT_PROGRAM) + "' render builtin:cornell -o '" + out +
                            "' --mode reference --size 64x48 --spp 1000000");
        EXPECT_EQ(result.status, 130) << result.output;
    }
    EXPECT_NE(result.output.find("of 1000000 samples per pixel"), std::string::npos) << result.output;
    ASSERT_TRUE(std::filesystem::exists(out)) << result.output;
    double sum = 0;
    for (const float value : io::readExr(out).pixels) {
        ASSERT_TRUE(std::isfinite(value));
        sum += static_cast<double>(value);
    }
    EXPECT_GT(sum, 0);
}

TEST(ReferenceMode, WrongUsageIsOneLineAndStatus2) {
    const std::string out = scratchPath("never.exr");
    const auto render = [&](const std::string& more) {
        return conelight("render builtin:cornell -o '" + out + "' --size 8x8 " + more);
    };
    expectOneLine(render("--mode cones --spp 4"), 2, "--mode reference");
    expectOneLine(render("--mode reference --component albedo"), 2, "indirect");
    expectOneLine(render("--mode reference --noise 0"), 2, "--noise");
    expectOneLine(render("--mode reference --noise much"), 2, "--noise");
    expectOneLine(render("--mode reference --filter round"), 2, "box");
    expectOneLine(render("--mode reference --spp 0"), 2, "--spp");
    expectOneLine(render("--mode reference --bounces -1"), 2, "--bounces");
    expectOneLine(render("--mode reference --aov bounce0"), 2, "bounce0");
    expectOneLine(render("--mode cones --aov half_a"), 2, "--mode reference");
    expectOneLine(conelight("render builtin:cornell --mode reference"), 2, "--output");
    EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace conelight::test
