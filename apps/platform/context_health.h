// SPDX-License-Identifier: MIT
// What a program that owns its OpenGL context can ask it about failures that belong to no call of its own.
#pragma once

namespace conelight::platform {

// Throws Error(Runtime) when the driver of the current context has run out of memory since the last call, or the
// context is lost. Takes the error flags.
void requireHealthyContext();

}  // namespace conelight::platform
