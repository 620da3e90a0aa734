// SPDX-License-Identifier: MIT
// The CPU scene tables: bounds, validation, measures of lights, and the two models of materials.
#include "conelight/scene.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "base/log.h"
#include "conelight/scene_fields.h"
#include "scene/light_profile.h"
#include "scene/scene_checks.h"

namespace conelight {

Aabb Mesh::bounds() const {
    Aabb box;
    for (const glm::vec3& p : positions) box.grow(p);
    return box;
}

Aabb Scene::bounds() const {
    Aabb box;
    for (const Instance& instance : instances) {
        if (!instance.visible || instance.mesh < 0) continue;
        for (const glm::vec3& p : meshes[static_cast<std::size_t>(instance.mesh)].positions)
            box.grow(glm::vec3(instance.worldFromObject * glm::vec4(p, 1)));
    }
    return box;
}

std::size_t Scene::triangleCount() const {
    std::size_t count = 0;
    for (const Instance& instance : instances)
        if (instance.visible && instance.mesh >= 0)
            count += meshes[static_cast<std::size_t>(instance.mesh)].triangleCount();
    return count;
}

namespace {

using base::fail;

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isFinite(const glm::vec4& v) { return isFinite(glm::vec3(v)) && std::isfinite(v.w); }

bool isFinite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

// Names, choices, indices are.
template <class T>
bool isFinite(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
        return std::isfinite(value);
    else
        return true;
}

void checkMesh(const Mesh& mesh, std::size_t index) {
    const auto where = [&] { return base::format("mesh %zu '%s'", index, mesh.name.c_str()); };
    const std::size_t count = mesh.positions.size();
    const auto attribute = [&](const char* name, std::size_t size) {
        if (size != 0 && size != count)
            fail(ErrorKind::BadInput, "%s: %zu %s for %zu positions; as many or none would be right",
                 where().c_str(), size, name, count);
    };
    attribute("normals", mesh.normals.size());
    attribute("uvs", mesh.uvs.size());
    attribute("tangents", mesh.tangents.size());
    attribute("colors", mesh.colors.size());
    if (mesh.indices.size() % 3 != 0)
        fail(ErrorKind::BadInput, "%s: %zu indices; a multiple of 3 would be right", where().c_str(),
             mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        if (mesh.indices[i] >= count)
            fail(ErrorKind::BadInput, "%s: index %zu is %u; less than %zu would be right", where().c_str(), i,
                 mesh.indices[i], count);
    for (std::size_t i = 0; i < count; ++i)
        if (!isFinite(mesh.positions[i]))
            fail(ErrorKind::BadInput, "%s: position %zu is not finite", where().c_str(), i);
}

// One number that is not finite would spread over the picture through every bounce. `kind` and `name`: of the
// object.
template <class T>
void validateNumbers(const T& object, const char* kind, const std::string& name) {
    visitFields(
        [&](const char* field, const auto& value) {
            if (!isFinite(value))
                fail(ErrorKind::BadInput, "%s '%s': %s is not finite", kind, name.c_str(), field);
        },
        object);
}

// Beyond it squares of lengths overflow in float, and the fault would show somewhere else.
constexpr float kFarthest = 1e15f;  // metres

void validateReach(const Instance& instance, std::size_t index, const Aabb& meshBounds) {
    if (meshBounds.empty()) return;
    for (const glm::vec3& corner : meshBounds.corners()) {
        const glm::vec3 at(instance.worldFromObject * glm::vec4(corner, 1));
        const float reach = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        if (!(reach <= kFarthest))
            fail(ErrorKind::BadInput,
                 "instance %zu '%s': reaches %.3g m from the origin; at most %.0e would be right", index,
                 instance.name.c_str(), double(reach), double(kFarthest));
    }
}

}  // namespace

void scene::validateMesh(const Mesh& mesh, std::size_t index) { checkMesh(mesh, index); }

void scene::validateReaches(const Scene& scene, std::size_t mesh, const Aabb& bounds) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].mesh == static_cast<int>(mesh)) validateReach(scene.instances[i], i, bounds);
}

void scene::validateLight(const Light& light) {
    validateNumbers(light, "light", light.name);
    if (light.profile == nullptr) return;
    constexpr std::size_t kSize = std::size_t{LightProfile::kRows} * LightProfile::kColumns;
    const std::vector<float>& factors = light.profile->factors;
    if (factors.size() != kSize ||
        !std::all_of(factors.begin(), factors.end(), [](float one) { return one >= 0 && one <= 1; }))
        fail(ErrorKind::BadInput, "light '%s': profile: %zu factors, each of 0 to 1, would be right",
             light.name.c_str(), kSize);
}

void scene::validateMaterial(const Scene& scene, const Material& material) {
    validateNumbers(material, "material", material.name);
    if (material.phong) validateNumbers(*material.phong, "material", material.name);
    const glm::vec3& color = material.attenuationColor;
    const bool glass = material.transmission >= 0 && material.transmission <= 1 && material.thickness >= 0 &&
                       std::min({color.r, color.g, color.b}) > 0 &&
                       std::max({color.r, color.g, color.b}) <= 1 && material.attenuationDistance >= 0;
    if (!glass)
        fail(ErrorKind::BadInput,
             "material '%s': transmission %g, thickness %g, attenuation colour %g %g %g at %g m; a "
             "transmission of 0 to 1, colours above 0 and up to 1, lengths of 0 or more would be right",
             material.name.c_str(), static_cast<double>(material.transmission),
             static_cast<double>(material.thickness), static_cast<double>(color.r),
             static_cast<double>(color.g), static_cast<double>(color.b),
             static_cast<double>(material.attenuationDistance));
    const glm::vec3& sheen = material.sheenColor;
    const auto isShare = [](float value) { return value >= 0 && value <= 1; };
    if (!isShare(material.coat) || !isShare(material.coatRoughness) || !isShare(sheen.r) ||
        !isShare(sheen.g) || !isShare(sheen.b) || !isShare(material.sheenRoughness))
        fail(ErrorKind::BadInput,
             "material '%s': coat %g of roughness %g, sheen %g %g %g of roughness %g; 0 to 1 each would be "
             "right",
             material.name.c_str(), static_cast<double>(material.coat),
             static_cast<double>(material.coatRoughness), static_cast<double>(sheen.r),
             static_cast<double>(sheen.g), static_cast<double>(sheen.b),
             static_cast<double>(material.sheenRoughness));
    visitFields(
        [&](const char* use, const auto& value) {
            if constexpr (std::is_same_v<decltype(value), const TextureRef&>)
                if (value.texture >= static_cast<int>(scene.textures.size()))
                    fail(ErrorKind::BadInput,
                         "material '%s': %s names texture %d; less than %zu would be right",
                         material.name.c_str(), use, value.texture, scene.textures.size());
        },
        material);
}

void scene::validateInstance(const Scene& scene, const Instance& instance, std::size_t index) {
    if (instance.mesh < 0 || instance.mesh >= static_cast<int>(scene.meshes.size()))
        fail(ErrorKind::BadInput, "instance %zu '%s': mesh %d; 0 or more and less than %zu would be right",
             index, instance.name.c_str(), instance.mesh, scene.meshes.size());
    if (instance.material >= static_cast<int>(scene.materials.size()))
        fail(ErrorKind::BadInput, "instance %zu '%s': material %d; less than %zu would be right", index,
             instance.name.c_str(), instance.material, scene.materials.size());
    if (!isFinite(instance.worldFromObject))
        fail(ErrorKind::BadInput, "instance %zu '%s': the transform is not finite", index,
             instance.name.c_str());
}

// A group after what it is in; things in groups that are there.
void scene::validateGroups(const Scene& scene) {
    const auto require = [](int group, std::size_t end, const char* kind, const std::string& name) {
        if (group < -1 || group >= static_cast<int>(end))
            fail(ErrorKind::BadInput, "%s '%s': group %d; -1 or more and less than %zu would be right", kind,
                 name.c_str(), group, end);
    };
    for (std::size_t i = 0; i < scene.groups.size(); ++i)
        require(scene.groups[i].parent, i, "group", scene.groups[i].name);
    for (const Instance& one : scene.instances) require(one.group, scene.groups.size(), "instance", one.name);
    for (const Light& one : scene.lights) require(one.group, scene.groups.size(), "light", one.name);
}

void scene::validateSky(const glm::vec3& sky) {
    if (!isFinite(sky)) fail(ErrorKind::BadInput, "sky: the radiance is not finite");
}

void scene::validateEnvironment(const Environment& environment) {
    const char* file = environment.file.c_str();
    if (!std::isfinite(environment.rotation) || !std::isfinite(environment.strength) ||
        environment.strength < 0)
        fail(ErrorKind::BadInput,
             "environment '%s': rotation %g, strength %g; a finite angle and a factor of 0 or more would be "
             "right",
             file, static_cast<double>(environment.rotation), static_cast<double>(environment.strength));
    if (environment.image == nullptr) return;
    const EnvironmentImage& image = *environment.image;
    const std::size_t texels = static_cast<std::size_t>(std::max(image.width, 0)) *
                               static_cast<std::size_t>(std::max(image.height, 0));
    if (texels == 0 || image.radiance.size() != texels)
        fail(ErrorKind::BadInput, "environment '%s': %d x %d texels and %zu radiances do not belong together",
             file, image.width, image.height, image.radiance.size());
    for (const glm::vec3& radiance : image.radiance)
        if (!isFinite(radiance) || glm::any(glm::lessThan(radiance, glm::vec3(0))))
            fail(ErrorKind::BadInput, "environment '%s': a radiance is negative or not finite", file);
}

void scene::validateBakedLight(const Scene& scene, const BakedLight& baked) {
    const std::size_t count = baked.positions.size();
    if (baked.irradiance.size() != count || baked.surfaceOf.size() != count)
        fail(ErrorKind::BadInput,
             "baked light: %zu positions, %zu irradiances and %zu surfaces; as many of each would be right",
             count, baked.irradiance.size(), baked.surfaceOf.size());
    for (const BakedLight::Surface& surface : baked.surfaces)
        if (surface.instance < 0 || surface.instance >= static_cast<int>(scene.instances.size()) ||
            !isFinite(surface.worldFromObject))
            fail(ErrorKind::BadInput,
                 "baked light: a surface of instance %d; a finite place of 0 or more and less than %zu would "
                 "be "
                 "right",
                 surface.instance, scene.instances.size());
    for (std::size_t i = 0; i < count; ++i)
        if (!isFinite(baked.positions[i]) || !isFinite(baked.irradiance[i]) ||
            glm::any(glm::lessThan(baked.irradiance[i], glm::vec3(0))) ||
            baked.surfaceOf[i] >= baked.surfaces.size())
            fail(ErrorKind::BadInput,
                 "baked light: vertex %zu; finite numbers, an irradiance of 0 or more and a surface that is "
                 "there "
                 "would be right",
                 i);
    if (baked.indices.size() % 3 != 0)
        fail(ErrorKind::BadInput, "baked light: %zu indices; a multiple of 3 would be right",
             baked.indices.size());
    for (const std::uint32_t index : baked.indices)
        if (index >= count)
            fail(ErrorKind::BadInput, "baked light: index %u; less than %zu would be right", index, count);
}

void scene::validateTexture(const Texture& texture) {
    const std::size_t texels = static_cast<std::size_t>(std::max(texture.width, 0)) *
                               static_cast<std::size_t>(std::max(texture.height, 0));
    if (texels == 0 || texture.rgba.size() != 4 * texels)
        fail(ErrorKind::BadInput, "texture '%s': %d x %d texels and %zu bytes do not belong together",
             texture.name.c_str(), texture.width, texture.height, texture.rgba.size());
}

void Scene::validate() const {
    for (std::size_t i = 0; i < meshes.size(); ++i) checkMesh(meshes[i], i);
    for (const Texture& texture : textures) scene::validateTexture(texture);
    for (const Material& material : materials) scene::validateMaterial(*this, material);
    std::vector<Aabb> meshBounds(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) meshBounds[i] = meshes[i].bounds();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        scene::validateInstance(*this, instances[i], i);
        validateReach(instances[i], i, meshBounds[static_cast<std::size_t>(instances[i].mesh)]);
    }
    for (const Light& light : lights) scene::validateLight(light);
    scene::validateGroups(*this);
    scene::validateSky(sky);
    scene::validateEnvironment(environment);
    if (baked != nullptr) scene::validateBakedLight(*this, *baked);
}

namespace {

// W for an intensity of 1; 0: there is none.
float fluxPerIntensity(const Light& light) {
    if (light.customFalloff) return 0;
    const float inner = std::cos(light.innerAngle), outer = std::cos(light.outerAngle);
    const bool spot = light.type == LightType::Spot;
    if (light.profile != nullptr && (spot || light.type == LightType::Point))
        return scene::profileFlux(light, spot ? inner : -2.0f, spot ? outer : -3.0f);
    switch (light.type) {
        case LightType::Point:
            return 4 * glm::pi<float>();
        case LightType::Spot:
            // Even within the inner cone; then the square of a ramp in the cosine, whose mean is a third.
            return 2 * glm::pi<float>() * (1 - inner + (inner - outer) / 3);
        case LightType::Sphere:
            return glm::pi<float>() * 4 * glm::pi<float>() * glm::dot(light.halfU, light.halfU);
        case LightType::Disk:
            return glm::pi<float>() * glm::pi<float>() * glm::length(glm::cross(light.halfU, light.halfV));
        case LightType::Rect:
            return glm::pi<float>() * 4 * glm::length(glm::cross(light.halfU, light.halfV));
        case LightType::Directional:
            return 0;
    }
    return 0;
}

}  // namespace

std::optional<glm::vec3> radiantFlux(const Light& light) {
    const float each = fluxPerIntensity(light);
    return each > 0 ? std::optional(each * light.intensity) : std::nullopt;
}

bool setRadiantFlux(Light& light, const glm::vec3& flux) {
    const float each = fluxPerIntensity(light);
    if (each > 0) light.intensity = flux / each;
    return each > 0;
}

// Lambert in both models: rho/pi * I and kd * color * c are equal when I = pi * c (docs/theory/1_scene.md).
PhongMaterial phongFromPbr(const Material& material) {
    PhongMaterial phong;
    const glm::vec3 albedo(material.baseColor);
    phong.color = albedo;
    phong.diffuseStrength = 1.0f - material.metallic;
    phong.ambientStrength = 0.0f;
    // Equal half-height width of the Blinn and GGX lobes: n = 2 / alpha^2 - 2.
    const float alpha = std::max(material.roughness * material.roughness, 0.01f);
    phong.shininess = std::clamp(2.0f / (alpha * alpha) - 2.0f, 1.0f, 1000.0f);
    phong.specularStrength = std::min(1.0f, 0.04f * material.specular + material.metallic);
    return phong;
}

PhongMaterial phongOf(const Material& material) {
    return material.phong ? *material.phong : phongFromPbr(material);
}

void setPbrFromPhong(Material& material, const PhongMaterial& phong) {
    // Inverse of the rule above; the specular weight grows with shininess so that walls of
    // shininess 1 and strength 0.01 stay diffuse and a mirror sphere of 256 and 1.3 mirrors. Chosen by eye.
    const float weight =
        std::clamp(phong.specularStrength, 0.0f, 1.0f) * phong.shininess / (phong.shininess + 62.0f);
    material.roughness = std::pow(2.0f / (std::max(phong.shininess, 0.0f) + 2.0f), 0.25f);
    material.metallic = 0.0f;
    // F0 = weight for a dielectric: specularColor scales the default 0.04.
    material.ior = 1.5f;
    material.specular = 1.0f;
    material.specularColor = glm::vec3(weight / 0.04f);
    const glm::vec3 albedo = glm::clamp(phong.color * phong.diffuseStrength, 0.0f, 1.0f) * (1.0f - weight);
    material.baseColor = glm::vec4(albedo, material.baseColor.a);
}

}  // namespace conelight
