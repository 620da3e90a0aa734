// SPDX-License-Identifier: MIT
// glTF 2.0 and GLB -> Scene. Private to this room.
//
// Read: nodes, default scene, meshes (all modes; points and lines left out with a note), sparse and quantized
// accessors, skins and morph targets, metallic-roughness materials, samplers, PNG/JPEG images in
// files, buffers and data URIs, cameras, animations of nodes, `extras.sky = [r,g,b]` of the scene,
// and the extensions
// KHR_lights_punctual, KHR_materials_{emissive_strength,ior,specular,unlit,pbrSpecularGlossiness},
// KHR_texture_transform, KHR_mesh_quantization, EXT_mesh_gpu_instancing.
// A required extension beyond these is an error; a used one a note.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "conelight/scene.h"
#include "io/animation.h"
#include "io/scene_file.h"

namespace conelight::io {

// Thrown for files of version 1.x, which have another structure.
struct GltfVersion1 : std::runtime_error {
    GltfVersion1() : std::runtime_error("glTF 1.0") {}
};

// With `animation`: its movement, too.
// Throws Error(BadInput) "FILE: JSON.PATH: what is wrong", or GltfVersion1.
Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options,
               SceneAnimation* animation = nullptr);

}  // namespace conelight::io
