// SPDX-License-Identifier: MIT
// Scalar products, and what is made of them, with one rounding on every driver. Built in, they are free in the order of
// their sum and may be fused (OpenGL 4.5 core leaves both open): llvmpipe and lavapipe differ in the last bit, and a
// last bit in a sum of fluxes draws other light samples. The order is that of llvmpipe. These hide the built-in
// functions (GLSL 4.50, 6.1) from where they are included, so every file that calls one includes this;
// tools/check_shaders sees to it.

float dot(vec2 a, vec2 b) {
    precise float sum = a.y * b.y + a.x * b.x;
    return sum;
}
float dot(vec3 a, vec3 b) {
    precise float sum = a.z * b.z + a.y * b.y + a.x * b.x;
    return sum;
}
float dot(vec4 a, vec4 b) {
    precise float sum = a.w * b.w + a.z * b.z + a.y * b.y + a.x * b.x;
    return sum;
}

float length(vec2 v) { return sqrt(dot(v, v)); }
float length(vec3 v) { return sqrt(dot(v, v)); }
vec2 normalize(vec2 v) { return v * inversesqrt(dot(v, v)); }
vec3 normalize(vec3 v) { return v * inversesqrt(dot(v, v)); }
vec3 reflect(vec3 incident, vec3 normal) { return incident - 2.0 * dot(normal, incident) * normal; }
