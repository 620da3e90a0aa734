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

// Primitives often share long vertex arrays: keep only the vertices this one uses. Returns which they were;
// empty: all, in their order.
std::vector<std::uint32_t> dropUnusedVertices(Mesh& mesh) {
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
        return {};
    }
    keep(mesh.positions, oldOfNew);
    keep(mesh.normals, oldOfNew);
    keep(mesh.uvs, oldOfNew);
    keep(mesh.tangents, oldOfNew);
    keep(mesh.colors, oldOfNew);
    return oldOfNew;
}

// The same of what moves the vertices.
void keepVertices(DeformedMesh& moving, const std::vector<std::uint32_t>& oldOfNew) {
    if (oldOfNew.empty()) return;
    for (MorphTarget& target : moving.targets) {
        keep(target.positions, oldOfNew);
        keep(target.normals, oldOfNew);
        keep(target.tangents, oldOfNew);
    }
    if (moving.influences == 0) return;
    std::vector<std::uint32_t> entries;
    for (const std::uint32_t old : oldOfNew)
        for (std::size_t k = 0; k < moving.influences; ++k)
            entries.push_back(std::uint32_t(old * moving.influences + k));
    keep(moving.jointNumbers, entries);
    keep(moving.jointWeights, entries);
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

GltfSkin readSkin(GltfFile& file, const GltfValue& skin, const std::vector<glm::mat4>& worldFromNode) {
    const GltfValue joints = skin["joints"];
    std::vector<float> inverse;
    if (skin["inverseBindMatrices"].exists()) {
        inverse = file.floats(skin["inverseBindMatrices"], 16);
        if (inverse.size() < 16 * joints.size())
            skin["inverseBindMatrices"].fail("one matrix per joint is needed");
    }
    GltfSkin out;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        glm::mat4 bind(1.0f);
        if (!inverse.empty()) std::copy_n(&inverse[16 * j], 16, &bind[0][0]);
        out.joints.push_back(joints[j].index(worldFromNode.size()).value());
        out.jointFromBind.push_back(bind);
        const glm::mat4& worldFromJoint = worldFromNode[out.joints.back()];
        out.worldFromBind.push_back(inverse.empty() ? worldFromJoint : worldFromJoint * bind);
    }
    return out;
}

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

std::vector<glm::vec3> GltfMeshes::readDeltas(const GltfValue& accessor, std::size_t count) {
    if (!accessor.exists() || count == 0) return {};
    std::vector<glm::vec3> delta = vectorsOf<3>(file_.floats(accessor, 3));
    if (delta.size() != count)
        accessor.fail(fmt::format("{} elements expected, found {}", count, delta.size()));
    return delta;
}

void GltfMeshes::morph(const GltfValue& primitive, const std::vector<float>& weights, Mesh& mesh) {
    const GltfValue targets = primitive["targets"];
    for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
        if (weights[t] == 0.0f) continue;
        const auto add = [&](const char* attribute, std::vector<glm::vec3>& to) {
            const std::vector<glm::vec3> delta = readDeltas(targets[t][attribute], to.size());
            for (std::size_t i = 0; i < delta.size(); ++i) to[i] += weights[t] * delta[i];
        };
        add("POSITION", mesh.positions);
        add("NORMAL", mesh.normals);
    }
}

void GltfMeshes::readInfluences(const GltfValue& attributes, std::size_t jointCount, std::size_t vertices,
                                DeformedMesh& to) {
    std::size_t sets = 0;
    while (attributes[fmt::format("JOINTS_{}", sets).c_str()].exists()) ++sets;
    to.influences = 4 * sets;
    to.jointNumbers.resize(to.influences * vertices);
    to.jointWeights.resize(to.influences * vertices);
    for (std::size_t set = 0; set < sets; ++set) {
        const GltfValue numbersOf = attributes[fmt::format("JOINTS_{}", set).c_str()];
        const std::vector<std::uint32_t> joints = file_.wholes(numbersOf, 4);
        const std::vector<float> weights =
            file_.floats(attributes[fmt::format("WEIGHTS_{}", set).c_str()], 4);
        if (joints.size() != 4 * vertices || weights.size() != joints.size())
            attributes.fail("joints and weights must have as many elements as positions");
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const std::size_t at = i / 4 * to.influences + 4 * set + i % 4;
            if (weights[i] == 0.0f) continue;
            if (joints[i] >= jointCount) numbersOf.fail(fmt::format("joint {} is out of range", joints[i]));
            to.jointNumbers[at] = joints[i];
            to.jointWeights[at] = weights[i];
        }
    }
}

Mesh GltfMeshes::readAttributes(const GltfValue& primitive, int material) {
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
    return mesh;
}

Mesh GltfMeshes::read(const GltfValue& primitive, const std::vector<float>& weights, const GltfSkin* skin,
                      int material) {
    const GltfValue attributes = primitive["attributes"];
    Mesh mesh = readAttributes(primitive, material);
    morph(primitive, weights, mesh);
    if (skin != nullptr && attributes["JOINTS_0"].exists()) {
        DeformedMesh moving;
        readInfluences(attributes, skin->joints.size(), mesh.positions.size(), moving);
        skinVertices(moving, skin->worldFromBind, mesh);
    }
    dropUnusedVertices(mesh);
    for (const glm::vec3& p : mesh.positions)
        if (!std::isfinite(p.x + p.y + p.z))
            attributes["POSITION"].fail("positions leave the range of numbers");
    if (!mesh.normals.empty()) badNormals_ += repairNormals(mesh);
    repairTangents(mesh);
    const Material& shown = scene_.materials[std::size_t(material)];
    if (mesh.tangents.empty() && (shown.normalTexture.used() || shown.coatNormalTexture.used()))
        makeTangents(mesh);
    return mesh;
}

// As it is without weights and joints; `moving` has all but the place of its mesh.
Mesh GltfMeshes::readMoving(const GltfValue& primitive, const GltfSkin* skin, int material,
                            DeformedMesh& moving) {
    const GltfValue attributes = primitive["attributes"], targets = primitive["targets"];
    Mesh mesh = readAttributes(primitive, material);
    for (std::size_t t = 0; t < targets.size(); ++t)
        moving.targets.push_back({readDeltas(targets[t]["POSITION"], mesh.positions.size()),
                                  readDeltas(targets[t]["NORMAL"], mesh.normals.size()),
                                  readDeltas(targets[t]["TANGENT"], mesh.tangents.size())});
    if (skin != nullptr && attributes["JOINTS_0"].exists()) {
        moving.joints = skin->joints;
        moving.jointFromBind = skin->jointFromBind;
        readInfluences(attributes, skin->joints.size(), mesh.positions.size(), moving);
    }
    keepVertices(moving, dropUnusedVertices(mesh));
    if (!mesh.normals.empty()) badNormals_ += repairNormals(mesh);
    repairTangents(mesh);
    if (mesh.tangents.empty() && scene_.materials[std::size_t(material)].normalTexture.used() &&
        !mesh.uvs.empty()) {
        const std::vector<std::uint32_t> before = mesh.indices;
        makeTangents(mesh);  // which splits vertices
        std::vector<std::uint32_t> oldOfNew(mesh.positions.size());
        for (std::size_t i = 0; i < before.size(); ++i) oldOfNew[mesh.indices[i]] = before[i];
        keepVertices(moving, oldOfNew);
    }
    moving.bind.positions = mesh.positions;
    moving.bind.normals = mesh.normals;
    moving.bind.tangents = mesh.tangents;
    return mesh;
}

std::vector<GltfPart> GltfMeshes::parts(std::size_t index, const std::vector<float>& weights,
                                        const GltfSkin* skin, std::vector<DeformedMesh>* moving) {
    const bool shared = skin == nullptr && moving == nullptr;
    const GltfValue meshValue = file_.array("meshes")[index];
    std::vector<float> used = weights;
    if (used.empty()) {
        used.resize(meshValue["weights"].size());
        for (std::size_t i = 0; i < used.size(); ++i) used[i] = meshValue["weights"][i].number(0.0f);
    }
    const std::vector<float> all = used;
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
        if (shared && known != known_.end()) {
            if (known->second >= 0) out.push_back({known->second, material});
            continue;
        }
        DeformedMesh moved;
        Mesh mesh = moving == nullptr ? read(primitive, used, skin, material)
                                      : readMoving(primitive, skin, material, moved);
        mesh.name = oneLine(meshValue["name"].text(fmt::format("mesh{}", index)));
        if (primitives.size() > 1) mesh.name += fmt::format(".{}", p);
        int at = -1;
        if (!mesh.indices.empty()) {
            at = int(scene_.meshes.size());
            scene_.meshes.push_back(std::move(mesh));
            out.push_back({at, material});
            if (moving != nullptr) {
                moved.mesh = std::size_t(at);
                moved.weights = all;
                moving->push_back(std::move(moved));
            }
        }
        if (shared) known_[key] = at;
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
