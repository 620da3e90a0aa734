// SPDX-License-Identifier: MIT
// What every stage needs to run passes: the programs, who takes their times, and which shape of a pass suits the
// driver. Owned by the renderer.
#pragma once

#include "gl/inputs.h"
#include "gl/pass.h"
#include "gl/program.h"

namespace conelight::gl {

// Passes that write each pixel once come as fragments for a software driver and as compute for a GPU
// (docs/design/0012-two-execution-profiles.md). Either gives the same bits on a driver that rounds alike in both.
enum class ExecutionProfile { Processor, Gpu };

// The shaders as that profile gets them: lib/execution.glsl tells them.
ShaderProvider providerFor(ExecutionProfile profile, ShaderProvider provider);

class Pace;

struct Device {
    ProgramLibrary& programs;
    Profiler& profiler;
    ExecutionProfile profile = ExecutionProfile::Processor;
    Pace* pace = nullptr;  // of a picture that is drawn in parts (gl/pace.h); null: in one
    // Programs for voxels in nested grids (shaders/lib/voxel_levels.glsl). Those for one grid know nothing of them.
    bool nestedGrids = false;

    // Whether counts of shaders are read a frame later (gl/late_words.h). A software driver computes as it is told, so
    // that waiting costs it nothing.
    bool readsLate() const { return profile == ExecutionProfile::Gpu && pace == nullptr; }

    const Program& get(const ProgramDesc& desc) const {
        return nestedGrids ? programs.get(forNestedGrids(desc)) : programs.get(desc);
    }
    static ProgramDesc forNestedGrids(ProgramDesc desc) {
        desc.defines.emplace_back("NESTED_GRIDS", "1");
        return desc;
    }
};

}  // namespace conelight::gl
