// SPDX-License-Identifier: MIT
// Reads channels and samplers of glTF animations; checks counts, component types, order of times.
#include "io/gltf_animation.h"

#include <fmt/core.h>

#include <algorithm>

#include "io/files.h"

namespace conelight::io {

namespace {

constexpr int kFloat = 5126;

void requireFloats(GltfFile& file, const GltfValue& accessorIndex, bool normalizedToo) {
    const GltfValue accessors = file.array("accessors");
    const auto index = accessorIndex.index(accessors.size());
    if (!index) accessorIndex.fail("is missing; the number of an accessor would be right");
    const GltfValue accessor = accessors[*index];
    if (accessor["componentType"].whole(0) == kFloat) return;
    if (!normalizedToo) accessor["componentType"].fail("must be 5126 (float) for times, places and sizes");
    if (!accessor["normalized"].boolean(false))
        accessor["normalized"].fail("must be true for rotations and weights that are no floats");
}

Interpolation interpolationOf(const GltfValue& sampler) {
    const std::string name = sampler["interpolation"].text("LINEAR");
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    if (name != "LINEAR")
        sampler["interpolation"].fail(
            fmt::format("'{}' is unknown; known: STEP, LINEAR, CUBICSPLINE", oneLine(name)));
    return Interpolation::Linear;
}

// All targets of a key stand side by side.
void readWeights(GltfFile& file, const GltfValue& output, std::size_t targets, NodeTrack& track) {
    track.weights = file.floats(output, 1);
    const std::size_t wanted =
        track.times.size() * targets * (track.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (track.weights.size() != wanted)
        output.fail(fmt::format("has {} weights; {}, for {} morph targets, would be right",
                                track.weights.size(), wanted, targets));
}

// `targets`: morph targets of the node's mesh.
void readSampler(GltfFile& file, const GltfValue& sampler, std::size_t targets, NodeTrack& track) {
    const bool turns = track.value == NodeValue::Rotation;
    const GltfValue input = sampler["input"], output = sampler["output"];
    requireFloats(file, input, false);
    requireFloats(file, output, turns || track.value == NodeValue::Weights);
    track.interpolation = interpolationOf(sampler);
    track.times = file.floats(input, 1);
    if (track.times.empty()) input.fail("has no keys; one time at least would be right");
    for (std::size_t k = 0; k < track.times.size(); ++k) {
        if (track.times[k] < 0.0f) input.fail(fmt::format("time {} is negative", k));
        if (k > 0 && !(track.times[k] > track.times[k - 1]))
            input.fail(fmt::format("time {} is not after the one before it; ascending would be right", k));
    }
    if (track.value == NodeValue::Weights) return readWeights(file, output, targets, track);
    const std::size_t components = turns ? 4 : 3;
    const std::vector<float> numbers = file.floats(output, components);
    const std::size_t wanted =
        track.times.size() * (track.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (numbers.size() != wanted * components)
        output.fail(fmt::format("has {} values; {} would be right", numbers.size() / components, wanted));
    for (std::size_t i = 0; i < wanted; ++i) {
        glm::vec4 v(0);
        for (std::size_t c = 0; c < components; ++c) v[int(c)] = numbers[i * components + c];
        track.values.push_back(v);
    }
}

// The value that a channel moves; nothing for what stays in rest pose.
std::optional<NodeValue> valueOf(const GltfValue& target) {
    const std::string path = target["path"].text("");
    if (path == "translation") return NodeValue::Translation;
    if (path == "rotation") return NodeValue::Rotation;
    if (path == "scale") return NodeValue::Scale;
    if (path == "weights") return NodeValue::Weights;
    if (path == "pointer") return std::nullopt;
    target["path"].fail(
        fmt::format("'{}' is unknown; known: translation, rotation, scale, weights", oneLine(path)));
}

}  // namespace

std::size_t morphTargets(const GltfFile& file, const GltfValue& node) {
    const GltfValue meshes = file.array("meshes");
    const auto mesh = node["mesh"].index(meshes.size());
    return mesh ? meshes[*mesh]["primitives"][std::size_t(0)]["targets"].size() : 0;
}

NodePose readNodePose(const GltfValue& node) {
    NodePose pose;
    if (node["matrix"].exists()) {
        glm::mat4 m;
        node["matrix"].numbers(&m[0][0], 16);
        pose.matrix = m;
        return pose;
    }
    pose.translation = node["translation"].vector<3>(glm::vec3(0));
    const glm::vec4 r = node["rotation"].vector<4>(glm::vec4(0, 0, 0, 1));
    pose.scale = node["scale"].vector<3>(glm::vec3(1));
    const float length = glm::length(r);
    if (!(length > 0.0f)) node["rotation"].fail("a quaternion without length");
    pose.rotation = glm::quat(r.w / length, r.x / length, r.y / length, r.z / length);
    return pose;
}

std::vector<AnimationClip> readClips(GltfFile& file, std::vector<std::string>& notes) {
    std::vector<AnimationClip> clips;
    const GltfValue animations = file.array("animations"), nodes = file.array("nodes");
    std::size_t left = 0;
    for (std::size_t a = 0; a < animations.size(); ++a) {
        const GltfValue samplers = animations[a]["samplers"], channels = animations[a]["channels"];
        AnimationClip clip;
        clip.name = oneLine(animations[a]["name"].text(fmt::format("clip{}", a)));
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const GltfValue target = channels[c]["target"];
            const auto value = valueOf(target);
            const auto node = target["node"].index(nodes.size());
            if (!value || !node) {
                ++left;
                continue;
            }
            const std::size_t targets = *value == NodeValue::Weights ? morphTargets(file, nodes[*node]) : 0;
            if (*value == NodeValue::Weights && targets == 0) {
                ++left;
                continue;
            }
            if (*value != NodeValue::Weights && nodes[*node]["matrix"].exists())
                target["node"].fail("is placed by a matrix; translation, rotation, scale would be right");
            const auto sampler = channels[c]["sampler"].index(samplers.size());
            if (!sampler) channels[c].fail("has no sampler");
            NodeTrack track;
            track.node = *node;
            track.value = *value;
            readSampler(file, samplers[*sampler], targets, track);
            clip.duration = std::max(clip.duration, track.times.back());
            clip.tracks.push_back(std::move(track));
        }
        clips.push_back(std::move(clip));
    }
    if (left > 0)
        notes.push_back(
            fmt::format("{} channel{} of animations left out (pointers, or weights without morph targets)",
                        left, left == 1 ? "" : "s"));
    return clips;
}

}  // namespace conelight::io
