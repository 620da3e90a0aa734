// SPDX-License-Identifier: MIT
// Light maps as files: a scene with second texture coordinates, pictures, and a JSON that describes them. Layout:
// docs/guide/bake.md. This is a table of bytes; what the values mean is whoever bakes' business.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "conelight/scene.h"
#include "io/gltf_write.h"

namespace conelight::io {

struct LightmapPicture {
    glm::ivec2 size{0};
    std::vector<glm::vec3> irradiance;  // row by row from the top
    std::vector<glm::vec3> direction;   // as irradiance; empty: no such picture
};

struct LightmapFiles {
    std::string scene;  // as it was named
    float texel = 0;    // m
    int samples = 0;
    std::uint32_t seed = 0;
    bool direct = false;  // direct light is in it
    std::vector<LightmapPicture> maps;
    GltfLightmaps places;
};

// FOLDER/scene.glb, lightmap_N.exr, .hdr and .png, lightmap_N_direction.exr; lightmaps.json last. `scene` is what
// goes into scene.glb. Returns what other programs will not see of it. Throws Error(Usage) when one of the files is
// there and `overwrite` is not given, Error(Runtime) that names the path.
std::vector<std::string> writeLightmaps(const std::filesystem::path& folder, const Scene& scene,
                                        const LightmapFiles& files, bool overwrite);
// Before long work: throws what writeLightmaps would.
void checkLightmapFolder(const std::filesystem::path& folder, std::size_t maps, bool directional,
                         bool overwrite);

}  // namespace conelight::io
