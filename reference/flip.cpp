// SPDX-License-Identifier: MIT
// FLIP: two display images -> per pixel, how strong the difference looks when one flips between them, [0,1].
// Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020,
// and for high dynamic range Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021. Constants and the order of steps are those of the authors' public implementation; the
// published values of its sample pictures have not been reproduced here. All filters are sums of separable
// ones and run so; borders repeat the outermost pixel.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include "reference/metric_parts.h"

#include <glm/gtc/constants.hpp>

namespace conelight::reference {
namespace {

// One channel of a picture.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;
};

// --- Colour spaces (D65) -------------------------------------------------------------------

// Linear sRGB to XYZ from the primaries of BT.709 and D65, to 6 digits.
const glm::mat3 kXyzFromRgb = glm::transpose(glm::mat3(0.412386f, 0.357591f, 0.180450f,  //
                                                       0.212637f, 0.715183f, 0.072180f,  //
                                                       0.019331f, 0.119197f, 0.950373f));
const glm::mat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const glm::vec3 kWhite = kXyzFromRgb * glm::vec3(1);

// The linear opponent space of S-CIELAB (Zhang and Wandell 1996): CIELAB without its cube root.
glm::vec3 ycxczFromRgb(const glm::vec3& rgb) {
    const glm::vec3 t = kXyzFromRgb * rgb / kWhite;
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

glm::vec3 rgbFromYcxcz(const glm::vec3& c) {
    const float y = (c.x + 16) / 116;
    return kRgbFromXyz * (glm::vec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

float labCurve(float t) {
    constexpr float kDelta = 6.0f / 29.0f;  // CIE 15
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29.0f;
}

// CIELAB with chroma scaled by lightness (Hunt 1952).
glm::vec3 huntLabFromRgb(const glm::vec3& rgb) {
    const glm::vec3 t = kXyzFromRgb * rgb / kWhite;
    const float x = labCurve(t.x), y = labCurve(t.y), z = labCurve(t.z);
    const float lightness = 116 * y - 16;
    const float hunt = 0.01f * lightness;
    return {lightness, hunt * 500 * (x - y), hunt * 200 * (y - z)};
}

// HyAB (Abasi et al. 2020): city block in lightness, Euclidean in chroma.
float hyab(const glm::vec3& a, const glm::vec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// --- Filters --------------------------------------------------------------------------------------------

using Kernel = std::vector<float>;  // odd length, centre in the middle

// Adds weight * (across x down) filtered `in` to `out`.
void addFiltered(const Plane& in, const Kernel& across, const Kernel& down, float weight, Plane& out) {
    const int width = in.width, height = in.height;
    const int radiusX = int(across.size()) / 2, radiusY = int(down.size()) / 2;
    const auto row = [&](int y) { return std::size_t(y) * std::size_t(width); };

    std::vector<float> padded(std::size_t(width + 2 * radiusX));
    Plane half{width, height, std::vector<float>(in.values.size(), 0.0f)};
    for (int y = 0; y < height; ++y) {
        for (int x = -radiusX; x < width + radiusX; ++x)
            padded[std::size_t(x + radiusX)] = in.values[row(y) + std::size_t(std::clamp(x, 0, width - 1))];
        float* target = &half.values[row(y)];
        for (std::size_t k = 0; k < across.size(); ++k)
            for (int x = 0; x < width; ++x) target[x] += across[k] * padded[std::size_t(x) + k];
    }
    for (int y = 0; y < height; ++y) {
        float* target = &out.values[row(y)];
        for (int k = -radiusY; k <= radiusY; ++k) {
            const float* source = &half.values[row(std::clamp(y + k, 0, height - 1))];
            const float w = weight * down[std::size_t(k + radiusY)];
            for (int x = 0; x < width; ++x) target[x] += w * source[x];
        }
    }
}

Plane filtered(const Plane& in, const Kernel& across, const Kernel& down) {
    Plane out{in.width, in.height, std::vector<float>(in.values.size(), 0.0f)};
    addFiltered(in, across, down, 1, out);
    return out;
}

float sumOf(const Kernel& kernel) {
    float sum = 0;
    for (const float weight : kernel) sum += weight;
    return sum;
}

// One Gaussian of a contrast sensitivity function, in the spatial domain:
// a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees.
struct Sensitivity {
    float a, b;
};
// The paper's constants of spatial filtering.
constexpr Sensitivity kAchromatic[] = {{1, 0.0047f}};
constexpr Sensitivity kRedGreen[] = {{1, 0.0053f}};
constexpr Sensitivity kBlueYellow[] = {{34.1f, 0.04f}, {13.5f, 0.025f}};
constexpr float kWidestB = 0.04f;

template <std::size_t count>
Plane contrastFiltered(const Plane& in, const Sensitivity (&terms)[count], float pixelsPerDegree) {
    // Three standard deviations of the widest, for all channels.
    const int radius =
        int(std::ceil(3 * std::sqrt(kWidestB / (2 * glm::pi<float>() * glm::pi<float>())) * pixelsPerDegree));
    Kernel kernels[count];
    float weights[count];
    float total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        for (int x = -radius; x <= radius; ++x) {
            const float degrees = float(x) / pixelsPerDegree;
            kernels[i].push_back(
                std::exp(-glm::pi<float>() * glm::pi<float>() * degrees * degrees / terms[i].b));
        }
        weights[i] = terms[i].a * std::sqrt(glm::pi<float>() / terms[i].b);
        total += weights[i] * sumOf(kernels[i]) * sumOf(kernels[i]);
    }
    Plane out{in.width, in.height, std::vector<float>(in.values.size(), 0.0f)};
    for (std::size_t i = 0; i < count; ++i) addFiltered(in, kernels[i], kernels[i], weights[i] / total, out);
    return out;
}

// Makes the positive weights sum to 1 and the negative ones to -1.
void normalizeSigned(Kernel& kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
    for (float& weight : kernel) weight /= weight > 0 ? positive : negative;
}

// --- The two pipelines ----------------------------------------------------------------------------------

// What one image brings to both pipelines.
struct Seen {
    std::vector<glm::vec3> lab;        // after the eye's blur, Hunt-adjusted CIELAB
    std::vector<float> edges, points;  // magnitude of features
};

std::vector<float> featureMagnitude(const Plane& y, const Kernel& derivative, const Kernel& smooth) {
    const Plane horizontal = filtered(y, derivative, smooth);
    const Plane vertical = filtered(y, smooth, derivative);
    std::vector<float> magnitude(y.values.size());
    for (std::size_t i = 0; i < magnitude.size(); ++i)
        magnitude[i] =
            std::sqrt(horizontal.values[i] * horizontal.values[i] + vertical.values[i] * vertical.values[i]);
    return magnitude;
}

// Edges and points in lightness: first and second derivative of a Gaussian.
void findFeatures(const Plane& y, float pixelsPerDegree, Seen& seen) {
    constexpr float kFeatureDegrees =
        0.082f;  // peak to trough of the eye's edge detector, as the paper has it
    const float sigma = 0.5f * kFeatureDegrees * pixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    Kernel smooth, edge, point;
    for (int x = -radius; x <= radius; ++x) {
        const float g = std::exp(-float(x * x) / (2 * sigma * sigma));
        smooth.push_back(g);
        edge.push_back(-float(x) * g);
        point.push_back((float(x * x) / (sigma * sigma) - 1) * g);
    }
    const float sum = sumOf(smooth);
    for (float& weight : smooth) weight /= sum;
    normalizeSigned(edge);
    normalizeSigned(point);
    seen.edges = featureMagnitude(y, edge, smooth);
    seen.points = featureMagnitude(y, point, smooth);
}

Seen see(const Colors& colors, float pixelsPerDegree) {
    const std::size_t count = colors.pixels.size();
    Plane channels[3];
    for (Plane& channel : channels) channel = {colors.width, colors.height, std::vector<float>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 c = ycxczFromRgb(colors.pixels[i]);
        for (int k = 0; k < 3; ++k) channels[k].values[i] = c[k];
    }
    Seen seen;
    seen.lab.resize(count);
    const Plane a = contrastFiltered(channels[0], kAchromatic, pixelsPerDegree);
    const Plane rg = contrastFiltered(channels[1], kRedGreen, pixelsPerDegree);
    const Plane by = contrastFiltered(channels[2], kBlueYellow, pixelsPerDegree);
    for (std::size_t i = 0; i < count; ++i)
        seen.lab[i] =
            huntLabFromRgb(glm::clamp(rgbFromYcxcz({a.values[i], rg.values[i], by.values[i]}), 0.0f, 1.0f));

    for (float& y : channels[0].values) y = (y + 16) / 116;
    findFeatures(channels[0], pixelsPerDegree, seen);
    return seen;
}

constexpr float kColorExponent = 0.7f;    // q_c
constexpr float kFeatureExponent = 0.5f;  // q_f

// Maps a powered HyAB distance to [0,1]: the first p_c of the range takes p_t of it.
float colorDifference(const glm::vec3& a, const glm::vec3& b) {
    constexpr float kPc = 0.4f, kPt = 0.95f;
    // The largest distance of two displayable colours: green to blue.
    static const float kLargest =
        std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColorExponent);
    const float distance = std::pow(hyab(a, b), kColorExponent);
    const float knee = kPc * kLargest;
    return distance < knee ? kPt / knee * distance : kPt + (distance - knee) / (kLargest - knee) * (1 - kPt);
}

// --- HDR ------------------------------------------------------------------------------------------------

// The ACES fit that HDR-FLIP assumes (Narkowicz 2015, without its pre-exposure of 0.6):
// f(x) = (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
constexpr float kK0 = 0.6f * 0.6f * 2.51f, kK1 = 0.6f * 0.03f;
constexpr float kK3 = 0.6f * 0.6f * 2.43f, kK4 = 0.6f * 0.59f, kK5 = 0.14f;

Colors toneMapped(const Colors& colors, float exposure) {
    const float scale = std::exp2(exposure);
    Colors result = colors;
    for (glm::vec3& c : result.pixels) {
        // From 1e6 on the curve is at its end, and its squares would overflow.
        c = glm::clamp(c * scale, 0.0f, 1e6f);
        c = glm::clamp((kK0 * c * c + kK1 * c) / (kK3 * c * c + kK4 * c + kK5), 0.0f, 1.0f);
    }
    return result;
}

// Exposures from where the brightest pixel of the reference is shown at 85 % to where its median is: as many
// as there are stops between, at least two.
std::vector<float> exposuresFor(const Colors& reference) {
    constexpr float kShown = 0.85f;
    const float p = (kK1 - kK4 * kShown) / (kK0 - kK3 * kShown), q = -kK5 * kShown / (kK0 - kK3 * kShown);
    const float shown = -p / 2 + std::sqrt(p * p / 4 - q);  // f(shown) = 0.85

    std::vector<float> luminance;
    luminance.reserve(reference.pixels.size());
    for (const glm::vec3& c : reference.pixels) luminance.push_back(std::max(luminanceOf(c), 0.0f));
    std::sort(luminance.begin(), luminance.end());
    const float brightest = luminance.back();
    if (!(brightest > 0)) return {0};
    // A median of 0 would be shown by an infinite exposure; the smallest one seen then stands for it.
    float median = (luminance[(luminance.size() - 1) / 2] + luminance[luminance.size() / 2]) / 2;
    if (!(median > 0)) median = *std::upper_bound(luminance.begin(), luminance.end(), 0.0f);

    const float start = std::log2(shown / brightest), stop = std::log2(shown / median);
    const int count = std::max(2, int(std::ceil(stop - start)));
    std::vector<float> exposures;
    for (int i = 0; i < count; ++i) exposures.push_back(start + float(i) * (stop - start) / float(count - 1));
    return exposures;
}

}  // namespace

std::vector<float> ldrFlip(const Colors& test, const Colors& reference, float pixelsPerDegree) {
    const Seen x = see(test, pixelsPerDegree);
    const Seen r = see(reference, pixelsPerDegree);
    std::vector<float> flip(x.lab.size());
    for (std::size_t i = 0; i < flip.size(); ++i) {
        const float color = colorDifference(x.lab[i], r.lab[i]);
        const float feature =
            std::max(std::abs(x.edges[i] - r.edges[i]), std::abs(x.points[i] - r.points[i]));
        const float exponent = 1 - std::pow(feature / std::numbers::sqrt2_v<float>, kFeatureExponent);
        flip[i] = std::pow(color, exponent);
    }
    return flip;
}

std::vector<float> hdrFlip(const Colors& test, const Colors& reference, float pixelsPerDegree) {
    const std::vector<float> exposures = exposuresFor(reference);
    std::vector<std::vector<float>> maps(exposures.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < exposures.size(); i = next++)
            maps[i] =
                ldrFlip(toneMapped(test, exposures[i]), toneMapped(reference, exposures[i]), pixelsPerDegree);
    };
    std::vector<std::jthread> helpers;
    const std::size_t threads = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
    for (std::size_t i = 1; i < std::min(threads, exposures.size()); ++i) helpers.emplace_back(work);
    work();
    helpers.clear();  // joins

    // The largest difference over all exposures; the order of threads does not show.
    std::vector<float> flip = std::move(maps.front());
    for (std::size_t k = 1; k < maps.size(); ++k)
        for (std::size_t i = 0; i < flip.size(); ++i) flip[i] = std::max(flip[i], maps[k][i]);
    return flip;
}

}  // namespace conelight::reference
