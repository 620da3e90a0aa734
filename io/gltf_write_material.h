// SPDX-License-Identifier: MIT
// Materials and textures of a glTF file that is being written. Private to this room.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "conelight/scene.h"
#include "io/gltf_write_buffer.h"

namespace conelight::io {

// Numbers of a vector as JSON has them.
nlohmann::ordered_json listOf(const glm::vec3& v);
nlohmann::ordered_json listOf(const glm::vec4& v);
nlohmann::ordered_json listOf(const glm::mat4& m);  // column by column

// Fills root["images"], ["samplers"], ["textures"]; texture i of the scene is texture i of the file.
void writeGltfTextures(nlohmann::ordered_json& root, GltfBuffer& buffer, const Scene& scene);

// Appends the material to root["materials"]; notes the extensions it uses.
void writeGltfMaterial(nlohmann::ordered_json& root, const Material& material,
                       std::set<std::string>& extensions);

}  // namespace conelight::io
