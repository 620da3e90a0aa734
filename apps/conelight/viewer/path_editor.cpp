// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/key_strip.h"
#include "viewer/panels.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr int kMostSamples = 1 << 20;  // as `conelight render --spp`

bool button(const char* label, const char* place, const char* help) {
    const bool pressed = ImGui::Button(label);
    notePlace(place);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return pressed;
}

}  // namespace

void pathEditor(Session& session, KeyStrip& strip, const FilmNumbers& film, const RunLine& run,
                const std::function<void(FilePurpose)>& ask) {
    const CameraPath& path = session.cameraPath();
    ImGui::Separator();
    const std::string count =
        path.empty() ? "no key frames yet"
                     : fmt::format("{} key frame{}, {:g} s", path.keys().size(),
                                   path.keys().size() == 1 ? "" : "s", path.end() - path.start());
    ImGui::TextDisabled("%s", count.c_str());
    strip.show(session, run);
    if (button("add key", "path:add", "this view becomes a key frame, 1 s after the last")) run("path add");
    if (!path.empty()) {
        ImGui::SameLine();
        // At once: commands wait for the end of the flight.
        if (session.playing() && button("stop", "path:stop", "stay here")) session.stopPlaying();
        if (!session.playing() && button("play", "path:play", "fly along the key frames")) run("path play");
        ImGui::SameLine();
        if (button("clear", "path:clear", "no key frames")) run("path clear");
    }
    if (button("load...", "path:load", "key frames from a file")) ask(FilePurpose::LoadPath);
    if (!path.empty()) {
        ImGui::SameLine();
        if (button("save...", "path:save", "key frames to a file")) ask(FilePurpose::SavePath);
    }
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    ImGui::DragInt("frames of a film", &film.frames, 1, 2, 100000);
    notePlace("film frames");
    film.frames = std::clamp(film.frames, 2, 100000);
    if (session.mode() == "reference") {
        ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
        ImGui::DragInt("samples a frame", &film.samples, 1, 1, kMostSamples);
        notePlace("film samples");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("paths per pixel of each frame of a film; four times as many halve the noise");
        film.samples = std::clamp(film.samples, 1, kMostSamples);
    }
    if (!path.empty()) {
        if (button("record path...", "path:record", "a film of the flight along the key frames"))
            ask(FilePurpose::RecordPath);
        if (ImGui::GetContentRegionAvail().x > 15 * ImGui::GetFontSize()) ImGui::SameLine();
    }
    if (button("record turn...", "path:turn", "a film of a turn round the target"))
        ask(FilePurpose::RecordTurntable);
}

}  // namespace conelight::program
