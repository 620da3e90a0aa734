// SPDX-License-Identifier: MIT
// What glass leaves of the light of a rectangle: its sample points are looked at one by one through the triangles of
// glass (lib/glass_tree.glsl). GLASS 0: the file is empty. Includers that set it include before:
// lib/scene_tables.glsl, lib/surface_array.glsl.
#include "lib/dot.glsl"
#include "lib/glass_tree.glsl"
#include "lib/random.glsl"
#include "lib/shadow.glsl"
#if GLASS
struct RectTint {
    bool asked;   // any glass may be in the way
    vec2 jitter;  // of all points, in [-1,1]^2 over the row and the column that each has for itself
    vec3 irradiance, specular;  // of points that were looked at, by their weights
    vec2 weights;               // the sums of these
};

RectTint rectTint(vec3 position, Light light) {
    vec3 toMiddle = light.position - position;
    bool asked = mayPassGlass(position, normalize(toMiddle), length(toMiddle),
                              max(length(light.halfU + light.halfV), length(light.halfU - light.halfV)));
    // Other points at each place: edges of glass make no steps, and a still's views make them smooth.
    uint seed = randomHash(floatBitsToUint(position.y + 3.7 * position.z));
    seed = randomHash(floatBitsToUint(position.x) ^ seed);
    vec2 jitter = 2.0 * vec2(randomFloat(seed), randomFloat(randomHash(seed))) - 1.0;
    return RectTint(asked, jitter, vec3(0.0), vec3(0.0), vec2(0.0));
}

// The k-th point; `weight`: of what is visible.
void addTint(inout RectTint tint, vec3 position, Light light, uint k, vec2 weight) {
    if (!tint.asked || weight.x + weight.y <= 0.0) return;
    vec2 beside = tint.jitter / float(light.sampleGrid * light.sampleGrid);
    vec3 toPoint = rectSamplePoint(light, k) + beside.x * light.halfU + beside.y * light.halfV - position;
    float distance = max(length(toPoint), 1e-6);
    float edge = sqrt(rectArea(light));
    vec3 left = glassTransmittance(position, toPoint / distance, distance, min(edge / distance, 1.0), true);
    tint.irradiance += weight.x * left;
    tint.specular += weight.y * left;
    tint.weights += weight;
}

vec3 tintOf(vec3 sum, float weight) { return weight > 0.0 ? sum / weight : vec3(1.0); }
#endif
