// SPDX-License-Identifier: MIT
#include "parts.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <type_traits>

#include "arrays.h"
#include "calls.h"
#include "io/scene_info.h"

namespace conelight::python {
namespace {

template <auto Member>
struct MemberOf;
template <class S, class T, T S::*Member>
struct MemberOf<Member> {
    using Struct = S;
    using Type = T;
};

template <class T>
T castTo(const py::handle& value) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw Error(ErrorKind::Usage,
                    fmt::format("{} is of the wrong type; {} would be right", std::string(py::repr(value)),
                                std::is_same_v<T, bool>          ? "True or False"
                                : std::is_same_v<T, std::string> ? "text"
                                : std::is_integral_v<T>          ? "a whole number"
                                                                 : "a number"));
    }
}

// Attributes whose Python value is that of the field.
template <auto Member>
constexpr Attribute<typename MemberOf<Member>::Struct> plain(const char* name, const char* doc) {
    using T = typename MemberOf<Member>::Struct;
    using Value = typename MemberOf<Member>::Type;
    constexpr auto read = [](const T& object) -> py::object {
        if constexpr (std::is_same_v<Value, glm::vec3> || std::is_same_v<Value, glm::vec4>)
            return tupleOf(object.*Member);
        else if constexpr (std::is_same_v<Value, glm::mat4>)
            return arrayOf(object.*Member);
        else
            return py::cast(object.*Member);
    };
    constexpr auto write = [](T& object, const py::handle& value) {
        if constexpr (std::is_same_v<Value, glm::vec3>)
            object.*Member = vec3Of("", value);
        else if constexpr (std::is_same_v<Value, glm::vec4>)
            object.*Member = vec4Of("", value);
        else if constexpr (std::is_same_v<Value, glm::mat4>)
            object.*Member = mat4Of("", value);
        else
            object.*Member = castTo<Value>(value);
    };
    return {name, +read, +write, doc};
}

// Index or None.
template <int Instance::*Member>
constexpr Attribute<Instance> optionalIndex(const char* name, const char* doc) {
    constexpr auto read = [](const Instance& object) -> py::object {
        return object.*Member < 0 ? py::none() : py::object(py::int_(object.*Member));
    };
    constexpr auto write = [](Instance& object, const py::handle& value) {
        object.*Member = value.is_none() ? -1 : castTo<int>(value);
    };
    return {name, +read, +write, doc};
}

template <TextureRef Material::*Member>
constexpr Attribute<Material> texture(const char* name, const char* doc) {
    constexpr auto read = [](const Material& object) -> py::object {
        const TextureRef& use = object.*Member;
        return use.used() ? py::object(py::int_(use.texture)) : py::none();
    };
    constexpr auto write = [](Material& object, const py::handle& value) {
        (object.*Member).texture = value.is_none() ? -1 : castTo<int>(value);
    };
    return {name, +read, +write, doc};
}

template <class Enum>
struct Word {
    const char* word;
    Enum value;
};
constexpr Word<AlphaMode> kAlphaModes[] = {
    {"opaque", AlphaMode::Opaque}, {"mask", AlphaMode::Mask}, {"blend", AlphaMode::Blend}};
constexpr Word<TextureWrap> kWraps[] = {
    {"repeat", TextureWrap::Repeat}, {"clamp", TextureWrap::Clamp}, {"mirror", TextureWrap::Mirror}};
constexpr Word<TextureFilter> kFilters[] = {{"linear", TextureFilter::Linear},
                                            {"nearest", TextureFilter::Nearest}};

template <class Enum, std::size_t N>
Enum valueOf(const char* what, const Word<Enum> (&words)[N], const std::string& word) {
    std::string known;
    for (const Word<Enum>& one : words) {
        if (word == one.word) return one.value;
        known += (known.empty() ? "" : ", ") + std::string(one.word);
    }
    throw Error(ErrorKind::Usage,
                fmt::format("{}there is no '{}'; one of {} would be right", what, word, known));
}

py::object readAlphaMode(const Material& material) {
    for (const Word<AlphaMode>& one : kAlphaModes)
        if (one.value == material.alphaMode) return py::str(one.word);
    return py::none();
}
void writeAlphaMode(Material& material, const py::handle& value) {
    material.alphaMode = valueOf("", kAlphaModes, castTo<std::string>(value));
}

py::object readDirection(const Light& light) { return tupleOf(light.direction); }
void writeDirection(Light& light, const py::handle& value) {
    const glm::vec3 direction = vec3Of("", value);
    const float length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length))
        throw Error(ErrorKind::Usage, "has no length; a vector that points somewhere would be right");
    // A unit vector stays as it is, bit for bit.
    light.direction = std::abs(length - 1) < 1e-6f ? direction : direction / length;
}

py::object readFlux(const Light& light) {
    const std::optional<glm::vec3> flux = radiantFlux(light);
    return flux ? py::object(tupleOf(*flux)) : py::none();
}
void writeFlux(Light& light, const py::handle& value) {
    if (!setRadiantFlux(light, vec3Of("", value)))
        throw Error(ErrorKind::Usage, fmt::format("lights of type {} with these numbers have none; "
                                                  "intensity would be right",
                                                  io::lightTypeName(light.type)));
}

}  // namespace

const std::vector<Attribute<Material>>& materialAttributes() {
    static const std::vector<Attribute<Material>> all = {
        plain<&Material::name>("name", "Text."),
        plain<&Material::baseColor>("base_color",
                                    "Albedo, or F0 of metals, linear, and opacity: (4,), 0 to 1."),
        plain<&Material::metallic>("metallic", "0 to 1."),
        plain<&Material::roughness>("roughness", "Perceptual, 0 to 1."),
        plain<&Material::ior>("ior", "Index of refraction, 1 or more; decides F0 of dielectrics."),
        plain<&Material::specular>("specular", "Scale of the dielectric lobe, 0 to 1."),
        plain<&Material::specularColor>("specular_color", "Tint of dielectric F0: (3,)."),
        plain<&Material::emission>("emission", "Radiance of the front face, W/(sr m^2): (3,)."),
        plain<&Material::normalScale>("normal_scale", "Scale of the normal texture."),
        plain<&Material::alphaCutoff>("alpha_cutoff", "alpha_mode mask: below it there is no surface."),
        {"alpha_mode", readAlphaMode, writeAlphaMode, "'opaque', 'mask' or 'blend'."},
        plain<&Material::doubleSided>("double_sided", "Whether backs are surfaces, too."),
        plain<&Material::unlit>("unlit", "Shows base_color as radiance; neither receives nor bounces light."),
        plain<&Material::transmission>("transmission", "Share of light that glass lets through, 0 to 1."),
        plain<&Material::thickness>("thickness",
                                    "Of glass: 0 a thin pane, above a solid that bends light; m."),
        plain<&Material::attenuationColor>("attenuation_color",
                                           "Of white light after attenuation_distance in a solid: (3,)."),
        plain<&Material::attenuationDistance>("attenuation_distance", "m; 0: the solid is clear."),
        plain<&Material::coat>("coat", "Share of the surface that has a clear coat, 0 to 1; not of glass."),
        plain<&Material::coatRoughness>("coat_roughness", "Of the coat, perceptual, 0 to 1."),
        plain<&Material::coatNormalScale>("coat_normal_scale", "Scale of the coat's normal texture."),
        plain<&Material::sheenColor>("sheen_color", "Sheen of cloth, below the coat: (3,), 0 to 1."),
        plain<&Material::sheenRoughness>("sheen_roughness", "Of the sheen, perceptual, 0 to 1."),
        texture<&Material::baseColorTexture>("base_color_texture", "Index of a texture, or None."),
        texture<&Material::metallicRoughnessTexture>("metallic_roughness_texture", "Index or None; g, b."),
        texture<&Material::normalTexture>("normal_texture", "Index or None; tangent space."),
        texture<&Material::emissiveTexture>("emissive_texture", "Index or None."),
        texture<&Material::specularTexture>("specular_texture", "Index or None; alpha."),
        texture<&Material::specularColorTexture>("specular_color_texture", "Index or None."),
        texture<&Material::transmissionTexture>("transmission_texture", "Index or None; r."),
        texture<&Material::coatTexture>("coat_texture", "Index or None; r."),
        texture<&Material::coatRoughnessTexture>("coat_roughness_texture", "Index or None; g."),
        texture<&Material::coatNormalTexture>("coat_normal_texture", "Index or None; tangent space."),
        texture<&Material::sheenColorTexture>("sheen_color_texture", "Index or None."),
        texture<&Material::sheenRoughnessTexture>("sheen_roughness_texture", "Index or None; alpha."),
    };
    return all;
}

const std::vector<Attribute<Instance>>& instanceAttributes() {
    static const std::vector<Attribute<Instance>> all = {
        plain<&Instance::name>("name", "Text."),
        plain<&Instance::mesh>("mesh", "Index of its mesh."),
        optionalIndex<&Instance::material>("material", "Index of its material; None: the default material."),
        plain<&Instance::worldFromObject>("transform", "World from object: (4, 4), column vectors, metres."),
        plain<&Instance::visible>("visible", "False: in no pass at all."),
        plain<&Instance::voxelized>("voxelized", "False: drawn, but neither occludes nor bounces nor emits."),
        plain<&Instance::castsShadow>("casts_shadow",
                                      "False: blocks no light that comes straight from lights."),
        plain<&Instance::dynamic>("dynamic", "It moves: light is not baked on it."),
    };
    return all;
}

const std::vector<Attribute<Light>>& lightAttributes() {
    static const std::vector<Attribute<Light>> all = {
        plain<&Light::name>("name", "Text."),
        plain<&Light::intensity>(
            "intensity",
            "(3,): W/sr (point, spot), W/m^2 facing it (directional), W/(sr m^2) (rect, disk, sphere)."),
        plain<&Light::position>("position", "Metres: (3,); of area lights their centre."),
        {"direction", readDirection, writeDirection, "Where light travels to: (3,), made a unit vector."},
        plain<&Light::halfU>("half_u",
                             "rect, disk: centre to edge, metres: (3,); sphere: its length is the radius."),
        plain<&Light::halfV>("half_v", "rect, disk: centre to the other edge, metres: (3,)."),
        plain<&Light::innerAngle>("inner_angle", "spot: half angle of full intensity, radians."),
        plain<&Light::outerAngle>("outer_angle", "spot: half angle of zero intensity, radians."),
        plain<&Light::range>("range", "Metres; 0: unlimited."),
        plain<&Light::enabled>("enabled", "Whether it shines."),
        plain<&Light::castsShadow>("casts_shadow", "Whether things stop its light."),
        {"flux", readFlux, writeFlux,
         "Radiant flux, W: (3,); None for directional lights. Sets the intensity."},
    };
    return all;
}

LightType lightTypeOf(const std::string& name) {
    constexpr Word<LightType> kTypes[] = {
        {"point", LightType::Point}, {"spot", LightType::Spot}, {"directional", LightType::Directional},
        {"rect", LightType::Rect},   {"disk", LightType::Disk}, {"sphere", LightType::Sphere}};
    return valueOf("type: ", kTypes, name);
}

Mesh meshOf(const py::object& positions, const py::object& indices, const py::kwargs& attributes) {
    Keywords given("add_mesh", attributes);
    Mesh mesh;
    mesh.name = given.take("name", std::string());
    mesh.positions = vectorsOf<glm::vec3>("positions", positions);
    mesh.indices = indicesOf("indices", indices);
    const auto read = [&](const char* name, auto& values) {
        const py::object value = given.take(name);
        if (value.is_none()) return;
        using Vector = typename std::decay_t<decltype(values)>::value_type;
        values = vectorsOf<Vector>(name, value);
        if (values.size() != mesh.positions.size())
            throw Error(ErrorKind::Usage, fmt::format("{}: {} rows; {}, as many as positions, would be right",
                                                      name, values.size(), mesh.positions.size()));
    };
    read("normals", mesh.normals);
    read("uvs", mesh.uvs);
    read("tangents", mesh.tangents);
    read("colors", mesh.colors);
    given.finish();
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const float length = glm::length(mesh.normals[i]);
        if (!(length > 0) || !std::isfinite(length))
            throw Error(ErrorKind::Usage,
                        fmt::format("normals: row {} has no length; a unit vector would be right", i));
        if (std::abs(length - 1) > 1e-4f) mesh.normals[i] /= length;  // unit vectors stay as they are
    }
    for (const std::uint32_t index : mesh.indices)
        if (index >= mesh.positions.size())
            throw Error(ErrorKind::Usage,
                        fmt::format("indices: {}; less than {}, the number of positions, would be right",
                                    index, mesh.positions.size()));
    return mesh;
}

Texture textureOf(const py::object& pixels, const py::kwargs& options) {
    using Bytes = py::array_t<std::uint8_t, py::array::c_style>;
    Keywords given("add_texture", options);
    Texture texture;
    texture.name = given.take("name", std::string());
    texture.srgb = given.take("srgb", true);
    const std::string wrap = given.take("wrap", std::string("repeat"));
    texture.wrapU = texture.wrapV = valueOf("wrap: ", kWraps, wrap);
    texture.filter = valueOf("filter: ", kFilters, given.take("filter", std::string("linear")));
    given.finish();
    const bool isBytes =
        py::isinstance<py::array>(pixels) && py::array(pixels).dtype().is(py::dtype::of<std::uint8_t>());
    if (!isBytes)
        throw Error(ErrorKind::Usage,
                    "pixels: are no uint8; an array (height, width, 3 or 4) would be right");
    const Bytes bytes = Bytes::ensure(pixels);
    const py::ssize_t channels = bytes.ndim() == 3 ? bytes.shape(2) : 0;
    constexpr py::ssize_t kMost = 16384;
    if ((channels != 3 && channels != 4) || bytes.size() == 0 || bytes.shape(0) > kMost ||
        bytes.shape(1) > kMost)
        throw Error(ErrorKind::Usage,
                    fmt::format("pixels: have shape {}; (height, width, 3 or 4), at most {} a "
                                "side, would be right",
                                shapeText(bytes), kMost));
    texture.height = static_cast<int>(bytes.shape(0));
    texture.width = static_cast<int>(bytes.shape(1));
    const auto count = static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
    texture.rgba.resize(4 * count, 255);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(&texture.rgba[4 * i], bytes.data() + i * static_cast<std::size_t>(channels),
                    static_cast<std::size_t>(channels));
    return texture;
}

}  // namespace conelight::python
