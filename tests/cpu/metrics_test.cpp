// SPDX-License-Identifier: MIT
// Error metrics on images whose errors are known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "conelight/error.h"
#include "reference/metrics.h"

namespace conelight::reference {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image constant(const glm::vec3& color, int width = 24, int height = 20) {
    return {width, height,
            std::vector<glm::vec4>(std::size_t(width) * std::size_t(height), glm::vec4(color, 1.0f))};
}

template <class Function>
Image fromFunction(int width, int height, Function colorAt) {
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.pixels.emplace_back(glm::vec3(colorAt(x, y)), 1.0f);
    return image;
}

// Linear value that an sRGB display shows as `encoded` (IEC 61966-2-1).
float linearOf(double encoded) {
    return float(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

MetricOptions withoutFlip() {
    MetricOptions options;
    options.flip = false;
    return options;
}

// Lightness L* of a grey of linear value y (CIE 15), y above 0.0089.
double lightness(double y) { return 116 * std::cbrt(y) - 16; }

// FLIP of two constant greys: no features, so the colour part alone; HyAB is the difference in lightness.
// 203.3: HyAB between Hunt-adjusted green (L* 87.73, a* -86.18, b* 83.18) and blue (32.30, 79.19, -107.86).
double flipOfGreys(double lightnessDifference) {
    const double largest = std::pow(203.31, 0.7), knee = 0.4 * largest;
    const double distance = std::pow(lightnessDifference, 0.7);
    return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (largest - knee);
}

}  // namespace

TEST(MetricsTest, ConstantImages) {
    const Metrics m = compareImages(constant(glm::vec3(0.6f)), constant(glm::vec3(0.5f)), withoutFlip());
    EXPECT_EQ(m.pixels, 480u);
    EXPECT_EQ(m.badPixels, 0u);
    EXPECT_NEAR(m.mean, 0.6, 1e-6);
    EXPECT_NEAR(m.referenceMean, 0.5, 1e-6);
    EXPECT_NEAR(m.bias, 0.2, 1e-6);
    EXPECT_NEAR(m.mae, 0.1, 1e-6);
    EXPECT_NEAR(m.mse, 0.01, 1e-6);
    EXPECT_NEAR(m.rmse, 0.1, 1e-6);
    EXPECT_NEAR(m.relRmse, 0.2, 1e-6);
    EXPECT_NEAR(m.relMse, 0.01 / 0.26, 1e-6);
    EXPECT_EQ(m.flip, 0);
}

TEST(MetricsTest, ChannelsCountAlike) {
    // Errors of 1, 0 and -2 in the channels: they cancel in the bias by a third, not in MAE and MSE.
    const Metrics m = compareImages(constant({2, 1, 1}), constant({1, 1, 3}), withoutFlip());
    EXPECT_NEAR(m.bias, -0.2, 1e-6);
    EXPECT_NEAR(m.mae, 1.0, 1e-6);
    EXPECT_NEAR(m.mse, 5.0 / 3, 1e-6);
}

// Errors of +0.2 and -0.2 in turn, and 0.1 on all: blocks of even sides see the 0.1 alone.
TEST(MetricsTest, BlocksSeeWhatNeighboursDoNotCancel) {
    const auto test = [](int x, int y) { return glm::vec3((x + y) % 2 != 0 ? 1.3f : 0.9f); };
    const Image reference = constant(glm::vec3(1), 24, 20);
    MetricOptions options = withoutFlip();
    const Metrics even = compareImages(fromFunction(24, 20, test), reference, options);
    EXPECT_EQ(even.blockSize, 4);
    EXPECT_NEAR(even.relRmse, std::sqrt(0.05), 1e-6);
    EXPECT_NEAR(even.blockRelRmse, 0.1, 1e-6);
    options.blockSize = 1;
    EXPECT_NEAR(compareImages(fromFunction(24, 20, test), reference, options).blockRelRmse, std::sqrt(0.05),
                1e-6);

    const Image a = fromFunction(24, 20, [](int x, int) { return glm::vec3(x % 8 < 4 ? 1.5f : 0.5f); });
    const Image b = fromFunction(24, 20, [](int x, int) { return glm::vec3(x % 8 < 4 ? 0.5f : 1.5f); });
    options.blockSize = 4;
    // The noise of the halves is the same all over a block: (0.6 - 0.5)(0.6 + 0.5) in each.
    const Metrics noisy = compareImages(constant(glm::vec3(1.6f)), reference, options, Halves{&a, &b});
    EXPECT_NEAR(noisy.blockRelRmse, std::sqrt(0.11), 1e-6);
}

// A picture of 6 x 5 pixels in blocks of 4: parts of blocks count by their pixels, and what is not finite not at all.
TEST(MetricsTest, PartsOfBlocksCountByTheirPixels) {
    const auto value = [](int x, int y) { return glm::vec3(x >= 4 ? 2.0f : y >= 4 ? 3.0f : 1.0f); };
    Image test = fromFunction(6, 5, value);
    const Image reference = constant(glm::vec3(1), 6, 5);
    // Ten pixels of error 1 in the two blocks at the right, four of error 2 below.
    EXPECT_NEAR(compareImages(test, reference, withoutFlip()).blockRelRmse,
                std::sqrt((10 * 1.0 + 4 * 4.0) / 30), 1e-6);
    test.pixels[5].g = kNan;
    EXPECT_NEAR(compareImages(test, reference, withoutFlip()).blockRelRmse,
                std::sqrt((9 * 1.0 + 4 * 4.0) / 29), 1e-6);
}

TEST(MetricsTest, EqualImages) {
    const Image image = fromFunction(32, 24, [](int x, int y) {
        return glm::vec3(float(x % 7) / 7, float(y % 5) / 5, float((x * y) % 11) / 3);
    });
    const Metrics m = compareImages(image, image);
    EXPECT_EQ(m.bias, 0);
    EXPECT_EQ(m.mae, 0);
    EXPECT_EQ(m.relMse, 0);
    EXPECT_EQ(m.psnr, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(m.ssim, 1, 1e-9);
    EXPECT_EQ(m.flip, 0);
    EXPECT_EQ(m.hdrFlip, 0);
}

TEST(MetricsTest, BlackReference) {
    const Metrics same = compareImages(constant(glm::vec3(0)), constant(glm::vec3(0)));
    EXPECT_EQ(same.bias, 0);
    EXPECT_EQ(same.relRmse, 0);
    EXPECT_EQ(same.hdrFlip, 0);
    const Metrics lit = compareImages(constant(glm::vec3(0.1f)), constant(glm::vec3(0)));
    EXPECT_EQ(lit.bias, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(lit.mae, 0.1, 1e-6);
    EXPECT_GT(lit.hdrFlip, 0.3);
}

TEST(MetricsTest, PsnrIsOfTheDisplay) {
    // A difference of 0.1 as displayed: 20 dB. One stop brighter, from half the radiance: the same.
    const float a = linearOf(0.5), b = linearOf(0.6);
    EXPECT_NEAR(compareImages(constant(glm::vec3(a)), constant(glm::vec3(b)), withoutFlip()).psnr, 20, 1e-3);
    MetricOptions brighter = withoutFlip();
    brighter.exposure = 1;
    EXPECT_NEAR(compareImages(constant(glm::vec3(a / 2)), constant(glm::vec3(b / 2)), brighter).psnr, 20,
                1e-3);
    // What a display cannot show is no difference on it.
    EXPECT_EQ(compareImages(constant(glm::vec3(2)), constant(glm::vec3(9)), withoutFlip()).psnr,
              std::numeric_limits<double>::infinity());
}

TEST(SsimTest, ConstantImagesDifferInLuminanceOnly) {
    const double a = 0.3, b = 0.7, c1 = 1e-4;
    const Metrics m =
        compareImages(constant(glm::vec3(linearOf(a))), constant(glm::vec3(linearOf(b))), withoutFlip());
    EXPECT_NEAR(m.ssim, (2 * a * b + c1) / (a * a + b * b + c1), 1e-5);
}

TEST(SsimTest, InvertedChecks) {
    // 0.5 +- 0.25 in a chessboard: means equal, covariance = -variance = -1/16 (the window's mean differs
    // from 0.5 by 1e-5).
    const auto checks = [](double sign) {
        return fromFunction(40, 40, [=](int x, int y) {
            return glm::vec3(linearOf(0.5 + sign * ((x + y) % 2 ? 0.25 : -0.25)));
        });
    };
    const double variance = 1.0 / 16, c2 = 9e-4;
    EXPECT_NEAR(compareImages(checks(1), checks(-1), withoutFlip()).ssim,
                (c2 - 2 * variance) / (2 * variance + c2), 1e-4);
}

TEST(SsimTest, NoiseOnAConstant) {
    // No covariance: C2 / (variance in the window + C2). The window's own mean takes part of the variance.
    std::mt19937 generator(1);
    std::normal_distribution<double> noise(0, 0.01);
    const Image noisy =
        fromFunction(128, 128, [&](int, int) { return glm::vec3(linearOf(0.5 + noise(generator))); });
    double squares = 0, sum = 0;
    for (int i = -5; i <= 5; ++i) sum += std::exp(-i * i / 4.5);
    for (int i = -5; i <= 5; ++i) squares += std::pow(std::exp(-i * i / 4.5) / sum, 2);
    const double variance = 1e-4 * (1 - squares * squares), c2 = 9e-4;
    // 0.004: curvature over the spread of window variances (0.3 of them: 0.01 * 0.09) and 16,384 samples.
    EXPECT_NEAR(compareImages(noisy, constant(glm::vec3(linearOf(0.5)), 128, 128), withoutFlip()).ssim,
                c2 / (variance + c2), 0.004);
}

TEST(SsimTest, IsThePapersSumOverWindows) {
    // Greys of noise, correlated between the images; every window by its definition, mean first, then
    // moments.
    constexpr int kWidth = 23, kHeight = 17;
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> noise(0, 1);
    std::vector<double> a, b;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        a.push_back(noise(generator));
        b.push_back(0.7 * a.back() + 0.3 * noise(generator));
    }
    double sum = 0;
    for (int top = 0; top + 11 <= kHeight; ++top)
        for (int left = 0; left + 11 <= kWidth; ++left) {
            const auto mean = [&](auto&& value) {
                double total = 0, weights = 0;
                for (int y = 0; y < 11; ++y)
                    for (int x = 0; x < 11; ++x) {
                        const double w = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2 * 1.5 * 1.5));
                        total += w * value(std::size_t((top + y) * kWidth + left + x));
                        weights += w;
                    }
                return total / weights;
            };
            const double meanA = mean([&](std::size_t i) { return a[i]; });
            const double meanB = mean([&](std::size_t i) { return b[i]; });
            const double varianceA = mean([&](std::size_t i) { return std::pow(a[i] - meanA, 2); });
            const double varianceB = mean([&](std::size_t i) { return std::pow(b[i] - meanB, 2); });
            const double covariance = mean([&](std::size_t i) { return (a[i] - meanA) * (b[i] - meanB); });
            sum += (2 * meanA * meanB + 1e-4) * (2 * covariance + 9e-4) /
                   ((meanA * meanA + meanB * meanB + 1e-4) * (varianceA + varianceB + 9e-4));
        }
    const auto image = [&](const std::vector<double>& values) {
        return fromFunction(kWidth, kHeight, [&](int x, int y) {
            return glm::vec3(linearOf(values[std::size_t(y * kWidth + x)]));
        });
    };
    EXPECT_NEAR(compareImages(image(a), image(b), withoutFlip()).ssim, sum / (13 * 7), 1e-5);
}

TEST(SsimTest, PicturesSmallerThanAWindow) {
    const Metrics m = compareImages(constant(glm::vec3(0.5f), 1, 1), constant(glm::vec3(0.5f), 1, 1));
    EXPECT_NEAR(m.ssim, 1, 1e-9);
    EXPECT_EQ(m.flip, 0);
}

TEST(MetricsTest, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
    Image test = constant(glm::vec3(0.6f), 40, 40), reference = constant(glm::vec3(0.5f), 40, 40);
    const Metrics clean = compareImages(test, reference);
    test.pixels[3].r = kNan;
    test.pixels[801].g = -kInfinity;
    reference.pixels[802].b = kInfinity;
    const Metrics m = compareImages(test, reference);
    EXPECT_EQ(m.badPixels, 3u);
    EXPECT_EQ(m.pixels, 1597u);
    EXPECT_NEAR(m.bias, clean.bias, 1e-9);
    EXPECT_NEAR(m.mse, clean.mse, 1e-9);
    EXPECT_NEAR(m.psnr, clean.psnr, 1e-6);
    EXPECT_NEAR(m.ssim, clean.ssim, 1e-9);
    EXPECT_NEAR(m.flip, clean.flip, 0.05 * clean.flip);  // neighbours see black in both images
    for (const ErrorMap map : {ErrorMap::Signed, ErrorMap::Absolute, ErrorMap::RelativeSquared,
                               ErrorMap::Flip, ErrorMap::HdrFlip}) {
        const std::vector<float> values = errorValues(test, reference, map);
        EXPECT_TRUE(std::isnan(values[3])) << nameOf(map);
        EXPECT_TRUE(std::isfinite(values[4])) << nameOf(map);
    }
    Image allBad = constant(glm::vec3(kNan), 40, 40);
    EXPECT_THROW(compareImages(allBad, reference), Error);
}

TEST(MetricsTest, PixelsThatAreNotChosenDoNotCount) {
    // Half of the picture is off by a fifth, the other by a half.
    const Image test = fromFunction(40, 40, [](int, int y) { return glm::vec3(y < 20 ? 0.6f : 0.75f); });
    const Image reference = constant(glm::vec3(0.5f), 40, 40);
    MetricOptions options;
    options.pixels.assign(1600, 0);
    std::fill(options.pixels.begin(), options.pixels.begin() + 800, 1);
    const Metrics m = compareImages(test, reference, options);
    EXPECT_EQ(m.pixels, 800u);
    EXPECT_EQ(m.badPixels, 0u);
    EXPECT_NEAR(m.relRmse, 0.2, 1e-6);
    EXPECT_TRUE(std::isnan(errorValues(test, reference, ErrorMap::Signed, options)[900]));
    options.pixels.resize(7);
    EXPECT_THROW(compareImages(test, reference, options), Error);
}

TEST(MetricsTest, DifferentSizesAreBadInput) {
    try {
        compareImages(constant(glm::vec3(1), 4, 3), constant(glm::vec3(1), 3, 4));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        EXPECT_NE(std::string(error.what()).find("4x3 and 3x4"), std::string::npos) << error.what();
    }
    EXPECT_THROW(compareImages(Image{}, Image{}), Error);
}

TEST(MetricsTest, HalvesTakeTheReferencesNoiseOut) {
    // Truth 1, test 1.1, halves with independent noise of sigma 0.5.
    constexpr int kSide = 256;
    constexpr double kSigma = 0.5;
    std::mt19937 generator(7);
    std::normal_distribution<float> noise(0, float(kSigma));
    const auto noisy = [&](int, int) {
        return glm::vec3(1) + glm::vec3(noise(generator), noise(generator), noise(generator));
    };
    const Image a = fromFunction(kSide, kSide, noisy), b = fromFunction(kSide, kSide, noisy);
    Image reference = a;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i)
        reference.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
    const Image test = constant(glm::vec3(1.1f), kSide, kSide);

    // Four standard errors: Var (e - n1)(e - n2) = sigma^4 + 2 e^2 sigma^2.
    const double count = 3.0 * kSide * kSide;
    const double tolerance = 4 * std::sqrt((std::pow(kSigma, 4) + 2 * 0.01 * kSigma * kSigma) / count);
    EXPECT_NEAR(compareImages(test, reference, withoutFlip(), Halves{&a, &b}).mse, 0.01, tolerance);
    EXPECT_NEAR(compareImages(test, reference, withoutFlip()).mse, 0.01 + kSigma * kSigma / 2, 2 * tolerance);
    EXPECT_NEAR(compareImages(test, reference, withoutFlip(), Halves{&a, &b}).referenceNoise,
                std::sqrt(kSigma * kSigma / 2), 0.01);
}

// The interval holds the truth 95 of 100 times, of a picture whose error is below the reference's noise, with
// noise that differs from pixel to pixel and has the same sign in all channels, as that of light paths has.
TEST(MetricsTest, IntervalOfRelRmseHoldsTheTruth) {
    constexpr int kSide = 32, kTrials = 400;
    std::mt19937 generator(11);
    std::normal_distribution<float> noise(0, 1);
    const auto error = [](int x, int y) { return 0.02f * static_cast<float>(x % 5 + y % 3); };
    double square = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) square += std::pow(error(x, y), 2) / (kSide * kSide);
    const Image test = fromFunction(kSide, kSide, [&](int x, int y) { return glm::vec3(1 + error(x, y)); });
    const auto noisy = [&](int x, int) {
        return glm::vec3(1 + noise(generator) * (x < kSide / 4 ? 1.0f : 0.2f));
    };
    int below = 0, above = 0;
    double width = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        const Image a = fromFunction(kSide, kSide, noisy), b = fromFunction(kSide, kSide, noisy);
        Image reference = a;
        for (std::size_t i = 0; i < reference.pixels.size(); ++i)
            reference.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
        const Metrics m = compareImages(test, reference, withoutFlip(), Halves{&a, &b});
        const double truth = std::sqrt(square) / m.referenceMean;
        EXPECT_LE(m.relRmseLow, m.relRmse);
        EXPECT_LE(m.relRmse, m.relRmseHigh);
        below += truth < m.relRmseLow ? 1 : 0;
        above += truth > m.relRmseHigh ? 1 : 0;
        width += (m.relRmseHigh - m.relRmseLow) / kTrials;
    }
    // 5 % of 400, give or take three of its standard deviations: not too narrow, and not too wide.
    EXPECT_LE(below + above, 33);
    EXPECT_GE(below + above, 7);
    EXPECT_GT(width, 0.05);
    const Metrics plain = compareImages(test, test, withoutFlip());
    EXPECT_EQ(plain.relRmseLow, 0);
    EXPECT_EQ(plain.relRmseHigh, 0);
}

TEST(FlipTest, ConstantGreys) {
    MetricOptions options;
    const auto flip = [&](float a, float b) {
        return compareImages(constant(glm::vec3(a)), constant(glm::vec3(b)), options).flip;
    };
    EXPECT_NEAR(flip(0, 1), flipOfGreys(100), 1e-3);  // 0.967
    EXPECT_NEAR(flip(0.5f, 0.4f), flipOfGreys(lightness(0.5) - lightness(0.4)), 1e-3);
    EXPECT_NEAR(flip(0.20f, 0.21f), flipOfGreys(lightness(0.21) - lightness(0.20)), 1e-3);
}

TEST(FlipTest, GreenToBlueIsTheLargestDifference) {
    EXPECT_NEAR(compareImages(constant({0, 1, 0}), constant({0, 0, 1})).flip, 1, 1e-4);
}

TEST(FlipTest, SymmetricForDisplayImages) {
    const Image a = fromFunction(40, 30, [](int x, int y) { return glm::vec3(x % 5, y % 3, 2) * 0.2f; });
    const Image b = fromFunction(40, 30, [](int x, int y) { return glm::vec3(y % 4, 1, x % 2) * 0.25f; });
    const double forth = compareImages(a, b).flip, back = compareImages(b, a).flip;
    EXPECT_GT(forth, 0.05);
    EXPECT_NEAR(forth, back, 1e-6);
}

TEST(FlipTest, GrowsWithTheError) {
    std::mt19937 generator(3);
    std::uniform_real_distribution<float> pattern(-1, 1);
    std::vector<float> noise(64 * 48);
    for (float& value : noise) value = pattern(generator);
    const Image reference = constant(glm::vec3(0.5f), 64, 48);
    double lastLdr = 0, lastHdr = 0;
    for (const float amplitude : {0.02f, 0.05f, 0.1f, 0.2f, 0.4f}) {
        const Image test = fromFunction(64, 48, [&](int x, int y) {
            return glm::vec3(0.5f + amplitude * noise[std::size_t(64 * y + x)]);
        });
        const Metrics m = compareImages(test, reference);
        EXPECT_GT(m.flip, lastLdr);
        EXPECT_GT(m.hdrFlip, lastHdr);
        lastLdr = m.flip;
        lastHdr = m.hdrFlip;
    }
    EXPECT_LT(lastHdr, 1);
}

TEST(FlipTest, AnEdgeCountsMoreThanItsColour) {
    // Left half brighter: beside the new edge the difference is raised, far from it the colour part is left.
    const Image reference = constant(glm::vec3(0.4f), 128, 32);
    const Image test = fromFunction(128, 32, [](int x, int) { return glm::vec3(x < 64 ? 0.5f : 0.4f); });
    const std::vector<float> map = errorValues(test, reference, ErrorMap::Flip);
    const double far = flipOfGreys(lightness(0.5) - lightness(0.4));
    EXPECT_NEAR(map[16 * 128 + 20], far, 1e-3);
    EXPECT_GT(map[16 * 128 + 62], far * 1.1);
    EXPECT_NEAR(map[16 * 128 + 110], 0, 1e-3);
}

TEST(FlipTest, FineNoiseBlursWithDistance) {
    // A chessboard is a grey from afar: more pixels per degree, less difference.
    const Image reference = constant(glm::vec3(0.5f), 64, 64);
    const Image test =
        fromFunction(64, 64, [](int x, int y) { return glm::vec3((x + y) % 2 ? 0.6f : 0.4f); });
    MetricOptions near, far;
    near.pixelsPerDegree = 20;
    far.pixelsPerDegree = 100;
    EXPECT_GT(compareImages(test, reference, near).flip, 1.5 * compareImages(test, reference, far).flip);
}

TEST(HdrFlipTest, ConstantReference) {
    // One exposure shows the reference at 0.85 of the ACES fit f; the test is 1.5 times brighter.
    const auto f = [](double x) {
        x *= 0.6;
        return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    };
    double shown = 1;  // f(shown) = 0.85, by bisection
    for (double step = 1; step > 1e-9; step /= 2) shown += f(shown) < 0.85 ? step : -step;
    const double expected = flipOfGreys(lightness(std::min(1.0, f(1.5 * shown))) - lightness(0.85));
    for (const float scale : {1.0f, 1e-3f, 4e4f})
        EXPECT_NEAR(compareImages(constant(glm::vec3(1.5f * scale)), constant(glm::vec3(scale))).hdrFlip,
                    expected, 1e-3);
}

TEST(HdrFlipTest, SeesWhatADisplayClips) {
    const auto lamp = [](float radiance) {
        return fromFunction(48, 48, [=](int x, int y) {
            return glm::vec3(std::abs(x - 24) < 8 && std::abs(y - 24) < 8 ? radiance : 0.3f);
        });
    };
    const Metrics m = compareImages(lamp(40), lamp(20));
    EXPECT_NEAR(m.flip, 0, 1e-6);
    EXPECT_GT(m.hdrFlip, 0.02);
}

TEST(ErrorMapTest, ValuesOfConstantImages) {
    const Image test = constant({0.4f, 0.6f, 0.5f}), reference = constant(glm::vec3(0.5f));
    const float luminance = (-0.2126f + 0.7152f) * 0.1f;
    EXPECT_NEAR(errorValues(test, reference, ErrorMap::Signed)[7], luminance / 0.5f, 1e-6);
    EXPECT_NEAR(errorValues(reference, test, ErrorMap::Signed)[7], -luminance / 0.5f, 1e-6);
    EXPECT_NEAR(errorValues(reference, test, ErrorMap::Absolute)[7], luminance / 0.5f, 1e-6);
    EXPECT_NEAR(errorValues(test, reference, ErrorMap::RelativeSquared)[7], 0.02 / 3 / 0.26, 1e-6);
    EXPECT_EQ(errorMapOf("hdr-flip"), ErrorMap::HdrFlip);
    EXPECT_EQ(errorMapOf("Signed"), std::nullopt);
}

TEST(ErrorMapTest, Colours) {
    const auto color = [](float value, bool isSigned) {
        std::uint8_t rgb[3];
        colorOfError(value, isSigned, rgb);
        return std::vector<int>{rgb[0], rgb[1], rgb[2]};
    };
    EXPECT_EQ(color(0, false), (std::vector<int>{0, 0, 4}));
    EXPECT_EQ(color(1, false), (std::vector<int>{252, 253, 191}));
    EXPECT_EQ(color(kInfinity, false), color(1, false));
    EXPECT_EQ(color(0.5f, false), (std::vector<int>{183, 55, 121}));
    EXPECT_EQ(color(0, true), (std::vector<int>{247, 247, 247}));
    EXPECT_GT(color(0.5f, true)[0], color(0.5f, true)[2] + 50);    // too bright: red
    EXPECT_GT(color(-0.5f, true)[2], color(-0.5f, true)[0] + 50);  // too dark: blue
    EXPECT_EQ(color(-7, true), color(-1, true));
    EXPECT_EQ(color(kNan, false), (std::vector<int>{0, 255, 0}));
    EXPECT_EQ(color(kNan, true), (std::vector<int>{0, 255, 0}));
}

}  // namespace conelight::reference
