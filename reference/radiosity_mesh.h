// SPDX-License-Identifier: MIT
// Patches and elements: each triangle of the scene is the root of a binary tree of triangles, halved at the
// middle of their longest edges (Rivara 1984, "Algorithms for refining triangular grids suitable for adaptive
// and multigrid techniques"). All triangles of a surface that share an edge are halved together, so there are
// no T-junctions inside a surface, and angles never fall below half of the smallest of the input.
//
// A surface is one side of an instance: double-sided materials have two. Vertices of the input that agree in
// position, normal, texture coordinates and colour are one; light is interpolated across them, and not across
// hard edges.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "conelight/scene.h"
#include "reference/ray_scene.h"

namespace conelight::reference {

constexpr std::uint32_t kNoElement = ~0u;

struct RadiositySurface {
    std::uint32_t instance = 0;
    bool back = false;
    bool reversed = false;  // elements wind clockwise seen from this side
};

struct ElementVertex {
    glm::dvec3 position{0};  // world
    std::uint32_t surface = 0;
    std::uint32_t place = 0;     // the same for vertices at one point of a surface
    std::uint32_t triangle = 0;  // of the mesh, and where on it
    glm::dvec2 barycentric{0};   // weights of its vertices 1 and 2
    std::uint32_t parentA = kNoElement, parentB = kNoElement;  // vertices it lies midway between
    std::uint32_t element = kNoElement;                        // one that has it as a corner
};

struct Element {
    std::array<std::uint32_t, 3> vertices{};
    std::array<glm::dvec2, 3> barycentric{};  // of the corners, on the root
    std::uint32_t child = kNoElement;         // the first of two; corner 0 of both is the apex
    std::uint32_t root = 0;
    std::uint32_t patch = kNoElement;  // set by the solver on the elements that are patches
    std::uint16_t depth = 0;           // halvings below its patch
};

class ElementMesh {
  public:
    explicit ElementMesh(const Scene& scene);

    // Halves an element, and its neighbours where the longest edges demand it. Nothing if it is no leaf.
    void split(std::uint32_t element);
    bool isLeaf(std::uint32_t element) const { return elements[element].child == kNoElement; }
    double longestEdge(std::uint32_t element) const;
    double area(std::uint32_t element) const;
    glm::dvec3 center(std::uint32_t element) const;
    glm::dvec2 centerBarycentric(std::uint32_t element) const;
    // Unit, on the surface's side.
    glm::vec3 normal(std::uint32_t element) const;
    // The patch that a ray hit; kNoElement on sides that are none (backs of single-sided surfaces).
    std::uint32_t patchAt(const RayHit& hit, bool front) const;
    // The scene's surface at a point of an element's root, seen from its side.
    RayHit hitAt(std::uint32_t element, const glm::dvec2& barycentric) const;
    std::uint32_t surfaceOf(std::uint32_t element) const {
        return vertices[elements[element].vertices[0]].surface;
    }

    std::vector<RadiositySurface> surfaces;
    std::vector<ElementVertex> vertices;
    std::vector<Element> elements;

  private:
    struct EdgeRank {
        double squared = 0;
        std::uint64_t key = 0;
        bool operator<(const EdgeRank& o) const {
            return squared != o.squared ? squared < o.squared : key < o.key;
        }
    };
    std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) const;
    std::pair<EdgeRank, int> longest(std::uint32_t element) const;
    void addSide(const Scene& scene, std::uint32_t instance, bool back);
    void addEdges(std::uint32_t element);
    void removeEdges(std::uint32_t element);
    void bisect(std::uint32_t element);

    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> edges_;  // leaves at each edge
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;             // vertex midway between two
    std::unordered_map<std::uint64_t, std::uint32_t> middlePlaces_;
    std::vector<std::array<std::vector<std::uint32_t>, 2>> roots_;    // per instance, side, triangle
    std::unordered_map<std::uint32_t, std::uint32_t> rootTriangles_;  // mesh triangle of each root
    std::uint32_t places_ = 0;
};

}  // namespace conelight::reference
