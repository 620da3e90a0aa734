// SPDX-License-Identifier: MIT
#include "io/gltf_extensions.h"

#include <array>

namespace conelight::io {

namespace {

using enum GltfSupport;

constexpr std::array kExtensions = {
    GltfExtension{"EXT_lights_ies", Read},
    GltfExtension{"EXT_lights_image_based", Read},
    GltfExtension{"EXT_mesh_gpu_instancing", Read},
    GltfExtension{"EXT_meshopt_compression", Read},
    GltfExtension{"EXT_texture_webp", Read},
    GltfExtension{"KHR_animation_pointer", Harmless},
    GltfExtension{"KHR_audio_emitter", Harmless},
    GltfExtension{"KHR_draco_mesh_compression", Read},
    GltfExtension{"KHR_lights_punctual", Read},
    GltfExtension{"KHR_materials_anisotropy", Fallback},
    GltfExtension{"KHR_materials_clearcoat", Read},
    GltfExtension{"KHR_materials_diffuse_transmission", Fallback},
    GltfExtension{"KHR_materials_dispersion", Fallback},
    GltfExtension{"KHR_materials_emissive_strength", Read},
    GltfExtension{"KHR_materials_ior", Read},
    GltfExtension{"KHR_materials_iridescence", Fallback},
    GltfExtension{"KHR_materials_pbrSpecularGlossiness", Read},
    GltfExtension{"KHR_materials_sheen", Read},
    GltfExtension{"KHR_materials_specular", Read},
    GltfExtension{"KHR_materials_transmission", Read},
    GltfExtension{"KHR_materials_unlit", Read},
    GltfExtension{"KHR_materials_variants", Fallback},
    GltfExtension{"KHR_materials_volume", Read},
    GltfExtension{"KHR_mesh_quantization", Read},
    GltfExtension{"KHR_node_visibility", Read},
    GltfExtension{"KHR_texture_basisu", Fallback},
    GltfExtension{"KHR_texture_transform", Read},
    GltfExtension{"KHR_xmp", Harmless},
    GltfExtension{"KHR_xmp_json_ld", Harmless},
    GltfExtension{"MSFT_texture_dds", Fallback},
    GltfExtension{"VRM", Harmless},
    GltfExtension{"VRMC_vrm", Harmless},
};

}  // namespace

std::span<const GltfExtension> gltfExtensions() { return kExtensions; }

GltfSupport supportOf(std::string_view name) {
    for (const GltfExtension& extension : kExtensions)
        if (extension.name == name) return extension.support;
    return None;
}

}  // namespace conelight::io
