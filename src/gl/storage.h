// SPDX-License-Identifier: MIT
// Memory for buffers and textures: whether there is room for it within a limit, and whether the driver gave it.
#pragma once

#include <cstddef>
#include <string>

#include "conelight/error.h"
#include "gl/object.h"

namespace conelight::gl {

std::size_t liveBytes();  // of all live objects of the process

// Kind Runtime. Nothing was asked of the driver.
struct MemoryError : Error {
    using Error::Error;
};

// Throws MemoryError when `bytes` more are beyond the limit (conelight/memory.h).
void requireRoom(const std::string& label, std::size_t bytes);

// Throws Error(Runtime) when `name`, whose storage was just asked for, has none; the driver's error flag is
// cleared then, because the host learns of the failure by the exception.
void requireStorage(ObjectType type, Name name, const std::string& label, std::size_t bytes);

// Throws Error(Runtime) when the context is lost, as the driver tells contexts that asked to be told.
void requireLiveContext();

}  // namespace conelight::gl
