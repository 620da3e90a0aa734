// SPDX-License-Identifier: MIT
#include "math/sheen.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

#include "math/brdf.h"

namespace conelight::math {
namespace {

// The exponent of Lambda, fitted by Estevez and Kulla.
float fittedExponent(float cosine, float alpha) {
    const float t = (1 - alpha) * (1 - alpha);
    const float a = glm::mix(21.5473f, 25.3245f, t), b = glm::mix(3.82987f, 3.32435f, t);
    const float c = glm::mix(0.19823f, 0.16801f, t), d = glm::mix(-1.97760f, -1.27393f, t);
    const float e = glm::mix(-4.32054f, -4.85967f, t);
    return a / (1 + b * std::pow(cosine, c)) + d * cosine + e;
}

float lambda(float cosine, float alpha) {
    return cosine < 0.5f ? std::exp(fittedExponent(cosine, alpha))
                         : std::exp(2 * fittedExponent(0.5f, alpha) - fittedExponent(1 - cosine, alpha));
}

float alphaOf(float roughness) {
    const float r = std::clamp(roughness, kMinSheenRoughness, 1.0f);
    return r * r;
}

float distribution(float alpha, float NoH) {
    const float sine2 = std::max(1 - NoH * NoH, 1e-7f);
    return (2 + 1 / alpha) * std::pow(sine2, 0.5f / alpha) / (2 * glm::pi<float>());
}

// Of the term times the cosine, over directions to the light. Their cosines are squares of an even grid: the lobe lies
// along the horizon.
double integrated(float NoV, float alpha) {
    constexpr int kCosines = 64, kTurns = 64;
    const double eyeSine = std::sqrt(std::max(1.0 - double(NoV) * double(NoV), 0.0));
    const float eye = lambda(NoV, alpha);
    double sum = 0;
    for (int i = 0; i < kCosines; ++i) {
        const double u = (i + 0.5) / kCosines, z = u * u, sine = std::sqrt(1 - z * z);
        double ring = 0;
        for (int j = 0; j < kTurns; ++j) {
            const double x = sine * std::cos(glm::pi<double>() * (j + 0.5) / kTurns) + eyeSine;
            const double y = sine * std::sin(glm::pi<double>() * (j + 0.5) / kTurns);
            const double height = z + double(NoV);
            ring += double(distribution(alpha, float(height / std::sqrt(x * x + y * y + height * height))));
        }
        sum += ring * 2 * u / (4 * double(NoV) * (1 + double(eye) + double(lambda(float(z), alpha))));
    }
    return sum * 2 * glm::pi<double>() / (kCosines * kTurns);
}

SheenTable computeTable() {
    SheenTable table{};
    for (int row = 0; row < kSheenTableEdge; ++row)
        for (int column = 0; column < kSheenTableEdge; ++column) {
            const float part = 1.0f / (kSheenTableEdge - 1);
            const float root = std::max(float(column) * part, 1e-2f);
            const float alpha = alphaOf(glm::mix(kMinSheenRoughness, 1.0f, float(row) * part));
            table[std::size_t(row) * kSheenTableEdge + std::size_t(column)] =
                float(integrated(root * root, alpha));
        }
    return table;
}

}  // namespace

float sheenVisible(float roughness, float NoH, float NoL, float NoV) {
    const float alpha = alphaOf(roughness);
    const float l = std::max(NoL, 1e-4f), v = std::max(NoV, 1e-4f);
    return distribution(alpha, NoH) / (4 * l * v * (1 + lambda(l, alpha) + lambda(v, alpha)));
}

const SheenTable& sheenTable() {
    static const SheenTable kTable = computeTable();
    return kTable;
}

SheenShare sheenShare(float NoV, float roughness) {
    const SheenTable& table = sheenTable();
    constexpr float kLast = kSheenTableEdge - 1;
    const float x = kLast * std::sqrt(std::clamp(NoV, 0.0f, 1.0f));
    const float y = kLast * (std::clamp(roughness, kMinSheenRoughness, 1.0f) - kMinSheenRoughness) /
                    (1 - kMinSheenRoughness);
    const int column = std::min(int(x), kSheenTableEdge - 2), row = std::min(int(y), kSheenTableEdge - 2);
    const float* at = &table[std::size_t(row) * kSheenTableEdge + std::size_t(column)];
    const float across = x - float(column);
    const float albedo =
        glm::mix(glm::mix(at[0], at[1], across),
                 glm::mix(at[kSheenTableEdge], at[kSheenTableEdge + 1], across), y - float(row));
    const float most = std::max(albedo, 1.0f);
    return {1 / most, albedo / most};
}

float evenSheen(float roughness) {
    constexpr int kAngles = 64;
    float sum = 0;
    for (int i = 0; i < kAngles; ++i)
        sum += sheenShare(std::sqrt((float(i) + 0.5f) / kAngles), roughness).albedo;
    return sum / kAngles;
}

LayerAlbedo evenLayers(float coat, float coatRoughness, const glm::vec3& sheenColor, float sheenRoughness) {
    LayerAlbedo layers;
    if (sheenColor != glm::vec3(0)) {
        layers.added = sheenColor * evenSheen(sheenRoughness);
        layers.taken = std::max({layers.added.r, layers.added.g, layers.added.b});
    }
    if (!(coat > 0)) return layers;
    const float own = coat * evenCoat(coatRoughness);
    return {1 - (1 - layers.taken) * (1 - own), layers.added * (1 - own) + own};
}

}  // namespace conelight::math
