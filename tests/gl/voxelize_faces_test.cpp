// SPDX-License-Identifier: MIT
// What the faces of voxels say: weight, area, normal, offset, colour and bounds against the CPU reference;
// the order of records; directions, emission, textures, masks and vertex colours.
#include "support/voxelize_rig.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "math/octahedral.h"

namespace conelight::test {
namespace {

using voxels::VoxelGrid;
using VoxelizeFacesTest = VoxelizeTest;

// The direction of face `index`, 0 to 5, or 6: it follows from its place among the faces of its voxel.
int directionOf(const VoxelizeResult& result, std::size_t index) {
    const glm::ivec3 voxel = voxels::unpackVoxel(result.faces[index].voxel);
    const std::uint32_t* word = &result.brickWords[4 * voxels::brickIndex(voxel / 4, result.grid.bricks())];
    const std::uint64_t mask = word[0] | (static_cast<std::uint64_t>(word[1]) << 32);
    const std::uint64_t below = (std::uint64_t{1} << voxels::bitOfVoxel(voxel)) - 1;
    const std::uint32_t record =
        result.records[word[2] + static_cast<std::uint32_t>(std::popcount(mask & below))];
    const std::uint32_t place = static_cast<std::uint32_t>(index) - (record & 0x3ffffffu);
    int direction = 0;
    for (std::uint32_t seen = 0; direction < 6; ++direction)
        if (((record >> (26 + direction)) & 1u) != 0 && seen++ == place) break;
    return direction;
}

// Normal, offset, bounds and colour. Returns whether the bounds are narrower than the voxel.
bool expectAsReference(const gpu::FaceRecord& face, const gpu::FaceMaterial& material,
                       const ReferenceFace& expected, int direction) {
    const glm::dvec3 n = glm::normalize(expected.normal);
    const glm::dvec3 normal(math::octDecode(math::unpackSnorm2x16(face.normal)));
    EXPECT_GT(glm::dot(normal, n), 0.99999);
    EXPECT_NEAR(static_cast<double>(voxels::unpackOffset(face.offsetWeight)),
                glm::dot(n, expected.center) / expected.weight, 1e-3);
    const glm::vec3 albedo = voxels::unpackAlbedo(material.albedo);
    glm::vec3 low, high;
    voxels::unpackBounds(face.bounds, low, high);
    EXPECT_EQ(wrongBounds(expected, direction, low, high), "");
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(static_cast<double>(albedo[k]), expected.albedo[k] / expected.weight, 1e-3);
    return glm::any(glm::greaterThan(glm::dvec3(low), expected.lower + 1.01 / 31));
}

// A torus, a two-sided square and a small mirrored box, which keeps facing outwards.
Scene torusSquareAndMirroredBox() {
    Scene scene = torus();
    addInstance(scene, squareMesh(), addDiffuseMaterial(scene, {0.2f, 0.7f, 0.3f}, true),
                glm::rotate(glm::mat4(1), 0.6f, {1, 1, 0.3f}));
    addInstance(scene, boxMesh(), addDiffuseMaterial(scene, {1, 1, 1}),
                glm::rotate(glm::scale(glm::translate(glm::mat4(1), {0.2f, 0.9f, 0}), {-0.3f, 0.2f, 0.25f}),
                            0.3f, {0, 1, 1}));
    scene.materials[0].specular = 1;  // reflects more than its colour
    scene.materials[0].roughness = 0.2f;
    return scene;
}

TEST_F(VoxelizeFacesTest, FacesSayWhatTheReferenceComputes) {
    const Scene scene = torusSquareAndMirroredBox();
    const VoxelizeResult result = voxelize(scene, 64);
    const ReferenceFaces reference =
        referenceFaces(scene, referenceTriangles(scene, result.grid), result.grid);
    std::size_t compared = 0, fitted = 0;
    double weightOf = 0, weightReference = 0;
    for (std::size_t index = 0; index < result.faces.size(); ++index) {
        const gpu::FaceRecord& face = result.faces[index];
        const gpu::FaceMaterial& material = result.materials[index];
        const glm::ivec3 voxel = voxels::unpackVoxel(face.voxel);
        ASSERT_TRUE(result.has(voxel));
        const int direction = directionOf(result, index);
        ASSERT_LT(direction, 6);
        const auto found = reference.find(std::uint64_t{8} * (face.voxel & 0x3fffffffu) +
                                          static_cast<std::uint64_t>(direction));
        // Slivers may exist on one side only.
        const double weight = static_cast<double>(voxels::unpackWeight(face.offsetWeight));
        if (found == reference.end()) {
            EXPECT_LT(weight, 1e-3);
            continue;
        }
        const ReferenceFace& f = found->second;
        weightOf += weight;
        weightReference += f.weight;
        // Faces with something to hide: voxel_layers_test.cpp.
        if (f.layered) continue;
        EXPECT_NEAR(weight, f.weight, 2e-4);
        EXPECT_NEAR(static_cast<double>(voxels::unpackArea(material)), f.area, 2e-4);
        if (f.weight < 0.01) continue;
        ++compared;
        fitted += expectAsReference(face, material, f, direction) ? 1 : 0;
        if (HasFailure())
            FAIL() << "voxel " << voxel.x << " " << voxel.y << " " << voxel.z << " direction " << direction;
    }
    EXPECT_GT(compared, 10000u);
    EXPECT_GT(fitted, compared / 200);  // edges of the box and the quad
    EXPECT_NEAR(weightOf / weightReference, 1.0, 1e-4);
    // No face of the reference is absent, but slivers.
    EXPECT_LT(static_cast<double>(reference.size()) - static_cast<double>(result.faces.size()),
              0.01 * static_cast<double>(reference.size()));
}

TEST_F(VoxelizeFacesTest, RecordsAreOrderedByBrickVoxelAndDirection) {
    const VoxelizeResult r = voxelize(torus(), 64);
    std::uint32_t voxel = 0, face = 0;
    std::size_t brick = 0;
    for (std::size_t b = 0; b < r.grid.brickCount(); ++b) {
        const std::uint64_t mask =
            r.brickWords[4 * b] | (static_cast<std::uint64_t>(r.brickWords[4 * b + 1]) << 32);
        if (mask == 0) continue;
        EXPECT_EQ(r.brickWords[4 * b + 2], voxel);
        EXPECT_EQ(voxels::brickIndex(voxels::unpackVoxel(r.bricks[brick++]), r.grid.bricks()), b);
        for (int i = 0; i < std::popcount(mask); ++i, ++voxel) {
            EXPECT_EQ(r.records[voxel] & 0x3ffffffu, face);
            face += static_cast<std::uint32_t>(std::popcount(r.records[voxel] >> 26));
        }
    }
    EXPECT_EQ(voxel, r.records.size());
    EXPECT_EQ(face, r.faces.size());
    EXPECT_EQ(brick, r.bricks.size());
}

TEST_F(VoxelizeFacesTest, DirectionsStayApart) {
    // Two quads facing +z a tenth of a voxel apart, of which the front one is seen; one facing -z.
    Scene scene;
    const int red = addDiffuseMaterial(scene, {1, 0, 0});
    const int blue = addDiffuseMaterial(scene, {0, 0, 1});
    addInstance(scene, squareMesh(), red);
    addInstance(scene, squareMesh(), blue, glm::translate(glm::mat4(1), {0, 0, 0.1f * 0.25f}));
    addInstance(scene, squareMesh(), red, glm::rotate(glm::mat4(1), glm::pi<float>(), {1, 0, 0}));
    VoxelGrid grid;
    grid.origin = {-2, -2, -0.1f};
    grid.voxelSize = 0.25f;
    grid.size = {16, 16, 4};
    const VoxelizeResult r = voxelize(scene, grid);
    ASSERT_EQ(r.faces.size(), 128u);
    for (std::size_t i = 0; i < r.faces.size(); i += 2) {
        EXPECT_NEAR(voxels::unpackWeight(r.faces[i].offsetWeight), 1.0f, 1e-3f);
        EXPECT_EQ(voxels::unpackAlbedo(r.materials[i].albedo), glm::vec3(0, 0, 1));
        EXPECT_NEAR(voxels::unpackOffset(r.faces[i].offsetWeight), 0.4f + 0.1f - 0.5f, 1e-3f);
        EXPECT_NEAR(voxels::unpackWeight(r.faces[i + 1].offsetWeight), 1.0f, 1e-3f);
        EXPECT_EQ(voxels::unpackAlbedo(r.materials[i + 1].albedo), glm::vec3(1, 0, 0));
        EXPECT_NEAR(voxels::unpackOffset(r.faces[i + 1].offsetWeight), -(0.4f - 0.5f), 1e-3f);
    }
}

TEST_F(VoxelizeFacesTest, EmissionIsKeptOfTheFrontOnly) {
    Scene scene;
    addInstance(scene, squareMesh(), addDiffuseMaterial(scene, glm::vec3(0.5f)));
    scene.materials[0].emission = {12.5f, 0.25f, 3.0f};
    const VoxelizeResult r = voxelize(scene, 64);
    ASSERT_FALSE(r.faces.empty());
    for (std::size_t i = 0; i < r.faces.size(); ++i) {
        EXPECT_GT(math::octDecode(math::unpackSnorm2x16(r.faces[i].normal)).z, 0.999f);
        const glm::vec3 e = voxels::unpackEmission(r.materials[i]);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(e[k] / scene.materials[0].emission[k], 1.0f, k == 1 ? 0.05f : 0.004f);
    }
}

// --- Textures

Texture checker(int edge, int cell, const glm::u8vec4& a, const glm::u8vec4& b) {
    Texture texture;
    texture.width = texture.height = edge;
    texture.srgb = false;
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x)
            for (int k = 0; k < 4; ++k) texture.rgba.push_back(((x / cell + y / cell) % 2 == 0 ? a : b)[k]);
    return texture;
}

Scene texturedQuad(const Texture& texture, float repeats, const glm::mat4& worldFromObject = glm::mat4(1)) {
    Scene scene;
    scene.textures.push_back(texture);
    const int material = addDiffuseMaterial(scene, glm::vec3(1));
    scene.materials[0].baseColorTexture.texture = 0;
    addInstance(scene, squareMesh(repeats), material, worldFromObject);
    return scene;
}

glm::dvec3 meanAlbedo(const VoxelizeResult& r) {
    glm::dvec3 sum(0);
    double weight = 0;
    for (std::size_t i = 0; i < r.faces.size(); ++i) {
        const double w = static_cast<double>(voxels::unpackWeight(r.faces[i].offsetWeight));
        sum += w * glm::dvec3(voxels::unpackAlbedo(r.materials[i].albedo));
        weight += w;
    }
    return sum / weight;
}

TEST_F(VoxelizeFacesTest, CheckerTextureAveragesToItsMean) {
    const Texture texture = checker(64, 8, {255, 0, 51, 255}, {0, 255, 102, 255});
    // Cells larger than voxels, of about their size, and far smaller.
    for (const float repeats : {1.0f, 7.3f, 90.0f}) {
        const VoxelizeResult r =
            voxelize(texturedQuad(texture, repeats, glm::rotate(glm::mat4(1), 0.4f, {1, 1, 0})), 64);
        const glm::dvec3 mean = meanAlbedo(r);
        EXPECT_NEAR(mean.x, 0.5, 0.01) << repeats;
        EXPECT_NEAR(mean.y, 0.5, 0.01) << repeats;
        EXPECT_NEAR(mean.z, 0.3, 0.01) << repeats;
    }
    // Large cells are seen as such, not smeared.
    const VoxelizeResult sharp = voxelize(texturedQuad(texture, 1), 128);
    std::size_t pure = 0;
    for (const gpu::FaceMaterial& material : sharp.materials)
        pure += std::abs(voxels::unpackAlbedo(material.albedo).x - 0.5f) > 0.45f ? 1 : 0;
    EXPECT_GT(static_cast<double>(pure), 0.7 * static_cast<double>(sharp.faces.size()));
}

TEST_F(VoxelizeFacesTest, MaskedTextureOfHalfCoverageGivesHalfTheWeight) {
    const Texture texture = checker(64, 8, {255, 0, 0, 255}, {0, 255, 0, 0});
    for (const float repeats : {2.0f, 20.0f, 300.0f}) {
        Scene scene = texturedQuad(texture, repeats);
        scene.materials[0].alphaMode = AlphaMode::Mask;
        const VoxelizeResult r = voxelize(scene, 64);
        Scene opaque = scene;
        opaque.materials[0].alphaMode = AlphaMode::Opaque;
        const VoxelizeResult all = voxelize(opaque, 64);
        double weight = 0, weightAll = 0;
        for (const gpu::FaceRecord& face : r.faces)
            weight += static_cast<double>(voxels::unpackWeight(face.offsetWeight));
        for (const gpu::FaceRecord& face : all.faces)
            weightAll += static_cast<double>(voxels::unpackWeight(face.offsetWeight));
        EXPECT_NEAR(weight / weightAll, 0.5, 0.02) << repeats;
        if (repeats > 10) continue;
        // What is cut away lends no colour: green is where alpha is zero.
        EXPECT_LT(meanAlbedo(r).y, 0.05) << repeats;
    }
}

TEST_F(VoxelizeFacesTest, VertexColoursAndBlendingCount) {
    Scene scene;
    const int material = addDiffuseMaterial(scene, {0.5f, 0.5f, 0.5f});
    scene.materials[0].alphaMode = AlphaMode::Blend;
    scene.materials[0].baseColor.a = 0.25f;
    Mesh quad = squareMesh();
    quad.colors = {{0, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {0, 1, 1, 1}};  // red rises with x
    addInstance(scene, quad, material);
    const VoxelizeResult r = voxelize(scene, 64);
    for (std::size_t i = 0; i < r.faces.size(); ++i) {
        const gpu::FaceRecord& face = r.faces[i];
        const glm::ivec3 voxel = voxels::unpackVoxel(face.voxel);
        const float x = r.grid.worldFromGrid(glm::vec3(voxel) + 0.5f).x;
        const float weight = voxels::unpackWeight(face.offsetWeight);
        if (weight < 0.249f) continue;  // the rim
        EXPECT_NEAR(weight, 0.25f, 1e-3f);
        EXPECT_NEAR(voxels::unpackAlbedo(r.materials[i].albedo).r, 0.5f * (0.5f + 0.5f * x), 0.01f);
        EXPECT_NEAR(voxels::unpackAlbedo(r.materials[i].albedo).g, 0.5f, 0.002f);
    }
}

}  // namespace
}  // namespace conelight::test
