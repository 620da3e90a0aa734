#version 450 core
// SPDX-License-Identifier: MIT
// Distance to the edges of a triangle -> a line along them, premultiplied.
#include "lib/dot.glsl"
#include "shared/image.h"
layout(std140) uniform WireframeBlock { WireframeConstants wireframe; };
layout(std140) uniform ExposureBlock { Exposure exposure; };
layout(location = 0) flat in vec3 edge0;
layout(location = 1) flat in vec3 edge1;
layout(location = 2) flat in vec3 edge2;
layout(location = 0) out vec4 color;

void main() {
    vec3 at = vec3(gl_FragCoord.xy, 1.0);
    float nearest = min(abs(dot(edge0, at)), min(abs(dot(edge1, at)), abs(dot(edge2, at))));
    float line = clamp(wireframe.halfWidth + 0.5 - nearest, 0.0, 1.0) * wireframe.opacity;
    if (line <= 0.0) discard;
    color = line * vec4(wireframe.color / exposure.scale, 1.0);
}
