// SPDX-License-Identifier: MIT
// What editors of the selection share: a drag of a widget is one step of undo.
#pragma once

#include <imgui.h>

#include <string>

#include "session/session.h"
#include "viewer/widget_places.h"

namespace conelight::program {

// Of the widget before: it can be found by `where edit:NAME`, and the end of its drag ends a step of undo.
inline void seals(Session& session, const char* name) {
    notePlace(std::string("edit:") + name);
    if (ImGui::IsItemDeactivatedAfterEdit()) session.seal();
}

}  // namespace conelight::program
