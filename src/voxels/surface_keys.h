// SPDX-License-Identifier: MIT
// Variants of the voxelizer's shaders (shaders/voxels/surface_*), one key per shader.
#pragma once

#include <vector>

#include "gl/program.h"

namespace conelight::voxels {

struct SurfaceCountKey {
    bool ofBricks;  // else of faces
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceCountKey> all() { return {{true}, {false}}; }
};

struct SurfaceScanKey {
    int step;  // of surface_scan.comp.glsl
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceScanKey> all() { return {{0}, {1}, {2}, {3}, {4}}; }
};

// Passes that differ only in whether they update voxels or make all.
struct SurfaceMarkKey {
    enum class Pass { Setup, Tiles, Faces } pass;
    bool update;
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceMarkKey> all();
};

// What of the material model the voxelized instances need.
struct SurfaceMaterialKey {
    bool emission, lobes;
    gl::Defines defines() const;
    static std::vector<SurfaceMaterialKey> all() {
        return {{false, false}, {false, true}, {true, false}, {true, true}};
    }
};

struct SurfaceClipKey {
    int detail;  // 0 constant, 1 textures or vertex colours, 2 alpha tests
    SurfaceMaterialKey material;
    bool update;
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceClipKey> all();
};

struct SurfaceResolveKey {
    SurfaceMaterialKey material;
    bool update;
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceResolveKey> all();
};

struct SurfaceLayersKey {
    SurfaceMaterialKey material;
    bool onlyWide;  // faces of which only the bounds are too wide
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceLayersKey> all();
};

// Passes without variants.
enum class SurfacePass { Bricks, Carry, Copy, Drop };
gl::ProgramDesc descOf(SurfacePass pass);

std::vector<gl::ProgramDesc> surfaceProgramDescs();

}  // namespace conelight::voxels
