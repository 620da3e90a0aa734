// SPDX-License-Identifier: MIT
#include "scene/gpu_materials.h"

#include <algorithm>
#include <cmath>

#include "gl/gl.h"
#include "gl/pass.h"
#include "gl/work.h"
#include "math/sheen.h"
#include "math/srgb.h"
#include "scene/mip_levels.h"
#include "scene/normal_map.h"
#include "shared/voxels.h"

namespace conelight::scene {
namespace {

// Edge of the low-resolution copies of textures that compute shaders sample. A voxel rarely covers less than
// 1/256 of a texture; 256^2 with mips costs 350 KB per texture.
constexpr int kSurfaceEdge = 256;

GLenum wrapMode(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Repeat:
            return GL_REPEAT;
        case TextureWrap::Clamp:
            return GL_CLAMP_TO_EDGE;
        case TextureWrap::Mirror:
            return GL_MIRRORED_REPEAT;
    }
    return GL_REPEAT;
}

struct Filtering {
    TextureWrap wrapU, wrapV;
    TextureFilter filter;
    bool mipmapped;
};

gl::Sampler samplerOf(const Filtering& f, const std::string& label) {
    // Mesa's software driver compiles and runs anisotropic lookups tens of times slower than trilinear ones.
    const float anisotropy = gl::isSoftwareDriver() ? 1.0f : 8.0f;
    const bool nearest = f.filter == TextureFilter::Nearest;
    const GLenum texels = nearest ? GL_NEAREST : GL_LINEAR;
    const GLenum levels = nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR;
    return gl::Sampler(gl::SamplerDesc{f.mipmapped ? levels : texels, texels, wrapMode(f.wrapU),
                                       wrapMode(f.wrapV), false, anisotropy},
                       label);
}

// Box-filters (or repeats) a texture to kSurfaceEdge^2 linear values.
std::vector<glm::vec4> linearSurface(const Texture& texture) {
    std::vector<glm::vec4> level(static_cast<std::size_t>(kSurfaceEdge) * kSurfaceEdge);
    float toLinear[256];
    for (int i = 0; i < 256; ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        toLinear[i] = texture.srgb ? math::srgbToLinear(value) : value;
    }
    const std::size_t pitch = static_cast<std::size_t>(texture.width);
    for (int y = 0; y < kSurfaceEdge; ++y) {
        const int y0 = y * texture.height / kSurfaceEdge;
        const int y1 = std::max(y0 + 1, (y + 1) * texture.height / kSurfaceEdge);
        for (int x = 0; x < kSurfaceEdge; ++x) {
            const int x0 = x * texture.width / kSurfaceEdge;
            const int x1 = std::max(x0 + 1, (x + 1) * texture.width / kSurfaceEdge);
            glm::vec4 sum(0);
            for (int sy = y0; sy < y1; ++sy)
                for (int sx = x0; sx < x1; ++sx) {
                    const std::uint8_t* t =
                        &texture
                             .rgba[4 * (static_cast<std::size_t>(sy) * pitch + static_cast<std::size_t>(sx))];
                    sum += glm::vec4(toLinear[t[0]], toLinear[t[1]], toLinear[t[2]],
                                     static_cast<float>(t[3]) / 255.0f);
                }
            level[static_cast<std::size_t>(y) * kSurfaceEdge + static_cast<std::size_t>(x)] =
                sum / static_cast<float>((y1 - y0) * (x1 - x0));
        }
    }
    return level;
}

// Stored sRGB-encoded, whatever the texture holds, in an sRGB format: 8 bits then err by less than 1 % above
// 0.02 of full scale, and the hardware decodes before it filters. (Square roots that the shader squares were
// tried: filtering between them darkened high-contrast textures by up to half.)
std::vector<std::uint8_t> encodedSurface(const std::vector<glm::vec4>& level) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(4 * level.size());
    for (const glm::vec4& texel : level)
        for (int i = 0; i < 4; ++i)
            bytes.push_back(static_cast<std::uint8_t>(
                std::lround((i < 3 ? math::linearToSrgb(texel[i]) : texel[i]) * 255.0f)));
    return bytes;
}

glm::vec4 uvRow(const TextureRef& use, int row) {
    const glm::mat3& t = use.uvFromUv;
    return {t[0][row], t[1][row], t[2][row], 0};
}

void packGlass(const Material& m, gpu::Material& g) {
    g.transmission = m.transmission;
    g.ior = std::max(m.ior, 1.0f);
    if (m.attenuationDistance > 0) g.absorption = -glm::log(m.attenuationColor) / m.attenuationDistance;
    for (int row = 0; row < 2; ++row) g.transmissionUvRow[row] = uvRow(m.transmissionTexture, row);
    g.transmissionLayer = m.transmissionTexture.texture;
}

// Of all texels, linear; white without a texture.
glm::vec4 meanTexel(const TextureRef& use, const std::vector<Texture>& textures) {
    if (!use.used()) return glm::vec4(1);
    const Texture& texture = textures[static_cast<std::size_t>(use.texture)];
    if (texture.rgba.size() < 4) return glm::vec4(1);
    std::array<std::array<std::uint64_t, 256>, 4> counts{};
    for (std::size_t i = 0; i < texture.rgba.size(); ++i) ++counts[i % 4][texture.rgba[i]];
    glm::dvec4 sum(0);
    for (int c = 0; c < 4; ++c)
        for (int level = 0; level < 256; ++level) {
            const float value = static_cast<float>(level) / 255.0f;
            const auto count =
                static_cast<double>(counts[static_cast<std::size_t>(c)][static_cast<std::size_t>(level)]);
            sum[c] += count * static_cast<double>(texture.srgb && c < 3 ? math::srgbToLinear(value) : value);
        }
    return glm::vec4(sum / static_cast<double>(texture.rgba.size() / 4));
}

std::uint32_t packedRoots(const glm::vec4& v) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i)
        bits |= static_cast<std::uint32_t>(std::lround(std::sqrt(std::clamp(v[i], 0.0f, 1.0f)) * 255.0f))
                << (8 * i);
    return bits;
}

void packLayers(const Material& m, const std::vector<Texture>& textures, gpu::Material& g) {
    g.coatNormalMap = -1;
    if (!hasLayers(m)) return;
    g.flags |= MATERIAL_LAYERED;
    g.coat = m.coat;
    g.coatRoughness = m.coatRoughness;
    g.coatNormalMap = m.coatNormalTexture.texture;
    g.coatNormalScale = m.coatNormalScale;
    g.sheenColor = m.sheenColor;
    g.sheenRoughness = m.sheenRoughness;
    const TextureRef* uses[5] = {&m.coatTexture, &m.coatRoughnessTexture, &m.coatNormalTexture,
                                 &m.sheenColorTexture, &m.sheenRoughnessTexture};
    for (int i = 0; i < 10; ++i) g.layerUvRow[i] = uvRow(*uses[i / 2], i % 2);
    const math::LayerAlbedo even =
        math::evenLayers(m.coat * meanTexel(m.coatTexture, textures).r,
                         m.coatRoughness * meanTexel(m.coatRoughnessTexture, textures).g,
                         m.sheenColor * glm::vec3(meanTexel(m.sheenColorTexture, textures)),
                         m.sheenRoughness * meanTexel(m.sheenRoughnessTexture, textures).a);
    g.evenLayers = packedRoots({even.added, even.taken});
}

}  // namespace

gpu::Material packedMaterial(const Material& m, const std::vector<Texture>& textures) {
    gpu::Material g{};
    g.baseColor = m.baseColor;
    g.emission = m.emission;
    g.alphaCutoff = m.alphaCutoff;
    // KHR_materials_ior and _specular: F0 = min(((ior-1)/(ior+1))^2 * specularColor, 1) * specular.
    const float ratio = m.ior > 0 ? (m.ior - 1) / (m.ior + 1) : 1.0f;
    g.specularF0 = glm::min(m.specularColor * (ratio * ratio), glm::vec3(1)) * m.specular;
    g.metallic = m.metallic;
    g.roughness = m.roughness;
    g.normalScale = m.normalScale;
    g.flags = (m.alphaMode == AlphaMode::Mask ? MATERIAL_ALPHA_MASK : 0u) |
              (m.alphaMode == AlphaMode::Blend ? MATERIAL_ALPHA_BLEND : 0u) |
              (m.doubleSided ? MATERIAL_DOUBLE_SIDED : 0u) | (m.unlit ? MATERIAL_UNLIT : 0u) |
              (m.phong ? MATERIAL_HAS_PHONG : 0u) | (m.thickness > 0 ? MATERIAL_SOLID : 0u);
    const TextureRef* uses[6] = {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                 &m.emissiveTexture,  &m.specularTexture,          &m.specularColorTexture};
    for (int i = 0; i < 6; ++i) {
        if (i < 4) g.layers[i] = uses[i]->texture;  // layers follow the order of the scene's textures
        if (uses[i]->used()) g.flags |= i == 0 ? MATERIAL_BASE_TEXTURE : MATERIAL_DETAIL_TEXTURES;
        for (int row = 0; row < 2; ++row) g.uvRow[2 * i + row] = uvRow(*uses[i], row);
    }
    packGlass(m, g);
    packLayers(m, textures, g);
    const PhongMaterial phong = phongOf(m);
    g.phongColor = phong.color;
    g.phongShininess = phong.shininess;
    g.phongAmbient = phong.ambientStrength;
    g.phongDiffuse = phong.diffuseStrength;
    g.phongSpecular = phong.specularStrength;
    return g;
}

bool isGlossyDielectric(const gpu::Material& m) {
    const bool reflects = std::max({m.specularF0.x, m.specularF0.y, m.specularF0.z}) > 0;
    // A texture may hold less than its factor.
    return reflects && m.metallic < 1 && (m.roughness <= LOBE_MAX_ROUGHNESS || m.layers.y >= 0);
}

MaterialTextures texturesOf(const Material& material) {
    return {{material.baseColorTexture.texture, material.metallicRoughnessTexture.texture,
             material.normalTexture.texture, material.emissiveTexture.texture,
             material.specularTexture.texture, material.specularColorTexture.texture,
             material.coatTexture.texture, material.coatRoughnessTexture.texture,
             material.coatNormalTexture.texture, material.sheenColorTexture.texture,
             material.sheenRoughnessTexture.texture}};
}

SceneTextures::SceneTextures(const std::vector<Texture>& sources, const std::vector<bool>& normals) {
    const std::uint8_t white[4] = {255, 255, 255, 255};
    white_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA8, 1, 1, 1, 1}, "white");
    white_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, white);
    // The surface array has at least one layer so that it can always be bound, and two levels: with one llvmpipe builds
    // other kernels (gl/sampler_slots.h).
    const int layers = std::max<int>(static_cast<int>(sources.size()), 1);
    const int edge = sources.empty() ? 2 : kSurfaceEdge;
    surfaceArray_ =
        gl::Texture({GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, edge, edge, layers, 0}, "surface array");
    for (int level = 0; sources.empty() && level < surfaceArray_.desc().levels; ++level)
        surfaceArray_.clear(level, GL_RGBA, GL_UNSIGNED_BYTE, white);
    drawn_.resize(sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (gl::Work* const work = gl::Work::current()) work->tell("textures", i + 1, sources.size());
        set(i, sources[i], normals[i]);
    }
    surfaceSampler_ = gl::Sampler({GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT}, "surface array");
}

// An array cannot grow: another takes the layers over, with room for half as many more.
int SceneTextures::addLayer() {
    const auto layer = static_cast<int>(drawn_.size());
    if (layer == 0 || layer >= surfaceArray_.desc().depth) {
        gl::Texture larger(
            {GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, kSurfaceEdge, kSurfaceEdge, layer + 1 + layer / 2, 0},
            "surface array");
        if (layer > 0) larger.copyLayers(surfaceArray_, layer);
        surfaceArray_ = std::move(larger);
    }
    drawn_.emplace_back();
    return layer;
}

void SceneTextures::add(const Texture& source) { set(static_cast<std::size_t>(addLayer()), source, false); }

void SceneTextures::add(const gl::Device& device, const HostTexture& source) {
    set(device, static_cast<std::size_t>(addLayer()), source);
}

// Those of one size and format take the new texels where they lie.
void SceneTextures::set(std::size_t index, const Texture& source, bool normals) {
    putForDrawing(index, source, normals);
    uploadSurface(source, static_cast<int>(index));
}

void SceneTextures::setUse(std::size_t index, const Texture& source, bool normals) {
    const DrawTexture& drawn = drawn_[index];
    if (drawn.foreign == 0 && drawn.normals != normals) putForDrawing(index, source, normals);
}

void SceneTextures::set(const gl::Device& device, std::size_t index, const HostTexture& source) {
    const Filtering filtering{source.wrapU, source.wrapV, source.filter,
                              gl::shapeOfForeign(source.texture).mipmapped};
    drawn_[index] = {{}, source.texture, samplerOf(filtering, "texture " + source.name)};
    hostTextures_.copy(device, source, surfaceArray_, static_cast<int>(index));
}

void SceneTextures::putForDrawing(std::size_t index, const Texture& texture, bool normals) {
    const std::string label = "texture " + texture.name;
    const auto format = static_cast<std::uint32_t>(texture.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8);
    drawn_[index].foreign = 0;
    gl::Texture& t = drawn_[index].own;
    if (!t || t.desc().format != format || t.width() != texture.width || t.height() != texture.height) {
        t = {};
        t = gl::Texture({GL_TEXTURE_2D, format, texture.width, texture.height, 1, 0}, label);
    }
    const std::vector<std::uint8_t> unit = normals ? unitNormals(texture.rgba) : std::vector<std::uint8_t>();
    const std::vector<std::uint8_t>& texels = normals ? unit : texture.rgba;
    t.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    const std::vector<MipLevel> levels = smallerLevels(texels, texture.width, texture.height, texture.srgb);
    for (std::size_t i = 0; i < levels.size(); ++i)
        t.upload(static_cast<int>(i) + 1, GL_RGBA, GL_UNSIGNED_BYTE, levels[i].rgba.data());
    drawn_[index].normals = normals;
    drawn_[index].sampler = samplerOf({texture.wrapU, texture.wrapV, texture.filter, true}, label);
}

void SceneTextures::uploadSurface(const Texture& source, int layer) {
    const std::vector<std::uint8_t> texels = encodedSurface(linearSurface(source));
    surfaceArray_.uploadLayer(0, layer, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    const std::vector<MipLevel> levels = smallerLevels(texels, kSurfaceEdge, kSurfaceEdge, true);
    for (std::size_t i = 0; i < levels.size(); ++i)
        surfaceArray_.uploadLayer(static_cast<int>(i) + 1, layer, GL_RGBA, GL_UNSIGNED_BYTE,
                                  levels[i].rgba.data());
}

void SceneTextures::declare(gl::Inputs& inputs) const {
    inputs.texture("surfaceArray", surfaceArray_, &surfaceSampler_);
}

void SceneTextures::bind(const MaterialTextures& textures, const MaterialUnits& units) const {
    for (std::size_t slot = 0; slot < units.size(); ++slot) {
        if (units[slot] < 0) continue;
        const int texture = textures.slots[slot];
        const auto unit = static_cast<unsigned>(units[slot]);
        if (texture < 0) {
            white_.bind(unit);
            gl::unbindSampler(unit);
        } else {
            const DrawTexture& drawn = drawn_[static_cast<std::size_t>(texture)];
            if (drawn.own)
                drawn.own.bind(unit);
            else
                gl::bindForeignTexture(unit, drawn.foreign);
            drawn.sampler.bind(unit);
        }
    }
}

namespace {
constexpr gl::ResourceName kMaterialTextures[kMaterialTextureCount] = {
    "baseTexture",       "metalRoughTexture",    "normalTexture",        "emissiveTexture",
    "specularTexture",   "specularColorTexture", "coatTexture",          "coatRoughnessTexture",
    "coatNormalTexture", "sheenColorTexture",    "sheenRoughnessTexture"};
}

void SceneTextures::declarePerDraw(gl::Inputs& inputs) {
    for (const gl::ResourceName name : kMaterialTextures) inputs.perDraw(name);
}

MaterialUnits SceneTextures::unitsOf(const gl::Program& program) {
    MaterialUnits units;
    for (std::size_t slot = 0; slot < units.size(); ++slot)
        units[slot] = program.unitOf(kMaterialTextures[slot]);
    return units;
}

}  // namespace conelight::scene
