// SPDX-License-Identifier: MIT
// Tessellation of the generated scenes' shapes: parameters -> Mesh attributes. See generated_shapes.h for the
// conventions. Normals of patches by central differences, tangents by per-triangle accumulation (Lengyel,
// "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001), hash by Wellons' search for 32-bit
// mixers of low bias (constants of "lowbias32", 2018).
#include "generated_shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace conelight::io::shapes {
namespace {

// Normals come from differences to the neighbouring grid points, so that they always agree with the
// triangles; on circles that is exact. At most a quarter of the domain, for patches of one or two pieces.
constexpr float kWidestStep = 0.25f;
// Twice the area over the longest edge squared under which a triangle is left out: float sines of whole turns
// make slivers of 1e-7 at poles; the flattest wanted triangle (a column seen along its shaft) has 1e-3.
constexpr float kMinFlatness = 1e-5f;

void appendVertex(Mesh& mesh, glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
}

// Corners counter-clockwise seen from the front; uvs given per corner.
void appendCorners(Mesh& mesh, const std::array<glm::vec3, 4>& p, const std::array<glm::vec2, 4>& uv) {
    const auto first = std::uint32_t(mesh.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(p[2] - p[0], p[3] - p[1]));
    for (int i = 0; i < 4; ++i) appendVertex(mesh, p[std::size_t(i)], normal, uv[std::size_t(i)]);
    for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

glm::vec3 patchNormal(const Patch& patch, float u, float v) {
    const float stepU = std::min(1.0f / float(patch.nu), kWidestStep);
    const float stepV = std::min(1.0f / float(patch.nv), kWidestStep);
    // The mean direction of the steps before and after, not their sum: a fold's long flank would outweigh its
    // tip.
    auto along = [](glm::vec3 before, glm::vec3 here, glm::vec3 after) {
        const glm::vec3 a = here - before, b = after - here;
        const float la = glm::length(a), lb = glm::length(b);
        return ((la > 0 ? a / la : a) + (lb > 0 ? b / lb : b)) * std::max(la, lb);
    };
    auto alongU = [&](float at) {
        return along(patch.position(u - stepU, at), patch.position(u, at), patch.position(u + stepU, at));
    };
    auto alongV = [&](float at) {
        return along(patch.position(u, at - stepV), patch.position(u, at), patch.position(u, at + stepV));
    };
    // Half a step inside of the patch: where a derivative vanishes, it is taken there.
    const float inside = v + (v < 0.5f ? 0.5f : -0.5f) * stepV;
    glm::vec3 du = alongU(v), dv = alongV(v);
    if (glm::length(du) < 1e-3f * glm::length(dv)) du = alongU(inside);  // a pole
    for (int attempt = 0; attempt < 2; ++attempt) {
        const glm::vec3 n = glm::cross(du, dv) * (patch.flip ? -1.0f : 1.0f);
        if (glm::length(n) > 1e-3f * glm::length(du) * glm::length(dv)) return glm::normalize(n);
        du = alongU(inside);
        dv = alongV(inside);
    }
    return {0, 1, 0};
}

}  // namespace

void appendQuad(Mesh& mesh, glm::vec3 origin, glm::vec3 edgeU, glm::vec3 edgeV, glm::vec2 uvOrigin) {
    const float u = glm::length(edgeU);
    const float v = glm::length(edgeV);
    appendCorners(
        mesh, {origin, origin + edgeU, origin + edgeU + edgeV, origin + edgeV},
        {uvOrigin + glm::vec2(0, v), uvOrigin + glm::vec2(u, v), uvOrigin + glm::vec2(u, 0), uvOrigin});
}

void appendHexahedron(Mesh& mesh, const std::array<glm::vec3, 8>& c) {
    // Four corners of each face, counter-clockwise from outside: -x +x -y +y -z +z.
    constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4},
                                  {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};
    for (const auto& f : kFaces) {
        const std::array<glm::vec3, 4> p{c[std::size_t(f[0])], c[std::size_t(f[1])], c[std::size_t(f[2])],
                                         c[std::size_t(f[3])]};
        const float u = glm::distance(p[0], p[1]);
        const float v = glm::distance(p[1], p[2]);
        appendCorners(mesh, p, {glm::vec2(0, v), glm::vec2(u, v), glm::vec2(u, 0), glm::vec2(0, 0)});
    }
}

void appendBox(Mesh& mesh, const Aabb& box, bool inward) {
    std::array<glm::vec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {(i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                      (i & 4) ? box.max.z : box.min.z};
    const std::size_t firstIndex = mesh.indices.size();
    const std::size_t firstVertex = mesh.positions.size();
    appendHexahedron(mesh, corners);
    if (!inward) return;
    for (std::size_t i = firstIndex; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (std::size_t i = firstVertex; i < mesh.normals.size(); ++i) mesh.normals[i] = -mesh.normals[i];
}

void appendFrame(Mesh& mesh, glm::vec3 origin, glm::vec3 edgeU, glm::vec3 edgeV, glm::vec2 lo, glm::vec2 hi) {
    const glm::vec2 size(glm::length(edgeU), glm::length(edgeV));
    const glm::vec2 outer[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const glm::vec2 inner[4] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
    for (int side = 0; side < 4; ++side) {
        const int next = (side + 1) % 4;
        const glm::vec2 f[4] = {outer[side], outer[next], inner[next], inner[side]};
        std::array<glm::vec3, 4> p;
        std::array<glm::vec2, 4> uv;
        for (std::size_t i = 0; i < 4; ++i) {
            p[i] = origin + edgeU * f[i].x + edgeV * f[i].y;
            uv[i] = glm::vec2(f[i].x, 1 - f[i].y) * size;
        }
        appendCorners(mesh, p, uv);
    }
}

std::vector<Mesh> buildCells(const CellSolid& cells, int parts) {
    std::vector<Mesh> meshes(static_cast<std::size_t>(parts));
    int count[3];
    for (std::size_t a = 0; a < 3; ++a) count[a] = int(cells.planes[a].size()) - 1;
    auto centreOf = [&](glm::ivec3 c) {
        glm::vec3 p;
        for (int a = 0; a < 3; ++a) {
            const auto& planes = cells.planes[std::size_t(a)];
            p[a] = 0.5f * (planes[std::size_t(c[a])] + planes[std::size_t(c[a]) + 1]);
        }
        return p;
    };
    auto isSolid = [&](glm::ivec3 c) {
        for (int a = 0; a < 3; ++a)
            if (c[a] < 0 || c[a] >= count[a]) return false;
        return cells.solid(centreOf(c));
    };
    auto corner = [&](glm::ivec3 c) {
        return glm::vec3(cells.planes[0][std::size_t(c.x)], cells.planes[1][std::size_t(c.y)],
                         cells.planes[2][std::size_t(c.z)]);
    };
    auto appendFace = [&](glm::ivec3 c, int axis, int direction) {
        // Edges of the face, such that their cross product points along `direction` on `axis`.
        glm::ivec3 base = c;
        if (direction > 0) base[axis] += 1;
        glm::ivec3 e1(0), e2(0);
        e1[(axis + 1) % 3] = 1;
        e2[(axis + 2) % 3] = 1;
        if (direction < 0) std::swap(e1, e2);
        glm::vec3 normal(0);
        normal[axis] = float(direction);
        const std::array<glm::vec3, 4> p{corner(base), corner(base + e1), corner(base + e1 + e2),
                                         corner(base + e2)};
        // Textures stand upright on walls and lie along x, z on floors and ceilings.
        std::array<glm::vec2, 4> uv;
        for (std::size_t i = 0; i < 4; ++i)
            uv[i] = axis == 1 ? glm::vec2(p[i].x, p[i].z) : glm::vec2(axis == 0 ? p[i].z : p[i].x, -p[i].y);
        const glm::vec3 centre = 0.5f * (p[0] + p[2]);
        const int part = cells.part(centre, normal);
        assert(part >= 0 && part < parts);
        appendCorners(meshes[std::size_t(part)], p, uv);
    };
    for (int k = 0; k < count[2]; ++k)
        for (int j = 0; j < count[1]; ++j)
            for (int i = 0; i < count[0]; ++i) {
                const glm::ivec3 c(i, j, k);
                if (!isSolid(c)) continue;
                for (int axis = 0; axis < 3; ++axis)
                    for (int direction : {-1, 1}) {
                        glm::ivec3 neighbour = c;
                        neighbour[axis] += direction;
                        if (!isSolid(neighbour)) appendFace(c, axis, direction);
                    }
            }
    return meshes;
}

void appendPatch(Mesh& mesh, const Patch& patch) {
    assert(patch.nu >= 1 && patch.nv >= 1);
    const auto first = std::uint32_t(mesh.positions.size());
    const auto row = std::uint32_t(patch.nu + 1);
    for (int j = 0; j <= patch.nv; ++j)
        for (int i = 0; i <= patch.nu; ++i) {
            const float u = float(i) / float(patch.nu);
            const float v = float(j) / float(patch.nv);
            const glm::vec3 position = patch.position(u, v);
            appendVertex(
                mesh, position, patchNormal(patch, u, v),
                patch.uvOf ? patch.uvOf(position) : patch.uvOffset + patch.uvScale * glm::vec2(u, 1 - v));
        }
    auto appendTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 e1 = mesh.positions[b] - mesh.positions[a];
        const glm::vec3 e2 = mesh.positions[c] - mesh.positions[a];
        const glm::vec3 e3 = e2 - e1;
        const float longest = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3)});
        if (glm::length(glm::cross(e1, e2)) <= kMinFlatness * longest) return;
        if (patch.flip) std::swap(b, c);
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (std::uint32_t j = 0; j < std::uint32_t(patch.nv); ++j)
        for (std::uint32_t i = 0; i < std::uint32_t(patch.nu); ++i) {
            const std::uint32_t a = first + j * row + i;
            appendTriangle(a, a + 1, a + row + 1);
            appendTriangle(a, a + row + 1, a + row);
        }
}

float Curve::length() const {
    constexpr int kPieces = 16;
    float sum = 0;
    for (int i = 0; i < kPieces; ++i)
        sum += glm::distance(at(float(i) / kPieces), at(float(i + 1) / kPieces));
    return sum;
}

Curve line(glm::vec2 from, glm::vec2 to, int n) {
    return {n, [=](float t) { return from + (to - from) * t; }};
}

Curve arc(glm::vec2 centre, glm::vec2 radii, float fromAngle, float toAngle, int n) {
    return {n, [=](float t) {
                const float a = fromAngle + (toAngle - fromAngle) * t;
                return centre + radii * glm::vec2(std::cos(a), std::sin(a));
            }};
}

std::vector<Patch> lathe(const std::vector<Curve>& profile, int around, float uvRadius) {
    std::vector<Patch> patches;
    float along = 0;
    for (const Curve& curve : profile) {
        Patch patch;
        patch.nu = around;
        patch.nv = curve.n;
        patch.position = [at = curve.at](float u, float v) {
            const glm::vec2 p = at(v);
            const float a = glm::two_pi<float>() * u;
            return glm::vec3(p.x * std::sin(a), p.y, p.x * std::cos(a));
        };
        const float length = curve.length();
        patch.uvScale = {glm::two_pi<float>() * uvRadius, length};
        patch.uvOffset = {0, -along - length};
        along += length;
        patches.push_back(std::move(patch));
    }
    return patches;
}

std::vector<Patch> extrude(const std::vector<Curve>& profile, glm::vec3 from, glm::vec3 to, glm::vec3 out,
                           float mitreFrom, float mitreTo) {
    std::vector<Patch> patches;
    const glm::vec3 along = glm::normalize(to - from);
    const bool flip = glm::dot(glm::cross(along, glm::vec3(0, 1, 0)), out) < 0;
    float height = 0;
    for (const Curve& curve : profile) {
        Patch patch;
        patch.nv = curve.n;
        patch.flip = flip;
        patch.position = [=, at = curve.at](float u, float v) {
            const glm::vec2 p = at(v);
            const glm::vec3 a = from - along * (mitreFrom * p.x);
            const glm::vec3 b = to + along * (mitreTo * p.x);
            return a + (b - a) * u + out * p.x + glm::vec3(0, p.y, 0);
        };
        const float length = curve.length();
        patch.uvScale = {glm::distance(from, to), length};
        patch.uvOffset = {0, -height - length};
        height += length;
        patches.push_back(std::move(patch));
    }
    return patches;
}

Patch uvSphere(glm::vec3 centre, glm::vec3 radii, int around, int down) {
    Patch patch;
    patch.nu = around;
    patch.nv = down;
    patch.position = [=](float u, float v) {
        const float a = glm::two_pi<float>() * u;
        const float b = glm::pi<float>() * v;
        const float r = std::sin(b);
        return centre + radii * glm::vec3(r * std::sin(a), -std::cos(b), r * std::cos(a));
    };
    patch.uvScale = {glm::two_pi<float>() * radii.x, glm::pi<float>() * radii.y};
    return patch;
}

void computeTangents(Mesh& mesh) {
    std::vector<glm::vec3> along(mesh.positions.size(), glm::vec3(0));
    std::vector<glm::vec3> up(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* t = &mesh.indices[i];
        const glm::vec3 e1 = mesh.positions[t[1]] - mesh.positions[t[0]];
        const glm::vec3 e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
        const glm::vec2 d1 = mesh.uvs[t[1]] - mesh.uvs[t[0]];
        const glm::vec2 d2 = mesh.uvs[t[2]] - mesh.uvs[t[0]];
        // Solve e = d.x * along - d.y * up for both edges; weight by the triangle's area in the texture.
        const float sign = d1.x * d2.y - d2.x * d1.y < 0 ? -1.0f : 1.0f;
        for (int k = 0; k < 3; ++k) {
            along[t[k]] += sign * (e1 * d2.y - e2 * d1.y);
            up[t[k]] -= sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 n = mesh.normals[i];
        glm::vec3 t = along[i] - n * glm::dot(n, along[i]);
        // A vertex without a texture direction gets any tangent.
        if (glm::dot(t, t) < 1e-20f)
            t = glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
        t = glm::normalize(t);
        mesh.tangents[i] = glm::vec4(t, glm::dot(glm::cross(n, t), up[i]) < 0 ? -1.0f : 1.0f);
    }
}

std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return hash(x + hash(y + hash(z + 0x9e3779b9u)));
}

float unitFloat(std::uint32_t h) { return float(h >> 8) * 0x1p-24f; }

}  // namespace conelight::io::shapes
