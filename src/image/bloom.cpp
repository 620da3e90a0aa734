// SPDX-License-Identifier: MIT
#include "image/bloom.h"

#include <algorithm>
#include <cmath>

#include "gl/gl.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

// Radii from an eighth of the height down, halved each time: the glare of an eye falls with about the square of the
// angle (Spencer and others 1995, "Physically-Based Glare Effects for Digital Images"), so that each octave has as much
// light as the next.
constexpr int kOctaves = 6;
constexpr double kWidest = 1.0 / 8;

struct BloomKey {
    bool down;
    gl::ProgramDesc desc() const {
        return {{down ? "image/bloom_down.comp.glsl" : "image/bloom_up.comp.glsl"}, {}};
    }
};

// Levels of a picture, without the picture itself.
int levelsOf(int width, int height) {
    int levels = 0;
    while (levels < kBloomLevels && std::max(width, height) >> (levels + 1) > 0) ++levels;
    return levels;
}

// The CPU's level: GL's order of rows.
struct Level {
    int width, height;
    std::vector<glm::vec3> pixels;
    Level(int w, int h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    glm::vec3& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    const glm::vec3& clamped(int x, int y) const {
        return pixels[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
                          static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
    }
    // Interpolated; texel i has its centre at i + 0.5.
    glm::vec3 sample(float x, float y) const {
        const float left = std::floor(x - 0.5f), low = std::floor(y - 0.5f);
        const float u = x - 0.5f - left, v = y - 0.5f - low;
        const int i = static_cast<int>(left), j = static_cast<int>(low);
        return glm::mix(glm::mix(clamped(i, j), clamped(i + 1, j), u),
                        glm::mix(clamped(i, j + 1), clamped(i + 1, j + 1), u), v);
    }
};

glm::vec3 finite(const glm::vec3& c) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) result[i] = std::isfinite(c[i]) ? c[i] : 0.0f;
    return result;
}

// As shaders/image/bloom_down.comp.glsl.
Level halved(const Level& from) {
    Level to(std::max(from.width / 2, 1), std::max(from.height / 2, 1));
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x) {
            const float cx = 2.0f * static_cast<float>(x) + 1, cy = 2.0f * static_cast<float>(y) + 1;
            glm::vec3 sum(0);
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    sum += 0.03125f * static_cast<float>((2 - std::abs(i)) * (2 - std::abs(j))) *
                           from.sample(cx + 2 * static_cast<float>(i), cy + 2 * static_cast<float>(j));
            for (const float j : {-1.0f, 1.0f})
                for (const float i : {-1.0f, 1.0f}) sum += 0.125f * from.sample(cx + i, cy + j);
            to.at(x, y) = sum;
        }
    return to;
}

// As bloomTent of shaders/image/bloom_tent.glsl.
glm::vec3 tent(const Level& coarse, int x, int y) {
    const float cx = 0.5f * (static_cast<float>(x) + 0.5f), cy = 0.5f * (static_cast<float>(y) + 0.5f);
    glm::vec3 sum(0);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            sum += 0.0625f * static_cast<float>((2 - std::abs(i)) * (2 - std::abs(j))) *
                   coarse.sample(cx + static_cast<float>(i), cy + static_cast<float>(j));
    return sum;
}

}  // namespace

// An octave's radius lies between two levels, or is less than a pixel.
BloomWeights bloomWeights(int width, int height) {
    BloomWeights weights{};
    const int last = levelsOf(width, height);
    for (int octave = 0; octave < kOctaves; ++octave) {
        const double radius = kWidest * height / std::exp2(octave);
        const double level = std::clamp(std::log2(std::max(radius, 1.0)), 0.0, static_cast<double>(last));
        const int below = std::min(static_cast<int>(level), last);
        const double part = level - below;
        weights[static_cast<std::size_t>(below)] += static_cast<float>((1 - part) / kOctaves);
        if (part > 0) weights[static_cast<std::size_t>(below) + 1] += static_cast<float>(part / kOctaves);
    }
    return weights;
}

Image bloomed(const Image& image, float strength) {
    if (!(strength > 0) || image.width < 2 || image.height < 2) return image;
    const BloomWeights weights = bloomWeights(image.width, image.height);
    std::vector<Level> levels;
    levels.emplace_back(image.width, image.height);
    const auto pixelAt = [&](int x, int y) {
        return static_cast<std::size_t>(image.height - 1 - y) * static_cast<std::size_t>(image.width) +
               static_cast<std::size_t>(x);
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            levels[0].at(x, y) = finite(glm::vec3(image.pixels[pixelAt(x, y)]));
    const int last = levelsOf(image.width, image.height);
    for (int k = 1; k <= last; ++k) levels.push_back(halved(levels.back()));
    for (int k = last; k >= 1; --k) {
        Level& level = levels[static_cast<std::size_t>(k)];
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x) {
                glm::vec3& pixel = level.at(x, y);
                pixel *= weights[static_cast<std::size_t>(k)];
                if (k < last) pixel += tent(levels[static_cast<std::size_t>(k) + 1], x, y);
            }
    }
    Image result = image;
    const float kept = 1 - strength + strength * weights[0];
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            glm::vec4& pixel = result.pixels[pixelAt(x, y)];
            pixel = {kept * glm::vec3(pixel) + strength * tent(levels[1], x, y), pixel.a};
        }
    return result;
}

void Bloom::spread(const gl::Device& device, const gl::Texture& linear) {
    const gl::PassScope pass(device.profiler, "bloom");
    const int width = linear.width(), height = linear.height(), last = levelsOf(width, height);
    const int halfWidth = std::max(width / 2, 1), halfHeight = std::max(height / 2, 1);
    if (!chain_ || chain_.width() != halfWidth || chain_.height() != halfHeight) {
        chain_ = {};  // frees the old one first
        chain_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, halfWidth, halfHeight, 1, last}, "bloom");
    }
    if (!linear_) linear_ = gl::Sampler({GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_CLAMP_TO_EDGE}, "bloom");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::BloomConstants), "bloom constants");
    weights_ = bloomWeights(width, height);
    const auto dispatch = [&](int level, const gl::Texture& from, int fromLevel, bool down) {
        gpu::BloomConstants constants{};
        constants.weight = weights_[static_cast<std::size_t>(level)];
        constants.fromLevel = static_cast<std::uint32_t>(fromLevel);
        constants.coarser = level < last ? 1.0f : 0.0f;
        constants_.update(constants);
        gl::Inputs given;
        given.uniform("BloomBlock", constants_)
            .texture("from", from, &linear_)
            .image("level", chain_, down ? gl::ImageUse::Write : gl::ImageUse::ReadWrite, level - 1);
        device.get(BloomKey{down}.desc())
            .dispatch(given, std::max(halfWidth >> (level - 1), 1), std::max(halfHeight >> (level - 1), 1));
        gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
    };
    for (int level = 1; level <= last; ++level)
        dispatch(level, level == 1 ? linear : chain_, std::max(level - 2, 0), true);
    for (int level = last; level >= 1; --level) dispatch(level, chain_, std::min(level, last - 1), false);
}

void Bloom::declare(gl::Inputs& inputs) const { inputs.texture("bloomChain", chain_, &linear_); }

std::vector<gl::ProgramDesc> Bloom::programDescs() { return {BloomKey{true}.desc(), BloomKey{false}.desc()}; }

}  // namespace conelight::image
