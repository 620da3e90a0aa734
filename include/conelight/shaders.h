// SPDX-License-Identifier: MIT
// The shaders as text, for tools that check or read them without a GPU.
#pragma once

#include <cstddef>
#include <string>

#include "conelight/export.h"
#include "conelight/renderer.h"

namespace conelight {

// Writes every shader entry in every variant the renderer can ask for into `directory` (made if missing):
// includes resolved, defines inserted, exactly what the driver gets. Files are named
// STAGE/NAME-DEFINES.comp.glsl (.vert .geom .frag), which glslangValidator understands. Below gpu/ is what GPUs get
// instead (RendererOptions::execution), in fewer variants. `shaderDirectory` as
// in RendererOptions. Returns how many files were written. Needs no GL context.
// Throws Error(Runtime): an include fails, a file cannot be written.
CONELIGHT_API std::size_t expandAllShaders(const std::string& directory,
                                           const std::string& shaderDirectory = "");

// The same of the programs that renderers of this process have built so far, as one of `execution` gets them; Auto counts
// as Processor.
CONELIGHT_API std::size_t expandBuiltShaders(const std::string& directory, Execution execution);

}  // namespace conelight
