#version 450 core
// SPDX-License-Identifier: MIT
// A mesh in buffers of the host's -> the scene's tables of vertices and indices, as src/scene/gpu_vertices.cpp packs
// them. An invocation per vertex and index.
//   FLAT  1: there are no normals; an invocation per triangle, which gets three vertices of its own
#ifndef FLAT
#error FLAT must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/octahedral.glsl"
#include "shared/host_mesh.h"
#include "shared/scene.h"
layout(std140) uniform HostMeshBlock { HostMeshConstants mesh; };
layout(std430) writeonly buffer VertexTable { Vertex vertices[]; };
layout(std430) writeonly buffer IndexTable { uint indices[]; };
layout(std430) readonly buffer HostPositions { uint positionWords[]; };
layout(std430) readonly buffer HostNormals { uint normalWords[]; };
layout(std430) readonly buffer HostUvs { uint uvWords[]; };
layout(std430) readonly buffer HostTangents { uint tangentWords[]; };
layout(std430) readonly buffer HostColors { uint colorWords[]; };
layout(std430) readonly buffer HostIndices { uint indexWords[]; };

// Words of a vertex that hold so many numbers of an attribute, at most 4.
uint wordsOf(uvec4 a, uint numbers) {
    uint perWord = a.z == HOST_FLOAT32 ? 1u : a.z >= HOST_SNORM8 ? 4u : 2u;
    return (numbers + perWord - 1u) / perWord;
}

vec4 decoded(uvec4 a, uvec4 words) {
    switch (a.z) {
        case HOST_FLOAT32:
            return uintBitsToFloat(words);
        case HOST_FLOAT16:
            return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
        case HOST_SNORM16:
            return vec4(unpackSnorm2x16(words.x), unpackSnorm2x16(words.y));
        case HOST_SNORM8:
            return unpackSnorm4x8(words.x);
        default:
            return unpackUnorm4x8(words.x);
    }
}

// GLSL 4.5 hands no buffer to a function.
#define READ(NAME, TABLE, NUMBERS)                                  \
    vec4 NAME(uvec4 a, uint vertex) {                               \
        uint at = a.x + vertex * a.y, count = wordsOf(a, NUMBERS);  \
        uvec4 words = uvec4(0u);                                    \
        for (uint i = 0u; i < count; ++i) words[i] = TABLE[at + i]; \
        return decoded(a, words);                                   \
    }
READ(positionAt, positionWords, 3u)
READ(normalAt, normalWords, 3u)
READ(uvAt, uvWords, 2u)
READ(tangentAt, tangentWords, 4u)
READ(colorAt, colorWords, 4u)

bool isFinite(float x) { return !isnan(x) && !isinf(x); }

vec3 unitOr(vec3 v, vec3 fallback) {
    float size = length(v);
    return size > 1e-20 && isFinite(size) ? v / size : fallback;
}

vec3 placeOf(uint vertex) {
    vec3 p = positionAt(mesh.positions, vertex).xyz;
    if (!isFinite(p.x) || !isFinite(p.y) || !isFinite(p.z)) p = mesh.low;
    return clamp(p, mesh.low, mesh.high);
}

uint vertexOf(uint corner) {
    uint at = mesh.indexOffset + corner;
    uint index = corner;
    if (mesh.indexKind == HOST_INDICES_SHORT) index = (indexWords[at / 2u] >> (16u * (at & 1u))) & 0xffffu;
    if (mesh.indexKind == HOST_INDICES_LONG) index = indexWords[at];
    return min(index, mesh.vertexCount - 1u);
}

uint tangentOf(uint vertex) {
    if (mesh.tangents.w == 0u) return mesh.noTangent;
    vec4 t = tangentAt(mesh.tangents, vertex);
    uint word = packSnorm2x16(octEncode(unitOr(t.xyz, vec3(1.0, 0.0, 0.0))));
    return (word & ~(VERTEX_SOLID_BITS | 1u)) | (t.w < 0.0 ? 1u : 0u);
}

void put(uint at, uint vertex, vec3 position, vec3 normal) {
    Vertex v;
    v.position = position;
    v.normalOct = packSnorm2x16(octEncode(normal));
    vec2 uv = mesh.uvs.w != 0u ? uvAt(mesh.uvs, vertex).xy : vec2(0.0);
    v.u = isFinite(uv.x) ? uv.x : 0.0;
    v.v = isFinite(uv.y) ? uv.y : 0.0;
    v.tangentOct = tangentOf(vertex);
    v.color = mesh.colors.w != 0u ? packUnorm4x8(colorAt(mesh.colors, vertex)) : 0xffffffffu;
    vertices[mesh.firstVertex + at] = v;
}

void main() {
    uint i = linearIndex();
#if FLAT
    if (3u * i >= mesh.indexCount) return;
    uvec3 corners = uvec3(vertexOf(3u * i), vertexOf(3u * i + 1u), vertexOf(3u * i + 2u));
    vec3 a = placeOf(corners.x), b = placeOf(corners.y), c = placeOf(corners.z);
    vec3 normal = unitOr(cross(b - a, c - a), vec3(0.0, 1.0, 0.0));
    put(3u * i, corners.x, a, normal);
    put(3u * i + 1u, corners.y, b, normal);
    put(3u * i + 2u, corners.z, c, normal);
    for (uint k = 3u * i; k < 3u * i + 3u; ++k) indices[mesh.firstIndex + k] = k;
#else
    if (i < mesh.vertexCount)
        put(i, i, placeOf(i), unitOr(normalAt(mesh.normals, i).xyz, vec3(0.0, 1.0, 0.0)));
    if (i < mesh.indexCount) indices[mesh.firstIndex + i] = vertexOf(i);
#endif
}
