// SPDX-License-Identifier: MIT
// Scene -> glTF 2.0: meshes, instances as nodes, metallic-roughness materials with the KHR extensions that
// io/gltf_*.cpp reads, textures as PNG, lights (KHR_lights_punctual), cameras. What glTF has no words for
// (rectangular lights, falloffs, Phong materials, flags of instances, settings) is kept in
// `extras.conelight`, which loadScene reads back and other programs ignore.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "conelight/scene.h"

namespace conelight::io {

// Light maps of instances: what of them a glTF file holds. Second coordinates become TEXCOORD_1; a node's
// `extras.lightmap` says which map, and uv' = offset + scale * uv.
struct GltfLightmaps {
    struct Place {
        int map = -1;  // -1: none
        glm::vec2 offset{0}, scale{1};
    };
    std::vector<std::vector<glm::vec2>> uvs;  // by mesh of the scene, then by vertex; empty: none
    std::vector<Place> instances;             // by instance
};

// `.glb`: one file; any other name: JSON with a NAME.bin beside it, both or neither. Replaces a file at
// `path`. Returns what other programs will not see, one line each. Throws Error(BadInput) as Scene::validate,
// Error(Usage) as refuseForeignBuffer, Error(Runtime) when a file cannot be written or exceeds 4 GiB (.glb).
std::vector<std::string> writeGltf(const std::filesystem::path& path, const Scene& scene,
                                   bool overwrite = false, const GltfLightmaps* lightmaps = nullptr);

// Throws Error(Usage) when the NAME.bin that writeGltf would write beside `path` is there and is not the one
// that a glTF file at `path` names; not with `overwrite`.
void refuseForeignBuffer(const std::filesystem::path& path, bool overwrite);

}  // namespace conelight::io
