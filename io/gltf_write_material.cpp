// SPDX-License-Identifier: MIT
#include "io/gltf_write_material.h"

#include <algorithm>
#include <cmath>

#include "io/picture_codec.h"

namespace conelight::io {
namespace {

using Json = nlohmann::ordered_json;

int wrapOf(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Repeat:
            return 10497;
        case TextureWrap::Clamp:
            return 33071;
        case TextureWrap::Mirror:
            return 33648;
    }
    return 10497;
}

// The transform as KHR_texture_transform, uv' = move * turn * stretch * uv. A shear has no place there; only
// scaled and turned ones come out of files.
Json transformOf(const glm::mat3& m) {
    const float scaleU = std::hypot(m[0][0], m[0][1]);
    const float angle = scaleU > 0 ? std::atan2(-m[0][1], m[0][0]) : 0.0f;
    const float scaleV = std::sin(angle) * m[1][0] + std::cos(angle) * m[1][1];
    return {{"offset", {m[2][0], m[2][1]}}, {"rotation", angle}, {"scale", {scaleU, scaleV}}};
}

Json textureInfo(const TextureRef& use, std::set<std::string>& extensions) {
    Json info = {{"index", use.texture}};
    if (use.uvFromUv != glm::mat3(1.0f)) {
        info["extensions"]["KHR_texture_transform"] = transformOf(use.uvFromUv);
        extensions.insert("KHR_texture_transform");
    }
    return info;
}

template <class Extension>
void writeLayers(const Material& m, std::set<std::string>& extensions, const Extension& extension) {
    const auto texture = [&](Json& to, const char* name, const TextureRef& use) {
        if (use.used()) to[name] = textureInfo(use, extensions);
    };
    if (m.coat > 0 || m.coatRoughness > 0 || m.coatTexture.used() || m.coatRoughnessTexture.used() ||
        m.coatNormalTexture.used()) {
        Json coat = {{"clearcoatFactor", m.coat}, {"clearcoatRoughnessFactor", m.coatRoughness}};
        texture(coat, "clearcoatTexture", m.coatTexture);
        texture(coat, "clearcoatRoughnessTexture", m.coatRoughnessTexture);
        texture(coat, "clearcoatNormalTexture", m.coatNormalTexture);
        if (m.coatNormalTexture.used()) coat["clearcoatNormalTexture"]["scale"] = m.coatNormalScale;
        extension("KHR_materials_clearcoat", coat);
    }
    if (m.sheenColor != glm::vec3(0) || m.sheenRoughness > 0 || m.sheenColorTexture.used() ||
        m.sheenRoughnessTexture.used()) {
        Json sheen = {{"sheenColorFactor", listOf(m.sheenColor)}, {"sheenRoughnessFactor", m.sheenRoughness}};
        texture(sheen, "sheenColorTexture", m.sheenColorTexture);
        texture(sheen, "sheenRoughnessTexture", m.sheenRoughnessTexture);
        extension("KHR_materials_sheen", sheen);
    }
}

void writeExtensions(Json& to, const Material& m, float strength, std::set<std::string>& extensions) {
    const auto extension = [&](const char* name, Json value) {
        to["extensions"][name] = std::move(value);
        extensions.insert(name);
    };
    if (strength > 1) extension("KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
    if (m.unlit) extension("KHR_materials_unlit", Json::object());
    if (m.ior != 1.5f) extension("KHR_materials_ior", {{"ior", m.ior}});
    if (m.specular != 1 || m.specularColor != glm::vec3(1) || m.specularTexture.used() ||
        m.specularColorTexture.used()) {
        Json specular = {{"specularFactor", m.specular}, {"specularColorFactor", listOf(m.specularColor)}};
        if (m.specularTexture.used())
            specular["specularTexture"] = textureInfo(m.specularTexture, extensions);
        if (m.specularColorTexture.used())
            specular["specularColorTexture"] = textureInfo(m.specularColorTexture, extensions);
        extension("KHR_materials_specular", specular);
    }
    if (m.transmission > 0 || m.transmissionTexture.used()) {
        Json transmission = {{"transmissionFactor", m.transmission}};
        if (m.transmissionTexture.used())
            transmission["transmissionTexture"] = textureInfo(m.transmissionTexture, extensions);
        extension("KHR_materials_transmission", transmission);
    }
    if (m.thickness > 0 || m.attenuationColor != glm::vec3(1) || m.attenuationDistance > 0) {
        Json volume = {{"thicknessFactor", m.thickness}, {"attenuationColor", listOf(m.attenuationColor)}};
        if (m.attenuationDistance > 0) volume["attenuationDistance"] = m.attenuationDistance;
        extension("KHR_materials_volume", volume);
    }
    writeLayers(m, extensions, extension);
}

}  // namespace

nlohmann::ordered_json listOf(const glm::vec3& v) { return nlohmann::ordered_json::array({v.x, v.y, v.z}); }
nlohmann::ordered_json listOf(const glm::vec4& v) {
    return nlohmann::ordered_json::array({v.x, v.y, v.z, v.w});
}
nlohmann::ordered_json listOf(const glm::mat4& m) {
    Json list = Json::array();
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) list.push_back(m[c][r]);
    return list;
}

void writeGltfTextures(Json& root, GltfBuffer& buffer, const Scene& scene) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& texture = scene.textures[i];
        const std::vector<std::uint8_t> png = encodePng({texture.width, texture.height, 4, texture.rgba, {}});
        // First the bytes: they may move what `root` refers to.
        const int view = buffer.view(png.data(), png.size());
        root["images"].push_back({{"name", texture.name}, {"mimeType", "image/png"}, {"bufferView", view}});
        const bool nearest = texture.filter == TextureFilter::Nearest;
        root["samplers"].push_back({{"magFilter", nearest ? 9728 : 9729},
                                    {"minFilter", nearest ? 9728 : 9987},
                                    {"wrapS", wrapOf(texture.wrapU)},
                                    {"wrapT", wrapOf(texture.wrapV)}});
        root["textures"].push_back({{"source", i}, {"sampler", i}});
    }
}

void writeGltfMaterial(Json& root, const Material& m, std::set<std::string>& extensions) {
    Json to = {{"name", m.name}};
    Json& pbr = to["pbrMetallicRoughness"];
    pbr = {{"baseColorFactor", listOf(glm::clamp(m.baseColor, 0.0f, 1.0f))},
           {"metallicFactor", m.metallic},
           {"roughnessFactor", m.roughness}};
    if (m.baseColorTexture.used()) pbr["baseColorTexture"] = textureInfo(m.baseColorTexture, extensions);
    if (m.metallicRoughnessTexture.used())
        pbr["metallicRoughnessTexture"] = textureInfo(m.metallicRoughnessTexture, extensions);
    if (m.normalTexture.used()) {
        to["normalTexture"] = textureInfo(m.normalTexture, extensions);
        to["normalTexture"]["scale"] = m.normalScale;
    }
    // Factors end at 1; what is above goes into the strength.
    const float strength = std::max({m.emission.r, m.emission.g, m.emission.b, 1.0f});
    if (m.emission != glm::vec3(0)) to["emissiveFactor"] = listOf(m.emission / strength);
    if (m.emissiveTexture.used()) to["emissiveTexture"] = textureInfo(m.emissiveTexture, extensions);
    if (m.alphaMode == AlphaMode::Mask) {
        to["alphaMode"] = "MASK";
        to["alphaCutoff"] = m.alphaCutoff;
    } else if (m.alphaMode == AlphaMode::Blend) {
        to["alphaMode"] = "BLEND";
    }
    if (m.doubleSided) to["doubleSided"] = true;
    writeExtensions(to, m, strength, extensions);
    if (m.phong)
        to["extras"]["conelight"]["phong"] = {{"color", listOf(m.phong->color)},
                                              {"shininess", m.phong->shininess},
                                              {"ambient", m.phong->ambientStrength},
                                              {"diffuse", m.phong->diffuseStrength},
                                              {"specular", m.phong->specularStrength}};
    root["materials"].push_back(to);
}

}  // namespace conelight::io
