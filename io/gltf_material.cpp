// SPDX-License-Identifier: MIT
// glTF materials -> Material. Metallic-roughness is ours already; KHR_materials_pbrSpecularGlossiness becomes
// a dielectric whose F0 is the specular colour (specularColor = specular / 0.04), roughness 1 - glossiness.
// Limits: one texture coordinate set per material (the base colour's); only PNG, JPEG and WebP pictures.
#include "io/gltf_material.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "io/picture_codec.h"

namespace conelight::io {

namespace {

TextureWrap wrapOf(const GltfValue& value) {
    switch (value.whole(10497)) {
        case 33071:
            return TextureWrap::Clamp;
        case 33648:
            return TextureWrap::Mirror;
        case 10497:
            return TextureWrap::Repeat;
        default:
            value.fail("unknown wrap mode");
    }
}

bool isKtx2(const Bytes& file) {
    constexpr std::string_view kStart = "\xABKTX 20\xBB";
    return file.size() > kStart.size() &&
           std::equal(kStart.begin(), kStart.end(), file.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

glm::vec3 positive(const glm::vec3& v) { return glm::max(v, glm::vec3(0)); }
glm::vec4 unit(const glm::vec4& v) { return glm::clamp(v, 0.0f, 1.0f); }

// uv' = T R S uv. The rotation's sense is the one of the extension's test model (TextureTransformTest):
// positive angles turn the picture clockwise on the screen.
glm::mat3 transformOf(const GltfValue& extension) {
    const glm::vec2 offset = extension["offset"].vector<2>(glm::vec2(0));
    const glm::vec2 scale = extension["scale"].vector<2>(glm::vec2(1));
    const float angle = extension["rotation"].number(0.0f);
    const float c = std::cos(angle), s = std::sin(angle);
    const glm::mat3 move(1, 0, 0, 0, 1, 0, offset.x, offset.y, 1);
    const glm::mat3 turn(c, -s, 0, s, c, 0, 0, 0, 1);
    const glm::mat3 stretch(scale.x, 0, 0, 0, scale.y, 0, 0, 0, 1);
    return move * turn * stretch;
}

}  // namespace

GltfMaterials::GltfMaterials(GltfFile& file, Scene& scene, const LoadOptions& options)
    : file_(file), scene_(scene), options_(options), budget_(options.maxTexels) {
    const GltfValue materials = file_.array("materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        uvSet_ = 0;
        uvSetKnown_ = uvSetMixed_ = false;
        scene_.materials.push_back(convert(materials[i]));
        uvSets_.push_back(uvSet_);
        if (uvSetMixed_)
            scene_.notes.push_back(fmt::format(
                "material {}: its textures use different texture coordinates; set {} is used for all", i,
                uvSet_));
    }
}

int GltfMaterials::indexOf(const GltfValue& primitive) {
    if (const auto index = primitive["material"].index(file_.array("materials").size())) return int(*index);
    if (defaultMaterial_ < 0) {
        Material material;
        material.name = "default";
        material.baseColor = glm::vec4(1);
        material.metallic = 1.0f;
        defaultMaterial_ = int(scene_.materials.size());
        scene_.materials.push_back(material);
        uvSets_.push_back(0);
    }
    return defaultMaterial_;
}

const ByteImage* GltfMaterials::image(std::size_t index) {
    const auto known = images_.find(index);
    if (known != images_.end()) return known->second ? &*known->second : nullptr;
    options_.tell({"pictures", images_.size(), file_.array("images").size()});
    std::optional<ByteImage>& slot = images_[index];
    const GltfValue value = file_.array("images")[index];
    try {
        const Bytes bytes = file_.imageBytes(value);
        if (isKtx2(bytes))
            value.fail("is KTX2, which no library here decodes; PNG, JPEG or WebP would be right");
        if (!isPng(bytes) && !isJpeg(bytes) && !isWebp(bytes)) value.fail("is neither PNG, JPEG nor WebP");
        slot = budget_.decode(bytes, value.path(), scene_.notes);
    } catch (const Error& error) {
        // The file's name in front of the message would be repeated by the caller.
        std::string why = error.what();
        const std::size_t at = why.find(value.path());
        if (at != std::string::npos) why.erase(0, at);
        scene_.notes.push_back(oneLine(why) + "; picture left out");
    }
    return slot ? &*slot : nullptr;
}

int GltfMaterials::textureIndex(const GltfValue& texture, bool srgb) {
    const std::size_t images = file_.array("images").size();
    // The picture of an extension is the better one; KTX2 is named by image(), where there is no other.
    std::optional<std::size_t> source = texture.extension("EXT_texture_webp")["source"].index(images);
    if (!source) source = texture["source"].index(images);
    if (!source) source = texture.extension("KHR_texture_basisu")["source"].index(images);
    if (!source) {
        scene_.notes.push_back(texture.path() + ": has no picture that is read; left out");
        return -1;
    }
    TextureWrap wrapU = TextureWrap::Repeat, wrapV = TextureWrap::Repeat;
    TextureFilter filter = TextureFilter::Linear;
    if (const auto at = texture["sampler"].index(file_.array("samplers").size())) {
        const GltfValue sampler = file_.array("samplers")[*at];
        wrapU = wrapOf(sampler["wrapS"]);
        wrapV = wrapOf(sampler["wrapT"]);
        if (sampler["magFilter"].whole(9729) == 9728) filter = TextureFilter::Nearest;
    }
    const std::vector<std::size_t> key = {*source, std::size_t(srgb), std::size_t(wrapU), std::size_t(wrapV),
                                          std::size_t(filter)};
    const auto known = textures_.find(key);
    if (known != textures_.end()) return known->second;
    const ByteImage* picture = image(*source);
    if (picture == nullptr) return textures_[key] = -1;
    Texture out;
    const GltfValue value = file_.array("images")[*source];
    out.name = oneLine(value["name"].text(""));
    if (out.name.empty()) {
        const std::string uri = value["uri"].text("");
        out.name = uri.empty() || uri.rfind("data:", 0) == 0 ? fmt::format("image{}", *source)
                                                             : oneLine(percentDecoded(uri));
    }
    out.width = picture->width;
    out.height = picture->height;
    out.srgb = srgb;
    out.wrapU = wrapU;
    out.wrapV = wrapV;
    out.filter = filter;
    out.rgba = picture->pixels;
    scene_.textures.push_back(std::move(out));
    return textures_[key] = int(scene_.textures.size()) - 1;
}

TextureRef GltfMaterials::texture(const GltfValue& info, bool srgb) {
    TextureRef out;
    if (!info.exists()) return out;
    const std::optional<std::size_t> at = info["index"].index(file_.array("textures").size());
    if (!at) info["index"].fail("is missing");
    out.texture = textureIndex(file_.array("textures")[*at], srgb);
    std::uint64_t set = info["texCoord"].whole(0);
    const GltfValue transform = info.extension("KHR_texture_transform");
    if (transform.exists()) {
        out.uvFromUv = transformOf(transform);
        set = transform["texCoord"].whole(set);
    }
    if (!uvSetKnown_)
        uvSet_ = std::size_t(set);
    else if (set != uvSet_)
        uvSetMixed_ = true;
    uvSetKnown_ = true;
    return out;
}

void GltfMaterials::convertSpecularGlossiness(const GltfValue& from, Material& to) {
    constexpr float kDielectricF0 = 0.04f;  // of the default index of refraction, 1.5
    to.baseColor = unit(from["diffuseFactor"].vector<4>(glm::vec4(1)));
    to.baseColorTexture = texture(from["diffuseTexture"], true);
    to.metallic = 0.0f;
    to.specularColor = positive(from["specularFactor"].vector<3>(glm::vec3(1))) / kDielectricF0;
    const float glossiness = glm::clamp(from["glossinessFactor"].number(1.0f), 0.0f, 1.0f);
    to.roughness = 1.0f - glossiness;
    to.specularColorTexture = texture(from["specularGlossinessTexture"], true);
    if (!to.specularColorTexture.used()) return;

    // Alpha holds glossiness per texel: derive a roughness picture (green) for it.
    to.roughness = 1.0f;
    Texture roughness = scene_.textures[std::size_t(to.specularColorTexture.texture)];
    roughness.name += " (roughness)";
    roughness.srgb = false;
    for (std::size_t i = 0; i + 3 < roughness.rgba.size(); i += 4) {
        const float value = 1.0f - glossiness * float(roughness.rgba[i + 3]) / 255.0f;
        roughness.rgba[i] = 255;
        roughness.rgba[i + 1] = std::uint8_t(std::lround(value * 255.0f));
        roughness.rgba[i + 2] = 255;
        roughness.rgba[i + 3] = 255;
    }
    to.metallicRoughnessTexture = to.specularColorTexture;
    to.metallicRoughnessTexture.texture = int(scene_.textures.size());
    scene_.textures.push_back(std::move(roughness));
}

void GltfMaterials::convertGlass(const GltfValue& from, Material& to) {
    const GltfValue transmission = from.extension("KHR_materials_transmission");
    if (transmission.exists()) {
        to.transmission = glm::clamp(transmission["transmissionFactor"].number(0.0f), 0.0f, 1.0f);
        to.transmissionTexture = texture(transmission["transmissionTexture"], false);
    }
    const GltfValue volume = from.extension("KHR_materials_volume");
    if (!volume.exists()) return;
    // The thickness texture is for renderers that do not follow light through the mesh.
    to.thickness = std::max(volume["thicknessFactor"].number(0.0f), 0.0f);
    const glm::vec3 color = volume["attenuationColor"].vector<3>(glm::vec3(1));
    to.attenuationColor = glm::clamp(color, kLeastAttenuationColor, 1.0f);
    to.attenuationDistance = std::max(volume["attenuationDistance"].number(0.0f), 0.0f);
}

void GltfMaterials::convertLayers(const GltfValue& from, Material& to) {
    const auto share = [](const GltfValue& value) { return glm::clamp(value.number(0.0f), 0.0f, 1.0f); };
    const GltfValue coat = from.extension("KHR_materials_clearcoat");
    if (coat.exists()) {
        to.coat = share(coat["clearcoatFactor"]);
        to.coatRoughness = share(coat["clearcoatRoughnessFactor"]);
        to.coatTexture = texture(coat["clearcoatTexture"], false);
        to.coatRoughnessTexture = texture(coat["clearcoatRoughnessTexture"], false);
        to.coatNormalTexture = texture(coat["clearcoatNormalTexture"], false);
        to.coatNormalScale = coat["clearcoatNormalTexture"]["scale"].number(1.0f);
    }
    const GltfValue sheen = from.extension("KHR_materials_sheen");
    if (sheen.exists()) {
        to.sheenColor = glm::clamp(sheen["sheenColorFactor"].vector<3>(glm::vec3(0)), 0.0f, 1.0f);
        to.sheenRoughness = share(sheen["sheenRoughnessFactor"]);
        to.sheenColorTexture = texture(sheen["sheenColorTexture"], true);
        to.sheenRoughnessTexture = texture(sheen["sheenRoughnessTexture"], false);
    }
    const bool layered = to.coat > 0 || to.sheenColor != glm::vec3(0);
    if (layered && isTransmissive(to))
        scene_.notes.push_back(
            fmt::format("material {}: glass is drawn without its clear coat and sheen",
                        to.name.empty() ? fmt::format("{}", scene_.materials.size()) : "'" + to.name + "'"));
}

Material GltfMaterials::convert(const GltfValue& from) {
    Material to;
    to.name = oneLine(from["name"].text(""));
    const GltfValue specularGlossiness = from.extension("KHR_materials_pbrSpecularGlossiness");
    if (specularGlossiness.exists()) {
        convertSpecularGlossiness(specularGlossiness, to);
    } else {
        const GltfValue pbr = from["pbrMetallicRoughness"];
        to.baseColor = unit(pbr["baseColorFactor"].vector<4>(glm::vec4(1)));
        to.metallic = glm::clamp(pbr["metallicFactor"].number(1.0f), 0.0f, 1.0f);
        to.roughness = glm::clamp(pbr["roughnessFactor"].number(1.0f), 0.0f, 1.0f);
        to.baseColorTexture = texture(pbr["baseColorTexture"], true);
        to.metallicRoughnessTexture = texture(pbr["metallicRoughnessTexture"], false);
    }
    to.normalTexture = texture(from["normalTexture"], false);
    to.normalScale = from["normalTexture"]["scale"].number(1.0f);
    to.emissiveTexture = texture(from["emissiveTexture"], true);
    to.emission = positive(from["emissiveFactor"].vector<3>(glm::vec3(0)));
    to.emission *=
        std::max(from.extension("KHR_materials_emissive_strength")["emissiveStrength"].number(1.0f), 0.0f);

    const std::string alpha = from["alphaMode"].text("OPAQUE");
    if (alpha == "MASK")
        to.alphaMode = AlphaMode::Mask;
    else if (alpha == "BLEND")
        to.alphaMode = AlphaMode::Blend;
    else if (alpha != "OPAQUE")
        from["alphaMode"].fail(fmt::format("'{}' is unknown", oneLine(alpha)));
    to.alphaCutoff = std::max(from["alphaCutoff"].number(0.5f), 0.0f);
    to.doubleSided = from["doubleSided"].boolean(false);

    const GltfValue ior = from.extension("KHR_materials_ior")["ior"];
    to.ior = ior.number(1.5f);
    if (to.ior != 0.0f && to.ior < 1.0f) ior.fail("must be 0, or 1 and more");
    const GltfValue specular = from.extension("KHR_materials_specular");
    if (specular.exists()) {
        to.specular = glm::clamp(specular["specularFactor"].number(1.0f), 0.0f, 1.0f);
        to.specularColor = positive(specular["specularColorFactor"].vector<3>(glm::vec3(1)));
        to.specularTexture = texture(specular["specularTexture"], false);
        to.specularColorTexture = texture(specular["specularColorTexture"], true);
    }
    to.unlit = from.extension("KHR_materials_unlit").exists();
    convertGlass(from, to);
    convertLayers(from, to);
    // Kept by io/gltf_write.cpp.
    const GltfValue extras = from["extras"];
    if (extras.isObject() && extras["conelight"].isObject()) {
        const GltfValue phong = extras["conelight"]["phong"];
        if (phong.isObject()) {
            PhongMaterial& own = to.phong.emplace();
            own.color = glm::clamp(phong["color"].vector<3>(own.color), 0.0f, 1.0f);
            own.shininess = std::max(phong["shininess"].number(own.shininess), 0.0f);
            own.ambientStrength = std::max(phong["ambient"].number(own.ambientStrength), 0.0f);
            own.diffuseStrength = std::max(phong["diffuse"].number(own.diffuseStrength), 0.0f);
            own.specularStrength = std::max(phong["specular"].number(own.specularStrength), 0.0f);
        }
    }
    return to;
}

}  // namespace conelight::io
