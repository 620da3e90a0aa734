// SPDX-License-Identifier: MIT
// The thesis's lit volume: GpuScene -> one 3D texture of direct light with its mips (thesis, chapter 4,
// "Voxelization Process"; chapter 5, "Voxelization"). Every triangle is seen along its dominant axis, and cut into
// columns of voxels; pieces carry the Phong light into the volume. Compute passes: one invocation per small triangle,
// eight per tile of a wide one. With the defect centerCoverage a raster pass instead, as in the original.
//
// RGBA16F premultiplied radiance and opacity (RGBA8 with the defect clippedRadiance). For occlusion cones two
// more, RGBA8: the area of surface in a texel as it is seen along x, y and z, in parts of a face, of what faces
// the positive and the negative sides (unless isotropicOpacity; stores that race make none). All lie in dense
// textures, or in bricks of one octree (gather/radiance_octree.h). The grid is a cube: fitted to the scene, or
// [-1,1]^3 with the defect wholeGrid. Work and memory beyond the volume go with the bricks of 8^3 voxels that hold
// surface, which a first pass marks; their number is read back, one wait for the GPU per build (none with the
// original's stores). With an octree, sums are freed after each build.
//
// Leaves the textures visible to texture fetches. GL state changed: raster state, programs and their slots.
// Limits: one colour per voxel for both faces of a wall; 255 layers of surface per voxel, 127 with areas.
#pragma once

#include "base/revision.h"
#include "base/steps.h"
#include "conelight/thesis/settings.h"
#include "gather/radiance_octree.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "thesis/shaders/constants.h"

namespace conelight::thesis {

struct ThesisVolumeOptions {
    int size = 64;           // voxels along the cube's edge; 8..512, divisible by 4
    float padding = 0.03f;   // of the fitted grid, fraction of the scene's extent per side
    glm::vec3 shift{0};      // moves the grid toward lower coordinates, voxels; 0..1
    bool unitGrid = false;   // [-1,1]^3 instead of the fitted grid
    bool shadows = true;     // light is tested against the shadow maps
    light::LightKey lights;  // which kinds of light there are, with shadows
    ThesisDefects defects;   // those of the volume count
    VolumeStorage storage = VolumeStorage::Dense;
    VoxelizationAxis along = VoxelizationAxis::Dominant;
    VolumeFilter filter = VolumeFilter::Linear;
    int bounces = 1;       // of indirect light in what cones find: one less in the volume
    ThesisSettings cones;  // above one bounce: their diffuse cones carry light on
    bool operator==(const ThesisVolumeOptions&) const = default;
};

class ThesisVolume {
  public:
    // Voxelizes `scene` anew. Storage is kept while size and format stay.
    struct Inputs {
        const scene::GpuScene& scene;
        const light::Lights& lights;
    };
    void build(const gl::Device& device, const Inputs& inputs, const ThesisVolumeOptions& options) {
        buildInSteps(device, inputs, options).finish();
    }
    base::Steps buildInSteps(const gl::Device& device, const Inputs& inputs,
                             const ThesisVolumeOptions& options);
    base::Revision revision() const { return revision_; }  // raised by each build

    const gpu::ThesisGrid& grid() const { return grid_; }
    // Of all voxels, or of the octree's bricks.
    const gl::Texture& texture() const { return lit_ < 0 ? texture_ : bounced_[lit_]; }
    const gather::RadianceOctree* octree() const { return isOctree_ ? &octree_ : nullptr; }
    // Trilinear within and between levels or the nearest, edge texels repeated outside.
    const gl::Sampler& sampler() const { return sampler_; }
    // volume and, if there are any, areasPlus and areasMinus, with their samplers; ThesisGridBlock; of an octree
    // what look-ups read.
    void declare(gl::Inputs& inputs) const;
    // Whether a build with these defects makes areas along the axes.
    static bool hasAreas(const ThesisDefects& defects) {
        return !defects.isotropicOpacity && !defects.racingStores;
    }

    // The grid that build() would use. The cube is fitted to `bounds`, the box in it that is filled to
    // `filled`.
    static gpu::ThesisGrid fitGrid(const Aabb& bounds, const Aabb& filled,
                                   const ThesisVolumeOptions& options);
    static gpu::ThesisGrid fitGrid(const Aabb& bounds, const ThesisVolumeOptions& options) {
        return fitGrid(bounds, bounds, options);
    }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    enum class Content : std::uint8_t { Light, Albedo, Normal };  // of the voxelizer's sums
    // What a scene asks of the voxelizer.
    struct SceneKey {
        bool textured = false;
        bool rectangles = false;  // some lights are rectangles
        bool tiles = false;       // tiles of wide triangles
    };

    void allocate(const ThesisVolumeOptions& options);
    void allocateDense(const ThesisVolumeOptions& options);
    void allocateLists();
    void allocateSums(const ThesisVolumeOptions& options);
    void layOut(const Inputs& inputs, const ThesisVolumeOptions& options);
    void clearBox();
    // Calls `pass` for each axis along which triangles are voxelized, with that axis in the constants.
    template <class Pass>
    void forEachAxis(const ThesisVolumeOptions& options, const Pass& pass);
    void markBricks(const gl::Device& device, const Inputs& inputs, const ThesisVolumeOptions& options);
    void listBricks(const gl::Device& device);
    void drawTriangles(const gl::Device& device, const Inputs& inputs, const ThesisVolumeOptions& options,
                       Content content);
    // What of the triangles is voxelized, and how.
    struct Wanted {
        const ThesisVolumeOptions& options;
        SceneKey scene;
        Content content;
    };
    void rasterTriangles(const gl::Device& device, const Inputs& inputs, const Wanted& wanted,
                         const gl::Inputs& given);
    void sumTriangles(const gl::Device& device, const Inputs& inputs, const Wanted& wanted, gl::Inputs given);
    void resolve(const gl::Device& device, const ThesisDefects& defects, const gl::Texture& target);
    bool areAreas(const gl::Texture& texture) const {
        return &texture == &areas_[0] || &texture == &areas_[1];
    }
    // From level `first` on.
    void buildMips(const gl::Device& device, const ThesisDefects& defects, const gl::Texture& texture,
                   int first = 1);
    static gl::ProgramDesc voxelizeDesc(const ThesisVolumeOptions& options, const SceneKey& scene,
                                        Content content);
    // bounces.cpp
    void allocateBounces(const ThesisVolumeOptions& options);
    void clearOthers(int level, const glm::ivec3& first, const glm::ivec3& size);
    void sumSurfaces(const gl::Device& device, const Inputs& inputs, const ThesisVolumeOptions& options);
    void bounce(const gl::Device& device, const Inputs& inputs, const ThesisVolumeOptions& options);
    // volume_octree.cpp
    void growOctree(const gl::Device& device, const ThesisVolumeOptions& options);
    static std::vector<gl::ProgramDesc> octreeDescs();
    void buildOctreeMips(const gl::Device& device, const ThesisDefects& defects, const gl::Texture& texture);
    gl::Inputs bricks() const;  // what passes over bricks read

    glm::ivec3 filledMin_{0},
        filledSize_{0};  // box of the texture's voxels that may not be zero; size 0: all
    gpu::ThesisGrid grid_{};
    bool isOctree_ = false;
    gather::RadianceOctree octree_;
    gl::Texture texture_, areas_[2];  // areas_: of what faces positive, negative sides; may be empty
    // Above one bounce: two volumes in turn, and what surfaces are made of.
    gl::Texture bounced_[2], albedo_, normal_;
    gl::Buffer bounceConstants_;
    int lit_ = -1;  // which of them has all bounces; -1: texture_
    gl::Sampler sampler_, areaSampler_;
    VolumeFilter filter_ = VolumeFilter::Linear;
    gl::Framebuffer viewport_;
    gl::Buffer constants_, sums_, areaSums_, brickSlots_, brickList_, brickMarks_, tiles_;
    // Of the list, and of wide triangles' tiles; 0 with the original's stores.
    std::size_t brickCount_ = 0, tileCount_ = 0;
    bool unfinished_ = false;  // the last build was left
    base::Revision revision_;
};

}  // namespace conelight::thesis
