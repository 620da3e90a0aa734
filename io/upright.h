// SPDX-License-Identifier: MIT
// Which way up a model stands, where its file does not say.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "conelight/scene.h"
#include "io/scene_file.h"

namespace conelight::io {

// Turns a scene that was read from `path` so that the axis `up` becomes +y. UpAxis::Auto turns formats that name no
// axis, by the three functions below, and adds a note when it does. `path` is opened for its comments.
void takeUpAxis(Scene& scene, const std::filesystem::path& path, UpAxis up);

// For formats whose models mostly stand along z, as STL: whether this one does. A model stands on what lies in the
// lowest 3 % of its height. It stands along y only when its ends there span at least twice as large a part of the
// outline as along z.
bool standsAlongZ(const Scene& scene);

// For formats that are y-up by custom, as OBJ and PLY: whether this one lies on a ground at its least z. Flat
// triangles there cover half of the outline and reach beyond what rises from them, and along y it stands on less
// than half as much.
bool hasGroundAcrossZ(const Scene& scene);

// The axis that comments at the beginning of a file name, in words ("z-up", "up axis: y") or by an exporter that
// always writes the same one; Auto: none. `extension` in lower case with its dot.
UpAxis upAxisOfComments(std::string_view head, const std::string& extension);

}  // namespace conelight::io
