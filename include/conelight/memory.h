// SPDX-License-Identifier: MIT
// How much memory the OpenGL objects of this library may take together.
#pragma once

#include <cstddef>

#include "conelight/export.h"

namespace conelight {

// Bytes of storage that all OpenGL objects of this library may have in the process; 0, the default: no limit. It is
// looked at before each allocation, in calls that follow. Renderer::render draws a picture that would need more with
// smaller shadow maps, fewer voxels or without a temporal past, and says so to the log, as a warning. Where that is not
// enough, and in all other calls, Error(Runtime) says what did not fit. Thread-safe.
CONELIGHT_API void setMemoryLimit(std::size_t bytes);
CONELIGHT_API std::size_t memoryLimit();

}  // namespace conelight
