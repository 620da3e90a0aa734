// SPDX-License-Identifier: MIT
// A mesh that the host has in buffers of its own, by their GL names: what a skin or a simulation on the GPU moves
// needs no way over the CPU. docs/guide/light_field.md
#pragma once

#include <cstdint>
#include <string>

#include "conelight/scene.h"

namespace conelight {

// Normalized numbers are in [-1, 1] or [0, 1], as vertex attributes of OpenGL are.
enum class HostEncoding : std::uint8_t { Float32, Float16, Snorm16, Snorm8, Unorm8 };

struct HostAttribute {
    std::uint32_t buffer = 0;  // GL name; 0: the mesh has none
    std::uint32_t offset = 0;  // bytes to the first vertex, a multiple of 4
    std::uint32_t stride = 0;  // bytes from vertex to vertex, a multiple of 4
    HostEncoding encoding = HostEncoding::Float32;
};

// The host's buffers are read during the call, after what its commands have written, and never written. What is read
// is kept on the GPU as other meshes are: 32 bytes a vertex and 4 an index.
struct HostMesh {
    std::string name;
    std::uint32_t vertexCount = 0;
    std::uint32_t indexCount = 0;  // a multiple of 3
    HostAttribute positions;       // x y z, m
    HostAttribute normals;         // x y z, of any length; none: flat, and three vertices a triangle are kept
    HostAttribute uvs;             // u v
    HostAttribute tangents;        // x y z w
    HostAttribute colors;          // r g b a, linear, [0,1]
    std::uint32_t indices = 0;     // GL name; 0: vertices follow each other, three a triangle
    std::uint32_t indexOffset = 0;  // bytes, a multiple of those of an index
    bool shortIndices = false;      // GL_UNSIGNED_SHORT; else GL_UNSIGNED_INT
    // Object space, m: nobody reads positions back, so the host says where they are at most. Those that lie outside are
    // moved to its edge, and those that are not finite to a corner of it.
    Aabb bounds;
};

}  // namespace conelight
