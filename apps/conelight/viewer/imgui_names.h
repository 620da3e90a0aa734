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

#if IMGUI_VERSION_NUM >= 18900
constexpr ImGuiKey kModCtrl = static_cast<ImGuiKey>(ImGuiMod_Ctrl),
                   kModShift = static_cast<ImGuiKey>(ImGuiMod_Shift),
                   kModAlt = static_cast<ImGuiKey>(ImGuiMod_Alt),
                   kModSuper = static_cast<ImGuiKey>(ImGuiMod_Super);
#elif IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey kModCtrl = ImGuiKey_ModCtrl, kModShift = ImGuiKey_ModShift, kModAlt = ImGuiKey_ModAlt,
                   kModSuper = ImGuiKey_ModSuper;
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
