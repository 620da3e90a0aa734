// SPDX-License-Identifier: MIT
// relight() of lit voxels by a budget of updates, of faces and of time. With a budget of time it depends on the
// machine how far light gets; without one the same calls give the same bits.
#pragma once

#include "gl/pass.h"
#include "light/lit_voxels.h"

namespace conelight::light {

class RelightBudget {
  public:
    struct Wanted {
        int updates = 1;          // of all faces, or of `faces` of them
        std::uint32_t faces = 0;  // 0: all
        double milliseconds = 0;  // since `start`; 0: no limit. At least some faces are updated
        double start = 0;         // of begin()
    };
    // The time from which a budget of milliseconds counts; 0 without one. Waits for a software driver first: what the
    // host has asked it for before is not ours.
    static double begin(double milliseconds);
    // Light of voxels and lights as they are, and as many updates as all of these allow. On a software driver the time
    // ends when the driver has done the work; on a GPU it is what the call before took per face.
    void relight(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                 const RelightSettings& settings, const Wanted& wanted);

  private:
    void relightInTime(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                       const RelightSettings& settings, const Wanted& wanted);
    void relightAndWait(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                        const RelightSettings& settings, const Wanted& wanted);
    void relightAsMeasured(const gl::Device& device, LitVoxels& lit, const LitVoxels::Inputs& inputs,
                           const RelightSettings& settings, const Wanted& wanted);
    std::uint32_t nextFaces(const LitVoxels& lit, const Wanted& wanted, double left,
                            std::uint64_t visited) const;
    void learn(double milliseconds, std::uint32_t faces);

    double msPerFace_ = 0;  // 0: not known yet
    // On a GPU: of the call before.
    gl::Query started_, ended_;
    std::uint32_t facesMeasured_ = 0;
};

}  // namespace conelight::light
