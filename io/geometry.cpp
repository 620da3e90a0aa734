// SPDX-License-Identifier: MIT
// Repairs that importers share: see geometry.h.
#include "io/geometry.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <map>

namespace conelight::io {

namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Unit vector along v in double precision (tiny triangles underflow in float), or `otherwise`.
glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    if (!(length > 0.0) || !std::isfinite(length)) return otherwise;
    return glm::vec3(v / length);
}

glm::dvec3 areaNormal(const Mesh& mesh, std::size_t triangle) {
    const glm::dvec3 a = mesh.positions[mesh.indices[3 * triangle]];
    const glm::dvec3 b = mesh.positions[mesh.indices[3 * triangle + 1]];
    const glm::dvec3 c = mesh.positions[mesh.indices[3 * triangle + 2]];
    return glm::cross(b - a, c - a);
}

template <typename T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    std::vector<T> out;
    if (values.empty()) return out;
    out.reserve(indices.size());
    for (const std::uint32_t index : indices) out.push_back(values[index]);
    return out;
}

// Any unit vector at right angles to n (Duff et al. 2017, without the branch on the sign's copy).
glm::vec3 anyPerpendicular(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

double cornerAngle(const glm::dvec3& at, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 u = b - at, v = c - at;
    const double lengths = glm::length(u) * glm::length(v);
    if (!(lengths > 0.0)) return 0.0;
    return std::acos(glm::clamp(glm::dot(u, v) / lengths, -1.0, 1.0));
}

// Tangent direction and handedness of one triangle's texture mapping; handedness 0 when it has no area.
struct TriangleFrame {
    glm::dvec3 tangent{0.0};
    int handedness = 0;
};

TriangleFrame triangleFrame(const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* at = &mesh.indices[3 * triangle];
    const glm::dvec3 e1 = glm::dvec3(mesh.positions[at[1]]) - glm::dvec3(mesh.positions[at[0]]);
    const glm::dvec3 e2 = glm::dvec3(mesh.positions[at[2]]) - glm::dvec3(mesh.positions[at[0]]);
    const glm::dvec2 d1 = glm::dvec2(mesh.uvs[at[1]]) - glm::dvec2(mesh.uvs[at[0]]);
    const glm::dvec2 d2 = glm::dvec2(mesh.uvs[at[2]]) - glm::dvec2(mesh.uvs[at[0]]);
    const double area = d1.x * d2.y - d2.x * d1.y;
    TriangleFrame frame;
    if (area == 0.0 || !std::isfinite(area)) return frame;
    const glm::dvec3 along = (e1 * d2.y - e2 * d1.y) * (area > 0.0 ? 1.0 : -1.0);
    const double length = glm::length(along);
    if (!(length > 0.0) || !std::isfinite(length)) return frame;
    frame.tangent = along / length;
    // v grows downward in glTF, and its bitangent points along -v: w = +1 for the usual upright mapping.
    frame.handedness = area > 0.0 ? -1 : 1;
    return frame;
}

Mesh mirroredX(const Mesh& mesh) {
    Mesh out = mesh;
    for (glm::vec3& p : out.positions) p.x = -p.x;
    for (glm::vec3& n : out.normals) n.x = -n.x;
    for (glm::vec4& t : out.tangents) {
        t.x = -t.x;
        t.w = -t.w;
    }
    for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3)
        std::swap(out.indices[i + 1], out.indices[i + 2]);
    return out;
}

}  // namespace

void makeFlatNormals(Mesh& mesh) {
    mesh.positions = gather(mesh.positions, mesh.indices);
    mesh.uvs = gather(mesh.uvs, mesh.indices);
    mesh.colors = gather(mesh.colors, mesh.indices);
    mesh.tangents.clear();
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = std::uint32_t(i);
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const glm::vec3 normal = unitOr(areaNormal(mesh, t), {0, 1, 0});
        for (std::size_t corner = 0; corner < 3; ++corner) mesh.normals[3 * t + corner] = normal;
    }
}

std::size_t repairNormals(Mesh& mesh) {
    // Normalize what can be; remember the rest.
    std::vector<std::uint8_t> bad(mesh.normals.size(), 0);
    std::size_t badCount = 0;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::vec3 n = mesh.normals[i];
        const glm::vec3 unit = finite(n) ? unitOr(glm::dvec3(n), glm::vec3(0)) : glm::vec3(0);
        bad[i] = unit == glm::vec3(0) ? 1 : 0;
        badCount += bad[i];
        mesh.normals[i] = unit;
    }
    if (badCount == 0) return 0;

    // Sum the area normals of the triangles around the bad vertices.
    std::vector<glm::dvec3> sums(mesh.normals.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const glm::dvec3 normal = areaNormal(mesh, t);
        for (std::size_t corner = 0; corner < 3; ++corner) sums[mesh.indices[3 * t + corner]] += normal;
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        if (bad[i] != 0) mesh.normals[i] = unitOr(sums[i], {0, 1, 0});
    return badCount;
}

void makeTangents(Mesh& mesh) {
    if (mesh.uvs.empty()) return;
    if (mesh.normals.empty()) makeFlatNormals(mesh);

    // Split vertices whose triangles disagree about handedness: the second kind gets a copy.
    const std::size_t triangleCount = mesh.triangleCount();
    std::vector<TriangleFrame> frames(triangleCount);
    std::vector<std::int8_t> side(mesh.positions.size(), 0);
    std::map<std::uint32_t, std::uint32_t> copies;
    for (std::size_t t = 0; t < triangleCount; ++t) {
        frames[t] = triangleFrame(mesh, t);
        if (frames[t].handedness == 0) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::uint32_t& index = mesh.indices[3 * t + corner];
            if (side[index] == 0) side[index] = std::int8_t(frames[t].handedness);
            if (side[index] == frames[t].handedness) continue;
            const auto [entry, isNew] = copies.try_emplace(index, std::uint32_t(mesh.positions.size()));
            if (isNew) {
                mesh.positions.push_back(mesh.positions[index]);
                mesh.normals.push_back(mesh.normals[index]);
                mesh.uvs.push_back(mesh.uvs[index]);
                if (!mesh.colors.empty()) mesh.colors.push_back(mesh.colors[index]);
                side.push_back(std::int8_t(frames[t].handedness));
            }
            index = entry->second;
        }
    }

    // Sum the triangles' tangents at each vertex, weighted by the corner's angle.
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < triangleCount; ++t) {
        if (frames[t].handedness == 0) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t at = mesh.indices[3 * t + corner];
            const double angle =
                cornerAngle(mesh.positions[at], mesh.positions[mesh.indices[3 * t + (corner + 1) % 3]],
                            mesh.positions[mesh.indices[3 * t + (corner + 2) % 3]]);
            const glm::dvec3 n = mesh.normals[at];
            glm::dvec3 inPlane = frames[t].tangent - n * glm::dot(n, frames[t].tangent);
            const double length = glm::length(inPlane);
            if (length > 1e-12) sums[at] += angle / length * inPlane;
        }
    }
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        const glm::vec3 tangent = unitOr(sums[i], anyPerpendicular(mesh.normals[i]));
        mesh.tangents[i] = glm::vec4(tangent, side[i] < 0 ? -1.0f : 1.0f);
    }
}

std::vector<KeptInstance> removeMirrors(Scene& scene) {
    std::vector<KeptInstance> origins;
    std::map<int, int> mirroredOf;
    std::vector<Instance> kept;
    kept.reserve(scene.instances.size());
    std::size_t dropped = 0;
    for (Instance& instance : scene.instances) {
        const double determinant = glm::determinant(glm::dmat3(glm::dmat4(instance.worldFromObject)));
        bool usable = std::isfinite(determinant) && determinant != 0.0;
        for (int c = 0; c < 4; ++c) usable = usable && finite(glm::vec3(instance.worldFromObject[c]));
        // A float inverse of it must exist too.
        if (usable) {
            const glm::mat3 inverse = glm::inverse(glm::mat3(instance.worldFromObject));
            for (int c = 0; c < 3; ++c) usable = usable && finite(inverse[c]);
        }
        if (!usable) {
            ++dropped;
            continue;
        }
        origins.push_back(
            {std::size_t(&instance - scene.instances.data()), determinant < 0.0, instance.mesh});
        if (determinant < 0.0) {
            const auto [entry, isNew] = mirroredOf.try_emplace(instance.mesh, int(scene.meshes.size()));
            if (isNew) {
                Mesh copy = mirroredX(scene.meshes[std::size_t(instance.mesh)]);
                scene.meshes.push_back(std::move(copy));
            }
            instance.mesh = entry->second;
            instance.worldFromObject[0] = -instance.worldFromObject[0];
        }
        kept.push_back(std::move(instance));
    }
    scene.instances = std::move(kept);
    if (dropped > 0)
        scene.notes.push_back(fmt::format("{} instance{} left out: zero scale, or beyond what numbers hold",
                                          dropped, dropped == 1 ? "" : "s"));
    return origins;
}

}  // namespace conelight::io
