// SPDX-License-Identifier: MIT
// Meshes in the order in which the GPU holds them: the same triangles, fewer vertices worked out twice.
#include "scene/mesh_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace conelight::test {
namespace {

constexpr std::uint32_t kEdge = 40;  // quads per edge of a grid

// Corners of a triangle by position, the lowest first: which corner is first says nothing, the turn does.
using Triangle = std::array<std::array<float, 3>, 3>;

std::vector<Triangle> trianglesOf(const std::vector<gpu::Vertex>& vertices, std::size_t firstVertex,
                                  const std::vector<std::uint32_t>& indices, std::size_t firstIndex) {
    std::vector<Triangle> triangles;
    for (std::size_t i = firstIndex; i < indices.size(); i += 3) {
        Triangle t;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::vec3 p = vertices.at(firstVertex + indices[i + corner]).position;
            t[corner] = {p.x, p.y, p.z};
        }
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        triangles.push_back(t);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

// Vertices worked out by a driver that keeps the last 32 by number modulo 32.
int workedOut(const std::vector<std::uint32_t>& indices) {
    std::array<std::uint32_t, 32> kept;
    kept.fill(~0u);
    int count = 0;
    for (const std::uint32_t index : indices) {
        count += kept[index % 32] == index ? 0 : 1;
        kept[index % 32] = index;
    }
    return count;
}

struct Grid {
    std::vector<gpu::Vertex> vertices;
    std::vector<std::uint32_t> indices;
};

// A grid of quads whose triangles come in a scattered order.
Grid scatteredGrid() {
    Grid grid;
    for (std::uint32_t y = 0; y <= kEdge; ++y)
        for (std::uint32_t x = 0; x <= kEdge; ++x) {
            gpu::Vertex vertex{};
            vertex.position = glm::vec3(x, y, 0.1f * static_cast<float>(x * y));
            vertex.color = y * (kEdge + 1) + x;
            grid.vertices.push_back(vertex);
        }
    const std::uint32_t quads = kEdge * kEdge;
    for (std::uint32_t i = 0; i < quads; ++i) {
        const std::uint32_t quad = i * 377 % quads;  // has no factor in common with their number
        const std::uint32_t a = quad / kEdge * (kEdge + 1) + quad % kEdge, b = a + kEdge + 1;
        for (const std::uint32_t index : {a, a + 1, b, b, a + 1, b + 1}) grid.indices.push_back(index);
    }
    return grid;
}

}  // namespace

TEST(MeshOrderTest, KeepsTrianglesAndTheirTurn) {
    const Grid before = scatteredGrid();
    Grid after = before;
    const std::vector<std::uint32_t> order = scene::orderForReuse(after.vertices, 0, after.indices, 0);
    EXPECT_NE(after.indices, before.indices);
    for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(after.vertices[i].color, order[i]);
    EXPECT_EQ(trianglesOf(after.vertices, 0, after.indices, 0),
              trianglesOf(before.vertices, 0, before.indices, 0));
    // Whole vertices move, none is lost.
    std::vector<char> found(before.vertices.size());
    for (const gpu::Vertex& vertex : after.vertices) {
        EXPECT_EQ(vertex.position, before.vertices.at(vertex.color).position);
        found.at(vertex.color) = 1;
    }
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), static_cast<std::ptrdiff_t>(found.size()));
}

TEST(MeshOrderTest, VerticesAreWorkedOutLessOften) {
    Grid grid = scatteredGrid();
    const int before = workedOut(grid.indices);
    scene::orderForReuse(grid.vertices, 0, grid.indices, 0);
    const int after = workedOut(grid.indices);
    EXPECT_LT(after, before / 2);
    EXPECT_LT(after, static_cast<int>(grid.indices.size()) / 3);  // less than one per triangle
}

TEST(MeshOrderTest, WhatComesBeforeStaysAndUnusedVerticesAreKept) {
    Grid grid = scatteredGrid();
    const Grid first = grid;
    // A second mesh behind the first, whose vertex 0 no triangle names.
    gpu::Vertex vertex{};
    for (const float x : {7.0f, 0.0f, 1.0f, 2.0f}) {
        vertex.position = glm::vec3(x, x * x, 0);
        grid.vertices.push_back(vertex);
    }
    grid.indices.insert(grid.indices.end(), {3, 1, 2});
    const std::vector<std::uint32_t> order =
        scene::orderForReuse(grid.vertices, first.vertices.size(), grid.indices, first.indices.size());
    EXPECT_TRUE(std::equal(first.indices.begin(), first.indices.end(), grid.indices.begin()));
    ASSERT_EQ(grid.vertices.size(), first.vertices.size() + 4);
    for (std::size_t i = 0; i < first.vertices.size(); ++i)
        ASSERT_EQ(grid.vertices[i].position, first.vertices[i].position);
    const std::vector<std::uint32_t> second(grid.indices.end() - 3, grid.indices.end());
    EXPECT_EQ(second, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(grid.vertices[first.vertices.size()].position.x, 2);
    EXPECT_EQ(grid.vertices.back().position.x, 7);
    EXPECT_EQ(order, (std::vector<std::uint32_t>{3, 1, 2, 0}));
}

}  // namespace conelight::test
