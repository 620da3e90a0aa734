// SPDX-License-Identifier: MIT
// KHR_debug: errors of the driver go to the log and are counted; a test fails when the count is not zero.
// Other messages of high severity go to the log as warnings, the rest and those of the shader compiler, which
// Program reports, nowhere. The count is process-wide.
#pragma once

#include <string>

namespace conelight::gl {

// For the owner of the context, not for the library, which leaves the host's callback alone. Needs a debug
// context. Synchronous: the message appears inside the call that caused it.
void installDebugCallback();

int debugErrorCount();  // GL_DEBUG_TYPE_ERROR since the start or the last reset
std::string lastDebugError();
void resetDebugErrors();

// Throws Error(NoGl) unless a context is current and is desktop OpenGL >= 4.5.
void requireContext();
// Whether any context is current on this thread. Costs microseconds.
bool hasCurrentContext();

}  // namespace conelight::gl
