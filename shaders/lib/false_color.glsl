// SPDX-License-Identifier: MIT
// Numbers as colours: 0 blue, 1/2 green, 1 red, mixtures between; beyond the ends as at them.
vec3 falseColor(float x) {
    return clamp(1.5 - abs(4.0 * clamp(x, 0.0, 1.0) - vec3(4.0, 2.0, 0.0) + vec3(0.5, 0.0, -0.5)), 0.0, 1.0);
}
