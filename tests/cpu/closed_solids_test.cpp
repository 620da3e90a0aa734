// SPDX-License-Identifier: MIT
#include "scene/closed_solids.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/clock.h"
#include "io/generated_shapes.h"
#include "shared/scene.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

Mesh boxOf(const glm::vec3& low, const glm::vec3& high) {
    Mesh mesh;
    io::shapes::appendBox(mesh, {low, high});
    return mesh;
}
// A tube of one wall: outside, rim, inside and two bottoms, or the outside alone.
Mesh cupOf(float radius, float height, float wall, bool whole) {
    std::vector<io::shapes::Curve> profile = {io::shapes::line({0, 0}, {radius, 0}),
                                              io::shapes::line({radius, 0}, {radius, height})};
    if (whole) {
        profile.push_back(io::shapes::line({radius, height}, {radius - wall, height}));
        profile.push_back(io::shapes::line({radius - wall, height}, {radius - wall, wall}));
        profile.push_back(io::shapes::line({radius - wall, wall}, {0, wall}));
    }
    Mesh mesh;
    for (const io::shapes::Patch& patch : io::shapes::lathe(profile, 48, 1))
        io::shapes::appendPatch(mesh, patch);
    return mesh;
}
void append(Mesh& to, const Mesh& from, const glm::vec3& shift) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    for (const glm::vec3& p : from.positions) to.positions.push_back(p + shift);
    for (const std::uint32_t i : from.indices) to.indices.push_back(first + i);
}
std::vector<float> thicknessOf(const Mesh& mesh) {
    return scene::solidThickness(mesh.positions, mesh.indices);
}

TEST(ClosedSolids, ThicknessIsFourVolumesOverTheArea) {
    for (const float thickness : thicknessOf(boxOf({1, 2, 3}, {2, 4, 6})))
        EXPECT_FLOAT_EQ(thickness, 24.0f / 22);
    // Long rods have their diameter, boards twice their thickness.
    EXPECT_NEAR(thicknessOf(boxOf({-5, -5, 0}, {5, 5, 0.01f}))[0], 0.02f, 1e-4f);
    Mesh rod;
    for (const io::shapes::Patch& patch :
         io::shapes::lathe({io::shapes::line({0, 0}, {0.1f, 0}), io::shapes::line({0.1f, 0}, {0.1f, 50}),
                            io::shapes::line({0.1f, 50}, {0, 50})},
                           96, 1))
        io::shapes::appendPatch(rod, patch);
    EXPECT_NEAR(thicknessOf(rod)[0], 0.2f, 1e-3f);
    // A vessel is as thick as twice its wall, not as wide as its rim.
    for (const float thickness : thicknessOf(cupOf(0.2f, 0.4f, 0.004f, true)))
        EXPECT_NEAR(thickness, 0.008f, 3e-4f);
}

TEST(ClosedSolids, WhatHasABorderIsOpen) {
    for (const float thickness : thicknessOf(cupOf(0.2f, 0.4f, 0.004f, false))) EXPECT_LT(thickness, 0);
    Mesh box = boxOf(glm::vec3(0), glm::vec3(1));
    box.indices.resize(box.indices.size() - 3);
    for (const float thickness : thicknessOf(box)) EXPECT_LT(thickness, 0);
    EXPECT_LT(thicknessOf(quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}))[0], 0);
    EXPECT_TRUE(thicknessOf(Mesh{}).empty());
    box = boxOf(glm::vec3(0), glm::vec3(1));
    box.positions[3].y = std::nanf("");
    for (const float thickness : thicknessOf(box)) EXPECT_LT(thickness, 0);
}

// One triangle the other way round: its edges are walked twice the same way.
TEST(ClosedSolids, WhatLooksInwardsIsOpen) {
    Mesh box = boxOf(glm::vec3(0), glm::vec3(1));
    std::swap(box.indices[0], box.indices[1]);
    EXPECT_LT(thicknessOf(box)[0], 0);
    for (std::size_t i = 3; i < box.indices.size(); i += 3) std::swap(box.indices[i], box.indices[i + 1]);
    for (const float thickness : thicknessOf(box)) EXPECT_LT(thickness, 0);  // a room
}

// A sheet that is there twice, back to back, has no inside either.
TEST(ClosedSolids, SheetsBackToBackHaveNoThickness) {
    Mesh sheet = quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    append(sheet, quadMesh({1, 0, 0}, {-1, 0, 0}, {0, 1, 0}), glm::vec3(0));
    for (const float thickness : thicknessOf(sheet)) EXPECT_EQ(thickness, 0);
}

TEST(ClosedSolids, EachPartHasItsOwn) {
    Mesh all = boxOf(glm::vec3(0), glm::vec3(1));
    const std::size_t first = all.positions.size();
    append(all, cupOf(0.2f, 0.4f, 0.004f, false), {3, 0, 0});
    const std::size_t second = all.positions.size();
    append(all, boxOf(glm::vec3(0), glm::vec3(0.1f)), {-3, 0, 0});
    const std::vector<float> thickness = thicknessOf(all);
    EXPECT_NEAR(thickness[0], 2.0f / 3, 1e-5f);
    EXPECT_LT(thickness[first], 0);
    EXPECT_NEAR(thickness[second], 0.2f / 3, 1e-5f);
}

// A bolt, a kilometre from the rest of its mesh.
TEST(ClosedSolids, SmallPartsMayBeFarAway) {
    Mesh all = boxOf(glm::vec3(0), glm::vec3(0.5f));
    const std::size_t first = all.positions.size();
    append(all, boxOf(glm::vec3(0), glm::vec3(0x1p-7f)), {1024, 512, -768});
    const std::size_t second = all.positions.size();
    append(all, boxOf(glm::vec3(0), glm::vec3(0x1p-7f)), {-512, 768, 1024});
    const std::vector<float> thickness = thicknessOf(all);
    EXPECT_NEAR(thickness[first], 0x1p-7f * 2 / 3, 1e-4f);
    EXPECT_NEAR(thickness[second], 0x1p-7f * 2 / 3, 1e-4f);
}

// Both sides of a seam are worked out apart, and are off by rounding.
TEST(ClosedSolids, SeamsMayBeOffByRounding) {
    for (int place = 0; place < 200; ++place) {
        Mesh box = boxOf(glm::vec3(0), glm::vec3(1));
        const glm::vec3 shift(0.37f * static_cast<float>(place), 5, 0.011f * static_cast<float>(place));
        for (std::size_t i = 0; i < box.positions.size(); ++i) {
            box.positions[i] += shift;
            if (i % 3 == 0) box.positions[i] *= 1 + 6e-8f;
        }
        EXPECT_NEAR(thicknessOf(box)[0], 2.0f / 3, 1e-4f) << place;
    }
}

TEST(ClosedSolids, CodesArePowersOfTwo) {
    const auto held = [](float thickness) {
        const std::uint32_t code = scene::solidCode(thickness), word = VERTEX_SOLID_WORD(code);
        EXPECT_EQ(word & ~VERTEX_SOLID_BITS, 0u);
        EXPECT_EQ(VERTEX_SOLID_CODE(word), code);
        return code == 0 ? -1.0f : std::exp2(static_cast<float>(code) - VERTEX_SOLID_BIAS);
    };
    EXPECT_EQ(held(-1), -1);
    EXPECT_EQ(held(1), 1);
    EXPECT_EQ(held(1.01f), 2);
    EXPECT_EQ(held(0.3f), 0.5f);
    EXPECT_EQ(held(2000), 2048);
    EXPECT_EQ(held(3000), -1);  // too thick to be told from what is open
    EXPECT_GT(held(0), 0);      // the least there is
    EXPECT_LT(held(0), 1e-5f);
}

// Not a test: prints what it costs to look through a mesh. docs/notes/2026-11-29-insides-of-solids.md.
TEST(ClosedSolids, DISABLED_CpuTime) {
    Mesh ball;
    io::shapes::appendPatch(ball, io::shapes::uvSphere(glm::vec3(0), glm::vec3(1), 1000, 500));
    const double start = base::processCpuMs();
    EXPECT_GT(thicknessOf(ball)[0], 1);
    fmt::print("{} triangles: {:.0f} CPU ms\n", ball.indices.size() / 3, base::processCpuMs() - start);
}

}  // namespace
}  // namespace conelight::test
