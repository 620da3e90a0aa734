// SPDX-License-Identifier: MIT
#include "support/reference_voxelizer.h"

#include <algorithm>
#include <cmath>

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

std::vector<glm::dvec3> clippedPolygon(const ReferenceTriangle& t, const glm::ivec3& voxel) {
    std::vector<glm::dvec3> polygon(t.p.begin(), t.p.end());
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double at = voxel[axis] + side % 2;
        const double sign = side % 2 == 0 ? 1 : -1;
        std::vector<glm::dvec3> rest;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec3& a = polygon[i];
            const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
            const double da = sign * (a[axis] - at);
            const double db = sign * (b[axis] - at);
            if (da >= 0) rest.push_back(a);
            if ((da >= 0) != (db >= 0)) rest.push_back(a + da / (da - db) * (b - a));
        }
        polygon = std::move(rest);
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

ReferenceFaces referenceFaces(const Scene& scene, const std::vector<ReferenceTriangle>& triangles,
                              const voxels::VoxelGrid& grid) {
    ReferenceFaces faces;
    for (const ReferenceTriangle& t : triangles) {
        const glm::dvec3 albedo(
            t.material >= 0 ? glm::vec3(scene.materials[static_cast<std::size_t>(t.material)].baseColor)
                            : glm::vec3(Material{}.baseColor));
        forEachVoxel(t, grid, 0, [&](const glm::ivec3& voxel) {
            const std::vector<glm::dvec3> polygon = clippedPolygon(t, voxel);
            const double area = polygonArea(polygon);
            if (area <= 0) return;
            glm::dvec3 center(0);
            double total = 0;
            for (std::size_t i = 2; i < polygon.size(); ++i) {
                const double part =
                    0.5 * glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
                center += part * (polygon[0] + polygon[i - 1] + polygon[i]) / 3.0;
                total += part;
            }
            center = center / total - (glm::dvec3(voxel) + 0.5);
            for (int side = 0; side < (t.twoSided ? 2 : 1); ++side) {
                const glm::dvec3 n = side == 0 ? t.normal() : -t.normal();
                for (int k = 0; k < 6; ++k) {
                    const double facing = glm::dot(n, glm::dvec3(voxels::directionVector(k)));
                    if (facing <= VOXEL_FACING_THRESHOLD) continue;
                    ReferenceFace& face =
                        faces[std::uint64_t{8} * voxels::packVoxel(voxel) + static_cast<std::uint64_t>(k)];
                    const double weight = area * facing;
                    face.weight += weight;
                    face.area += area;
                    face.normal += weight * n;
                    face.center += weight * center;
                    face.albedo += weight * albedo;
                    for (const glm::dvec3& p : polygon) {
                        face.lower = glm::min(face.lower, p - glm::dvec3(voxel));
                        face.upper = glm::max(face.upper, p - glm::dvec3(voxel));
                    }
                }
            }
        });
    }
    return faces;
}

}  // namespace conelight::test
