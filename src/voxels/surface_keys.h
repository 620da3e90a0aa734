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

// What has been counted, in the order of STEP of surface_scan.comp.glsl: Bricks and Faces are turned into
// starts; of the others only the group counts of the passes that follow are written.
enum class SurfaceCounted { Tiles, Bricks, Faces, Work, Layers };

struct SurfaceScanKey {
    SurfaceCounted counted;
    gl::ProgramDesc desc() const;
    static std::vector<SurfaceScanKey> all() {
        using enum SurfaceCounted;
        return {{Tiles}, {Bricks}, {Faces}, {Work}, {Layers}};
    }
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
enum class SurfacePass { Bricks, Carry, Copy, Drop, Shift };
gl::ProgramDesc descOf(SurfacePass pass);

std::vector<gl::ProgramDesc> surfaceProgramDescs();

}  // namespace conelight::voxels
