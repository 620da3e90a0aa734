// SPDX-License-Identifier: MIT
// The fields of a scene's structs, each with its name: one list per struct, from which checks, streams,
// hashes and edits are derived. A struct that has one field more, or one less, than its list does not
// compile.
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "conelight/scene.h"

namespace conelight {

// A field of some object. The name is the words that messages use.
template <class T>
struct Field {
    const char* name;
    T& value;
};
// Compilers before P1816 (Clang 16 and older) deduce nothing for aggregates.
template <class T>
Field(const char*, T&) -> Field<T>;

template <class T, class Struct>
concept FieldsFrom = std::same_as<std::remove_const_t<T>, Struct>;

// Every `fieldsOf` returns a tuple of Field, in the order of declaration. Its first line names all of the
// struct's members: the compiler refuses it when their number is another.
template <FieldsFrom<PhongMaterial> P>
auto fieldsOf(P& phong) {
    auto& [color, shininess, ambientStrength, diffuseStrength, specularStrength] = phong;
    return std::tuple{Field{"Phong colour", color}, Field{"Phong shininess", shininess},
                      Field{"Phong ambient strength", ambientStrength},
                      Field{"Phong diffuse strength", diffuseStrength},
                      Field{"Phong specular strength", specularStrength}};
}

template <FieldsFrom<Material> M>
auto fieldsOf(M& material) {
    auto& [name, baseColor, metallic, roughness, ior, specular, specularColor, emission, normalScale,
           alphaCutoff, alphaMode, doubleSided, unlit, transmission, thickness, attenuationColor,
           attenuationDistance, coat, coatRoughness, coatNormalScale, sheenColor, sheenRoughness,
           baseColorTexture, metallicRoughnessTexture, normalTexture, emissiveTexture, specularTexture,
           specularColorTexture, transmissionTexture, coatTexture, coatRoughnessTexture, coatNormalTexture,
           sheenColorTexture, sheenRoughnessTexture, phong] = material;
    return std::tuple{Field{"name", name},
                      Field{"base colour", baseColor},
                      Field{"metallic", metallic},
                      Field{"roughness", roughness},
                      Field{"ior", ior},
                      Field{"specular", specular},
                      Field{"specular colour", specularColor},
                      Field{"emission", emission},
                      Field{"normal scale", normalScale},
                      Field{"alpha cutoff", alphaCutoff},
                      Field{"alpha mode", alphaMode},
                      Field{"double-sided", doubleSided},
                      Field{"unlit", unlit},
                      Field{"transmission", transmission},
                      Field{"thickness", thickness},
                      Field{"attenuation colour", attenuationColor},
                      Field{"attenuation distance", attenuationDistance},
                      Field{"coat", coat},
                      Field{"coat roughness", coatRoughness},
                      Field{"coat normal scale", coatNormalScale},
                      Field{"sheen colour", sheenColor},
                      Field{"sheen roughness", sheenRoughness},
                      Field{"base colour", baseColorTexture},
                      Field{"metallic-roughness", metallicRoughnessTexture},
                      Field{"normal", normalTexture},
                      Field{"emission", emissiveTexture},
                      Field{"specular", specularTexture},
                      Field{"specular colour", specularColorTexture},
                      Field{"transmission", transmissionTexture},
                      Field{"coat", coatTexture},
                      Field{"coat roughness", coatRoughnessTexture},
                      Field{"coat normal", coatNormalTexture},
                      Field{"sheen colour", sheenColorTexture},
                      Field{"sheen roughness", sheenRoughnessTexture},
                      Field{"Phong", phong}};
}

template <FieldsFrom<Instance> I>
auto fieldsOf(I& instance) {
    auto& [name, mesh, material, worldFromObject, visible, voxelized, castsShadow, dynamic, group] = instance;
    return std::tuple{Field{"name", name},
                      Field{"mesh", mesh},
                      Field{"material", material},
                      Field{"transform", worldFromObject},
                      Field{"visible", visible},
                      Field{"voxelized", voxelized},
                      Field{"casts shadow", castsShadow},
                      Field{"dynamic", dynamic},
                      Field{"group", group}};
}

template <FieldsFrom<Light> L>
auto fieldsOf(L& light) {
    auto& [name, type, intensity, position, direction, halfU, halfV, innerAngle, outerAngle, range, enabled,
           castsShadow, customFalloff, falloff, profile, group] = light;
    return std::tuple{Field{"name", name},
                      Field{"type", type},
                      Field{"intensity", intensity},
                      Field{"position", position},
                      Field{"direction", direction},
                      Field{"first edge", halfU},
                      Field{"second edge", halfV},
                      Field{"inner angle", innerAngle},
                      Field{"outer angle", outerAngle},
                      Field{"range", range},
                      Field{"enabled", enabled},
                      Field{"casts shadow", castsShadow},
                      Field{"own falloff", customFalloff},
                      Field{"falloff", falloff},
                      Field{"profile", profile},
                      Field{"group", group}};
}

template <FieldsFrom<Group> G>
auto fieldsOf(G& group) {
    auto& [name, parent] = group;
    return std::tuple{Field{"name", name}, Field{"parent", parent}};
}

template <FieldsFrom<Camera> C>
auto fieldsOf(C& camera) {
    auto& [name, eye, target, up, fovY, zNear, zFar, lensDiameter, focusDistance, orthographicHeight] =
        camera;
    return std::tuple{Field{"name", name},
                      Field{"eye", eye},
                      Field{"target", target},
                      Field{"up", up},
                      Field{"field of view", fovY},
                      Field{"near plane", zNear},
                      Field{"far plane", zFar},
                      Field{"lens diameter", lensDiameter},
                      Field{"focus distance", focusDistance},
                      Field{"orthographic height", orthographicHeight}};
}

// Calls visit(name, value, ...) for each field, with the values of all objects, which are of one struct.
template <class Visit, class First, class... Others>
void visitFields(const Visit& visit, First& first, Others&... others) {
    const auto at = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
        const auto field = std::get<I>(fieldsOf(first));
        visit(field.name, field.value, std::get<I>(fieldsOf(others)).value...);
    };
    using Fields = decltype(fieldsOf(first));
    [&]<std::size_t... I>(std::index_sequence<I...>) { (at(std::integral_constant<std::size_t, I>{}), ...); }
    (std::make_index_sequence<std::tuple_size_v<Fields>>{});
}

}  // namespace conelight
