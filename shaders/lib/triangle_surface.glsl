// SPDX-License-Identifier: MIT
// What a ray shows of a triangle that it met (TRIANGLE_HITS 1; else nothing): colour, emission and lobe of
// the material there, light that falls on the point, and the voxels' irradiance interpolated. Part of
// lib/voxel_light.glsl.
#if TRIANGLE_HITS
// Lobes wider than this (GGX's alpha; roughness 0.3) show nothing so small: their rays meet plane pieces.
const float kTriangleAlpha = 0.09;
// With more rectangles their light is the face's.
const uint kTriangleMostRects = 4u;

struct TriangleSurface {
    vec3 geometricNormal;  // unit, against the ray
    vec2 lobe;             // metalness, roughness
};
TriangleSurface metTriangle;  // of the last triangleRadiance

// Radiance at the point, matt, as hitRadiance; `s` becomes that of the point but for its radiance.
vec3 triangleRadiance(VoxelHit hit, vec3 origin, vec3 direction, inout FaceShade s, out vec3 bent) {
    TriangleCorners c = triangleCorners(hit.triangle);
    vec3 twice = cross(c.edge1, c.edge2);
    float twiceArea = length(twice);
    vec3 n = twice / twiceArea;
    n = dot(n, direction) > 0.0 ? -n : n;
    vec3 at = vec3(1.0 - hit.at.x - hit.at.y, hit.at);
    uvec3 v = triangleVertices(hit.triangle, c.instance);
    vec3 object = at.x * octDecode(unpackSnorm2x16(vertices[v.x].normalOct)) +
                  at.y * octDecode(unpackSnorm2x16(vertices[v.y].normalOct)) +
                  at.z * octDecode(unpackSnorm2x16(vertices[v.z].normalOct));
    bent = normalize(instances[c.instance].normalColumn0.xyz * object.x +
                     instances[c.instance].normalColumn1.xyz * object.y +
                     instances[c.instance].normalColumn2.xyz * object.z);
    bent = dot(bent, n) < 0.0 ? -bent : bent;

    // The material, textures averaged over what the ray stands for.
    uint material = instances[c.instance].material;
    uint wide = instances[c.instance].flags;
    ivec4 layers = materials[material].layers;
    vec2 uv = triangleUv(v, at);
    vec2 du = triangleUv(v, vec3(-1.0, 1.0, 0.0));
    vec2 dv = triangleUv(v, vec3(-1.0, 0.0, 1.0));
    float footprint =
        sqrt(abs(du.x * dv.y - du.y * dv.x) / twiceArea) * (rayCone.width + hit.t * rayCone.growth);
    vec3 color = at.x * vertexColor(vertices[v.x].color, wide).rgb +
                 at.y * vertexColor(vertices[v.y].color, wide).rgb +
                 at.z * vertexColor(vertices[v.z].color, wide).rgb;
    color *= materials[material].baseColor.rgb * triangleTexel(material, layers.x, 0, uv, footprint).rgb;
    vec3 emission = materials[material].emission * triangleTexel(material, layers.w, 3, uv, footprint).rgb;
    uvec4 kept = texelFetch(voxelFaces, 2 * hit.face + 1);
    emission = (kept.w & FACE_AREA_LIGHT) != 0u ? vec3(0.0) : emission;
    // Textures of metalness and roughness: as the voxel has them.
    vec2 lobe = layers.y >= 0 ? unpackLobe(kept.w >> 16)
                              : vec2(materials[material].metallic, materials[material].roughness);
    bool unlit = (materials[material].flags & MATERIAL_UNLIT) != 0u;
    vec3 faceAlbedo = s.albedo;
    s.albedo = unlit ? vec3(0.0) : evenAlbedo(color, lobe.x, lobe.y, materials[material].specularF0);
    emission = unlit ? vec3(0.0) : emission;
    metTriangle = TriangleSurface(n, unlit ? vec2(0.0) : lobe);

    // The light there. Of a rectangle one point is asked: rays are many.
    vec3 point = origin + hit.t * direction;
    vec4 around = cachedIrradiance(point, n, true);
    s.irradiance = around.a > 0.0 ? around.rgb : s.irradiance;
    vec3 position = worldFromGrid(point);
    vec3 steady = unpackRgb9e5(texelFetch(steadyLight, hit.face).x);
    vec3 reflected = vec3(0.0);  // by the face
    vec3 direct = vec3(0.0);
#if EXACT_DIRECT
    direct = directIrradiance(position, bent, n, 0.0);
#else
    reflected += max(s.radiance - steady, vec3(0.0));
#endif
    bool few = lighting.lightEnds.w - lighting.lightEnds.z <= kTriangleMostRects;
    uint i = few ? lighting.lightEnds.z : lighting.lightEnds.w;
    uint random = randomHash(floatBitsToUint(hit.t)) ^ floatBitsToUint(hit.at.x);
    while (i < lighting.lightEnds.w) {
        Light light = lights[i];
        uint count = light.sampleGrid * light.sampleGrid;
        uint k = min(uint(randomNext(random) * float(count)), count - 1u);
        direct += light.intensity * rectIrradiance(light, position, bent) *
                  shadowVisibilityRect(light, k, rectSamplePoint(light, k), position, n);
        ++i;
    }
    vec3 emitted = (kept.w & FACE_AREA_LIGHT) != 0u
                       ? vec3(0.0)
                       : unpackEmission(texelFetch(voxelFaceSources, hit.face).xy);
    reflected += few ? vec3(0.0) : max(steady - emitted, vec3(0.0));
    return emission +
           s.albedo * (direct * (1.0 / kGatherPi) + s.irradiance + reflected / max(faceAlbedo, 1e-3));
}
#endif
