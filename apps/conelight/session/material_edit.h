// SPDX-License-Identifier: MIT
// Changes of a material that keep its two models, Phong's and the metallic-roughness one, at one look
// (docs/theory/1_scene.md, "Two material models").
#pragma once

#include <set>
#include <string>

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

}  // namespace conelight::program
