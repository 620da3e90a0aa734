// SPDX-License-Identifier: MIT
// Where light-sampled rays go: the flux of faces -> pools of faces by cluster, and for each cell of the grid which clusters
// its surfaces draw (shaders/lib/light_cells.glsl). Method: docs/theory/4c_estimator.md, "The pool". Part of
// light::IrradianceCache.
//
// The same fluxes and numbers give the same bits: all sums have an order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

class LightSamples {
  public:
    // Makes room for the faces of these voxels. What was written may be lost.
    void reserve(const voxels::VoxelGrid& grid, std::uint32_t faces);
    // Frees what drawing needs, but not what was drawn.
    void release();
    bool canDraw() const { return static_cast<bool>(fluxes_); }
    // What the commit of the cache writes: FluxTable, sidedFlux() of each face; CellMarkTable, a bit per row in which rays
    // start. Forgets the marks so far.
    void declareWritten(gl::Inputs& inputs);
    // Draws anew, by what was written. `constants`: gpu::CacheConstants.
    base::Steps drawInSteps(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                            const gl::Buffer& constants);

    void declare(gl::Inputs& inputs) const;                // lightSamples
    const gl::Buffer& buffer() const { return samples_; }  // of shared/irradiance.h, for tests
    const gl::Buffer& fluxes() const { return fluxes_; }   // for tests

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer samples_, fluxes_, runs_, clusterList_, clusterPlaces_, rowList_, marks_;
    gl::Texture sampleTexels_, fluxTexels_, runTexels_, clusterListTexels_, clusterPlaceTexels_,
        rowListTexels_, markTexels_;
    std::size_t runCount_ = 0;
};

}  // namespace conelight::light
