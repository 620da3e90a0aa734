// SPDX-License-Identifier: MIT
// The list of modes: who draws each, and with which shaders. The library's own come first; a mode with a
// folder of its own (modes/) is added by whoever wants it.
#pragma once

#include <memory>
#include <vector>

#include "conelight/settings.h"
#include "gl/program.h"
#include "modes/mode.h"

namespace conelight::modes {

struct ModeEntry {
    Mode mode;
    std::unique_ptr<ModeRenderer> (*make)();
    std::vector<gl::ProgramDesc> (*programDescs)();  // every variant of its shaders, for checks
};

// Call before the first Renderer, from one thread. A mode that is there already is passed over.
void registerMode(const ModeEntry& entry);
const std::vector<ModeEntry>& registeredModes();

// Throws Error(Usage) for a mode that nobody registered.
std::unique_ptr<ModeRenderer> makeModeRenderer(Mode mode);

// Of LightField (conelight/light_field.h).
std::vector<gl::ProgramDesc> lightFieldProgramDescs();

}  // namespace conelight::modes
