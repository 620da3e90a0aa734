// SPDX-License-Identifier: MIT
// What the files of the generated scenes share: the values asked for, helpers to fill the tables of a Scene,
// and one builder per scene. For conelight_io and for guests (modes/) with scenes of their own; the public face is
// generated.h.
//
// Albedos are linear Rec.709, measured-like values for paint and stone, never above 0.8. Light is chosen by
// eye (2026) such that the first camera's picture at exposure 1 has a mean of 0.2 to 0.4 after tone mapping.
#pragma once

#include "conelight/scene.h"
#include "io/generated.h"
#include "io/generated_shapes.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace conelight::io::generated {

// Values of a scene's parameters, complete and within their ranges.
class Values {
  public:
    void set(std::string_view name, double value);
    double operator[](std::string_view name) const;  // asserts that the parameter exists

  private:
    std::vector<std::pair<std::string_view, double>> values_;
};

// Reads "key=value&key=value" over the defaults of `info`; throws Error(Usage) that starts with "builtin:SPEC".
Values parseValues(const std::string& spec, const GeneratedSceneInfo& info, std::string_view text);

// Paint: no specular lobe at all, so that a path tracer sees exactly albedo / pi.
Material matte(std::string name, glm::vec3 albedo);
// A dielectric with the default F0 of 0.04.
Material glossy(std::string name, glm::vec3 albedo, float roughness);
Material metal(std::string name, glm::vec3 f0, float roughness);
Material emitter(std::string name, glm::vec3 radiance);

// Each returns the index of what was added.
int add(Scene& scene, Material material);
int add(Scene& scene, Mesh mesh);
int add(Scene& scene, Texture texture);
// The texture once per `metres`, for texture coordinates in metres.
TextureRef repeat(int texture, float metres);
Instance& place(Scene& scene, int mesh, int material, std::string name = {},
                const glm::mat4& worldFromObject = glm::mat4(1));
// A mesh with one instance, both called `name`.
Instance& addPart(Scene& scene, Mesh mesh, std::string name, int material);

Mesh quad(glm::vec3 origin, glm::vec3 edgeU, glm::vec3 edgeV);
Mesh box(const Aabb& bounds, bool inward = false);

glm::mat4 translation(glm::vec3 offset);
glm::mat4 turnAboutY(float angle);  // rad, counter-clockwise seen from above

Camera camera(std::string name, glm::vec3 eye, glm::vec3 target, float fovYDeg);
Light pointLight(std::string name, glm::vec3 position, glm::vec3 intensity);
Light sunLight(std::string name, glm::vec3 direction, glm::vec3 irradiance);

Scene buildCornell(const Values& values);
Scene buildCornellPoint(const Values& values);
Scene buildFurnace(const Values& values);
Scene buildLeak(const Values& values);
Scene buildSunroom(const Values& values);
Scene buildCorridor(const Values& values);
Scene buildAtrium(const Values& values);
Scene buildGlossy(const Values& values);
Scene buildSpheres(const Values& values);
Scene buildColours(const Values& values);
Scene buildLanterns(const Values& values);
Scene buildVases(const Values& values);
Scene buildStudy(const Values& values);
Scene buildClutter(const Values& values);
Scene buildTunnel(const Values& values);
Scene buildYard(const Values& values);
Scene buildLobby(const Values& values);
Scene buildMirrors(const Values& values);
Scene buildScreens(const Values& values);
Scene buildLoft(const Values& values);
Scene buildLounge(const Values& values);
Scene buildNeon(const Values& values);
Scene buildLibrary(const Values& values);
Scene buildHeap(const Values& values);
Scene buildBends(const Values& values);
Scene buildParlour(const Values& values);
Scene buildGarden(const Values& values);
Scene buildStreet(const Values& values);
Scene buildCounter(const Values& values);
Scene buildWorkshop(const Values& values);
Scene buildBathroom(const Values& values);
Scene buildGreenhouse(const Values& values);
Scene buildCafe(const Values& values);
Scene buildAttic(const Values& values);
Scene buildCellar(const Values& values);
Scene buildGlass(const Values& values);
Scene buildConservatory(const Values& values);
Scene buildGlassware(const Values& values);
Scene buildVeils(const Values& values);
Scene buildCoats(const Values& values);
Scene buildMirrorHall(const Values& values);
Scene buildPlain(const Values& values);
Scene buildLamps(const Values& values);
Scene buildTown(const Values& values);

}  // namespace conelight::io::generated
