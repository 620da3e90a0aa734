// SPDX-License-Identifier: MIT
// Light of many lamps at a place: a few of them, of which rays tell whether they are seen, stand for all. The mean over
// draws is the sum over all lamps (docs/theory/3_light.md, "Many lamps").
//
// A walk down the tree (shared/lamps.h) ends where what a node gives is known well enough: at a lamp, or where one lamp
// of the node, drawn by power, may stand for the others. After Yuksel 2019, "Stochastic Lightcuts", and Conty Estevez
// and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting". Of these candidates some are drawn by
// what they would give, at even distances over its sum (Talbot et al. 2005, "Importance Resampling for Global
// Illumination"), and asked whether they are seen.
//
// Includers include before: what rays need (lib/lamp_sight.glsl).
#include "lib/dot.glsl"
#include "lib/lamp_sight.glsl"
#include "lib/lights.glsl"
#include "lib/random.glsl"
#include "shared/lamps.h"
uniform usamplerBuffer lampNodes;
uniform usamplerBuffer lampSlots;

// A node is left whole where what it may err by is below this part of all light: 32 candidates or so of 10^4 lamps
// (builtin:lamps).
const float kLampTolerance = 0.02;
// The sum of all light is told from nodes that a place lies outside of, by so many radii.
const float kLampOutside2 = 1.0;
// Of the cosine of a node that reaches above the horizon.
const float kLampLeastCosine = 1e-3;
const int kMostLampCandidates = 64;
// Levels of a tree over 10^6 lamps: so many nodes may be left to walk through when no more are opened.
const int kLampDepth = 20;
const int kLampAttempts = 8;

// A node as a place sees it.
struct LampNodeView {
    float gives;  // about, per solid angle of the lamps' light: W/m^2
    float wide;   // its radius over its distance; 0: a lamp
    bool within;
    bool lamp;
    int next;
    uint firstSlot;
};

LampNodeView lampNode(int node, vec3 position, vec3 normal) {
    uvec4 a = texelFetch(lampNodes, 3 * node), b = texelFetch(lampNodes, 3 * node + 1);
    vec3 way = uintBitsToFloat(a.xyz) - position;
    float radius2 = uintBitsToFloat(a.w), d2 = dot(way, way);
    LampNodeView seen;
    seen.next = int(b.z);
    seen.firstSlot = b.w;
    seen.lamp = seen.next == node + 1;
    seen.within = d2 <= kLampOutside2 * radius2;
    // The largest cosine with the normal of directions to its sphere
    float cosine = dot(way, normal) * inversesqrt(max(d2, 1e-20));
    float sine2 = clamp(radius2 / max(d2, 1e-20), 0.0, 1.0);
    float wideCosine = sqrt(1.0 - sine2);
    float reached = cosine * wideCosine + sqrt(max(1.0 - cosine * cosine, 0.0) * sine2);
    float largest = cosine >= wideCosine ? 1.0 : max(reached, kLampLeastCosine);
    largest = seen.lamp ? max(cosine, 0.0) : largest;
    float outOfReach = sqrt(d2) - sqrt(radius2) - uintBitsToFloat(b.y);
    seen.gives = outOfReach > 0.0 ? 0.0 : uintBitsToFloat(b.x) * largest / max(max(d2, radius2), 1e-6);
    seen.wide = seen.lamp ? 0.0 : sqrt(sine2);
    return seen;
}

// About what all lamps give.
float lampTotal(vec3 position, vec3 normal, bool wanted) {
    float total = 0.0;
    int end = int(texelFetch(lampNodes, 1).z), node = wanted ? 0 : end - 1;
    do {
        LampNodeView seen = lampNode(node, position, normal);
        bool opens = seen.within && !seen.lamp;
        total += opens ? 0.0 : seen.gives;
        node = opens ? node + 1 : seen.next;
    } while (node < end);
    return total;
}

// What a lamp gives, were it seen, and but for glass.
DirectLight lampShare(const bool specular, Receiver r, Brdf b, Light light) {
    vec3 l = light.position - r.position;
    float d2 = dot(l, l);
    l *= inversesqrt(max(d2, 1e-20));
    float facing = distanceFalloff(light, d2) * spotFalloff(light, l);
    DirectLight sum = DirectLight(vec3(0.0), vec3(0.0));
    addLight(sum, specular, r, b, l, light.intensity * (dot(l, r.geometricNormal) > 0.0 ? facing : 0.0));
    return sum;
}

// The radiance that it is told by; of a place without lobe its irradiance.
float lampBrightness(const bool specular, DirectLight light, Brdf b) {
    vec3 reflected = specular ? b.diffuse / kPi * light.irradiance + light.specular : light.irradiance;
    return dot(reflected, vec3(1.0 / 3.0));
}

// Which draw of a place: those of one seed complement each other.
struct LampDraw {
    uint seed;
    uint index;
    bool wanted;
};

// The candidates of a draw, in the tree's order: their lamps, and the sum of what they and those before would give.
uint candidateLamps[kMostLampCandidates];
float candidateSums[kMostLampCandidates];

// Finds them; returns how many. Of a node that one lamp stands for each place draws evenly over passes. Where there would
// be too many, nodes are left whole that give more.
int findCandidates(const bool specular, Receiver r, Brdf b, LampDraw draw) {
    float least = kLampTolerance * lampTotal(r.position, r.normal, draw.wanted);
    int end = int(texelFetch(lampNodes, 1).z), count, attempts = 0;
    bool tooMany;
    do {
        int node = draw.wanted ? 0 : end - 1;
        float sum = 0.0;
        tooMany = false;
        count = 0;
        do {
            LampNodeView seen = lampNode(node, r.position, r.normal);
            bool opens = !seen.lamp && (seen.within || seen.gives * seen.wide > least);
            tooMany = tooMany || (opens && count >= kMostLampCandidates - kLampDepth);
            opens = opens && count < kMostLampCandidates - kLampDepth;
            if (!opens && seen.gives > 0.0) {
                uint slots = texelFetch(lampNodes, 3 * node + 2).x;
                float xi = sequencePoint(draw.seed ^ uint(node) * 0x9e3779b9u, draw.index).y;
                uint slot = seen.firstSlot + min(uint(xi * float(slots)), slots - 1u);
                uint number = texelFetch(lampSlots, int(slot)).x;
                Light light = lightOfTexels(number);
                float times = seen.lamp ? 1.0 : float(slots) / float(light.sampleGrid);
                sum += times * lampBrightness(specular, lampShare(specular, r, b, light), b);
                candidateLamps[count] = number;
                candidateSums[count] = sum;
                ++count;
            }
            node = opens ? node + 1 : seen.next;
        } while (node < end && count < kMostLampCandidates);
        least *= 2.0;
    } while (tooMany && ++attempts < kLampAttempts);
    return count;
}

// Light of all lamps at a place; rays begin at `start`, which lies off its surface.
DirectLight lampLight(const bool specular, Receiver r, Brdf b, vec3 start, LampDraw draw) {
    int count = findCandidates(specular, r, b, draw);
    float all = count > 0 && draw.wanted ? candidateSums[max(count - 1, 0)] : 0.0;
    float first = sequencePoint(draw.seed, draw.index).x;
    DirectLight sum = DirectLight(vec3(0.0), vec3(0.0));
    int at = 0, i = 0;
    do {
        float place = all * (float(i) + first) / float(LAMP_RAYS);
        while (at < count - 1 && candidateSums[at] <= place) ++at;
        Light light = lightOfTexels(candidateLamps[at]);
        DirectLight share = lampShare(specular, r, b, light);
        float brightness = lampBrightness(specular, share, b);
        bool any = all > 0.0 && brightness > 0.0;
        bool asked = any && (light.flags & LIGHT_CASTS_SHADOW) != 0u;
        bool seen = any && (seesLamp(start, light.position, asked) || !asked);
        vec3 left = vec3(seen ? all / (float(LAMP_RAYS) * brightness) : 0.0);
#if GLASS
        vec3 toLamp = light.position - r.position;
        float distance = length(toLamp);
        if (seen)
            left *= glassTransmittance(r.position, toLamp / max(distance, 1e-20), distance, kAnyBend, true);
#endif
        sum.irradiance += left * share.irradiance;
        sum.specular += left * share.specular;
    } while (++i < LAMP_RAYS);
    return sum;
}
