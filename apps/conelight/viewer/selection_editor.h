// SPDX-License-Identifier: MIT
// The editor of what is selected: an object's place and flags, a material, a light. Of several things the last one
// chosen, and flags of all objects.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/light_units.h"
#include "session/session.h"
#include "viewer/panels.h"
#include "viewer/texture_gallery.h"

namespace conelight::program {

// How the strength and colour of lights are shown.
struct LightView {
    LightUnit unit = LightUnit::Radiant;
    bool byTemperature = false;
    // The field of the profile: its text, of which file and light it is, and why that could not be read.
    std::string profile, profileOf, problem;
    std::size_t light = 0;
};

class SelectionEditor {
  public:
    // Into the current ImGui window.
    void show(Session& session, const RunLine& run);

  private:
    void editInstance(Session& session, std::size_t index, const RunLine& run);
    void showMaterialOf(Session& session, const Instance& instance, const RunLine& run);
    void editMaterial(Session& session, std::size_t index);
    // How many objects have the material.
    std::size_t usesOf(const Session& session, std::size_t material);

    LightView lights_;
    TextureGallery textures_;
    std::vector<std::size_t> uses_;
    std::uint64_t usesRevision_ = 0;
};

void editLight(Session& session, std::size_t index, LightView& view);

}  // namespace conelight::program
