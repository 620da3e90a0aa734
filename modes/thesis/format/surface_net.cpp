// SPDX-License-Identifier: MIT
// Naive surface nets: a vertex in every cell that the surface crosses, at the mean of its crossings of the
// cell's edges; a quad round every lattice edge that the surface crosses.
#include "thesis/format/surface_net.h"

#include <array>
#include <cmath>

namespace conelight::thesis {
namespace {

struct Lattice {
    glm::vec3 origin;
    float cell;
    glm::ivec3 nodes;
    std::vector<float> values;

    std::size_t index(const glm::ivec3& n) const {
        return (std::size_t(n.z) * std::size_t(nodes.y) + std::size_t(n.y)) * std::size_t(nodes.x) +
               std::size_t(n.x);
    }
    float at(const glm::ivec3& n) const { return values[index(n)]; }
    glm::vec3 place(const glm::ivec3& n) const { return origin + cell * glm::vec3(n); }
};

glm::ivec3 unit(int axis) {
    glm::ivec3 step(0);
    step[axis] = 1;
    return step;
}

// Whether some corners of a cell are inside and some are not.
bool isCrossed(const Lattice& lattice, const glm::ivec3& cell) {
    const auto row = std::size_t(lattice.nodes.x), layer = row * std::size_t(lattice.nodes.y);
    const float* corner = &lattice.values[lattice.index(cell)];
    int inside = 0;
    for (const std::size_t k : {std::size_t(0), row, layer, layer + row})
        inside += (corner[k] < 0 ? 1 : 0) + (corner[k + 1] < 0 ? 1 : 0);
    return inside != 0 && inside != 8;
}

// The mean of the crossings of a cell's edges; false: none.
bool crossing(const Lattice& lattice, const glm::ivec3& cell, glm::vec3& point) {
    if (!isCrossed(lattice, cell)) return false;
    glm::vec3 sum(0);
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 4; ++k) {
            const glm::ivec3 from = cell + (k & 1) * unit((axis + 1) % 3) + (k >> 1) * unit((axis + 2) % 3);
            const float a = lattice.at(from), b = lattice.at(from + unit(axis));
            if ((a < 0) == (b < 0)) continue;
            sum += glm::mix(lattice.place(from), lattice.place(from + unit(axis)), a / (a - b));
            ++count;
        }
    if (count == 0) return false;
    point = sum / float(count);
    return true;
}

// Values of all nodes. Blocks of nodes that lie far from the surface take the value of their middle: only its
// sign is read there. Far is twice what an exact distance would ask for.
void fill(Lattice& lattice, const std::function<float(const glm::vec3&)>& distance) {
    constexpr int kBlock = 4;
    const float far = 2 * std::sqrt(3.0f) * 0.5f * kBlock * lattice.cell;
    lattice.values.resize(std::size_t(lattice.nodes.x) * std::size_t(lattice.nodes.y) *
                          std::size_t(lattice.nodes.z));
    const auto fillBlock = [&](const glm::ivec3& low) {
        const glm::ivec3 high = glm::min(low + kBlock, lattice.nodes);
        const float middle = distance(lattice.place(low) + 0.5f * (kBlock - 1) * lattice.cell);
        for (int z = low.z; z < high.z; ++z)
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x)
                    lattice.values[lattice.index({x, y, z})] =
                        std::abs(middle) > far ? middle : distance(lattice.place({x, y, z}));
    };
    for (int z = 0; z < lattice.nodes.z; z += kBlock)
        for (int y = 0; y < lattice.nodes.y; y += kBlock)
            for (int x = 0; x < lattice.nodes.x; x += kBlock) fillBlock({x, y, z});
}

// Normals by area; a triangle that its vertices' normals turn away from gets vertices of its own.
void addNormals(Mesh& mesh) {
    const auto across = [&](std::size_t i) {
        const glm::vec3& a = mesh.positions[mesh.indices[i]];
        return glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
    };
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) mesh.normals[mesh.indices[i + k]] += across(i);
    for (glm::vec3& n : mesh.normals) n = glm::length(n) > 1e-20f ? glm::normalize(n) : glm::vec3(0, 1, 0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 n = glm::normalize(across(i));
        glm::vec3 sum(0);
        for (std::size_t k = 0; k < 3; ++k) sum += mesh.normals[mesh.indices[i + k]];
        if (glm::dot(n, sum) > 0.01f) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.positions.push_back(glm::vec3(mesh.positions[mesh.indices[i + k]]));
            mesh.normals.push_back(n);
            mesh.indices[i + k] = std::uint32_t(mesh.positions.size() - 1);
        }
    }
    mesh.uvs.assign(mesh.positions.size(), glm::vec2(0));
}

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 n =
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    if (glm::length(n) > 0) mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

}  // namespace

Mesh surfaceNet(const std::function<float(const glm::vec3&)>& distance, const Aabb& bounds, float cell) {
    Lattice lattice{bounds.min - cell, cell, glm::ivec3(glm::ceil(bounds.extent() / cell)) + 3, {}};
    fill(lattice, distance);
    Mesh mesh;
    constexpr std::uint32_t kNone = ~0u;
    std::vector<std::uint32_t> vertexOf(lattice.values.size(), kNone);
    for (int z = 0; z + 1 < lattice.nodes.z; ++z)
        for (int y = 0; y + 1 < lattice.nodes.y; ++y)
            for (int x = 0; x + 1 < lattice.nodes.x; ++x) {
                glm::vec3 point;
                if (!crossing(lattice, {x, y, z}, point)) continue;
                vertexOf[lattice.index({x, y, z})] = std::uint32_t(mesh.positions.size());
                mesh.positions.push_back(point);
            }
    // Cells round an edge along `axis`, counter-clockwise about it.
    for (int z = 1; z + 1 < lattice.nodes.z; ++z)
        for (int y = 1; y + 1 < lattice.nodes.y; ++y)
            for (int x = 1; x + 1 < lattice.nodes.x; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    const glm::ivec3 node(x, y, z);
                    const bool inside = lattice.at(node) < 0;
                    if (inside == (lattice.at(node + unit(axis)) < 0)) continue;
                    const glm::ivec3 u = unit((axis + 1) % 3), v = unit((axis + 2) % 3);
                    std::array<std::uint32_t, 4> q = {
                        vertexOf[lattice.index(node - u - v)], vertexOf[lattice.index(node - v)],
                        vertexOf[lattice.index(node)], vertexOf[lattice.index(node - u)]};
                    if (!inside) std::swap(q[1], q[3]);
                    addTriangle(mesh, q[0], q[1], q[2]);
                    addTriangle(mesh, q[0], q[2], q[3]);
                }
    addNormals(mesh);
    return mesh;
}

}  // namespace conelight::thesis
