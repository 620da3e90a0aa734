// SPDX-License-Identifier: MIT
// Small scenes and reductions of pictures for tests of the path tracer: what a matt plane shows is the
// irradiance on it.
#pragma once

#include "conelight/scene.h"
#include "reference/path_tracer.h"

namespace conelight::test {

// Lambert alone: no specular lobe. White unless said.
Material mattMaterial(const glm::vec3& albedo = glm::vec3(1), const glm::vec3& emission = glm::vec3(0));

// A closed box of edge 2 about the origin, six walls of one material that face inwards, one instance each;
// its camera is inside.
Scene closedBox(const Material& material);

// A closed unit sphere about the origin with smooth normals, `columns` x `rows` quads.
Mesh sphereMesh(int columns, int rows);

// A camera that looks from `height` above straight down (-y) on a square of edge `width` about `point`.
Camera cameraAbove(const glm::vec3& point, float height, float width);

// Mean over all pixels and channels (alpha left out); NaN where one is not finite.
double meanOf(const Image& image);
glm::dvec3 meanColorOf(const Image& image);

// sqrt(mean (a - b)^2) / mean(b).
double relRmse(const Image& a, const Image& b);

}  // namespace conelight::test
