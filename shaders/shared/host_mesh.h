// SPDX-License-Identifier: MIT
// How a mesh of the host's lies in its buffers; filled by src/scene/host_mesh.cpp.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

// HostEncoding of conelight/host_mesh.h
#define HOST_FLOAT32 0u
#define HOST_FLOAT16 1u
#define HOST_SNORM16 2u
#define HOST_SNORM8 3u
#define HOST_UNORM8 4u

#define HOST_INDICES_NONE 0u
#define HOST_INDICES_SHORT 1u
#define HOST_INDICES_LONG 2u

struct HostMeshConstants {
    vec3 low;  // of the bounds
    uint vertexCount;
    // ---- 16 B
    vec3 high;
    uint indexCount;
    // ---- 32 B
    uint firstVertex;  // in the scene's tables
    uint firstIndex;
    uint indexOffset;  // indices
    uint indexKind;    // HOST_INDICES_*
    // ---- 48 B
    // Of each attribute: offset in words, stride in words, HOST_*, and 1 where it is there.
    uvec4 positions;
    uvec4 normals;
    uvec4 uvs;
    uvec4 tangents;
    uvec4 colors;
    // ---- 128 B
    uint noTangent;  // Vertex::tangentOct of a mesh without
    uint pad0;
    uint pad1;
    uint pad2;
};  // 144 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::HostMeshConstants) == 144);
#endif
