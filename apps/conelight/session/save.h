// SPDX-License-Identifier: MIT
// Writes the session's scene as it is now.
#pragma once

#include <string>
#include <vector>

#include "session/session.h"

namespace conelight::program {

// What is written of it: settings in it, the present view as its first camera.
Scene sceneToSave(const Session& session);

// The format by extension: .txt .scene (the thesis's text format, with view and settings), .gltf .glb. The
// present view is the first camera of what is written. Returns what the format could not hold, one line each.
// Throws Error(Usage) for an unknown extension, and for a file that exists unless `force`; Error(Runtime)
// when it cannot be written.
std::vector<std::string> saveSession(Session& session, const std::string& path, bool force);

}  // namespace conelight::program
