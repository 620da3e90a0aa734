// SPDX-License-Identifier: MIT
// Soft shadows by a cone from a surface to a light through the radiance volume (an occlusion cone):
// how much of the light's disc is seen. Needs lib/cone_trace.glsl's defines. The aperture is that of the
// light as it looks from the surface; CONE_SHADOWS in lib/lights.glsl asks for it.
#include "lib/cone_trace.glsl"
#include "lib/dot.glsl"

// Footprints stay below this part of what is left of the way: a sample reaches one and a half of its edge past
// its centre, and what the light hangs on is not in its way.
const float kShadowLampPart = 0.5;
// A cone ends so many voxels before the light: the voxels that the lamp is in are not in its way.
const float kShadowLampVoxels = 2.0;

float coneShadowTan() { return cones.shadowTan; }

// The volume's texture repeats its last texels beyond the border, which keeps rooms closed; towards a light
// there is nothing. Fades within half a texel on either side of the border, as between texels.
float insideVolume(vec3 p, float level) {
    vec3 q = (p - volume.origin) * volume.inverseExtent;
    vec3 inside = (0.5 - abs(q - 0.5)) * volume.extent * (volume.inverseVoxelSize * exp2(-level));
    vec3 fade = clamp(inside + 0.5, 0.0, 1.0);
    return fade.x * fade.y * fade.z;
}

float coneShadow(vec3 position, vec3 geometricNormal, vec3 toLight, float distance, float tanHalf) {
    vec3 origin = position + cones.offset * geometricNormal;
    float voxel = volume.voxelSize;
    float end = min(volumeExit(origin, toLight), distance - kShadowLampVoxels * voxel);
    float opacity = 0.0;
    float t = 0.0;
    uint samples = 0u;
    bool running = end > 0.0 && dot(geometricNormal, toLight) > 0.0;
    do {
        // Half the cone's width: the kernel of a texel of edge s and a disc of diameter 2 s have one variance.
        float edge = min(tanHalf * t, kShadowLampPart * (distance - t));
        float level = clamp(log2(edge * volume.inverseVoxelSize), 0.0, volume.maxLevel);
        float texel = voxel * exp2(level);
        float delta = min(cones.step * texel, max(end - t, 0.0));
        float middle = t + 0.5 * delta;
        if (running) {
            // Between levels: distances to a light differ from pixel to pixel, and so would the jumps.
            vec3 p = origin + middle * toLight;
            vec2 levels = vec2(floor(level), ceil(level));
            vec2 parts =
                delta / (voxel * exp2(levels)) * vec2(insideVolume(p, levels.x), insideVolume(p, levels.y));
            float added = mix(sampleStretch(p, toLight, levels.x, parts.x).a,
                              sampleStretch(p, toLight, levels.y, parts.y).a, fract(level));
#if AREA
            opacity = min(opacity + added, 1.0);
#else
            opacity += (1.0 - opacity) * added;
#endif
        }
        t += delta;
        running = running && t < end && opacity < kFullOpacity && ++samples < kMaxSamples;
    } while (running);
    return opacity < kFullOpacity ? 1.0 - opacity : 0.0;
}
