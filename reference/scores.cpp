// SPDX-License-Identifier: MIT
#include "reference/scores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/log.h"

namespace conelight::reference {
namespace {

bool finite(const glm::vec4& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

double sum(const glm::vec4& p) {
    return static_cast<double>(p.x) + static_cast<double>(p.y) + static_cast<double>(p.z);
}

void requireSameSize(const Image& a, const Image& b, const char* what) {
    if (a.width == b.width && a.height == b.height && !a.pixels.empty()) return;
    base::fail(ErrorKind::BadInput,
               "%s: pictures of %d x %d and %d x %d pixels; the same size would be right", what, a.width,
               a.height, b.width, b.height);
}

double meanOf(const Image& image) {
    double total = 0;
    std::size_t count = 0;
    for (const glm::vec4& p : image.pixels) {
        if (!finite(p)) continue;
        total += sum(p);
        count += 3;
    }
    return count > 0 ? total / static_cast<double>(count) : 0;
}

double ratioOf(double value, double mean) {
    if (mean > 0) return value / mean;
    return value > 0 ? std::numeric_limits<double>::infinity() : 0;
}

// Axes and size of the picture plane at distance 1; of parallel rays at any.
struct View {
    glm::dvec3 eye, forward, right, up;
    double tanX = 1, tanY = 1;
    bool parallel;
    int width, height;

    View(const Camera& camera, int w, int h) : parallel(camera.isOrthographic()), width(w), height(h) {
        eye = camera.eye;
        forward = glm::normalize(glm::dvec3(camera.target) - eye);
        right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
        up = glm::cross(right, forward);
        tanY = parallel ? 0.5 * static_cast<double>(camera.orthographicHeight)
                        : std::tan(0.5 * static_cast<double>(camera.fovY));
        tanX = tanY * w / h;
    }
    glm::dvec3 pointAt(int x, int y, double depth) const {
        const double u = (2 * (x + 0.5) / width - 1) * tanX;
        const double v = (1 - 2 * (y + 0.5) / height) * tanY;
        return eye + depth * forward + (parallel ? 1 : depth) * (u * right + v * up);
    }
    // Pixel coordinates (the first pixel's centre is 0, 0) and view depth.
    glm::dvec3 project(const glm::dvec3& point) const {
        const glm::dvec3 d = point - eye;
        const double depth = glm::dot(d, forward);
        const double scale = parallel ? 1 : depth;
        const double u = glm::dot(d, right) / (scale * tanX);
        const double v = glm::dot(d, up) / (scale * tanY);
        return {0.5 * (u + 1) * width - 0.5, 0.5 * (1 - v) * height - 0.5, depth};
    }
};

struct Errors {
    glm::dvec3 a{0}, b{0};  // against either half
};

std::size_t indexOf(const Image& image, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
}

// What is taken off the picture.
enum class Less { Reference, Nothing };

std::optional<Errors> errorsAt(const FlickerFrame& frame, Less less, int x, int y) {
    const std::size_t i = indexOf(frame.test, x, y);
    if (less == Less::Nothing) {
        const glm::vec4 t = frame.test.pixels[i];
        if (!finite(t)) return std::nullopt;
        return Errors{glm::dvec3(t), glm::dvec3(t)};
    }
    const glm::vec4 t = frame.test.pixels[i], a = frame.halfA.pixels[i], b = frame.halfB.pixels[i];
    if (!finite(t) || !finite(a) || !finite(b)) return std::nullopt;
    return Errors{glm::dvec3(t) - glm::dvec3(a), glm::dvec3(t) - glm::dvec3(b)};
}

// The error at a world point as another frame sees it; nothing when it is hidden there or outside, or next to
// an edge, where the four pixels show different surfaces.
std::optional<Errors> errorsOf(const FlickerFrame& frame, Less less, const View& view,
                               const glm::dvec3& point) {
    // 1/depth is linear over the pixels of a plane, so it is read like the errors and has to be right there.
    // What curves within a pixel, or lies behind an edge, is off by more.
    constexpr double kDepthTolerance = 0.005;
    // Half a thousandth of a pixel: a camera that stands still reads its own pixels, not their neighbours.
    constexpr double kSnap = 5e-4;
    const glm::dvec3 at = view.project(point);
    if (!(at.z > 0)) return std::nullopt;
    glm::dvec2 p(at);
    for (int i = 0; i < 2; ++i)
        if (std::abs(p[i] - std::round(p[i])) < kSnap) p[i] = std::round(p[i]);
    const glm::dvec2 low = glm::floor(p), part = p - low;
    Errors result;
    double inverseDepth = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const int dx = corner & 1, dy = corner >> 1;
        const double weight = (dx != 0 ? part.x : 1 - part.x) * (dy != 0 ? part.y : 1 - part.y);
        if (weight == 0) continue;
        const int x = static_cast<int>(low.x) + dx, y = static_cast<int>(low.y) + dy;
        if (x < 0 || y < 0 || x >= view.width || y >= view.height) return std::nullopt;
        const double depth = frame.depth.pixels[indexOf(frame.depth, x, y)].x;
        if (!(depth > 0)) return std::nullopt;
        inverseDepth += weight / depth;
        const std::optional<Errors> one = errorsAt(frame, less, x, y);
        if (!one) return std::nullopt;
        result.a += weight * one->a;
        result.b += weight * one->b;
    }
    if (!(std::abs(inverseDepth * at.z - 1) <= kDepthTolerance)) return std::nullopt;
    return result;
}

struct HighPass {
    double sum = 0, squares = 0;
    std::size_t used = 0;
};

// Of frame t, which has neighbours.
HighPass highPassOf(std::span<const FlickerFrame> frames, std::size_t t, Less less) {
    const FlickerFrame &before = frames[t - 1], &now = frames[t], &after = frames[t + 1];
    const int width = now.test.width, height = now.test.height;
    const View here(now.camera, width, height);
    const View views[2] = {{before.camera, width, height}, {after.camera, width, height}};
    HighPass result;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double depth = now.depth.pixels[indexOf(now.depth, x, y)].x;
            const std::optional<Errors> e = errorsAt(now, less, x, y);
            if (!(depth > 0) || !e) continue;
            const glm::dvec3 point = here.pointAt(x, y, depth);
            const std::optional<Errors> e0 = errorsOf(before, less, views[0], point);
            const std::optional<Errors> e1 = errorsOf(after, less, views[1], point);
            if (!e0 || !e1) continue;
            const double product = glm::dot(e->a - 0.5 * (e0->a + e1->a), e->b - 0.5 * (e0->b + e1->b));
            result.sum += product;
            result.squares += product * product;
            ++result.used;
        }
    return result;
}

// A mean of h^2 as a flicker.
double relativeOf(double meanSquare, double mean) {
    return ratioOf(std::sqrt(std::max(2.0 / 3.0 * meanSquare, 0.0)), mean);
}
double valueOf(const HighPass& h, double mean) {
    return relativeOf(h.used > 0 ? h.sum / (3 * static_cast<double>(h.used)) : 0, mean);
}

void requireThree(std::span<const FlickerFrame> frames) {
    if (frames.size() < 3)
        base::fail(ErrorKind::BadInput, "flicker: %zu frames; at least 3 would be right", frames.size());
}

}  // namespace

LeakScore leakScore(const Image& dark, const Image& darkReference, const Image& lit,
                    const Image& litReference, double blackLevel) {
    requireSameSize(dark, darkReference, "leak");
    const double limit = blackLevel * meanOf(litReference);
    LeakScore score;
    double total = 0;
    for (std::size_t i = 0; i < dark.pixels.size(); ++i) {
        const glm::vec4& truth = darkReference.pixels[i];
        if (!finite(truth) || !finite(dark.pixels[i]) || sum(truth) / 3 > limit) continue;
        ++score.darkPixels;
        total += sum(dark.pixels[i]);
    }
    if (score.darkPixels == 0)
        base::fail(ErrorKind::BadInput,
                   "leak: the reference is black nowhere; a camera in a place without light would be right");
    score.darkMean = total / (3 * static_cast<double>(score.darkPixels));
    score.litMean = meanOf(lit);
    score.ratio = ratioOf(score.darkMean, score.litMean);
    return score;
}

double meanRadiance(const Image& image) {
    double total = 0;
    std::size_t count = 0;
    for (const glm::vec4& pixel : image.pixels) {
        if (!finite(pixel)) continue;
        total += sum(pixel);
        count += 3;
    }
    return count == 0 ? 0 : total / static_cast<double>(count);
}

double relativeDifference(const Image& a, const Image& b, double mean) {
    requireSameSize(a, b, "difference");
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (!finite(a.pixels[i]) || !finite(b.pixels[i])) continue;
        const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
        squares += glm::dot(d, d);
        count += 3;
    }
    return count == 0 ? 0 : ratioOf(std::sqrt(squares / static_cast<double>(count)), mean);
}

double relativeDifference(const Image& a, const Image& b) {
    return relativeDifference(a, b, meanRadiance(b));
}

FlickerScore flickerScore(std::span<const FlickerFrame> frames, std::span<const std::size_t> middles) {
    requireThree(frames);
    std::vector<std::size_t> counted(middles.begin(), middles.end());
    for (std::size_t t = 1; middles.empty() && t + 1 < frames.size(); ++t) counted.push_back(t);
    FlickerScore score;
    std::size_t withHalves = 0;
    for (const FlickerFrame& frame : frames) {
        for (const Image* image : {&frame.test, &frame.depth})
            requireSameSize(*image, frames[0].test, "flicker");
        if (frame.halfA.pixels.empty()) continue;
        for (const Image* image : {&frame.halfA, &frame.halfB})
            requireSameSize(*image, frames[0].test, "flicker");
        score.mean += 0.5 * (meanOf(frame.halfA) + meanOf(frame.halfB));
        ++withHalves;
    }
    score.mean /= static_cast<double>(std::max<std::size_t>(withHalves, 1));
    HighPass all;
    for (const std::size_t t : counted) {
        for (std::size_t near = t - 1; near <= t + 1; ++near)
            requireSameSize(frames[near].halfA, frames[0].test, "flicker");
        const HighPass one = highPassOf(frames, t, Less::Reference);
        score.each.push_back(valueOf(one, score.mean));
        all.sum += one.sum;
        all.squares += one.squares;
        all.used += one.used;
    }
    if (all.used > 0)
        score.floor = relativeOf(std::sqrt(all.squares) / (3 * static_cast<double>(all.used)), score.mean);
    const double pixels = static_cast<double>(frames[0].test.pixels.size() * counted.size());
    score.pixelsUsed = static_cast<double>(all.used) / pixels;
    score.flicker = valueOf(all, score.mean);
    return score;
}

std::vector<double> unsteadiness(std::span<const FlickerFrame> frames) {
    requireThree(frames);
    double mean = 0;
    for (const FlickerFrame& frame : frames) {
        for (const Image* image : {&frame.test, &frame.depth})
            requireSameSize(*image, frames[0].test, "flicker");
        mean += meanOf(frame.test) / static_cast<double>(frames.size());
    }
    std::vector<double> each;
    for (std::size_t t = 1; t + 1 < frames.size(); ++t)
        each.push_back(valueOf(highPassOf(frames, t, Less::Nothing), mean));
    return each;
}

Jump jumpOf(std::span<const double> each) {
    constexpr std::size_t kAbout = 8;  // frames on either side
    Jump jump;
    for (std::size_t i = 1; i < each.size(); ++i) {
        const double both = std::min(each[i - 1], each[i]);
        const std::size_t from = i - std::min(i, kAbout), to = std::min(each.size(), i + kAbout);
        std::vector<double> about(each.begin() + static_cast<std::ptrdiff_t>(from),
                                  each.begin() + static_cast<std::ptrdiff_t>(to));
        const auto middle = about.begin() + static_cast<std::ptrdiff_t>(about.size() / 2);
        std::nth_element(about.begin(), middle, about.end());
        const double ratio = *middle > 0 ? both / *middle
                             : both > 0  ? std::numeric_limits<double>::infinity()
                                         : 1;
        if (ratio > jump.ratio) jump = {ratio, 1 + i};
    }
    return jump;
}

int settledAt(std::span<const double> errors, double fraction) {
    int frame = static_cast<int>(errors.size());
    if (errors.empty() || !(errors.back() <= fraction)) return 0;
    while (frame > 1 && errors[static_cast<std::size_t>(frame) - 2] <= fraction) --frame;
    return frame;
}

}  // namespace conelight::reference
