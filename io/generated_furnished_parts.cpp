// SPDX-License-Identifier: MIT
// Parts of the scenes of the kinds that people model: sizes in m -> Mesh.
#include "io/generated_furnished.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace conelight::io::generated {

void makeTwoSided(Scene& scene) {
    for (Material& material : scene.materials) material.doubleSided = true;
}

int textured(Scene& scene, const char* name, Texture texture, float metres, glm::vec3 colour) {
    Material m = matte(name, colour);
    m.baseColorTexture = repeat(add(scene, std::move(texture)), metres);
    return add(scene, std::move(m));
}

Instance& Placer::put(Mesh mesh, std::string name, int material, const glm::mat4& thingFromPart) const {
    Instance& instance = addPart(scene, std::move(mesh), std::move(name), material);
    instance.worldFromObject = worldFromThing * thingFromPart;
    return instance;
}

Instance& Placer::put(Mesh mesh, std::string name, int material, glm::vec3 at) const {
    return put(std::move(mesh), std::move(name), material, translation(at));
}

Instance& Placer::again(int mesh, std::string name, int material, const glm::mat4& thingFromPart) const {
    return place(scene, mesh, material, std::move(name), worldFromThing * thingFromPart);
}

void merge(Mesh& mesh, const Mesh& more, const glm::mat4& place) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (const glm::vec3& p : more.positions) mesh.positions.emplace_back(place * glm::vec4(p, 1));
    for (const glm::vec3& n : more.normals) mesh.normals.push_back(glm::normalize(glm::mat3(place) * n));
    mesh.uvs.insert(mesh.uvs.end(), more.uvs.begin(), more.uvs.end());
    for (const std::uint32_t i : more.indices) mesh.indices.push_back(first + i);
}

void appendPolygon(Mesh& mesh, std::vector<glm::vec3> corners, glm::vec3 outward) {
    glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (glm::dot(normal, outward) < 0) {
        normal = -normal;
        std::reverse(corners.begin(), corners.end());
    }
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const auto first = std::uint32_t(mesh.positions.size());
    for (const glm::vec3& p : corners) {
        mesh.positions.push_back(p);
        mesh.normals.push_back(normal);
        mesh.uvs.push_back(axis == 1   ? glm::vec2(p.x, p.z)
                           : axis == 0 ? glm::vec2(p.z, -p.y)
                                       : glm::vec2(p.x, -p.y));
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i)
        for (const std::uint32_t k : {0u, i - 1, i}) mesh.indices.push_back(first + k);
}

Mesh cylinder(float radius, float bottom, float top, int around, int pieces) {
    return turned(
        {shapes::line({0, bottom}, {radius, bottom}), shapes::line({radius, bottom}, {radius, top}, pieces),
         shapes::line({radius, top}, {0, top})},
        around);
}

Mesh rod(glm::vec3 from, glm::vec3 to, float radius, int around) {
    const glm::vec3 up = glm::normalize(to - from);
    const glm::vec3 side =
        glm::normalize(glm::cross(up, std::abs(up.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)));
    const glm::mat4 place(glm::vec4(side, 0), glm::vec4(up, 0), glm::vec4(glm::cross(side, up), 0),
                          glm::vec4(from, 1));
    Mesh mesh;
    merge(mesh, cylinder(radius, 0, glm::distance(from, to), around, 1), place);
    return mesh;
}

Mesh tube(const std::function<glm::vec3(float)>& middle, float radius, int along, int around,
          glm::vec3 across) {
    shapes::Patch skin;
    skin.nu = along;
    skin.nv = around;
    skin.position = [&](float u, float v) {
        const glm::vec3 forward = glm::normalize(middle(u + 0.001f) - middle(u - 0.001f));
        const glm::vec3 side = glm::normalize(glm::cross(forward, across));
        const float angle = 2 * glm::pi<float>() * v;
        return middle(u) + radius * (std::cos(angle) * side + std::sin(angle) * glm::cross(side, forward));
    };
    Mesh mesh;
    shapes::appendPatch(mesh, skin);
    return mesh;
}

Mesh wire(glm::vec3 from, glm::vec3 to, float sag, float radius) {
    const glm::vec3 across = glm::normalize(glm::cross(to - from, glm::vec3(0, 1, 0)));
    return tube([=](float t) { return glm::mix(from, to, t) - glm::vec3(0, 4 * sag * t * (1 - t), 0); },
                radius, 32, 8, across);
}

Mesh sheet(const std::function<glm::vec3(float u, float v)>& position, int nu, int nv, glm::vec2 metres) {
    shapes::Patch patch;
    patch.nu = nu;
    patch.nv = nv;
    patch.position = position;
    patch.uvScale = metres;
    Mesh mesh;
    shapes::appendPatch(mesh, patch);
    return mesh;
}

Mesh chamferedBox(const Aabb& box, float cut) {
    const glm::vec3 centre = 0.5f * (box.min + box.max), half = 0.5f * (box.max - box.min);
    // The corner of the face across `axis` that points along `sign`.
    const auto corner = [&](glm::vec3 sign, int axis) {
        glm::vec3 p = half - cut;
        p[axis] = half[axis];
        return centre + sign * p;
    };
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (const float s : {-1.0f, 1.0f}) {
            const auto signs = [&](float along, float second, float third) {
                glm::vec3 sign(0);
                sign[axis] = along, sign[b] = second, sign[c] = third;
                return sign;
            };
            appendPolygon(mesh,
                          {corner(signs(s, -1, -1), axis), corner(signs(s, 1, -1), axis),
                           corner(signs(s, 1, 1), axis), corner(signs(s, -1, 1), axis)},
                          signs(s, 0, 0));
            // The edge between the faces across `axis` and across `b`, at both ends of the latter.
            for (const float t : {-1.0f, 1.0f})
                appendPolygon(mesh,
                              {corner(signs(s, t, -1), axis), corner(signs(s, t, 1), axis),
                               corner(signs(s, t, 1), b), corner(signs(s, t, -1), b)},
                              signs(s, t, 0));
        }
    }
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        appendPolygon(mesh, {corner(sign, 0), corner(sign, 1), corner(sign, 2)}, sign);
    }
    return mesh;
}

Mesh cup(float radius, float height, float wall, int around) {
    return turned(
        {shapes::line({0, 0}, {0.8f * radius, 0}), shapes::line({0.8f * radius, 0}, {radius, height}, 4),
         shapes::line({radius, height}, {radius - wall, height}),
         shapes::line({radius - wall, height}, {0.8f * radius - wall, wall}, 4),
         shapes::line({0.8f * radius - wall, wall}, {0, wall})},
        around);
}

Mesh curtain(float width, float height, float wave, int waves) {
    shapes::Patch cloth;
    cloth.nu = 12 * waves;
    cloth.nv = 6;
    cloth.position = [=](float u, float v) {
        const float phase = 2 * glm::pi<float>() * float(waves) * u;
        return glm::vec3(width * (u - 0.5f), height * v, wave * std::sin(phase) * (1 - 0.3f * v));
    };
    Mesh mesh;
    shapes::appendPatch(mesh, cloth);
    return mesh;
}

Mesh leaves(glm::vec3 radii, int count, float size, std::uint32_t seed) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const auto value = [&](std::uint32_t what) {
            return shapes::unitFloat(shapes::hash(seed, std::uint32_t(i), what));
        };
        const float z = 2 * value(0) - 1, phi = 2 * glm::pi<float>() * value(1);
        const float across = std::sqrt(1 - z * z), r = std::cbrt(value(2));
        const glm::vec3 centre = r * radii * glm::vec3(across * std::cos(phi), z, across * std::sin(phi));
        const glm::mat4 turn = glm::rotate(glm::mat4(1), 6.28f * value(3),
                                           glm::normalize(glm::vec3(value(4), value(5), value(6)) - 0.5f));
        const glm::vec3 u = size * glm::vec3(turn[0]), v = 0.6f * size * glm::vec3(turn[1]);
        shapes::appendQuad(mesh, centre - 0.5f * (u + v), u, v);
    }
    return mesh;
}

float randomAt(std::uint32_t seed, int i, int what) {
    return shapes::unitFloat(shapes::hash(seed, std::uint32_t(i), std::uint32_t(what)));
}

}  // namespace conelight::io::generated
