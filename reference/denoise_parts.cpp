// SPDX-License-Identifier: MIT
#include "reference/denoise_parts.h"

#include <algorithm>
#include <cmath>

namespace conelight::reference {
namespace {

using ColorList = std::vector<glm::vec3>;

constexpr float kLeastReflectance = 0.01f;  // light is divided by no less: black surfaces keep what they show
constexpr float kBrightest = 1e12f;

// The smaller of the differences on both sides: an edge is no slope.
float slopeAt(const std::vector<float>& distance, std::size_t at, std::size_t step, bool before, bool after) {
    constexpr float kNone = 3.4e38f;
    float least = kNone;
    if (before && distance[at - step] > 0) least = std::abs(distance[at] - distance[at - step]);
    if (after && distance[at + step] > 0)
        least = std::min(least, std::abs(distance[at + step] - distance[at]));
    return least < kNone ? least : 0.0f;
}

void setMean(Image& image, const HalfColors& halves) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {0.5f * (halves[0][i] + halves[1][i]), image.pixels[i].a};
}

void setHalves(Image& a, Image& b, const HalfColors& halves) {
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        a.pixels[i] = {halves[0][i], a.pixels[i].a};
        b.pixels[i] = {halves[1][i], b.pixels[i].a};
    }
}

HalfColors sumOf(HalfColors a, const HalfColors& b) {
    for (std::size_t h = 0; h < 2; ++h)
        for (std::size_t i = 0; i < a[h].size(); ++i) a[h][i] += b[h][i];
    return a;
}

// Estimated relRMSE of what the filter leaves.
double noiseLeft(const PathTracedPicture& noisy, const PathTracedPicture& clean) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < noisy.full.pixels.size(); ++i) {
        const glm::dvec3 a(usableColor(noisy.halfA.pixels[i])), b(usableColor(noisy.halfB.pixels[i]));
        const glm::dvec3 error =
            errorOf(a, b, glm::dvec3(clean.halfA.pixels[i]), glm::dvec3(clean.halfB.pixels[i]));
        squares += error.r + error.g + error.b;
        const glm::dvec3 mean = 0.5 * (a + b);
        sum += mean.r + mean.g + mean.b;
    }
    const double count = 3.0 * static_cast<double>(noisy.full.pixels.size());
    return sum > 0 ? std::sqrt(std::max(squares, 0.0) / count) / (sum / count) : 0;
}

}  // namespace

glm::vec3 usableColor(const glm::vec4& pixel) {
    glm::vec3 result(0);
    for (int c = 0; c < 3; ++c)
        if (std::isfinite(pixel[c])) result[c] = std::clamp(pixel[c], -kBrightest, kBrightest);
    return result;
}

HalfColors LightPart::light() const {
    HalfColors result = irradiance;
    for (std::size_t h = 0; h < 2; ++h)
        for (std::size_t i = 0; i < result[h].size(); ++i) result[h][i] *= reflectance[h][i];
    return result;
}

LightParts partsOf(const PathTracedPicture& picture) {
    const FeaturePictures& f = picture.features;
    const Image* const full[] = {&picture.halfA, &picture.halfB};
    const Image* const indirect[] = {&picture.indirectA, &picture.indirectB};
    const Image* const diffuse[] = {&f.diffuseA, &f.diffuseB};
    const Image* const emission[] = {&f.emissionA, &f.emissionB};
    const Image* const albedo[] = {&f.albedoA, &f.albedoB};
    const Image* const gloss[] = {&f.glossA, &f.glossB};
    const std::size_t count = picture.full.pixels.size();
    LightParts result;
    for (std::size_t h = 0; h < 2; ++h) {
        result.emission[h].resize(count);
        for (LightPart& part : result.parts) part.irradiance[h] = part.reflectance[h] = ColorList(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 shines = result.emission[h][i] = usableColor(emission[h]->pixels[i]);
            const glm::vec3 bounced = usableColor(indirect[h]->pixels[i]);
            const glm::vec3 scattered = usableColor(diffuse[h]->pixels[i]);
            const glm::vec3 a = usableColor(albedo[h]->pixels[i]), g = usableColor(gloss[h]->pixels[i]);
            const glm::vec3 light[] = {usableColor(full[h]->pixels[i]) - bounced - shines, scattered,
                                       bounced - scattered};
            const glm::vec3 reflectance[] = {a + g, a, g};
            for (std::size_t p = 0; p < 3; ++p) {
                LightPart& part = result.parts[p];
                part.reflectance[h][i] = glm::max(reflectance[p], kLeastReflectance);
                part.irradiance[h][i] = glm::max(light[p], 0.0f) / part.reflectance[h][i];
            }
        }
    }
    return result;
}

GuideTable guideOf(const PathTracedPicture& picture) {
    GuideTable guide;
    guide.width = picture.full.width;
    guide.height = picture.full.height;
    const std::size_t count = guide.pixels();
    guide.normal.resize(count);
    guide.distance.resize(count);
    guide.slope.resize(count);
    guide.albedo.resize(count);
    const FeaturePictures& f = picture.features;
    for (std::size_t i = 0; i < count; ++i) {
        guide.normal[i] = usableColor(f.normal.pixels[i]);
        const float distance = f.normal.pixels[i].w;
        guide.distance[i] = std::isfinite(distance) ? std::max(distance, 0.0f) : 0.0f;
        guide.albedo[i] = 0.5f * (usableColor(f.albedoA.pixels[i]) + usableColor(f.albedoB.pixels[i]));
    }
    const auto width = static_cast<std::size_t>(guide.width), height = static_cast<std::size_t>(guide.height);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = y * width + x;
            guide.slope[i] = {slopeAt(guide.distance, i, 1, x > 0, x + 1 < width),
                              slopeAt(guide.distance, i, width, y > 0, y + 1 < height)};
        }
    return guide;
}

PathTracedPicture pictureOf(const PathTracedPicture& noisy, std::array<HalfColors, 3> light,
                            const HalfColors& emission) {
    PathTracedPicture clean = noisy;
    const HalfColors direct = sumOf(std::move(light[0]), emission);
    setMean(clean.direct, direct);
    setMean(clean.diffuse, light[1]);
    setMean(clean.specular, light[2]);
    const HalfColors indirect = sumOf(std::move(light[1]), light[2]);
    setMean(clean.indirect, indirect);
    setHalves(clean.indirectA, clean.indirectB, indirect);
    const HalfColors full = sumOf(direct, indirect);
    setMean(clean.full, full);
    setHalves(clean.halfA, clean.halfB, full);
    clean.noise = noiseLeft(noisy, clean);
    return clean;
}

}  // namespace conelight::reference
