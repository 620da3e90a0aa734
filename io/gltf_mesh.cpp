// SPDX-License-Identifier: MIT
// glTF primitives -> Mesh: attributes of any component type, strips and fans unrolled, unused vertices
// dropped, normals repaired, tangents made where a normal map needs them.
#include "io/gltf_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "io/geometry.h"

namespace conelight::io {

namespace {

template <int N>
std::vector<glm::vec<N, float>> vectorsOf(const std::vector<float>& numbers) {
    std::vector<glm::vec<N, float>> out(numbers.size() / N);
    for (std::size_t i = 0; i < out.size(); ++i)
        for (int c = 0; c < N; ++c) out[i][c] = numbers[i * N + std::size_t(c)];
    return out;
}

template <typename T>
void keep(std::vector<T>& values, const std::vector<std::uint32_t>& oldOfNew) {
    if (values.empty()) return;
    std::vector<T> kept;
    kept.reserve(oldOfNew.size());
    for (const std::uint32_t old : oldOfNew) kept.push_back(values[old]);
    values = std::move(kept);
}

// Primitives often share long vertex arrays: keep only the vertices this one uses.
void dropUnusedVertices(Mesh& mesh) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> newOfOld(mesh.positions.size(), kUnused), oldOfNew;
    for (std::uint32_t& index : mesh.indices) {
        if (newOfOld[index] == kUnused) {
            newOfOld[index] = std::uint32_t(oldOfNew.size());
            oldOfNew.push_back(index);
        }
        index = newOfOld[index];
    }
    if (oldOfNew.size() == newOfOld.size()) {
        // All used: restore the file's order.
        for (std::uint32_t& index : mesh.indices) index = oldOfNew[index];
        return;
    }
    keep(mesh.positions, oldOfNew);
    keep(mesh.normals, oldOfNew);
    keep(mesh.uvs, oldOfNew);
    keep(mesh.tangents, oldOfNew);
    keep(mesh.colors, oldOfNew);
}

void repairTangents(Mesh& mesh) {
    for (glm::vec4& t : mesh.tangents) {
        const float length = glm::length(glm::vec3(t));
        if (!(length > 0.0f)) {
            mesh.tangents.clear();  // one broken tangent: make them all anew
            return;
        }
        t = glm::vec4(glm::vec3(t) / length, t.w < 0.0f ? -1.0f : 1.0f);
    }
}

}  // namespace

std::vector<std::uint32_t> GltfMeshes::readIndices(const GltfValue& primitive, std::size_t vertexCount) {
    std::vector<std::uint32_t> order;
    if (primitive["indices"].exists()) {
        order = file_.wholes(primitive["indices"], 1);
        for (std::size_t i = 0; i < order.size(); ++i)
            if (order[i] >= vertexCount)
                primitive["indices"].fail(
                    fmt::format("index {} of element {} is out of range; there are {} vertices", order[i], i,
                                vertexCount));
    } else {
        order.resize(vertexCount);
        for (std::size_t i = 0; i < vertexCount; ++i) order[i] = std::uint32_t(i);
    }

    // 4: triangles as they are; 5: strip, every second one turned; 6: fan.
    const std::uint64_t mode = primitive["mode"].whole(4);
    if (mode == 4) {
        order.resize(order.size() / 3 * 3);
        return order;
    }
    if (mode != 5 && mode != 6) primitive["mode"].fail(fmt::format("{} is unknown", mode));
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 2; i < order.size(); ++i) {
        const std::uint32_t a = mode == 6 ? order[0] : order[i - 2];
        const std::uint32_t b = order[i - 1], c = order[i];
        if (a == b || b == c || a == c) continue;  // strips are joined by empty triangles
        if (mode == 5 && i % 2 == 1)
            triangles.insert(triangles.end(), {b, a, c});
        else
            triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

void GltfMeshes::morph(const GltfValue& primitive, const std::vector<float>& weights, Mesh& mesh) {
    const GltfValue targets = primitive["targets"];
    for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
        if (weights[t] == 0.0f) continue;
        const auto add = [&](const char* attribute, std::vector<glm::vec3>& to) {
            const GltfValue accessor = targets[t][attribute];
            if (!accessor.exists() || to.empty()) return;
            const auto delta = vectorsOf<3>(file_.floats(accessor, 3));
            if (delta.size() != to.size())
                accessor.fail(fmt::format("{} elements expected, found {}", to.size(), delta.size()));
            for (std::size_t i = 0; i < to.size(); ++i) to[i] += weights[t] * delta[i];
        };
        add("POSITION", mesh.positions);
        add("NORMAL", mesh.normals);
    }
}

void GltfMeshes::skin(const GltfValue& attributes, const std::vector<glm::mat4>& worldFromBind, Mesh& mesh) {
    const std::vector<std::uint32_t> joints = file_.wholes(attributes["JOINTS_0"], 4);
    const std::vector<float> weights = file_.floats(attributes["WEIGHTS_0"], 4);
    if (joints.size() != 4 * mesh.positions.size() || weights.size() != joints.size())
        attributes.fail("joints and weights must have as many elements as positions");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::mat4 m(0.0f);
        float sum = 0.0f;
        for (std::size_t j = 0; j < 4; ++j) {
            const float weight = weights[4 * i + j];
            if (weight == 0.0f) continue;
            if (joints[4 * i + j] >= worldFromBind.size())
                attributes["JOINTS_0"].fail(fmt::format("joint {} is out of range", joints[4 * i + j]));
            m += weight * worldFromBind[joints[4 * i + j]];
            sum += weight;
        }
        if (!(sum > 0.0f))
            m = glm::mat4(1.0f);
        else
            m /= sum;
        mesh.positions[i] = glm::vec3(m * glm::vec4(mesh.positions[i], 1.0f));
        if (!mesh.normals.empty())
            mesh.normals[i] = glm::transpose(glm::inverse(glm::mat3(m))) * mesh.normals[i];
        if (!mesh.tangents.empty())
            mesh.tangents[i] = glm::vec4(glm::mat3(m) * glm::vec3(mesh.tangents[i]), mesh.tangents[i].w);
    }
}

Mesh GltfMeshes::read(const GltfValue& primitive, const std::vector<float>& weights,
                      const std::vector<glm::mat4>* worldFromBind, int material) {
    const GltfValue attributes = primitive["attributes"];
    Mesh mesh;
    mesh.positions = vectorsOf<3>(file_.floats(attributes["POSITION"], 3));
    const auto sized = [&](const GltfValue& accessor, std::size_t size) {
        if (size != mesh.positions.size())
            accessor.fail(
                fmt::format("{} elements expected (as positions), found {}", mesh.positions.size(), size));
    };
    if (attributes["NORMAL"].exists()) {
        mesh.normals = vectorsOf<3>(file_.floats(attributes["NORMAL"], 3));
        sized(attributes["NORMAL"], mesh.normals.size());
    }
    if (attributes["TANGENT"].exists() && !mesh.normals.empty()) {
        mesh.tangents = vectorsOf<4>(file_.floats(attributes["TANGENT"], 4));
        sized(attributes["TANGENT"], mesh.tangents.size());
    }
    const GltfValue uvs = attributes[fmt::format("TEXCOORD_{}", materials_.uvSetOf(material)).c_str()];
    if (uvs.exists()) {
        mesh.uvs = vectorsOf<2>(file_.floats(uvs, 2));
        sized(uvs, mesh.uvs.size());
    }
    if (attributes["COLOR_0"].exists()) {
        mesh.colors = vectorsOf<4>(file_.floats(attributes["COLOR_0"], 4, true));
        sized(attributes["COLOR_0"], mesh.colors.size());
        for (glm::vec4& color : mesh.colors) color = glm::max(color, glm::vec4(0));
    }
    mesh.indices = readIndices(primitive, mesh.positions.size());
    morph(primitive, weights, mesh);
    if (worldFromBind != nullptr && attributes["JOINTS_0"].exists()) skin(attributes, *worldFromBind, mesh);
    dropUnusedVertices(mesh);
    for (const glm::vec3& p : mesh.positions)
        if (!std::isfinite(p.x + p.y + p.z))
            attributes["POSITION"].fail("positions leave the range of numbers");
    if (!mesh.normals.empty()) badNormals_ += repairNormals(mesh);
    repairTangents(mesh);
    if (mesh.tangents.empty() && scene_.materials[std::size_t(material)].normalTexture.used())
        makeTangents(mesh);
    return mesh;
}

std::vector<GltfPart> GltfMeshes::parts(std::size_t index, const std::vector<float>& weights,
                                        const std::vector<glm::mat4>* worldFromBind) {
    const GltfValue meshValue = file_.array("meshes")[index];
    std::vector<float> used = weights;
    if (used.empty()) {
        used.resize(meshValue["weights"].size());
        for (std::size_t i = 0; i < used.size(); ++i) used[i] = meshValue["weights"][i].number(0.0f);
    }
    if (std::all_of(used.begin(), used.end(), [](float weight) { return weight == 0.0f; })) used.clear();

    std::vector<GltfPart> out;
    const GltfValue primitives = meshValue["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const GltfValue primitive = primitives[p];
        if (primitive["mode"].whole(4) < 4) {
            ++pointPrimitives_;
            continue;
        }
        if (!primitive["attributes"]["POSITION"].exists()) continue;  // allowed, and draws nothing
        const int material = materials_.indexOf(primitive);
        // Equal primitives (same accessors, weights and kind of material) share one mesh.
        std::string key = primitive["attributes"].json().dump() + "|" +
                          fmt::format("{}", primitive["mode"].whole(4)) + "|" +
                          (primitive["indices"].exists() ? primitive["indices"].json().dump() : "") + "|" +
                          fmt::format("{}|{}", materials_.uvSetOf(material),
                                      scene_.materials[std::size_t(material)].normalTexture.used());
        for (const float weight : used) key += fmt::format("|{}", weight);
        if (!used.empty() && primitive["targets"].exists()) key += primitive["targets"].json().dump();
        const auto known = known_.find(key);
        if (worldFromBind == nullptr && known != known_.end()) {
            if (known->second >= 0) out.push_back({known->second, material});
            continue;
        }
        Mesh mesh = read(primitive, used, worldFromBind, material);
        mesh.name = oneLine(meshValue["name"].text(fmt::format("mesh{}", index)));
        if (primitives.size() > 1) mesh.name += fmt::format(".{}", p);
        int at = -1;
        if (!mesh.indices.empty()) {
            at = int(scene_.meshes.size());
            scene_.meshes.push_back(std::move(mesh));
            out.push_back({at, material});
        }
        if (worldFromBind == nullptr) known_[key] = at;
    }
    return out;
}

void GltfMeshes::addNotes() {
    if (pointPrimitives_ > 0)
        scene_.notes.push_back(fmt::format("{} primitive{} of points or lines left out", pointPrimitives_,
                                           pointPrimitives_ == 1 ? "" : "s"));
    if (badNormals_ > 0)
        scene_.notes.push_back(fmt::format("{} normals without length replaced", badNormals_));
}

}  // namespace conelight::io
