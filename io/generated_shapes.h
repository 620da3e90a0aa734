// SPDX-License-Identifier: MIT
// Shapes of the generated scenes: quads, boxes, rectilinear solids, and smooth surfaces given as
// position(u,v). A Patch is a surface that is not tessellated yet: its triangle count is known before any
// vertex is computed, which lets a scene be planned for a triangle budget. Normals of patches come from
// central differences. Winding: counter-clockwise seen from the side the normals point to. Texture
// coordinates are metres unless said otherwise; a material scales them (TextureRef::uvFromUv).
#pragma once

#include "conelight/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace conelight::io::shapes {

// ---- Flat things ----------------------------------------------------------------------------------------

// The parallelogram origin, +edgeU, +edgeU+edgeV, +edgeV; its front is the side of cross(edgeU, edgeV).
void appendQuad(Mesh& mesh, glm::vec3 origin, glm::vec3 edgeU, glm::vec3 edgeV,
                glm::vec2 uvOrigin = glm::vec2(0));

// Six outward (or inward) faces of the axis-aligned box, each with its own vertices.
void appendBox(Mesh& mesh, const Aabb& box, bool inward = false);

// The convex hexahedron with the corners of a sheared box: corner bits x=1, y=2, z=4. Faces outward.
void appendHexahedron(Mesh& mesh, const std::array<glm::vec3, 8>& corners);

// A frame: the rectangle (origin, edgeU, edgeV) less a smaller one given by fractions [lo, hi] of the edges.
// Four trapezoids that share their corners, so that a quad in the hole leaves no crack and no T-junction.
void appendFrame(Mesh& mesh, glm::vec3 origin, glm::vec3 edgeU, glm::vec3 edgeV, glm::vec2 lo, glm::vec2 hi);

// Walls of a building on a rectilinear lattice. Cell (i,j,k) lies between planes[0][i] and planes[0][i+1],
// and so on; everything outside the lattice is empty. Every face between a solid and an empty cell goes to
// the mesh `part(centre, normal)` (an index below `parts`). The union of the parts is closed, and conforming:
// no T-junctions.
struct CellSolid {
    std::array<std::vector<float>, 3> planes;
    std::function<bool(glm::vec3 centre)> solid;
    std::function<int(glm::vec3 centre, glm::vec3 normal)> part;
};
std::vector<Mesh> buildCells(const CellSolid& cells, int parts);

// ---- Smooth things --------------------------------------------------------------------------------------

// A surface over (u,v) in [0,1]^2 and the grid it will be cut into. `position` must be defined slightly
// outside of the unit square. The front is the side of cross(dp/du, dp/dv), or the other one if `flip`.
struct Patch {
    int nu = 1;
    int nv = 1;
    std::function<glm::vec3(float u, float v)> position;
    glm::vec2 uvScale{1.0f};  // uv = uvOffset + uvScale * (u, 1 - v): texture rows run down from v = 1
    glm::vec2 uvOffset{0.0f};
    std::function<glm::vec2(glm::vec3 position)> uvOf;  // if set: the uv instead, for flat faces cut oddly
    bool flip = false;
    std::size_t triangleCount() const { return 2 * std::size_t(nu) * std::size_t(nv); }
};

// Appends the grid. Triangles without area (at the poles of a sphere) are left out.
void appendPatch(Mesh& mesh, const Patch& patch);

// A plane curve over t in [0,1] with the number of pieces to cut it into.
struct Curve {
    int n = 1;
    std::function<glm::vec2(float t)> at;
    float length() const;  // of the polyline through 17 points
};
Curve line(glm::vec2 from, glm::vec2 to, int n = 1);
Curve arc(glm::vec2 centre, glm::vec2 radii, float fromAngle, float toAngle,
          int n);  // angles in rad, from +x

// Turns (radius, height) curves about the y axis. With a profile that runs from the bottom's centre outward
// and up, the front is outside. `around` pieces; curves keep their creases. `uvRadius` sets metres per turn.
std::vector<Patch> lathe(const std::vector<Curve>& profile, int around, float uvRadius);

// Moves curves given in (out, up) straight from `from` to `to`; `out` is a unit vector, up is +y. With a
// profile that runs upward on the out side the front is outside if (to - from) x up points along `out`.
// Mitres shift the ends by out-coordinate times the mitre (1: a 45 degree outer corner, -1: an inner one).
std::vector<Patch> extrude(const std::vector<Curve>& profile, glm::vec3 from, glm::vec3 to, glm::vec3 out,
                           float mitreFrom, float mitreTo);

Patch uvSphere(glm::vec3 centre, glm::vec3 radii, int around, int down);

// Fills `tangents` from positions, normals and uvs: tangent along +u, w such that the bitangent
// w * cross(normal, tangent) points to the texture's upper rows (-v), as normal maps expect.
void computeTangents(Mesh& mesh);

// ---- Numbers without a generator's state ----------------------------------------------------------------

std::uint32_t hash(std::uint32_t x);  // a bijection with good avalanche
std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z = 0);
float unitFloat(std::uint32_t h);  // [0,1), 24 bits

}  // namespace conelight::io::shapes
