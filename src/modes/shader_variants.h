// SPDX-License-Identifier: MIT
// Every program the renderer can ask for, put together from the stages' lists. Tests link each of them, and
// `conelight shaders --expand` writes each for glslangValidator. A shader that is in no list fails
// tests/cpu/shader_variants_test.cpp.
#pragma once

#include <vector>

#include "gl/program.h"

namespace conelight::modes {

// Without repetition, in the order of the stages. No GL calls.
std::vector<gl::ProgramDesc> allShaderVariants();

}  // namespace conelight::modes
