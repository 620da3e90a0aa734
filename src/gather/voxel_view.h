// SPDX-License-Identifier: MIT
// Views of voxels by ray casting: component voxels, and view.voxels among the objects of a picture. Cubes,
// their edges, plane pieces, a volume, or colours on surfaces, at any level; no draw call per voxel. What
// they show: ViewSettings.
//
// Where there is nothing is found out once per voxelization, means of coarser levels once per state of the
// light.
//
// Needs the frame block, the scene tables and the G-buffer bound, and for surface voxels SurfaceVoxels (shape
// faces also OctantWords). Writes `output`; readers need a texture-fetch barrier. GL state changed: program,
// images 0 and 1, BINDING_PASS, BINDING_STORAGE_PASS, UNIT_PASS.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "shared/frame.h"
#include "thesis/render/volume.h"
#include "voxels/radiance_volume.h"
#include "voxels/surface_voxels.h"

namespace conelight::gather {

struct VoxelViewGrid;

class VoxelView {
  public:
    struct Target {
        gl::ProgramLibrary& programs;
        gl::Profiler& profiler;
        const Settings& settings;
        const gpu::FrameConstants& view;
        const gl::Texture& output;
        bool among;  // on top of the picture in `output`
    };

    // `hasOctants`: shape faces can be drawn.
    void draw(const Target& target, const voxels::SurfaceVoxels& surface, bool hasOctants);
    // `volume` holds what `surface` does; its grid is bound.
    void draw(const Target& target, const voxels::RadianceVolume& volume,
              const voxels::SurfaceVoxels& surface);
    void draw(const Target& target, const voxels::ThesisVolume& volume);

    // Before the next draw: other voxels, or other light on the same ones.
    void voxelsChanged() { occupiedValid_ = levelsValid_ = false; }
    void lightChanged() { levelsValid_ = false; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void run(const Target& target, int source, VoxelShape shape, bool directional, const VoxelViewGrid& grid,
             int levelOfMode, const gl::Texture* volume);
    void buildOccupied(const Target& target, int source, bool halves, const glm::ivec3& size);
    void buildLevels(const Target& target, const voxels::SurfaceVoxels& surface, const glm::ivec3& size,
                     int maxLevel);

    gl::Texture occupied_;  // voxel_view_occupied.comp.glsl
    bool occupiedValid_ = false;
    gl::Texture levels_;  // level 1 and up of surface voxels
    bool levelsValid_ = false;
    VoxelData levelsData_ = VoxelData::Radiance;
    gl::Buffer constants_;
};

}  // namespace conelight::gather
