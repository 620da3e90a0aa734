// SPDX-License-Identifier: MIT
// Views along the world's axes, of the selection or of the whole scene.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "session/session.h"

namespace conelight::program {

// `side`: front (from +z), back, right (from +x), left, top (from +y) or bottom. A step of undo.
void viewFrom(Session& session, const std::string& side, const glm::ivec2& pictureSize);
// The present view as a camera of the scene, a step of undo; returns its name.
std::string keepView(Session& session);
// The scene's camera that follows the present one, or comes before it; round and round.
void nextCamera(Session& session, bool before);

}  // namespace conelight::program
