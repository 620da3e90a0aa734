// SPDX-License-Identifier: MIT
// Light of mode `hybrid`, baked once for what does not move in a scene, and kept while that stays as it is.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "reference/radiosity.h"

namespace conelight::program {

// Names what bakeIndirect depends on: the static part of a scene and the settings that count.
std::string staticKey(const Scene& scene, const reference::RadiositySettings& settings);
// Whether anything is marked as moving.
bool hasDynamic(const Scene& scene);

class StaticBake {
  public:
    // Bakes when the static part or the settings are others than at the last call. `onProgress` as of bakeIndirect; a
    // bake that it stopped is not kept.
    std::shared_ptr<const BakedLight> of(
        const Scene& scene, const reference::RadiositySettings& settings,
        const std::function<bool(const reference::RadiosityProgress&)>& onProgress = {});
    std::size_t bakes() const { return bakes_; }                       // how often it was baked
    const reference::RadiosityStats& stats() const { return stats_; }  // of the last one

  private:
    std::string key_;
    std::shared_ptr<const BakedLight> light_;
    reference::RadiosityStats stats_;
    std::size_t bakes_ = 0;
};

}  // namespace conelight::program
