// SPDX-License-Identifier: MIT
// The order in which updates of the irradiance cache visit faces (shaders/light/cache_order.comp.glsl).
// Voxels -> faces that gather, those of one place and direction in a block next to each other. Faces that
// share another's irradiance, and faces found inside closed objects, are not visited.
#pragma once

#include "base/steps.h"
#include "gl/device.h"
#include "gl/late_words.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

class FaceOrder {
  public:
    struct Wanted {
        bool searches;      // faces that may be inside closed objects are visited, to find out
        bool keepsMemory;   // for the next sort: where voxels change again and again
        bool late = false;  // numbers may come a frame later
    };
    // `states` (gpu::FaceCache per face) of faces that are not visited are changed.
    base::Steps sortInSteps(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                            const gl::Buffer& states, const gl::Texture& stateTexels, Wanted wanted);

    // Faces that updates visit in order, and those behind them, of which each is searched: both wait while the numbers
    // are on their way from the GPU.
    std::uint32_t gathering() const { return known().gathering; }
    std::uint32_t doubtful() const { return known().doubtful; }
    std::uint32_t visited() const { return gathering() + doubtful(); }
    bool isFresh() const { return late_.ofThisFrame(); }  // on their way since this frame
    const gl::Buffer& counts() const { return chunks_; }  // begins with both, for shaders
    const gl::Buffer& buffer() const { return order_; }
    const gl::Texture& texels() const { return orderTexels_; }  // R32UI: a face per place

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Counts {
        std::uint32_t gathering = 0, doubtful = 0;
    };
    const Counts& known() const;
    void takeCounts(bool late);
    void reserveOrder(std::size_t faces);
    void reserveBins(std::uint32_t count);
    void releaseBins();

    gl::Buffer order_, bins_, binStarts_, chunks_, block_;
    gl::Texture orderTexels_, binTexels_, binStartTexels_;
    mutable Counts counts_;
    mutable gl::LateWords late_;  // what they are to be
    std::uint32_t sorts_ = 0;     // ever
};

}  // namespace conelight::light
