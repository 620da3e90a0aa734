// SPDX-License-Identifier: MIT
// Clip and time -> transforms. Interpolations as in the specification of glTF 2.0, appendix C.
#include "io/animation.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "conelight/error.h"

namespace conelight::io {

namespace {

glm::quat quatOf(const glm::vec4& v) { return {v.w, v.x, v.y, v.z}; }

glm::vec4 unitOf(const glm::vec4& v) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : glm::vec4(0, 0, 0, 1);
}

bool invertible(const glm::mat4& m) {
    const double determinant = glm::determinant(glm::dmat3(glm::dmat4(m)));
    if (!std::isfinite(determinant) || determinant == 0.0) return false;
    const glm::mat3 inverse = glm::inverse(glm::mat3(m));
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            if (!std::isfinite(inverse[c][r])) return false;
    return true;
}

}  // namespace

glm::mat4 NodePose::parentFromNode() const {
    if (matrix) return *matrix;
    glm::mat4 m = glm::mat4_cast(rotation);
    for (int c = 0; c < 3; ++c) m[c] *= scale[c];
    m[3] = glm::vec4(translation, 1.0f);
    return m;
}

namespace {

// Values between two keys: s of the way from key k to key k + 1, `length` seconds apart.
struct Between {
    std::size_t key = 0;
    bool held = true;  // the key's own value
    float s = 0, length = 0;
};

Between betweenAt(const NodeTrack& track, float time) {
    const std::vector<float>& times = track.times;
    // The last key at or before the time.
    const std::size_t after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (after == 0) return {};
    const std::size_t k = after - 1;
    if (after == times.size() || track.interpolation == Interpolation::Step) return {k};
    const float length = times[after] - times[k];
    return {k, false, (time - times[k]) / length, length};
}

// Hermite's polynomial; slopes are per second.
template <class T>
T hermite(const Between& at, const T& from, const T& leaving, const T& to, const T& arriving) {
    const float s = at.s, s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * from + at.length * (s3 - 2 * s2 + s) * leaving + (3 * s2 - 2 * s3) * to +
           at.length * (s3 - s2) * arriving;
}

}  // namespace

glm::vec4 NodeTrack::at(float time) const {
    const bool cubic = interpolation == Interpolation::CubicSpline, turns = value == NodeValue::Rotation;
    const auto key = [&](std::size_t k) { return values[cubic ? 3 * k + 1 : k]; };
    const auto done = [&](const glm::vec4& v) { return turns ? unitOf(v) : v; };
    const Between between = betweenAt(*this, time);
    const std::size_t k = between.key, after = k + 1;
    if (between.held) return done(key(k));
    if (cubic) return done(hermite(between, key(k), values[3 * k + 2], key(after), values[3 * after]));
    if (!turns) return glm::mix(key(k), key(after), between.s);
    const glm::quat q = glm::slerp(quatOf(unitOf(key(k))), quatOf(unitOf(key(after))), between.s);
    return unitOf({q.x, q.y, q.z, q.w});
}

std::vector<float> NodeTrack::weightsAt(float time) const {
    const bool cubic = interpolation == Interpolation::CubicSpline;
    const std::size_t rows = cubic ? 3 * times.size() : times.size(), count = weights.size() / rows;
    const auto row = [&](std::size_t r, std::size_t i) { return weights[r * count + i]; };
    const auto key = [&](std::size_t k, std::size_t i) { return row(cubic ? 3 * k + 1 : k, i); };
    const Between between = betweenAt(*this, time);
    const std::size_t k = between.key, after = k + 1;
    std::vector<float> out(count);
    for (std::size_t i = 0; i < count; ++i)
        out[i] = between.held ? key(k, i)
                 : cubic ? hermite(between, key(k, i), row(3 * k + 2, i), key(after, i), row(3 * after, i))
                         : glm::mix(key(k, i), key(after, i), between.s);
    return out;
}

void placeLight(Light& light, const glm::mat4& worldFromNode) {
    light.position = glm::vec3(worldFromNode[3]);
    const glm::vec3 along = -glm::vec3(worldFromNode[2]);
    const float length = glm::length(along);
    light.direction = length > 0.0f && std::isfinite(length) ? along / length : glm::vec3(0, 0, -1);
    // A profile turns with its lamp.
    const glm::vec3 across(worldFromNode[0]);
    const float width = glm::length(across);
    if (light.profile != nullptr && width > 0.0f && std::isfinite(width)) light.halfU = across / width;
}

bool placeCamera(Camera& camera, const glm::mat4& worldFromNode, float distance) {
    const glm::vec3 forward = -glm::vec3(worldFromNode[2]), up = glm::vec3(worldFromNode[1]);
    const float slant = glm::length(glm::cross(forward, up));
    if (!(slant > 0.0f) || !std::isfinite(slant)) return false;
    camera.eye = glm::vec3(worldFromNode[3]);
    camera.target = camera.eye + glm::normalize(forward) * distance;
    camera.up = glm::normalize(up);
    return true;
}

namespace {

std::vector<glm::mat4> worldFromNodes(const SceneAnimation& animation, const std::vector<NodePose>& poses) {
    std::vector<glm::mat4> worldFromNode(poses.size());
    for (const std::size_t n : animation.parentsFirst) {
        const int parent = animation.nodes[n].parent;
        const glm::mat4 local = poses[n].parentFromNode();
        worldFromNode[n] = parent < 0 ? local : worldFromNode[std::size_t(parent)] * local;
    }
    return worldFromNode;
}

std::vector<NodePose> restOf(const SceneAnimation& animation) {
    std::vector<NodePose> poses;
    for (const AnimatedNode& node : animation.nodes) poses.push_back(node.rest);
    return poses;
}

}  // namespace

NodePoses restPoses(const SceneAnimation& animation) {
    return {worldFromNodes(animation, restOf(animation)),
            std::vector<std::vector<float>>(animation.nodes.size())};
}

NodePoses posesAt(const SceneAnimation& animation, std::size_t clip, float time) {
    NodePoses out;
    out.weights.resize(animation.nodes.size());
    std::vector<NodePose> poses = restOf(animation);
    for (const NodeTrack& track : animation.clips.at(clip).tracks) {
        if (track.value == NodeValue::Weights) {
            out.weights[track.node] = track.weightsAt(time);
            continue;
        }
        const glm::vec4 v = track.at(time);
        NodePose& pose = poses[track.node];
        if (track.value == NodeValue::Translation) pose.translation = glm::vec3(v);
        if (track.value == NodeValue::Rotation) pose.rotation = quatOf(v);
        if (track.value == NodeValue::Scale) pose.scale = glm::vec3(v);
    }
    out.worldFromNode = worldFromNodes(animation, poses);
    return out;
}

void poseScene(const SceneAnimation& animation, std::size_t clip, float time, const Scene& rest,
               Scene& scene) {
    poseScene(animation, posesAt(animation, clip, time), rest, scene);
}

void poseScene(const SceneAnimation& animation, const NodePoses& poses, const Scene& rest, Scene& scene) {
    const std::vector<glm::mat4>& worldFromNode = poses.worldFromNode;
    for (const SceneAnimation::Hung& hung : animation.instances) {
        Instance& instance = scene.instances[hung.index];
        const glm::mat4 placed = worldFromNode[hung.node] * hung.nodeFromThing;
        const bool usable = invertible(placed);
        instance.visible = usable && rest.instances[hung.index].visible;
        if (usable) instance.worldFromObject = placed;
    }
    for (const SceneAnimation::Hung& hung : animation.lights)
        placeLight(scene.lights[hung.index], worldFromNode[hung.node]);
    for (const SceneAnimation::Hung& hung : animation.cameras)
        placeCamera(scene.cameras[hung.index], worldFromNode[hung.node], hung.distance);
}

void markMoving(const SceneAnimation& animation, Scene& scene) {
    std::vector<bool> moves(animation.nodes.size(), false), deforms(scene.meshes.size(), false);
    for (const AnimationClip& clip : animation.clips)
        for (const NodeTrack& track : clip.tracks)
            if (track.value != NodeValue::Weights) moves[track.node] = true;
    for (const std::size_t node : animation.parentsFirst) {
        const int parent = animation.nodes[node].parent;
        if (parent >= 0 && moves[static_cast<std::size_t>(parent)]) moves[node] = true;
    }
    if (!animation.clips.empty())
        for (const DeformedMesh& mesh : animation.meshes) deforms[mesh.mesh] = true;
    for (const SceneAnimation::Hung& hung : animation.instances)
        if (moves[hung.node]) scene.instances[hung.index].dynamic = true;
    for (Instance& instance : scene.instances)
        if (deforms[static_cast<std::size_t>(instance.mesh)]) instance.dynamic = true;
}

std::size_t clipNumber(const SceneAnimation& animation, const std::string& nameOrNumber) {
    std::string known;
    for (std::size_t i = 0; i < animation.clips.size(); ++i) {
        if (animation.clips[i].name == nameOrNumber) return i;
        known += fmt::format("{}{} ({})", i > 0 ? ", " : "", animation.clips[i].name, i);
    }
    std::size_t number = 0;
    const char* const end = nameOrNumber.data() + nameOrNumber.size();
    const auto [stop, error] = std::from_chars(nameOrNumber.data(), end, number);
    if (error == std::errc() && stop == end && number < animation.clips.size()) return number;
    throw Error(ErrorKind::Usage,
                fmt::format("there is no clip '{}'; {}", nameOrNumber,
                            known.empty() ? "the scene has none" : known + " would be right"));
}

}  // namespace conelight::io
