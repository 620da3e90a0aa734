// SPDX-License-Identifier: MIT
#include "view/shadow_cascades.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/log.h"
#include "light/shadow_layout.h"

namespace conelight::view {
namespace {

constexpr float kNearest = 2.0f;  // m to either side of the eye: texels of 4 mm at 1024
// A map of the whole scene that reaches no farther is as fine as rooms need: texels of 3 cm at 1024.
constexpr float kFineEnough = 16.0f;
constexpr int kMostLevels = 16;
// Below this size of maps there are fewer levels instead.
constexpr int kLeastSize = 1024;
// Maps move by so many parts of their edge, and are drawn anew then.
constexpr int kSteps = 16;
// Of half its edge a level serves what no such step and no filter takes out of its map.
constexpr float kServed = 0.92f;
// How far maps reach along the light to either side, in halves of their edge. Casters before that are drawn on the near
// side, receivers beyond have a coarser level. Floats then keep depths of near things exact to a fraction of a texel.
constexpr float kDepth = 16.0f;

bool isCascaded(const gpu::Light& light) { return light.type == LIGHT_DIRECTIONAL && light.shadow >= 0; }

// About the eye, moved in whole steps of whole texels: texels stay where they are in the world.
light::ParallelMap mapAbout(const gpu::Light& light, const glm::vec3& eye, float half, int size, int guard) {
    const float texel = 2.0f * half / static_cast<float>(size - 2 * guard - 2);
    const float step = texel * static_cast<float>(std::max(size / kSteps, 1));
    const auto snapped = [&](const glm::vec3& axis) {
        return axis * (std::floor(glm::dot(eye, axis) / step + 0.5f) * step);
    };
    const float depth = kDepth * half;
    return {snapped(light.halfU) + snapped(light.halfV) + snapped(light.direction) - depth * light.direction,
            0.5f / depth, texel};
}

}  // namespace

CascadeLevels cascadeLevels(float half, const LightSettings& settings, int lights, std::size_t bytes) {
    CascadeLevels levels;
    levels.size = settings.shadowSize / 8 * 8;
    if (lights == 0 || levels.size < 64 || half <= kFineEnough) return levels;
    const int finer = std::min(static_cast<int>(std::ceil(std::log2(half / kNearest))), kMostLevels - 1);
    levels.asked = finer + 1;
    const auto affordable = [&] {
        light::ShadowLayout one;
        one.layers = one.surfaceLayers = lights;
        return static_cast<int>(std::min<std::size_t>(bytes / one.bytes(levels.size), kMostLevels));
    };
    while (affordable() < levels.asked && levels.size > kLeastSize)
        levels.size = std::max(levels.size / 2 / 8 * 8, kLeastSize);
    const int most = std::min(affordable(), levels.asked) - 1;
    if (most < 1) return levels;
    const int doublings = (finer + most - 1) / most;  // from level to level
    levels.ratio = 1 << doublings;
    levels.count = (finer + doublings - 1) / doublings + 1;
    return levels;
}

void ShadowCascades::clear() { *this = {}; }

base::Steps ShadowCascades::updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                          const light::Lights& lights, LightSettings settings,
                                          glm::vec3 eye) {
    // Together with the other maps within what all may take; an eighth of it in any case.
    constexpr std::size_t kMost = light::kMostShadowBytes;
    const std::size_t left = kMost - std::min(lights.shadowBytes(), kMost - kMost / 8);
    float half = 0;
    int count = 0;
    for (const gpu::Light& light : lights.table()) {
        if (!isCascaded(light) || scene.bounds().empty()) continue;
        half = std::max(half, light::halfOfAll(light, scene.bounds()));
        ++count;
    }
    const CascadeLevels levels = cascadeLevels(half, settings, count, left);
    if (levels.asked > 0 && levels.count < levels.asked && levels_.asked == 0)
        base::log(LogLevel::Info, "shadows of the sun in " + std::to_string(std::max(levels.count, 1)) +
                                      " levels about the eye, not " + std::to_string(levels.asked) +
                                      ": many lights share their memory");
    if (levels.count == 0) {
        if (levels_.count > 0) clear();
        levels_ = levels;
        co_return;
    }

    const int guard = light::guardTexels(settings.shadowFilter, levels.size);
    light::ShadowLayout layout;
    layout.size = levels.size;
    std::vector<gpu::Cascade> cascades;
    for (const gpu::Light& light : lights.table()) {
        if (light.type != LIGHT_DIRECTIONAL) continue;
        float reach = kNearest;
        for (int level = 0; level < levels.count; ++level, reach *= static_cast<float>(levels.ratio)) {
            const bool whole = level == levels.count - 1;
            const light::ParallelMap map =
                whole ? light::parallelMapOfAll(light, scene.bounds(), levels.size, guard)
                      : mapAbout(light, eye, reach, levels.size, guard);
            cascades.push_back({map.position, map.shadowNear, map.texel, -1, 0, 0});
            if (!isCascaded(light)) continue;
            light::ShadowView view = light::parallelView(light, map, levels.size);
            view.layer = cascades.back().layer = layout.layers++;
            view.clamped = !whole;
            layout.views.push_back(view);
        }
    }
    layout.surfaceLayers = layout.layers;
    layout.leavesVeils = lights.hasVeils();
    levels_ = levels;
    upload(eye, cascades);

    std::vector<glm::vec3> places;
    for (const gpu::Cascade& cascade : cascades) places.push_back(cascade.position);
    const Sources sources{scene.identity(), scene.geometryRevision(), lights.revision(), settings};
    redrawn_ = 0;
    if (sources == from_ && places == places_) co_return;
    from_ = {};
    co_await maps_.drawInSteps(device, scene, std::move(layout), "shadow cascades");
    redrawn_ = maps_.redrawn();
    from_ = sources;
    places_ = places;
}

void ShadowCascades::upload(const glm::vec3& eye, const std::vector<gpu::Cascade>& cascades) {
    gpu::CascadeConstants constants{};
    constants.middle = eye;
    constants.levels = static_cast<std::uint32_t>(levels_.count);
    constants.inverseNearest = 1.0f / (kServed * kNearest);
    constants.perDoubling = 1.0f / std::log2(static_cast<float>(levels_.ratio));
    constants.inverseDepth = 1.0f / kDepth;
    std::vector<std::byte> bytes(sizeof constants + cascades.size() * sizeof(gpu::Cascade));
    std::memcpy(bytes.data(), &constants, sizeof constants);
    std::memcpy(bytes.data() + sizeof constants, cascades.data(), cascades.size() * sizeof(gpu::Cascade));
    if (!table_ || table_.bytes() != bytes.size())
        table_ = gl::Buffer(bytes, "shadow cascades");
    else
        table_.update(0, bytes.data(), bytes.size());
}

void ShadowCascades::declare(gl::Inputs& inputs) const {
    inputs.storage("CascadeTable", table_);
    maps_.declareAs(inputs, "cascadeDepths", "cascadeSurfaces");
}

}  // namespace conelight::view
