// SPDX-License-Identifier: MIT
// Parts of the scenes of the kinds that people model: rods, wires, sheets, cups, leaves, boxes with chamfered
// edges. Internal to conelight_io.
#pragma once

#include "io/generated_trial_parts.h"

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace conelight::io::generated {

// Exporters make every material two-sided.
void makeTwoSided(Scene& scene);

int textured(Scene& scene, const char* name, Texture texture, float metres, glm::vec3 colour);

// Puts parts where the thing stands that they belong to.
struct Placer {
    Scene& scene;
    glm::mat4 worldFromThing{1.0f};
    Instance& put(Mesh mesh, std::string name, int material,
                  const glm::mat4& thingFromPart = glm::mat4(1)) const;
    Instance& put(Mesh mesh, std::string name, int material, glm::vec3 at) const;
    // One more instance of a mesh that is there.
    Instance& again(int mesh, std::string name, int material, const glm::mat4& thingFromPart) const;
    Placer at(const glm::mat4& thingFromPart) const { return {scene, worldFromThing * thingFromPart}; }
};

// Adds a mesh turned and moved.
void merge(Mesh& mesh, const Mesh& more, const glm::mat4& place = glm::mat4(1));
// A plane convex polygon whose front is on the side of `outward`; texture coordinates along the two axes that it
// faces least.
void appendPolygon(Mesh& mesh, std::vector<glm::vec3> corners, glm::vec3 outward);

// A closed round solid between two radii and heights.
Mesh cylinder(float radius, float bottom, float top, int around = 32, int pieces = 4);
// The same between two points.
Mesh rod(glm::vec3 from, glm::vec3 to, float radius, int around = 12);
// A round skin about a curve over [0,1], open at both ends. The curve never runs along `across`.
Mesh tube(const std::function<glm::vec3(float)>& middle, float radius, int along, int around = 12,
          glm::vec3 across = {0, 0, 1});
// A wire that hangs between two points, `sag` below their middle.
Mesh wire(glm::vec3 from, glm::vec3 to, float sag, float radius);
Mesh sheet(const std::function<glm::vec3(float u, float v)>& position, int nu, int nv, glm::vec2 metres);
// A box whose edges are cut off.
Mesh chamferedBox(const Aabb& box, float cut);
// A cup: outer wall, rim of `wall`, inner wall, bottom.
Mesh cup(float radius, float height, float wall, int around = 40);
// A hanging sheet of cloth, wavy along x.
Mesh curtain(float width, float height, float wave, int waves);
// Leaves about a centre: quads turned at random, more of them outside than inside.
Mesh leaves(glm::vec3 radii, int count, float size, std::uint32_t seed);

// [0,1), the same for the same three numbers.
float randomAt(std::uint32_t seed, int i, int what = 0);

}  // namespace conelight::io::generated
