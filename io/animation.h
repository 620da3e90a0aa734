// SPDX-License-Identifier: MIT
// Movement of a scene: nodes in trees, clips of key values over time, and what hangs on which node. A clip at
// a time gives the transforms of instances, point, spot and directional lights, and cameras, and the vertices of
// meshes with skins or morph targets.
//
// Limits: rectangular lights stay where they are. A clip that mirrors what its rest pose does not mirror shows back
// sides.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/scene.h"
#include "io/scene_file.h"

namespace conelight::io {

// A node's place in its parent: a matrix, or translation * rotation * scale.
struct NodePose {
    std::optional<glm::mat4> matrix;
    glm::vec3 translation{0.0f};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1.0f};
    CONELIGHT_API glm::mat4 parentFromNode() const;
};

struct AnimatedNode {
    int parent = -1;
    NodePose rest;
};

enum class NodeValue : std::uint8_t { Translation, Rotation, Scale, Weights };
enum class Interpolation : std::uint8_t { Step, Linear, CubicSpline };

// One value of one node over time, held before the first key and after the last. Rotations are (x, y, z, w).
struct NodeTrack {
    std::size_t node = 0;
    NodeValue value = NodeValue::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times;       // s, ascending, at least one
    std::vector<glm::vec4> values;  // one per time; CubicSpline three: slope in, value, slope out
    std::vector<float> weights;     // instead of values: as many for each of them as there are morph targets
    CONELIGHT_API glm::vec4 at(float time) const;  // of rotations: unit length
    CONELIGHT_API std::vector<float> weightsAt(float time) const;
};

struct AnimationClip {
    std::string name;
    float duration = 0;  // s, time of the last key
    std::vector<NodeTrack> tracks;
};

// What a morph target adds to each vertex, times its weight; empty: nothing.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

// A mesh whose vertices move, by morph targets, then by a skin: linear blends of joints. Its instances stand still
// when it has a skin.
struct DeformedMesh {
    std::size_t mesh = 0;        // of Scene::meshes, whose indices, uvs and colours stay
    std::size_t node = 0;        // has the weights of the targets
    Mesh bind;                   // positions, normals and tangents that targets and joints start from
    std::vector<float> weights;  // at rest, one per target
    std::vector<MorphTarget> targets;
    std::vector<std::size_t> joints;          // nodes; none: no skin
    std::vector<glm::mat4> jointFromBind;     // one per joint
    std::size_t influences = 0;               // joints of a vertex: 4, 8 and so on
    std::vector<std::uint32_t> jointNumbers;  // `influences` per vertex, below joints.size()
    std::vector<float> jointWeights;          // as many; their sum counts as 1
    bool mirrored = false;                    // x of the scene's mesh is turned round
};

struct SceneAnimation {
    // Thing number `index` of its vector hangs on `node`.
    struct Hung {
        std::size_t index = 0, node = 0;
        glm::mat4 nodeFromThing{1.0f};  // of instances
        float distance = 1;             // of cameras: to the target
    };
    std::vector<AnimatedNode> nodes;
    std::vector<std::size_t> parentsFirst;  // all nodes in that order
    std::vector<AnimationClip> clips;
    std::vector<Hung> instances, lights, cameras;
    std::vector<DeformedMesh> meshes;
};

// Where a clip's nodes are at a time.
struct NodePoses {
    std::vector<glm::mat4> worldFromNode;
    std::vector<std::vector<float>> weights;  // by node; empty: as at rest
};
CONELIGHT_API NodePoses posesAt(const SceneAnimation& animation, std::size_t clip, float time);
CONELIGHT_API NodePoses restPoses(const SceneAnimation& animation);

// Puts the scene that `animation` was loaded with into a pose: of clip number `clip` at `time`, s, or the one given.
// Meshes are deform()'s. An instance whose transform has no inverse then is invisible; others are visible as `rest`
// has them.
CONELIGHT_API void poseScene(const SceneAnimation& animation, const NodePoses& poses, const Scene& rest,
                             Scene& scene);
CONELIGHT_API void poseScene(const SceneAnimation& animation, std::size_t clip, float time, const Scene& rest,
                             Scene& scene);

// Gives `mesh`, which is the scene's, the positions, normals and tangents of a pose. False: they are as they were.
// A pose beyond what numbers hold changes nothing.
CONELIGHT_API bool deform(const DeformedMesh& deformed, const NodePoses& poses, Mesh& mesh);

// Marks the instances that any clip moves or deforms as dynamic.
CONELIGHT_API void markMoving(const SceneAnimation& animation, Scene& scene);

// Number of the clip that a user names by name, or by number from 0. Throws Error(Usage) that lists them.
CONELIGHT_API std::size_t clipNumber(const SceneAnimation& animation, const std::string& nameOrNumber);

// As loadScene, with the movement of glTF files, whose instances are marked (markMoving); empty for all others. Throws Error(BadInput) for clips that
// cannot be used, too.
CONELIGHT_API Scene loadAnimatedScene(const std::string& pathOrBuiltin, const LoadOptions& options,
                                      SceneAnimation& animation);

// The same; clips that cannot be used are left out, with a note.
CONELIGHT_API Scene loadMovingScene(const std::string& pathOrBuiltin, const LoadOptions& options,
                                    SceneAnimation& animation);

// Where a node puts a light, and a camera of this distance to its target. False: no usable direction.
CONELIGHT_API void placeLight(Light& light, const glm::mat4& worldFromNode);
CONELIGHT_API bool placeCamera(Camera& camera, const glm::mat4& worldFromNode, float distance);

}  // namespace conelight::io
