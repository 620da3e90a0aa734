// SPDX-License-Identifier: MIT
// Light maps: a scene -> irradiance in the texels of second texture coordinates, for hosts that show it as it is.
// What is baked, and the files: docs/guide/bake.md.
//
// A map holds what arrives at the front of surfaces: what the path tracer finds along rays from them, and on demand
// what lights and flat emissive quads send straight. Light of the sky and of other emitters is always in it.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "conelight/scene.h"
#include "reference/baked_picture.h"
#include "reference/lightmap_charts.h"
#include "reference/partial_bake.h"

namespace conelight::reference {

struct LightmapPlace {
    int map = -1;          // -1: the instance has no light map
    glm::ivec2 offset{0};  // of its mesh's rectangle, texels from the map's corner
};

// Instances of a mesh share its second coordinates, and each has a rectangle of its own.
struct LightmapLayout {
    float texel = 0;                    // m, at most
    std::vector<ChartedMesh> meshes;    // as the scene's; empty where no instance has a map
    std::vector<LightmapPlace> places;  // by instance
    std::vector<glm::ivec2> sizes;      // by map, texels
    std::size_t texels() const;         // of all maps
};

// Visible instances that reflect light diffusely have maps. Of instances of a mesh the largest has texels of
// `texel` m. Maps are at most `side` texels wide and high. Throws Error(Usage) for a texel that is not above 0, for
// a side below 16 or above 16384, and for a mesh that no map can hold; Error(BadInput) without any such instance.
LightmapLayout layOutLightmaps(const Scene& scene, float texel, int side);

struct LightmapSettings {
    int samples = 1024;       // paths of a texel; 16..2^20
    int bounces = -1;         // of indirect light, 1 or more; -1: all
    bool direct = false;      // also light that lights and flat emissive quads send straight
    bool directions = false;  // also where light comes from
    std::uint32_t seed = 1;
    int threads = 0;  // 0: all cores
};

// Row by row from the top.
struct Lightmap {
    glm::ivec2 size{0};
    std::vector<glm::vec3> irradiance;  // of indirect light, W/m^2
    std::vector<glm::vec3> direct;      // of direct light; empty where it was not asked for
    // Mean direction of the light that arrives, in the world, weighted by what it gives: its length tells how
    // much of it comes from there. 0 where it was not asked for.
    std::vector<glm::vec3> direction;
};

// `onProgress(done)`, done in [0,1], is called now and then; when it returns false, no maps are returned. The
// same bits for the same seed, whatever the number of threads. `partial`: texels that are done are taken from it, and
// others put there.
std::vector<Lightmap> bakeLightmaps(const Scene& scene, const LightmapLayout& layout,
                                    const LightmapSettings& settings,
                                    const std::function<bool(double)>& onProgress = {},
                                    PartialBake* partial = nullptr);

// What a host's shader reads of indirect light: bilinear. With `directional`, the mean direction turns the light to a
// normal that differs from the vertices' (half Lambert, as Valve 2006, "Shading in Valve's Source Engine").
glm::vec3 irradianceAt(const Scene& scene, const LightmapLayout& layout, const std::vector<Lightmap>& maps,
                       const RayHit& hit, const glm::vec3& shadingNormal, bool directional);

BakedPicture drawWithLightmaps(const Scene& scene, const LightmapLayout& layout,
                               const std::vector<Lightmap>& maps, bool directional, const Camera& camera,
                               const PathTracedPicture& truth);

}  // namespace conelight::reference
