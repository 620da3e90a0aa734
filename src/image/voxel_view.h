// SPDX-License-Identifier: MIT
// Views of voxels by ray casting: component voxels, and view.voxels among the objects of a picture. Cubes,
// their edges, plane pieces, a volume, or colours on surfaces, at any level; no draw call per voxel. What
// they show: ViewSettings.
//
// Where there is nothing is found out once per voxelization, means of coarser levels once per state of the
// light. Writes `output`; readers need a texture-fetch barrier. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/revision.h"
#include "conelight/settings.h"
#include "gather/radiance_volume.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "shared/voxel_view.h"
#include "view/surfaces.h"
#include "voxels/voxels.h"

namespace conelight::image {

// What a mode without surface voxels shows: a cube of RGBA texels, premultiplied colour and opacity, with
// mips.
struct VoxelVolume {
    const gl::Texture& texture;
    const gather::RadianceOctree* octree = nullptr;  // whose bricks the texture holds; null: it is dense
    const gl::Sampler& sampler;                      // linear
    glm::vec3 origin;                                // of the lowest corner, m
    float voxelSize;                                 // m
    int size;                                        // voxels along an edge
    int maxLevel;
    glm::ivec3 filledMin, filledSize;  // box of voxels outside of which there is nothing
    bool zeroMeansEmpty;               // a mean of zero two levels up: its voxels are zero
    int level;                         // that is shown unless view.voxel_level says another
    bool onSurfaces;                   // shape auto: on the picture's surfaces
    base::Revision revision;           // of what it holds
};

class VoxelView {
  public:
    struct Target {
        const Settings& settings;
        const scene::GpuScene& scene;
        const light::Lights& lights;
        const view::Surfaces& surfaces;
        const gl::Texture& output;
        bool among;  // on top of the picture in `output`
    };

    // Surface voxels, and the light on their faces, of a revision.
    struct Lit {
        const voxels::Voxels& voxels;
        const light::LitFaces& faces;
        base::Revision light;
    };
    // Shape faces is drawn where the voxels have octant words.
    void draw(const gl::Device& device, const Target& target, const Lit& lit);
    // `volume` holds what `voxels` do.
    void draw(const gl::Device& device, const Target& target, const gather::RadianceVolume& volume,
              const voxels::Voxels& voxels);
    void draw(const gl::Device& device, const Target& target, const VoxelVolume& volume);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    // Where the voxels lie that are shown, and how.
    struct Shown {
        int source;  // SOURCE of the shaders
        VoxelShape shape;
        bool directional;
        glm::vec3 origin;
        float voxelSize;
        glm::ivec3 size;
        int maxLevel;
        int levelOfMode;
    };
    void run(const gl::Device& device, const Target& target, const Shown& shown, gl::Inputs& inputs);
    void buildOccupied(const gl::Device& device, const Shown& shown, bool halves, gl::Inputs inputs,
                       base::Revision of);
    void buildLevels(const gl::Device& device, VoxelData data, const Lit& lit, const glm::ivec3& size,
                     int maxLevel);
    const gl::Buffer& constants(const gpu::VoxelViewConstants& values);

    gl::Texture occupied_;  // voxel_view_occupied.comp.glsl
    base::Revision occupiedOf_;
    gl::Texture levels_;  // level 1 and up of surface voxels
    base::Revision levelsOf_;
    gl::Texture nothing_;  // one texel, in place of levels
    VoxelData levelsData_ = VoxelData::Radiance;
    gl::Buffer constants_;
};

}  // namespace conelight::image
