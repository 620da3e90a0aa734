// SPDX-License-Identifier: MIT
// Unit vectors that with `n` form a right-handed frame (Duff et al. 2017, "Building an Orthonormal Basis,
// Revisited").
void tangentFrame(vec3 n, out vec3 u, out vec3 v) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    u = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    v = vec3(b, s + n.y * n.y * a, -n.y);
}
