// SPDX-License-Identifier: MIT
// Assimp's materials -> metallic-roughness. Formats with physically based values keep them. Phong values map:
//   diffuse colour, map     -> base colour          opacity, map      -> base colour's alpha (Blend / Mask)
//   shininess n             -> GGX alpha = sqrt(2/(n+2)) (Walter et al. 2007, section 5.2), roughness =
//   sqrt(alpha) specular colour ks      -> dielectric F0 = 0.08 ks, so that 0.5, the usual default, is the 4
//   % of plastic;
//                              mirrors (OBJ illum 3, 5, 8) take F0 = ks; ks = 0 is no specular lobe at all
//   emissive colour, map    -> emission             normal map, height map -> normal map
// Limits: transparency has no refraction; specular maps of Phong materials are left out.
#include "io/assimp_material.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>

#include "conelight/error.h"
#include "io/files.h"
#include "io/image_file.h"
#include "io/texture_budget.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {

std::string rawTextOf(const aiString& text) {
    return std::string(text.data, std::min<std::size_t>(text.length, sizeof text.data - 1));
}

float unit(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f; }
glm::vec3 unit(const aiColor3D& c) { return {unit(c.r), unit(c.g), unit(c.b)}; }
float positive(float value) { return std::isfinite(value) ? std::max(value, 0.0f) : 0.0f; }

// How the texels of a picture are turned into a texture.
enum class Use { Colour, Data, NormalFromHeight };

class TextureTable {
  public:
    TextureTable(const aiScene& source, const SceneFolder& folder, std::uint64_t maxTexels, Scene& scene)
        : source_(source), folder_(folder), budget_(maxTexels), scene_(scene) {}

    // The texture of slot `type`, or unused when there is none or it cannot be read (then noted).
    TextureRef find(const aiMaterial& material, aiTextureType type, Use use);
    // Puts the opacity picture of the material into the alpha of its base colour texture.
    bool mergeOpacity(const aiMaterial& material, Material& out);

  private:
    struct Picture {
        std::string name;
        ByteImage image;
    };
    const Picture* picture(const std::string& path);
    std::optional<Picture> decode(const std::string& path);
    SceneFolder::Choice locate(const std::string& path) const;
    int add(const std::string& key, const Picture& picture, std::vector<std::uint8_t> rgba, bool srgb,
            aiTextureMapMode u, aiTextureMapMode v);

    const aiScene& source_;
    const SceneFolder& folder_;
    TextureBudget budget_;
    Scene& scene_;
    std::map<std::string, std::optional<Picture>> pictures_;
    std::map<std::string, int> textures_;
};

TextureWrap wrapOf(aiTextureMapMode mode) {
    switch (mode) {
        case aiTextureMapMode_Clamp:
        case aiTextureMapMode_Decal:
            return TextureWrap::Clamp;
        case aiTextureMapMode_Mirror:
            return TextureWrap::Mirror;
        default:
            return TextureWrap::Repeat;
    }
}

// A file named in a model, often with the author's own folders: as given, beside the model, and by its bare
// name beside the model and in the folders people use.
SceneFolder::Choice TextureTable::locate(const std::string& path) const {
    std::string slashed = path;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    if (slashed.rfind("file://", 0) == 0) slashed.erase(0, 7);
    std::vector<fs::path> candidates;
    for (const std::string& spelled : {slashed, percentDecoded(slashed)}) {
        const fs::path given(spelled);
        const fs::path& folder = folder_.path();
        candidates.push_back(folder / given);  // an absolute path stays as it is
        candidates.push_back(folder / given.filename());
        for (const char* sub : {"textures", "Textures", "maps", "images"})
            candidates.push_back(folder / sub / given.filename());
        candidates.push_back(folder / ".." / "textures" / given.filename());
    }
    return folder_.firstOf(candidates);
}

std::optional<TextureTable::Picture> TextureTable::decode(const std::string& path) {
    Picture out;
    out.name = oneLine(path);
    std::vector<std::string> notes;
    try {
        if (const aiTexture* embedded = source_.GetEmbeddedTexture(path.c_str())) {
            const auto* bytes = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
            if (bytes == nullptr) throw Error(ErrorKind::BadInput, "embedded picture is empty");
            if (embedded->mHeight == 0) {
                out.image = budget_.decode({bytes, embedded->mWidth}, "embedded picture", notes);
                for (const std::string& note : notes) scene_.notes.push_back(note);
                return out;
            }
            if (std::uint64_t(embedded->mWidth) * embedded->mHeight > (1u << 28) || embedded->mWidth == 0)
                throw Error(ErrorKind::BadInput, "embedded picture has an unusable size");
            out.image = {int(embedded->mWidth), int(embedded->mHeight), 4, {}};
            const std::size_t count = std::size_t(embedded->mWidth) * embedded->mHeight;
            out.image.pixels.reserve(4 * count);
            for (std::size_t i = 0; i < count; ++i) {
                const aiTexel& t = embedded->pcData[i];
                out.image.pixels.insert(out.image.pixels.end(), {t.r, t.g, t.b, t.a});
            }
            return out;
        }
        const SceneFolder::Choice found = locate(path);
        if (found.file.empty()) throw Error(ErrorKind::BadInput, found.refusal);
        out.name = found.file.filename().string();
        out.image = budget_.decode(folder_.read(found.file), "picture", notes);
        for (const std::string& note : notes)
            scene_.notes.push_back(fmt::format("texture {}: {}", oneLine(path), note));
        return out;
    } catch (const Error& error) {
        scene_.notes.push_back(fmt::format("texture {}: {}; left out", oneLine(path), error.what()));
        return std::nullopt;
    }
}

const TextureTable::Picture* TextureTable::picture(const std::string& path) {
    auto entry = pictures_.find(path);
    if (entry == pictures_.end()) entry = pictures_.emplace(path, decode(path)).first;
    return entry->second ? &*entry->second : nullptr;
}

int TextureTable::add(const std::string& key, const Picture& source, std::vector<std::uint8_t> rgba,
                      bool srgb, aiTextureMapMode u, aiTextureMapMode v) {
    Texture texture;
    texture.name = source.name;
    texture.width = source.image.width;
    texture.height = source.image.height;
    texture.srgb = srgb;
    texture.wrapU = wrapOf(u);
    texture.wrapV = wrapOf(v);
    texture.rgba = std::move(rgba);
    scene_.textures.push_back(std::move(texture));
    return textures_[key] = int(scene_.textures.size()) - 1;
}

// Height map -> tangent-space normals by central differences with wrap-around. One texel step is taken as one
// texel of width, full white as kHeightTexels of them: bump maps carry no unit, 2 looks like relief without
// spikes (chosen by eye).
std::vector<std::uint8_t> normalsFromHeights(const ByteImage& image) {
    constexpr float kHeightTexels = 2.0f;
    const int w = image.width, h = image.height;
    const auto height = [&](int x, int y) {
        const std::size_t at = 4 * (std::size_t((y + h) % h) * std::size_t(w) + std::size_t((x + w) % w));
        return float(image.pixels[at] + image.pixels[at + 1] + image.pixels[at + 2]) / (3.0f * 255.0f);
    };
    std::vector<std::uint8_t> out;
    out.reserve(image.pixels.size());
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const float du = 0.5f * kHeightTexels * (height(x + 1, y) - height(x - 1, y));
            const float dv = 0.5f * kHeightTexels * (height(x, y + 1) - height(x, y - 1));
            const glm::vec3 n = glm::normalize(glm::vec3(-du, dv, 1.0f));  // rows run down, green points up
            for (int c = 0; c < 3; ++c)
                out.push_back(std::uint8_t(std::lround((0.5f * n[c] + 0.5f) * 255.0f)));
            out.push_back(255);
        }
    return out;
}

// Many files name a normal map in the bump slot. A height map is grey; a normal map is blue on the average.
bool looksLikeNormals(const ByteImage& image) {
    std::uint64_t sum[3] = {0, 0, 0};
    for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += image.pixels[i + c];
    return double(sum[2]) > 1.2 * double(std::max(sum[0], sum[1]));
}

TextureRef TextureTable::find(const aiMaterial& material, aiTextureType type, Use use) {
    TextureRef out;
    if (material.GetTextureCount(type) == 0) return out;
    aiString path;
    aiTextureMapping mapping = aiTextureMapping_UV;
    unsigned uvIndex = 0;
    ai_real blend = 1;
    aiTextureOp op = aiTextureOp_Multiply;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (material.GetTexture(type, 0, &path, &mapping, &uvIndex, &blend, &op, modes) != aiReturn_SUCCESS)
        return out;
    if (path.length == 0) return out;
    const Picture* found = picture(rawTextOf(path));
    if (found == nullptr) return out;
    if (use == Use::NormalFromHeight && looksLikeNormals(found->image)) use = Use::Data;
    const std::string key =
        fmt::format("{}|{}|{}|{}", rawTextOf(path), int(use), int(wrapOf(modes[0])), int(wrapOf(modes[1])));
    const auto known = textures_.find(key);
    if (known != textures_.end())
        out.texture = known->second;
    else if (use == Use::NormalFromHeight)
        out.texture = add(key, *found, normalsFromHeights(found->image), false, modes[0], modes[1]);
    else
        out.texture = add(key, *found, found->image.pixels, use == Use::Colour, modes[0], modes[1]);

    // Assimp turns about the picture's centre and scales first; v was flipped by the importer.
    aiUVTransform transform;
    if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS) {
        const float c = std::cos(transform.mRotation), s = std::sin(transform.mRotation);
        const glm::mat3 scale(transform.mScaling.x, 0, 0, 0, transform.mScaling.y, 0, 0, 0, 1);
        const glm::mat3 toCentre(1, 0, 0, 0, 1, 0, -0.5f, -0.5f, 1),
            fromCentre(1, 0, 0, 0, 1, 0, 0.5f, 0.5f, 1);
        const glm::mat3 turn(c, s, 0, -s, c, 0, 0, 0, 1);
        const glm::mat3 move(1, 0, 0, 0, 1, 0, transform.mTranslation.x, -transform.mTranslation.y, 1);
        const glm::mat3 flip(1, 0, 0, 0, -1, 0, 0, 1, 1);
        const glm::mat3 all = move * flip * fromCentre * turn * toCentre * scale * flip;
        bool usable = true;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) usable = usable && std::isfinite(all[i][j]);
        if (usable) out.uvFromUv = all;
    }
    return out;
}

bool TextureTable::mergeOpacity(const aiMaterial& material, Material& out) {
    aiString path;
    if (material.GetTextureCount(aiTextureType_OPACITY) == 0 ||
        material.GetTexture(aiTextureType_OPACITY, 0, &path) != aiReturn_SUCCESS || path.length == 0)
        return false;
    const Picture* opacity = picture(rawTextOf(path));
    if (opacity == nullptr) return false;
    if (!out.baseColorTexture.used()) {
        out.baseColorTexture = find(material, aiTextureType_OPACITY, Use::Colour);
        if (!out.baseColorTexture.used()) return false;
        Texture copy = scene_.textures[std::size_t(out.baseColorTexture.texture)];
        for (std::size_t i = 0; i + 3 < copy.rgba.size(); i += 4)
            copy.rgba[i] = copy.rgba[i + 1] = copy.rgba[i + 2] = 255;
        scene_.textures.push_back(std::move(copy));
    } else {
        scene_.textures.push_back(scene_.textures[std::size_t(out.baseColorTexture.texture)]);
    }
    out.baseColorTexture.texture = int(scene_.textures.size()) - 1;
    Texture& merged = scene_.textures.back();

    // Opacity is the picture's own alpha when that varies, else its brightness; nearest texel.
    const ByteImage& from = opacity->image;
    bool alphaVaries = false;
    for (std::size_t i = 3; i < from.pixels.size() && !alphaVaries; i += 4)
        alphaVaries = from.pixels[i] != 255;
    for (int y = 0; y < merged.height; ++y)
        for (int x = 0; x < merged.width; ++x) {
            const int sx = int(std::int64_t(x) * from.width / merged.width);
            const int sy = int(std::int64_t(y) * from.height / merged.height);
            const std::uint8_t* texel =
                &from.pixels[4 * (std::size_t(sy) * std::size_t(from.width) + std::size_t(sx))];
            const int grey = (int(texel[0]) + texel[1] + texel[2]) / 3;
            merged.rgba[4 * (std::size_t(y) * std::size_t(merged.width) + std::size_t(x)) + 3] =
                alphaVaries ? texel[3] : std::uint8_t(grey);
        }
    return true;
}

// F0 and lobe from Phong's specular colour and exponent.
void mapPhongSpecular(const aiMaterial& material, Material& out) {
    aiColor3D specular(0, 0, 0);
    float exponent = 0.0f, strength = 1.0f;
    int illum = 2;
    const bool hasSpecular = material.Get(AI_MATKEY_COLOR_SPECULAR, specular) == aiReturn_SUCCESS;
    material.Get(AI_MATKEY_SHININESS, exponent);
    material.Get(AI_MATKEY_SHININESS_STRENGTH, strength);
    material.Get("$mat.illum", 0, 0, illum);
    if (!hasSpecular) return;  // a format without the notion: plain rough dielectric

    const glm::vec3 ks = unit(specular) * (strength > 0.0f ? unit(strength) : 1.0f);
    const float strongest = std::max({ks.r, ks.g, ks.b});
    const bool mirror = illum == 3 || illum == 5 || illum == 8;
    out.specular = strongest > 0.0f && illum != 0 && illum != 1 ? 1.0f : 0.0f;
    out.specularColor = ks * (mirror ? 1.0f / 0.04f : 0.08f / 0.04f);
    const float n = positive(exponent);
    if (n > 0.0f) out.roughness = unit(std::pow(2.0f / (n + 2.0f), 0.25f));
}

void mapColours(const aiMaterial& material, Material& out) {
    aiColor4D base;
    aiColor3D diffuse(0.8f, 0.8f, 0.8f), emissive(0, 0, 0);
    float metallic = 0.0f, roughness = 1.0f, intensity = 1.0f;
    const bool hasBase = material.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS;
    const bool hasMetallic = material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS;
    const bool hasRoughness = material.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS;
    if (hasBase)
        diffuse = {base.r, base.g, base.b};
    else
        material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    out.baseColor = glm::vec4(unit(diffuse), 1.0f);
    if (hasMetallic || hasRoughness) {
        out.metallic = unit(metallic);
        out.roughness = unit(roughness);
    } else {
        mapPhongSpecular(material, out);
    }
    if (material.Get(AI_MATKEY_COLOR_EMISSIVE, emissive) == aiReturn_SUCCESS)
        out.emission = {positive(emissive.r), positive(emissive.g), positive(emissive.b)};
    if (material.Get(AI_MATKEY_EMISSIVE_INTENSITY, intensity) == aiReturn_SUCCESS)
        out.emission *= positive(intensity);

    int twoSided = 0;
    if (material.Get(AI_MATKEY_TWOSIDED, twoSided) == aiReturn_SUCCESS) out.doubleSided = twoSided != 0;
    int shading = 0;
    if (material.Get(AI_MATKEY_SHADING_MODEL, shading) == aiReturn_SUCCESS)
        out.unlit = shading == aiShadingMode_NoShading;
}

// As OBJ and FBX have them, without pictures.
void mapLayers(const aiMaterial& material, Material& out) {
    float coat = 0, coatRoughness = 0, sheenRoughness = 0;
    aiColor3D sheen(0, 0, 0);
    if (material.Get(AI_MATKEY_CLEARCOAT_FACTOR, coat) == aiReturn_SUCCESS) out.coat = unit(coat);
    if (material.Get(AI_MATKEY_CLEARCOAT_ROUGHNESS_FACTOR, coatRoughness) == aiReturn_SUCCESS)
        out.coatRoughness = unit(coatRoughness);
    if (material.Get(AI_MATKEY_SHEEN_COLOR_FACTOR, sheen) == aiReturn_SUCCESS) out.sheenColor = unit(sheen);
    if (material.Get(AI_MATKEY_SHEEN_ROUGHNESS_FACTOR, sheenRoughness) == aiReturn_SUCCESS)
        out.sheenRoughness = unit(sheenRoughness);
}

Material convert(const aiMaterial& material, TextureTable& textures) {
    Material out;
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) out.name = oneLine(rawTextOf(name));
    if (out.name == AI_DEFAULT_MATERIAL_NAME) return out;  // the file names none: our default
    mapColours(material, out);
    mapLayers(material, out);

    out.baseColorTexture = textures.find(material, aiTextureType_BASE_COLOR, Use::Colour);
    if (!out.baseColorTexture.used())
        out.baseColorTexture = textures.find(material, aiTextureType_DIFFUSE, Use::Colour);
    out.emissiveTexture = textures.find(material, aiTextureType_EMISSIVE, Use::Colour);
    if (!out.emissiveTexture.used())
        out.emissiveTexture = textures.find(material, aiTextureType_EMISSION_COLOR, Use::Colour);
    if (out.emissiveTexture.used() && out.emission == glm::vec3(0)) out.emission = glm::vec3(1);
    out.normalTexture = textures.find(material, aiTextureType_NORMALS, Use::Data);
    if (!out.normalTexture.used())
        out.normalTexture = textures.find(material, aiTextureType_NORMAL_CAMERA, Use::Data);
    if (!out.normalTexture.used())
        out.normalTexture = textures.find(material, aiTextureType_HEIGHT, Use::NormalFromHeight);
    // A texture with a black factor would vanish: exporters write that by mistake, viewers show the texture.
    if (out.baseColorTexture.used() && glm::vec3(out.baseColor) == glm::vec3(0))
        out.baseColor = {1, 1, 1, out.baseColor.a};

    // Opacity 0 is nearly always a writer's "unset" (DXF, some FBX): taken as opaque.
    float opacity = 1.0f;
    if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && unit(opacity) > 0.0f)
        out.baseColor.a = unit(opacity);
    if (out.baseColor.a < 1.0f) out.alphaMode = AlphaMode::Blend;
    if (textures.mergeOpacity(material, out)) out.alphaMode = AlphaMode::Mask;
    return out;
}

}  // namespace

void importAssimpMaterials(const aiScene& source, const SceneFolder& folder, std::uint64_t maxTexels,
                           Scene& scene) {
    TextureTable textures(source, folder, maxTexels, scene);
    for (unsigned i = 0; i < source.mNumMaterials; ++i)
        scene.materials.push_back(convert(*source.mMaterials[i], textures));
}

}  // namespace conelight::io
