// SPDX-License-Identifier: MIT
// KHR_debug: errors of the driver go to the log and are counted; a test fails when the count is not zero.
#pragma once

#include <string>

namespace conelight::gl {

// Needs a debug context. Synchronous: the message appears inside the call that caused it.
void installDebugCallback();

int debugErrorCount();            // GL_DEBUG_TYPE_ERROR since the start or the last reset
std::string lastDebugError();
void resetDebugErrors();

// Throws Error(NoGl) unless the current context is desktop OpenGL >= 4.5.
void requireContext();

}  // namespace conelight::gl
