// SPDX-License-Identifier: MIT
#include "static_bake.h"

#include <fmt/core.h>

#include <algorithm>

#include "scene_hash.h"

namespace conelight::program {

std::string staticKey(const Scene& scene, const reference::RadiositySettings& s) {
    Hash hash;
    addStatics(hash, scene);
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {}", hash.hex(), s.patchSize, s.maxSubdivision,
                       s.subdivideError, s.residual, s.patchRays, s.gatherRays, s.visibilityRays, s.bounces,
                       s.seed, s.emissiveQuads);
}

bool hasDynamic(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [](const Instance& one) { return one.dynamic; });
}

std::shared_ptr<const BakedLight> StaticBake::of(
    const Scene& scene, const reference::RadiositySettings& settings,
    const std::function<bool(const reference::RadiosityProgress&)>& onProgress) {
    const std::string key = staticKey(scene, settings);
    if (light_ != nullptr && key_ == key) return light_;
    bool stopped = false;
    light_ = std::make_shared<const BakedLight>(
        reference::bakeIndirect(scene, settings, &stats_, [&](const reference::RadiosityProgress& now) {
            stopped = stopped || (onProgress && !onProgress(now));
            return !stopped;
        }));
    key_ = stopped ? std::string() : key;
    ++bakes_;
    return light_;
}

}  // namespace conelight::program
