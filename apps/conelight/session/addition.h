// SPDX-License-Identifier: MIT
// Shapes and scenes that are added to a session's: built or read, placed on what is below the middle of the view,
// appended as one step of undo, and selected.
#pragma once

#include <string>
#include <vector>

#include "session/picker.h"
#include "session/session.h"

namespace conelight::program {

// plane, box, sphere, cylinder, torus.
const std::vector<std::string>& shapeKinds();
// One object of that kind and size, m, that stands on y = 0 about the origin.
Scene shapeOf(const std::string& kind, float size);

// Where what is added stands, and about how large a shape is to be for the view: 1, 2 or 5 times a power of ten, m.
struct AddedPlace {
    glm::vec3 foot{0};
    float size = 1;
};
// On the surface in the middle of the view where that is level, else on what is below; where nothing is, in the
// middle of what the camera turns about.
AddedPlace placeInView(const Session& session, Picker& picker);

// Appends the meshes, materials, textures, objects and lights of `part`, moved so that its box stands on `foot`.
// Names that are taken get a number.
void addToScene(Session& session, Scene part, const glm::vec3& foot, const std::string& label);

// The objects and lights of a file, for addImported: any thread. Throws what io::loadScene throws, and Error(Usage) for a
// file that has neither. Several are a group with the file's name.
Scene readPart(const std::string& file, const OpenHow& how, const io::LoadOptions& options = {});
// Where the view looks; selected. Returns what there is to say.
std::vector<std::string> addImported(Session& session, Picker& picker, Scene part, const std::string& file);

}  // namespace conelight::program
