// SPDX-License-Identifier: MIT
// The octree that a volume of radiance may be stored in (cones.storage=octree; Crassin et al. 2009, "GigaVoxels",
// and 2011): occupied voxels -> nodes and empty bricks at every level of the volume. Layout, and what is in
// a brick: shared/radiance_octree.h. RadianceVolume fills the bricks; a volume of a guest may have several
// textures of bricks at the same places (fitBricks).
//
// Nodes are counted first; node pool and brick textures have the size that this gives, up to one slice of bricks.
// Numbers are given by a prefix sum: the same voxels give the same bits. A voxelization costs one wait for the
// GPU, which reads the counts.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
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
    // Of a volume: texels of level 0, coarsest level, directions with a brick of their own.
    struct Shape {
        glm::ivec3 size{4};
        int maxLevel = 0;
        int blocks = 1;
        bool operator==(const Shape&) const = default;
    };
    // Runs a pass that marks voxels (lib/octree_mark.glsl), with what it reads and writes of the tree.
    using Mark = std::function<void(const gl::Inputs& tree)>;
    // Nodes for the marked voxels, without bricks of its own. Otherwise as below.
    void build(const gl::Device& device, const Shape& shape, const Mark& mark);
    // Makes `texture` one of bricks for this tree, all zero; kept if it has the size.
    void fitBricks(gl::Texture& texture, std::uint32_t format, const std::string& label) const;

    // Nodes for the voxels as they are, with zero in all bricks. Does nothing for the same layout and
    // revision of voxels. Leaves the results visible to shaders. Throws Error(Runtime) when the driver has no
    // room, or a tree has more than 2^24 nodes.
    void build(const gl::Device& device, const RadianceLayout& layout, const voxels::SurfaceVoxels& surface);

    // What look-ups read: RadianceOctreeBlock, OctreeNodes, and radianceBricks if there are bricks of its own.
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
    void number(const gl::Device& device, const gl::Buffer& slots);

    Shape shape_;
    RadianceLayout layout_;
    base::Revision voxelsFrom_;
    std::array<std::uint32_t, 2 * OCTREE_LEVELS> counts_{};  // nodes of each level, then bricks
    gpu::RadianceOctree constants_{};
    gl::Buffer block_;
    gl::Buffer nodes_, brickNodes_;
    glm::ivec3 brickTexels_{0};  // of a texture of bricks
    gl::Texture bricks_;
};

}  // namespace conelight::gather
