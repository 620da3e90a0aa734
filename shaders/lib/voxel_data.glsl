// SPDX-License-Identifier: MIT
// What a face or a voxel of the surface voxels shows in the views of voxels (conelight::VoxelData). After
// lib/ray_query.glsl.
#include "lib/dot.glsl"
#include "lib/false_color.glsl"
#include "lib/lit_face.glsl"
#include "shared/irradiance.h"
#include "shared/voxel_view.h"
uniform usamplerBuffer voxelFaceMaterials;

vec3 faceData(int face, uint data) {
    uvec4 a = texelFetch(voxelFaces, face);
    uvec4 b = texelFetch(litFaces, face);
    uint updates = faceUpdates(b.w);
    switch (data) {
        case VIEW_IRRADIANCE:
            return litIrradiance(b);
        case VIEW_AGE:
            return updates == FACE_UPDATES_INTERIOR ? vec3(1.0, 0.0, 1.0)
                                                    : falseColor(log2(1.0 + float(updates)) / 8.0);
        case VIEW_ALBEDO:
            return unpackAlbedo(b.x);
        case VIEW_NORMAL:
            return 0.5 + 0.5 * octDecode(unpackSnorm2x16(a.x));
        case VIEW_EMISSION:
            return unpackEmission(texelFetch(voxelFaceMaterials, face));
        case VIEW_COVERAGE:
            return vec3(min(unpackWeight(a.y), 1.0));
        case VIEW_BRICKS: {
            uvec4 word = texelFetch(voxelBricks, unpackVoxel(a.w) >> 2, 0);
            return falseColor(float(bitCount(word.x) + bitCount(word.y)) / 64.0);
        }
        default: {
            // Emitters that are lights as well are dark to rays, which count them as lights; they glow all
            // the same.
            vec3 glow = (b.w & FACE_AREA_LIGHT) != 0u ? unpackEmission(texelFetch(voxelFaceMaterials, face))
                                                      : vec3(0.0);
            return unpackRgb9e5(b.y) + glow + unpackAlbedo(b.x) * litIrradiance(b);
        }
    }
}

// Premultiplied mean over the faces of a voxel, and what it hides: the area of a plane piece with coverages W
// along the axes is |W|. Faces count by coverage and by how much they look against `ray`; the others only
// where none does. A zero ray: all alike. `record`: of the voxel (voxRec).
vec4 voxelMean(uint record, vec3 ray, uint data) {
    uint directions = faceDirections(record);
    int face = int(faceBase(record));
    vec4 sum = vec4(0.0);
    vec3 axes = vec3(0.0);
    bool any = dot(ray, ray) > 0.0;
    do {
        int k = findLSB(directions);
        directions &= directions - 1u;
        vec3 along = directionVector(k);
        float coverage = unpackWeight(texelFetch(voxelFaces, face).y);
        float weight = coverage * (any ? max(-dot(along, ray), 1e-4) : 1.0);
        sum += weight * vec4(faceData(face, data), 1.0);
        axes = max(axes, abs(along) * coverage);
        ++face;
    } while (directions != 0u);
    float opacity = min(length(axes), 1.0);
    return vec4(sum.rgb / max(sum.a, 1e-12) * opacity, opacity);
}
