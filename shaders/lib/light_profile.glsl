// SPDX-License-Identifier: MIT
// Profiles of lamps: how the strength of a point light or spot depends on the direction it leaves in. Layer n of the
// table belongs to lights with n + 1 in the high half of their flags; a row is an angle from the light's direction, from
// 0 to pi, a column one about it, from halfU by -halfV, all round. Linear between them, as intensityFactor in
// src/scene/light_profile.cpp.
#include "lib/dot.glsl"
#include "shared/scene.h"
uniform sampler2DArray lightProfiles;

// Factor of the light's intensity; `toLight` is a unit vector.
float profileFactor(Light light, vec3 toLight) {
    int layer = int(light.flags >> LIGHT_PROFILE_SHIFT) - 1;
    if (layer < 0) return 1.0;
    vec3 size = vec3(textureSize(lightProfiles, 0));
    float cosine = clamp(-dot(toLight, light.direction), -1.0, 1.0);
    float about = atan(dot(toLight, light.halfV), -dot(toLight, light.halfU)) * (0.5 / 3.14159265);
    vec2 at = vec2(fract(about) * size.x, acos(cosine) * ((size.y - 1.0) / 3.14159265));
    ivec2 low = ivec2(min(at, size.xy - vec2(1.0, 2.0)));
    vec2 part = at - vec2(low);
    int next = low.x + 1 < int(size.x) ? low.x + 1 : 0;
    float a = texelFetch(lightProfiles, ivec3(low, layer), 0).x;
    float b = texelFetch(lightProfiles, ivec3(next, low.y, layer), 0).x;
    float c = texelFetch(lightProfiles, ivec3(low.x, low.y + 1, layer), 0).x;
    float d = texelFetch(lightProfiles, ivec3(next, low.y + 1, layer), 0).x;
    return mix(mix(a, b, part.x), mix(c, d, part.x), part.y);
}
