// SPDX-License-Identifier: MIT
// Area lights of constant radiance: rectangles; with LIGHTS_SHAPED (lib/rect_points.glsl) disks and spheres, too.
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/rect_points.glsl"
#include "lib/tangent_frame.glsl"
#include "shared/scene.h"

// Angle between unit vectors a and b, times the component along n of the unit normal of their plane.
float edgeTerm(vec3 a, vec3 b, vec3 n) {
    vec3 c = cross(a, b);
    float sine = length(c);
    float cosine = dot(a, b);
    // angle / sine -> 1 for small angles.
    float angle = sine > 1e-5 ? atan(sine, cosine) / sine : 1.0;
    return angle * dot(c, n);
}

// Irradiance at the origin with normal n per unit radiance of a convex polygon: Lambert's sum over
// edges (Lambert 1760; Baum et al. 1989, "Improving Radiosity Solutions through the Use of Analytically
// Determined Form-Factors", eq. 7), clipped at the horizon. A convex polygon leaves and enters the horizon
// once at most, so the clipped edges plus one edge along the horizon close it.
struct PolygonSum {
    vec3 leaves, enters;
    float sum;
};

void addEdge(inout PolygonSum s, vec3 a, vec3 b, vec3 n) {
    float ha = dot(a, n), hb = dot(b, n);
    bool aAbove = ha > 0.0, bAbove = hb > 0.0;
    // Where the edge crosses the horizon, if it does.
    vec3 crossing = a + (b - a) * (ha / (aAbove != bAbove ? ha - hb : 1.0));
    if (aAbove && !bAbove) s.leaves = crossing;
    if (!aAbove && bAbove) s.enters = crossing;
    vec3 from = aAbove ? a : crossing;
    vec3 to = bAbove ? b : crossing;
    float term = edgeTerm(normalize(from), normalize(to), n);
    s.sum += aAbove || bAbove ? term : 0.0;
}

float closedSum(PolygonSum s, vec3 n) {
    bool clipped = dot(s.leaves, s.leaves) > 0.0 && dot(s.enters, s.enters) > 0.0;
    s.sum += clipped ? edgeTerm(normalize(s.leaves), normalize(s.enters), n) : 0.0;
    return 0.5 * abs(s.sum);  // the sign is that of the edges' turn
}

float polygonIrradiance(vec3 corner[4], vec3 n) {
    PolygonSum s = PolygonSum(vec3(0.0), vec3(0.0), 0.0);
    for (int i = 0; i < 4; ++i) addEdge(s, corner[i], corner[(i + 1) & 3], n);
    return closedSum(s, n);
}

void rectCorners(Light light, vec3 p, out vec3 corner[4]) {
    vec3 c = light.position - p;
    corner[0] = c - light.halfU - light.halfV;
    corner[1] = c + light.halfU - light.halfV;
    corner[2] = c + light.halfU + light.halfV;
    corner[3] = c - light.halfU + light.halfV;
}

#if LIGHTS_SHAPED
// Round lights are polygons of twelve corners and of their area: what is reflected of them is then sums over edges,
// as of rectangles. Of a sphere it is the disc where lines from the receiver touch it.
const int kRoundCorners = 12;
const float kRoundCornerRadius = 1.0233267;    // sqrt(pi / 3)
const vec2 kRoundTurn = vec2(0.8660254, 0.5);  // cosine and sine of a twelfth
const float kRoundNearby = 1.0 / 3600.0;       // radius^2 / distance^2, below which a light is a point:
                                               // it errs by 3e-4 there, and sums over edges by rounding
struct LightDisk {
    vec3 middle, u, v;  // from the receiver
};

LightDisk diskOf(Light light, vec3 p) {
    vec3 c = light.position - p;
    if (!isSphere(light)) return LightDisk(c, light.halfU, light.halfV);
    float d2 = max(dot(c, c), 1e-20), r2 = dot(light.halfU, light.halfU);
    float part = max(1.0 - r2 / d2, 0.0);
    vec3 u, v;
    tangentFrame(c * inversesqrt(d2), u, v);
    float radius = sqrt(r2 * part);
    return LightDisk(part * c, radius * u, radius * v);
}

bool roundShines(Light light, vec3 c) {
    return isSphere(light) ? dot(c, c) > dot(light.halfU, light.halfU) : dot(c, light.direction) < 0.0;
}

float roundExtent2(Light light) { return max(dot(light.halfU, light.halfU), dot(light.halfV, light.halfV)); }

float roundPolygon(LightDisk r, vec3 n) {
    r.u *= kRoundCornerRadius;
    r.v *= kRoundCornerRadius;
    PolygonSum s = PolygonSum(vec3(0.0), vec3(0.0), 0.0);
    vec2 at = vec2(1.0, 0.0);
    int i = 0;
    do {
        vec2 next =
            vec2(at.x * kRoundTurn.x - at.y * kRoundTurn.y, at.x * kRoundTurn.y + at.y * kRoundTurn.x);
        addEdge(s, r.middle + at.x * r.u + at.y * r.v, r.middle + next.x * r.u + next.y * r.v, n);
        at = next;
    } while (++i < kRoundCorners);
    return closedSum(s, n);
}

// Of a sphere of radius^2 r2 about c, cut at the horizon: Snyder 1996, "Area Light Sources for Real-Time Graphics".
float sphereIrradiance(vec3 c, float r2, vec3 n) {
    float d2 = dot(c, c);
    float h2 = d2 / max(r2, 1e-20);
    float cosine = dot(c, n) * inversesqrt(max(d2, 1e-20));
    float k2 = 1.0 - h2 * cosine * cosine;  // above 0 where the horizon cuts it
    if (k2 <= 0.0) return kPi * max(cosine, 0.0) / h2;
    float far = sqrt(max(h2 - 1.0, 1e-12));
    float part =
        cosine * acos(clamp(-cosine * far * inversesqrt(max(1.0 - cosine * cosine, 1e-12)), -1.0, 1.0)) -
        sqrt(k2) * far;
    return max(part / h2 + atan(sqrt(k2) / far), 0.0);
}

float roundIrradiance(Light light, vec3 p, vec3 n) {
    vec3 c = light.position - p;
    float d2 = dot(c, c), extent2 = roundExtent2(light);
    if (!roundShines(light, c)) return 0.0;
    if (isSphere(light)) return sphereIrradiance(c, extent2, n);
    if (extent2 < kRoundNearby * d2)
        return rectArea(light) * max(dot(c, n), 0.0) * max(-dot(c, light.direction), 0.0) / (d2 * d2);
    return roundPolygon(diskOf(light, p), n);
}
#endif

// Irradiance at p with normal n per unit radiance; rectangles and disks have one shining side.
float rectIrradiance(Light light, vec3 p, vec3 n) {
#if LIGHTS_SHAPED
    if (isRound(light)) return roundIrradiance(light, p, n);
#endif
    vec3 corner[4];
    rectCorners(light, p, corner);
    return dot(p - light.position, light.direction) > 0.0 ? polygonIrradiance(corner, n) : 0.0;
}

// The linearly transformed cosine (Heitz et al. 2016) nearest to the GGX lobe times the cosine: a direction
// (x, y, z), z along the normal and x to the side of the mirrored view, becomes ((x - shift z) / width.x, y /
// width.y, z) (3.5), so that the horizon stays where it is. For small alpha the width is 2 alpha (1 / NoV^2,
// 1) and the shift the view's tangent, as reflection doubles the angle of the facet. The factors on these are
// polynomials fitted by tools/fit_rect_lobe.cpp, in s as in directionalAlbedo.
struct RectLobe {
    vec3 along;  // the side of the mirrored view, in the surface
    vec3 across;
    vec3 normal;
    vec2 width;
    float shift;
};

RectLobe rectLobe(vec3 n, vec3 toEye, float alpha, float NoV) {
    RectLobe lobe;
    lobe.normal = n;
    vec3 along = dot(n, toEye) * n - toEye;
    float alongLength = length(along);
    lobe.along = alongLength > 1e-4 ? along / alongLength : normalize(cross(n.yzx, n) + vec3(1e-6));
    lobe.across = cross(n, lobe.along);
    float r = sqrt(alpha);
    float s = NoV / (NoV + alpha);
    float wideX =
        (1.29227 + s * (-5.47364 + s * (14.8254 + s * (-13.2592 + s * (3.61848))))) +
        r * ((-5.52999 + s * (27.8312 + s * (-56.654 + s * (50.7816 + s * (-16.5467))))) +
             r * ((11.5977 + s * (-43.9361 + s * (52.2134 + s * (-11.7053 + s * (-7.00019))))) +
                  r * ((-9.48487 + s * (30.8728 + s * (-8.04704 + s * (-31.1243 + s * (12.3386))))) +
                       r * ((3.05076 + s * (-9.56177 + s * (2.7346 + s * (-4.20788 + s * (17.8255)))))))));
    float wideY =
        (-0.286434 + s * (4.24182 + s * (-7.01885 + s * (6.48932 + s * (-2.42788))))) +
        r * ((6.8825 + s * (-22.6236 + s * (26.5856 + s * (-11.6195 + s * (0.853501))))) +
             r * ((-11.9879 + s * (40.263 + s * (-37.5247 + s * (5.36034 + s * (2.98663))))) +
                  r * ((7.89362 + s * (-31.7826 + s * (28.3491 + s * (-6.39589 + s * (3.06636))))) +
                       r * ((-1.65108 + s * (8.11413 + s * (-4.08973 + s * (-6.18177 + s * (4.88188)))))))));
    float shift =
        (1.14059 + s * (-3.51801 + s * (11.3454 + s * (-12.1974 + s * (4.22556))))) +
        r * ((-3.87199 + s * (6.10689 + s * (-13.0306 + s * (32.6652 + s * (-21.743))))) +
             r * ((6.72048 + s * (9.90489 + s * (-20.6585 + s * (-53.1321 + s * (56.1935))))) +
                  r * ((-5.0604 + s * (-10.0926 + s * (-37.6492 + s * (219.072 + s * (-166.697))))) +
                       r * ((1.12677 + s * (-3.92632 + s * (69.7312 + s * (-208.799 + s * (145.081)))))))));
    wideX = max(wideX, 0.05) * s / NoV;
    lobe.width = 2.0 * alpha * vec2(wideX * wideX, max(wideY, 0.05));
    lobe.shift = max(shift, 0.0) * s / NoV * sqrt(max(1.0 - NoV * NoV, 0.0));
    return lobe;
}

// Into the space where the lobe is a cosine, but for the division by the width. z: along the normal.
vec3 rectLobeSpace(RectLobe lobe, vec3 v, float z) {
    return vec3(dot(v, lobe.along) - lobe.shift * z, dot(v, lobe.across), z);
}

// Density of the transformed cosine per steradian, times pi; `width2`: squares of the width.
float rectLobeDensity(vec3 inSpace, vec2 width2) {
    float q = dot(inSpace.xy * inSpace.xy, 1.0 / width2) + inSpace.z * inSpace.z;
    return max(inSpace.z, 0.0) * inversesqrt(width2.x * width2.y) / (q * q);
}

// The sum over sample points takes the error of the transformed cosine away where no cell holds more than
// the first of these shares of the lobe, and is left out from the second on, where the lobe falls between the
// points. From the errors in tests/shader/rect_light_test.cpp.
const vec2 kRectMended = vec2(0.1, 0.25);

// Sums over the rectangle's sample points.
struct RectSums {
    vec2 exact;    // of the lobe; x: without Fresnel's factor, y: its grazing part
    float cosine;  // of the transformed cosine
    float most;    // the largest term of that
};

#if LIGHTS_SHAPED
// Share of the transformed cosine that a round light covers.
float roundLobe(Light light, vec3 p, RectLobe lobe) {
    vec3 c = light.position - p;
    if (!roundShines(light, c)) return 0.0;
    float d2 = dot(c, c), narrow = min(min(lobe.width.x, lobe.width.y), 1.0);
    if (roundExtent2(light) < kRoundNearby * narrow * narrow * d2) {
        vec3 l = c * inversesqrt(d2);
        vec3 inSpace = rectLobeSpace(lobe, l, dot(l, lobe.normal));
        return rectLobeDensity(inSpace, lobe.width * lobe.width) * rectArea(light) * rectCosine(light, l) /
               (kPi * d2);
    }
    LightDisk r = diskOf(light, p);
    vec3 scale = 1.0 / vec3(lobe.width, 1.0);
    r.middle = scale * rectLobeSpace(lobe, r.middle, dot(r.middle, lobe.normal));
    r.u = scale * rectLobeSpace(lobe, r.u, dot(r.u, lobe.normal));
    r.v = scale * rectLobeSpace(lobe, r.v, dot(r.v, lobe.normal));
    return roundPolygon(r, vec3(0.0, 0.0, 1.0)) / kPi;
}
#endif

#if LIGHTS_SHAPED
// A sphere is one direction to rays where its radius over its distance, squared, is so small a part of the lobe's width,
// squared: tests/shader/rect_light_test.cpp holds the mean of what it reflects.
const float kSmallSphere = 0.1;

bool isSmallSphere(Light light, vec3 c, RectLobe lobe) {
    float narrow = min(min(lobe.width.x, lobe.width.y), 1.0);
    return isSphere(light) && roundExtent2(light) < kSmallSphere * narrow * narrow * dot(c, c);
}

float roundLobeQuick(Light light, vec3 p, RectLobe lobe) {
    vec3 c = light.position - p;
    if (!isSmallSphere(light, c, lobe)) return roundLobe(light, p, lobe);
    float d2 = dot(c, c);
    vec3 l = c * inversesqrt(d2);
    vec3 inSpace = rectLobeSpace(lobe, l, dot(l, lobe.normal));
    return rectLobeDensity(inSpace, lobe.width * lobe.width) * roundExtent2(light) / d2;
}
#endif

float rectLobeShare(Light light, vec3 p, RectLobe lobe) {
#if LIGHTS_SHAPED
    if (isRound(light)) return roundLobe(light, p, lobe);
#endif
    vec3 corner[4];
    rectCorners(light, p, corner);
    for (int i = 0; i < 4; ++i)
        corner[i] = rectLobeSpace(lobe, corner[i], dot(corner[i], lobe.normal)) / vec3(lobe.width, 1.0);
    return polygonIrradiance(corner, vec3(0.0, 0.0, 1.0)) / kPi;
}

// Unshadowed reflection towards the eye per unit radiance. The integral of the transformed cosine over the
// rectangle is that of a cosine over the transformed rectangle, closed; Fresnel's factor is the lobe's mean.
// The difference between the two sums is small and smooth, so that few points do, where the lobe alone would
// take hundreds.
vec3 rectSpecular(Light light, vec3 p, RectLobe lobe, Brdf b, RectSums sums) {
    float whole = rectLobeShare(light, p, lobe);
    vec3 missing = b.compensation * (b.f0 * (sums.exact.x - sums.exact.y) + b.f90 * sums.exact.y) -
                   b.albedo * sums.cosine;
    float mended = 1.0 - smoothstep(kRectMended.x, kRectMended.y, sums.most);
    return max(b.albedo * whole + mended * missing, vec3(0.0));
}

// Angle over sine of an edge between unit vectors, by the cosine: a cubic fitted for [0, 1] (error 0.13 %),
// below by the other side's.
float edgeAngleOverSine(float cosine) {
    float y = abs(cosine);
    float g = 1.56895 + y * (-0.958997 + y * (0.564784 + y * -0.176038));
    return cosine < 0.0 ? kPi * inversesqrt(max(1.0 - y * y, 1e-6)) - g : g;
}

// The same for what a ray meets, at less cost: the transformed cosine alone, not cut at the
// horizon.
vec3 rectSpecularQuick(Light light, vec3 p, RectLobe lobe, Brdf b) {
#if LIGHTS_SHAPED
    if (isRound(light)) return b.albedo * roundLobeQuick(light, p, lobe);
#endif
    vec3 corner[4];
    rectCorners(light, p, corner);
    for (int i = 0; i < 4; ++i)
        corner[i] =
            normalize(rectLobeSpace(lobe, corner[i], dot(corner[i], lobe.normal)) / vec3(lobe.width, 1.0));
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 from = corner[i], to = corner[(i + 1) & 3];
        sum += edgeAngleOverSine(dot(from, to)) * (from.x * to.y - from.y * to.x);
    }
    // Seen from the shining side, which way the corners turn.
    float turn = dot(cross(light.halfU, light.halfV), light.direction);
    bool inFront = dot(p - light.position, light.direction) > 0.0;
    return inFront ? b.albedo * (max(turn > 0.0 ? -sum : sum, 0.0) / (2.0 * kPi)) : vec3(0.0);
}

// Widening of the lobe (width^2) per steradian of a cell, where it weighs what of a reflection is visible: by
// eye, so that highlights fade evenly behind an edge.
const float kRectCellWidening = 1.0;

// Sample point of an area light (lib/rect_points.glsl) for a ray that asks one of them whether the rectangle is
// seen in the lobe: number k with the probability of its share of the transformed cosine, xi in [0,1).
// All alike, a ray would ask points that the lobe does not reflect. In rectLobeSpace a point's share is
// height / distance^4, as the distance to the rectangle's plane is the same for all.
uint rectPointInLobe(Light light, vec3 p, RectLobe lobe, float xi) {
    vec3 c = light.position - p;
    uint count = light.sampleGrid * light.sampleGrid;
#if LIGHTS_SHAPED
    if (isSmallSphere(light, c, lobe)) return min(uint(xi * float(count)), count - 1u);
#endif
    float cell = rectArea(light) / float(count);
    vec2 width2 = lobe.width * lobe.width + kRectCellWidening * cell / max(dot(c, c), cell);
    vec3 scale = vec3(inversesqrt(width2), 1.0);
    vec3 middle = scale * rectLobeSpace(lobe, c, dot(c, lobe.normal));
#if !LIGHTS_SHAPED
    vec3 u = scale * rectLobeSpace(lobe, light.halfU, dot(light.halfU, lobe.normal));
    vec3 v = scale * rectLobeSpace(lobe, light.halfV, dot(light.halfV, lobe.normal));
#endif
    float sum = 0.0;
    uint chosen = 0u;
    for (uint k = 0u; k < count; ++k) {
#if LIGHTS_SHAPED
        vec3 beside = rectPointOffset(light, k);
        vec3 q = middle + scale * rectLobeSpace(lobe, beside, dot(beside, lobe.normal));
#else
        vec2 at = rectPointPlace(k, light.sampleGrid);
        vec3 q = middle + at.x * u + at.y * v;
#endif
        float q2 = max(dot(q, q), 1e-12);
        float share = max(q.z, 0.0) / (q2 * q2);
        sum += share;
        // One number decides between the points so far and this one, and is spread over [0,1) again.
        float before = 1.0 - share / max(sum, 1e-30);
        bool taken = share > 0.0 && xi >= before;
        xi = taken ? (xi - before) / max(1.0 - before, 1e-6) : xi / max(before, 1e-6);
        chosen = taken ? k : chosen;
    }
    return chosen;
}
