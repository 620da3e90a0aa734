// SPDX-License-Identifier: MIT
// A Scene as a flat byte string and back, for handing it from one process to another of the same program
// (child_process.h). Not a file format: it has no version and holds native byte order.
#pragma once

#include <span>

#include "conelight/scene.h"
#include "io/files.h"

namespace conelight::io {

Bytes bytesFromScene(const Scene& scene);

// Throws Error(Runtime) when the bytes are not exactly one scene.
Scene sceneFromBytes(std::span<const std::uint8_t> bytes);

}  // namespace conelight::io
