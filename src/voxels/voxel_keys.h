// SPDX-License-Identifier: MIT
// What finds a face of surface voxels by its place: grid, brickWord and voxRec of shared/voxels.h. Those of
// the voxels before are kept (SurfaceVoxels::previous), so that light can go from old faces to new ones.
#pragma once

#include "base/revision.h"
#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/texture.h"
#include "voxels/voxel_grid.h"

namespace conelight::voxels {

struct VoxelKeys {
    VoxelGrid grid;
    gl::Texture brickWords;    // RGBA32UI, size of grid.bricks()
    gl::Buffer records;        // voxRec
    gl::Texture recordTexels;  // the same
    base::Revision revision;   // of the voxels; none while they are being made

    // voxelBricks, voxelBrickImage, voxelRecords, RecordTable.
    void declare(gl::Inputs& inputs) const;
    // As the voxels before others: oldBricks, oldRecords.
    void declareOld(gl::Inputs& inputs) const;
};

}  // namespace conelight::voxels
