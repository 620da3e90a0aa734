// SPDX-License-Identifier: MIT
// The scene as plain tables on the CPU: what exists, in metres and radiometric units, before anything is
// uploaded. Filled by hand or by conelight_io (glTF, OBJ, other formats, generated scenes);
// read by the renderer and by the path tracer, which both see exactly this.
//
// Conventions: right-handed, y up, metres, radians, linear Rec.709 RGB. Column vectors, worldFromObject.
// Triangles are counter-clockwise seen from their front. Texture coordinates: (0,0) is the first row's first
// texel (glTF's convention). Indices refer to the vectors of Scene; -1 means none.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/glm_layout.h"

namespace conelight {

// Axis-aligned box; empty when min > max.
struct Aabb {
    glm::vec3 min{3.4e38f};
    glm::vec3 max{-3.4e38f};
    bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    glm::vec3 center() const { return 0.5f * (min + max); }
    glm::vec3 extent() const { return empty() ? glm::vec3(0) : max - min; }
    void grow(const glm::vec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void grow(const Aabb& b) {
        min = glm::min(min, b.min);
        max = glm::max(max, b.max);
    }
    std::array<glm::vec3, 8> corners() const {
        std::array<glm::vec3, 8> all;
        for (unsigned i = 0; i < 8; ++i)
            all[i] = {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                      (i & 4) != 0 ? max.z : min.z};
        return all;
    }
    // Least box round this one's corners, taken through an affine transform; empty stays empty.
    Aabb transformed(const glm::mat4& transform) const {
        Aabb box;
        if (empty()) return box;
        for (const glm::vec3& corner : corners()) box.grow(glm::vec3(transform * glm::vec4(corner, 1)));
        return box;
    }
};

// Indexed triangles with one material per instance. Every attribute but `positions` may be empty; if not, it
// has as many elements as `positions`. Missing normals are flat, missing uvs (0,0), missing colours white.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // unit length
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec4> tangents;     // unit length; w = +-1: bitangent = w * cross(normal, tangent)
    std::vector<glm::vec4> colors;       // linear, multiplied onto the base colour (rgb) and opacity (a)
    std::vector<std::uint32_t> indices;  // multiple of 3

    std::size_t triangleCount() const { return indices.size() / 3; }
    CONELIGHT_API Aabb bounds() const;
};

enum class TextureWrap : std::uint8_t { Repeat, Clamp, Mirror };
enum class TextureFilter : std::uint8_t { Linear, Nearest };

// 8-bit RGBA image, rows from the top. `srgb` says whether rgb is sRGB-encoded (base colour, emission) or
// linear (normal, metallic-roughness). Alpha is always linear.
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    bool srgb = true;
    TextureWrap wrapU = TextureWrap::Repeat;
    TextureWrap wrapV = TextureWrap::Repeat;
    TextureFilter filter = TextureFilter::Linear;
    std::vector<std::uint8_t> rgba;  // 4 * width * height
};

// A use of a texture by a material: which one, and uv' = uvFromUv * (uv, 1) (KHR_texture_transform).
struct TextureRef {
    int texture = -1;
    glm::mat3 uvFromUv{1.0f};
    bool used() const { return texture >= 0; }
    bool operator==(const TextureRef&) const = default;
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

// Phong's model with an ambient part, as mode `phong` shows it. Radiance per light: (ambient + diffuse * n.l
// + specular * (v.r)^shininess) * lightColor * color / attenuation.
struct PhongMaterial {
    glm::vec3 color{0.85f};  // linear, [0,1]
    float shininess = 32.0f;
    float ambientStrength = 0.08f;
    float diffuseStrength = 1.0f;
    float specularStrength = 0.5f;
    bool operator==(const PhongMaterial&) const = default;
};

// glTF metallic-roughness with KHR_materials_specular, _ior, _transmission, _volume, _clearcoat, _sheen,
// _emissive_strength and _unlit.
struct Material {
    std::string name;
    glm::vec4 baseColor{0.8f, 0.8f, 0.8f, 1.0f};  // rgb: albedo (dielectric) or F0 (metal), [0,1]; a: opacity
    float metallic = 0.0f;                        // [0,1]
    float roughness = 1.0f;                       // perceptual, [0,1]; GGX alpha = roughness^2
    float ior = 1.5f;                             // >= 1; dielectric F0 = ((ior-1)/(ior+1))^2; 0: F0 = 1
    float specular = 1.0f;                        // [0,1], scales the dielectric specular lobe
    glm::vec3 specularColor{1.0f};                // >= 0, tints dielectric F0 (F0 is clamped to 1)
    glm::vec3 emission{0.0f};  // radiance, W/(sr m^2), of the front face (both if doubleSided)
    float normalScale = 1.0f;
    float alphaCutoff = 0.5f;  // AlphaMode::Mask: below it there is no surface
    AlphaMode alphaMode = AlphaMode::Opaque;
    bool doubleSided = false;
    bool unlit = false;  // shows baseColor as radiance; neither receives nor bounces light
    // Glass: share of the light below a dielectric's gloss, [0,1], that goes through, tinted by baseColor,
    // instead of being scattered back.
    float transmission = 0.0f;
    // 0: a thin pane, which bends no light; above, m: the closed surface of a solid that bends it by `ior`.
    // How far light goes in it is the mesh's business.
    float thickness = 0.0f;
    glm::vec3 attenuationColor{1.0f};  // (0,1]; what white light is after attenuationDistance in the solid
    float attenuationDistance = 0.0f;  // m, >= 0; 0: the solid is clear
    // Layers above all of this, not on glass. A clear coat of index 1.5, and below it the sheen of cloth.
    float coat = 0.0f;             // [0,1]; share of the surface that is coated
    float coatRoughness = 0.0f;    // perceptual, [0,1]
    float coatNormalScale = 1.0f;  // of coatNormalTexture
    glm::vec3 sheenColor{0.0f};    // [0,1]; black: none
    float sheenRoughness = 0.0f;   // perceptual, [0,1]

    TextureRef baseColorTexture;          // rgb * baseColor.rgb, a * baseColor.a
    TextureRef metallicRoughnessTexture;  // g: roughness, b: metallic
    TextureRef normalTexture;             // tangent space
    TextureRef emissiveTexture;           // rgb * emission
    TextureRef specularTexture;           // a: specular
    TextureRef specularColorTexture;      // rgb: specularColor
    TextureRef transmissionTexture;       // r * transmission
    TextureRef coatTexture;               // r * coat
    TextureRef coatRoughnessTexture;      // g * coatRoughness
    TextureRef
        coatNormalTexture;  // tangent space; none: the coat lies smoothly over what normalTexture bends
    TextureRef sheenColorTexture;      // rgb * sheenColor
    TextureRef sheenRoughnessTexture;  // a * sheenRoughness

    std::optional<PhongMaterial> phong;  // what modes of that model show; none: phongFromPbr of the above

    bool operator==(const Material&) const = default;
};

// Readers and editors keep attenuation colours from here on: black would absorb without end.
inline constexpr float kLeastAttenuationColor = 1e-4f;

// Whether light goes through it.
inline bool isTransmissive(const Material& m) { return m.transmission > 0 && m.metallic < 1 && !m.unlit; }
// Whether it has a coat or sheen that shows.
inline bool hasLayers(const Material& m) {
    return (m.coat > 0 || m.sheenColor != glm::vec3(0)) && !isTransmissive(m) && !m.unlit;
}

// The Phong model of a metallic-roughness material, and the other way round: setPbrFromPhong sets what the
// model says and leaves the rest, `phong` too. The mapping is chosen so
// that a diffuse surface shows the same radiance in both (docs/theory/1_scene.md, "Two material models").
CONELIGHT_API PhongMaterial phongFromPbr(const Material& material);
CONELIGHT_API void setPbrFromPhong(Material& material, const PhongMaterial& phong);
// As the scene gives it, or else derived.
CONELIGHT_API PhongMaterial phongOf(const Material& material);

// What belongs together, as a tree of names: for lists and selections. Places are those of the instances and lights.
struct Group {
    std::string name;
    int parent = -1;  // a group before this one; -1: none
    bool operator==(const Group&) const = default;
};

// One placement of a mesh.
struct Instance {
    std::string name;
    int mesh = -1;
    int material = -1;  // -1: the default Material
    glm::mat4 worldFromObject{1.0f};
    bool visible = true;      // false: in no pass at all
    bool voxelized = true;    // false: drawn, but neither occludes nor bounces nor emits
    bool castsShadow = true;  // false: left out of shadow maps and shadow rays
    bool dynamic = false;     // it moves: light is not baked on it (mode hybrid), and nothing else
    int group = -1;           // that it belongs to; -1: none
    bool operator==(const Instance&) const = default;
};

enum class LightType : std::uint8_t { Point, Spot, Directional, Rect, Disk, Sphere };
constexpr int kLightTypes = 6;
constexpr bool hasArea(LightType type) { return type >= LightType::Rect; }
constexpr bool hasDirection(LightType type) { return type != LightType::Point && type != LightType::Sphere; }

// How the strength of a point light or spot depends on the direction it leaves in, as of a real lamp: factors of its
// intensity on an even grid. Rows are angles from the light's direction, 0 to pi; columns run about it, the first along
// halfU as far as that is across the direction, a quarter later along cross(halfU, direction). Linear between them.
struct LightProfile {
    static constexpr int kRows = 361, kColumns = 144;
    std::string file;            // where it is from; empty: from nowhere
    std::string text;            // of the file (IES LM-63), as it was read
    std::vector<float> factors;  // kRows * kColumns, 0 to 1
    float candela = 0;           // as measured, where the factor is 1; 0: unknown
};

// A light. `intensity` is W/sr (point, spot), irradiance in W/m^2 on a plane facing it (directional) or
// radiance in W/(sr m^2) of the front face (rect, disk) or of the whole surface (sphere).
struct Light {
    std::string name;
    LightType type = LightType::Point;
    glm::vec3 intensity{1.0f};
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, -1.0f,
                        0.0f};  // unit; where light travels to (spot, directional, normal of rect and disk)
    // rect and disk, which is the ellipse in the rectangle: centre to edge; cross(halfU, halfV) need not point along
    // `direction`. sphere: the length of halfU is its radius.
    glm::vec3 halfU{0.5f, 0, 0};
    glm::vec3 halfV{0, 0, 0.5f};
    float innerAngle = 0.0f;         // spot: half angle of full intensity, rad, [0, outerAngle]
    float outerAngle = 0.78539816f;  // spot: half angle of zero intensity, rad, (innerAngle, pi/2]
    float range = 0.0f;              // glTF's range in metres, 0 = unlimited
    bool enabled = true;
    bool castsShadow = true;
    // A falloff of its own instead of the inverse square: intensity / (constant + linear d + quadratic d^2).
    bool customFalloff = false;
    glm::vec3 falloff{1.0f, 0.15f, 0.45f};        // constant, linear, quadratic
    std::shared_ptr<const LightProfile> profile;  // point, spot; shared by copies, never changed; null: none
    int group = -1;                               // that it belongs to; -1: none
    bool operator==(const Light&) const = default;
};

// Factor of a point light's or spot's intensity in the unit direction `away` from it, by its profile; 1 without one.
CONELIGHT_API float intensityFactor(const Light& light, const glm::vec3& away);

// Radiant flux, W: all that a light sends out, per channel. Point lights and spots as their intensity over all
// directions; area lights as their radiance over area and hemisphere. Nothing for a directional light, which has no
// end, and for a light with a falloff of its own, which has no physical unit.
CONELIGHT_API std::optional<glm::vec3> radiantFlux(const Light& light);
// Sets the intensity by it, 0 or more, for the shape that the light has. False, and nothing is changed, where there
// is none.
CONELIGHT_API bool setRadiantFlux(Light& light, const glm::vec3& flux);

// Looks from eye to target: in perspective or, orthographic, by parallel rays.
struct Camera {
    std::string name;
    glm::vec3 eye{0, 0, 3};
    glm::vec3 target{0, 0, 0};
    glm::vec3 up{0, 1, 0};
    float fovY = 0.78539816f;  // vertical field of view, rad; kept when the picture's aspect changes
    float zNear = 0.01f;
    float zFar = 1000.0f;
    // A thin lens: what lies nearer or farther than the plane in focus is blurred.
    float lensDiameter = 0;   // m; 0: a pinhole, all is sharp
    float focusDistance = 0;  // along the view to the plane in focus, m; 0: through the target
    // Above 0: rays are parallel, and the picture is so high, m. Field of view and lens have no part then: all is sharp.
    float orthographicHeight = 0;  // 0: perspective
    float focus() const { return focusDistance > 0 ? focusDistance : glm::distance(eye, target); }
    bool isOrthographic() const { return orthographicHeight > 0; }
    bool hasLens() const { return lensDiameter > 0 && focus() > 0 && !isOrthographic(); }
    // m that the picture is high at a distance along the view.
    float heightAt(float distance) const {
        return isOrthographic() ? orthographicHeight : 2 * distance * std::tan(0.5f * fovY);
    }
    bool operator==(const Camera&) const = default;
};

// How a camera looks: unit vectors, right-handed as right, up, -forward.
struct CameraAxes {
    glm::dvec3 forward, right, up;
};
// A camera that looks along its up vector, or from a point to itself, still gets axes: the world axis least aligned
// with the view takes the place of up, -z that of the view.
CONELIGHT_API CameraAxes cameraAxes(const Camera& camera);

// A picture of surroundings: radiance by direction, W/(sr m^2), linear Rec.709. Latitude-longitude: rows run
// from straight up (+y) to straight down, columns once round the horizon.
struct EnvironmentImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;  // width * height, >= 0, finite
};

// Surroundings infinitely far away, from all directions. Their light adds to that of Scene::sky.
// Unrotated, the middle of the picture is seen along -z, and its right half towards +x.
struct Environment {
    std::string file;                               // where the picture is from; empty: from nowhere
    std::shared_ptr<const EnvironmentImage> image;  // shared by copies, never changed; null: black
    float rotation = 0.0f;  // of the surroundings about +y, rad, counter-clockwise as seen from above
    float strength = 1.0f;  // factor of the picture's radiance, >= 0
    bool used() const { return image != nullptr && strength > 0.0f; }
    bool operator==(const Environment&) const = default;
};

// Light computed once for what does not move: irradiance at points of its surfaces, interpolated between them. Mode
// `hybrid` shows it. It holds for instances that stand where they stood then; others gather their light anew.
struct BakedLight {
    // One side of an instance.
    struct Surface {
        int instance = -1;
        bool back = false;                // the side that its triangles face away from
        glm::mat4 worldFromObject{1.0f};  // of the instance, when it was baked
    };
    std::vector<Surface> surfaces;
    // Per vertex.
    std::vector<glm::vec3> positions;      // world, m
    std::vector<glm::vec3> irradiance;     // W/m^2, >= 0: all light but what comes straight from lights
    std::vector<std::uint32_t> surfaceOf;  // index of a surface, the same for the corners of a triangle
    std::vector<std::uint32_t> indices;    // multiple of 3; counter-clockwise seen from the surface's side
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Group> groups;
    std::vector<Camera> cameras;
    glm::vec3 sky{0.0f};  // constant radiance of the surroundings, W/(sr m^2)
    Environment environment;
    std::shared_ptr<const BakedLight> baked;  // shared by copies, never changed; null: nothing is baked
    // Name of the format whose conventions hold here, beside those above; empty: none. Such scenes were made
    // to be seen by Phong's model alone, without shadow maps or tone map, or in the mode of that name.
    std::string format;
    // Settings that the scene file asks for, KEY=VALUE in order (see settings.h); the caller applies them.
    std::vector<std::pair<std::string, std::string>> settings;
    // What the importer left out or changed, one line each, without the file name.
    std::vector<std::string> notes;

    // World bounds of all visible instances. O(vertices).
    CONELIGHT_API Aabb bounds() const;
    CONELIGHT_API std::size_t triangleCount() const;  // over visible instances

    // Throws Error(BadInput) that names the first element that breaks the rules above (an index out of range,
    // an attribute of the wrong length, a non-finite position or matrix, an instance that reaches further
    // than 1e15 m, a zero-size texture).
    CONELIGHT_API void validate() const;
};

// A camera that looks at the whole of `bounds` from the front (+z) and slightly above, 45 degrees vertical.
CONELIGHT_API Camera frameCamera(const Aabb& bounds);

// Where a unit direction lies in an environment's picture, unrotated, and back: [0,1) from the left, [0,1] from
// the top.
CONELIGHT_API glm::vec2 environmentUv(const glm::vec3& direction);
CONELIGHT_API glm::vec3 environmentDirection(const glm::vec2& uv);

// Takes the sun out of the environment's picture and adds it as a directional light, whose shadows are sharp and
// whose light is free of noise. False, and nothing is changed, when no spot of 4 degrees' radius gives more than a
// twentieth of the picture's light.
CONELIGHT_API bool splitSun(Scene& scene);

// Adds what a scene needs to be seen: a camera when there is none, inside if the scene is a room; and a studio with a
// ground (studio.h), in rooms a lamp, when there is no light, no emission and no sky. What was added is appended to
// `notes`. docs/theory/1_scene.md, "What a scene lacks".
CONELIGHT_API void completeScene(Scene& scene);

}  // namespace conelight
