// SPDX-License-Identifier: MIT
#include "light/lit_voxels.h"

#include <algorithm>
#include <cstdint>

#include "gl/gl.h"
#include "gl/pace.h"
#include "light/inject_light.h"
#include "light/near_lamps.h"
#include "shared/irradiance.h"

namespace conelight::light {
namespace {

// With a limited number of bounces updates are not averaged, so each has to do.
constexpr int kRaysPerBounce = 32;
// The first updates after a change only carry bounces around: what they find is replaced, so a quarter of the
// rays will do.
constexpr int kCoarseUpdates = IRRADIANCE_SETTLE;
// Means over frames while the cache is still on its way would show old light.
constexpr int kSteadyUpdates = 14;
// So many faces have all their updates.
constexpr std::uint32_t kFacesOfAllUpdates = 1u << 18;

// What is left of the light before a thing moved goes by so many more.
constexpr int kUpdatesAfterMoves = 48;

// With a limited number of bounces, of lamps that are drawn by chance, besides the first.
constexpr int kLampDrawsOfBounces = 4;

}  // namespace

RelightSettings relightSettings(const TracedSettings& settings) {
    RelightSettings relight;
    relight.updates = settings.cacheUpdates;
    relight.bounces = settings.bounces;
    // Rays at pixels add a bounce to what the cache holds.
    if (settings.bounces) relight.updates = *settings.bounces - (settings.pixelRays > 0 ? 1 : 0);
    relight.rays = settings.cacheRays;
    relight.exactHits = settings.exactHits;
    return relight;
}

int updatesOfFaces(int updates, std::uint32_t faces) {
    if (updates <= kSteadyUpdates || faces <= kFacesOfAllUpdates) return updates;
    const std::int64_t averaged = std::int64_t{updates - IRRADIANCE_SETTLE} * kFacesOfAllUpdates / faces;
    return std::max(IRRADIANCE_SETTLE + static_cast<int>(averaged), kSteadyUpdates);
}

base::Steps LitVoxels::relightInSteps(const gl::Device& device, const Inputs& inputs,
                                      const RelightSettings& settings, const Budget& budget) {
    const bool first = !revision_;
    const bool otherVoxels = voxelsFrom_ != inputs.voxels.revision();
    const bool otherSources = otherVoxels || directDue_ || lightsFrom_ != inputs.lights.revision();
    const bool otherSettings = !first && !(settings_ == settings);
    const voxels::VoxelGrid& grid = inputs.voxels.grid();
    // Nested grids go with the eye.
    const bool otherLevels = (grid_.levels > 1 || grid.levels > 1) && !(grid_ == grid);
    const bool otherGrid = !first && (otherLevels || !(voxelSettings_ == inputs.voxels.settings()));
    if (budget.nothing && !otherSources && !otherSettings) co_return;

    // A finished picture must not be better or worse for those before it; moving ones keep what is there. Light of a limited number of bounces starts in the dark.
    const bool otherBounces = !first && settings_.bounces != settings.bounces;
    const bool inTheDark =
        otherBounces || (settings.bounces && otherSources) ||
        (!first && !budget.oneUpdate && (otherSettings || otherGrid || otherSources || changed_));
    if (inTheDark) {
        visitsBefore_ = faceVisits();
        cache_ = {};
        voxelsFrom_ = {};
    }
    SceneEdits changed = places_.look(inputs.scene);
    // Light that is still due is of a call that was left, and of a change that is not known any more.
    if (!budget.oneUpdate || inTheDark || otherSettings || directDue_) changed.reset();
    const bool changes = inTheDark || otherSources || otherSettings;
    if (inTheDark || otherVoxels)
        co_await cache_.adoptInSteps(device, inputs.voxels, changed);
    else if (changes)
        cache_.restartAverages(changed);
    if (changes) changed_ = changed;
    voxelsFrom_ = inputs.voxels.revision();
    voxelSettings_ = inputs.voxels.settings();
    directDue_ = inTheDark || otherSources;
    lightsFrom_ = inputs.lights.revision();
    grid_ = grid;
    settings_ = settings;
    if (directDue_) {
        co_await putDirectLight(device, inputs);
        sourcesBefore_ = sources_;
        sources_ = revision_ = base::Revision::next();
        directDue_ = false;
    }
    co_await update(device, inputs, budget);
}

base::Steps LitVoxels::followVoxels(const gl::Device& device, const voxels::Voxels& voxels) {
    if (!revision_ || !voxels.revision() || voxelsFrom_ == voxels.revision()) co_return;
    co_await cache_.adoptInSteps(device, voxels, {});
    voxelsFrom_ = voxels.revision();
    directDue_ = true;
}

// Direct light, emission and sky on every face.
base::Steps LitVoxels::putDirectLight(const gl::Device& device, const Inputs& inputs) {
    const voxels::SurfaceVoxels& surface = inputs.voxels.surface();
    gl::reserveTexels(directLight_, directTexels_, GL_R32UI, std::size_t{4} * surface.mostFaces(),
                      "cached direct light");
    const bool fits = surface.mostFaces() > 0 && hasOtherEmitters(inputs.scene, inputs.lights);
    if (fits) co_await fit_.updateInSteps(device, inputs.scene, inputs.voxels);
    const RayLight rays{directLight_, fits ? &fit_ : nullptr};
    injectLight(device, {inputs.scene, inputs.lights, surface}, faces_, &rays);
    co_await gl::rest(device);
    // Where rays look lamps up where they hit, that is a point of the face.
    const bool exact = inputs.lights.hitKey(inputs.scene, settings_.exactHits).exact;
    const NearLampInputs lit{inputs.scene, inputs.lights, inputs.voxels, directLight_};
    lightNearBulbs(device, lit, faces_);
    if (!exact && !inputs.lights.drawsLamps()) lightNearLamps(device, lit, faces_);
    if (inputs.lights.drawsLamps())
        co_await lamps_.beginInSteps(device, {inputs.scene, inputs.lights, inputs.voxels, faces_});
}

// More draws of lamps, between updates.
base::Steps LitVoxels::drawLamps(const gl::Device& device, const Inputs& inputs, std::uint32_t faces,
                                 int rounds) {
    for (int i = 0; i < rounds && inputs.lights.drawsLamps(); ++i)
        co_await lamps_.goOnInSteps(device, {inputs.scene, inputs.lights, inputs.voxels, faces_}, faces);
}

base::Steps LitVoxels::update(const gl::Device& device, const Inputs& inputs, const Budget& budget) {
    const IrradianceCache::Inputs given{inputs.scene, inputs.lights, inputs.voxels, directTexels_, faces_};
    CacheSettings cache;
    // A reflection is a bounce, which updates count.
    if (settings_.bounces) cache.reflections = 0;
    cache.averages = !settings_.bounces;
    cache.exactDirect = settings_.exactHits;
    cache.facesPerUpdate = budget.oneUpdate ? budget.faces : 0;
    const int missing = missingUpdates();
    if (!settings_.bounces && !budget.oneUpdate) {
        const int coarse = std::clamp(kCoarseUpdates - cache_.updates(), 0, missing);
        cache.cosineRays = cache.lightRays = std::max(settings_.rays / 4, 1);
        co_await cache_.updateInSteps(device, given, cache, coarse);
        if (coarse > 0) revision_ = base::Revision::next();
    }
    // Coarse ones have found out how many faces there are to update.
    int passes = missingUpdates();
    if (budget.oneUpdate && !settings_.bounces) passes = std::min(passes, 1);
    // Those that average get another draw of lamps than those before; the rays of few updates all draws at once.
    if (passes > 0)
        co_await drawLamps(device, inputs, settings_.bounces ? 0 : cache.facesPerUpdate,
                           settings_.bounces ? kLampDrawsOfBounces : 1);
    cache.cosineRays = cache.lightRays =
        settings_.bounces ? std::max(settings_.rays, kRaysPerBounce) : settings_.rays;
    co_await cache_.updateInSteps(device, given, cache, passes);
    if (passes > 0) revision_ = base::Revision::next();
    if (!budget.oneUpdate || missing == 0) cache_.endSharing();
}

base::Steps LitVoxels::redrawInSteps(const gl::Device& device, const Inputs& inputs, std::uint32_t draw) {
    co_await cache_.redrawInSteps(device, {inputs.scene, inputs.lights, inputs.voxels, directTexels_, faces_},
                                  draw);
}

int LitVoxels::wantedUpdates() const {
    const int updates = settings_.updates + (changed_ && !changed_->most ? kUpdatesAfterMoves : 0);
    // How many faces there are is known without waiting for it when averages begin. Of limited bounces each update is one.
    const bool known = cache_.updates() >= IRRADIANCE_SETTLE && !settings_.bounces;
    return known ? updatesOfFaces(updates, cache_.faces()) : updates;
}

int LitVoxels::missingUpdates() const { return std::max(wantedUpdates() - cache_.updates(), 0); }

int LitVoxels::updates() const {
    const int made = cache_.updates();
    return made < wantedUpdates() ? std::min(made, settings_.updates - 1) : settings_.updates;
}

bool LitVoxels::steady() const { return cache_.updates() >= std::min(settings_.updates, kSteadyUpdates); }

void LitVoxels::declare(gl::Inputs& inputs) const {
    inputs.add(faces_).texture("cachedDirect", directTexels_).add(cache_);
}

std::vector<gl::ProgramDesc> LitVoxels::programDescs() {
    std::vector<gl::ProgramDesc> descs = injectLightProgramDescs();
    for (const auto& more : {EmissionFit::programDescs(), nearLampsProgramDescs(), LampFaces::programDescs(),
                             IrradianceCache::programDescs(), Caustics::programDescs()})
        descs.insert(descs.end(), more.begin(), more.end());
    return descs;
}

}  // namespace conelight::light
