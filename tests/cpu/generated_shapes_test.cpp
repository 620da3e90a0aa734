// SPDX-License-Identifier: MIT
// Shapes and textures of the generated scenes: exact normals on spheres and cylinders, closed solids,
// promised triangle counts, tangents as normal maps expect them, textures without seams.
#include "io/generated_shapes.h"

#include <glm/gtc/constants.hpp>
#include "io/generated_textures.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace conelight {
namespace {

namespace shapes = io::shapes;
namespace textures = io::textures;

// Sum over all triangles of the signed tetrahedron volumes: that of the solid if its faces look outward.
double signedVolume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

// Edges whose opposite does not occur as often as they do; points are welded on a lattice of 10 micrometres.
std::size_t openEdges(const std::vector<Mesh>& meshes) {
    using Point = std::array<long, 3>;
    std::map<std::pair<Point, Point>, int> balance;
    auto weld = [](glm::vec3 p) {
        return Point{std::lround(double(p.x) * 1e5), std::lround(double(p.y) * 1e5),
                     std::lround(double(p.z) * 1e5)};
    };
    for (const Mesh& mesh : meshes)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const Point from = weld(mesh.positions[mesh.indices[i + k]]);
                const Point to = weld(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
                if (from < to)
                    ++balance[{from, to}];
                else
                    --balance[{to, from}];
            }
    std::size_t open = 0;
    for (const auto& [edge, sum] : balance) open += sum != 0;
    return open;
}

TEST(GeneratedShapes, SphereIsClosedWithRadialNormals) {
    const glm::vec3 centre(0.3f, -1, 2);
    Mesh mesh;
    shapes::appendPatch(mesh, shapes::uvSphere(centre, glm::vec3(0.5f), 48, 24));
    EXPECT_EQ(mesh.triangleCount(), 2u * 48 * 24 - 2 * 48);  // the poles' empty halves are left out
    EXPECT_EQ(openEdges({mesh}), 0u);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_GT(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i] - centre)), 0.99999f);
    for (glm::vec3& p : mesh.positions) p -= centre;
    EXPECT_NEAR(signedVolume(mesh), 4.0 / 3 * double(glm::pi<float>()) * 0.125, 0.01 * 0.5236);
}

TEST(GeneratedShapes, LatheFollowsItsProfile) {
    // A closed cylinder: creases stay sharp, the side's normals are horizontal, the caps' vertical.
    Mesh mesh;
    for (const shapes::Patch& patch :
         shapes::lathe({shapes::line({0, 0}, {0.4f, 0}), shapes::line({0.4f, 0}, {0.4f, 1.5f}, 3),
                        shapes::line({0.4f, 1.5f}, {0, 1.5f})},
                       64, 0.4f))
        shapes::appendPatch(mesh, patch);
    EXPECT_EQ(openEdges({mesh}), 0u);
    EXPECT_NEAR(signedVolume(mesh), double(glm::pi<float>()) * 0.16 * 1.5, 0.005 * 0.754);
    for (const glm::vec3& n : mesh.normals)
        EXPECT_TRUE(std::abs(std::abs(n.y) - 1) < 1e-4f || std::abs(n.y) < 1e-4f) << n.y;
}

TEST(GeneratedShapes, BoxesFaceOutwardOrInward) {
    const Aabb bounds{{-1, 0, 2}, {1, 3, 2.5f}};
    Mesh out, in;
    shapes::appendBox(out, bounds);
    shapes::appendBox(in, bounds, true);
    EXPECT_NEAR(signedVolume(out), 3.0, 1e-5);
    EXPECT_NEAR(signedVolume(in), -3.0, 1e-5);
    EXPECT_EQ(openEdges({out}), 0u);
    EXPECT_EQ(openEdges({in}), 0u);
}

TEST(GeneratedShapes, QuadAndFrameFillTheSameRectangle) {
    Mesh mesh;
    const glm::vec3 o(1, 2, 3), u(2, 0, 0), v(0, 0, -1);
    shapes::appendFrame(mesh, o, u, v, {0.25f, 0.3f}, {0.5f, 0.8f});
    shapes::appendQuad(mesh, o + 0.25f * u + 0.3f * v, 0.25f * u, 0.5f * v);
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 n = glm::cross(mesh.positions[mesh.indices[i + 1]] - mesh.positions[mesh.indices[i]],
                                       mesh.positions[mesh.indices[i + 2]] - mesh.positions[mesh.indices[i]]);
        EXPECT_GT(n.y, 0.0f);  // cross(u, v) is up
        area += 0.5 * double(glm::length(n));
    }
    EXPECT_NEAR(area, 2.0, 1e-5);
}

TEST(GeneratedShapes, CellsAreClosedAndSplitByPart) {
    // A block of 3 x 3 x 3 cells with a tunnel along z: volume 27 - 3.
    shapes::CellSolid cells;
    cells.planes.fill({-1.5f, -0.5f, 0.5f, 1.5f});
    cells.solid = [](glm::vec3 p) { return std::abs(p.x) > 0.5f || std::abs(p.y) > 0.5f; };
    cells.part = [](glm::vec3 p, glm::vec3 n) {
        return std::abs(p.x) < 0.6f && std::abs(p.y) < 0.6f && n.z == 0.0f ? 1 : 0;
    };
    const std::vector<Mesh> parts = shapes::buildCells(cells, 2);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_NEAR(signedVolume(parts[0]) + signedVolume(parts[1]), 24.0, 1e-4);
    EXPECT_EQ(openEdges(parts), 0u);
    EXPECT_EQ(parts[1].triangleCount(), 4u * 3 * 2);  // the tunnel's walls
}

TEST(GeneratedShapes, ExtrusionsMeetInMitres) {
    // Four sides around a square hole, profile a triangle in section: closed when the mitres agree.
    const std::vector<shapes::Curve> profile{shapes::line({0, 0}, {0.2f, 0.1f}),
                                             shapes::line({0.2f, 0.1f}, {0, 0.3f}),
                                             shapes::line({0, 0.3f}, {0, 0})};
    const glm::vec3 corner[4] = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    const glm::vec3 out[4] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}};
    Mesh mesh;
    for (int side = 0; side < 4; ++side)
        for (const shapes::Patch& p :
             shapes::extrude(profile, corner[side], corner[(side + 1) % 4], out[side], -1, -1))
            shapes::appendPatch(mesh, p);
    EXPECT_EQ(openEdges({mesh}), 0u);
    EXPECT_GT(signedVolume(mesh), 0.0);
}

TEST(GeneratedShapes, TangentsFollowTheTexture) {
    // On a wall seen from the front the tangent is its right, the bitangent up, toward the texture's first
    // row.
    Mesh mesh;
    shapes::appendQuad(mesh, {0, 0, 0}, {2, 0, 0}, {0, 1, 0});
    shapes::computeTangents(mesh);
    ASSERT_EQ(mesh.tangents.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 t(mesh.tangents[i]);
        const glm::vec3 b = mesh.tangents[i].w * glm::cross(mesh.normals[i], t);
        EXPECT_NEAR(t.x, 1, 1e-6f);
        EXPECT_NEAR(b.y, 1, 1e-6f);
        // The upper corners hold v = 0, the first row.
        EXPECT_EQ(mesh.positions[i].y > 0.5f, mesh.uvs[i].y < 0.5f);
    }
}

TEST(GeneratedShapes, HashSpreads) {
    // 64k consecutive inputs fall evenly into 64 bins of the unit interval, and never collide.
    std::array<int, 64> bins{};
    std::set<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < 65536; ++i) {
        const std::uint32_t h = shapes::hash(i);
        seen.insert(h);
        const float f = shapes::unitFloat(h);
        ASSERT_GE(f, 0.0f);
        ASSERT_LT(f, 1.0f);
        ++bins[std::size_t(f * 64)];
    }
    EXPECT_EQ(seen.size(), 65536u);
    for (int count : bins) EXPECT_NEAR(count, 1024, 5 * 32);  // five standard deviations
}

// ---- Textures -------------------------------------------------------------------------------------------

TEST(GeneratedTextures, NoiseRepeatsWithTheUnitSquare) {
    for (int i = 0; i < 50; ++i) {
        const glm::vec2 uv(0.0137f * float(i), 0.0191f * float(i));
        EXPECT_NEAR(textures::noise(uv, 7, 3), textures::noise(uv + glm::vec2(1, 0), 7, 3), 1e-4f);
        EXPECT_NEAR(textures::noise(uv, 7, 3), textures::noise(uv + glm::vec2(0, -2), 7, 3), 1e-4f);
        EXPECT_LT(std::abs(textures::noise(uv, 7, 3)), 0.8f);
    }
}

// Mean difference between neighbouring columns (or rows) `a` and `b`, over all channels.
double difference(const Texture& t, bool rows, int a, int b) {
    double sum = 0;
    for (int i = 0; i < t.width; ++i)
        for (int k = 0; k < 3; ++k) {
            auto at = [&](int line) {
                const int x = rows ? i : line, y = rows ? line : i;
                return int(t.rgba[std::size_t(4 * (y * t.width + x) + k)]);
            };
            sum += std::abs(at(a) - at(b));
        }
    return sum / (3.0 * t.width);
}

TEST(GeneratedTextures, TileWithoutSeams) {
    const textures::Surface ashlar = textures::ashlar(128), tiles = textures::tiles(128);
    const Texture plaster = textures::plaster(128), marble = textures::marble(128),
                  fabric = textures::fabric(128), wood = textures::wood(128);
    for (const Texture* t : {&ashlar.color, &ashlar.normal, &tiles.color, &tiles.normal, &tiles.roughness,
                             &plaster, &marble, &fabric, &wood}) {
        SCOPED_TRACE(t->name);
        ASSERT_EQ(t->rgba.size(), 4u * 128 * 128);
        EXPECT_FALSE(t->name.empty());
        for (bool rows : {false, true}) {
            // The step across the border is no bigger than the biggest one inside.
            double biggest = 0;
            for (int i = 0; i + 1 < 128; ++i) biggest = std::max(biggest, difference(*t, rows, i, i + 1));
            EXPECT_GT(biggest, 0.0);
            EXPECT_LE(difference(*t, rows, 127, 0), 1.3 * biggest + 0.5);
        }
    }
    EXPECT_TRUE(ashlar.color.srgb);
    EXPECT_FALSE(ashlar.normal.srgb);
    EXPECT_FALSE(tiles.roughness.srgb);
}

TEST(GeneratedTextures, NormalMapsHoldUnitNormalsThatLookOut) {
    for (const Texture& t : {textures::ashlar(64).normal, textures::tiles(64).normal})
        for (std::size_t i = 0; i < t.rgba.size(); i += 4) {
            const glm::vec3 n = glm::vec3(t.rgba[i], t.rgba[i + 1], t.rgba[i + 2]) / 255.0f * 2.0f - 1.0f;
            ASSERT_NEAR(glm::length(n), 1.0f, 0.02f);
            ASSERT_GT(n.z, 0.0f);
        }
    // A tile's upper rim slopes toward the joint above it: its normals lean up, to green above one half.
    const Texture tiles = textures::tiles(256).normal;
    double green = 0;
    for (int x = 20; x < 100; ++x) green += tiles.rgba[std::size_t(4 * (1 * 256 + x) + 1)];
    EXPECT_GT(green / 80, 135.0);
}

}  // namespace
}  // namespace conelight
