// SPDX-License-Identifier: MIT
// The octree that a radiance volume may be stored in (cones.storage=octree; Crassin et al. 2009, "GigaVoxels",
// and 2011): occupied voxels -> nodes and empty bricks at every level of the volume. Layout, and what is in
// a brick: shared/radiance_octree.h. RadianceVolume fills the bricks.
//
// Nodes are counted first; node pool and brick texture have the size that this gives, up to one slice of bricks.
// Numbers are given by a prefix sum: the same voxels give the same bits. A voxelization costs one wait for the
// GPU, which reads the counts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/revision.h"
#include "gather/radiance_layout.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "shared/radiance_octree.h"
#include "voxels/surface_voxels.h"

namespace conelight::gather {

class RadianceOctree {
  public:
    // Nodes for the voxels as they are, with zero in all bricks. Does nothing for the same layout and
    // revision of voxels. Leaves the results visible to shaders. Throws Error(Runtime) when the driver has no
    // room, or a tree has more than 2^24 nodes.
    void build(const gl::Device& device, const RadianceLayout& layout, const voxels::SurfaceVoxels& surface);

    // What look-ups read: RadianceOctreeBlock, OctreeNodes, radianceBricks.
    void declare(gl::Inputs& inputs) const;
    // Makes `level` the one that is filled, and adds what filling it reads: RadianceOctreeBlock, OctreeNodes,
    // OctreeBricks.
    void declareFill(gl::Inputs& inputs, int level);

    std::uint32_t nodeCount(int level) const;   // up to topLevel()
    std::uint32_t brickCount(int level) const;  // up to the volume's coarsest
    int topLevel() const { return static_cast<int>(constants_.topLevel); }
    const gl::Texture& bricks() const { return bricks_; }
    const gl::Buffer& nodes() const { return nodes_; }
    const gl::Buffer& brickNodes() const { return brickNodes_; }  // OctreeBricks

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void allocate(std::uint32_t nodes, std::uint32_t bricks);

    RadianceLayout layout_;
    base::Revision voxelsFrom_;
    std::array<std::uint32_t, 2 * OCTREE_LEVELS> counts_{};  // nodes of each level, then bricks
    gpu::RadianceOctree constants_{};
    gl::Buffer block_;
    gl::Buffer nodes_, brickNodes_;
    gl::Texture bricks_;
};

}  // namespace conelight::gather
