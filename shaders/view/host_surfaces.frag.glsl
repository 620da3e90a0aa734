#version 450 core
// SPDX-License-Identifier: MIT
// A host's picture (HostSurfaces of conelight/light_field.h) -> the G-buffer's words (lib/gbuffer_pack.glsl), for
// one of reduction x reduction texels. Albedo is white: what is gathered does not know it.
//   FACE_NORMALS  1: normals of triangles are given; 0: they are those of the plane through neighbouring texels
//   ROUGHNESS     0: all is rough
//   REFLECTANCE   0: 0.04
//   INSTANCES     0: all is instance 0
#if !defined(FACE_NORMALS) || !defined(ROUGHNESS) || !defined(REFLECTANCE) || !defined(INSTANCES)
#error FACE_NORMALS, ROUGHNESS, REFLECTANCE and INSTANCES must be 0 or 1
#endif
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/gbuffer_pack.glsl"
#include "lib/octahedral.glsl"
#include "shared/gbuffer.h"
#include "shared/host_surfaces.h"
layout(std140) uniform HostSurfaceBlock { HostSurfaceConstants host; };
uniform sampler2D hostDepth;
uniform sampler2D hostNormal;
uniform sampler2D hostFaceNormal;
uniform sampler2D hostRoughness;
uniform sampler2D hostReflectance;
uniform usampler2D hostInstances;
layout(location = 0) out uvec4 outGeometry;
layout(location = 1) out uvec4 outMaterial;

// View depth at a texel, 0 where nothing was drawn or outside; where its ray begins, and the way per unit of depth.
float depthAt(ivec2 texel, out vec3 origin, out vec3 ray) {
    vec2 pixel = vec2(texel) / float(host.reduction);
    vec2 clip = (pixel + 0.5) / vec2(frame.width, frame.height) * 2.0 - 1.0;
    bool parallel = frame.parallel != 0.0;
    vec3 across = clip.x * frame.viewRight + clip.y * frame.viewUp;
    ray = frame.viewForward + (parallel ? vec3(0.0) : across);
    origin = frame.eye + (parallel ? across : vec3(0.0));
    ivec2 size = textureSize(hostDepth, 0);
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size));
    float d = texelFetch(hostDepth, clamp(texel, ivec2(0), size - 1), 0).x;
    float along = host.depthScale * d + host.depthOffset;
    float depth = parallel ? along : host.depthOfEye / (along - dot(host.depthRow, ray));
    return inside && d != host.background && depth > 0.0 && depth < 1e18 ? depth : 0.0;
}

vec3 decodedNormal(vec4 texel) {
    bool unsigned01 = host.encoding == HOST_NORMAL_WORLD_UNORM || host.encoding == HOST_NORMAL_VIEW_UNORM;
    bool ofView = host.encoding == HOST_NORMAL_VIEW || host.encoding == HOST_NORMAL_VIEW_UNORM;
    vec3 n = unsigned01 ? texel.xyz * 2.0 - 1.0 : texel.xyz;
    if (host.encoding == HOST_NORMAL_OCTAHEDRAL) n = octDecode(texel.xy);
    if (ofView) n = mat3(host.worldFromView) * n;
    float size = length(n);
    return size > 1e-6 ? n / size : vec3(0.0);
}

#if !FACE_NORMALS
// From here to the nearer of two neighbours: across an edge lies the farther one.
vec3 alongSurface(ivec2 texel, ivec2 toNext, float depth, vec3 here) {
    vec3 originBefore, rayBefore, originAfter, rayAfter;
    float before = depthAt(texel - toNext, originBefore, rayBefore);
    float after = depthAt(texel + toNext, originAfter, rayAfter);
    bool forward = before == 0.0 || (after != 0.0 && abs(after - depth) < abs(before - depth));
    if (before == 0.0 && after == 0.0) return vec3(0.0);
    return forward ? originAfter + after * rayAfter - here : here - originBefore - before * rayBefore;
}
#endif

vec3 faceNormal(ivec2 texel, float depth, vec3 here, vec3 ray, vec3 shading) {
#if FACE_NORMALS
    vec3 n = decodedNormal(texelFetch(hostFaceNormal, texel, 0));
#else
    vec3 n =
        cross(alongSurface(texel, ivec2(1, 0), depth, here), alongSurface(texel, ivec2(0, 1), depth, here));
    float size = length(n);
    n = size > 0.0 ? n / size : vec3(0.0);
#endif
    if (n == vec3(0.0)) n = shading;
    return dot(n, ray) > 0.0 ? -n : n;
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) * int(host.reduction);
    vec3 origin, ray;
    float depth = depthAt(texel, origin, ray);
    vec3 shading = decodedNormal(texelFetch(hostNormal, texel, 0));
    vec3 face = faceNormal(texel, depth, origin + depth * ray, ray, shading);
    // Slivers may have no normal of their own.
    if (shading == vec3(0.0)) shading = face;
    if (depth == 0.0 || face == vec3(0.0)) {
        outGeometry = outMaterial = uvec4(0);
        gl_FragDepth = 1.0;
        return;
    }
    if (dot(shading, face) < 0.0) shading = -shading;
    float roughness = 1.0;
    vec3 reflectance = vec3(0.04);
    uint instance = 0u;
#if ROUGHNESS
    roughness = clamp(texelFetch(hostRoughness, texel, 0)[host.roughnessChannel], 0.0, 1.0);
#endif
#if REFLECTANCE
    reflectance = clamp(texelFetch(hostReflectance, texel, 0).rgb, 0.0, 1.0);
#endif
#if INSTANCES
    instance = min(texelFetch(hostInstances, texel, 0).x, max(host.instances, 1u) - 1u);
#endif
    outGeometry = uvec4(floatBitsToUint(depth), packSnorm2x16(octEncode(shading)),
                        packSnorm2x16(octEncode(face)), packInstanceWord(instance, false));
    outMaterial = uvec4(packUnorm2x16(vec2(1.0)), packUnorm2x16(vec2(1.0, roughness)),
                        packReflectance(reflectance, 0.0), 0u);
    gl_FragDepth = 0.0;
}
