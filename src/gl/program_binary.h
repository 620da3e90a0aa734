// SPDX-License-Identifier: MIT
// Linked programs as bytes, which the same driver links again without their sources (ProgramCache). Of drivers that have
// no format for that, nothing is kept and nothing loaded.
// Use on the thread of the context only.
#pragma once

#include <span>
#include <string>

#include "conelight/program_cache.h"
#include "gl/object.h"
#include "gl/shader_source.h"

namespace conelight::gl {

// Changes with each text, and with each driver: its name, its version.
std::string programKey(std::span<const ExpandedShader> stages);

// Before a program is linked that keepBinary() is to read.
void wantBinary(Name program);
void keepBinary(Name program, const std::string& key, ProgramCache& cache);
// Links `program` by what is kept under `key`; false where that is nothing, or damaged, or another driver's: then a line
// of the log names `label`, and the program is as it was.
bool linkBinary(Name program, const std::string& key, const std::string& label, ProgramCache& cache);

}  // namespace conelight::gl
