// SPDX-License-Identifier: MIT
#include "light/relight_budget.h"

#include <algorithm>
#include <cstdint>

#include "base/clock.h"

namespace conelight::light {
namespace {

// Before anything has been measured: a few milliseconds on two cores of a CPU driver.
constexpr std::uint32_t kFirstFaces = 2048;
// Fewer cost no less: each call commits the light of all faces.
constexpr std::uint32_t kLeastFaces = 1024;

// Updates at most `faces`, and returns how many.
std::uint32_t updateFaces(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                          const RelightSettings& settings, std::uint32_t faces) {
    lit.relight(device, inputs, settings, {.oneUpdate = true, .faces = faces});
    const std::uint32_t all = lit.facesPerUpdate();
    return all > 0 ? std::min(faces, all) : faces;
}

}  // namespace

double RelightBudget::begin(double milliseconds) {
    if (!(milliseconds > 0)) return 0;
    if (gl::isSoftwareDriver()) gl::finish();
    return base::wallMs();
}

void RelightBudget::relight(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                            const RelightSettings& settings, const Wanted& wanted) {
    if (wanted.milliseconds > 0 && wanted.updates > 0)
        return relightInTime(device, lit, inputs, settings, wanted);
    Budget each{.oneUpdate = true, .faces = wanted.faces, .nothing = wanted.updates <= 0};
    // The first call finds what has changed; the others go on from there.
    lit.relight(device, inputs, settings, each);
    for (int i = 1; i < wanted.updates && lit.updates() < settings.updates; ++i)
        lit.relight(device, inputs, settings, each);
}

// What is the same for any number of faces counts to the cost of each: more of them take less time than is thought,
// so that the number grows from time to time until it fills the budget.
void RelightBudget::learn(double milliseconds, std::uint32_t faces) {
    msPerFace_ = milliseconds / std::max(faces, 1u);
}

// As many faces as the time that is left and the other limits allow; 0: no more.
std::uint32_t RelightBudget::nextFaces(const LitVoxels& lit, const Wanted& wanted, double left,
                                       std::uint64_t visited) const {
    double faces = msPerFace_ > 0 ? left / msPerFace_ : kFirstFaces - static_cast<double>(visited);
    if (visited > 0 && faces < kLeastFaces) return 0;
    faces = std::min(faces, 1e9);
    const std::uint32_t round = lit.facesPerUpdate();  // not known at first
    if (round > 0) {
        const std::uint64_t each = wanted.faces > 0 ? std::min(wanted.faces, round) : round;
        const std::uint64_t most = each * static_cast<std::uint64_t>(wanted.updates);
        if (visited >= most) return 0;
        faces = std::min(faces, static_cast<double>(std::min<std::uint64_t>(most - visited, round)));
    }
    return static_cast<std::uint32_t>(std::max(faces, 1.0 * kLeastFaces));
}

void RelightBudget::relightInTime(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                                  const RelightSettings& settings, const Wanted& wanted) {
    if (gl::isSoftwareDriver())  // whose queries of time lie
        relightAndWait(device, lit, inputs, settings, wanted);
    else
        relightAsMeasured(device, lit, inputs, settings, wanted);
}

void RelightBudget::relightAndWait(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                                   const RelightSettings& settings, const Wanted& wanted) {
    std::uint64_t visited = 0;
    for (;;) {
        const double start = base::wallMs();
        const std::uint32_t most =
            nextFaces(lit, wanted, wanted.milliseconds - (start - wanted.start), visited);
        if (most == 0) break;
        const std::uint32_t count = updateFaces(device, lit, inputs, settings, most);
        visited += count;
        gl::finish();
        learn(base::wallMs() - start, count);
        if (lit.updates() >= settings.updates || lit.facesPerUpdate() == 0) break;
    }
}

void RelightBudget::relightAsMeasured(const gl::Device& device, LitVoxels& lit,
                                      const LitVoxels::Inputs& inputs, const RelightSettings& settings,
                                      const Wanted& wanted) {
    if (facesMeasured_ > 0) learn(ended_.resultMs() - started_.resultMs(), facesMeasured_);
    if (!started_) {
        started_ = gl::Query("relight start");
        ended_ = gl::Query("relight end");
    }
    started_.record();
    std::uint64_t visited = 0;
    for (;;) {
        const double left = wanted.milliseconds - static_cast<double>(visited) * msPerFace_;
        const std::uint32_t most = nextFaces(lit, wanted, left, visited);
        if (most == 0) break;
        visited += updateFaces(device, lit, inputs, settings, most);
        if (lit.updates() >= settings.updates || lit.facesPerUpdate() == 0) break;
    }
    ended_.record();
    facesMeasured_ = static_cast<std::uint32_t>(visited);
}

}  // namespace conelight::light
