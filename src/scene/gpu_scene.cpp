// SPDX-License-Identifier: MIT
#include "scene/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"
#include "gl/pass.h"
#include "math/octahedral.h"
#include "scene/gpu_lights.h"
#include "scene/mesh_order.h"
#include "shared/bindings.h"

namespace conelight::scene {
namespace {

// Edge of the low-resolution copies of textures that compute shaders sample. A voxel rarely covers less than
// 1/256 of a texture; 256^2 with mips costs 350 KB per texture.
constexpr int kSurfaceEdge = 256;
// Of a part of a mesh: large enough that a draw costs little beside its triangles, by eye.
constexpr std::uint32_t kPartIndices = 3 * 256;

std::uint32_t packUnorm8(const glm::vec4& color) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i)
        bits |= static_cast<std::uint32_t>(std::lround(glm::clamp(color[i], 0.0f, 1.0f) * 255.0f)) << (8 * i);
    return bits;
}

// RGB9E5 of EXT_texture_shared_exponent, section "Conversion": rounding errs by 1/1022 of the largest
// channel.
std::uint32_t packRgb9e5(const glm::vec4& color) {
    constexpr float kLargest = 65408.0f;
    const glm::vec3 c = glm::clamp(glm::vec3(color), 0.0f, kLargest);
    const float most = std::max({c.r, c.g, c.b});
    int exponent = most > 0 ? std::max(-16, std::ilogb(most)) + 16 : 0;
    if (std::lround(std::ldexp(most, 24 - exponent)) == 512) ++exponent;
    std::uint32_t bits = static_cast<std::uint32_t>(exponent) << 27;
    for (int i = 0; i < 3; ++i)
        bits |= static_cast<std::uint32_t>(std::lround(std::ldexp(c[i], 24 - exponent))) << (9 * i);
    return bits;
}

// Whether 8 bits do not hold the colours of a mesh: brighter than 1, or finer, as baked light is. Opacity
// has no place beside the shared exponent.
bool hasWideColors(const Mesh& mesh) {
    bool wide = false;
    for (const glm::vec4& color : mesh.colors) {
        if (color.a != 1.0f) return false;
        for (int i = 0; i < 3; ++i) {
            // Values made of 8 bits, as most files have them, are off by rounding only.
            const float steps = color[i] * 255.0f;
            wide = wide || color[i] > 1.0f || std::fabs(steps - std::round(steps)) > 1e-3f;
        }
    }
    return wide;
}

// Area-weighted smooth normals would hide hard edges: missing normals are flat, which splits vertices.
struct FlatMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> source;  // vertex of the original mesh
};

FlatMesh flattened(const Mesh& mesh) {
    FlatMesh flat;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::vec3 c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 cross = glm::cross(b - a, c - a);
        const float length = glm::length(cross);
        const glm::vec3 normal = length > 0 ? cross / length : glm::vec3(0, 1, 0);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t source = mesh.indices[i + static_cast<std::size_t>(corner)];
            flat.positions.push_back(mesh.positions[source]);
            flat.normals.push_back(normal);
            flat.source.push_back(source);
        }
    }
    return flat;
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : fallback;
}

// Appends a mesh; returns false when its vertices were split (so that its indices are 0, 1, 2 ...).
bool appendVertices(const Mesh& mesh, std::vector<gpu::Vertex>& vertices) {
    const bool hasNormals = !mesh.normals.empty();
    FlatMesh flat;
    if (!hasNormals) flat = flattened(mesh);
    const bool wide = hasWideColors(mesh);
    const std::size_t count = hasNormals ? mesh.positions.size() : flat.positions.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t source = hasNormals ? i : flat.source[i];
        gpu::Vertex vertex{};
        vertex.position = hasNormals ? mesh.positions[i] : flat.positions[i];
        const glm::vec3 normal = unitOr(hasNormals ? mesh.normals[i] : flat.normals[i], {0, 1, 0});
        vertex.normalOct = math::packSnorm2x16(math::octEncode(normal));
        const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[source];
        vertex.u = std::isfinite(uv.x) ? uv.x : 0;
        vertex.v = std::isfinite(uv.y) ? uv.y : 0;
        const glm::vec4 tangent = mesh.tangents.empty() ? glm::vec4(1, 0, 0, 1) : mesh.tangents[source];
        const std::uint32_t packed =
            math::packSnorm2x16(math::octEncode(unitOr(glm::vec3(tangent), {1, 0, 0})));
        vertex.tangentOct = (packed & ~1u) | (tangent.w < 0 ? 1u : 0u);
        const glm::vec4 color = mesh.colors.empty() ? glm::vec4(1) : mesh.colors[source];
        vertex.color = wide ? packRgb9e5(color) : packUnorm8(color);
        vertices.push_back(vertex);
    }
    return hasNormals;
}

gpu::Material packedMaterial(const Material& m) {
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
              (m.phong ? MATERIAL_HAS_PHONG : 0u);
    const TextureRef* uses[6] = {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                 &m.emissiveTexture,  &m.specularTexture,          &m.specularColorTexture};
    for (int i = 0; i < 6; ++i) {
        if (i < 4) g.layers[i] = uses[i]->texture;  // layers follow the order of the scene's textures
        if (uses[i]->used()) g.flags |= i == 0 ? MATERIAL_BASE_TEXTURE : MATERIAL_DETAIL_TEXTURES;
        const glm::mat3& t = uses[i]->uvFromUv;
        g.uvRow[2 * i] = {t[0][0], t[1][0], t[2][0], 0};
        g.uvRow[2 * i + 1] = {t[0][1], t[1][1], t[2][1], 0};
    }
    const PhongMaterial phong = phongOf(m);
    g.phongColor = phong.color;
    g.phongShininess = phong.shininess;
    g.phongAmbient = phong.ambientStrength;
    g.phongDiffuse = phong.diffuseStrength;
    g.phongSpecular = phong.specularStrength;
    return g;
}

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

float srgbToLinear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

float linearToSrgb(float c) {
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}

// Box-filters (or repeats) a texture to kSurfaceEdge^2 linear values.
std::vector<glm::vec4> linearSurface(const Texture& texture) {
    std::vector<glm::vec4> level(static_cast<std::size_t>(kSurfaceEdge) * kSurfaceEdge);
    float toLinear[256];
    for (int i = 0; i < 256; ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        toLinear[i] = texture.srgb ? srgbToLinear(value) : value;
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

// 2x2 box.
std::vector<glm::vec4> halved(const std::vector<glm::vec4>& level, std::size_t edge) {
    std::vector<glm::vec4> half(edge * edge / 4);
    for (std::size_t y = 0; y < edge / 2; ++y)
        for (std::size_t x = 0; x < edge / 2; ++x) {
            const glm::vec4* t = &level[2 * y * edge + 2 * x];
            half[y * (edge / 2) + x] = 0.25f * (t[0] + t[1] + t[edge] + t[edge + 1]);
        }
    return half;
}

// Stored sRGB-encoded, whatever the texture holds, in an sRGB format: 8 bits then err by less than 1 % above
// 0.02 of full scale, and the hardware decodes before it filters. (Square roots that the shader squares were
// tried: filtering between them darkened high-contrast textures by up to half.)
std::vector<std::uint8_t> encodedSurface(const std::vector<glm::vec4>& level) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(4 * level.size());
    for (const glm::vec4& texel : level)
        for (int i = 0; i < 4; ++i)
            bytes.push_back(
                static_cast<std::uint8_t>(std::lround((i < 3 ? linearToSrgb(texel[i]) : texel[i]) * 255.0f)));
    return bytes;
}

}  // namespace

GpuScene::GpuScene(const Scene& source) {
    source.validate();
    static std::uint64_t made = 0;
    identity_ = ++made;
    uploadGeometry(source);
    uploadMaterials(source);
    uploadTextures(source);
    setLights(source.lights);
    firstBounds_ = bounds();
}

void GpuScene::uploadGeometry(const Scene& source) {
    // Meshes one after the other; instances name their ranges.
    std::vector<gpu::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    struct Range {
        std::uint32_t firstVertex, firstIndex, indexCount;
        Aabb bounds;
        bool wideColors;
        std::size_t firstPart;
    };
    std::vector<Range> ranges;
    for (const Mesh& mesh : source.meshes) {
        hasVertexColors_ = hasVertexColors_ || !mesh.colors.empty();
        Range range{static_cast<std::uint32_t>(vertices.size()),
                    static_cast<std::uint32_t>(indices.size()),
                    static_cast<std::uint32_t>(mesh.indices.size()),
                    mesh.bounds(),
                    hasWideColors(mesh),
                    partBounds_.size()};
        if (appendVertices(mesh, vertices)) {
            indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        } else {
            indices.resize(indices.size() + mesh.indices.size());
            std::iota(indices.end() - static_cast<std::ptrdiff_t>(mesh.indices.size()), indices.end(), 0u);
        }
        orderForReuse(vertices, range.firstVertex, indices, range.firstIndex);
        for (std::size_t i = range.firstIndex; i < indices.size(); ++i) {
            if ((i - range.firstIndex) % kPartIndices == 0) partBounds_.emplace_back();
            partBounds_.back().grow(vertices[range.firstVertex + indices[i]].position);
        }
        ranges.push_back(range);
    }
    const std::uint32_t defaultMaterial = static_cast<std::uint32_t>(source.materials.size());
    std::vector<std::uint32_t> instanceIndices;
    for (const Instance& instance : source.instances) {
        const Range& range = ranges[static_cast<std::size_t>(instance.mesh)];
        gpu::Instance g{};
        g.firstIndex = range.firstIndex;
        g.indexCount = range.indexCount;
        g.firstVertex = range.firstVertex;
        g.material = instance.material >= 0 ? static_cast<std::uint32_t>(instance.material) : defaultMaterial;
        g.firstTriangle = triangleCount_;
        g.flags = range.wideColors ? INSTANCE_WIDE_COLORS : 0u;
        triangleCount_ += range.indexCount / 3;
        instanceIndices.push_back(static_cast<std::uint32_t>(instances_.size()));
        instances_.push_back(g);
        instanceObjectBounds_.push_back(range.bounds);
        instanceParts_.push_back(range.firstPart);
    }
    vertexBuffer_ = gl::Buffer(vertices, "scene vertices");
    indexBuffer_ = gl::Buffer(indices, "scene indices");
    instanceIndexBuffer_ = gl::Buffer(instanceIndices, "scene instance indices");
    instanceBounds_.resize(instances_.size());
    instanceRevisions_.resize(instances_.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        setFlags(i, source.instances[i]);
        place(i, source.instances[i].worldFromObject);
        instances_[i].prevWorldFromObject = instances_[i].worldFromObject;
    }
    instanceBuffer_ = gl::Buffer(instances_, "scene instances");
    vertexArray_ = gl::VertexArray(vertexBuffer_, sizeof(gpu::Vertex),
                                   {{0, 3, GL_FLOAT, false, offsetof(gpu::Vertex, position)},
                                    {1, 1, GL_UNSIGNED_INT, true, offsetof(gpu::Vertex, normalOct)},
                                    {2, 2, GL_FLOAT, false, offsetof(gpu::Vertex, u)},
                                    {3, 1, GL_UNSIGNED_INT, true, offsetof(gpu::Vertex, tangentOct)},
                                    {4, 1, GL_UNSIGNED_INT, true, offsetof(gpu::Vertex, color)}},
                                   indexBuffer_, "scene");
    vertexArray_.addPerDrawUint(5, instanceIndexBuffer_);
    drawOrder_.resize(instances_.size());
    std::iota(drawOrder_.begin(), drawOrder_.end(), 0u);
    sortDraws();
}

void GpuScene::sortDraws() {
    std::stable_sort(drawOrder_.begin(), drawOrder_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return instances_[a].material != instances_[b].material
                   ? instances_[a].material < instances_[b].material
                   : a < b;
    });
}

void GpuScene::setFlags(std::size_t index, const Instance& source) {
    gpu::Instance& g = instances_[index];
    g.flags = (source.visible ? INSTANCE_VISIBLE : 0u) |
              (source.visible && source.voxelized ? INSTANCE_VOXELIZED : 0u) |
              (source.visible && source.castsShadow ? INSTANCE_CASTS_SHADOW : 0u) |
              (source.dynamic ? INSTANCE_DYNAMIC : 0u) |
              (g.flags & (INSTANCE_FLIPPED | INSTANCE_LIT_EXACTLY | INSTANCE_WIDE_COLORS));
}

// In the CPU table.
void GpuScene::place(std::size_t index, const glm::mat4& worldFromObject) {
    gpu::Instance& g = instances_[index];
    g.worldFromObject = worldFromObject;
    const glm::mat3 linear(worldFromObject);
    const float determinant = glm::determinant(linear);
    g.flags = determinant < 0 ? g.flags | INSTANCE_FLIPPED : g.flags & ~INSTANCE_FLIPPED;
    // Cofactors instead of the inverse transpose: the same direction, and defined for flat scalings too.
    const float sign = determinant < 0 ? -1.0f : 1.0f;
    g.normalColumn0 = glm::vec4(glm::cross(linear[1], linear[2]) * sign, 0);
    g.normalColumn1 = glm::vec4(glm::cross(linear[2], linear[0]) * sign, 0);
    g.normalColumn2 = glm::vec4(glm::cross(linear[0], linear[1]) * sign, 0);
    instanceBounds_[index] = instanceObjectBounds_[index].transformed(worldFromObject);
    boundsCurrent_ = false;
}

void GpuScene::uploadInstance(std::size_t index) {
    instanceBuffer_.update(index * sizeof(gpu::Instance), &instances_[index], sizeof(gpu::Instance));
}

void GpuScene::setInstance(std::size_t index, const Instance& instance) {
    gpu::Instance& g = instances_[index];
    const std::uint32_t material = instance.material >= 0 ? static_cast<std::uint32_t>(instance.material)
                                                          : static_cast<std::uint32_t>(materials_.size() - 1);
    const std::uint32_t flagsBefore = g.flags;
    const bool recolored = g.material != material;
    g.material = material;
    setFlags(index, instance);
    // Moved twice within a frame, it still has one place before.
    const bool moves = g.worldFromObject != instance.worldFromObject;
    if (moves && std::find(moved_.begin(), moved_.end(), static_cast<std::uint32_t>(index)) == moved_.end())
        moved_.push_back(static_cast<std::uint32_t>(index));
    place(index, instance.worldFromObject);
    if (!moves && !recolored && g.flags == flagsBefore) return;
    uploadInstance(index);
    if (recolored) sortDraws();
    instanceRevisions_[index] = ++geometryRevision_;
}

void GpuScene::endFrame() {
    for (const std::uint32_t index : moved_) {
        instances_[index].prevWorldFromObject = instances_[index].worldFromObject;
        uploadInstance(index);
    }
    moved_.clear();
}

void GpuScene::setMaterial(std::size_t index, const Material& material) {
    materials_[index] = packedMaterial(material);
    materialTextures_[index] = texturesOf(material);
    materialBuffer_.update(index * sizeof(gpu::Material), &materials_[index], sizeof(gpu::Material));
    ++geometryRevision_;
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if (instances_[i].material == index) instanceRevisions_[i] = geometryRevision_;
}

const Aabb& GpuScene::bounds() const {
    if (boundsCurrent_) return bounds_;
    bounds_ = Aabb{};
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if ((instances_[i].flags & INSTANCE_VISIBLE) != 0 && !instanceBounds_[i].empty())
            bounds_.grow(instanceBounds_[i]);
    boundsCurrent_ = true;
    return bounds_;
}

GpuScene::MaterialTextures GpuScene::texturesOf(const Material& material) {
    return {{material.baseColorTexture.texture, material.metallicRoughnessTexture.texture,
             material.normalTexture.texture, material.emissiveTexture.texture,
             material.specularTexture.texture, material.specularColorTexture.texture}};
}

void GpuScene::uploadMaterials(const Scene& source) {
    for (const Material& material : source.materials) {
        materials_.push_back(packedMaterial(material));
        materialTextures_.push_back(texturesOf(material));
    }
    materials_.push_back(packedMaterial(Material{}));
    materialTextures_.push_back({{-1, -1, -1, -1, -1, -1}});
    materialBuffer_ = gl::Buffer(materials_, "scene materials");
}

void GpuScene::uploadTextures(const Scene& source) {
    const std::uint8_t white[4] = {255, 255, 255, 255};
    white_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA8, 1, 1, 1, 1}, "white");
    white_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, white);
    // Mesa's software driver compiles and runs anisotropic lookups tens of times slower than trilinear ones.
    const float anisotropy = gl::isSoftwareDriver() ? 1.0f : 8.0f;
    for (const Texture& texture : source.textures) {
        const std::string label = "texture " + texture.name;
        gl::Texture t({GL_TEXTURE_2D, static_cast<std::uint32_t>(texture.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8),
                       texture.width, texture.height, 1, 0},
                      label);
        t.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, texture.rgba.data());
        t.generateMipmaps();
        textures_.push_back(std::move(t));
        const bool nearest = texture.filter == TextureFilter::Nearest;
        samplers_.emplace_back(
            gl::SamplerDesc{
                static_cast<std::uint32_t>(nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR),
                static_cast<std::uint32_t>(nearest ? GL_NEAREST : GL_LINEAR), wrapMode(texture.wrapU),
                wrapMode(texture.wrapV), false, anisotropy},
            label);
    }
    // The surface array has at least one (white) layer so that it can always be bound.
    const int layers = std::max<int>(static_cast<int>(source.textures.size()), 1);
    const int edge = source.textures.empty() ? 1 : kSurfaceEdge;
    surfaceArray_ =
        gl::Texture({GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, edge, edge, layers, 0}, "surface array");
    if (source.textures.empty()) surfaceArray_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, white);
    for (std::size_t i = 0; i < source.textures.size(); ++i) {
        std::vector<glm::vec4> level = linearSurface(source.textures[i]);
        for (int mip = 0; mip < surfaceArray_.desc().levels; ++mip) {
            surfaceArray_.uploadLayer(mip, static_cast<int>(i), GL_RGBA, GL_UNSIGNED_BYTE,
                                      encodedSurface(level).data());
            level = halved(level, static_cast<std::size_t>(surfaceArray_.width(mip)));
        }
    }
    surfaceSampler_ = gl::Sampler({GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT}, "surface array");
}

void GpuScene::setLights(const std::vector<Light>& lights) {
    updateLights(packedLights(lights));
    ++lightRevision_;
}

void GpuScene::setLitExactly(std::size_t instance, bool lit) {
    gpu::Instance& g = instances_[instance];
    const std::uint32_t flags = lit ? g.flags | INSTANCE_LIT_EXACTLY : g.flags & ~INSTANCE_LIT_EXACTLY;
    if (flags == g.flags) return;
    g.flags = flags;
    uploadInstance(instance);
}

void GpuScene::updateLights(const std::vector<gpu::Light>& lights) {
    if (!lightBuffer_ || lights.size() * sizeof(gpu::Light) > lightBuffer_.bytes())
        lightBuffer_ = gl::Buffer(lights, "scene lights");
    else
        lightBuffer_.update(0, lights.data(), lights.size() * sizeof(gpu::Light));
    lights_ = lights;
}

void GpuScene::bind() const {
    vertexBuffer_.bindStorage(BINDING_VERTICES);
    indexBuffer_.bindStorage(BINDING_INDICES);
    instanceBuffer_.bindStorage(BINDING_INSTANCES);
    materialBuffer_.bindStorage(BINDING_MATERIALS);
    lightBuffer_.bindStorage(BINDING_LIGHTS);
    lightBuffer_.bindUniform(BINDING_FIXED_LIGHTS);
    surfaceArray_.bind(UNIT_SURFACE_ARRAY);
    surfaceSampler_.bind(UNIT_SURFACE_ARRAY);
}

void GpuScene::bindMaterialTextures(std::uint32_t material) const {
    for (unsigned slot = 0; slot < 6; ++slot) {
        const int texture = materialTextures_[material].slots[slot];
        const unsigned unit = UNIT_MATERIAL_BASE + slot;
        if (texture < 0) {
            white_.bind(unit);
            gl::unbindSampler(unit);
        } else {
            textures_[static_cast<std::size_t>(texture)].bind(unit);
            samplers_[static_cast<std::size_t>(texture)].bind(unit);
        }
    }
}

// Parts that follow each other in one draw.
void GpuScene::drawParts(std::uint32_t index, const PartFilter& part, int copies) const {
    const gpu::Instance& instance = instances_[index];
    std::uint32_t begin = 0;  // of those that are accepted but not drawn yet
    const auto drawTo = [&](std::uint32_t end) {
        if (begin < end)
            gl::drawIndexed({instance.firstIndex + begin, end - begin, instance.firstVertex, index, copies});
    };
    std::size_t number = instanceParts_[index];
    for (std::uint32_t first = 0; first < instance.indexCount; first += kPartIndices, ++number) {
        if (part(instance, partBounds_[number])) continue;
        drawTo(first);
        begin = first + kPartIndices;
    }
    drawTo(instance.indexCount);
}

void GpuScene::draw(const InstanceFilter& filter, gl::Cull cull, bool bindTextures, int copies,
                    const PartFilter& part) const {
    vertexArray_.bind();
    std::uint32_t boundMaterial = ~0u;
    // -1: nothing set yet, so that the first instance sets both.
    int boundDoubleSided = -1;
    int boundFlipped = -1;
    for (const std::uint32_t index : drawOrder_) {
        const gpu::Instance& instance = instances_[index];
        if ((instance.flags & INSTANCE_VISIBLE) == 0 || instance.indexCount == 0) continue;
        if (filter && !filter(instance)) continue;
        if (bindTextures && instance.material != boundMaterial) {
            bindMaterialTextures(instance.material);
            boundMaterial = instance.material;
        }
        const int doubleSided = (materials_[instance.material].flags & MATERIAL_DOUBLE_SIDED) != 0 ? 1 : 0;
        if (doubleSided != boundDoubleSided) {
            gl::setCull(doubleSided != 0 ? gl::Cull::None : cull);
            boundDoubleSided = doubleSided;
        }
        const int flipped = (instance.flags & INSTANCE_FLIPPED) != 0 ? 1 : 0;
        if (flipped != boundFlipped) {
            gl::setFrontFace(flipped == 0);
            boundFlipped = flipped;
        }
        if (part)
            drawParts(index, part, copies);
        else
            gl::drawIndexed({instance.firstIndex, instance.indexCount, instance.firstVertex, index, copies});
    }
}

}  // namespace conelight::scene
