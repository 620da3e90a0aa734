// SPDX-License-Identifier: MIT
#include "light/light_key.h"

#include <algorithm>
#include <utility>

namespace conelight::light {
namespace {

// More would make unrolled programs long.
constexpr int kFixedLights = 4;
constexpr int kLargestFilter = 4;  // LightSettings::shadowFilter

}  // namespace

LightKey LightKey::of(const glm::uvec4& ends, bool shaped, bool shadows, int filter,
                      gl::ExecutionProfile profile) {
    const auto total = static_cast<int>(ends.w);
    LightKey key;
    key.shaped = shaped;
    key.fixed =
        total == 0 || (total <= kFixedLights && !shaped && profile == gl::ExecutionProfile::Processor);
    const auto number = [&](std::uint32_t first, std::uint32_t end) {
        const auto count = static_cast<int>(end - first);
        return key.fixed ? count : std::min(count, 1);
    };
    key.point = number(0, ends.x);
    key.spot = number(ends.x, ends.y);
    key.directional = number(ends.y, ends.z);
    key.rect = number(ends.z, ends.w);
    key.shadows = shadows && total > 0;
    key.filter = key.shadows ? filter : 0;
    return key;
}

gl::Defines LightKey::defines() const {
    gl::Defines defines{{"LIGHTS_POINT", std::to_string(point)},
                        {"LIGHTS_SPOT", std::to_string(spot)},
                        {"LIGHTS_DIRECTIONAL", std::to_string(directional)},
                        {"LIGHTS_RECT", std::to_string(rect)},
                        {"LIGHTS_SHAPED", shaped ? "1" : "0"},
                        {"LIGHTS_FIXED", fixed ? "1" : "0"},
                        {"LIGHTS_SHADOWS", shadows ? "1" : "0"},
                        {"SHADOW_FILTER", std::to_string(filter)}};
    if (glass) defines.emplace_back("GLASS", "1");
    if (cascades) defines.emplace_back("SHADOW_CASCADES", "1");
    return defines;
}

std::vector<LightKey> LightKey::ofPixels() {
    std::vector<LightKey> keys = all();
    const std::size_t count = keys.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!keys[i].shadows || keys[i].directional == 0) continue;
        keys.push_back(keys[i]);
        keys.back().cascades = true;
    }
    return keys;
}

namespace {

// Every number of each kind; more than four lights are told by which kinds there are.
std::vector<LightKey> kindsOfLights() {
    std::vector<LightKey> keys;
    for (int code = 0; code < 5 * 5 * 5 * 5; ++code) {
        LightKey key{
            .point = code % 5, .spot = code / 5 % 5, .directional = code / 25 % 5, .rect = code / 125};
        const int total = key.point + key.spot + key.directional + key.rect;
        if (total <= kFixedLights) keys.push_back(key);
        key.fixed = false;
        if (std::max({key.point, key.spot, key.directional, key.rect}) != 1) continue;
        keys.push_back(key);
        key.shaped = true;
        keys.push_back(key);
    }
    return keys;
}

}  // namespace

std::vector<LightKey> LightKey::all() {
    std::vector<LightKey> keys;
    for (LightKey key : kindsOfLights()) {
        keys.push_back(key);
        key.shadows = true;
        const bool any = key.point + key.spot + key.directional + key.rect > 0;
        for (int filter = 0; any && filter <= kLargestFilter; ++filter) {
            key.filter = filter;
            for (const bool glass : {false, true}) {
                key.glass = glass;
                keys.push_back(key);
            }
        }
    }
    return keys;
}

gl::Defines LampKey::defines() const {
    gl::Defines defines{{"LIGHTS_SHAPED", shaped ? "1" : "0"}, {"LIGHTS_SHADOWS", "0"}};
    if (glass) defines.emplace_back("GLASS", "1");
    if (veils) defines.emplace_back("VEILS", "1");
    return defines;
}

std::vector<LampKey> LampKey::all() {
    std::vector<LampKey> keys;
    for (const bool shaped : {false, true})
        for (const auto& [glass, veils] : {std::pair{false, false}, {true, false}, {true, true}})
            keys.push_back({shaped, glass, veils});
    return keys;
}

gl::Defines HitKey::defines() const {
    gl::Defines defines{{"EXACT_DIRECT", exact ? "1" : "0"}};
    if (exact)
        for (auto& define : lights.defines()) defines.push_back(std::move(define));
    else
        defines.emplace_back("LIGHTS_SHAPED", lights.shaped ? "1" : "0");
    defines.emplace_back("LOBES", lobes ? "1" : "0");
    if (exact && (lobes || gloss)) defines.emplace_back("GLOSS", "1");
    if (environment) defines.emplace_back("ENVIRONMENT", "1");
    if (guided) defines.emplace_back("SKY_GUIDE", "1");
    if (glass) defines.emplace_back("GLASS", "1");
    return defines;
}

std::vector<HitKey> HitKey::all(int filter) {
    std::vector<HitKey> keys;
    for (int bits = 0; bits < 12; ++bits) {
        HitKey key{.lobes = (bits & 2) != 0,
                   .environment = bits / 4 == 1,
                   .guided = bits / 4 == 2,
                   .glass = (bits & 1) != 0,
                   .lights = {}};
        for (const bool shaped : {true, false}) {
            key.lights.shaped = shaped;
            keys.push_back(key);
        }
        key.exact = true;
        for (const LightKey& lights : LightKey::all()) {
            const bool punctual = lights.point + lights.spot + lights.directional > 0;
            if (!punctual || lights.rect != 0 || lights.filter != 0 || lights.glass) continue;
            key.lights = lights;
            if (lights.shadows) key.lights.filter = filter;
            for (const bool gloss : {false, true}) {
                key.gloss = gloss;
                if (!(gloss && key.lobes)) keys.push_back(key);
            }
        }
    }
    return keys;
}

}  // namespace conelight::light
