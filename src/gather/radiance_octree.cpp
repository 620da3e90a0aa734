// SPDX-License-Identifier: MIT
#include "gather/radiance_octree.h"

#include <algorithm>
#include <numeric>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"
#include "shared/prefix_sum.h"

namespace conelight::gather {
namespace {

constexpr int kLevels = OCTREE_LEVELS;
// Slices of the brick texture: at most eight times as many as a row has bricks, so that the last one, which is
// filled in part, is a small part of all; and no more than 2048 texels, the least limit of GL 4.5.
constexpr std::uint32_t kSlicesPerRow = 8, kMostSlices = 2048 / OCTREE_BRICK_EDGE, kMostRowBits = 8;

struct MarkKey {
    int blocks;  // 1 or 6
    gl::ProgramDesc desc() const {
        return {{"gather/octree_mark.comp.glsl"}, {{"DIRECTIONAL", blocks == 6 ? "1" : "0"}}};
    }
    static std::vector<MarkKey> all() { return {{1}, {6}}; }
};

struct NodesKey {
    int step;
    gl::ProgramDesc desc() const {
        return {{"gather/octree_nodes.comp.glsl"}, {{"STEP", std::to_string(step)}}};
    }
    static std::vector<NodesKey> all() { return {{0}, {1}, {2}, {3}}; }
};

int ceilDiv(int value, int by) { return (value + by - 1) / by; }

// Level of the one node that holds all texels.
int rootLevelOf(const glm::ivec3& size) {
    int nodes = ceilDiv(std::max({size.x, size.y, size.z}), OCTREE_NODE_EDGE);
    int level = 0;
    for (; nodes > 1; nodes = ceilDiv(nodes, 2)) ++level;
    CONELIGHT_ASSERT(level <= OCTREE_DEEPEST, "grids have at most 1024 voxels along an axis");
    return level;
}

std::uint32_t rowBitsFor(std::uint32_t bricks) {
    std::uint32_t bits = 0;
    const auto slices = [&] { return (bricks + (1u << (2 * bits)) - 1) >> (2 * bits); };
    while (bits < kMostRowBits && slices() > std::min(kSlicesPerRow << bits, kMostSlices)) ++bits;
    return bits;
}

}  // namespace

void RadianceOctree::allocate(std::uint32_t nodes, std::uint32_t bricks) {
    if (nodes > OCTREE_CHILD_MASK || bricks > OCTREE_NUMBER_MASK)
        base::fail(ErrorKind::Runtime,
                   "storage: an octree of %u nodes and %u bricks; at most %u and %u would be right, as fewer "
                   "voxels give",
                   nodes, bricks, OCTREE_CHILD_MASK, OCTREE_NUMBER_MASK);
    // Of a tree without voxels, the nodes at which look-ups start are read all the same.
    const std::size_t nodeBytes = std::size_t{8} * std::max(nodes, std::uint32_t{kLevels});
    const std::size_t listBytes = std::size_t{4} * bricks;
    // Freed first: two of them need not fit.
    nodes_ = {};
    nodes_ = gl::Buffer(nodeBytes, "octree nodes");
    brickNodes_ = {};
    brickNodes_ = gl::Buffer(listBytes, "octree brick nodes");

    constants_.rowBits = rowBitsFor(bricks);
    const int row = 1 << constants_.rowBits;
    const int slices = std::max(ceilDiv(static_cast<int>(bricks), row * row), 1);
    const glm::ivec3 texels = OCTREE_BRICK_EDGE * glm::ivec3(row, row, slices);
    constants_.inverseTextureSize = 1.0f / glm::vec3(texels);
    brickTexels_ = texels;
}

void RadianceOctree::fitBricks(gl::Texture& texture, std::uint32_t format, const std::string& label) const {
    const glm::ivec3& size = brickTexels_;
    if (!texture || texture.desc().format != format || texture.width() != size.x ||
        texture.depth() != size.z || texture.desc().levels != 1) {
        texture.reset();
        texture = gl::Texture({GL_TEXTURE_3D, format, size.x, size.y, size.z}, label);
        texture.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        texture.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        for (const unsigned axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
            texture.parameter(axis, GL_CLAMP_TO_EDGE);
    }
    texture.clear(0, GL_RGBA, GL_FLOAT, nullptr);
}

void RadianceOctree::build(const gl::Device& device, const RadianceLayout& layout,
                           const voxels::SurfaceVoxels& surface) {
    if (bricks_ && layout_ == layout && voxelsFrom_ == surface.revision()) return;
    build(device, {layout.size, layout.maxLevel, layout.blocks}, [&](const gl::Inputs& tree) {
        gl::Inputs marks = tree;
        marks.add(surface);
        device.get(MarkKey{layout.blocks}.desc()).dispatchLinear(marks, surface.mostVoxels());
    });
    fitBricks(bricks_, GL_RGBA16F, "radiance bricks");
    layout_ = layout;
    voxelsFrom_ = surface.revision();
}

void RadianceOctree::build(const gl::Device& device, const Shape& shape, const Mark& mark) {
    const gl::PassScope pass(device.profiler, "radiance octree");
    shape_ = shape;
    if (!block_) block_ = gl::Buffer(sizeof(gpu::RadianceOctree), "octree constants");
    const int root = rootLevelOf(shape.size);
    constants_.rootLevel = static_cast<std::uint32_t>(root);
    constants_.maxLevel = static_cast<std::uint32_t>(shape.maxLevel);
    constants_.topLevel = std::max(constants_.rootLevel, constants_.maxLevel);
    constants_.slots = constants_.topLevel - constants_.rootLevel + ((1u << (3 * (root + 1))) - 1) / 7;
    constants_.slotsPerChunk = gpu::perChunk(constants_.slots);
    block_.update(constants_);
    const gl::Buffer slots(std::size_t{4} * constants_.slots, "octree slots");
    const gl::Buffer counted(sizeof(counts_), "octree counts");
    const gl::Buffer none(8, "octree nodes");

    gl::Inputs marks;
    marks.uniform("RadianceOctreeBlock", block_)
        .storage("OctreeNodes", none)
        .storage("OctreeSlots", slots)
        .storage("OctreeCounts", counted);
    mark(marks);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Update);
    counted.read(0, counts_.data(), sizeof(counts_));

    const auto sum = [&](int from) {
        return std::accumulate(counts_.begin() + from, counts_.begin() + from + kLevels, 0u);
    };
    allocate(sum(0), sum(kLevels));
    block_.update(constants_);
    number(device, slots);
}

// Numbers for the marked slots.
void RadianceOctree::number(const gl::Device& device, const gl::Buffer& slots) {
    const std::uint32_t chunks = gpu::chunksOf(constants_.slots);
    const gl::Buffer sums(std::size_t{8} * chunks, "octree chunks");
    gl::Inputs numbers;
    numbers.uniform("RadianceOctreeBlock", block_)
        .storage("OctreeSlots", slots)
        .storage("OctreeChunks", sums)
        .storage("OctreeNodes", nodes_)
        .storage("OctreeBricks", brickNodes_);
    const std::uint32_t invocations[] = {chunks, 1, chunks, constants_.slots};
    for (const NodesKey& key : NodesKey::all()) {
        device.get(key.desc()).dispatchLinear(numbers, invocations[key.step]);
        gl::barrier(gl::Access::ShaderStorage);
    }
}

std::uint32_t RadianceOctree::nodeCount(int level) const { return counts_[static_cast<std::size_t>(level)]; }

std::uint32_t RadianceOctree::brickCount(int level) const {
    return counts_[static_cast<std::size_t>(kLevels + level)];
}

void RadianceOctree::declare(gl::Inputs& inputs) const {
    inputs.uniform("RadianceOctreeBlock", block_).storage("OctreeNodes", nodes_);
    if (bricks_) inputs.texture("radianceBricks", bricks_);
}

void RadianceOctree::declareFill(gl::Inputs& inputs, int level) {
    // Bricks are numbered from the root's level down.
    constants_.firstBrick = 0;
    for (int above = level + 1; above <= shape_.maxLevel; ++above) constants_.firstBrick += brickCount(above);
    constants_.level = static_cast<std::uint32_t>(level);
    constants_.brickCount = brickCount(level);
    block_.update(constants_);
    inputs.uniform("RadianceOctreeBlock", block_)
        .storage("OctreeNodes", nodes_)
        .storage("OctreeBricks", brickNodes_);
}

std::vector<gl::ProgramDesc> RadianceOctree::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const MarkKey& key : MarkKey::all()) descs.push_back(key.desc());
    for (const NodesKey& key : NodesKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
