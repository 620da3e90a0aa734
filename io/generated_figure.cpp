// SPDX-License-Identifier: MIT
// Limbs are rigid and hang on nodes: hips, thighs, shins, arms. A second is a stride of 1.2 m, of two steps.
#include "io/generated_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string_view>

#include "io/generated_town_parts.h"

namespace conelight::io::generated {
namespace {

constexpr float kSpeed = 1.2f, kHip = 0.88f, kThigh = 0.44f, kStandsAt = 1.65f;
constexpr int kKeysASecond = 12;

// Node 0 goes along, 1 goes up and down on it, the others turn.
struct Limb {
    std::string_view name;
    int parent;
    glm::vec3 joint;  // in the parent
    float phase;      // of the stride
};
constexpr std::array<Limb, 8> kLimbs = {Limb{"figure", -1, {0, 0, 0}, 0},
                                        {"figure body", 0, {0, 0, 0}, 0},
                                        {"figure thigh left", 1, {0, kHip, -0.09f}, 0},
                                        {"figure thigh right", 1, {0, kHip, 0.09f}, 0.5f},
                                        {"figure shin left", 2, {0, -kThigh, 0}, 0},
                                        {"figure shin right", 3, {0, -kThigh, 0}, 0.5f},
                                        {"figure arm left", 1, {0, 1.40f, -0.23f}, 0.5f},
                                        {"figure arm right", 1, {0, 1.40f, 0.23f}, 0}};

bool isShin(std::size_t limb) { return limb == 4 || limb == 5; }
bool isArm(std::size_t limb) { return limb >= 6; }

// About z, rad; forward is positive.
float angleAt(std::size_t limb, float seconds) {
    const float turn = 2 * glm::pi<float>() * (seconds + kLimbs[limb].phase);
    if (isArm(limb)) return 0.36f * std::sin(turn);
    if (isShin(limb)) return -0.12f - 0.75f * std::max(std::cos(turn + 0.3f), 0.0f);
    return 0.06f + 0.46f * std::sin(turn);
}

Mesh limbMesh(std::size_t limb) {
    const glm::vec3 coat(0.42f, 0.07f, 0.06f), cloth(0.09f, 0.11f, 0.17f), skin(0.52f, 0.31f, 0.21f),
        leather(0.09f, 0.05f, 0.03f);
    PaintedMesh mesh;
    if (limb == 1) {
        const glm::mat4 flat(glm::mat3(0.66f, 0, 0, 0, 1, 0, 0, 0, 1));
        mesh.add(turned({shapes::line({0, 0.74f}, {0.21f, 0.74f}, 1),
                         shapes::line({0.21f, 0.74f}, {0.16f, 1.08f}, 3),
                         shapes::line({0.16f, 1.08f}, {0.22f, 1.38f}, 3),
                         shapes::arc({0, 1.38f}, {0.22f, 0.10f}, 0, 0.5f * glm::pi<float>(), 5)},
                        24),
                 coat, flat);
        mesh.add(rod({0, 1.42f, 0}, {0, 1.56f, 0}, 0.055f), skin);
        mesh.add(sphere(0.11f, 24), skin, translation({0.01f, 1.64f, 0}));
        mesh.add(sphere(0.115f, 24), leather, translation({-0.012f, 1.665f, 0}));
    } else if (isArm(limb)) {
        mesh.add(rod({0, 0.02f, 0}, {0.02f, -0.30f, 0}, 0.052f), coat);
        mesh.add(rod({0.02f, -0.29f, 0}, {0.08f, -0.56f, 0}, 0.044f), coat);
        mesh.add(sphere(0.05f, 16), skin, translation({0.09f, -0.60f, 0}));
    } else if (isShin(limb)) {
        mesh.add(sphere(0.072f, 16), cloth);
        mesh.add(rod({0, 0, 0}, {0, -0.40f, 0}, 0.062f), cloth);
        mesh.box({-0.07f, -kHip + kThigh, -0.045f}, {0.19f, -0.36f, 0.045f}, leather);
    } else {
        mesh.add(rod({0, 0.04f, 0}, {0, -kThigh, 0}, 0.083f), cloth);
    }
    return mesh.take();
}

glm::vec4 turnAboutZ(float angle) { return {0, 0, std::sin(0.5f * angle), std::cos(0.5f * angle)}; }

SceneAnimation walkFrom(glm::vec3 start) {
    SceneAnimation animation;
    AnimationClip clip{"walk", kWalkSeconds, {}};
    for (std::size_t limb = 0; limb < kLimbs.size(); ++limb) {
        AnimatedNode node{kLimbs[limb].parent, {}};
        node.rest.translation = limb == 0 ? start : kLimbs[limb].joint;
        animation.nodes.push_back(node);
        animation.parentsFirst.push_back(limb);
        NodeTrack track;
        track.node = limb;
        track.value = limb < 2 ? NodeValue::Translation : NodeValue::Rotation;
        for (int key = 0; key <= int(kWalkSeconds) * kKeysASecond; ++key) {
            const float seconds = float(key) / kKeysASecond;
            track.times.push_back(seconds);
            if (limb == 0)
                track.values.emplace_back(start + glm::vec3(kSpeed * seconds, 0, 0), 0);
            else if (limb == 1)  // highest where one foot passes the other
                track.values.emplace_back(0, -0.045f * std::abs(std::sin(2 * glm::pi<float>() * seconds)), 0,
                                          0);
            else
                track.values.push_back(turnAboutZ(angleAt(limb, seconds)));
        }
        clip.tracks.push_back(std::move(track));
    }
    animation.clips.push_back(std::move(clip));
    return animation;
}

}  // namespace

void addWalkingFigure(Scene& scene, glm::vec3 start) {
    const int paint = add(scene, matte("cloth of the figure", glm::vec3(0.99f)));
    const NodePoses poses = posesAt(walkFrom(start), 0, kStandsAt);
    for (std::size_t limb = 1; limb < kLimbs.size(); ++limb)
        addPart(scene, limbMesh(limb), std::string(kLimbs[limb].name), paint);
    const std::size_t first = scene.instances.size() - (kLimbs.size() - 1);
    for (std::size_t limb = 1; limb < kLimbs.size(); ++limb) {
        Instance& part = scene.instances[first + limb - 1];
        part.worldFromObject = poses.worldFromNode[limb];
        part.dynamic = true;
    }
}

SceneAnimation figureAnimation(const Scene& scene) {
    const auto body = std::find_if(scene.instances.begin(), scene.instances.end(),
                                   [](const Instance& one) { return one.name == kLimbs[1].name; });
    if (body == scene.instances.end()) return {};
    const NodePoses poses = posesAt(walkFrom(glm::vec3(0)), 0, kStandsAt);
    SceneAnimation animation =
        walkFrom(glm::vec3(body->worldFromObject[3]) - glm::vec3(poses.worldFromNode[1][3]));
    const auto first = static_cast<std::size_t>(body - scene.instances.begin());
    for (std::size_t limb = 1; limb < kLimbs.size(); ++limb)
        animation.instances.push_back({first + limb - 1, limb, glm::mat4(1), 1});
    return animation;
}

}  // namespace conelight::io::generated
