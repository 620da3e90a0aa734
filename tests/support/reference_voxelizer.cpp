// SPDX-License-Identifier: MIT
#include "support/reference_voxelizer.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "math/brdf.h"
#include "voxels/voxel_record.h"

namespace conelight::test {

double ReferenceTriangle::area() const { return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])); }
glm::dvec3 ReferenceTriangle::normal() const { return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])); }

std::vector<ReferenceTriangle> referenceTriangles(const Scene& scene, const voxels::VoxelGrid& grid) {
    std::vector<ReferenceTriangle> triangles;
    for (const Instance& instance : scene.instances) {
        if (!instance.visible || !instance.voxelized) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const glm::dmat4 worldFromObject(instance.worldFromObject);
        const bool flipped = glm::determinant(glm::dmat3(worldFromObject)) < 0;
        const bool twoSided = instance.material >= 0 &&
                              scene.materials[static_cast<std::size_t>(instance.material)].doubleSided;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            ReferenceTriangle t{{}, instance.material, twoSided};
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec4 world =
                    worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + k]]), 1);
                t.p[flipped ? (3 - k) % 3 : k] =
                    (glm::dvec3(world) - glm::dvec3(grid.origin)) / static_cast<double>(grid.voxelSize);
            }
            if (t.area() > 0) triangles.push_back(t);
        }
    }
    return triangles;
}

bool touches(const ReferenceTriangle& t, const glm::dvec3& center, double half) {
    const glm::dvec3 v[3] = {t.p[0] - center, t.p[1] - center, t.p[2] - center};
    const auto separated = [&](const glm::dvec3& axis) {
        const double a = glm::dot(axis, v[0]);
        const double b = glm::dot(axis, v[1]);
        const double c = glm::dot(axis, v[2]);
        const double reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
    };
    const glm::dvec3 sides[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const glm::dvec3& side : sides)
        if (separated(side)) return false;
    if (separated(glm::cross(v[1] - v[0], v[2] - v[0]))) return false;
    for (int edge = 0; edge < 3; ++edge)
        for (const glm::dvec3& side : sides)
            if (separated(glm::cross(v[(edge + 1) % 3] - v[edge], side))) return false;
    return true;
}

// What of a polygon lies on one side of the plane across an axis (Sutherland-Hodgman).
static std::vector<glm::dvec3> cut(const std::vector<glm::dvec3>& polygon, int axis, double at, bool above) {
    const double sign = above ? 1 : -1;
    std::vector<glm::dvec3> rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (a[axis] - at);
        const double db = sign * (b[axis] - at);
        if (da >= 0) rest.push_back(a);
        if ((da >= 0) != (db >= 0)) rest.push_back(a + da / (da - db) * (b - a));
    }
    return rest;
}

std::vector<glm::dvec3> clippedPolygon(const ReferenceTriangle& t, const glm::ivec3& voxel) {
    std::vector<glm::dvec3> polygon(t.p.begin(), t.p.end());
    for (int axis = 0; axis < 3; ++axis) {
        polygon = cut(polygon, axis, voxel[axis], true);
        polygon = cut(polygon, axis, voxel[axis] + 1, false);
    }
    return polygon;
}

double polygonArea(const std::vector<glm::dvec3>& polygon) {
    glm::dvec3 sum(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * glm::length(sum);
}

void forEachVoxel(const ReferenceTriangle& t, const voxels::VoxelGrid& grid, double slack,
                  const std::function<void(const glm::ivec3&)>& visit) {
    const glm::dvec3 n = t.normal();
    const glm::dvec3 m = glm::abs(n);
    const int w = m.z >= m.x && m.z >= m.y ? 2 : (m.y >= m.x ? 1 : 0);
    const int u = (w + 1) % 3;
    const int v = (w + 2) % 3;
    const glm::dvec3 low = glm::min(glm::min(t.p[0], t.p[1]), t.p[2]) - slack;
    const glm::dvec3 high = glm::max(glm::max(t.p[0], t.p[1]), t.p[2]) + slack;
    const auto first = [&](int axis, double x) {
        return std::clamp(static_cast<int>(std::floor(x)) - 1, 0, grid.size[axis] - 1);
    };
    const auto last = [&](int axis, double x) {
        return std::clamp(static_cast<int>(std::floor(x)) + 1, 0, grid.size[axis] - 1);
    };
    for (int j = first(v, low[v]); j <= last(v, high[v]); ++j)
        for (int i = first(u, low[u]); i <= last(u, high[u]); ++i) {
            // Heights of the plane over the cell; one voxel more on both sides, the test below decides.
            const double middle =
                t.p[0][w] - (n[u] * (i + 0.5 - t.p[0][u]) + n[v] * (j + 0.5 - t.p[0][v])) / n[w];
            const double rise = 0.5 * (m[u] + m[v]) / m[w] + slack * 4;
            for (int k = first(w, std::max(middle - rise, low[w]));
                 k <= last(w, std::min(middle + rise, high[w])); ++k) {
                glm::ivec3 voxel;
                voxel[u] = i;
                voxel[v] = j;
                voxel[w] = k;
                if (touches(t, glm::dvec3(voxel) + 0.5, 0.5 + slack)) visit(voxel);
            }
        }
}

namespace {

// What of one triangle a face holds.
struct Piece {
    double area = 0, weight = 0, own = 0;        // own: of its area, what is this face's
    glm::dvec3 normal{0}, center{0}, albedo{0};  // center: from the voxel's
    glm::dvec3 lower{1}, upper{0};               // of the voxel
};

// Edges of a box in a voxel whose sides are moved outwards to multiples of 1/31.
glm::dvec3 roundedSize(const glm::dvec3& lower, const glm::dvec3& upper) {
    constexpr double kRounding = 1e-6;  // of the shader's numbers
    const glm::dvec3 a = glm::floor(glm::clamp(lower, 0.0, 1.0) * 31.0 + kRounding);
    const glm::dvec3 b = glm::ceil(glm::clamp(upper, 0.0, 1.0) * 31.0 - kRounding);
    return (b - a) / 31.0;
}

// Weighted sums; bounds of the pieces of which more than `leastSeen` is seen.
ReferenceFace sumOf(const std::vector<Piece>& pieces, const std::vector<double>& seen, double leastSeen) {
    ReferenceFace face;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const double weight = piece.weight * seen[i];
        face.weight += weight;
        face.area += piece.own * seen[i];
        face.normal += weight * piece.normal;
        face.center += weight * piece.center;
        face.albedo += weight * piece.albedo;
        if (seen[i] <= leastSeen) continue;
        face.lower = glm::min(face.lower, piece.lower);
        face.upper = glm::max(face.upper, piece.upper);
    }
    face.offset = glm::dot(glm::normalize(face.normal), face.center) / face.weight;
    return face;
}

// How much of each piece is seen along the axis, where pieces cover each other (docs/theory/2_voxels.md,
// "Layers within a voxel"): cover of 16 slices of depth, filled from the front.
std::vector<double> seenOf(const std::vector<Piece>& pieces, const glm::dvec3& normal, double room) {
    constexpr int kSlices = 16;
    std::vector<glm::dvec2> reach;  // of depth
    double farthest = 1e9, nearest = -1e9;
    for (const Piece& piece : pieces) {
        const glm::dvec3 inPlane = normal - glm::dot(normal, piece.normal) * piece.normal;
        const double half = 0.5 * glm::dot(glm::abs(inPlane), roundedSize(piece.lower, piece.upper));
        const double middle = glm::dot(normal, piece.center);
        reach.emplace_back(middle - half, middle + half);
        farthest = std::min(farthest, middle - half);
        nearest = std::max(nearest, middle + half);
    }
    // In slices, widened by half of one on both sides.
    const double thickness = std::max(nearest - farthest, 1.0 / 256) / (kSlices - 1);
    const auto share = [&](std::size_t piece, int slice) {
        const double low = (reach[piece].x - farthest) / thickness;
        const double high = (reach[piece].y - farthest) / thickness + 1;
        return std::max(std::min(high, slice + 1.0) - std::max(low, double(slice)), 0.0) / (high - low);
    };
    std::vector<double> seen(pieces.size(), 0.0);
    for (int slice = kSlices - 1; slice >= 0; --slice) {
        double cover = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) cover += pieces[i].weight * share(i, slice);
        const double part = cover > 0 ? std::min(room / cover, 1.0) : 0.0;
        for (std::size_t i = 0; i < pieces.size(); ++i) seen[i] += part * share(i, slice);
        room -= part * cover;
    }
    return seen;
}

ReferenceFace faceOf(const std::vector<Piece>& pieces, int direction, bool hides) {
    ReferenceFace face = sumOf(pieces, std::vector<double>(pieces.size(), 1.0), 0);
    const int axis = direction / 2;
    const glm::dvec3 size = roundedSize(face.lower, face.upper);
    const double room = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    if (!hides || face.weight <= room + 1.0 / 256) return face;
    const double leastSeen = room / face.weight / 8;
    const glm::dvec3 normal = glm::normalize(face.normal);
    const std::vector<double> seen = seenOf(pieces, normal, room);
    face = sumOf(pieces, seen, leastSeen);
    face.layered = true;
    // The plane goes through the rearmost that is seen, not through the mean.
    double rear = 1;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (seen[i] > leastSeen) rear = std::min(rear, glm::dot(normal, pieces[i].center));
    const double behind = glm::dot(normal, face.center) / face.weight - rear;
    face.offset = glm::dot(glm::normalize(face.normal), face.center) / face.weight - std::max(behind, 0.0);
    return face;
}

}  // namespace

std::string wrongBounds(const ReferenceFace& face, int direction, const glm::dvec3& lower,
                        const glm::dvec3& upper) {
    constexpr double kStep = 1.0 / 31;
    bool same = true;
    for (int i = 0; i < 3; ++i) {
        same = same && std::abs(lower[i] - face.lower[i]) < 1.01 * kStep &&
               std::abs(upper[i] - face.upper[i]) < 1.01 * kStep;
        if (lower[i] < face.lower[i] - 1.01 * kStep || upper[i] > face.upper[i] + 1.01 * kStep ||
            upper[i] < lower[i])
            return "beyond what the face holds";
    }
    if (same) return {};
    // The plane's piece within them: a large square of the plane, clipped.
    const glm::dvec3 n = glm::normalize(face.normal);
    const auto filled = [&](const glm::dvec3& low, const glm::dvec3& high) {
        const glm::dvec3 u =
            glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(n, u), at = 0.5 + face.offset * n;
        std::vector<glm::dvec3> piece = {at - 4.0 * u - 4.0 * v, at + 4.0 * u - 4.0 * v,
                                         at + 4.0 * u + 4.0 * v, at - 4.0 * u + 4.0 * v};
        for (int i = 0; i < 3; ++i) {
            piece = cut(piece, i, low[i], true);
            piece = cut(piece, i, high[i], false);
        }
        return piece.size() < 3 ? 0.0 : polygonArea(piece) * std::abs(n[direction / 2]);
    };
    // What a step of rounding at each end adds or takes, to bounds and offset.
    const double most = filled(lower - kStep, upper + kStep), least = filled(lower + kStep, upper - kStep);
    if (face.weight < least - 0.02) return fmt::format("hold {:.3f}, of {:.3f}", least, face.weight);
    if (face.weight > most + 0.02) return fmt::format("hold {:.3f} only, of {:.3f}", most, face.weight);
    return {};
}

ReferenceFaces referenceFaces(const Scene& scene, const std::vector<ReferenceTriangle>& triangles,
                              const voxels::VoxelGrid& grid, bool hides) {
    std::unordered_map<std::uint64_t, std::vector<Piece>> pieces;
    for (const ReferenceTriangle& t : triangles) {
        const Material material =
            t.material >= 0 ? scene.materials[static_cast<std::size_t>(t.material)] : Material{};
        const float ratio = (material.ior - 1) / (material.ior + 1);
        const glm::dvec3 albedo(math::evenAlbedo(
            glm::vec3(material.baseColor), material.metallic, material.roughness,
            glm::min(material.specularColor * (ratio * ratio), glm::vec3(1)) * material.specular));
        forEachVoxel(t, grid, 0, [&](const glm::ivec3& voxel) {
            const std::vector<glm::dvec3> polygon = clippedPolygon(t, voxel);
            Piece piece;
            piece.area = polygonArea(polygon);
            piece.albedo = albedo;
            if (piece.area <= 0) return;
            double total = 0;
            for (std::size_t i = 2; i < polygon.size(); ++i) {
                const double part =
                    0.5 * glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
                piece.center += part * (polygon[0] + polygon[i - 1] + polygon[i]) / 3.0;
                total += part;
            }
            piece.center = piece.center / total - (glm::dvec3(voxel) + 0.5);
            for (const glm::dvec3& p : polygon) {
                piece.lower = glm::min(piece.lower, p - glm::dvec3(voxel));
                piece.upper = glm::max(piece.upper, p - glm::dvec3(voxel));
            }
            for (int side = 0; side < (t.twoSided ? 2 : 1); ++side) {
                piece.normal = side == 0 ? t.normal() : -t.normal();
                for (int k = 0; k < 6; ++k) {
                    const double facing = glm::dot(piece.normal, glm::dvec3(voxels::directionVector(k)));
                    if (facing <= VOXEL_FACING_THRESHOLD) continue;
                    piece.weight = piece.area * facing;
                    piece.own = piece.weight * facing;
                    pieces[std::uint64_t{8} * voxels::packVoxel(voxel) + static_cast<std::uint64_t>(k)]
                        .push_back(piece);
                }
            }
        });
    }
    ReferenceFaces faces;
    for (const auto& [key, list] : pieces) faces[key] = faceOf(list, static_cast<int>(key % 8), hides);
    return faces;
}

}  // namespace conelight::test
