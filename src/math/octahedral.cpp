// SPDX-License-Identifier: MIT
#include "math/octahedral.h"

#include <cmath>

namespace conelight::math {
namespace {
glm::vec2 wrap(const glm::vec2& v) {
    return {(1 - std::abs(v.y)) * (v.x >= 0 ? 1.0f : -1.0f), (1 - std::abs(v.x)) * (v.y >= 0 ? 1.0f : -1.0f)};
}
}  // namespace

glm::vec2 octEncode(const glm::vec3& n) {
    const glm::vec2 p = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    return n.z >= 0 ? p : wrap(p);
}

glm::vec3 octDecode(const glm::vec2& p) {
    glm::vec3 n(p, 1 - std::abs(p.x) - std::abs(p.y));
    if (n.z < 0) {
        const glm::vec2 folded = wrap(glm::vec2(n));
        n.x = folded.x;
        n.y = folded.y;
    }
    return glm::normalize(n);
}

std::uint32_t packSnorm2x16(const glm::vec2& v) {
    const auto one = [](float x) {
        return static_cast<std::uint32_t>(static_cast<std::uint16_t>(
            static_cast<std::int16_t>(std::lround(glm::clamp(x, -1.0f, 1.0f) * 32767.0f))));
    };
    return one(v.x) | (one(v.y) << 16);
}

glm::vec2 unpackSnorm2x16(std::uint32_t bits) {
    const auto one = [](std::uint32_t half) {
        return glm::max(static_cast<float>(static_cast<std::int16_t>(half & 0xffffu)) / 32767.0f, -1.0f);
    };
    return {one(bits), one(bits >> 16)};
}

}  // namespace conelight::math
