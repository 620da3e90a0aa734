// SPDX-License-Identifier: MIT
#include "gather/indirect.h"

#include <algorithm>
#include <utility>

#include "gl/pace.h"

namespace conelight::gather {
namespace {

// Means over frames while the cache is still on its way, so many passes at what changed: longer ones would show old light
// (builtin:cornell-point, interactive: 16 frames to settle instead of 12 when they were long after 8
// updates).
constexpr int kUnsettledMean = 4;
// Later ones reach over one of so many frames since the light changed: the weight of what was gathered before falls with
// that power of the frames, where a mean of all would keep it for as long as it is (docs/theory/4e_pixels.md).
constexpr int kFramesPerPass = 2;
// What the filter takes a draw of lamps for: rays into the hemisphere of about as much noise (builtin:lamps, 100 and 1,000).
constexpr int kLampRays = 16;
constexpr int kOcclusionPasses = 16;
constexpr int kOcclusionRays = 2;

bool sameView(const gpu::FrameConstants& a, const gpu::FrameConstants& b) {
    return a.clipFromWorld == b.clipFromWorld && a.eye == b.eye && a.viewForward == b.viewForward &&
           a.viewRight == b.viewRight && a.viewUp == b.viewUp && a.parallel == b.parallel &&
           a.width == b.width && a.height == b.height;
}

// Whether any surface may be as smooth as `limit`.
bool hasGloss(const scene::GpuScene& scene, float limit) {
    return std::any_of(scene.instances().begin(), scene.instances().end(),
                       [&](const gpu::Instance& instance) { return mayHaveLobe(scene, instance, limit); });
}

bool wantsIrradiance(const Indirect::Wanted& wanted) {
    return wanted.settings.pixelRays > 0 && (wanted.parts.diffuse || wanted.parts.specular);
}

bool wantsLobe(const Indirect::Wanted& wanted, const RayInputs& inputs) {
    return wanted.settings.specularRays > 0 && wanted.parts.specular &&
           (inputs.surfaces.areHosts() ? inputs.surfaces.mayHaveLobes()
                                       : hasGloss(inputs.scene, wanted.settings.specularLimit));
}

bool wantsLamps(const Indirect::Wanted& wanted, const RayInputs& inputs) {
    return wanted.parts.direct && inputs.lights.drawsLamps();
}

// Where a coat may be seen.
bool wantsCoat(const Indirect::Wanted& wanted, const RayInputs& inputs) {
    return wanted.settings.specularRays > 0 && wanted.parts.specular && inputs.surfaces.haveLayers() &&
           std::any_of(inputs.scene.instances().begin(), inputs.scene.instances().end(),
                       [&](const gpu::Instance& one) { return mayHaveCoatLobe(inputs.scene, one); });
}

}  // namespace

// Histories of other light or of other settings are old.
void Indirect::follow(const RayInputs& inputs, const TracedSettings& settings) {
    if (lightFrom_ != inputs.lit.sources() || !settings_ || !(*settings_ == settings))
        for (Gathered* one : {&diffuse_, &specular_, &coats_, &occlusion_}) one->history.passes = 0;
    const base::Revision lamps = inputs.lights.revision(), voxels = inputs.voxels.revision();
    if (lampsFrom_ != lamps || lampVoxelsFrom_ != voxels || !settings_ || !(*settings_ == settings))
        lamps_.history.passes = 0;
    lampsFrom_ = lamps;
    lampVoxelsFrom_ = voxels;
    lightFrom_ = inputs.lit.sources();
    settings_ = settings;
    // Where things were in the pictures so far is not known any more if they moved for one that was left.
    const bool lost = unfinished_ && moved_;
    unfinished_ = true;
    // Surfaces may have been seen since the last picture without one.
    const base::Revision movedFrom = inputs.surfaces.movedFrom();
    if (lost || (movedFrom && movedFrom != instances_.at())) forget();
    followInstances(inputs.scene);
}

void Indirect::forget() {
    for (Gathered* one : {&diffuse_, &specular_, &coats_, &occlusion_, &lamps_})
        one->history = {.view = std::nullopt, .passes = 0, .number = one->history.number};
}

// For means that follow what moves.
void Indirect::followInstances(const scene::GpuScene& scene) {
    const std::vector<scene::InstanceChange>& changes = instances_.look(scene);
    if (instances_.fewer()) forget();
    // Where vertices were, pixels say (Surfaces::haveMotion), or their means stay where they match.
    moved_ = std::any_of(changes.begin(), changes.end(),
                         [](const scene::InstanceChange& one) { return one.moved || one.reshaped; });
    if (moved_) motion_ = gl::Buffer(scene::oldFromWorld(scene, changes), "instance motion");
}

// Finished at once, or one more pass on top of what is known.
base::Steps Indirect::addPasses(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                                Gathered& gathered) {
    PixelRays& picture = gathered.rays;
    History& history = gathered.history;
    RayPass next = pass;
    next.motion = moved_ ? &motion_ : nullptr;
    const gpu::FrameConstants& view = inputs.surfaces.view();
    const bool known = history.view && picture.has(inputs.surfaces.width(), inputs.surfaces.height());
    // A host's vectors may say that anything moves.
    const bool still = known && sameView(*history.view, view) && !moved_ && !inputs.surfaces.haveMotion();
    if (pass.settings.budgeted) {
        next.reuse = !known ? Reuse::None : (still ? Reuse::SameView : Reuse::Reproject);
        next.number = history.number++;
        const bool steady = &gathered == &lamps_ || inputs.lit.steady();
        const int grown = steady ? history.passes / kFramesPerPass : 0;
        next.shortest = std::max(kUnsettledMean, grown);
        next.shortestOfLobes = std::max(1, grown);
        co_await picture.gatherInSteps(device, inputs, next);
        ++history.passes;
        history.view = view;
    } else {
        if (!still) history.passes = 0;
        for (; history.passes < pass.longest; ++history.passes) {
            next.reuse = history.passes == 0 ? Reuse::None : Reuse::SameView;
            next.number = static_cast<std::uint32_t>(history.passes);
            co_await picture.gatherInSteps(device, inputs, next);
            history.view = view;
        }
        history.number = static_cast<std::uint32_t>(history.passes);
    }
}

base::Steps Indirect::gatherOne(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted,
                                int rays, Gathered& gathered) {
    const RayPass pass{wanted.settings, rays,    wanted.settings.passes, 0,
                       Reuse::None,     nullptr, wanted.lookupCounters};
    co_await addPasses(device, inputs, pass, gathered);
    co_await gathered.rays.filterInSteps(device, inputs, wanted.settings.filterLevels);
    gathered.picture = &gathered.rays.filtered();
}

base::Steps Indirect::gatherInSteps(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted) {
    const TracedSettings& settings = wanted.settings;
    follow(inputs, settings);
    for (Gathered* one : {&lamps_, &diffuse_, &specular_, &coats_}) one->picture = nullptr;
    if (wantsLamps(wanted, inputs)) co_await gatherOne(device, inputs, wanted, kLampRays, lamps_);
    if (wantsIrradiance(wanted)) co_await gatherOne(device, inputs, wanted, settings.pixelRays, diffuse_);
    if (wantsLobe(wanted, inputs))
        co_await gatherOne(device, inputs, wanted, settings.specularRays, specular_);
    if (wantsCoat(wanted, inputs)) co_await gatherOne(device, inputs, wanted, settings.specularRays, coats_);
    for (Gathered* one : {&lamps_, &diffuse_, &specular_, &coats_}) one->found = one->picture;
    gatheredView_ = inputs.surfaces.view();
    unfinished_ = false;
}

base::Steps Indirect::carry(const gl::Device& device, const RayInputs& inputs,
                            const TracedSettings& settings) {
    const auto carryOne = [&](Gathered& gathered, bool lobes) {
        if (gathered.found == nullptr) return;
        const CarriedPicture::From from{.picture = *gathered.found,
                                        .view = gatheredView_,
                                        .lobes = lobes ? &gathered.rays.lobes() : nullptr,
                                        .specularLimit = settings.specularLimit,
                                        .coats = &gathered == &coats_,
                                        .cached = &gathered != &lamps_};
        gathered.picture = &gathered.carried.carry(device, inputs, from);
    };
    carryOne(diffuse_, false);
    co_await gl::rest(device);
    carryOne(lamps_, false);
    co_await gl::rest(device);
    carryOne(specular_, true);
    co_await gl::rest(device);
    // Beside the pixels' centres there may be none.
    coats_.picture = nullptr;
    if (!inputs.surfaces.haveLayers()) co_return;
    carryOne(coats_, true);
    co_await gl::rest(device);
}

base::Steps Indirect::gatherOcclusion(const gl::Device& device, const RayInputs& inputs,
                                      const TracedSettings& settings) {
    follow(inputs, settings);
    const RayPass pass{settings, kOcclusionRays, kOcclusionPasses};
    co_await addPasses(device, inputs, pass, occlusion_);
    co_await occlusion_.rays.filterInSteps(device, inputs, 1);
    occlusion_.picture = &occlusion_.rays.filtered();
    unfinished_ = false;
}

void Indirect::record(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted,
                      StepRecorder& recorder) {
    const TracedSettings& settings = wanted.settings;
    if (wantsIrradiance(wanted))
        diffuse_.rays.record(device, inputs, {settings, settings.pixelRays, settings.passes}, settings.passes,
                             recorder);
    if (wantsLobe(wanted, inputs))
        specular_.rays.record(device, inputs, {settings, settings.specularRays, settings.passes},
                              settings.passes, recorder);
}

void Indirect::recordOcclusion(const gl::Device& device, const RayInputs& inputs,
                               const TracedSettings& settings, StepRecorder& recorder) {
    occlusion_.rays.record(device, inputs, {settings, kOcclusionRays, kOcclusionPasses}, kOcclusionPasses,
                           recorder);
}

}  // namespace conelight::gather
