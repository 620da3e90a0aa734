// SPDX-License-Identifier: MIT
// The picture's halves -> three parts of the light each (denoise_parts.cpp) -> candidates (denoise_filter.cpp) ->
// those of least error (denoise_choice.cpp) -> the picture again.
#include "reference/denoise.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/clock.h"
#include "base/log.h"
#include "reference/denoise_oidn.h"
#include "reference/denoise_parts.h"

namespace conelight::reference {
namespace {

constexpr int kVarianceRadius = 2;  // pixels: two halves alone tell a pixel's variance badly
constexpr int kFireflyRadius = 3;   // pixels
constexpr float kFirefly = 10;      // standard deviations of the neighbours' noise

// A half that is brighter than the other by more than the noise around explains is taken down to that. What is
// bright in both halves stays.
void tameFireflies(HalfColors& halves, int width, int height) {
    const auto sumOf = [](const glm::vec3& c) { return c.r + c.g + c.b; };
    std::vector<float> squares(halves[0].size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const float difference = sumOf(halves[0][i] - halves[1][i]);
        squares[i] = difference * difference;
    }
    const std::vector<float> around = meanAround(squares, width, height, kFireflyRadius);
    for (std::size_t i = 0; i < squares.size(); ++i) {
        if (!(squares[i] > kFirefly * kFirefly * around[i])) continue;
        glm::vec3 &a = halves[0][i], &b = halves[1][i];
        glm::vec3& bright = sumOf(a) > sumOf(b) ? a : b;
        const float most = std::min(sumOf(a), sumOf(b)) + kFirefly * std::sqrt(around[i]);
        bright *= most / sumOf(bright);
    }
}

// Of a half: half the mean square of the halves' difference, averaged over neighbours.
std::vector<glm::vec3> varianceOf(const HalfColors& halves, int width, int height) {
    std::vector<glm::vec3> squares(halves[0].size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const glm::vec3 difference = halves[0][i] - halves[1][i];
        squares[i] = 0.5f * difference * difference;
    }
    return smoothed(squares, width, height, kVarianceRadius);
}

// Parts without noise stay as they are.
void filterParts(std::array<LightPart, 3>& parts, const GuideTable& guide, int threads) {
    std::vector<NoisySignal> signals;
    std::vector<LightPart*> noisy;
    for (LightPart& part : parts) {
        if (!part.isNoisy()) continue;
        tameFireflies(part.irradiance, guide.width, guide.height);
        noisy.push_back(&part);
        const std::vector<glm::vec3> variance = varianceOf(part.irradiance, guide.width, guide.height);
        for (const std::vector<glm::vec3>& half : part.irradiance) signals.push_back({half, variance});
    }
    std::vector<FilteredSignal> results = filterSignals(guide, signals, threads);
    for (std::size_t i = 0; i < noisy.size(); ++i) {
        FilteredSignal &a = results[2 * i], &b = results[2 * i + 1];
        const HalfColors byColor = {std::move(a.byColor), std::move(b.byColor)};
        const HalfColors byFeatures = {std::move(a.byFeatures), std::move(b.byFeatures)};
        noisy[i]->irradiance =
            leastError({&noisy[i]->irradiance, &byColor, &byFeatures}, guide.width, guide.height);
    }
}

void requireFeatures(const PathTracedPicture& picture) {
    const FeaturePictures& f = picture.features;
    const std::size_t count = picture.full.pixels.size();
    for (const Image* image :
         {&picture.halfA, &picture.halfB, &picture.indirectA, &picture.indirectB, &f.albedoA, &f.albedoB,
          &f.glossA, &f.glossB, &f.emissionA, &f.emissionB, &f.normal, &f.diffuseA, &f.diffuseB})
        if (image->pixels.size() != count || count == 0)
            base::fail(
                ErrorKind::Usage,
                "denoise: a picture without features; PathTracerSettings::features = true would be right");
}

}  // namespace

PathTracedPicture denoise(const PathTracedPicture& noisy, const DenoiseSettings& settings) {
    if (settings.by == Denoiser::None) return noisy;
    requireFeatures(noisy);
    const double cpuStart = base::processCpuMs(), wallStart = base::wallMs();
    LightParts parts = partsOf(noisy);
    const GuideTable guide = guideOf(noisy);
    const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
    if (settings.by == Denoiser::Own)
        filterParts(parts.parts, guide, settings.threads > 0 ? settings.threads : cores);

    std::array<HalfColors, 3> light;
    for (std::size_t p = 0; p < light.size(); ++p) {
        light[p] = parts.parts[p].light();
        if (settings.by == Denoiser::Oidn)
            for (std::vector<glm::vec3>& half : light[p]) filterByOidn(half, guide);
    }
    PathTracedPicture clean = pictureOf(noisy, std::move(light), parts.emission);
    clean.cpuSeconds += (base::processCpuMs() - cpuStart) * 1e-3;
    clean.wallSeconds += (base::wallMs() - wallStart) * 1e-3;
    return clean;
}

}  // namespace conelight::reference
