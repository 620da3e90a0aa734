// SPDX-License-Identifier: MIT
// FLIP against a second implementation that follows the definitions literally: whole two-dimensional kernels,
// double precision, CIELAB by its textbook formula. It is slow and small, and shares no code with the first.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "reference/metrics.h"

namespace conelight::reference {
namespace {

using Triple = std::array<double, 3>;

struct Grid {
    int width = 0, height = 0;
    std::vector<Triple> values;
    const Triple& at(int x, int y) const {
        return values[std::size_t(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
    }
};

Triple map(const Triple& v, const std::array<Triple, 3>& rows) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) result[i] += rows[i][j] * v[j];
    return result;
}

// sRGB (IEC 61966-2-1) to XYZ and back, the standard's four digits; white is what (1,1,1) becomes.
constexpr std::array<Triple, 3> kToXyz = {
    {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
constexpr std::array<Triple, 3> kFromXyz = {{{3.2406255, -1.5372080, -0.4986286},
                                             {-0.9689307, 1.8757561, 0.0415175},
                                             {0.0557101, -0.2040211, 1.0569959}}};
constexpr Triple kWhite = {0.9505, 1.0, 1.0890};

Triple toOpponent(const Triple& rgb) {
    const Triple xyz = map(rgb, kToXyz);
    const double x = xyz[0] / kWhite[0], y = xyz[1], z = xyz[2] / kWhite[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Triple fromOpponent(const Triple& c) {
    const double y = (c[0] + 16) / 116;
    return map({(y + c[1] / 500) * kWhite[0], y, (y - c[2] / 200) * kWhite[2]}, kFromXyz);
}

Triple toHuntLab(const Triple& rgb) {
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    const Triple xyz = map(rgb, kToXyz);
    const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1]), z = f(xyz[2] / kWhite[2]);
    const double lightness = 116 * y - 16;
    return {lightness, lightness / 100 * 500 * (x - y), lightness / 100 * 200 * (y - z)};
}

// Sum over a square of kernel(x, y) times a channel.
double filtered(const Grid& grid, int x, int y, std::size_t channel, int radius,
                const std::function<double(int, int)>& kernel) {
    double sum = 0;
    for (int v = -radius; v <= radius; ++v)
        for (int u = -radius; u <= radius; ++u) sum += kernel(u, v) * grid.at(x + u, y + v)[channel];
    return sum;
}

// Contrast sensitivity of a channel, the HPG paper's constants.
double sensitivity(std::size_t channel, double degrees2) {
    const auto term = [&](double a, double b) {
        return a * std::sqrt(std::numbers::pi / b) *
               std::exp(-std::numbers::pi * std::numbers::pi * degrees2 / b);
    };
    return channel == 0   ? term(1, 0.0047)
           : channel == 1 ? term(1, 0.0053)
                          : term(34.1, 0.04) + term(13.5, 0.025);
}

struct Eye {
    double pixelsPerDegree;

    Triple colorAt(const Grid& opponent, int x, int y) const {
        const int radius =
            int(std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * pixelsPerDegree));
        Triple blurred;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto weight = [&](int u, int v) {
                return sensitivity(c, (u * u + v * v) / (pixelsPerDegree * pixelsPerDegree));
            };
            double total = 0;
            for (int v = -radius; v <= radius; ++v)
                for (int u = -radius; u <= radius; ++u) total += weight(u, v);
            blurred[c] = filtered(opponent, x, y, c, radius, weight) / total;
        }
        Triple rgb = fromOpponent(blurred);
        for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
        return toHuntLab(rgb);
    }

    // Magnitude of the edge (order 1) or point (order 2) detector.
    double featureAt(const Grid& opponent, int x, int y, int order) const {
        const double sigma = 0.5 * 0.082 * pixelsPerDegree;
        const int radius = int(std::ceil(3 * sigma));
        const auto raw = [&](int u, int v) {
            const double g = std::exp(-(u * u + v * v) / (2 * sigma * sigma));
            return (order == 1 ? -u : u * u / (sigma * sigma) - 1) * g;
        };
        double positive = 0, negative = 0;
        for (int v = -radius; v <= radius; ++v)
            for (int u = -radius; u <= radius; ++u)
                (raw(u, v) > 0 ? positive : negative) += std::abs(raw(u, v));
        const auto kernel = [&](int u, int v) { return raw(u, v) / (raw(u, v) > 0 ? positive : negative); };
        const double across = filtered(opponent, x, y, 0, radius, kernel);
        const double down = filtered(opponent, x, y, 0, radius, [&](int u, int v) { return kernel(v, u); });
        return std::hypot(across, down) / 116;  // of (Y + 16) / 116; the constant has no derivative
    }
};

double hyab(const Triple& a, const Triple& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

Grid opponentOf(const Grid& rgb) {
    Grid result = rgb;
    for (Triple& c : result.values) c = toOpponent(c);
    return result;
}

double flipAt(const Grid& test, const Grid& reference, int x, int y, double pixelsPerDegree) {
    const Eye eye{pixelsPerDegree};
    const double largest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), 0.7);
    const double distance = std::pow(hyab(eye.colorAt(test, x, y), eye.colorAt(reference, x, y)), 0.7);
    const double knee = 0.4 * largest;
    const double color =
        distance < knee ? 0.95 / knee * distance : 0.95 + (distance - knee) / (largest - knee) * 0.05;
    double feature = 0;
    for (const int order : {1, 2})
        feature = std::max(
            feature, std::abs(eye.featureAt(test, x, y, order) - eye.featureAt(reference, x, y, order)));
    return std::pow(color, 1 - std::sqrt(feature / std::sqrt(2.0)));
}

// Smooth colours, an edge, a dot, and noise.
Image picture(unsigned seed, int width, int height, float gain) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> noise(0, 0.3f);
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 c(float(x) / float(width), 0.2f, float(y) / float(height));
            if (x + y > int(seed) + 14) c = {0.1f, 0.7f, 0.2f};
            if (x == 5 && y == int(seed) + 3) c = glm::vec3(1);
            image.pixels.emplace_back(
                (c * 0.7f + glm::vec3(noise(generator), noise(generator), noise(generator))) * gain, 1.0f);
        }
    return image;
}

Grid gridOf(const Image& image, const std::function<double(double)>& curve) {
    Grid grid{image.width, image.height, {}};
    for (const glm::vec4& c : image.pixels) grid.values.push_back({curve(c.r), curve(c.g), curve(c.b)});
    return grid;
}

}  // namespace

TEST(FlipPaperTest, LdrFlipIsThePapers) {
    for (const double pixelsPerDegree : {67.02, 25.0}) {
        const Image test = picture(1, 22, 16, 1), reference = picture(4, 22, 16, 1);
        MetricOptions options;
        options.pixelsPerDegree = float(pixelsPerDegree);
        const std::vector<float> map = errorValues(test, reference, ErrorMap::Flip, options);
        const auto clip = [](double c) { return std::clamp(c, 0.0, 1.0); };
        const Grid x = opponentOf(gridOf(test, clip)), r = opponentOf(gridOf(reference, clip));
        // 0.002: the standard's matrices have four digits, and the square root in the exponent sharpens the
        // smallest differences.
        for (int i = 0; i < 22 * 16; i += 7)
            EXPECT_NEAR(map[std::size_t(i)], flipAt(x, r, i % 22, i / 22, pixelsPerDegree), 2e-3) << i;
    }
}

TEST(FlipPaperTest, HdrFlipIsTheLargestOverExposures) {
    // Radiance up to 60 over a median of about 1: six stops and more.
    Image test = picture(1, 22, 16, 2), reference = picture(4, 22, 16, 2);
    for (int i = 0; i < 5; ++i) {
        reference.pixels[std::size_t(40 + i)] = glm::vec4(60, 40, 20, 1);
        test.pixels[std::size_t(40 + i)] = glm::vec4(30, 40, 20, 1);
    }
    const std::vector<float> map = errorValues(test, reference, ErrorMap::HdrFlip);

    const auto aces = [](double c) {
        c *= 0.6;
        return std::clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
    };
    double shown = 1;
    for (double step = 1; step > 1e-12; step /= 2) shown += aces(shown) < 0.85 ? step : -step;
    std::vector<double> luminance;
    for (const glm::vec4& c : reference.pixels)
        luminance.push_back(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
    std::sort(luminance.begin(), luminance.end());
    const double median = (luminance[luminance.size() / 2 - 1] + luminance[luminance.size() / 2]) / 2;
    const double start = std::log2(shown / luminance.back()), stop = std::log2(shown / median);
    const int count = std::max(2, int(std::ceil(stop - start)));
    ASSERT_GE(count, 5);
    std::vector<double> largest(map.size(), 0);
    for (int k = 0; k < count; ++k) {
        const double gain = std::exp2(start + k * (stop - start) / (count - 1));
        const auto curve = [&](double c) { return aces(gain * c); };
        const Grid x = opponentOf(gridOf(test, curve)), r = opponentOf(gridOf(reference, curve));
        for (int i = 0; i < 22 * 16; i += 11)
            largest[std::size_t(i)] = std::max(largest[std::size_t(i)], flipAt(x, r, i % 22, i / 22, 67.02));
    }
    for (int i = 0; i < 22 * 16; i += 11)
        EXPECT_NEAR(map[std::size_t(i)], largest[std::size_t(i)], 2e-3) << i;
}

}  // namespace conelight::reference
