// SPDX-License-Identifier: MIT
// Unit vectors as two numbers: octahedral mapping (Meyer et al. 2010, "On Floating-Point Normal Vectors").
// C++ twin: src/math/octahedral.h.
#include "lib/dot.glsl"

vec2 octWrap(vec2 v) { return (1.0 - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

// Unit vector -> [-1,1]^2.
vec2 octEncode(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z >= 0.0 ? p : octWrap(p);
}

// [-1,1]^2 -> unit vector.
vec3 octDecode(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = octWrap(n.xy);
    return normalize(n);
}
