// SPDX-License-Identifier: MIT
// Morph targets and skins -> vertices. Linear blend skinning as in the specification of glTF 2.0, section 3.7.3.
#include <algorithm>
#include <cmath>

#include "io/animation.h"
#include "io/geometry.h"
#include "io/gltf_mesh.h"

namespace conelight::io {

namespace {

template <class T>
void addTarget(std::vector<T>& values, const std::vector<glm::vec3>& deltas, float weight) {
    if (deltas.size() != values.size()) return;
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int c = 0; c < 3; ++c) values[i][c] += weight * deltas[i][c];
}

void morph(const DeformedMesh& deformed, const std::vector<float>& weights, Mesh& mesh) {
    for (std::size_t t = 0; t < std::min(deformed.targets.size(), weights.size()); ++t) {
        if (weights[t] == 0.0f) continue;
        addTarget(mesh.positions, deformed.targets[t].positions, weights[t]);
        addTarget(mesh.normals, deformed.targets[t].normals, weights[t]);
        addTarget(mesh.tangents, deformed.targets[t].tangents, weights[t]);
    }
}

void moveVertex(const glm::mat4& worldFromBind, std::size_t i, Mesh& mesh) {
    mesh.positions[i] = glm::vec3(worldFromBind * glm::vec4(mesh.positions[i], 1.0f));
    const glm::mat3 linear(worldFromBind);
    if (!mesh.normals.empty()) mesh.normals[i] = glm::transpose(glm::inverse(linear)) * mesh.normals[i];
    if (!mesh.tangents.empty())
        mesh.tangents[i] = glm::vec4(linear * glm::vec3(mesh.tangents[i]), mesh.tangents[i].w);
}

void mirror(Mesh& mesh) {
    for (glm::vec3& p : mesh.positions) p.x = -p.x;
    for (glm::vec3& n : mesh.normals) n.x = -n.x;
    for (glm::vec4& t : mesh.tangents) t = glm::vec4(-t.x, t.y, t.z, -t.w);
}

}  // namespace

void skinVertices(const DeformedMesh& deformed, const std::vector<glm::mat4>& worldFromBind, Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::mat4 m(0.0f);
        float sum = 0.0f;
        for (std::size_t k = i * deformed.influences; k < (i + 1) * deformed.influences; ++k) {
            if (deformed.jointWeights[k] == 0.0f) continue;
            m += deformed.jointWeights[k] * worldFromBind[deformed.jointNumbers[k]];
            sum += deformed.jointWeights[k];
        }
        if (sum > 0.0f) moveVertex(m / sum, i, mesh);
    }
}

bool deform(const DeformedMesh& deformed, const NodePoses& poses, Mesh& mesh) {
    Mesh posed;
    posed.positions = deformed.bind.positions;
    posed.normals = deformed.bind.normals;
    posed.tangents = deformed.bind.tangents;
    const std::vector<float>& moved = poses.weights[deformed.node];
    morph(deformed, moved.empty() ? deformed.weights : moved, posed);
    if (!deformed.joints.empty()) {
        std::vector<glm::mat4> worldFromBind;
        for (std::size_t j = 0; j < deformed.joints.size(); ++j)
            worldFromBind.push_back(poses.worldFromNode[deformed.joints[j]] * deformed.jointFromBind[j]);
        skinVertices(deformed, worldFromBind, posed);
    }
    if (deformed.mirrored) mirror(posed);
    for (const glm::vec3& p : posed.positions)
        if (!std::isfinite(p.x + p.y + p.z)) return false;
    posed.indices = std::move(mesh.indices);  // for the normals of vertices whose own have no length
    repairNormals(posed);
    mesh.indices = std::move(posed.indices);
    for (std::size_t i = 0; i < posed.tangents.size(); ++i) {
        const float length = glm::length(glm::vec3(posed.tangents[i]));
        posed.tangents[i] = std::isfinite(length) && length > 0.0f
                                ? glm::vec4(glm::vec3(posed.tangents[i]) / length, posed.tangents[i].w)
                                : deformed.bind.tangents[i];
    }
    const bool same =
        posed.positions == mesh.positions && posed.normals == mesh.normals && posed.tangents == mesh.tangents;
    mesh.positions = std::move(posed.positions);
    mesh.normals = std::move(posed.normals);
    mesh.tangents = std::move(posed.tangents);
    return !same;
}

}  // namespace conelight::io
