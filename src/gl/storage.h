// SPDX-License-Identifier: MIT
// Whether the driver gave the memory that a buffer or texture asked for.
#pragma once

#include <cstddef>
#include <string>

#include "gl/object.h"

namespace conelight::gl {

// Throws Error(Runtime) when `name`, whose storage was just asked for, has none; the driver's error flag is
// cleared then, because the host learns of the failure by the exception.
void requireStorage(ObjectType type, Name name, const std::string& label, std::size_t bytes);

}  // namespace conelight::gl
