#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer + shadow maps -> which lights without extent each pixel sees: bit n is 1 where light n of the table is seen.
// Pixels of which the texels about a point disagree go into a list: a ray will tell (docs/theory/3_light.md, "Edges by
// rays"). COUNT_LOOKUPS 1: adds the lookups, as those of occlusion.
#define SHADOW_DIVIDED 1
layout(local_size_x = 8, local_size_y = 8) in;
#define VISIBILITY_LIST_ACCESS
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/lights.glsl"
#include "lib/visibility_list.glsl"
#include "lib/voxel_grid.glsl"
layout(r32ui) writeonly uniform uimage2D result;

// What shadow maps say of the lights.
struct MapAnswers {
    uint seen;  // bit n: more than half
    uint open;  // bit n: a ray has to tell
};

void addAnswer(inout MapAnswers answers, uint number, float visible, bool lit, Light light) {
    uint bit = number < kVisibilityLights ? 1u << number : 0u;
    answers.seen |= visible > 0.5 ? bit : 0u;
    answers.open |= lit && shadowDivided && light.shadow >= 0 ? bit : 0u;
}

// Whether a light without direction shines on a surface, but for what hides it.
bool shinesOn(Light light, Surface s) {
    vec3 toLight = light.position - s.position;
    float falloff = distanceFalloff(light, dot(toLight, toLight)) * spotFalloff(light, normalize(toLight));
    return dot(toLight, s.geometricNormal) > 0.0 && falloff > 0.0 && light.intensity != vec3(0.0);
}

void askPoint(inout MapAnswers answers, Surface s, Light light, uint number) {
    float visible = shadowVisibilityPoint(light, litPosition(s), s.geometricNormal, vec2(0.0));
    addAnswer(answers, number, visible, shinesOn(light, s), light);
}

void askSpot(inout MapAnswers answers, Surface s, Light light, uint number) {
    float visible = shadowVisibilitySpot(light, litPosition(s), s.geometricNormal, vec2(0.0));
    addAnswer(answers, number, visible, shinesOn(light, s), light);
}

void askDirectional(inout MapAnswers answers, Surface s, Light light, uint number) {
    float visible = directionalMapVisibility(light, number, litPosition(s), s.geometricNormal, vec2(0.0));
    bool shines = dot(light.direction, s.geometricNormal) < 0.0 && light.intensity != vec3(0.0);
#if SHADOW_CASCADES
    // A ray does not see what is nearer than where it starts; finer texels do.
    shines = shines && cascadeTexel > kStartVoxels * grid.voxelSize;
#endif
    addAnswer(answers, number, visible, shines, light);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s);
    MapAnswers answers = MapAnswers(0u, 0u);
#if LIGHTS_POINT
    FOR_POINT_LIGHTS(askPoint(answers, s, light, number))
#endif
#if LIGHTS_SPOT
    FOR_SPOT_LIGHTS(askSpot(answers, s, light, number))
#endif
#if LIGHTS_DIRECTIONAL
    FOR_DIRECTIONAL_LIGHTS(askDirectional(answers, s, light, number))
#endif

#if COUNT_LOOKUPS
    addLookups(LOOKUPS_OCCLUSION, seen);
#endif
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    imageStore(result, pixel, uvec4(answers.seen));
    if (seen && answers.open != 0u) {
        uint at = atomicAdd(visibilityList.count, 1u);
        visibilityList.pixels[at] = uvec2(uint(pixel.x) | uint(pixel.y) << 16, answers.open);
        atomicMax(visibilityList.groups.y, at / (VISIBILITY_GROUP * VISIBILITY_GROUPS_X) + 1u);
    }
}
