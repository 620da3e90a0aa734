// SPDX-License-Identifier: MIT
// Vertices of the scene's triangles, for the passes of the voxelizer that read them: surface_setup for
// positions, surface_clip for texture coordinates and colours. Both must see the corners in one order.
layout(std430) readonly buffer VertexTable { Vertex vertices[]; };
layout(std430) readonly buffer IndexTable { uint indices[]; };
layout(std430) readonly buffer InstanceTable { Instance instances[]; };
layout(std430) readonly buffer MaterialTable { Material materials[]; };

// Places in VertexTable, counter-clockwise also in mirrored instances.
uvec3 cornersOfTriangle(uint triangle, uint instance) {
    uint firstIndex = instances[instance].firstIndex + 3u * (triangle - instances[instance].firstTriangle);
    bool flipped = (instances[instance].flags & INSTANCE_FLIPPED) != 0u;
    return instances[instance].firstVertex + uvec3(indices[firstIndex],
                                                   indices[firstIndex + (flipped ? 2u : 1u)],
                                                   indices[firstIndex + (flipped ? 1u : 2u)]);
}
