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

// The point of a triangle that a ray met.
struct TrianglePoint {
    uint instance;
    uvec3 vertices;
    vec3 at;      // barycentric coordinates
    vec3 normal;  // unit, against the ray
    vec3 bent;    // that of the vertices, on the same side
    float twiceArea;
};

TrianglePoint trianglePoint(VoxelHit hit, vec3 direction) {
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
    vec3 bent = normalize(instances[c.instance].normalColumn0.xyz * object.x +
                          instances[c.instance].normalColumn1.xyz * object.y +
                          instances[c.instance].normalColumn2.xyz * object.z);
    bent = dot(bent, n) < 0.0 ? -bent : bent;
    return TrianglePoint(c.instance, v, at, n, bent, twiceArea);
}

// The material there, textures averaged over what the ray stands for.
struct TriangleMaterial {
    vec3 albedo;
    vec3 emission;
    vec2 lobe;  // metalness, roughness
};

TriangleMaterial triangleMaterial(TrianglePoint p, VoxelHit hit) {
    uvec3 v = p.vertices;
    vec3 at = p.at;
    uint material = instances[p.instance].material;
    uint wide = instances[p.instance].flags;
    ivec4 layers = materials[material].layers;
    vec2 uv = triangleUv(v, at);
    vec2 du = triangleUv(v, vec3(-1.0, 1.0, 0.0));
    vec2 dv = triangleUv(v, vec3(-1.0, 0.0, 1.0));
    float footprint =
        sqrt(abs(du.x * dv.y - du.y * dv.x) / p.twiceArea) * (rayCone.width + hit.t * rayCone.growth);
    vec3 color = at.x * vertexColor(vertices[v.x].color, wide).rgb +
                 at.y * vertexColor(vertices[v.y].color, wide).rgb +
                 at.z * vertexColor(vertices[v.z].color, wide).rgb;
    color *= materials[material].baseColor.rgb * triangleTexel(material, layers.x, 0, uv, footprint).rgb;
    vec3 emission = materials[material].emission * triangleTexel(material, layers.w, 3, uv, footprint).rgb;
    uint shadeBits = texelFetch(voxelFaces, 2 * hit.face + 1).w;
    emission = (shadeBits & FACE_AREA_LIGHT) != 0u ? vec3(0.0) : emission;
    // Textures of metalness and roughness: as the voxel has them.
    vec2 lobe = layers.y >= 0 ? unpackLobe(shadeBits >> 16)
                              : vec2(materials[material].metallic, materials[material].roughness);
    vec3 albedo = evenAlbedo(color, lobe.x, lobe.y, materials[material].specularF0);
    bool unlit = (materials[material].flags & MATERIAL_UNLIT) != 0u;
    if (unlit) return TriangleMaterial(vec3(0.0), vec3(0.0), vec2(0.0));
    return TriangleMaterial(albedo, emission, lobe);
}

bool fewRects() { return lighting.lightEnds.w - lighting.lightEnds.z <= kTriangleMostRects; }

// Adds the irradiance at the point by the rectangles. Of each one point is asked: rays are many.
void addTriangleRects(inout vec3 direct, TrianglePoint p, vec3 position, VoxelHit hit) {
    uint i = fewRects() ? lighting.lightEnds.z : lighting.lightEnds.w;
    uint random = randomHash(floatBitsToUint(hit.t)) ^ floatBitsToUint(hit.at.x);
    while (i < lighting.lightEnds.w) {
        Light light = lights[i];
        uint count = light.sampleGrid * light.sampleGrid;
        uint k = min(uint(randomNext(random) * float(count)), count - 1u);
        direct += light.intensity * rectIrradiance(light, position, p.bent) *
                  shadowVisibilityRect(light, k, rectSamplePoint(light, k), position, p.normal);
        ++i;
    }
}

// Direct light that the face reflects, of lights that are not asked at the point. `radiance`: the face's.
vec3 faceReflected(int face, vec3 radiance) {
    vec3 steady = unpackRgb9e5(texelFetch(steadyLight, face).x);
    vec3 reflected = vec3(0.0);
#if !EXACT_DIRECT
    reflected += max(radiance - steady, vec3(0.0));
#endif
    bool areaLight = (texelFetch(voxelFaces, 2 * face + 1).w & FACE_AREA_LIGHT) != 0u;
    vec3 emitted = areaLight ? vec3(0.0) : unpackEmission(texelFetch(voxelFaceSources, face).xy);
    reflected += fewRects() ? vec3(0.0) : max(steady - emitted, vec3(0.0));
    return reflected;
}

// Radiance at the point, matt, as hitRadiance; `s` becomes that of the point but for its radiance.
vec3 triangleRadiance(VoxelHit hit, vec3 origin, vec3 direction, inout FaceShade s, out vec3 bent) {
    TrianglePoint p = trianglePoint(hit, direction);
    TriangleMaterial m = triangleMaterial(p, hit);
    metTriangle = TriangleSurface(p.normal, m.lobe);
    bent = p.bent;
    vec3 faceAlbedo = s.albedo;
    s.albedo = m.albedo;

    // Gather the light there.
    vec3 point = origin + hit.t * direction;
    vec4 around = cachedIrradiance(point, p.normal, true);
    s.irradiance = around.a > 0.0 ? around.rgb : s.irradiance;
    vec3 position = worldFromGrid(point);
    vec3 direct = vec3(0.0);
#if EXACT_DIRECT
    direct = directIrradiance(position, bent, p.normal, 0.0);
#endif
    addTriangleRects(direct, p, position, hit);
    vec3 reflected = faceReflected(hit.face, s.radiance);
    return m.emission +
           s.albedo * (direct * (1.0 / kGatherPi) + s.irradiance + reflected / max(faceAlbedo, 1e-3));
}
#endif
