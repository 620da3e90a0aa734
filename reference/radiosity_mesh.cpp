// SPDX-License-Identifier: MIT
#include "reference/radiosity_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "reference/surface.h"

namespace conelight::reference {
namespace {

double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

std::uint64_t pairOf(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

// What tells vertices of the input apart: position, normal, uv, colour.
using VertexKey = std::array<float, 12>;

VertexKey keyOf(const Mesh& mesh, std::uint32_t v, const glm::vec3& faceNormal) {
    const glm::vec3 p = mesh.positions[v];
    const glm::vec3 n = mesh.normals.empty() ? faceNormal : mesh.normals[v];
    const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[v];
    const glm::vec4 c = mesh.colors.empty() ? glm::vec4(1) : mesh.colors[v];
    return {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, c.r, c.g, c.b, c.a};
}

}  // namespace

ElementMesh::ElementMesh(const Scene& scene) : roots_(scene.instances.size()) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!instance.visible || instance.mesh < 0) continue;
        const Material& material = materialOf(scene, instance);
        if (material.unlit) continue;
        addSide(scene, i, false);
        if (material.doubleSided) addSide(scene, i, true);
    }
}

void ElementMesh::addSide(const Scene& scene, std::uint32_t index, bool back) {
    const Instance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const bool mirrored = glm::determinant(glm::mat3(instance.worldFromObject)) < 0;
    const auto surface = static_cast<std::uint32_t>(surfaces.size());
    surfaces.push_back({index, back, mirrored != back});
    std::map<VertexKey, std::uint32_t> known;
    std::map<std::array<float, 3>, std::uint32_t> places;
    std::vector<std::uint32_t>& roots = roots_[index][back ? 1 : 0];
    roots.assign(mesh.triangleCount(), kNoElement);
    const glm::dmat4 world(instance.worldFromObject);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        std::array<glm::vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.indices[3 * std::size_t{t} + k]];
        const glm::dvec3 cross = glm::cross(glm::dvec3(p[1] - p[0]), glm::dvec3(p[2] - p[0]));
        if (!(glm::length(cross) > 0)) continue;
        const glm::vec3 faceNormal(glm::normalize(cross));
        Element root;
        root.root = static_cast<std::uint32_t>(elements.size());
        root.barycentric = {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [found, isNew] =
                known.try_emplace(keyOf(mesh, mesh.indices[3 * std::size_t{t} + k], faceNormal),
                                  static_cast<std::uint32_t>(vertices.size()));
            if (isNew) {
                const auto [place, newPlace] = places.try_emplace({p[k].x, p[k].y, p[k].z}, places_);
                if (newPlace) ++places_;
                ElementVertex v;
                v.position = glm::dvec3(world * glm::dvec4(glm::dvec3(p[k]), 1));
                v.surface = surface;
                v.place = place->second;
                v.triangle = t;
                v.barycentric = root.barycentric[k];
                vertices.push_back(v);
            }
            root.vertices[k] = found->second;
        }
        const auto& c = root.vertices;
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
        elements.push_back(root);
        rootTriangles_[root.root] = t;
        roots[t] = root.root;
        if (!(area(root.root) > 0)) {  // scaled flat
            elements.pop_back();
            roots[t] = kNoElement;
            continue;
        }
        addEdges(root.root);
    }
}

std::uint64_t ElementMesh::edgeKey(std::uint32_t a, std::uint32_t b) const {
    return pairOf(vertices[a].place, vertices[b].place);
}

std::pair<ElementMesh::EdgeRank, int> ElementMesh::longest(std::uint32_t element) const {
    const auto& v = elements[element].vertices;
    std::pair<EdgeRank, int> best{{-1, 0}, 0};
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = v[static_cast<std::size_t>(k)], b = v[static_cast<std::size_t>((k + 1) % 3)];
        const glm::dvec3 way = vertices[a].position - vertices[b].position;
        const EdgeRank rank{glm::dot(way, way), edgeKey(a, b)};
        if (best.first < rank) best = {rank, k};
    }
    return best;
}

void ElementMesh::addEdges(std::uint32_t element) {
    const auto& v = elements[element].vertices;
    for (std::size_t k = 0; k < 3; ++k) edges_[edgeKey(v[k], v[(k + 1) % 3])].push_back(element);
    for (const std::uint32_t corner : v) vertices[corner].element = element;
}

void ElementMesh::removeEdges(std::uint32_t element) {
    const auto& v = elements[element].vertices;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto found = edges_.find(edgeKey(v[k], v[(k + 1) % 3]));
        std::erase(found->second, element);
        if (found->second.empty()) edges_.erase(found);
    }
}

void ElementMesh::bisect(std::uint32_t index) {
    removeEdges(index);
    const auto k = static_cast<std::size_t>(longest(index).second);
    const Element parent = elements[index];
    const std::size_t ia = k, ib = (k + 1) % 3, apex = (k + 2) % 3;
    const std::uint32_t a = parent.vertices[ia], b = parent.vertices[ib];
    const glm::dvec2 middle = 0.5 * (parent.barycentric[ia] + parent.barycentric[ib]);
    const auto [found, isNew] =
        middles_.try_emplace(pairOf(a, b), static_cast<std::uint32_t>(vertices.size()));
    if (isNew) {
        const auto [place, newPlace] = middlePlaces_.try_emplace(edgeKey(a, b), places_);
        if (newPlace) ++places_;
        ElementVertex v;
        v.position = 0.5 * (vertices[a].position + vertices[b].position);
        v.surface = vertices[a].surface;
        v.place = place->second;
        v.triangle = hitAt(index, middle).triangle;
        v.barycentric = middle;
        v.parentA = a;
        v.parentB = b;
        vertices.push_back(v);
    }
    const auto first = static_cast<std::uint32_t>(elements.size());
    Element child;
    child.root = parent.root;
    child.patch = parent.patch;
    child.depth = parent.patch == kNoElement ? 0 : static_cast<std::uint16_t>(parent.depth + 1);
    child.vertices = {parent.vertices[apex], a, found->second};
    child.barycentric = {parent.barycentric[apex], parent.barycentric[ia], middle};
    elements.push_back(child);
    child.vertices = {parent.vertices[apex], found->second, b};
    child.barycentric = {parent.barycentric[apex], middle, parent.barycentric[ib]};
    elements.push_back(child);
    elements[index].child = first;
    addEdges(first);
    addEdges(first + 1);
}

void ElementMesh::split(std::uint32_t element) {
    while (isLeaf(element)) {
        // Along the longest edges to one that is the longest of all that share it.
        std::uint32_t at = element;
        for (;;) {
            const std::uint64_t key = longest(at).first.key;
            const std::vector<std::uint32_t> sharing = edges_.at(key);
            const auto other = std::find_if(sharing.begin(), sharing.end(),
                                            [&](std::uint32_t e) { return longest(e).first.key != key; });
            if (other == sharing.end()) {
                for (const std::uint32_t e : sharing) bisect(e);
                break;
            }
            at = *other;
        }
    }
}

double ElementMesh::longestEdge(std::uint32_t element) const {
    return std::sqrt(longest(element).first.squared);
}

double ElementMesh::area(std::uint32_t element) const {
    const auto& v = elements[element].vertices;
    const glm::dvec3 a = vertices[v[0]].position;
    return 0.5 * glm::length(glm::cross(vertices[v[1]].position - a, vertices[v[2]].position - a));
}

glm::dvec3 ElementMesh::center(std::uint32_t element) const {
    const auto& v = elements[element].vertices;
    return (vertices[v[0]].position + vertices[v[1]].position + vertices[v[2]].position) / 3.0;
}

glm::dvec2 ElementMesh::centerBarycentric(std::uint32_t element) const {
    const auto& b = elements[element].barycentric;
    return (b[0] + b[1] + b[2]) / 3.0;
}

glm::vec3 ElementMesh::normal(std::uint32_t element) const {
    const auto& v = elements[element].vertices;
    const glm::dvec3 a = vertices[v[0]].position;
    const glm::vec3 n(glm::normalize(glm::cross(vertices[v[1]].position - a, vertices[v[2]].position - a)));
    return surfaces[vertices[v[0]].surface].reversed ? -n : n;
}

std::uint32_t ElementMesh::patchAt(const RayHit& hit, bool front) const {
    const std::vector<std::uint32_t>& roots = roots_[hit.instance][front ? 0 : 1];
    if (hit.triangle >= roots.size()) return kNoElement;
    std::uint32_t at = roots[hit.triangle];
    if (at == kNoElement) return kNoElement;
    const glm::dvec2 p(hit.barycentric);
    while (elements[at].patch == kNoElement) {
        const Element& e = elements[at];
        if (e.child == kNoElement) return kNoElement;
        const Element& first = elements[e.child];
        // The children meet in the line from the apex to the middle.
        const glm::dvec2 line = first.barycentric[2] - first.barycentric[0];
        const double side = cross2(line, p - first.barycentric[0]);
        const double own = cross2(line, first.barycentric[1] - first.barycentric[0]);
        at = e.child + (side * own >= 0 ? 0u : 1u);
    }
    return elements[at].patch;
}

RayHit ElementMesh::hitAt(std::uint32_t element, const glm::dvec2& barycentric) const {
    const Element& root = elements[elements[element].root];
    const RadiositySurface& surface = surfaces[vertices[root.vertices[0]].surface];
    RayHit hit;
    hit.instance = surface.instance;
    hit.triangle = rootTriangles_.at(elements[element].root);
    hit.barycentric = glm::vec2(barycentric);
    const glm::vec3 n = normal(elements[element].root);
    hit.geometricNormal = surface.back ? -n : n;
    return hit;
}

}  // namespace conelight::reference
