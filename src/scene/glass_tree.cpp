// SPDX-License-Identifier: MIT
#include "scene/glass_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "gl/gl.h"
#include "math/brdf.h"
#include "math/octahedral.h"
#include "shared/caustics.h"

namespace conelight::scene {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr int kBins = 16;
// With more veils, shadow maps have them: the tree of so many takes 15 MB, and a tenth of a second to make.
constexpr std::size_t kMostVeilTriangles = 1 << 17;

// A triangle while the tree is made.
struct Item {
    Aabb box;
    glm::vec3 center;
    std::uint32_t triangle;
};

float halfArea(const Aabb& box) {
    const glm::vec3 e = box.extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Split {
    int axis = -1;  // none: all centres in one place
    float place = 0;
};

Split bestSplit(const std::vector<Item>& items, std::size_t begin, std::size_t end) {
    Aabb centers;
    for (std::size_t i = begin; i < end; ++i) centers.grow(items[i].center);
    Split best;
    float least = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float from = centers.min[axis], width = centers.extent()[axis];
        if (!(width > 0)) continue;
        std::array<Aabb, kBins> boxes;
        std::array<int, kBins> counts{};
        for (std::size_t i = begin; i < end; ++i) {
            const auto bin = static_cast<std::size_t>(
                std::clamp(static_cast<int>((items[i].center[axis] - from) / width * kBins), 0, kBins - 1));
            boxes[bin].grow(items[i].box);
            ++counts[bin];
        }
        std::array<float, kBins> right{};  // cost of all bins from here on
        Aabb box;
        int count = 0;
        for (std::size_t bin = kBins; bin-- > 1;) {
            box.grow(boxes[bin]);
            count += counts[bin];
            right[bin] = halfArea(box) * static_cast<float>(count);
        }
        box = Aabb{};
        count = 0;
        for (std::size_t bin = 1; bin < kBins; ++bin) {
            box.grow(boxes[bin - 1]);
            count += counts[bin - 1];
            const float cost = halfArea(box) * static_cast<float>(count) + right[bin];
            if (count == 0 || static_cast<std::size_t>(count) == end - begin) continue;
            if (best.axis >= 0 && cost >= least) continue;
            least = cost;
            best = {axis, from + width * static_cast<float>(bin) / kBins};
        }
    }
    return best;
}

void appendNodes(std::vector<Item>& items, std::size_t begin, std::size_t end,
                 std::vector<gpu::GlassNode>& nodes) {
    const std::size_t self = nodes.size();
    Aabb box;
    for (std::size_t i = begin; i < end; ++i) box.grow(items[i].box);
    nodes.push_back({box.min, 0, box.max, 0});
    const std::size_t count = end - begin;
    if (count <= kLeafTriangles) {
        nodes[self].triangles =
            GLASS_LEAF * static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(count);
    } else {
        const Split split = bestSplit(items, begin, end);
        const auto first = items.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = items.begin() + static_cast<std::ptrdiff_t>(end);
        auto middle = first + static_cast<std::ptrdiff_t>(count / 2);
        if (split.axis >= 0)
            middle = std::stable_partition(
                first, last, [&](const Item& item) { return item.center[split.axis] < split.place; });
        if (middle == first || middle == last) middle = first + static_cast<std::ptrdiff_t>(count / 2);
        const auto at = static_cast<std::size_t>(middle - items.begin());
        appendNodes(items, begin, at, nodes);
        appendNodes(items, at, end, nodes);
    }
    nodes[self].skip = static_cast<std::uint32_t>(nodes.size());
}

std::uint32_t packedNormal(const glm::vec3& n) { return math::packSnorm2x16(math::octEncode(n)); }

void appendTriangles(const GpuScene& scene, std::size_t index, std::uint32_t solid,
                     std::vector<gpu::GlassTriangle>& triangles) {
    const Instance& instance = scene.source().instances[index];
    const Mesh& mesh = scene.source().meshes[static_cast<std::size_t>(instance.mesh)];
    const gpu::Instance& placed = scene.instances()[index];
    const bool flipped = (placed.flags & INSTANCE_FLIPPED) != 0;
    const glm::mat3 normalMatrix(placed.normalColumn0, placed.normalColumn1, placed.normalColumn2);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> v = {mesh.indices[i], mesh.indices[i + (flipped ? 2 : 1)],
                                                mesh.indices[i + (flipped ? 1 : 2)]};
        std::array<glm::vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[v[k]], 1));
        const glm::vec3 twice = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(glm::length(twice) > 0)) continue;  // nothing can be met
        std::array<std::uint32_t, 3> normals;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 n = mesh.normals.empty() ? twice : normalMatrix * mesh.normals[v[k]];
            normals[k] = packedNormal(glm::length(n) > 0 ? glm::normalize(n) : glm::normalize(twice));
        }
        std::array<glm::vec2, 3> uvs{};
        for (std::size_t k = 0; k < 3 && !mesh.uvs.empty(); ++k) uvs[k] = mesh.uvs[v[k]];
        triangles.push_back({corners[0], normals[0], corners[1], normals[1], corners[2], normals[2], uvs[0],
                             uvs[1], uvs[2], static_cast<std::uint32_t>(index), solid});
    }
}

const gpu::Material& materialOf(const GpuScene& scene, std::size_t index) {
    return scene.materials()[scene.instances()[index].material];
}

// A texture makes it smoother at most.
bool isSmooth(const gpu::Material& material) { return material.roughness <= math::kMinRoughness; }

GlassSolid solidOf(const GpuScene& scene, std::size_t index) {
    const Instance& instance = scene.source().instances[index];
    const Mesh& mesh = scene.source().meshes[static_cast<std::size_t>(instance.mesh)];
    Aabb box;
    for (const glm::vec3& p : mesh.positions) box.grow(glm::vec3(instance.worldFromObject * glm::vec4(p, 1)));
    const bool isPane = (materialOf(scene, index).flags & MATERIAL_SOLID) == 0;
    GlassSolid solid{box.center(), 0, static_cast<std::uint32_t>(index), isPane};
    for (const glm::vec3& p : mesh.positions)
        solid.radius = std::max(
            solid.radius, glm::distance(solid.middle, glm::vec3(instance.worldFromObject * glm::vec4(p, 1))));
    return solid;
}

std::vector<GlassSolid> solidsOf(const GpuScene& scene) {
    std::vector<GlassSolid> solids;
    const std::vector<gpu::Instance>& instances = scene.instances();
    for (const bool solid : {true, false})
        for (std::size_t i = 0; i < instances.size(); ++i)
            if (isGlass(instances[i]) && ((materialOf(scene, i).flags & MATERIAL_SOLID) != 0) == solid &&
                (solid || isSmooth(materialOf(scene, i))))
                solids.push_back(solidOf(scene, i));
    return solids;
}

}  // namespace

std::vector<gpu::GlassNode> sortIntoTree(std::vector<gpu::GlassTriangle>& triangles) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Aabb box;
        for (const glm::vec3& corner : {triangles[i].corner0, triangles[i].corner1, triangles[i].corner2})
            box.grow(corner);
        items.push_back({box, box.center(), static_cast<std::uint32_t>(i)});
    }
    std::vector<gpu::GlassNode> nodes;
    if (items.empty()) return nodes;
    appendNodes(items, 0, items.size(), nodes);
    for (gpu::GlassNode& node : nodes)
        if (node.skip == nodes.size()) node.skip = GLASS_END;
    std::vector<gpu::GlassTriangle> sorted;
    for (const Item& item : items) sorted.push_back(triangles[item.triangle]);
    triangles = std::move(sorted);
    return nodes;
}

bool hasVeils(const GpuScene& scene) {
    const std::vector<gpu::Instance>& instances = scene.instances();
    std::size_t triangles = 0;
    for (const gpu::Instance& instance : instances)
        if (isVeil(instance)) triangles += instance.indexCount / 3;
    return triangles > 0 && triangles <= kMostVeilTriangles;
}

void GlassTree::update(const GpuScene& scene, bool veils) {
    if (scene_ == scene.identity() && geometry_ == scene.geometryRevision() && veils == veils_) return;
    const bool sameScene = scene_ == scene.identity() && veils == veils_;
    veils_ = veils;
    scene_ = scene.identity();
    geometry_ = scene.geometryRevision();
    std::vector<base::Revision> from;
    const std::vector<gpu::Instance>& instances = scene.instances();
    const auto isIn = [&](std::size_t i) { return isGlass(instances[i]) || (veils && isVeil(instances[i])); };
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (isIn(i)) from.push_back(scene.instanceRevision(i));
    std::vector<GlassSolid> solids = solidsOf(scene);
    const bool sameSolids = solids == solids_;
    solids_ = std::move(solids);
    if (sameScene && from == from_ && sameSolids) return;
    from_ = std::move(from);
    const auto numberOf = [&](std::size_t instance) {
        if (!isGlass(instances[instance])) return GLASS_VEIL;
        for (std::uint32_t i = 0; i < solids_.size(); ++i)
            if (solids_[i].instance == instance) return i;
        return CAUSTIC_NO_SOLID;
    };
    std::vector<gpu::GlassTriangle> triangles;
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (isIn(i)) appendTriangles(scene, i, numberOf(i), triangles);
    holdsGlass_ = std::any_of(instances.begin(), instances.end(), isGlass);
    const std::vector<gpu::GlassNode> nodes = sortIntoTree(triangles);
    nodes_ = static_cast<std::uint32_t>(nodes.size());
    nodeTexture_ = {};
    triangleTexture_ = {};
    nodeBuffer_ = {};
    triangleBuffer_ = {};
    if (nodes.empty()) return;
    nodeBuffer_ = gl::Buffer(nodes, "glass nodes");
    triangleBuffer_ = gl::Buffer(triangles, "glass triangles");
    nodeTexture_ = gl::Texture(nodeBuffer_, GL_RGBA32UI, "glass nodes");
    triangleTexture_ = gl::Texture(triangleBuffer_, GL_RGBA32UI, "glass triangles");
}

void GlassTree::declare(gl::Inputs& inputs) const {
    if (empty()) return;
    inputs.texture("glassNodes", nodeTexture_).texture("glassTriangles", triangleTexture_);
}

}  // namespace conelight::scene
