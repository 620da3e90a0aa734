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

// At fewer pixels, if there are any.
RayInputs reducedInputs(const RayInputs& inputs, const view::Surfaces* reduced) {
    if (reduced == nullptr) return inputs;
    return {inputs.scene, inputs.lights, inputs.voxels, inputs.lit, *reduced};
}

}  // namespace

// Histories of other light or of other settings are old.
void Indirect::follow(const RayInputs& inputs, const TracedSettings& settings,
                      const view::Surfaces* reduced) {
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
    const auto unseen = [&](const view::Surfaces& surfaces) {
        return surfaces.movedFrom() && surfaces.movedFrom() != instances_.at();
    };
    if (lost || unseen(inputs.surfaces) || (reduced != nullptr && unseen(*reduced))) forget();
    followInstances(inputs.scene);
}

void Indirect::forget() {
    for (Gathered* one : {&diffuse_, &specular_, &coats_, &occlusion_, &lamps_})
        one->history = {.view = std::nullopt, .passes = 0, .number = one->history.number, .light = {}};
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

// Whether there are means so far, of a picture of this size.
bool Indirect::isKnown(const RayInputs& inputs, const Gathered& gathered) {
    return gathered.history.view && gathered.rays.has(inputs.surfaces.width(), inputs.surfaces.height());
}

// Whether they are of this view.
bool Indirect::isStill(const RayInputs& inputs, const Gathered& gathered) const {
    // A host's vectors may say that anything moves.
    return isKnown(inputs, gathered) && sameView(*gathered.history.view, inputs.surfaces.view()) && !moved_ &&
           !inputs.surfaces.haveMotion();
}

// One more on top of what is known.
base::Steps Indirect::addPass(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                              Gathered& gathered) {
    History& history = gathered.history;
    RayPass next = pass;
    next.motion = moved_ ? &motion_ : nullptr;
    next.reuse = !isKnown(inputs, gathered)  ? Reuse::None
                 : isStill(inputs, gathered) ? Reuse::SameView
                                             : Reuse::Reproject;
    next.number = history.number++;
    const bool steady = &gathered == &lamps_ || inputs.lit.steady();
    const int grown = steady ? history.passes / kFramesPerPass : 0;
    next.shortest = std::max(kUnsettledMean, grown);
    next.shortestOfLight = std::max(std::min(history.passes + 1, kUnsettledMean), grown);
    next.shortestOfLobes = std::max(1, grown);
    const base::Revision light = inputs.lit.sources();
    next.light = history.light == light                        ? LightSoFar::Now
                 : history.light == inputs.lit.sourcesBefore() ? LightSoFar::Before
                                                               : LightSoFar::Unknown;
    co_await gathered.rays.gatherInSteps(device, inputs, next);
    ++history.passes;
    history.view = inputs.surfaces.view();
    history.light = light;
}

// Passes of a picture that is finished at once which are those of this view.
int Indirect::keptPasses(const RayInputs& inputs, Gathered& gathered) {
    if (!isStill(inputs, gathered)) gathered.history.passes = 0;
    return gathered.history.passes;
}

// Of such a picture, up to so many.
base::Steps Indirect::addPasses(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                                int until, Gathered& gathered) {
    History& history = gathered.history;
    RayPass next = pass;
    next.motion = moved_ ? &motion_ : nullptr;
    for (; history.passes < until; ++history.passes) {
        next.reuse = history.passes == 0 ? Reuse::None : Reuse::SameView;
        next.number = static_cast<std::uint32_t>(history.passes);
        co_await gathered.rays.gatherInSteps(device, inputs, next);
        history.view = inputs.surfaces.view();
        history.light = inputs.lit.sources();
    }
    history.number = static_cast<std::uint32_t>(history.passes);
}

std::vector<Indirect::PictureRays> Indirect::wantedPictures(const RayInputs& inputs, const Wanted& wanted) {
    const TracedSettings& settings = wanted.settings;
    std::vector<PictureRays> pictures;
    if (wantsLamps(wanted, inputs)) pictures.push_back({&lamps_, kLampRays, inputs});
    if (wantsIrradiance(wanted))
        pictures.push_back({&diffuse_, settings.pixelRays, reducedInputs(inputs, wanted.reduced)});
    if (wantsLobe(wanted, inputs)) pictures.push_back({&specular_, settings.specularRays, inputs});
    if (wantsCoat(wanted, inputs)) pictures.push_back({&coats_, settings.specularRays, inputs});
    return pictures;
}

base::Steps Indirect::gatherAll(const gl::Device& device, const Wanted& wanted,
                                const std::vector<PictureRays>& pictures) {
    const int passes = wanted.settings.passes;
    const auto passOf = [&](const PictureRays& one) {
        return RayPass{wanted.settings, one.rays, passes, 0, Reuse::None, nullptr, wanted.lookupCounters};
    };
    if (wanted.settings.budgeted) {
        for (const PictureRays& one : pictures)
            co_await addPass(device, one.inputs, passOf(one), *one.gathered);
        co_return;
    }
    int made = passes;
    for (const PictureRays& one : pictures) made = std::min(made, keptPasses(one.inputs, *one.gathered));
    // Each pass aims at light samples of its own: what one draw of them errs by, more passes do not average.
    for (; made < passes; ++made) {
        if (wanted.redraw) co_await wanted.redraw(static_cast<std::uint32_t>(made));
        for (const PictureRays& one : pictures)
            co_await addPasses(device, one.inputs, passOf(one), made + 1, *one.gathered);
    }
}

base::Steps Indirect::gatherInSteps(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted) {
    follow(inputs, wanted.settings, wanted.reduced);
    for (Gathered* one : {&lamps_, &diffuse_, &specular_, &coats_}) one->picture = one->found = nullptr;
    const std::vector<PictureRays> pictures = wantedPictures(inputs, wanted);
    co_await gatherAll(device, wanted, pictures);
    for (const auto& [gathered, rays, at] : pictures) {
        co_await gathered->rays.filterInSteps(device, at, wanted.settings.filterLevels);
        gathered->picture = gathered->found = &gathered->rays.filtered();
        gathered->foundView = at.surfaces.view();
        if (&at.surfaces == &inputs.surfaces) continue;
        carryOne(device, inputs, wanted.settings, *gathered);
        co_await gl::rest(device);
    }
    unfinished_ = false;
}

// What gather() found, at other pixels.
void Indirect::carryOne(const gl::Device& device, const RayInputs& inputs, const TracedSettings& settings,
                        Gathered& gathered) {
    if (gathered.found == nullptr) return;
    const bool lobes = &gathered == &specular_ || &gathered == &coats_;
    const CarriedPicture::From from{.picture = *gathered.found,
                                    .view = gathered.foundView,
                                    .lobes = lobes ? &gathered.rays.lobes() : nullptr,
                                    .specularLimit = settings.specularLimit,
                                    .coats = &gathered == &coats_,
                                    .cached = &gathered != &lamps_};
    gathered.picture = &gathered.carried.carry(device, inputs, from);
}

base::Steps Indirect::carry(const gl::Device& device, const RayInputs& inputs,
                            const TracedSettings& settings) {
    for (Gathered* one : {&diffuse_, &lamps_, &specular_}) {
        carryOne(device, inputs, settings, *one);
        co_await gl::rest(device);
    }
    // Beside the pixels' centres there may be none.
    coats_.picture = nullptr;
    if (!inputs.surfaces.haveLayers()) co_return;
    carryOne(device, inputs, settings, coats_);
    co_await gl::rest(device);
}

base::Steps Indirect::gatherOcclusion(const gl::Device& device, const RayInputs& inputs,
                                      const TracedSettings& settings) {
    follow(inputs, settings);
    const RayPass pass{settings, kOcclusionRays, kOcclusionPasses};
    if (settings.budgeted) {
        co_await addPass(device, inputs, pass, occlusion_);
    } else {
        keptPasses(inputs, occlusion_);
        co_await addPasses(device, inputs, pass, kOcclusionPasses, occlusion_);
    }
    co_await occlusion_.rays.filterInSteps(device, inputs, 1);
    occlusion_.picture = &occlusion_.rays.filtered();
    unfinished_ = false;
}

// The passes that a finished picture has.
void Indirect::recordPasses(const gl::Device& device, const Wanted& wanted, const PictureRays& picture,
                            StepRecorder& recorder) {
    RayPass pass{wanted.settings, picture.rays, wanted.settings.passes};
    // A picture of fewer pixels stays as it is.
    PixelRays& gathered = picture.gathered->rays;
    PixelRays apart(gathered.kind());
    const view::Surfaces& surfaces = picture.inputs.surfaces;
    PixelRays& rays = gathered.has(surfaces.width(), surfaces.height()) ? gathered : apart;
    for (; pass.number < static_cast<std::uint32_t>(pass.longest); ++pass.number) {
        if (wanted.redraw && !wanted.settings.budgeted) wanted.redraw(pass.number).finish();
        rays.record(device, picture.inputs, pass, recorder);
    }
}

void Indirect::record(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted,
                      StepRecorder& recorder) {
    const TracedSettings& settings = wanted.settings;
    if (wantsIrradiance(wanted))
        recordPasses(device, wanted, {&diffuse_, settings.pixelRays, inputs}, recorder);
    if (wantsLobe(wanted, inputs))
        recordPasses(device, wanted, {&specular_, settings.specularRays, inputs}, recorder);
}

void Indirect::recordOcclusion(const gl::Device& device, const RayInputs& inputs,
                               const TracedSettings& settings, StepRecorder& recorder) {
    RayPass pass{settings, kOcclusionRays, kOcclusionPasses};
    for (; pass.number < kOcclusionPasses; ++pass.number)
        occlusion_.rays.record(device, inputs, pass, recorder);
}

}  // namespace conelight::gather
