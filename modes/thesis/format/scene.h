// SPDX-License-Identifier: MIT
// The thesis's scene text format -> Scene. Private to this room; the format is described in
// docs/reference/thesis_format.md.
#pragma once

#include <filesystem>

#include "conelight/scene.h"
#include "io/scene_file.h"

namespace conelight::thesis {

Scene loadThesisScene(const std::filesystem::path& path, const io::LoadOptions& options);

// The camera of the thesis's program: yaw -90 looks along -z, degrees.
Camera thesisCamera(const std::string& name, const glm::vec3& eye, float yawDeg, float pitchDeg);

// Edge 1, centred, 8 shared corners with diagonal normals (made unit here), 12 triangles.
Mesh thesisCube();

}  // namespace conelight::thesis
