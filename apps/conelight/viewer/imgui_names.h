// SPDX-License-Identifier: MIT
// Names that Dear ImGui changed between 1.86 (Debian 12) and what is newest, by the version it is built with.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace conelight::program {

#if IMGUI_VERSION_NUM >= 19090
constexpr ImGuiCol kColTabShown = ImGuiCol_TabSelected;
#else
constexpr ImGuiCol kColTabShown = ImGuiCol_TabActive;
#endif

#if IMGUI_VERSION_NUM >= 19100
constexpr ImGuiSelectableFlags kKeepPopup = ImGuiSelectableFlags_NoAutoClosePopups;
#else
constexpr ImGuiSelectableFlags kKeepPopup = ImGuiSelectableFlags_DontClosePopups;
#endif

// Of the window's context: an integer or a pointer, by ImGui's version.
inline ImTextureID textureId(std::uint32_t texture) {
    return (ImTextureID)(static_cast<std::uintptr_t>(texture));
}

inline bool escapePressed() {
#if IMGUI_VERSION_NUM >= 18700
    return ImGui::IsKeyPressed(ImGuiKey_Escape);
#else
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
#endif
}

}  // namespace conelight::program
