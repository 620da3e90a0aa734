// SPDX-License-Identifier: MIT
// Several surfaces that face the same way within one voxel: what lies in front hides what it covers, nothing
// hides itself. Against values known from the geometry, and against the CPU reference.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <random>

#include "gl/pass.h"
#include "math/octahedral.h"
#include "scene/gpu_scene.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/reference_voxelizer.h"
#include "support/view_rig.h"
#include "voxels/ray_query.h"
#include "voxels/surface_voxels.h"
#include "voxels/voxel_record.h"

namespace conelight::test {
namespace {

using voxels::VoxelGrid;

const glm::vec3 kRed(0.8f, 0.1f, 0.05f);
const glm::vec3 kGreen(0.1f, 0.6f, 0.2f);
constexpr int kUp = 2, kDown = 3;  // directions +y, -y

Material painted(const glm::vec3& albedo, bool doubleSided = false) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1);
    material.specular = 0;  // diffuse: reflects what its colour says
    material.doubleSided = doubleSided;
    material.specular = 0;
    return material;
}

// Voxels of edge 1: coordinates below are those of the grid.
VoxelGrid unitGrid(const glm::ivec3& size) {
    VoxelGrid grid;
    grid.origin = glm::vec3(0);
    grid.voxelSize = 1;
    grid.size = size;
    return grid;
}

// A rectangle at height y, looking up.
Mesh sheet(float x0, float x1, float y) { return quadMesh({x0, y, 4}, {x1 - x0, 0, 0}, {0, 0, -4}); }

struct Face {
    float weight, offset, area;
    glm::vec3 albedo, normal, lower, upper, emission;
};

struct VoxelLayers : public GlTest {
    voxels::VoxelTables tables;
    std::vector<gpu::FaceMaterial> materials;

    void voxelize(const Scene& scene, const VoxelGrid& grid) {
        const scene::GpuScene gpu(scene);
        voxels::SurfaceVoxels surface;
        surface.build(device(), gpu, grid);
        tables = voxels::downloadVoxels(surface);
        materials = surface.faceMaterials().read<gpu::FaceMaterial>(surface.faceCount());
    }
    std::optional<Face> face(const glm::ivec3& voxel, int direction) const {
        if (!tables.has(voxel)) return {};
        const std::uint32_t record = tables.record(voxel);
        std::uint32_t index = record & 0x3ffffffu;
        if ((record >> (26 + direction) & 1u) == 0) return {};
        for (int k = 0; k < direction; ++k) index += record >> (26 + k) & 1u;
        const gpu::FaceRecord& r = tables.faces[index];
        const gpu::FaceMaterial& material = materials[index];
        Face f{voxels::unpackWeight(r.offsetWeight),
               voxels::unpackOffset(r.offsetWeight),
               voxels::unpackArea(material),
               voxels::unpackAlbedo(material.albedo),
               math::octDecode(math::unpackSnorm2x16(r.normal)),
               {},
               {},
               voxels::unpackEmission(material)};
        voxels::unpackBounds(r.bounds, f.lower, f.upper);
        return f;
    }
    // Every face against the reference. Returns how many of them have something to hide.
    int expectAsReference(const Scene& scene, bool hides = true) {
        const ReferenceFaces faces =
            referenceFaces(scene, referenceTriangles(scene, tables.grid), tables.grid, hides);
        int layered = 0;
        for (const auto& [key, expected] : faces) {
            if (expected.weight < 0.01) continue;
            const glm::ivec3 voxel = voxels::unpackVoxel(static_cast<std::uint32_t>(key / 8));
            const std::optional<Face> f = face(voxel, static_cast<int>(key % 8));
            EXPECT_TRUE(f) << "no face";
            if (!f) return layered;
            layered += expected.layered ? 1 : 0;
            // Bounds of 1/31 and normals of 16 bits decide where slices end.
            const double slack = expected.layered ? 4e-3 : 2e-4;
            const glm::dvec3 n = glm::normalize(expected.normal);
            EXPECT_NEAR(static_cast<double>(f->weight), expected.weight, slack);
            EXPECT_NEAR(static_cast<double>(f->area), expected.area, 2 * slack);
            EXPECT_GT(glm::dot(glm::dvec3(f->normal), n), expected.layered ? 0.9999 : 0.99999);
            EXPECT_NEAR(static_cast<double>(f->offset), expected.offset, expected.layered ? 5e-3 : 1e-3);
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(static_cast<double>(f->albedo[i]), expected.albedo[i] / expected.weight,
                            expected.layered ? 5e-3 : 1e-3);
            }
            EXPECT_EQ(wrongBounds(expected, static_cast<int>(key % 8), f->lower, f->upper), "");
            if (HasFailure()) {
                ADD_FAILURE() << "voxel " << voxel.x << " " << voxel.y << " " << voxel.z << " direction "
                              << key % 8 << (expected.layered ? ", layered" : "");
                return layered;
            }
        }
        return layered;
    }
};

TEST_F(VoxelLayers, TheFrontSheetHidesTheOneBehind) {
    // From far apart to a hundredth of a voxel, in both orders in the file.
    for (const float gap : {0.4f, 0.1f, 0.01f})
        for (const bool redFirst : {false, true}) {
            Scene scene;
            if (redFirst) addInstance(scene, sheet(0, 4, 0.3f + gap), painted(kRed, true));
            addInstance(scene, sheet(0, 4, 0.3f), painted(kGreen, true));
            if (!redFirst) addInstance(scene, sheet(0, 4, 0.3f + gap), painted(kRed, true));
            voxelize(scene, unitGrid(glm::ivec3(4)));
            const std::optional<Face> above = face({1, 0, 1}, kUp);
            const std::optional<Face> below = face({1, 0, 1}, kDown);
            ASSERT_TRUE(above && below);
            EXPECT_NEAR(above->weight, 1.0f, 1e-3f);
            EXPECT_NEAR(above->area, 1.0f, 1e-3f);
            EXPECT_NEAR(above->offset, 0.3f + gap - 0.5f, 1e-3f);
            EXPECT_GE(above->lower.y, 0.3f + gap - 1.01f / 31);
            EXPECT_LE(above->upper.y, 0.3f + gap + 1.01f / 31);
            EXPECT_NEAR(below->weight, 1.0f, 1e-3f);
            EXPECT_NEAR(below->offset, -(0.3f - 0.5f), 1e-3f);
            EXPECT_LE(below->upper.y, 0.3f + 1.01f / 31);
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(above->albedo[i], kRed[i], 2e-3f);
                EXPECT_NEAR(below->albedo[i], kGreen[i], 2e-3f);
            }
        }
}

TEST_F(VoxelLayers, AVoxelAtTheEdgeMixesByWhatIsSeen) {
    // The carpet ends within voxel 1.
    for (const float share : {0.1f, 0.5f, 0.8f}) {
        Scene scene;
        addInstance(scene, sheet(0, 4, 0.2f), painted(kGreen));
        addInstance(scene, sheet(0, 1 + share, 0.6f), painted(kRed));
        voxelize(scene, unitGrid(glm::ivec3(4)));
        const std::optional<Face> f = face({1, 0, 1}, kUp);
        ASSERT_TRUE(f);
        EXPECT_NEAR(f->weight, 1.0f, 1e-3f);
        // Rays from the carpet's side must meet the floor: the plane is the floor's, the bounds reach to the
        // top.
        EXPECT_NEAR(f->offset, 0.2f - 0.5f, 1e-3f);
        EXPECT_LE(f->lower.y, 0.2f);
        EXPECT_GE(f->upper.y, 0.6f);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(f->albedo[i], glm::mix(kGreen[i], kRed[i], share), 2e-3f);
        const std::optional<Face> covered = face({0, 0, 1}, kUp);
        ASSERT_TRUE(covered);
        EXPECT_NEAR(covered->albedo.r, kRed.r, 2e-3f);
        const std::optional<Face> open = face({2, 0, 1}, kUp);
        ASSERT_TRUE(open);
        EXPECT_NEAR(open->albedo.r, kGreen.r, 2e-3f);
        EXPECT_NEAR(open->offset, -0.3f, 1e-3f);
    }
}

TEST_F(VoxelLayers, WhatFillsPartOfAVoxelHidesWhatLiesBehindThatPart) {
    // A book on a book, both end in the middle of voxel 1; behind them nothing.
    Scene scene;
    addInstance(scene, sheet(0, 1.5f, 0.25f), painted(kGreen));
    addInstance(scene, sheet(0, 1.5f, 0.5f), painted(kRed));
    voxelize(scene, unitGrid(glm::ivec3(4)));
    const std::optional<Face> f = face({1, 0, 1}, kUp);
    ASSERT_TRUE(f);
    // Bounds are rounded to 1/31, and so is the room.
    EXPECT_NEAR(f->weight, 0.5f, 1.0f / 31);
    EXPECT_NEAR(f->albedo.r, kRed.r, 0.03f);
    EXPECT_NEAR(f->offset, 0.0f, 0.01f);
    EXPECT_GE(f->lower.y, 0.5f - 1.01f / 31);
}

TEST_F(VoxelLayers, TurnedLayersAreTakenApart) {
    // A roof over its ceiling, 0.08 voxel apart, at any slope.
    for (const glm::vec3 turn :
         {glm::vec3(0.4f, 0.1f, 0), glm::vec3(0.8f, 0.5f, 0.3f), glm::vec3(1.3f, -0.7f, 0.2f)}) {
        const glm::mat4 pose =
            glm::rotate(glm::rotate(glm::rotate(glm::translate(glm::mat4(1), {8, 8, 8}), turn.x, {1, 0, 0}),
                                    turn.y, {0, 1, 0}),
                        turn.z, {0, 0, 1});
        Scene scene;
        addInstance(scene, quadMesh({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), painted(kGreen), pose);
        addInstance(scene, quadMesh({-5, 0.08f, 5}, {10, 0, 0}, {0, 0, -10}), painted(kRed), pose);
        voxelize(scene, unitGrid(glm::ivec3(16)));
        double red = 0, all = 0;
        int whole = 0;
        for (int z = 0; z < 16; ++z)
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x)
                    for (int k = 0; k < 6; ++k) {
                        const std::optional<Face> f = face({x, y, z}, k);
                        // The front of a voxel that one of the layers all but misses belongs to the other.
                        if (!f || f->weight < 0.7f) continue;
                        ++whole;
                        all += static_cast<double>(f->weight);
                        red +=
                            static_cast<double>(f->weight * (f->albedo.r - kGreen.r) / (kRed.r - kGreen.r));
                        EXPECT_LE(f->weight, 1.005f);
                    }
        EXPECT_GT(whole, 60);
        // Half, if neither hid the other. Not all: where the red one leaves the voxel the green one is seen,
        // and the bounds of a slanted piece have more room than it fills.
        EXPECT_GT(red / all, 0.72) << turn.x;
    }
}

TEST_F(VoxelLayers, NothingHidesItself) {
    // Planes at any slope, and a surface of many small triangles: all that there is counts, as if nothing
    // could be hidden.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 8; ++i) {
        const glm::mat4 pose =
            glm::rotate(glm::translate(glm::mat4(1), {8, 8, 8}), 3 * unit(random),
                        glm::normalize(glm::vec3(unit(random), unit(random), unit(random))));
        Scene scene;
        Mesh mesh = quadMesh({-6, 0, 6}, {12, 0, 0}, {0, 0, -12});
        if (i % 2 == 1) {  // waves, a voxel high; slopes below 1
            mesh = {};
            const int n = 48;
            for (int z = 0; z <= n; ++z)
                for (int x = 0; x <= n; ++x) {
                    const glm::vec2 p = 11.7f * glm::vec2(x, z) / static_cast<float>(n) - 5.8f;
                    mesh.positions.emplace_back(p.x, 0.25f * std::sin(2 * p.x) * std::cos(1.7f * p.y), p.y);
                }
            for (int z = 0; z < n; ++z)
                for (int x = 0; x < n; ++x) {
                    const auto at = static_cast<std::uint32_t>(z * (n + 1) + x);
                    for (const std::uint32_t v : {0, n + 1, 1, 1, n + 1, n + 2})
                        mesh.indices.push_back(at + v);
                }
        }
        addInstance(scene, mesh, painted(kRed),
                    i % 2 == 1 ? glm::translate(glm::mat4(1), glm::vec3(8) + 0.3f * unit(random)) : pose);
        voxelize(scene, unitGrid(glm::ivec3(16)));
        EXPECT_EQ(expectAsReference(scene, false), 0);
    }
}

TEST_F(VoxelLayers, CrossingSurfacesShowTheirUpperHalves) {
    // An X, seen from above: each arm hides half of the other. Its arms stay away from the voxel's edges.
    const glm::mat4 middle = glm::translate(glm::mat4(1), {1.5f, 1.52f, 1.5f});
    Scene scene;
    for (const float side : {-1.0f, 1.0f})
        addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), painted(side < 0 ? kRed : kGreen),
                    glm::rotate(middle, side * glm::quarter_pi<float>(), {0, 0, 1}));
    voxelize(scene, unitGrid(glm::ivec3(4)));
    expectAsReference(scene);
    const std::optional<Face> f = face({1, 1, 1}, kUp);
    ASSERT_TRUE(f);
    EXPECT_NEAR(f->weight, 1.0f, 0.01f);
    EXPECT_NEAR(f->area, std::sqrt(0.5f), 0.03f);
    EXPECT_GT(f->normal.y, 0.999f);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(f->albedo[i], 0.5f * (kRed[i] + kGreen[i]), 0.01f);
}

TEST_F(VoxelLayers, WhatLetsThroughHidesItsShareOnly) {
    // A veil of opacity 0.25 over the floor, and a grille of which half is cut away by its texture.
    Scene scene;
    Material veil = painted(kRed);
    veil.baseColor.a = 0.25f;
    veil.alphaMode = AlphaMode::Blend;
    addInstance(scene, sheet(0, 4, 0.2f), painted(kGreen));
    addInstance(scene, sheet(0, 4, 0.6f), veil);
    voxelize(scene, unitGrid(glm::ivec3(4)));
    std::optional<Face> f = face({1, 0, 1}, kUp);
    ASSERT_TRUE(f);
    EXPECT_NEAR(f->weight, 1.0f, 2e-3f);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(f->albedo[i], glm::mix(kGreen[i], kRed[i], 0.25f), 2e-3f);

    Texture stripes;
    stripes.width = stripes.height = 64;
    stripes.srgb = false;
    for (int i = 0; i < 64 * 64; ++i)
        for (const int value : {255, 255, 255, i % 4 < 2 ? 255 : 0})
            stripes.rgba.push_back(static_cast<std::uint8_t>(value));
    scene.textures.push_back(stripes);
    Material& grille = scene.materials.back();
    grille.baseColor.a = 1;
    grille.alphaMode = AlphaMode::Mask;
    grille.baseColorTexture.texture = 0;
    scene.meshes.back().uvs = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    voxelize(scene, unitGrid(glm::ivec3(4)));
    f = face({1, 0, 1}, kUp);
    ASSERT_TRUE(f);
    EXPECT_NEAR(f->weight, 1.0f, 2e-3f);
    EXPECT_NEAR(f->albedo.r, 0.5f * (kGreen.r + kRed.r), 0.05f);
}

TEST_F(VoxelLayers, EmissionIsHiddenAndSeenLikeTheRest) {
    for (const bool glowsInFront : {false, true}) {
        Scene scene;
        Material glowing = painted(kGreen);
        glowing.emission = {4, 2, 1};
        addInstance(scene, sheet(0, 4, 0.2f), glowsInFront ? painted(kRed) : glowing);
        addInstance(scene, sheet(0, 1.5f, 0.6f), glowsInFront ? glowing : painted(kRed));
        voxelize(scene, unitGrid(glm::ivec3(4)));
        const float expected[3] = {glowsInFront ? 4.0f : 0.0f, 2, glowsInFront ? 0.0f : 4.0f};
        for (int x = 0; x < 3; ++x) {
            const std::optional<Face> f = face({x, 0, 1}, kUp);
            ASSERT_TRUE(f);
            EXPECT_NEAR(f->emission.r, expected[x], 0.01f);
        }
    }
}

TEST_F(VoxelLayers, LightIsLookedUpOnTopOfWhatStandsInFront) {
    addShader("test/rise.comp.glsl", R"(#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer In { uvec4 texels[]; };
layout(std430) writeonly buffer Out { vec4 rises[]; };
void main() {
    uvec4 r = texels[gl_GlobalInvocationID.x];
    rises[gl_GlobalInvocationID.x] = vec4(faceFrontOffset(r, octDecode(unpackSnorm2x16(r.x))), 0.0);
})");
    const auto rises = [&] {
        std::vector<gpu::FaceRecord> faces = tables.faces;
        faces.resize((faces.size() + 63) / 64 * 64);
        const gl::Buffer in(faces, "in");
        const gl::Buffer out(faces.size() * 16, "out");
        programs()
            .compute("test/rise.comp.glsl")
            .dispatch(gl::Inputs().storage("In", in).storage("Out", out), static_cast<int>(faces.size()));
        gl::barrier(gl::Access::ShaderStorage);
        return out.read<glm::vec4>(tables.faces.size());
    };
    // Carpet over floor: none where either is alone, the carpet's height where both are seen.
    Scene carpet;
    addInstance(carpet, sheet(0, 4, 0.2f), painted(kGreen));
    addInstance(carpet, sheet(0, 1.4f, 0.6f), painted(kRed));
    voxelize(carpet, unitGrid(glm::ivec3(4)));
    const std::vector<glm::vec4> got = rises();
    for (std::size_t i = 0; i < got.size(); ++i) {
        EXPECT_EQ(got[i].x, 0.0f);
        EXPECT_EQ(got[i].z, 0.0f);
        const bool edge = voxels::unpackVoxel(tables.faces[i].voxel).x == 1;
        EXPECT_NEAR(got[i].y, edge ? 0.4f : 0.0f, 2.0f / 31);
    }
    // Planes at any slope: only what rounding of the bounds explains.
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 axis = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)));
        Scene plane;
        addInstance(plane, quadMesh({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}), painted(kRed),
                    glm::rotate(glm::translate(glm::mat4(1), {8, 8, 8}), 3 * unit(random), axis));
        voxelize(plane, unitGrid(glm::ivec3(16)));
        for (const glm::vec4& rise : rises()) EXPECT_LT(glm::length(glm::vec3(rise)), 1.0f / 31);
    }
}

// A lamp straight above a sheet that ends within voxels: nothing but the height of the sheet keeps its light there.
TEST_F(VoxelLayers, ALampAboveTheEdgeOfASheetLightsIt) {
    const float voxel = 4.0f / 64;
    for (const float covered : {0.3f, 0.6f, 0.9f})
        for (const float gap : {0.15f, 0.2f, 0.5f}) {
            Scene scene;
            addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), painted(glm::vec3(0.5f)));
            const float half = (4 + covered) * voxel, height = gap * voxel;
            addInstance(scene, quadMesh({-half, height, half}, {2 * half, 0, 0}, {0, 0, -2 * half}),
                        painted(glm::vec3(0.5f)));
            Light lamp;
            lamp.position = {0, 1, 0};
            lamp.intensity = glm::vec3(10);
            scene.lights.push_back(lamp);
            CacheRig rig(programs(), scene, 64);
            rig.relight();
            int seen = 0;
            for (const CachedFace& face : rig.faces()) {
                const glm::vec3 way = lamp.position - face.position;
                const float d2 = glm::dot(way, way);
                if (face.normal.y < 0.9f || std::max(std::abs(way.x), std::abs(way.z)) > half + voxel)
                    continue;
                const float expected = 10 * way.y / std::sqrt(d2) / d2 * 0.5f / glm::pi<float>();
                EXPECT_NEAR(face.radiance.r / expected, 1, 0.1f) << covered << ' ' << gap;
                ++seen;
            }
            EXPECT_GT(seen, 80);
        }
}

TEST_F(VoxelLayers, HundredsOfLayersAreOne) {
    Scene scene;
    for (int i = 0; i < 400; ++i)
        addInstance(scene, sheet(0, 4, 0.1f + 0.002f * static_cast<float>(i)),
                    painted(i < 300 ? kGreen : kRed));
    voxelize(scene, unitGrid(glm::ivec3(4)));
    const std::optional<Face> f = face({1, 0, 1}, kUp);
    ASSERT_TRUE(f);
    EXPECT_NEAR(f->weight, 1.0f, 1e-3f);
    EXPECT_NEAR(f->albedo.r, kRed.r, 2e-3f);
    EXPECT_GT(f->offset, 0.34f);  // the last is at 0.398; a slice of depth is 0.053
    EXPECT_GT(f->lower.y, 0.75f);
}

TEST_F(VoxelLayers, AgreesWithTheReference) {
    // Sheets across each other at random, boxes of which voxels hold several sides, small ones and large.
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    Scene scene;
    for (int i = 0; i < 24; ++i) {
        const glm::vec3 at = 8.0f + 4.0f * glm::vec3(unit(random), unit(random), unit(random));
        const float size = i < 12 ? 3.0f : 0.6f;
        addInstance(scene, quadMesh({-size, 0, size}, {2 * size, 0, 0}, {0, 0, -2 * size}),
                    painted(0.5f + 0.4f * glm::vec3(unit(random), unit(random), unit(random)), i % 3 == 0),
                    glm::rotate(glm::translate(glm::mat4(1), at), 3 * unit(random),
                                glm::normalize(glm::vec3(unit(random), unit(random), unit(random)))));
    }
    voxelize(scene, unitGrid(glm::ivec3(16)));
    EXPECT_GT(expectAsReference(scene), 50);
}

}  // namespace
}  // namespace conelight::test
