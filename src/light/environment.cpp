// SPDX-License-Identifier: MIT
#include "light/environment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "gl/gl.h"
#include "math/brightness.h"
#include "scene/surroundings.h"

namespace conelight::light {
namespace {

// Finer pictures are taken at this size: 32 MB, and 0.09 degrees a texel.
constexpr int kWidest = 4096;
// Columns of the cells that rays are drawn in: 0.35 degrees, less than the sun. Coarser ones blur its shadows.
constexpr int kCellColumns = 1024;
constexpr float kLargestTexel = 32768.0f;  // of RGB9E5, as glm packs it

// Walker's alias table of weights, as shaders read it: {share that stays, as float bits; where the rest goes}.
std::vector<glm::uvec2> aliasTable(const std::vector<double>& weights) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    const std::size_t count = weights.size();
    std::vector<glm::uvec2> table(count);
    std::vector<double> share(count);
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < count; ++i) {
        share[i] = weights[i] * static_cast<double>(count) / sum;
        (share[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    const auto set = [&](std::uint32_t i, double kept, std::uint32_t other) {
        table[i] = {std::bit_cast<std::uint32_t>(static_cast<float>(kept)), other};
    };
    while (!small.empty() && !large.empty()) {
        const std::uint32_t less = small.back(), more = large.back();
        small.pop_back();
        set(less, share[less], more);
        share[more] -= 1 - share[less];
        if (share[more] < 1) {
            large.pop_back();
            small.push_back(more);
        }
    }
    // What rounding has left over is whole.
    for (const std::uint32_t i : small) set(i, 1, i);
    for (const std::uint32_t i : large) set(i, 1, i);
    return table;
}

}  // namespace

void EnvironmentTable::update(const Environment& environment) {
    if (!environment.used()) {
        *this = {};
        return;
    }
    if (from_ == environment.image) return;
    *this = {};
    from_ = environment.image;
    float brightest = 0;
    for (const glm::vec3& radiance : from_->radiance)
        brightest = std::max({brightest, radiance.r, radiance.g, radiance.b});
    if (!(brightest > 0)) return;
    scale_ = brightest / kLargestTexel;

    const int width =
        std::clamp(static_cast<int>(std::bit_ceil(static_cast<unsigned>(from_->width))), 2, kWidest);
    const int levels = static_cast<int>(std::bit_width(static_cast<unsigned>(width)));
    EnvironmentImage image = scene::resampled(*from_, width, width / 2);
    picture_ = gl::Texture({GL_TEXTURE_2D, GL_RGB9_E5, width, width / 2, 1, levels}, "environment");
    picture_.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    picture_.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    picture_.parameter(GL_TEXTURE_WRAP_S, GL_REPEAT);
    picture_.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    cellLevel_ =
        std::max(0, static_cast<int>(std::bit_width(static_cast<unsigned>(width / kCellColumns))) - 1);
    for (int level = 0; level < levels; ++level) {
        if (level > 0)
            image = scene::resampled(image, std::max(image.width / 2, 1), std::max(image.height / 2, 1));
        std::vector<std::uint32_t> texels;
        for (const glm::vec3& radiance : image.radiance)
            texels.push_back(glm::packF3x9_E1x5(glm::min(radiance / scale_, glm::vec3(kLargestTexel))));
        picture_.upload(level, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, texels.data());
        if (level != cellLevel_) continue;
        std::vector<double> weights;
        double flux = 0;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const int row = static_cast<int>(i) / image.width;
            weights.push_back(static_cast<double>(math::brightness(glm::unpackF3x9_E1x5(texels[i]))) *
                              scene::texelSolidAngle(image, row));
            flux += weights.back();
        }
        inverseFlux_ = flux > 0 ? static_cast<float>(1 / flux) : 0;
        if (!(flux > 0)) weights.assign(weights.size(), 1);
        cellBuffer_ = gl::Buffer(aliasTable(weights), "environment cells");
        cells_ = gl::Texture(cellBuffer_, GL_RG32UI, "environment cells");
    }
}

void EnvironmentTable::describe(const Environment& environment, gpu::LightingConstants& constants) const {
    if (!hasPicture()) return;
    constants.environmentScale = scale_ * environment.strength;
    constants.environmentTurn = environment.rotation / (2 * std::numbers::pi_v<float>);
    constants.environmentInverseFlux = inverseFlux_;
    constants.environmentLevel0 = std::log2(static_cast<float>(picture_.width()));
    constants.environmentCellLevel = static_cast<float>(cellLevel_);
}

void EnvironmentTable::declare(gl::Inputs& inputs) const {
    if (!hasPicture()) return;
    inputs.texture("environmentPicture", picture_).texture("environmentCells", cells_);
}

}  // namespace conelight::light
