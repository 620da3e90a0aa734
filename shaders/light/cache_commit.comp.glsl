#version 450 core
// SPDX-License-Identifier: MIT
// After an update: means into the lit faces, where rays read them, and into faceLight, where pixels do,
// shared there with neighbours as far as only noise parts them; and the flux of each face.
//
// AT_PIXELS 0: leaves faceLight alone, for a commit that is followed by another before pixels look.
// SHARED 0: faces keep their own, for limited bounces: each update has rays enough.
layout(local_size_x = 64) in;
#include "lib/dot.glsl"
#include "lib/light_cells.glsl"
#include "light/cache_common.glsl"
uniform usamplerBuffer stateTexels;
layout(std430) writeonly buffer LitFaceTable { uvec4 litTable[]; };
// The same once more: software drivers read storage lane by lane in loops.
uniform usamplerBuffer litFaces;
uniform usamplerBuffer voxelFaces;
uniform usamplerBuffer voxelRecords;
layout(rgba32ui) readonly uniform uimage3D voxelBrickImage;
layout(std430) writeonly buffer FaceLightTable { uvec2 faceLight[]; };
layout(std430) buffer CellMarkTable { uint cellMarks[]; };
layout(std430) writeonly buffer FluxTable { float fluxes[]; };

#if SHARED && !AT_PIXELS
#error only what pixels see is shared
#endif
#if AT_PIXELS
// The inside of a solid lies next to its outside. Of a cloth that is seen from its other side nothing else is
// there, so that a small weight does as well as a large one: this part of it.
const uint kReversePart = 64u;

// In 16 bits, as unpackWeight reads it from the upper half of a word.
uint weightAtPixels(uvec4 hitTexel, bool lit) {
    uint weight = hitTexel.y >> 16;
    if ((hitTexel.z & FACE_REVERSE) != 0u) weight = (weight + kReversePart - 1u) / kReversePart;
    return lit ? weight : 0u;
}
#endif
#if SHARED
#include "light/face_plane.glsl"

// What neighbour `side` of a face with the normal n adds to its mean, and its weight; or nothing. One that shows another's mean
// does not: its own voxel has that one.
vec4 neighbourIrradiance(int side, vec3 own, uint updates, uvec4 hitTexel, vec3 n) {
    int face = neighbourOnPlane(side, 1, hitTexel, n);
    FaceCache state = unpackState(texelFetch(stateTexels, max(face, 0)));
    bool counts = face >= 0 && (state.counts & CACHE_SHARES) == 0u &&
                  (state.counts & CACHE_UPDATES_MASK) != 0u && !isInterior(state);
    return counts ? vec4(state.irradiance, 1.0) * likeness(own, state.irradiance, updates) : vec4(0.0);
}

// The mean of a face and its neighbours on the same plane. Only pixels see it: rays go on reading each face's own, whose
// noise they average. Four calls in place of a loop take a tenth off the pass: loads side by side are cheap.
vec3 shownIrradiance(vec3 own, uvec4 hitTexel, uint updates) {
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    vec4 sum = vec4(own, 1.0);
    sum +=
        neighbourIrradiance(0, own, updates, hitTexel, n) + neighbourIrradiance(1, own, updates, hitTexel, n);
    sum +=
        neighbourIrradiance(2, own, updates, hitTexel, n) + neighbourIrradiance(3, own, updates, hitTexel, n);
    return sum.rgb / sum.a;
}
#endif

void mark(uint place, uvec3 bits) {
    if ((cellMarks[place] & bits.x) == 0u) atomicOr(cellMarks[place], bits.x);
    if ((cellMarks[place + 1u] & bits.y) == 0u) atomicOr(cellMarks[place + 1u], bits.y);
    if ((cellMarks[place + 2u] & bits.z) == 0u) atomicOr(cellMarks[place + 2u], bits.z);
}

// Marks the cell in which rays from the face will look for light samples, and if it is lit the cluster that it is of.
void markLight(uvec4 hitTexel, vec3 normal, bool lit) {
    vec3 onPlane = 0.5 + unpackOffset(hitTexel.y) * normal;
#if NESTED_GRIDS
    vec4 place = voxelPlace(hitTexel.w);
    vec3 middle = place.xyz + place.w * onPlane;
#else
    vec3 middle = vec3(unpackVoxel(hitTexel.w)) + onPlane;
#endif
    LightCell cell = cellAt(middle, normal, cellShift(cache.update, cache.seed));
    mark(3u * uint(cell.row), extentBits(cell, middle));
    LightCell cluster = clusterOfFace(hitTexel, normal);
    if (lit) mark(uint(LIGHT_CLUSTER_MARKS_AT + 3 * cluster.row), extentBits(cluster, middle));
}

void main() {
    uint face = linearIndex();
    if (face >= grid.faceCount) return;
    int owner = stateOwner(int(face), texelFetch(stateTexels, int(face)));
    FaceCache state = unpackState(texelFetch(stateTexels, owner));
    uvec4 hitTexel = texelFetch(voxelFaces, int(face));
    uvec4 lit = texelFetch(litFaces, int(face));
    uint updates = state.counts & CACHE_UPDATES_MASK;
    bool dead = isInterior(state);
    vec3 irradiance = dead ? vec3(0.0) : clamp(state.irradiance, 0.0, 65504.0);
    vec3 radiance = unpackRgb9e5(lit.y) + unpackAlbedo(lit.x) * irradiance;
    vec3 normal = octDecode(unpackSnorm2x16(hitTexel.x));
    float flux = dead ? 0.0 : faceFlux(hitTexel, radiance);
    fluxes[face] = sidedFlux(flux, faceDirection(hitTexel, normal));
    bool marks = ((face >> 3) + cache.update) % LIGHT_MARKED_PERIOD == 0u;
    if (!dead && marks) markLight(hitTexel, normal, flux > 0.0);
    lit.z = packHalf2x16(irradiance.rg);
    lit.w = packHalf2x16(vec2(irradiance.b, 0.0)) | (lit.w & (FACE_LOBE_BITS | FACE_AREA_LIGHT)) |
            (uint(findMSB(updates) + 1) << FACE_AGE_SHIFT) |
            (dead ? FACE_INTERIOR : (updates != 0u ? FACE_LIT : 0u));
    litTable[face].zw = lit.zw;
#if AT_PIXELS
#if SHARED
    vec3 shown = clamp(shownIrradiance(irradiance, hitTexel, updates), 0.0, 65504.0);
#else
    vec3 shown = irradiance;
#endif
    faceLight[face] =
        uvec2(packHalf2x16(shown.rg),
              packHalf2x16(vec2(shown.b, 0.0)) | weightAtPixels(hitTexel, !dead && updates != 0u) << 16);
#endif
}
