// SPDX-License-Identifier: MIT
// Where the texels of a radiance volume lie: grid and settings -> size of its levels, blocks, storage.
#pragma once

#include <glm/glm.hpp>

#include "conelight/settings.h"
#include "shared/radiance_volume.h"
#include "voxels/voxel_grid.h"

namespace conelight::gather {

struct RadianceLayout {
    voxels::VoxelGrid grid;
    int blocks = 1;      // 6 with directions
    int maxLevel = 0;    // coarsest level
    glm::ivec3 size{4};  // texels of level 0 per block; texel 0 is voxel 0
    VolumeStorage storage = VolumeStorage::Dense;

    gpu::RadianceVolume packed() const;
    bool operator==(const RadianceLayout&) const = default;
};

// `maxFootprint`: fraction of the grid's longest side (ConesSettings).
RadianceLayout radianceLayout(const voxels::VoxelGrid& grid, VolumeDirections directional, float maxFootprint,
                              VolumeStorage storage = VolumeStorage::Dense);

}  // namespace conelight::gather
