#version 450 core
// SPDX-License-Identifier: MIT
// The volume itself: every texel of a level that holds anything as a cube of its colour (thesis, "Voxel
// Visualization"), found by walking the grid from the eye (Amanatides and Woo 1987); or, with SURFACES, the
// texels' colours at the places the eye sees. Colours are shown as stored, that is premultiplied, unless the
// opacity is below one: then divided by it, so that coarse levels stay legible.
#include "lib/gbuffer.glsl"
#include "shared/thesis.h"
layout(local_size_x = 8, local_size_y = 8) in;
#ifndef SURFACES
#error SURFACES must be 0 or 1
#endif
layout(std140, binding = BINDING_THESIS_GRID) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std140, binding = BINDING_PASS) uniform ThesisBlock { ThesisConstants thesis; };
layout(binding = UNIT_PASS) uniform sampler3D volume;
layout(binding = 0, rgba32f) uniform writeonly image2D picture;

vec3 shownColor(vec4 texel) { return texel.rgb / max(texel.a, 1e-4); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inside = all(lessThan(pixel, ivec2(frame.width, frame.height)));
    int level = int(min(float(thesis.viewLevel), grid.maxLevel));
    vec4 shown = vec4(0.0);
#if SURFACES
    Surface s;
    bool seen = fetchSurface(min(pixel, ivec2(frame.width, frame.height) - 1), s) && inside;
    vec4 texel = textureLod(volume, (s.position - grid.origin) / grid.edge, float(level));
    if (seen) shown = vec4(shownColor(texel), 1.0);
#else
    vec3 size = vec3(textureSize(volume, level));
    // In texels of the level.
    vec3 origin = (frame.eye - grid.origin) / grid.edge * size;
    vec3 direction = normalize(pixelRay(pixel));
    direction = mix(direction, vec3(1e-6), lessThan(abs(direction), vec3(1e-6)));
    vec3 inverse = 1.0 / direction;
    vec3 toLow = -origin * inverse, toHigh = (size - origin) * inverse;
    vec3 entries = min(toLow, toHigh), exits = max(toLow, toHigh);
    float t = max(max(entries.x, entries.y), max(entries.z, 0.0));
    float end = min(exits.x, min(exits.y, exits.z));
    ivec3 cell = clamp(ivec3(floor(origin + t * direction)), ivec3(0), ivec3(size) - 1);
    ivec3 cellStep = ivec3(sign(direction));
    vec3 next = (vec3(cell) + 0.5 + 0.5 * vec3(cellStep) - origin) * inverse;
    bool running = inside && t < end;
    do {
        vec4 texel = texelFetch(volume, cell, level);
        if (running && texel.a > 0.0) shown = vec4(shownColor(texel), 1.0);
        bvec3 nearest = lessThanEqual(next, min(next.yzx, next.zxy));
        // Exactly one axis, also where two borders meet.
        ivec3 axis = nearest.x ? ivec3(1, 0, 0) : nearest.y ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
        cell += axis * cellStep;
        next += vec3(axis) * abs(inverse);
        running = running && shown.a == 0.0 && all(greaterThanEqual(cell, ivec3(0))) &&
                  all(lessThan(cell, ivec3(size)));
    } while (running);
#endif
    if (shown.a == 0.0) shown.rgb = frame.sky;
    if (inside) imageStore(picture, pixel, shown);
}
