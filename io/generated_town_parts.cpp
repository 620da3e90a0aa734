// SPDX-License-Identifier: MIT
// Trees, lamps, furniture and what stands on the square of builtin:town: sizes in m -> Mesh.
#include "io/generated_town_parts.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace conelight::io::generated {
namespace {

constexpr glm::vec3 kOak(0.36f, 0.23f, 0.13f), kCastIron(0.05f, 0.055f, 0.05f),
    kFountainStone(0.56f, 0.53f, 0.47f);

void addChair(PaintedMesh& painted, const glm::mat4& place) {
    painted.box({-0.21f, 0.43f, -0.21f}, {0.21f, 0.46f, 0.21f}, kOak, place);
    for (const float x : {-0.2f, 0.17f})
        for (const float z : {-0.2f, 0.17f})
            painted.box({x, 0.01f, z}, {x + 0.03f, z < 0 ? 0.9f : 0.43f, z + 0.03f}, kOak, place);
    painted.box({-0.17f, 0.7f, -0.195f}, {0.17f, 0.88f, -0.18f}, kOak, place);
}

void addTable(PaintedMesh& painted, const glm::mat4& place) {
    painted.add(cylinder(0.5f, 0.71f, 0.74f, 28, 1), 1.2f * kOak, place);
    painted.add(cylinder(0.04f, 0.02f, 0.71f, 12, 1), kCastIron, place);
    painted.add(cylinder(0.28f, 0.01f, 0.03f, 20, 1), kCastIron, place);
    for (int i = 0; i < 3; ++i) {
        const float a = 2.1f * float(i) + 0.4f;
        addChair(painted, place * turnAboutY(a) * translation({0, 0, 0.72f}) * turnAboutY(3.14159265f));
        painted.add(cup(0.04f, 0.08f, 0.005f, 16), {0.7f, 0.7f, 0.68f},
                    place * turnAboutY(a) * translation({0.1f, 0.741f, 0.25f}));
    }
}

}  // namespace

void PaintedMesh::add(const Mesh& part, glm::vec3 colour, const glm::mat4& place) {
    merge(mesh_, part, place);
    mesh_.colors.resize(mesh_.positions.size(), glm::vec4(glm::min(colour, glm::vec3(0.8f)), 1));
}

void PaintedMesh::box(glm::vec3 low, glm::vec3 high, glm::vec3 colour, const glm::mat4& place) {
    add(generated::box({low, high}), colour, place);
}

// Two round tables, a counter with shelves of books and bottles behind it, pictures, a rug.
Mesh townFurniture() {
    PaintedMesh painted;
    addTable(painted, translation({2.3f, 0, -2.4f}));
    addTable(painted, translation({5.6f, 0, -1.9f}) * turnAboutY(1.1f));
    painted.box({1.2f, 0.011f, -3.5f}, {3.4f, 0.022f, -1.3f}, {0.42f, 0.10f, 0.08f});
    painted.box({5.2f, 0.01f, -3.6f}, {7.3f, 1.0f, -3.1f}, 0.8f * kOak);
    painted.box({5.1f, 1.0f, -3.65f}, {7.4f, 1.05f, -3.0f}, {0.5f, 0.48f, 0.44f});
    for (int shelf = 0; shelf < 3; ++shelf) {
        const float y = 1.2f + 0.45f * float(shelf);
        painted.box({5.0f, y, -4.42f}, {7.6f, y + 0.03f, -4.18f}, kOak);
        for (int i = 0; i < 16; ++i) {
            const float x = 5.05f + 0.157f * float(i), tall = 0.18f + 0.16f * randomAt(3, i, shelf);
            const glm::vec3 colour(0.15f + 0.5f * randomAt(4, i, shelf), 0.12f + 0.3f * randomAt(5, i, shelf),
                                   0.1f + 0.3f * randomAt(6, i, shelf));
            painted.add(cylinder(0.045f, y + 0.03f, y + 0.03f + tall, 10, 1), colour,
                        translation({x + 0.06f, 0, -4.3f}));
        }
    }
    for (int i = 0; i < 2; ++i) {
        const float z = -1.6f - 1.4f * float(i);
        painted.box({0.3f, 1.35f, z - 0.5f}, {0.33f, 2.05f, z + 0.5f}, kOak);
        painted.box({0.33f, 1.41f, z - 0.44f}, {0.335f, 1.99f, z + 0.44f},
                    i == 0 ? glm::vec3(0.16f, 0.3f, 0.42f) : glm::vec3(0.5f, 0.36f, 0.12f));
    }
    painted.add(rod({4, 2.6f, -2.4f}, {4, 2.95f, -2.4f}, 0.012f, 8), kCastIron);
    return painted.take();
}

// A trunk with boughs, and clumps of leaves at their ends.
Mesh townTree(int leavesPerClump, float leaf, std::uint32_t seed) {
    constexpr int kBoughs = 8;
    PaintedMesh painted;
    const glm::vec3 bark(0.20f, 0.15f, 0.11f);
    painted.add(
        turned({shapes::line({0.22f, 0}, {0.15f, 0.5f}), shapes::line({0.15f, 0.5f}, {0.11f, 3.6f}, 3)}, 9),
        bark);
    for (int i = 0; i <= kBoughs; ++i) {
        const float a = 2 * glm::pi<float>() * (float(i) + 0.7f * randomAt(seed, i)) / kBoughs;
        const float out = i == kBoughs ? 0.1f : 1.0f + 0.6f * randomAt(seed, i, 1);
        const glm::vec3 tip(out * std::cos(a),
                            3.3f + 1.6f * randomAt(seed, i, 2) + (i == kBoughs ? 1.0f : 0.0f),
                            out * std::sin(a));
        painted.add(rod({0, 2.4f + 0.1f * float(i), 0}, tip, 0.045f, 5), bark);
        const float tone = 0.8f + 0.45f * randomAt(seed, i, 3);
        painted.add(leaves({1.05f, 0.8f, 1.05f}, leavesPerClump, leaf, seed + std::uint32_t(31 * i)),
                    tone * glm::vec3(0.17f + 0.06f * randomAt(seed, i, 4), 0.29f, 0.07f), translation(tip));
    }
    return painted.take();
}

Mesh townLampPost() {
    PaintedMesh painted;
    painted.add(
        turned({shapes::line({0.16f, 0}, {0.13f, 0.5f}, 2), shapes::line({0.13f, 0.5f}, {0.05f, 0.75f}, 2),
                shapes::line({0.05f, 0.75f}, {0.04f, 3.8f}, 2), shapes::line({0.04f, 3.8f}, {0.05f, 3.88f}),
                shapes::line({0.05f, 3.88f}, {0, 3.9f})},
               12),
        kCastIron);
    for (int i = 0; i < 4; ++i) {
        const float a = 0.5f * glm::pi<float>() * float(i);
        painted.add(rod({0.03f * std::cos(a), 3.88f, 0.03f * std::sin(a)},
                        {0.2f * std::cos(a), 4.4f, 0.2f * std::sin(a)}, 0.01f, 5),
                    kCastIron);
    }
    painted.add(turned({shapes::line({0, 4.4f}, {0.27f, 4.4f}), shapes::line({0.27f, 4.4f}, {0.05f, 4.62f}),
                        shapes::line({0.05f, 4.62f}, {0, 4.75f})},
                       12),
                kCastIron);
    return painted.take();
}

Mesh townFountain() {
    PaintedMesh painted;
    const auto stone = [&](const std::vector<shapes::Curve>& profile, int around) {
        painted.add(turned(profile, around), kFountainStone);
    };
    stone({shapes::line({3.4f, 0}, {3.4f, 0.15f}), shapes::line({3.4f, 0.15f}, {3.0f, 0.15f}),
           shapes::line({3.0f, 0.15f}, {2.95f, 0.5f}),
           shapes::arc({2.93f, 0.6f}, {0.14f, 0.1f}, -1.57f, 1.57f, 6),
           shapes::line({2.93f, 0.7f}, {2.7f, 0.7f}), shapes::line({2.7f, 0.7f}, {2.65f, 0.2f}),
           shapes::line({2.65f, 0.2f}, {0, 0.2f})},
          48);
    stone({shapes::line({0.5f, 0.2f}, {0.45f, 0.5f}), shapes::line({0.45f, 0.5f}, {0.22f, 0.8f}, 2),
           shapes::line({0.22f, 0.8f}, {0.2f, 1.5f}, 2), shapes::line({0.2f, 1.5f}, {1.15f, 1.85f}, 4),
           shapes::arc({1.15f, 1.92f}, {0.07f, 0.07f}, -1.57f, 1.57f, 5),
           shapes::line({1.15f, 1.99f}, {0.2f, 1.75f}, 4), shapes::line({0.2f, 1.75f}, {0.13f, 2.4f}, 2),
           shapes::line({0.13f, 2.4f}, {0.55f, 2.6f}, 3), shapes::line({0.55f, 2.6f}, {0.5f, 2.68f}),
           shapes::line({0.5f, 2.68f}, {0, 2.5f}, 2)},
          36);
    return painted.take();
}

Mesh townWater() {
    Mesh water = turned({shapes::line({2.67f, 0.55f}, {0.2f, 0.55f}, 3)}, 48);
    merge(water, turned({shapes::line({1.08f, 1.95f}, {0.15f, 1.95f})}, 36));
    return water;
}

Mesh townBench() {
    PaintedMesh painted;
    for (int i = 0; i < 4; ++i)
        painted.box({-0.9f, 0.43f, -0.2f + 0.11f * float(i)}, {0.9f, 0.46f, -0.11f + 0.11f * float(i)}, kOak);
    for (int i = 0; i < 3; ++i)
        painted.box({-0.9f, 0.56f + 0.13f * float(i), -0.26f}, {0.9f, 0.65f + 0.13f * float(i), -0.235f},
                    kOak);
    for (const float x : {-0.75f, 0.7f}) {
        painted.box({x, 0, -0.27f}, {x + 0.05f, 0.92f, -0.22f}, kCastIron);
        painted.box({x, 0, 0.18f}, {x + 0.05f, 0.43f, 0.23f}, kCastIron);
        painted.box({x, 0.38f, -0.22f}, {x + 0.05f, 0.43f, 0.18f}, kCastIron);
    }
    return painted.take();
}

// A table of boxes with fruit below a striped roof of cloth on four poles.
Mesh townStall(glm::vec3 cloth) {
    PaintedMesh painted;
    for (const float x : {-1.4f, 1.35f})
        for (const float z : {-0.9f, 0.85f})
            painted.box({x, 0, z}, {x + 0.05f, z < 0 ? 2.3f : 2.05f, z + 0.05f}, kOak);
    painted.box({-1.35f, 0.72f, -0.8f}, {1.35f, 0.78f, 0.8f}, kOak);
    constexpr int kStripes = 10;
    for (int i = 0; i < kStripes; ++i) {
        const glm::vec3 colour = i % 2 == 0 ? cloth : glm::vec3(0.7f, 0.68f, 0.62f);
        const float x = -1.6f + 0.32f * float(i);
        painted.add(quad({x, 2.05f, 1.15f}, {0.32f, 0, 0}, {0, 0.4f, -2.2f}), colour);
        painted.add(quad({x, 2.44f, -1.05f}, {0.32f, 0, 0}, {0, -0.4f, 2.2f}), colour);
        painted.box({x, 1.88f, 1.14f}, {x + 0.32f, 2.05f, 1.15f}, colour);
    }
    for (int i = 0; i < 10; ++i) {
        const glm::mat4 place = translation({-1.3f + 0.52f * float(i % 5), 0.78f, i < 5 ? 0.1f : -0.65f});
        const glm::vec3 fruit = glm::vec3(0.55f, 0.12f + 0.4f * randomAt(8, i), 0.05f);
        painted.box({0, 0, 0}, {0.46f, 0.16f, 0.6f}, 1.3f * kOak, place);
        for (int k = 0; k < 12; ++k)
            painted.add(
                sphere(0.06f, 8), fruit,
                place * translation({0.08f + 0.1f * float(k % 4), 0.18f, 0.1f + 0.19f * float(k / 4)}));
    }
    return painted.take();
}

}  // namespace conelight::io::generated
