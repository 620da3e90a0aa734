// SPDX-License-Identifier: MIT
// The surface voxels of a scene: GpuScene -> brickWord, voxRec, face, material of shared/voxels.h.
// Every triangle is clipped exactly against the voxels it meets (docs/theory/2_voxels.md, eq. 2.2) by compute
// passes. Sums are integers, so the result is the same bit for bit, whatever the order of threads.
//
// Instances without INSTANCE_VOXELIZED are left out; unlit materials occlude (black, no emission); a masked
// or blended texture scales coverage; double-sided triangles count in both directions. Triangles may be of
// any size and may reach out of the grid; those without area are skipped. What lies in front hides what it
// covers within a voxel ("Layers within a voxel", ibidem). Limits: 1023 voxels per axis; 2^26 faces; 65,000
// triangles in one voxel, 21,000 where they cover each other.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/revision.h"
#include "base/steps.h"
#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "voxels/voxel_grid.h"
#include "voxels/voxel_keys.h"

namespace conelight::voxels {

// What the last build or update had to do.
struct SurfaceUpdate {
    bool whole = false;           // everything was voxelized anew
    bool scrolled = false;        // nested grids moved, and kept what they could
    std::uint32_t triangles = 0;  // set up
    std::uint32_t fragments = 0;  // clipped
    std::uint32_t faces = 0;      // summed up
};

class SurfaceVoxels {
  public:
    SurfaceVoxels();
    ~SurfaceVoxels();
    SurfaceVoxels(SurfaceVoxels&&) noexcept;
    SurfaceVoxels& operator=(SurfaceVoxels&&) noexcept;

    // Voxelizes `scene` anew into its grid (gridOf, or `grid`; several levels take a device of nestedGrids, and one
    // grid a device without), cheap enough for every frame: from the second
    // call on memory is kept and only grows. Waits for the GPU once, to read the counts. Leaves the results
    // visible to later shaders, as storage, textures and indirect arguments.
    void build(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings) {
        build(device, scene, gridOf(scene, settings));
    }
    void build(const gl::Device& device, const scene::GpuScene& scene, const VoxelGrid& grid) {
        buildInSteps(device, scene, grid).finish();
    }

    // As build(), but does again only what `scene` has changed since the last build or update: bit for bit
    // the same voxels. Nested grids around another eye keep the voxels that stay in their level, which may differ
    // from those of a build by rounding (hasScrolled). Falls back to build() for another scene or grid,
    // when materials need another variant of the passes, when more than half of the triangles changed, and
    // when a list has become too small. Does nothing when nothing changed. On a GPU it does not wait where lists have
    // room for all that may come.
    void update(const gl::Device& device, const scene::GpuScene& scene, const VoxelSettings& settings) {
        updateInSteps(device, scene, gridOf(scene, settings)).finish();
    }
    // Left before it is done, the next one builds all anew.
    base::Steps buildInSteps(const gl::Device& device, const scene::GpuScene& scene, VoxelGrid grid);
    base::Steps updateInSteps(const gl::Device& device, const scene::GpuScene& scene, VoxelGrid grid);

    // Raised by each build(), and by each update() that changed voxels; none before the first. Buffers and
    // textures may be others at another revision.
    base::Revision revision() const;
    const VoxelKeys& keys() const;
    // Those of the voxels before the last change; null when there were none.
    const VoxelKeys* previous() const;

    // Of the last build or update: bit i % 32 of word i / 32 is set when something changed in brick i
    // (brickIndex); all are set after a build.
    const gl::Buffer& changedBricks() const;
    const SurfaceUpdate& lastUpdate() const;
    // Whether some were made while nested grids lay elsewhere.
    bool hasScrolled() const;

    // The grid fitted to the scene as it was handed over, grown by whole bricks to what has left it since.
    static VoxelGrid gridOf(const scene::GpuScene& scene, const VoxelSettings& settings);
    // The same in settings.levels levels around settings.anchor, or an eye.
    static VoxelGrid gridAround(const scene::GpuScene& scene, const VoxelSettings& settings,
                                const glm::vec3& eye);

    // What shaders may read: VoxelGridBlock, VoxelLevelBlock, voxelBricks, voxelBrickImage, voxelRecords, voxelFaces,
    // voxelFaceMaterials; and as storage RecordTable, FaceTable, FaceMaterialTable, BrickTable (the occupied
    // bricks).
    void declare(gl::Inputs& inputs) const;
    // What rays read that meet triangles: voxelChains, voxelFragments, voxelPairs, voxelTriangles.
    void declareTriangles(gl::Inputs& inputs) const;

    const VoxelGrid& grid() const;
    std::uint32_t voxelCount() const;  // occupied voxels
    std::uint32_t faceCount() const;
    std::uint32_t occupiedBrickCount() const;
    std::uint32_t fragmentCount() const;  // pairs (triangle, voxel)
    std::uint32_t fragmentSlots() const;  // places of fragments; those not in use have no area
    // On a GPU the counts of an update come a frame later, so that it is not waited for: those above wait if they have
    // to. At most so many there are, and shaders know how many (VoxelGridBlock).
    std::uint32_t mostVoxels() const;
    std::uint32_t mostFaces() const;
    std::uint32_t mostOccupiedBricks() const;
    std::uint32_t mostFragmentSlots() const;
    bool isLate() const;  // the counts are on their way
    // fragmentSlots() into a buffer, without waiting.
    void putFragmentSlots(gl::Buffer& to, std::size_t offset) const;

    const gl::Texture& brickWords() const;     // RGBA32UI, size of grid().bricks()
    const gl::Buffer& records() const;         // voxRec; voxelCount() uints are in use
    const gl::Buffer& faces() const;           // gpu::FaceRecord; faceCount() are in use
    const gl::Buffer& faceMaterials() const;   // gpu::FaceMaterial, likewise
    const gl::Buffer& occupiedBricks() const;  // packVoxel(brick) of each, in order of brick index

    static std::vector<gl::ProgramDesc> programDescs();

    // The voxelizer's own list, for tests: 32 bytes per fragment, see shaders/voxels/surface_clip.comp.glsl.
    const gl::Buffer& fragments() const;

  private:
    std::uint32_t known(int counter) const;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::voxels
