// SPDX-License-Identifier: MIT
// Changes of a material that keep its two models, Phong's and the metallic-roughness one, at one look
// (docs/theory/1_scene.md, "Two material models").
#pragma once

#include <set>
#include <string>
#include <vector>

#include "session/session.h"

namespace conelight::program {

// Gives the material these Phong values; what its other model derived from the old ones is derived from the
// new, what was set by itself stays.
void setPhong(Material& material, const PhongMaterial& phong);
// Gives it this albedo (or metal's colour) in both models.
void setColor(Material& material, const glm::vec3& color);

// Names of up to three objects that use one of the materials and are not called `name`; empty: none.
std::string othersWith(const Session& session, const std::set<std::size_t>& materials,
                       const std::string& name);

// How many objects have each material.
std::vector<std::size_t> usesOfMaterials(const Scene& scene);
// Objects whose material others have, too, get a copy of it: those that are named together and share one get one
// together. One step of undo; returns how many copies were made.
int makeMaterialsSingle(Session& session, const std::vector<std::size_t>& objects);

}  // namespace conelight::program
