// SPDX-License-Identifier: MIT
// The camera sees all of the selection, or of the scene: one step of undo.
#pragma once

#include <glm/glm.hpp>

#include "session/session.h"

namespace conelight::program {

Aabb selectedBounds(const Session& session);  // of the whole scene where nothing with a place is selected
float aspectOf(const glm::ivec2& pictureSize);
void focusOnSelection(Session& session, const glm::ivec2& pictureSize);

}  // namespace conelight::program
