// SPDX-License-Identifier: MIT
#include "thesis/format/bodies.h"

#include <algorithm>
#include <cmath>

#include "thesis/format/surface_net.h"

namespace conelight::thesis {
namespace {

using glm::vec3;

// Distances of round parts. All sizes in metres, chosen by eye.
float capsule(const vec3& p, const vec3& a, const vec3& b, float ra, float rb) {
    const vec3 ab = b - a;
    const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
    return glm::length(p - a - t * ab) - glm::mix(ra, rb, t);
}

// Not exact away from the surface, but of the right sign everywhere.
float ellipsoid(const vec3& p, const vec3& centre, const vec3& radii) {
    const vec3 q = (p - centre) / radii;
    const float k = glm::length(q), g = glm::length(q / radii);
    return g > 1e-6f ? k * (k - 1) / g : -std::min({radii.x, radii.y, radii.z});
}

// Union with a fillet of about `k`.
float blend(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - 0.25f * h * h * k;
}

vec3 turnedZ(const vec3& p, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x + s * p.y, -s * p.x + c * p.y, p.z};
}

vec3 turnedX(const vec3& p, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {p.x, c * p.y + s * p.z, -s * p.y + c * p.z};
}

vec3 turnedY(const vec3& p, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
}

// A robe from the ground to the waist, with folds that run down and swing.
float robe(const vec3& p) {
    const float around = std::atan2(p.z, p.x), low = std::clamp(1 - p.y / 0.55f, 0.0f, 1.0f);
    const float fold =
        0.014f * low * std::sin(13 * around + 5 * p.y) + 0.006f * low * std::sin(29 * around - 9 * p.y);
    const float flare = 0.05f * low * low * low;
    const float base =
        capsule(p * vec3(1, 1, 1.12f), {0, 0.08f, 0}, {0, 0.56f, 0}, 0.125f, 0.07f) - flare - fold;
    return 0.7f * std::max(base, 0.015f - p.y);  // folds steepen the distance
}

// A wing: layers of feathers on a bent sheet. `side`: -1 or 1.
float wing(const vec3& p, float side) {
    const vec3 q = turnedY(vec3(side * p.x, p.y, p.z) - vec3(0.05f, 0.66f, -0.075f), 0.45f);
    const vec3 r = turnedZ(q, -0.35f);
    const float bend = 0.9f * r.x * r.x;
    const float feather = 0.006f * std::sin(95 * r.x) * std::clamp((0.12f - r.y) * 4, 0.0f, 1.0f);
    const vec3 s(r.x, r.y, r.z + bend + feather);
    const float upper = ellipsoid(s, {0.13f, 0.07f, 0}, {0.16f, 0.12f, 0.020f});
    const float lower = ellipsoid(turnedZ(s, -0.30f), {0.19f, -0.10f, 0}, {0.085f, 0.27f, 0.017f});
    return 0.7f * blend(upper, lower, 0.03f);
}

float statue(const vec3& p) {
    float d = robe(p);
    d = blend(d, ellipsoid(p, {0, 0.60f, 0.005f}, {0.083f, 0.11f, 0.062f}), 0.03f);              // trunk
    d = blend(d, capsule(p, {-0.08f, 0.695f, 0}, {0.08f, 0.695f, 0}, 0.034f, 0.034f), 0.03f);    // shoulders
    d = blend(d, capsule(p, {0, 0.70f, 0}, {0, 0.79f, 0.005f}, 0.03f, 0.024f), 0.02f);           // neck
    d = blend(d, ellipsoid(p, {0, 0.835f, 0.012f}, {0.042f, 0.056f, 0.050f}), 0.012f);           // head
    d = blend(d, ellipsoid(p, {0, 0.856f, -0.022f}, {0.047f, 0.046f, 0.042f}), 0.012f);          // hair
    d = blend(d, capsule(p, {0, 0.827f, 0.058f}, {0, 0.842f, 0.054f}, 0.009f, 0.006f), 0.012f);  // nose
    d = blend(d, capsule(p, {0.095f, 0.695f, 0}, {0.175f, 0.79f, 0.03f}, 0.029f, 0.023f), 0.02f);
    d = blend(d, capsule(p, {0.175f, 0.79f, 0.03f}, {0.155f, 0.93f, 0.06f}, 0.022f, 0.016f), 0.012f);
    d = blend(d, capsule(p, {0.155f, 0.90f, 0.06f}, {0.155f, 1.01f, 0.063f}, 0.012f, 0.026f),
              0.01f);  // torch
    d = blend(d, ellipsoid(p, {0.155f, 1.045f, 0.064f}, {0.024f, 0.042f, 0.024f}), 0.008f);
    d = blend(d, capsule(p, {-0.095f, 0.695f, 0}, {-0.145f, 0.575f, 0.03f}, 0.029f, 0.024f), 0.02f);
    d = blend(d, capsule(p, {-0.145f, 0.575f, 0.03f}, {-0.07f, 0.53f, 0.105f}, 0.023f, 0.018f), 0.012f);
    d = blend(d, std::min(wing(p, 1), wing(p, -1)), 0.02f);
    const vec3 foot(glm::length(glm::vec2(p.x, p.z)) - 0.17f, std::abs(p.y - 0.02f) - 0.02f, 0);
    const float plinth =
        glm::length(glm::max(foot, vec3(0))) + std::min(std::max(foot.x, foot.y), 0.0f) - 0.006f;
    return std::min(d, plinth);
}

float rabbit(const vec3& p) {
    const vec3 m(std::abs(p.x), p.y, p.z);  // alike on both sides
    float d = ellipsoid(p, {0, 0.29f, -0.06f}, {0.21f, 0.24f, 0.29f});
    d = blend(d, ellipsoid(p, {0, 0.36f, 0.16f}, {0.14f, 0.20f, 0.15f}), 0.10f);
    d = blend(d, ellipsoid(p, {0, 0.59f, 0.26f}, {0.115f, 0.115f, 0.15f}), 0.06f);
    d = blend(d, ellipsoid(p, {0, 0.555f, 0.385f}, {0.062f, 0.055f, 0.05f}), 0.04f);
    d = blend(d,
              ellipsoid(turnedX(m - vec3(0.062f, 0.68f, 0.19f), -0.28f), {0.012f, 0.16f, 0},
                        {0.042f, 0.18f, 0.027f}),
              0.03f);
    d = blend(d, ellipsoid(m, {0.155f, 0.19f, -0.10f}, {0.10f, 0.17f, 0.18f}), 0.04f);
    d = blend(d, capsule(m, {0.15f, 0.045f, -0.08f}, {0.15f, 0.045f, 0.16f}, 0.045f, 0.042f), 0.04f);
    d = blend(d, capsule(m, {0.075f, 0.27f, 0.22f}, {0.075f, 0.04f, 0.29f}, 0.05f, 0.04f), 0.04f);
    d = blend(d, ellipsoid(p, {0, 0.20f, -0.36f}, {0.075f, 0.075f, 0.065f}), 0.04f);
    d += 0.0035f * std::sin(41 * p.x + 3) * std::sin(37 * p.y) * std::sin(43 * p.z);  // fur
    return 0.85f * d;
}

// The dragon's spine, from tail to neck.
vec3 spine(float s) {
    const float along = -0.85f + 1.5f * s;
    const float wave = 0.20f * std::sin(5.2f * s + 0.4f) * (1 - 0.4f * s);
    const float rise =
        0.17f + 0.14f * std::sin(3.1f * s) + 0.52f * std::pow(std::max(s - 0.68f, 0.0f) / 0.32f, 1.6f);
    return {along, rise, wave};
}

float dragon(const vec3& p) {
    constexpr int kPieces = 28;
    float d = 1e9f;
    for (int i = 0; i < kPieces; ++i) {
        const float a = float(i) / kPieces, b = float(i + 1) / kPieces;
        const auto radius = [](float s) {
            return 0.018f + 0.115f * std::sin(3.0f * std::pow(s, 0.85f)) * (1 - 0.25f * s);
        };
        d = blend(d, capsule(p, spine(a), spine(b), radius(a), radius(b)), 0.02f);
        if (i % 2 == 1 && i < kPieces - 2) {  // the comb along the back
            const vec3 top = spine(b) + vec3(0, radius(b), 0);
            d = blend(d, capsule(p, top, top + vec3(-0.03f, 0.045f + 0.2f * radius(b), 0), 0.018f, 0.005f),
                      0.012f);
        }
    }
    const vec3 head = spine(1) + vec3(0.05f, 0.05f, 0);
    const vec3 q = p - head, m(q.x, q.y, std::abs(q.z));
    d = blend(d, ellipsoid(q, vec3(0), {0.11f, 0.075f, 0.07f}), 0.04f);
    d = blend(d, capsule(q, {0.06f, 0.0f, 0}, {0.20f, -0.012f, 0}, 0.045f, 0.030f), 0.03f);    // upper jaw
    d = blend(d, capsule(q, {0.04f, -0.05f, 0}, {0.17f, -0.085f, 0}, 0.030f, 0.018f), 0.02f);  // lower jaw
    d = blend(d, capsule(m, {-0.03f, 0.05f, 0.035f}, {-0.15f, 0.14f, 0.06f}, 0.022f, 0.007f),
              0.015f);                                                          // horns
    d = blend(d, ellipsoid(m, {0.055f, 0.045f, 0.045f}, vec3(0.022f)), 0.01f);  // brows
    for (const float s : {0.42f, 0.72f})
        for (const float side : {-1.0f, 1.0f}) {
            const vec3 hip = spine(s) + vec3(0, -0.02f, side * 0.07f),
                       knee = hip + vec3(0.05f, -0.05f, side * 0.09f);
            const vec3 ankle(knee.x - 0.05f, 0.04f, knee.z),
                toe(ankle.x + 0.10f, 0.028f, ankle.z + side * 0.02f);
            d = blend(d, capsule(p, hip, knee, 0.062f, 0.042f), 0.03f);
            d = blend(d, capsule(p, knee, ankle, 0.040f, 0.028f), 0.02f);
            d = blend(d, capsule(p, ankle, toe, 0.030f, 0.018f), 0.015f);
        }
    d += 0.004f * std::sin(70 * p.x) * std::sin(62 * p.y + 30 * p.z);  // scales
    return 0.75f * std::max(d, 0.002f - p.y);
}

}  // namespace

Mesh statueMesh(int detail) {
    return surfaceNet(statue, {{-0.42f, 0, -0.36f}, {0.42f, 1.1f, 0.22f}}, 1.0f / float(detail));
}

Mesh rabbitMesh(int detail) {
    return surfaceNet(rabbit, {{-0.32f, -0.02f, -0.48f}, {0.32f, 1.08f, 0.50f}}, 1.0f / float(detail));
}

Mesh dragonMesh(int detail) {
    return surfaceNet(dragon, {{-0.92f, -0.01f, -0.40f}, {0.98f, 1.08f, 0.40f}}, 1.0f / float(detail));
}

}  // namespace conelight::thesis
