// SPDX-License-Identifier: MIT
// The geometry of the thesis's cones, without textures: sizes along a cone, the cone sets, the angular
// weight. Numbers and letters: docs/theory/4g_thesis_cones.md, "The thesis's cones".
#include "lib/dot.glsl"
#include "thesis/shaders/defects.glsl"

// A sample of size s reaches past its centre by 1.5 s (the tent of a texel whose centre is half a texel away)
// and by up to twice that, with little weight, where the next coarser level is blended in. Sizes are kept
// below the clearance divided by this, a value between the two, by eye on the thesis's rooms: at 1.5 walls
// light themselves, at 2.5 diffuse cones are too narrow and corners cast bands.
const float kClearance = 2.0;
// In voxels: surfaces are at most one voxel from the centres of their voxels, whose tents reach one further.
const float kOriginOffset = 1.75;

// Edge of the texels that stand for the cone at distance t. A disc of diameter d has the standard deviation
// d/4 along each axis, the kernel of a trilinear sample (a box and a tent of edge s) s/2: they are equal for
// s = d/2. But never so large that the kernel would touch a surface at distance `clearance`, which the cone
// does not meet. May be less than a voxel: what is then read is a voxel, max(size, voxelSize).
float sampleSize(float diameter, float clearance, float voxelSize) {
#if COARSE_LOD
    float size = diameter;
#else
    float size = 0.5 * diameter;
#endif
#if !FIXED_OFFSETS
    size = max(min(size, clearance * (1.0 / kClearance)), 1e-3 * voxelSize);
#endif
    return size;
}

// Level whose texels have that edge. The original took log2(diameter N) for a grid of edge 2: one too many.
float sampleLevel(float size, float voxelSize, float maxLevel) {
    float level = log2(size / voxelSize);
#if COARSE_LOD
    level += 1.0;
#endif
    return clamp(level, 0.0, maxLevel);
}

// Two axes across n. The original's lie across world z: none where n is parallel to it, short elsewhere.
// Here they lie across y, with a fixed choice where n is parallel to it: rooms have few round ceilings.
struct ConeFrame {
    vec3 x;
    vec3 z;
    bool defined;  // false: the original's z is not a number
};

ConeFrame coneFrame(vec3 n) {
    ConeFrame result;
#if NAN_AXES
    vec3 x = vec3(n.y, -n.x, 0.0);  // n x (0, 0, 1)
#else
    vec3 x = vec3(-n.z, 0.0, n.x);  // n x (0, 1, 0)
    if (dot(x, x) < 1e-8) x = vec3(1.0, 0.0, 0.0);
#endif
    float len2 = dot(x, x);
    result.defined = len2 > 1e-12;
    vec3 unitX = x * inversesqrt(max(len2, 1e-12));
    result.z = cross(unitX, n);
#if SHORT_SIDE_AXIS
    result.x = x;
#else
    result.x = unitX;
#endif
    return result;
}

// Cone number k of the enabled sets: front (1), intermediate (4), side (4), in this order. a: weight.
// `lift` is the sine of the elevation of side cones above the surface, so that they do not graze it.
vec4 coneOfSets(int k, int frontCones, int intermediateCones, vec3 n, ConeFrame axes, float lift) {
    int j = k - frontCones;
    bool side = j >= intermediateCones;
    vec3 across = ((j & 2) == 0 ? axes.x : axes.z) * ((j & 1) == 0 ? 1.0 : -1.0);
#if GRAZING_SIDE_CONES
    vec3 sideways = across;
    lift = 0.0;
#else
    vec3 sideways = across * sqrt(1.0 - lift * lift) + n * lift;
#endif
    vec3 tilted = normalize(n + across);
    vec3 direction = j < 0 ? n : side ? sideways : tilted;
#if NO_COSINE_WEIGHTS
    float weight = 1.0;
#else
    // cos 45 degrees for the intermediate cones whatever their axes do, so that weights add up as normalised.
    float weight = j < 0 ? 1.0 : side ? max(lift, 0.05) : 0.70710678;
#endif
    return vec4(direction, weight);
}

// Sum of the weights above.
float weightOfSets(int frontCones, int intermediateCones, int sideCones, float lift) {
#if NO_COSINE_WEIGHTS
    return float(frontCones + intermediateCones + sideCones);
#else
#if GRAZING_SIDE_CONES
    lift = 0.0;
#endif
    return float(frontCones) + 0.70710678 * float(intermediateCones) + max(lift, 0.05) * float(sideCones);
#endif
}

// The thesis's angular weight (1 - g/pi)^q: g is the angle between mirrored view and light, less a grace that
// grows with shininess: 0.008 pi per unit, in the original up to all of pi at 125; here it nears pi but never
// gets there, with the same slope at 0.
float angularWeight(float cosToLight, float shininess, float falloff) {
    const float kPi = 3.14159265;
#if SHININESS_SATURATION
    float grace = 0.008 * kPi * shininess;
#else
    float grace = kPi * (1.0 - exp(-0.008 * shininess));
#endif
    float angle = max(acos(clamp(cosToLight, -1.0, 1.0)) - grace, 0.0);
    return pow(max(1.0 - angle / kPi, 0.0), falloff);
}

// Spread (diameter per distance) of a cone as wide as the Phong lobe cos^shininess at half its height. At
// most 1 (53 degrees): wider ones would reach below the horizon.
float spreadOfShininess(float shininess) {
    return min(2.0 * sqrt(exp2(2.0 / max(shininess, 0.1)) - 1.0), 1.0);
}
