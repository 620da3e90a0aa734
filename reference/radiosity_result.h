// SPDX-License-Identifier: MIT
// Elements and the light at their vertices -> a Scene of unlit meshes (radiosity.h).
#pragma once

#include <vector>

#include "conelight/scene.h"
#include "reference/radiosity_mesh.h"
#include "reference/surface.h"

namespace conelight::reference {

// Part of the base colour that a surface reflects diffusely: 1 - metallic, less what its lobe takes, averaged
// over the directions to the eye (weighted by their cosine).
float diffusePart(const Surface& surface);

// `irradiance`: per vertex of the mesh.
Scene litScene(const Scene& scene, const ElementMesh& mesh, const std::vector<glm::vec3>& irradiance);

// As it is, over the same mesh.
BakedLight bakedLight(const Scene& scene, const ElementMesh& mesh, const std::vector<glm::vec3>& irradiance);

}  // namespace conelight::reference
