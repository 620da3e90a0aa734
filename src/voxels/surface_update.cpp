// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "gl/gl.h"
#include "voxels/surface_work.h"

namespace conelight::voxels {
namespace {

// Boxes of instances are grown by this many voxels before their bricks are searched: transformed corners of a
// box and transformed vertices are rounded differently (2^-24 of their distance from the origin, a few
// times).
constexpr float kBoxMargin = 0.1f;
constexpr float kBoxRounding = 1e-6f;

// Marks the bricks of a level that a box meets, from the place of its first on; a box that is not finite meets all.
void addBricks(std::vector<bool>& marked, const VoxelGrid& grid, std::size_t first, const Aabb& box) {
    if (box.empty()) return;
    const glm::ivec3 bricks = grid.bricks();
    glm::ivec3 low(0), high(bricks - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const float a = grid.gridFromWorld(box.min)[axis];
        const float b = grid.gridFromWorld(box.max)[axis];
        if (!std::isfinite(a) || !std::isfinite(b)) continue;
        const float far =
            std::max({std::abs(box.min[axis]), std::abs(box.max[axis]), std::abs(grid.origin[axis])});
        const float margin = kBoxMargin + kBoxRounding * far / grid.voxelSize;
        const float limit = static_cast<float>(bricks[axis]);
        low[axis] = static_cast<int>(std::clamp(std::floor((a - margin) / 4), 0.0f, limit));
        high[axis] = static_cast<int>(std::clamp(std::floor((b + margin) / 4), -1.0f, limit - 1));
    }
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) marked[first + brickIndex({x, y, z}, bricks)] = true;
}

}  // namespace

void SurfaceVoxels::Impl::remember(const scene::GpuScene& scene) {
    const std::size_t count = scene.instances().size();
    sceneIdentity = scene.identity();
    revisions.resize(count);
    boxes.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        revisions[i] = scene.instanceRevision(i);
        boxes[i] = (scene.instances()[i].flags & INSTANCE_VOXELIZED) != 0 ? scene.instanceBounds(i) : Aabb{};
    }
}

bool SurfaceVoxels::Impl::canUpdate(const scene::GpuScene& scene, const VoxelGrid& wanted) const {
    // No revision: a build or update did not come to its end.
    return keys.revision && sceneIdentity == scene.identity() && grid == wanted &&
           surfaces == surfacesOf(scene);
}

Edits SurfaceVoxels::Impl::editsOf(const scene::GpuScene& scene) const {
    Edits edits;
    const std::size_t count = scene.instances().size();  // of which the last may be new
    edits.stale.resize(count / 32 + 1);
    std::vector<bool> marked(grid.brickCount());
    for (std::size_t i = 0; i < count; ++i) {
        const bool added = i >= revisions.size();
        if (!added && revisions[i] == scene.instanceRevision(i)) continue;
        const gpu::Instance& instance = scene.instances()[i];
        const auto index = static_cast<std::uint32_t>(i);
        edits.any = true;
        edits.stale[index / 32] |= 1u << (index % 32);
        for (int level = 0; level < grid.levels && !added; ++level) {
            const VoxelGrid one = grid.level(level);
            addBricks(marked, one, static_cast<std::size_t>(level) * one.brickCount(), boxes[i]);
        }
        if ((instance.flags & INSTANCE_VOXELIZED) == 0 || instance.indexCount < 3) continue;
        edits.runs.emplace_back(index, edits.triangles);
        edits.triangles += instance.indexCount / 3;
    }
    for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i]) edits.editedBricks.push_back(static_cast<std::uint32_t>(i));
    return edits;
}

void SurfaceVoxels::Impl::uploadEdits(const scene::GpuScene& scene, const Edits& edits) {
    before.reserve(capacity.voxels, capacity.faces);
    const auto room = [](gl::Buffer& buffer, std::size_t bytes, const char* label) {
        if (!buffer || buffer.bytes() < bytes) buffer = gl::Buffer(bytes + bytes / 4, label);
    };
    const auto fill = [&](gl::Buffer& buffer, const auto& values, const char* label) {
        const std::size_t bytes = values.size() * sizeof values[0];
        room(buffer, bytes, label);
        buffer.update(0, values.data(), bytes);
    };
    fill(stale, edits.stale, "voxelizer stale instances");
    fill(runs, edits.runs, "voxelizer changed instances");
    fill(editedBricks, edits.editedBricks, "voxelizer edited bricks");
    if (!freeList || freeList.bytes() < std::size_t{4} * capacity.fragments)
        freeList = gl::Buffer(std::size_t{4} * capacity.fragments, "voxelizer free slots");
    room(origins, std::size_t{4} * capacity.voxels, "voxelizer origins");
    room(workList, std::size_t{4} * capacity.faces, "voxelizer work list");

    upload(scene, &edits);
    std::array<std::uint32_t, SURFACE_COUNTER_WORDS> start{};
    start[SURFACE_FREE] = freeSlots;
    start[SURFACE_TAIL] = tail;
    counters.update(start);
    changedBricks.clear();
}

// Old place: fragments leave their chains, slots become free.
void SurfaceVoxels::Impl::drop(const gl::Device& device, const Edits& edits) {
    const gl::PassScope scope(device.profiler, "voxelize: drop");
    gl::Inputs given = this->given();
    device.get(descOf(SurfacePass::Drop)).dispatchLinear(given, 64 * edits.editedBricks.size());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// New place: as mark(), for the triangles of changed instances.
void SurfaceVoxels::Impl::markEdits(const gl::Device& device, const scene::GpuScene& scene,
                                    const Edits& edits) {
    const gl::PassScope scope(device.profiler, "voxelize: mark");
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Setup, true}.desc())
        .dispatchLinear(given, static_cast<std::size_t>(grid.levels) * edits.triangles);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(SurfaceScanKey{SurfaceCounted::Tiles}.desc()).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::TextureFetch);
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Tiles, true}.desc())
        .dispatchIndirect(given, counters, 4 * SURFACE_ARGS_TILES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Chains under the new numbers of their voxels. `before` is what was there, `now` what will be.
void SurfaceVoxels::Impl::carry(const gl::Device& device) {
    const gl::PassScope scope(device.profiler, "voxelize: carry");
    gl::Inputs given = this->given();
    device.get(descOf(SurfacePass::Carry)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_BRICKS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Reads the counts back. False when a list was too small: what there is now is of no use.
bool SurfaceVoxels::Impl::finishUpdate(const Edits& edits) {
    counters.read(0, counts.data(), sizeof counts);
    const std::uint32_t made = counts[SURFACE_FRAGMENTS];
    const std::uint32_t reused = std::min(made, counts[SURFACE_FREE]);
    tail += made - reused;
    freeSlots = counts[SURFACE_FREE] - reused;
    lastUpdate = {false, edits.triangles, made, counts[SURFACE_WORK]};
    return tail <= capacity.fragments && counts[SURFACE_TILES] <= capacity.tiles &&
           counts[SURFACE_VOXELS] <= capacity.voxels && counts[SURFACE_FACES] <= capacity.faces &&
           counts[SURFACE_BRICKS] <= capacity.bricks;
}

void SurfaceVoxels::update(const gl::Device& device, const scene::GpuScene& scene,
                           const VoxelSettings& settings) {
    update(device, scene, gridOf(scene, settings));
}

void SurfaceVoxels::update(const gl::Device& device, const scene::GpuScene& scene, const VoxelGrid& grid) {
    Impl& m = *impl_;
    if (!m.canUpdate(scene, grid)) return build(device, scene, grid);
    const Edits edits = m.editsOf(scene);
    // Beyond half of all triangles, to clip all is as cheap as to search for those to keep.
    if (2 * edits.triangles > scene.triangleCount()) return build(device, scene, grid);
    if (!edits.any) {
        m.changedBricks.clear();
        m.lastUpdate = {};
        return;
    }
    m.allocateFor(m.capacity);
    m.growTriangles(scene.triangleCount());
    m.uploadEdits(scene, edits);
    m.drop(device, edits);
    m.markEdits(device, scene, edits);
    std::swap(m.now, m.before);
    std::swap(m.keys, m.oldKeys);
    m.keys.revision = {};
    reserveRecords(m.keys, m.capacity.voxels);
    clearBricks(m.keys, m.grid.storedBricks());
    m.compact(device);
    m.carry(device);
    m.clip(device, scene, true);
    m.resolve(device, true);
    if (!m.finishUpdate(edits)) {
        // A list is too small: grow() in build() sees what a whole scene needs.
        return build(device, scene, grid);
    }
    m.updateGridBlock();
    m.keys.grid = m.grid;
    m.keys.faceCount = m.counts[SURFACE_FACES];
    m.keys.revision = base::Revision::next();
    m.remember(scene);
}

}  // namespace conelight::voxels
