// SPDX-License-Identifier: MIT
// Every program the renderer can ask for, put together from the keys of the stages and modes (`Key::all()`),
// and a part of them that stands for all. Tests link each of that part, and `conelight shaders --expand`
// writes each for glslangValidator. A shader that is in no list fails tests/cpu/shader_variants_test.cpp; a
// program that is asked for and is in no list fails the test that asked (tests/support/variant_check.h).
#pragma once

#include <string>
#include <vector>

#include "gl/program.h"

namespace conelight::modes {

// Without repetition, in the order of the stages. No GL calls.
std::vector<gl::ProgramDesc> allShaderVariants();

// Of a compute program by its label (gl::ProgramDesc): the file that expandBuiltShaders writes, without its ending.
std::string variantNameOf(const std::string& label);

// A part of `all` that stands for it: every value of a define that any variant of a program's files has
// (`together` 1), or every two values of two defines that any has together (2). Faults of more at a time are
// not met by checks of this part.
std::vector<gl::ProgramDesc> coveringVariants(const std::vector<gl::ProgramDesc>& all, int together);

}  // namespace conelight::modes
