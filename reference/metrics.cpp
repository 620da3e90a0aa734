// SPDX-License-Identifier: MIT
// The metrics that are sums over pixels, and the frame around the others. Sums run in double precision in
// pixel order, so the numbers do not depend on threads.
#include "reference/metrics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "conelight/error.h"
#include "reference/metric_parts.h"

namespace conelight::reference {
namespace {

// Keeps relMSE finite where the reference is black (Rousselle et al. 2011, eq. 6).
constexpr double kRelMseFloor = 0.01;

bool isFinite(const glm::vec4& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

// part / whole, where 0 / 0 means "no difference".
double ratio(double part, double whole) {
    if (whole != 0) return part / whole;
    return part == 0 ? 0 : std::numeric_limits<double>::infinity();
}

double meanOf(const std::vector<float>& values, const std::vector<std::uint8_t>& usable) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!usable[i]) continue;
        sum += values[i];
        ++count;
    }
    return sum / static_cast<double>(count);
}

void addRadianceMetrics(Metrics& m, const Image& test, const Image& reference,
                        const std::optional<Halves>& halves, const std::vector<std::uint8_t>& usable) {
    double sumX = 0, sumR = 0, absolute = 0, squared = 0, relative = 0, noise = 0;
    double spread = 0;  // variance of `squared`
    for (std::size_t i = 0; i < usable.size(); ++i) {
        if (!usable[i]) continue;
        double chance = 0;
        for (int c = 0; c < 3; ++c) {
            const double x = test.pixels[i][c];
            const double r = reference.pixels[i][c];
            double square = (x - r) * (x - r);
            if (halves) {
                const double a = halves->a->pixels[i][c];
                const double b = halves->b->pixels[i][c];
                // E[(x-a)(x-b)] = (x - E r)^2 for independent halves: their noise has no square in it.
                square = (x - a) * (x - b);
                noise += (a - b) * (a - b) / 4;  // variance of (a + b) / 2
                chance += (a - b) * (x - 0.5 * (a + b));
            }
            sumX += x;
            sumR += r;
            absolute += std::abs(x - r);
            squared += square;
            relative += square / (r * r + kRelMseFloor);
        }
        spread += chance * chance;
    }
    const double count = 3.0 * static_cast<double>(m.pixels);
    m.mean = sumX / count;
    m.referenceMean = sumR / count;
    m.bias = ratio(m.mean - m.referenceMean, m.referenceMean);
    m.mae = absolute / count;
    m.mse = squared / count;
    m.rmse = std::sqrt(std::max(m.mse, 0.0));
    m.relRmse = ratio(m.rmse, m.referenceMean);
    constexpr double kWithin = 2;  // standard errors: 95 of 100 times
    const double wide = kWithin * std::sqrt(spread) / count;
    m.relRmseLow = ratio(std::sqrt(std::max(m.mse - wide, 0.0)), m.referenceMean);
    m.relRmseHigh = ratio(std::sqrt(std::max(m.mse + wide, 0.0)), m.referenceMean);
    m.relMse = relative / count;
    m.referenceNoise = ratio(std::sqrt(noise / count), m.referenceMean);
}

// Means of blocks of m.blockSize pixels a side. Sums of a row of blocks are kept for each block of it.
double blocksRelRmse(const Metrics& m, const Image& test, const Image& reference,
                     const std::optional<Halves>& halves, const std::vector<std::uint8_t>& usable) {
    struct Sums {
        glm::dvec3 a{0}, b{0};  // of the errors against either half, or twice against the reference
        std::size_t pixels = 0;
    };
    const Image& first = halves ? *halves->a : reference;
    const Image& second = halves ? *halves->b : reference;
    const int n = m.blockSize;
    double squared = 0;
    for (int top = 0; top < test.height; top += n) {
        std::vector<Sums> row(std::size_t((test.width + n - 1) / n));
        for (int y = top; y < std::min(top + n, test.height); ++y)
            for (int x = 0; x < test.width; ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(test.width) + std::size_t(x);
                if (!usable[i]) continue;
                Sums& block = row[std::size_t(x / n)];
                const glm::dvec3 value = glm::dvec3(test.pixels[i]);
                block.a += value - glm::dvec3(first.pixels[i]);
                block.b += value - glm::dvec3(second.pixels[i]);
                ++block.pixels;
            }
        // A block of k pixels counts k times the square of its mean error.
        for (const Sums& block : row)
            if (block.pixels > 0) squared += glm::dot(block.a, block.b) / double(block.pixels);
    }
    const double mse = squared / (3.0 * static_cast<double>(m.pixels));
    return ratio(std::sqrt(std::max(mse, 0.0)), m.referenceMean);
}

// Encoded luma of a display image.
std::vector<float> lumaOf(const Colors& display) {
    std::vector<float> luma;
    luma.reserve(display.pixels.size());
    for (const glm::vec3& c : display.pixels)
        luma.push_back(luminanceOf({srgbOf(c.r), srgbOf(c.g), srgbOf(c.b)}));
    return luma;
}

double psnrOf(const Colors& test, const Colors& reference, const std::vector<std::uint8_t>& usable) {
    double squared = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < usable.size(); ++i) {
        if (!usable[i]) continue;
        for (int c = 0; c < 3; ++c) {
            const double difference = double(srgbOf(test.pixels[i][c])) - srgbOf(reference.pixels[i][c]);
            squared += difference * difference;
        }
        count += 3;
    }
    return 10 * std::log10(static_cast<double>(count) / squared);  // +infinity for equal images
}

}  // namespace

std::vector<std::uint8_t> usablePixels(const std::vector<const Image*>& images,
                                       const std::vector<std::uint8_t>& chosen) {
    const Image& first = *images.front();
    if (first.width <= 0 || first.height <= 0 ||
        first.pixels.size() != std::size_t(first.width) * std::size_t(first.height))
        throw Error(ErrorKind::BadInput, "comparison: an image has no pixels");
    for (const Image* image : images)
        if (image->width != first.width || image->height != first.height ||
            image->pixels.size() != first.pixels.size())
            throw Error(
                ErrorKind::BadInput,
                fmt::format("comparison: the images are {}x{} and {}x{} pixels; the same size would be "
                            "right",
                            first.width, first.height, image->width, image->height));
    if (!chosen.empty() && chosen.size() != first.pixels.size())
        throw Error(
            ErrorKind::BadInput,
            fmt::format("comparison: {} pixels are chosen of {} x {}; one number for each would be right",
                        chosen.size(), first.width, first.height));
    std::vector<std::uint8_t> usable = chosen;
    usable.resize(first.pixels.size(), 1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < usable.size(); ++i) {
        for (const Image* image : images)
            if (!isFinite(image->pixels[i])) usable[i] = 0;
        count += usable[i];
    }
    if (count == 0)
        throw Error(ErrorKind::BadInput, "comparison: no pixel that counts is finite in all images");
    return usable;
}

Colors usableColors(const Image& image, const std::vector<std::uint8_t>& usable) {
    Colors colors{image.width, image.height, std::vector<glm::vec3>(image.pixels.size(), glm::vec3(0))};
    for (std::size_t i = 0; i < usable.size(); ++i)
        if (usable[i]) colors.pixels[i] = glm::vec3(image.pixels[i]);
    return colors;
}

Colors displayColors(const Colors& colors, float exposure) {
    const float scale = std::exp2(exposure);
    Colors display = colors;
    for (glm::vec3& c : display.pixels) c = glm::clamp(c * scale, 0.0f, 1.0f);
    return display;
}

float srgbOf(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

Metrics compareImages(const Image& test, const Image& reference, const MetricOptions& options,
                      std::optional<Halves> halves, FlipMaps* maps) {
    std::vector<const Image*> images = {&test, &reference};
    if (halves) images.insert(images.end(), {halves->a, halves->b});
    const std::vector<std::uint8_t> usable = usablePixels(images, options.pixels);

    Metrics m;
    for (std::size_t i = 0; i < usable.size(); ++i)
        if (usable[i] != 0 || options.pixels.empty() || options.pixels[i] != 0)
            ++(usable[i] != 0 ? m.pixels : m.badPixels);
    addRadianceMetrics(m, test, reference, halves, usable);
    m.blockSize = std::max(options.blockSize, 1);
    m.blockRelRmse = blocksRelRmse(m, test, reference, halves, usable);

    const Colors x = usableColors(test, usable);
    const Colors r = usableColors(reference, usable);
    const Colors displayX = displayColors(x, options.exposure);
    const Colors displayR = displayColors(r, options.exposure);
    m.psnr = psnrOf(displayX, displayR, usable);
    m.ssim = meanSsim(lumaOf(displayX), lumaOf(displayR), x.width, x.height, usable);
    if (options.flip) {
        FlipMaps both = {ldrFlip(displayX, displayR, options.pixelsPerDegree),
                         hdrFlip(x, r, options.pixelsPerDegree)};
        m.flip = meanOf(both.flip, usable);
        m.hdrFlip = meanOf(both.hdrFlip, usable);
        for (std::size_t i = 0; i < usable.size(); ++i)
            if (!usable[i]) both.flip[i] = both.hdrFlip[i] = std::numeric_limits<float>::quiet_NaN();
        if (maps) *maps = std::move(both);
    }
    return m;
}

}  // namespace conelight::reference
