// SPDX-License-Identifier: MIT
// Clips: choose, play, scrub.
#include <imgui.h>

#include <algorithm>

#include "viewer/panels.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

std::size_t chosen(const Session& session) {
    std::size_t now = session.clipState().clip;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##clip", session.clips()[now].name.c_str())) {
        for (std::size_t i = 0; i < session.clips().size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(session.clips()[i].name.c_str(), i == session.clipState().clip)) now = i;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    notePlace("clip:choose");
    return now;
}

}  // namespace

void clipEditor(Session& session) {
    if (!session.clipsFit()) {
        ImGui::TextWrapped("objects came or went: clips play again when the scene is opened anew");
        notePlace("clip:unfit");
        return;
    }
    const ClipState state = session.clipState();
    const std::size_t clip = chosen(session);
    if (clip != state.clip) state.playing ? session.playClip(clip) : session.poseClip(clip, 0);
    if (ImGui::Button(state.playing ? "hold" : "play"))
        state.playing ? session.stopClip() : session.playClip(clip);
    notePlace("clip:play");
    ImGui::SameLine();
    bool loops = state.loops;
    if (ImGui::Checkbox("loop", &loops)) session.setClipLoops(loops);
    notePlace("clip:loop");
    ImGui::SameLine();
    if (ImGui::Button("rest")) session.restClip();
    notePlace("clip:rest");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("as the scene was opened");
    float time = static_cast<float>(session.clipState().seconds);
    const float duration = std::max(session.clips()[session.clipState().clip].duration, 1e-3f);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##time", &time, 0, duration, "%.2f s")) {
        session.stopClip();
        session.poseClip(session.clipState().clip, time);
    }
    notePlace("clip:time");
}

}  // namespace conelight::program
