// SPDX-License-Identifier: MIT
// The occlusion cone from a pixel to a light -> share of the light that does not arrive. Before it:
// cone_samples.glsl, ThesisConstants `thesis`, OCCLUSION.
#include "lib/dot.glsl"

// What a sample's opacity is multiplied by, at distance t of a cone whose way to a light is `distance` long.
float occlusionGain(float t, float distance) {
#if OCCLUSION == CUSTOMISED
#if OCCLUSION_FUDGE
    float x = clamp(thesis.shadowStrength * sqrt(t) / distance, 0.0, 1.0);
#else
    float x = clamp(thesis.shadowStrength * sqrt(t / distance), 0.0, 1.0);
#endif
    return x * x * (3.0 - 2.0 * x);
#else
    return 1.0;
#endif
}

float withStep(float opacity, float added) {
#if NO_STEP_CORRECTION
    return opacity + (1.0 - opacity) * added;
#else
    return min(opacity + added, 1.0);
#endif
}

// Opacity that a step adds: x by what faces the cone, y by what faces away. A closed body has both, once each; a
// sheet one of them.
#if ISOTROPIC_OPACITY
// Where in its step a sample lies: at the beginning.
const float kSampleAt = 0.0;

// Of a step of `length`, sampled at distance t in texels of edge `size`, times `gain`.
vec2 stepOcclusion(vec3 origin, vec3 direction, float t, float size, float length, float gain) {
    vec3 p = origin + t * direction;
    return vec2(stepOpacity(sampleVolume(p, size).a * gain, length, max(size, grid.voxelSize)), 0.0);
}
#else
const float kSampleAt = 0.5;  // in the middle
const float kReach = 1.5;     // of a sample past its centre, texels: half a texel and a tent

// A surface of normal n hides |n.d| of its area: the sum over its areas along the axes (theory 4a, "A cone").
// Between two levels, as distances to a light differ from pixel to pixel, and so would the jumps of whole
// levels; a step's part of their mean edge makes a plane whole.
vec2 stepOcclusion(vec3 origin, vec3 direction, float t, float size, float length, float gain) {
    vec3 q = (origin + t * direction - grid.origin) / grid.edge;
    float level = sampleLevel(size, grid.voxelSize, grid.maxLevel);
#if OCTREE
    vec3 plus, minus;
    sampleBorderedBricks(areasPlus, areasMinus, q, level, plus, minus);
#else
    vec3 plus = textureLod(areasPlus, q, level).rgb, minus = textureLod(areasMinus, q, level).rgb;
#endif
    vec3 facing = mix(plus, minus, greaterThan(direction, vec3(0.0)));
    vec3 share = gain * abs(direction);
    float finer = floor(level);
    float edge = grid.voxelSize * exp2(finer) * (1.0 + level - finer);
    // What faces away and may have been beside the start, in reach of a sample, is a wall of the corner there.
    vec3 left = clamp(abs(direction) * (t / (kReach * edge)) - 1.0, 0.0, 1.0);
    vec2 seen = vec2(dot(facing, share), dot((plus + minus - facing) * left, share));
#if NO_STEP_CORRECTION
    return min(seen, 1.0);
#else
    return min(seen * (length / edge), 1.0);
#endif
}
#endif

// Way from `origin` to where the box of voxels that hold anything ends.
float wayOut(vec3 origin, vec3 direction) {
    vec3 low = grid.origin + grid.voxelSize * vec3(grid.boxMin.xyz);
    vec3 high = low + grid.voxelSize * vec3(grid.boxSize.xyz);
    vec3 away = mix(direction, vec3(1e-6), lessThan(abs(direction), vec3(1e-6)));
    vec3 ways = (mix(low, high, greaterThan(away, vec3(0.0))) - origin) / away;
    return max(min(min(ways.x, ways.y), ways.z), grid.voxelSize);
}

// Way in whose parts occluders are near to the surface. The farther a light is outside of the box, the shorter it is;
// nothing of it is left where the light has no place.
float wayOf(ThesisLight light, vec3 origin, vec3 direction, float distance) {
#if OCCLUSION_FUDGE
    return distance;
#else
    float inBox = min(light.distance, wayOut(origin, direction));
    return inBox * inBox / light.distance;
#endif
}

// Share of the light that does not arrive.
float traceOcclusion(Surface s, ThesisLight light, float spread, bool isTraced, inout uint samples) {
    ThesisCone cone = coneOf(thesis.occlusionCone);
    cone.spread = spread;
    float offset = originOffset(0.0);
    vec3 origin = s.position + offset * s.normal;
    vec3 toLight = s.position + light.toLight * light.distance - origin;
    // Lights far outside act from just outside.
    float distance = min(length(toLight), 2.0 * grid.edge);
    vec3 direction = normalize(toLight);
    float way = wayOf(light, origin, direction, distance);
    float climb = dot(direction, s.normal);
#if FIXED_OFFSETS
    float end = distance;
#else
    // The cone ends where its samples would touch what the light hangs on.
    float end = distance - kOriginOffset * grid.voxelSize;
#endif
    float t = cone.start;
    vec2 hidden = vec2(0.0);
    float opacity = 0.0;
    uint coneSamples = 0u;
    bool running = isTraced && t < end;
    bool started = running;
    do {
        float diameter = cone.spread * t;
        float size = sampleSize(diameter, min(offset + t * climb, distance - t), grid.voxelSize);
        float texelEdge = max(size, grid.voxelSize);
        float stride = stepLength(cone, diameter, texelEdge);
#if LAST_STEP
        float length = stride;
#else
        float length = min(stride, end - t);
#endif
        float at = t + kSampleAt * length;
        float gain = occlusionGain(at, way);
#if NO_STEP_CORRECTION && !LAST_STEP
        gain *= length / stride;
#endif
        vec2 added = stepOcclusion(origin, direction, at, size, length, gain);
        ++coneSamples;
        float opacityBefore = opacity;
        hidden = vec2(withStep(hidden.x, added.x), withStep(hidden.y, added.y));
        opacity = max(hidden.x, hidden.y);
        if (running)
            RECORD_STEP(STEP_SAMPLE, origin + at * direction, at, texelEdge,
                        sampleLevel(size, grid.voxelSize, grid.maxLevel), vec3(0.0), opacity - opacityBefore,
                        opacity);
        t += stride;
        running = running && t < end && opacity < 0.999 && coneSamples < thesis.maxSamples;
    } while (running);
    samples += started ? coneSamples : 0u;
    RECORD_PATH(PATH_OCCLUSION_CONE, origin, direction, 0.5 * cone.spread,
                vec3(1.0 / float(max(thesis.lightCount, 1u))), vec3(started ? 1.0 - opacity : 1.0),
                started ? opacity : 0.0, min(t, end), opacity >= 0.999 ? END_FULL : END_OPEN);
    return started ? opacity : 0.0;
}
