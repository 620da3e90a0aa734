// SPDX-License-Identifier: MIT
// Meshes, materials and small scenes that tests put together: a quad, a box, a sphere, a closed room of one
// material. All are closed forms, so that what they show is known.
#pragma once

#include "conelight/scene.h"

namespace conelight::test {

// Lambert alone: no specular lobe. White unless said.
Material diffuseMaterial(const glm::vec3& albedo = glm::vec3(1), const glm::vec3& emission = glm::vec3(0));

// One quad (two triangles) with its normal, counter-clockwise from the side of cross(edgeU, edgeV).
Mesh quadMesh(const glm::vec3& origin, const glm::vec3& edgeU, const glm::vec3& edgeV);

// The box [-1, 1]^3 without normals: 8 corners, 12 triangles that face outwards.
Mesh boxMesh();

// A closed unit sphere about the origin with smooth normals, `columns` x `rows` quads.
Mesh sphereMesh(int columns, int rows);

// Adds the mesh with a material as an instance; returns the instance's index.
std::size_t addInstance(Scene& scene, Mesh mesh, const Material& material,
                        const glm::mat4& worldFromObject = glm::mat4(1));

// A closed box of edge 2 about the origin, six walls of one material that face inwards, one instance each;
// its camera is inside.
Scene closedBox(const Material& material);

}  // namespace conelight::test
