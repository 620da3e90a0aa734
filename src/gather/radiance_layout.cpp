// SPDX-License-Identifier: MIT
#include "gather/radiance_layout.h"

#include <algorithm>
#include <cmath>

namespace conelight::gather {
namespace {

int roundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

gpu::RadianceVolume RadianceLayout::packed() const {
    gpu::RadianceVolume v{};
    const float h = grid.voxelSize;
    v.origin = grid.origin;
    v.voxelSize = h;
    v.inverseVoxelSize = 1.0f / h;
    v.extent = glm::vec3(size) * h;
    v.inverseExtent = 1.0f / v.extent;
    v.maxLevel = static_cast<float>(maxLevel);
    v.sizeX = static_cast<std::uint32_t>(size.x);
    v.sizeY = static_cast<std::uint32_t>(size.y);
    v.sizeZ = static_cast<std::uint32_t>(size.z);
    v.halfTexelX = 0.5f / static_cast<float>(size.x);
    return v;
}

RadianceLayout radianceLayout(const voxels::VoxelGrid& grid, VolumeDirections directional, float maxFootprint,
                              VolumeStorage storage) {
    RadianceLayout layout;
    layout.grid = grid;
    layout.blocks = directional == VolumeDirections::Six ? 6 : 1;
    layout.storage = storage;
    const int longest = std::max({grid.size.x, grid.size.y, grid.size.z});
    // The coarsest level is the one whose texels are nearest to the largest footprint.
    const float footprint = std::clamp(maxFootprint, 0.0f, 1.0f) * static_cast<float>(longest);
    layout.maxLevel = footprint > 1.0f ? static_cast<int>(std::lround(std::log2(footprint))) : 0;
    const int texel = 1 << layout.maxLevel;
    layout.size = {roundUp(grid.size.x, texel), roundUp(grid.size.y, texel), roundUp(grid.size.z, texel)};
    return layout;
}

}  // namespace conelight::gather
