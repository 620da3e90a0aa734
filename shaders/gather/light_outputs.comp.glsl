#version 450 core
// SPDX-License-Identifier: MIT
// Light for a host's own shading (gather/light_outputs.glsl) by a compute shader, for GPUs.
#include "gather/light_outputs.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) writeonly uniform image2D diffuseOutput;
layout(rgba16f) writeonly uniform image2D specularOutput;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(diffuseOutput)))) return;
    vec4 diffuse, specular;
    lightOutputs(pixel, diffuse, specular);
    imageStore(diffuseOutput, pixel, diffuse);
    imageStore(specularOutput, pixel, specular);
}
