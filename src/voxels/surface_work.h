// SPDX-License-Identifier: MIT
// The inside of SurfaceVoxels: its results, its work space, its passes. surface_work.cpp makes room,
// surface_passes.cpp voxelizes, surface_update.cpp does again what changed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gl/late_words.h"
#include "shared/prefix_sum.h"
#include "shared/voxels.h"
#include "voxels/surface_bounds.h"
#include "voxels/surface_keys.h"
#include "voxels/surface_voxels.h"

namespace conelight::voxels {

constexpr float kLeastEmission = 1e-6f;  // W/(sr m^2); less is none

// How much every list can hold.
struct Capacity {
    std::uint32_t triangles = 0;
    std::uint32_t tiles = 0;
    std::uint32_t fragments = 0;
    std::uint32_t voxels = 0;
    std::uint32_t faces = 0;
    std::uint32_t bricks = 0;      // occupied
    std::uint32_t gridBricks = 0;  // all
};

// What of the material model the voxelized instances of a scene need.
struct Surfaces {
    int detail = 0;             // 0 constant, 1 textures or vertex colours, 2 alpha tests
    float largestEmission = 0;  // W/(sr m^2), any component
    bool lobes = false;         // metals, glossy dielectrics
    bool emit() const { return largestEmission > kLeastEmission; }
    SurfaceMaterialKey key() const { return {emit(), lobes}; }
    bool operator==(const Surfaces&) const = default;
};

Surfaces surfacesOf(const scene::GpuScene& scene);
std::uint32_t withSpare(std::uint32_t needed);  // and a little more

// What an update makes besides the keys. Two of them take turns when there are updates.
struct Results {
    gl::Buffer faces, faceMaterials, chains;
    gl::Texture faceTexels, materialTexels, chainTexels;
    std::uint32_t voxels = 0, faceCount = 0;  // there is room for

    void reserve(std::uint32_t wantedVoxels, std::uint32_t wantedFaces);
    // Keeps the first so many.
    void trim(std::uint32_t wantedVoxels, std::uint32_t wantedFaces);
};

void reserveRecords(VoxelKeys& keys, std::uint32_t voxels);
void clearBricks(VoxelKeys& keys, const glm::ivec3& bricks);

// Which instances have changed since the last build, and what has to be done about them.
struct Edits {
    std::vector<std::uint32_t> stale;         // bit per instance
    std::vector<glm::uvec2> runs;             // instances to voxelize: index, first triangle of the work
    std::vector<std::uint32_t> editedBricks;  // where changed instances were
    std::uint32_t triangles = 0;              // of the work
    std::uint32_t changedTriangles = 0;
    VoxelGrid from;        // where nested grids were
    bool scrolls = false;  // they are elsewhere
    bool any = false;
};

// Counts of an update that are on their way to the CPU; how many there are at most until then.
struct LateCounts {
    gl::LateWords words;
    struct Counts {
        std::uint32_t slots = 0, voxels = 0, faces = 0, bricks = 0;
    } most;
};

struct SurfaceVoxels::Impl {
    VoxelGrid grid;
    Capacity capacity;
    std::array<std::uint32_t, SURFACE_COUNTER_WORDS> counts{};
    Surfaces surfaces;

    VoxelKeys keys, oldKeys;  // oldKeys: of the voxels before, empty until the second build or update
    Results now, before;      // before: empty until the first update
    gl::Buffer brickList, gridBlock, levelBlock, scrollBlock, changedBricks;
    // Work space
    gl::Buffer counters, constants, triangles, tiles, pairs, masks, shiftedMasks, fragments, chunks, owners,
        layered;
    gl::Texture triangleTexels, pairTexels, fragmentTexels, ownerTexels;
    gl::Buffer stale, runs, editedBricks, freeList, origins, workList;  // of updates

    bool scrolled = false;    // some voxels were made where the grid was before
    bool unfinished = false;  // a build or an update did not come to its end

    // The scene as it was voxelized last.
    base::Revision sceneIdentity;
    std::vector<base::Revision> revisions;
    std::vector<Aabb> boxes;  // empty: not voxelized
    // Slots of fragments: those below `tail` are in use or on the list of free ones.
    std::uint32_t tail = 0, freeSlots = 0;
    LateCounts late;
    UpdateBounds bounder;
    SurfaceUpdate lastUpdate;

    void reserve(const scene::GpuScene& scene);
    void allocateFor(const Capacity& wanted);
    void releaseLists();
    void trim();
    bool grow();
    void growTriangles(std::uint32_t count);
    void reserveFaceLists(std::uint32_t faces);
    void growLists(const Capacity& wanted);
    void growFreeList();
    void upload(const scene::GpuScene& scene, const Edits* edits = nullptr);
    void clearWorkSpace();
    gl::Inputs given() const;
    base::Steps mark(const gl::Device& device, const scene::GpuScene& scene);
    base::Steps compact(const gl::Device& device);
    base::Steps clip(const gl::Device& device, const scene::GpuScene& scene, bool update);
    base::Steps resolve(const gl::Device& device, bool update);
    void updateGridBlock();

    void remember(const scene::GpuScene& scene);
    bool canUpdate(const scene::GpuScene& scene, const VoxelGrid& wanted) const;
    Edits editsOf(const scene::GpuScene& scene, const VoxelGrid& wanted) const;
    void uploadEdits(const scene::GpuScene& scene, const Edits& edits);
    base::Steps drop(const gl::Device& device, const Edits& edits);
    base::Steps shift(const gl::Device& device);
    base::Steps markEdits(const gl::Device& device, const scene::GpuScene& scene, const Edits& edits);
    base::Steps carry(const gl::Device& device);
    bool makeRoom(const scene::GpuScene& scene, const Edits& edits);
    bool finishUpdate(const Edits& edits);
    void finishLate(const Edits& edits);
    void takeCounts();
    bool fits() const;
    void know();
};

}  // namespace conelight::voxels
