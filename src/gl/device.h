// SPDX-License-Identifier: MIT
// What every stage needs to run passes: the programs, and who takes their times. Owned by the renderer.
#pragma once

#include "gl/inputs.h"
#include "gl/pass.h"
#include "gl/program.h"

namespace conelight::gl {

struct Device {
    ProgramLibrary& programs;
    Profiler& profiler;

    const Program& get(const ProgramDesc& desc) const { return programs.get(desc); }
};

}  // namespace conelight::gl
