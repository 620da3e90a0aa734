// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/assert.h"
#include "gl/gl.h"
#include "gl/pace.h"
#include "voxels/nested_grid.h"
#include "voxels/surface_bounds.h"
#include "voxels/surface_work.h"

namespace conelight::voxels {
namespace {

// Marks the bricks of a level that a box meets, from the place of its first on; a box that is not finite meets all.
void addBricks(std::vector<bool>& marked, const VoxelGrid& grid, std::size_t first, const Aabb& box) {
    const glm::ivec3 bricks = grid.bricks();
    const VoxelRange range = voxelsOfBox(grid, box);
    const glm::ivec3 low = range.low / 4, high = (range.end + 3) / 4 - 1;
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) marked[first + brickIndex({x, y, z}, bricks)] = true;
}

// Marks the bricks that leave their level.
void addLeaving(std::vector<bool>& marked, const VoxelGrid& from, const VoxelGrid& to) {
    const glm::ivec3 bricks = from.bricks();
    std::size_t place = 0;
    for (int level = 0; level < from.levels; ++level) {
        const glm::ivec3 shift = shiftOf(from, to, level);
        for (int z = 0; z < bricks.z; ++z)
            for (int y = 0; y < bricks.y; ++y)
                for (int x = 0; x < bricks.x; ++x) {
                    const glm::ivec3 voxel = 4 * glm::ivec3(x, y, z) + shift;
                    if (!to.contains(voxel) || isWithinFiner(to, level, voxel)) marked[place] = true;
                    ++place;
                }
    }
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
    return keys.revision && !unfinished && sceneIdentity == scene.identity() &&
           (grid == wanted || isMoved(grid, wanted)) && surfaces == surfacesOf(scene);
}

Edits SurfaceVoxels::Impl::editsOf(const scene::GpuScene& scene, const VoxelGrid& wanted) const {
    Edits edits;
    edits.from = grid;
    edits.any = edits.scrolls = !(grid == wanted);
    const std::size_t count = scene.instances().size();  // of which the last may be new
    edits.stale.resize(count / 32 + 1);
    std::vector<bool> marked(grid.brickCount());
    for (std::size_t i = 0; i < count; ++i) {
        const bool added = i >= revisions.size();
        const bool changed = added || revisions[i] != scene.instanceRevision(i);
        if (!changed && !edits.scrolls) continue;
        const gpu::Instance& instance = scene.instances()[i];
        const auto index = static_cast<std::uint32_t>(i);
        edits.any = true;
        if (changed) edits.stale[index / 32] |= 1u << (index % 32);
        for (int level = 0; level < grid.levels && changed && !added; ++level) {
            const VoxelGrid one = grid.level(level);
            addBricks(marked, one, static_cast<std::size_t>(level) * one.brickCount(), boxes[i]);
        }
        if ((instance.flags & INSTANCE_VOXELIZED) == 0 || instance.indexCount < 3) continue;
        edits.runs.emplace_back(index, edits.triangles);
        edits.triangles += instance.indexCount / 3;
        if (changed) edits.changedTriangles += instance.indexCount / 3;
    }
    if (edits.scrolls) addLeaving(marked, grid, wanted);
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
    growFreeList();
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
base::Steps SurfaceVoxels::Impl::drop(const gl::Device& device, const Edits& edits) {
    gl::PassSteps scope(device, "voxelize: drop");
    gl::Inputs given = this->given();
    device.get(descOf(SurfacePass::Drop)).dispatchLinear(given, 64 * edits.editedBricks.size());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    co_await scope.rest();
}

// Nested grids move: masks and fragments that stay get the coordinates that they have from here on.
base::Steps SurfaceVoxels::Impl::shift(const gl::Device& device) {
    gl::PassSteps scope(device, "voxelize: shift");
    if (shiftedMasks.bytes() != masks.bytes())
        shiftedMasks = gl::Buffer(masks.bytes(), "voxelizer shifted masks");
    gl::Inputs given = this->given();
    device.get(descOf(SurfacePass::Shift))
        .dispatchLinear(given, std::max<std::size_t>(grid.brickCount(), tail));
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    std::swap(masks, shiftedMasks);
    changedBricks.fill(~0u);
    co_await scope.rest();
}

// New place: as mark(), for the triangles of changed instances.
base::Steps SurfaceVoxels::Impl::markEdits(const gl::Device& device, const scene::GpuScene& scene,
                                           const Edits& edits) {
    gl::PassSteps scope(device, "voxelize: mark");
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Setup, true}.desc())
        .dispatchLinear(given, static_cast<std::size_t>(grid.levels) * edits.triangles);
    gl::barrier(gl::Access::ShaderStorage);
    co_await scope.rest();
    device.get(SurfaceScanKey{SurfaceCounted::Tiles}.desc()).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::TextureFetch);
    co_await scope.rest();
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Tiles, true}.desc())
        .dispatchIndirect(given, counters, 4 * SURFACE_ARGS_TILES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    co_await scope.rest();
}

// Chains under the new numbers of their voxels. `before` is what was there, `now` what will be.
base::Steps SurfaceVoxels::Impl::carry(const gl::Device& device) {
    gl::PassSteps scope(device, "voxelize: carry");
    gl::Inputs given = this->given();
    device.get(descOf(SurfacePass::Carry)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_BRICKS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    co_await scope.rest();
}

// More room in lists costs memory; up to twice of what there is it is worth a wait less in every frame, and up to so
// many entries in any case.
constexpr double kMostGrowth = 2, kGrowthForFree = 65536;

// Makes room for all that the update may find, so that its counts need not be waited for. False: that would be too much,
// or is not known.
bool SurfaceVoxels::Impl::makeRoom(const scene::GpuScene& scene, const Edits& edits) {
    const std::optional<SurfaceBounds> found = bounder.of(scene, edits.runs, grid);
    if (!found) return false;
    Capacity wanted = capacity;
    bool fits = true;
    const auto need = [&](std::uint32_t& have, std::uint32_t used, double more, double most) {
        const double needed = std::min(used + std::ceil(more), most);
        fits = fits && needed <= std::max(kMostGrowth * have, kGrowthForFree);
        if (fits && needed > have) have = withSpare(static_cast<std::uint32_t>(needed));
        return static_cast<std::uint32_t>(std::min(needed, 1e9));
    };
    constexpr double kUnlimited = 1e9;
    const double bricks = static_cast<double>(grid.brickCount());
    late.most.slots = need(wanted.fragments, tail, found->fragments, kUnlimited);
    late.most.voxels = need(wanted.voxels, counts[SURFACE_VOXELS], found->voxels, kUnlimited);
    late.most.faces = need(wanted.faces, counts[SURFACE_FACES], found->faces, kUnlimited);
    late.most.bricks = need(wanted.bricks, counts[SURFACE_BRICKS], found->bricks, bricks);
    need(wanted.tiles, 0, found->tiles, kUnlimited);
    if (fits) growLists(wanted);
    return fits;
}

// What the counts say, of an update that has set up so many triangles.
void SurfaceVoxels::Impl::takeCounts() {
    const std::uint32_t made = counts[SURFACE_FRAGMENTS];
    const std::uint32_t reused = std::min(made, counts[SURFACE_FREE]);
    tail += made - reused;
    freeSlots = counts[SURFACE_FREE] - reused;
    lastUpdate.fragments = made;
    lastUpdate.faces = counts[SURFACE_WORK];
}

bool SurfaceVoxels::Impl::fits() const {
    return tail <= capacity.fragments && counts[SURFACE_TILES] <= capacity.tiles &&
           counts[SURFACE_VOXELS] <= capacity.voxels && counts[SURFACE_FACES] <= capacity.faces &&
           counts[SURFACE_BRICKS] <= capacity.bricks;
}

// Reads the counts back. False when a list was too small: what there is is of no use then.
bool SurfaceVoxels::Impl::finishUpdate(const Edits& edits) {
    counters.read(0, counts.data(), sizeof counts);
    lastUpdate = {false, edits.scrolls, edits.triangles, 0, 0};
    takeCounts();
    if (!fits()) return false;
    updateGridBlock();
    return true;
}

// Leaves the counts on their way: shaders have them.
void SurfaceVoxels::Impl::finishLate(const Edits& edits) {
    lastUpdate = {false, edits.scrolls, edits.triangles, 0, 0};
    late.words.take(counters, 0, counts.size());
    updateGridBlock();
    const auto copy = [&](std::size_t counter, std::size_t to) {
        gridBlock.copyRange(counters, 4 * counter, to, 4);
    };
    copy(SURFACE_VOXELS, offsetof(gpu::VoxelGrid, voxelCount));
    copy(SURFACE_FACES, offsetof(gpu::VoxelGrid, faceCount));
    copy(SURFACE_BRICKS, offsetof(gpu::VoxelGrid, occupiedBricks));
}

// Takes counts in that are on their way.
void SurfaceVoxels::Impl::know() {
    if (!late.words.pending()) return;
    late.words.read(counts);
    takeCounts();
    CONELIGHT_ASSERT(fits(), "SurfaceVoxels::update: more than the most that there can be");
}

base::Steps SurfaceVoxels::updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                         VoxelGrid grid) {
    Impl& m = *impl_;
    m.know();
    const bool can = m.canUpdate(scene, grid);
    const Edits edits = can ? m.editsOf(scene, grid) : Edits{};
    // Beyond half of all triangles, to clip all is as cheap as to search for those to keep.
    if (!can || 2 * edits.changedTriangles > scene.triangleCount()) {
        co_await buildInSteps(device, scene, grid);
        co_return;
    }
    if (!edits.any) {
        m.changedBricks.clear();
        m.lastUpdate = {};
        co_return;
    }
    m.unfinished = true;
    m.grid = grid;
    m.allocateFor(m.capacity);
    m.growTriangles(scene.triangleCount());
    // Fragments of all instances may come in where nested grids move.
    const bool late = device.readsLate() && !edits.scrolls && m.makeRoom(scene, edits);
    m.uploadEdits(scene, edits);
    co_await m.drop(device, edits);
    if (edits.scrolls) co_await m.shift(device);
    co_await m.markEdits(device, scene, edits);
    std::swap(m.now, m.before);
    std::swap(m.keys, m.oldKeys);
    m.keys.revision = {};
    reserveRecords(m.keys, m.capacity.voxels);
    clearBricks(m.keys, m.grid.storedBricks());
    co_await m.compact(device);
    co_await m.carry(device);
    co_await m.clip(device, scene, true);
    co_await m.resolve(device, true);
    if (late) {
        m.finishLate(edits);
    } else if (!m.finishUpdate(edits)) {
        // A list is too small: grow() in build() sees what a whole scene needs.
        co_await buildInSteps(device, scene, grid);
        co_return;
    }
    m.keys.grid = m.grid;
    m.keys.revision = base::Revision::next();
    m.remember(scene);
    m.scrolled = m.scrolled || edits.scrolls;
    m.unfinished = false;
}

}  // namespace conelight::voxels
