// SPDX-License-Identifier: MIT
// Scene -> the thesis's text format, with this project's additions (lights, cameras, sky, settings; see
// docs/reference/thesis_format.md), and a folder NAME_meshes beside it with an .obj file per mesh, since the
// format itself holds none. Reading it back (scene.h) gives the scene again, but for what is
// returned, one line each: textures, vertex colours, spaces in names. Transforms with shear, which the format
// cannot say, are applied to a mesh of their own.
#pragma once

#include <string>
#include <vector>

#include "conelight/scene.h"

namespace conelight::thesis {

// Throws Error(Usage) for a file that is there already unless `force`; Error(Runtime) when one cannot be
// written.
std::vector<std::string> writeThesisScene(const std::string& path, const Scene& scene, bool force);

}  // namespace conelight::thesis
