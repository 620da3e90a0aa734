// SPDX-License-Identifier: MIT
#include "structs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace conelight::c {
namespace {

template <class Enum>
Enum enumOf(int value, int count, const char* what) {
    if (value < 0 || value >= count)
        failUsage(std::string(what) + ": " + std::to_string(value) + "; 0 to " + std::to_string(count - 1) +
                  " would be right");
    return static_cast<Enum>(value);
}

// `count` vectors of the caller's array; nothing of NULL.
template <class Vector>
std::vector<Vector> vectorsOf(const float* values, std::size_t count) {
    std::vector<Vector> vectors;
    if (values == nullptr) return vectors;
    vectors.resize(count);
    std::memcpy(static_cast<void*>(vectors.data()), values, count * sizeof(Vector));
    return vectors;
}

}  // namespace

glm::mat4 matrixOf(const float* columns) {
    glm::mat4 matrix;
    for (int i = 0; i < 4; ++i)
        matrix[i] = {columns[4 * i], columns[4 * i + 1], columns[4 * i + 2], columns[4 * i + 3]};
    return matrix;
}

namespace {

// What the caller's version has of a struct, which was `firstSize` bytes at first, over `values` for the rest.
template <class Struct>
void takeGrown(Struct& values, const Struct* given, std::size_t firstSize, const char* what) {
    const std::size_t size = need(given, what).size;
    if (size < firstSize)
        failUsage(std::string(what) + ": size " + std::to_string(size) + "; " +
                  std::to_string(sizeof(Struct)) + ", what the INIT macro sets, would be right");
    std::memcpy(static_cast<void*>(&values), given, std::min(size, sizeof values));
}

conelight_material wholeMaterial(const Material& before, const conelight_material* given, const char* what) {
    conelight_material values = CONELIGHT_MATERIAL_INIT;
    values.coat = before.coat;
    values.coat_roughness = before.coatRoughness;
    for (int i = 0; i < 3; ++i) values.sheen_color[i] = before.sheenColor[i];
    values.sheen_roughness = before.sheenRoughness;
    takeGrown(values, given, offsetof(conelight_material, coat), what);
    return values;
}

}  // namespace

conelight_renderer_options optionsOf(const conelight_renderer_options* given) {
    conelight_renderer_options values = CONELIGHT_RENDERER_OPTIONS_INIT;
    if (given != nullptr)
        takeGrown(values, given, offsetof(conelight_renderer_options, top_first), "options");
    return values;
}

void assign(Material& material, const conelight_material* given, const char* what) {
    const conelight_material values = wholeMaterial(material, given, what);
    const AlphaMode mode = enumOf<AlphaMode>(values.alpha, 3, "material.alpha");
    material.name = textOf(values.name);
    material.baseColor = {vec3Of(values.base_color), values.base_color[3]};
    material.metallic = values.metallic;
    material.roughness = values.roughness;
    material.ior = values.ior;
    material.specular = values.specular;
    material.specularColor = vec3Of(values.specular_color);
    material.emission = vec3Of(values.emission);
    material.normalScale = values.normal_scale;
    material.alphaCutoff = values.alpha_cutoff;
    material.transmission = values.transmission;
    material.thickness = values.thickness;
    material.attenuationColor = vec3Of(values.attenuation_color);
    material.attenuationDistance = values.attenuation_distance;
    material.alphaMode = mode;
    material.doubleSided = values.double_sided != 0;
    material.unlit = values.unlit != 0;
    material.baseColorTexture.texture = values.base_color_texture;
    material.metallicRoughnessTexture.texture = values.metallic_roughness_texture;
    material.normalTexture.texture = values.normal_texture;
    material.emissiveTexture.texture = values.emissive_texture;
    material.coat = values.coat;
    material.coatRoughness = values.coat_roughness;
    material.sheenColor = vec3Of(values.sheen_color);
    material.sheenRoughness = values.sheen_roughness;
}

void assign(Light& light, const conelight_light& values) {
    light.type = enumOf<LightType>(values.type, 6, "light.type");
    light.name = textOf(values.name);
    light.intensity = vec3Of(values.intensity);
    light.position = vec3Of(values.position);
    light.direction = vec3Of(values.direction);
    light.halfU = vec3Of(values.half_u);
    light.halfV = vec3Of(values.half_v);
    light.innerAngle = values.inner_angle;
    light.outerAngle = values.outer_angle;
    light.range = values.range;
    light.enabled = values.enabled != 0;
    light.castsShadow = values.casts_shadow != 0;
}

Instance instanceOf(const conelight_instance& values) {
    Instance instance;
    instance.name = textOf(values.name);
    instance.mesh = values.mesh;
    instance.material = values.material;
    instance.worldFromObject = matrixOf(values.world_from_object);
    instance.visible = values.visible != 0;
    instance.voxelized = values.voxelized != 0;
    instance.castsShadow = values.casts_shadow != 0;
    instance.dynamic = values.dynamic != 0;
    return instance;
}

Mesh meshOf(const conelight_mesh& values) {
    if (values.vertex_count > 0) need(values.positions, "mesh.positions");
    if (values.index_count > 0) need(values.indices, "mesh.indices");
    if (values.index_count % 3 != 0)
        failUsage("mesh.index_count: " + std::to_string(values.index_count) +
                  "; a multiple of 3 would be right");
    Mesh mesh;
    mesh.name = textOf(values.name);
    mesh.positions = vectorsOf<glm::vec3>(values.positions, values.vertex_count);
    mesh.normals = vectorsOf<glm::vec3>(values.normals, values.vertex_count);
    mesh.uvs = vectorsOf<glm::vec2>(values.uvs, values.vertex_count);
    mesh.tangents = vectorsOf<glm::vec4>(values.tangents, values.vertex_count);
    mesh.colors = vectorsOf<glm::vec4>(values.colors, values.vertex_count);
    if (values.index_count > 0) mesh.indices.assign(values.indices, values.indices + values.index_count);
    return mesh;
}

namespace {

HostAttribute attributeOf(const conelight_attribute& values) {
    constexpr int kEncodings = static_cast<int>(HostEncoding::Unorm8) + 1;
    return {values.buffer, values.offset, values.stride,
            enumOf<HostEncoding>(values.encoding, kEncodings, "attribute.encoding")};
}

}  // namespace

HostMesh hostMeshOf(const conelight_host_mesh& values) {
    HostMesh mesh;
    mesh.name = textOf(values.name);
    mesh.vertexCount = values.vertex_count;
    mesh.indexCount = values.index_count;
    mesh.positions = attributeOf(values.positions);
    mesh.normals = attributeOf(values.normals);
    mesh.uvs = attributeOf(values.uvs);
    mesh.tangents = attributeOf(values.tangents);
    mesh.colors = attributeOf(values.colors);
    mesh.indices = values.indices;
    mesh.indexOffset = values.index_offset;
    mesh.shortIndices = values.short_indices != 0;
    mesh.bounds = {vec3Of(values.low), vec3Of(values.high)};
    return mesh;
}

HostTexture hostTextureOf(const conelight_host_texture& values) {
    const TextureWrap wrap = values.clamp != 0 ? TextureWrap::Clamp : TextureWrap::Repeat;
    return {.name = textOf(values.name),
            .texture = values.texture,
            .wrapU = wrap,
            .wrapV = wrap,
            .filter = values.nearest != 0 ? TextureFilter::Nearest : TextureFilter::Linear};
}

Texture textureOf(const conelight_texture& values) {
    constexpr std::int32_t kMostPixels = 1 << 15;  // each way: 4 GiB in all
    if (values.width < 1 || values.height < 1 || values.width > kMostPixels || values.height > kMostPixels)
        failUsage("texture: " + std::to_string(values.width) + " x " + std::to_string(values.height) +
                  " pixels; 1 to 32768 each way would be right");
    const std::uint8_t* first = &need(values.rgba, "texture.rgba");
    const auto pixels = static_cast<std::size_t>(values.width) * static_cast<std::size_t>(values.height);
    Texture texture;
    texture.name = textOf(values.name);
    texture.width = values.width;
    texture.height = values.height;
    texture.srgb = values.srgb != 0;
    texture.filter = values.nearest != 0 ? TextureFilter::Nearest : TextureFilter::Linear;
    texture.wrapU = texture.wrapV = values.clamp != 0 ? TextureWrap::Clamp : TextureWrap::Repeat;
    texture.rgba.assign(first, first + 4 * pixels);
    return texture;
}

Camera cameraOf(const conelight_camera& values) {
    Camera camera;
    camera.eye = vec3Of(values.eye);
    camera.target = vec3Of(values.target);
    camera.up = vec3Of(values.up);
    camera.fovY = values.fov_y;
    camera.zNear = values.z_near;
    camera.zFar = values.z_far;
    camera.orthographicHeight = values.orthographic_height;
    const float side = glm::length(glm::cross(camera.target - camera.eye, camera.up));
    if (!std::isfinite(side) || side <= 0)
        failUsage("camera: eye, target and up give no view; finite ones, not on one line, would be right");
    if (!(camera.fovY > 0 && camera.fovY < 3.1415926f))
        failUsage("camera.fov_y: " + std::to_string(camera.fovY) + "; above 0 and below pi would be right");
    if (!(camera.orthographicHeight >= 0 && std::isfinite(camera.orthographicHeight)))
        failUsage("camera.orthographic_height: " + std::to_string(camera.orthographicHeight) +
                  "; above 0, or 0, would be right");
    if (!(camera.zNear > 0 && camera.zFar > camera.zNear && std::isfinite(camera.zFar)))
        failUsage("camera: z_near " + std::to_string(camera.zNear) + ", z_far " +
                  std::to_string(camera.zFar) + "; 0 < z_near < z_far would be right");
    return camera;
}

conelight_light valuesOf(const Light& light) {
    conelight_light values = CONELIGHT_LIGHT_INIT;
    values.name = light.name.c_str();
    values.type = static_cast<int>(light.type);
    put(values.intensity, light.intensity);
    put(values.position, light.position);
    put(values.direction, light.direction);
    put(values.half_u, light.halfU);
    put(values.half_v, light.halfV);
    values.inner_angle = light.innerAngle;
    values.outer_angle = light.outerAngle;
    values.range = light.range;
    values.enabled = light.enabled ? 1 : 0;
    values.casts_shadow = light.castsShadow ? 1 : 0;
    return values;
}

conelight_instance valuesOf(const Instance& instance) {
    conelight_instance values = CONELIGHT_INSTANCE_INIT;
    values.name = instance.name.c_str();
    values.mesh = instance.mesh;
    values.material = instance.material;
    for (int i = 0; i < 4; ++i)
        std::copy_n(&instance.worldFromObject[i].x, 4, values.world_from_object + 4 * i);
    values.visible = instance.visible ? 1 : 0;
    values.voxelized = instance.voxelized ? 1 : 0;
    values.casts_shadow = instance.castsShadow ? 1 : 0;
    values.dynamic = instance.dynamic ? 1 : 0;
    return values;
}

conelight_camera valuesOf(const Camera& camera) {
    conelight_camera values = CONELIGHT_CAMERA_INIT;
    put(values.eye, camera.eye);
    put(values.target, camera.target);
    put(values.up, camera.up);
    values.fov_y = camera.fovY;
    values.z_near = camera.zNear;
    values.z_far = camera.zFar;
    values.orthographic_height = camera.orthographicHeight;
    return values;
}

}  // namespace conelight::c
