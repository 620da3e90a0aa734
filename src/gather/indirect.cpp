// SPDX-License-Identifier: MIT
#include "gather/indirect.h"

#include <algorithm>
#include <utility>

#include "gl/pace.h"

namespace conelight::gather {
namespace {

// Means over frames while the cache is still on its way, so many passes: longer ones would show old light
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
        diffuseHistory_.passes = specularHistory_.passes = coatHistory_.passes = occlusionHistory_.passes = 0;
    const base::Revision lamps = inputs.lights.revision(), voxels = inputs.voxels.revision();
    if (lampsFrom_ != lamps || lampVoxelsFrom_ != voxels || !settings_ || !(*settings_ == settings))
        lampHistory_.passes = 0;
    lampsFrom_ = lamps;
    lampVoxelsFrom_ = voxels;
    lightFrom_ = inputs.lit.sources();
    settings_ = settings;
    // Where things were in the pictures so far is not known any more if they moved for one that was left.
    const bool lost = unfinished_ && moved_;
    unfinished_ = true;
    followInstances(inputs.scene);
    if (lost) forget();
}

void Indirect::forget() {
    diffuseHistory_ = specularHistory_ = coatHistory_ = occlusionHistory_ = lampHistory_ = {};
}

// Where each instance was in the frame before, for means that follow them. One that has come since stands still.
void Indirect::followInstances(const scene::GpuScene& scene) {
    const std::vector<gpu::Instance>& instances = scene.instances();
    if (placed_.size() > instances.size()) forget();
    moved_ = false;
    std::vector<glm::mat4> oldFromWorld(instances.size(), glm::mat4(1));
    const std::size_t known = std::min(placed_.size(), instances.size());
    placed_.resize(instances.size());
    entries_.resize(instances.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const glm::mat4 place = instances[i].worldFromObject;
        if (i < known && entries_[i] == scene.entryRevision(i) && placed_[i] != place) {
            oldFromWorld[i] = placed_[i] * glm::inverse(place);
            moved_ = true;
        }
        placed_[i] = place;
        entries_[i] = scene.entryRevision(i);
    }
    if (moved_) motion_ = gl::Buffer(oldFromWorld, "instance motion");
}

// Finished at once, or one more pass on top of what is known.
base::Steps Indirect::addPasses(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                                PixelRays& picture, History& history) {
    RayPass next = pass;
    next.motion = moved_ ? &motion_ : nullptr;
    const gpu::FrameConstants& view = inputs.surfaces.view();
    const bool known = history.view && picture.has(inputs.surfaces.width(), inputs.surfaces.height());
    // A host's vectors may say that anything moves.
    const bool still = known && sameView(*history.view, view) && !moved_ && !inputs.surfaces.haveMotion();
    if (pass.settings.budgeted) {
        next.reuse = !known ? Reuse::None : (still ? Reuse::SameView : Reuse::Reproject);
        next.number = static_cast<std::uint32_t>(history.passes);
        const bool steady = &picture == &lamps_ || inputs.lit.steady();
        const int grown = steady ? history.passes / kFramesPerPass : 0;
        next.longest = std::min(pass.longest, std::max(kUnsettledMean, grown));
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
    }
}

base::Steps Indirect::gatherInSteps(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted) {
    const TracedSettings& settings = wanted.settings;
    follow(inputs, settings);
    irradiance_ = lobe_ = coat_ = lampPicture_ = nullptr;
    if (wantsLamps(wanted, inputs)) {
        const RayPass pass{settings,    kLampRays, settings.passes,      0,
                           Reuse::None, nullptr,   wanted.lookupCounters};
        co_await addPasses(device, inputs, pass, lamps_, lampHistory_);
        co_await lamps_.filterInSteps(device, inputs, settings.filterLevels);
        lampPicture_ = &lamps_.filtered();
    }
    if (wantsIrradiance(wanted)) {
        const RayPass pass{settings, settings.pixelRays,   settings.passes, 0, Reuse::None,
                           nullptr,  wanted.lookupCounters};
        co_await addPasses(device, inputs, pass, diffuse_, diffuseHistory_);
        co_await diffuse_.filterInSteps(device, inputs, settings.filterLevels);
        irradiance_ = &diffuse_.filtered();
    }
    if (wantsLobe(wanted, inputs)) {
        const RayPass pass{settings, settings.specularRays, settings.passes, 0, Reuse::None,
                           nullptr,  wanted.lookupCounters};
        co_await addPasses(device, inputs, pass, specular_, specularHistory_);
        co_await specular_.filterInSteps(device, inputs, settings.filterLevels);
        lobe_ = &specular_.filtered();
    }
    if (wantsCoat(wanted, inputs)) {
        const RayPass pass{settings, settings.specularRays, settings.passes, 0, Reuse::None,
                           nullptr,  wanted.lookupCounters};
        co_await addPasses(device, inputs, pass, coats_, coatHistory_);
        co_await coats_.filterInSteps(device, inputs, settings.filterLevels);
        coat_ = &coats_.filtered();
    }
    gatheredIrradiance_ = irradiance_;
    gatheredLobe_ = lobe_;
    gatheredLamps_ = lampPicture_;
    gatheredCoat_ = coat_;
    gatheredView_ = inputs.surfaces.view();
    unfinished_ = false;
}

base::Steps Indirect::carry(const gl::Device& device, const RayInputs& inputs,
                            const TracedSettings& settings) {
    if (gatheredIrradiance_ != nullptr)
        irradiance_ = &carriedIrradiance_.carry(
            device, inputs, {*gatheredIrradiance_, gatheredView_, nullptr, settings.specularLimit});
    co_await gl::rest(device);
    if (gatheredLamps_ != nullptr)
        lampPicture_ = &carriedLamps_.carry(device, inputs,
                                            {.picture = *gatheredLamps_,
                                             .view = gatheredView_,
                                             .lobes = nullptr,
                                             .specularLimit = settings.specularLimit,
                                             .cached = false});
    co_await gl::rest(device);
    if (gatheredLobe_ != nullptr)
        lobe_ = &carriedLobe_.carry(device, inputs,
                                    {*gatheredLobe_, gatheredView_, &lobes(), settings.specularLimit});
    co_await gl::rest(device);
    // Beside the pixels' centres there may be none.
    coat_ = nullptr;
    if (gatheredCoat_ == nullptr || !inputs.surfaces.haveLayers()) co_return;
    coat_ = &carriedCoat_.carry(
        device, inputs, {*gatheredCoat_, gatheredView_, &coats_.lobes(), settings.specularLimit, true});
    co_await gl::rest(device);
}

base::Steps Indirect::gatherOcclusion(const gl::Device& device, const RayInputs& inputs,
                                      const TracedSettings& settings) {
    follow(inputs, settings);
    const RayPass pass{settings, kOcclusionRays, kOcclusionPasses};
    co_await addPasses(device, inputs, pass, occlusion_, occlusionHistory_);
    co_await occlusion_.filterInSteps(device, inputs, 1);
    occlusionPicture_ = &occlusion_.filtered();
    unfinished_ = false;
}

void Indirect::record(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted,
                      StepRecorder& recorder) {
    const TracedSettings& settings = wanted.settings;
    if (wantsIrradiance(wanted))
        diffuse_.record(device, inputs, {settings, settings.pixelRays, settings.passes}, settings.passes,
                        recorder);
    if (wantsLobe(wanted, inputs))
        specular_.record(device, inputs, {settings, settings.specularRays, settings.passes}, settings.passes,
                         recorder);
}

void Indirect::recordOcclusion(const gl::Device& device, const RayInputs& inputs,
                               const TracedSettings& settings, StepRecorder& recorder) {
    occlusion_.record(device, inputs, {settings, kOcclusionRays, kOcclusionPasses}, kOcclusionPasses,
                      recorder);
}

}  // namespace conelight::gather
