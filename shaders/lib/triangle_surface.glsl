// SPDX-License-Identifier: MIT
// Outgoing radiance of a triangle that a ray hit (TRIANGLE_HITS 1; otherwise the file is empty): Ray,
// VoxelHit -> albedo, emission and lobe of the material there, direct light at the point, and the
// interpolated cache. Part of lib/voxel_light.glsl.
#include "lib/dot.glsl"
#if TRIANGLE_HITS
// Rays in lobes wider than this (GGX alpha; roughness 0.3) hit plane pieces: triangles would not be resolved.
const float kTriangleAlpha = 0.09;
// With more rectangular lights than this their irradiance is the face's.
const uint kTriangleMostRects = 4u;

struct TriangleSurface {
    vec3 geometricNormal;  // unit, against the ray
    vec2 lobe;             // metalness, roughness
    vec3 lampEmission;     // of a rectangular light that the triangle is part of
};
TriangleSurface hitTriangle;  // of the last triangleRadiance

// Whether light at a triangle is that of a pixel: of every sample point of a rectangle, not of one that is drawn, and
// of caustics as fine as their map. Where rays are few.
bool allRectPoints = false;

// The point where a ray hit a triangle.
struct TrianglePoint {
    uint instance;
    uvec3 vertices;
    vec3 barycentric;
    vec3 geometricNormal;  // unit, against the ray
    vec3 shadingNormal;    // interpolated between the vertices, on the same side
    float twiceArea;
    float curvature;  // of the vertices' normals, rad per voxel
};

TrianglePoint trianglePoint(Ray ray, VoxelHit hit) {
    // Compute the geometric normal
    TriangleCorners c = triangleCorners(hit.triangle);
    vec3 twice = cross(c.edge1, c.edge2);
    float twiceArea = length(twice);
    vec3 normal = twice / twiceArea;
    normal = dot(normal, ray.direction) > 0.0 ? -normal : normal;

    // Interpolate the shading normal
    vec3 at = vec3(1.0 - hit.barycentric.x - hit.barycentric.y, hit.barycentric);
    uvec3 v = triangleVertices(hit.triangle, c.instance);
    mat3 own = mat3(octDecode(unpackSnorm2x16(vertices[v.x].normalOct)),
                    octDecode(unpackSnorm2x16(vertices[v.y].normalOct)),
                    octDecode(unpackSnorm2x16(vertices[v.z].normalOct)));
    vec3 object = own * at;
    vec3 shadingNormal = normalize(instances[c.instance].normalColumn0.xyz * object.x +
                                   instances[c.instance].normalColumn1.xyz * object.y +
                                   instances[c.instance].normalColumn2.xyz * object.z);
    shadingNormal = dot(shadingNormal, normal) < 0.0 ? -shadingNormal : shadingNormal;

    // Compute how fast it turns
    vec3 turn1 = own[1] - own[0], turn2 = own[2] - own[0];
    float turned = dot(turn1, turn1) + dot(turn2, turn2);
    float apart = dot(c.edge1, c.edge1) + dot(c.edge2, c.edge2);
    float curvature = sqrt(turned / max(apart, 1e-20));
    return TrianglePoint(c.instance, v, at, normal, shadingNormal, twiceArea, curvature);
}

// The material there; textures are filtered over the footprint of the ray.
struct TriangleMaterial {
    vec3 albedo;
    vec3 emission;
    vec3 lampEmission;  // where a rectangular light stands for it
    vec2 lobe;          // metalness, roughness
};

TriangleMaterial triangleMaterial(TrianglePoint p, VoxelHit hit) {
    // Compute the footprint of the ray in texture coordinates
    uvec3 v = p.vertices;
    vec3 at = p.barycentric;
    vec2 uv = triangleUv(v, at);
    vec2 du = triangleUv(v, vec3(-1.0, 1.0, 0.0));
    vec2 dv = triangleUv(v, vec3(-1.0, 0.0, 1.0));
    float footprint =
        sqrt(abs(du.x * dv.y - du.y * dv.x) / p.twiceArea) * (rayCone.width + hit.t * rayCone.growth);

    // Look up the base color
    uint material = instances[p.instance].material;
    uint wide = instances[p.instance].flags;
    ivec4 layers = materials[material].layers;
    vec3 color = at.x * vertexColor(vertices[v.x].color, wide).rgb +
                 at.y * vertexColor(vertices[v.y].color, wide).rgb +
                 at.z * vertexColor(vertices[v.z].color, wide).rgb;
    color *= materials[material].baseColor.rgb * triangleTexel(material, layers.x, 0, uv, footprint).rgb;

    // Look up the emission
    vec3 emission = materials[material].emission * triangleTexel(material, layers.w, 3, uv, footprint).rgb;
    uint faceBits = texelFetch(litFaces, hit.face).w;
    bool lamp = (faceBits & FACE_AREA_LIGHT) != 0u;

    // Look up the lobe; textured metalness and roughness are the voxel's
    vec2 lobe =
        layers.y >= 0 ? litLobe(faceBits) : vec2(materials[material].metallic, materials[material].roughness);
    vec3 albedo = evenAlbedo(color, lobe.x, lobe.y, materials[material].specularF0);
    albedo = layeredAlbedo(albedo, materials[material].evenLayers);
    lobe = toldLobe(color, lobe.x, lobe.y, materials[material].specularF0);
    bool unlit = (materials[material].flags & MATERIAL_UNLIT) != 0u;
    if (unlit) return TriangleMaterial(vec3(0.0), vec3(0.0), vec3(0.0), vec2(0.0));
    return TriangleMaterial(albedo, lamp ? vec3(0.0) : emission, lamp ? emission : vec3(0.0), lobe);
}

bool fewRects() { return lighting.lightEnds.w - lighting.lightEnds.z <= kTriangleMostRects; }

// Irradiance at a point by a rectangle, of which points begin..end are looked at.
vec3 triangleRect(TrianglePoint p, vec3 position, Light light, uint begin, uint end) {
    float whole = rectIrradiance(light, position, p.shadingNormal);
    float cellArea = rectArea(light) / float(light.sampleGrid * light.sampleGrid);
    vec2 weights = vec2(0.0);  // of all points, of those that are seen
#if GLASS
    RectTint tint = rectTint(position, light);
#endif
    uint k = begin;
    do {
        vec3 point = rectSamplePoint(light, k);
        vec3 l = point - position;
        float d2 = max(dot(l, l), 1e-20);
        l *= inversesqrt(d2);
        float cosines = rectCosine(light, l) * max(dot(l, p.shadingNormal), 0.0);
        float weight = begin + 1u < end ? cosines / max(d2, cellArea) : 1.0;
        float seen = weight * shadowVisibilityRect(light, k, point, position, p.geometricNormal);
        weights += vec2(weight, seen);
#if GLASS
        addTint(tint, position, light, k, vec2(seen, 0.0));
#endif
    } while (++k < end);
    vec3 irradiance = light.intensity * (whole * (weights.x > 0.0 ? weights.y / weights.x : 1.0));
#if GLASS
    irradiance *= tintOf(tint.irradiance, tint.weights.x);
#endif
    return irradiance;
}

// Irradiance at the point by the rectangular lights, added to `irradiance`.
void addTriangleRects(TrianglePoint p, vec3 position, VoxelHit hit, inout vec3 irradiance) {
    uint i = fewRects() ? lighting.lightEnds.z : lighting.lightEnds.w;
    uint random = randomHash(floatBitsToUint(hit.t)) ^ floatBitsToUint(hit.barycentric.x);
    while (i < lighting.lightEnds.w) {
        Light light = lightOfTable(i);
        uint count = light.sampleGrid * light.sampleGrid;
        uint k = min(uint(randomNext(random) * float(count)), count - 1u);
        irradiance +=
            triangleRect(p, position, light, allRectPoints ? 0u : k, allRectPoints ? count : k + 1u);
        ++i;
    }
}

// Reflected direct light of the face, by those lights that are not evaluated at the point.
vec3 faceReflected(int face, vec3 directRadiance) {
    vec3 steady = unpackRgb9e5(texelFetch(cachedDirect, face).x);
    vec3 reflected = vec3(0.0);
#if !EXACT_DIRECT
    reflected += max(directRadiance - steady, vec3(0.0));
#endif
    bool areaLight = (texelFetch(litFaces, face).w & FACE_AREA_LIGHT) != 0u;
    vec3 emitted = areaLight ? vec3(0.0) : unpackEmission(texelFetch(voxelFaceMaterials, face));
    reflected += fewRects() ? vec3(0.0) : max(steady - emitted, vec3(0.0));
    return reflected;
}

// Outgoing radiance at the point as if it were diffuse, as hitRadiance. `s` becomes the shading of the point,
// but for its directRadiance.
vec3 triangleRadiance(Ray ray, VoxelHit hit, inout Footprint footprint, inout FaceShading s,
                      out vec3 shadingNormal) {
    // Look up the material
    TrianglePoint p = trianglePoint(ray, hit);
    TriangleMaterial m = triangleMaterial(p, hit);
    hitTriangle = TriangleSurface(p.geometricNormal, m.lobe, m.lampEmission);
    shadingNormal = p.shadingNormal;
    meetSurface(footprint, ray, hit.t, p.geometricNormal, p.curvature);
    vec3 faceAlbedo = s.albedo;
    s.albedo = m.albedo;

    // Interpolate the cache
    vec3 point = ray.origin + hit.t * ray.direction;
    vec4 cached = cachedIrradiance(point, p.geometricNormal, true);
    s.irradiance = cached.a > 0.0 ? cached.rgb : s.irradiance;

    // Evaluate the lights at the point
    vec3 position = worldFromGrid(point);
    vec3 direct = vec3(0.0);
    vec3 irradiance = vec3(0.0);
#if EXACT_DIRECT
    direct =
        reflectedPunctual(s.albedo, m.lobe, footprint.alpha2,
                          Receiver(position, shadingNormal, p.geometricNormal, -ray.direction, vec2(0.0)));
#endif
    addTriangleRects(p, position, hit, irradiance);
#if GLASS
    // With many rectangles it is part of the face's light. Sharp rays see it as pixels do.
    float width = allRectPoints ? 0.0 : (rayCone.width + hit.t * rayCone.growth) * grid.voxelSize;
    if (fewRects()) irradiance += causticIrradiance(position, p.geometricNormal, width);
#endif
    vec3 reflected = faceReflected(hit.face, s.directRadiance);
    return m.emission + direct +
           s.albedo * (irradiance * (1.0 / kGatherPi) + s.irradiance + reflected / max(faceAlbedo, 1e-3));
}
#endif
