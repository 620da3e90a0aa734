// SPDX-License-Identifier: MIT
// The compute voxelizer against the CPU reference (tests/support/reference_voxelizer.h): which voxels, what
// area, what each face says; the same bits in every run; textures, masks, odd triangles; twins of the packing
// functions.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <random>
#include <unordered_set>

#include "gl/pass.h"
#include "io/scene_file.h"
#include "math/octahedral.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/reference_voxelizer.h"
#include "voxels/surface_voxels.h"
#include "voxels/voxel_record.h"

namespace conelight::test {
namespace {

using voxels::VoxelGrid;

// --- Scenes made here
int addMaterial(Scene& scene, const glm::vec3& albedo, bool doubleSided = false) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1);
    material.specular = 0;  // matt: reflects what its colour says
    material.doubleSided = doubleSided;
    material.specular = 0;  // its colour is all that it reflects
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void addInstance(Scene& scene, Mesh mesh, int material, const glm::mat4& worldFromObject = glm::mat4(1)) {
    scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = material;
    instance.worldFromObject = worldFromObject;
    scene.instances.push_back(instance);
}

Mesh boxMesh() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return mesh;
}

Mesh torusMesh(int rings, int sides) {
    Mesh mesh;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            const float a = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(rings);
            const float b = glm::two_pi<float>() * static_cast<float>(j) / static_cast<float>(sides);
            const float r = 1.0f + 0.4f * std::cos(b);
            mesh.positions.emplace_back(r * std::cos(a), 0.4f * std::sin(b), r * std::sin(a));
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % rings) * sides + j % sides); };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j)
            for (const std::uint32_t v :
                 {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)})
                mesh.indices.push_back(v);
    return mesh;
}

// 12 triangles, each hundreds of voxels long, none along an axis.
Scene rotatedBox() {
    Scene scene;
    const glm::mat4 turn = glm::rotate(glm::rotate(glm::mat4(1), 0.7f, {0.3f, 1, 0.2f}), 0.4f, {1, 0, 0.5f});
    addInstance(scene, boxMesh(), addMaterial(scene, {0.25f, 0.5f, 0.75f}), turn);
    return scene;
}

Scene torus() {
    Scene scene;
    addInstance(scene, torusMesh(90, 40), addMaterial(scene, {0.9f, 0.1f, 0.4f}),
                glm::rotate(glm::mat4(1), 0.5f, {1, 0.2f, 0.1f}));
    return scene;
}

// Two triangles over [-1,1]^2 in the plane z = 0, facing +z, uv from (0,0) to (repeats, repeats).
Mesh quadMesh(float repeats = 1) {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// --- What the voxelizer made

struct Result {
    VoxelGrid grid;
    std::vector<std::uint32_t> brickWords;
    std::vector<std::uint32_t> records;
    std::vector<gpu::FaceRecord> faces;
    std::vector<std::uint32_t> sources;
    std::vector<std::uint32_t> bricks;
    double area = 0;  // in voxel sides
    std::vector<glm::ivec3> occupied;

    bool has(const glm::ivec3& voxel) const {
        const std::uint32_t* word = &brickWords[4 * voxels::brickIndex(voxel / 4, grid.bricks())];
        const std::uint32_t bit = voxels::bitOfVoxel(voxel);
        return ((word[bit / 32] >> (bit % 32)) & 1u) != 0;
    }
    std::uint64_t hash() const {
        std::uint64_t h = 1469598103934665603u;
        const auto add = [&](const void* data, std::size_t bytes) {
            for (std::size_t i = 0; i < bytes; ++i)
                h = (h ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211u;
        };
        add(brickWords.data(), 4 * brickWords.size());
        add(records.data(), 4 * records.size());
        add(faces.data(), sizeof(gpu::FaceRecord) * faces.size());
        add(sources.data(), 4 * sources.size());
        add(bricks.data(), 4 * bricks.size());
        return h;
    }
};

Result download(const voxels::SurfaceVoxels& surface) {
    Result r;
    r.grid = surface.grid();
    r.brickWords.resize(4 * r.grid.brickCount());
    surface.brickWords().read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, r.brickWords.data(),
                              4 * r.brickWords.size());
    r.records = surface.records().read<std::uint32_t>(surface.voxelCount());
    r.faces = surface.faces().read<gpu::FaceRecord>(surface.faceCount());
    r.sources = surface.faceSources().read<std::uint32_t>(2 * std::size_t{surface.faceCount()});
    r.bricks = surface.occupiedBricks().read<std::uint32_t>(surface.occupiedBrickCount());
    const auto fragments = surface.fragments().read<std::uint32_t>(8 * std::size_t{surface.fragmentCount()});
    for (std::size_t i = 1; i < fragments.size(); i += 8)
        r.area += static_cast<double>(std::bit_cast<float>(fragments[i]));
    const glm::ivec3 bricks = r.grid.bricks();
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x)
                for (std::uint32_t bit = 0; bit < 64; ++bit) {
                    const glm::ivec3 voxel = voxels::voxelOfBit({x, y, z}, bit);
                    if (r.has(voxel)) r.occupied.push_back(voxel);
                }
    return r;
}

double meshArea(const std::vector<ReferenceTriangle>& triangles) {
    return std::accumulate(triangles.begin(), triangles.end(), 0.0,
                           [](double sum, const ReferenceTriangle& t) { return sum + t.area(); });
}

class VoxelizeTest : public GlTest {
  protected:
    Result voxelize(const Scene& scene, int size, float padding = 0.03f) {
        const scene::GpuScene gpuScene(scene);
        voxels::SurfaceVoxels surface;
        surface.build(programs(), profiler_, gpuScene, VoxelSettings{size, padding});
        return download(surface);
    }
    Result voxelize(const Scene& scene, const VoxelGrid& grid) {
        const scene::GpuScene gpuScene(scene);
        voxels::SurfaceVoxels surface;
        surface.build(programs(), profiler_, gpuScene, grid);
        return download(surface);
    }
    // No voxel missed; none marked that no triangle comes within 1e-4 voxel of.
    void expectSameVoxels(const Scene& scene, const Result& result) {
        const std::vector<ReferenceTriangle> triangles = referenceTriangles(scene, result.grid);
        std::unordered_set<std::uint32_t> touched, nearly;
        for (const ReferenceTriangle& t : triangles) {
            forEachVoxel(t, result.grid, 1e-4, [&](const glm::ivec3& voxel) {
                nearly.insert(voxels::packVoxel(voxel));
                if (touches(t, glm::dvec3(voxel) + 0.5, 0.5)) touched.insert(voxels::packVoxel(voxel));
            });
        }
        std::size_t missed = 0;
        for (const std::uint32_t packed : touched) missed += result.has(voxels::unpackVoxel(packed)) ? 0 : 1;
        std::size_t extra = 0;
        for (const glm::ivec3& voxel : result.occupied)
            extra += nearly.count(voxels::packVoxel(voxel)) != 0 ? 0 : 1;
        EXPECT_GT(touched.size(), 1000u);
        EXPECT_EQ(missed, 0u) << "of " << touched.size();
        EXPECT_EQ(extra, 0u) << "of " << result.occupied.size();
        const double area = meshArea(triangles);
        EXPECT_NEAR(result.area / area, 1.0, 1e-3);
    }
    gl::Profiler profiler_;
};

// --- Which voxels, how much area

class VoxelizeSizes : public VoxelizeTest, public ::testing::WithParamInterface<int> {};

TEST_P(VoxelizeSizes, RotatedBoxOfHugeTriangles) {
    const Scene scene = rotatedBox();
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

TEST_P(VoxelizeSizes, Torus) {
    const Scene scene = torus();
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

TEST_P(VoxelizeSizes, BuiltinSpheres) {
    const Scene scene = io::loadScene("builtin:spheres");
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

TEST_P(VoxelizeSizes, ThesisSceneWithLucy) {
    const std::optional<std::string> file = testData("vxct/scenes/scene.txt");
    if (!file) GTEST_SKIP() << "no test data";
    const Scene scene = io::loadScene(*file);
    expectSameVoxels(scene, voxelize(scene, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Grid, VoxelizeSizes, ::testing::Values(64, 128, 256));

TEST_F(VoxelizeTest, TrianglesLargerThanTheGridAreClippedToIt) {
    const Scene scene = rotatedBox();
    // A window into the middle of one side and one edge, a tenth of the box; not cubic.
    VoxelGrid window;
    window.voxelSize = 0.004f;
    window.size = {64, 40, 52};
    const glm::vec3 corner(glm::vec3(scene.instances[0].worldFromObject * glm::vec4(0.9f, 1, 0.1f, 1)));
    window.origin = corner - 0.5f * window.voxelSize * glm::vec3(window.size);
    const Result result = voxelize(scene, window);
    std::size_t missed = 0, extra = 0, met = 0;
    std::unordered_set<std::uint32_t> nearly;
    double area = 0;
    for (const ReferenceTriangle& t : referenceTriangles(scene, window))
        forEachVoxel(t, window, 3e-4, [&](const glm::ivec3& voxel) {  // coordinates reach 500: a wider slack
            nearly.insert(voxels::packVoxel(voxel));
            if (!touches(t, glm::dvec3(voxel) + 0.5, 0.5)) return;
            ++met;
            missed += result.has(voxel) ? 0 : 1;
            area += polygonArea(clippedPolygon(t, voxel));
        });
    for (const glm::ivec3& voxel : result.occupied)
        extra += nearly.count(voxels::packVoxel(voxel)) != 0 ? 0 : 1;
    EXPECT_GT(met, 2000u);
    EXPECT_EQ(missed, 0u);
    EXPECT_EQ(extra, 0u);
    EXPECT_NEAR(result.area / area, 1.0, 1e-3);
}

TEST_F(VoxelizeTest, SceneOutsideTheGridGivesNothing) {
    VoxelGrid away;
    away.origin = glm::vec3(100);
    away.size = glm::ivec3(16);
    const Result result = voxelize(rotatedBox(), away);
    EXPECT_TRUE(result.occupied.empty());
    EXPECT_TRUE(result.faces.empty());
    EXPECT_TRUE(voxelize(Scene{}, 32).faces.empty());
}

// --- What faces say

TEST_F(VoxelizeTest, FacesSayWhatTheReferenceComputes) {
    Scene scene = torus();
    addInstance(scene, quadMesh(), addMaterial(scene, {0.2f, 0.7f, 0.3f}, true),
                glm::rotate(glm::mat4(1), 0.6f, {1, 1, 0.3f}));
    // A mirrored instance: triangles keep facing outwards.
    addInstance(scene, boxMesh(), addMaterial(scene, {1, 1, 1}),
                glm::rotate(glm::scale(glm::translate(glm::mat4(1), {0.2f, 0.9f, 0}), {-0.3f, 0.2f, 0.25f}),
                            0.3f, {0, 1, 1}));
    scene.materials[0].specular = 1;  // reflects more than its colour
    scene.materials[0].roughness = 0.2f;
    const Result result = voxelize(scene, 64);
    const ReferenceFaces reference =
        referenceFaces(scene, referenceTriangles(scene, result.grid), result.grid);
    std::size_t compared = 0, fitted = 0, index = 0;
    double weightOf = 0, weightReference = 0;
    for (const gpu::FaceRecord& face : result.faces) {
        const std::uint32_t* source = &result.sources[2 * index];
        ++index;
        // The direction follows from the face's place among those of its voxel; find it by the reference's
        // keys.
        const glm::ivec3 voxel = voxels::unpackVoxel(face.voxel);
        ASSERT_TRUE(result.has(voxel));
        const std::uint32_t* word =
            &result.brickWords[4 * voxels::brickIndex(voxel / 4, result.grid.bricks())];
        const std::uint64_t mask = word[0] | (static_cast<std::uint64_t>(word[1]) << 32);
        const std::uint32_t bit = voxels::bitOfVoxel(voxel);
        const std::uint32_t record =
            result.records[word[2] +
                           static_cast<std::uint32_t>(std::popcount(mask & ((std::uint64_t{1} << bit) - 1)))];
        const std::uint32_t place = static_cast<std::uint32_t>(index - 1) - (record & 0x3ffffffu);
        int direction = 0;
        for (std::uint32_t seen = 0; direction < 6; ++direction)
            if (((record >> (26 + direction)) & 1u) != 0 && seen++ == place) break;
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
        EXPECT_NEAR(static_cast<double>(voxels::unpackArea({source[0], source[1]})), f.area, 2e-4);
        if (f.weight < 0.01) continue;
        ++compared;
        const glm::dvec3 n = glm::normalize(f.normal);
        const glm::dvec3 normal(math::octDecode(math::unpackSnorm2x16(face.normal)));
        EXPECT_GT(glm::dot(normal, n), 0.99999);
        EXPECT_NEAR(static_cast<double>(voxels::unpackOffset(face.offsetWeight)),
                    glm::dot(n, f.center) / f.weight, 1e-3);
        const glm::vec3 albedo = voxels::unpackAlbedo(face.albedo);
        glm::vec3 low, high;
        voxels::unpackBounds(face.bounds, low, high);
        EXPECT_EQ(wrongBounds(f, direction, low, high), "");
        fitted += glm::any(glm::greaterThan(glm::dvec3(low), f.lower + 1.01 / 31)) ? 1 : 0;
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(albedo[k]), f.albedo[k] / f.weight, 1e-3);
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

TEST_F(VoxelizeTest, RecordsAreOrderedByBrickVoxelAndDirection) {
    const Result r = voxelize(torus(), 64);
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

TEST_F(VoxelizeTest, DirectionsStayApart) {
    // Two quads facing +z a tenth of a voxel apart, of which the front one is seen; one facing -z.
    Scene scene;
    const int red = addMaterial(scene, {1, 0, 0});
    const int blue = addMaterial(scene, {0, 0, 1});
    addInstance(scene, quadMesh(), red);
    addInstance(scene, quadMesh(), blue, glm::translate(glm::mat4(1), {0, 0, 0.1f * 0.25f}));
    addInstance(scene, quadMesh(), red, glm::rotate(glm::mat4(1), glm::pi<float>(), {1, 0, 0}));
    VoxelGrid grid;
    grid.origin = {-2, -2, -0.1f};
    grid.voxelSize = 0.25f;
    grid.size = {16, 16, 4};
    const Result r = voxelize(scene, grid);
    ASSERT_EQ(r.faces.size(), 128u);
    for (std::size_t i = 0; i < r.faces.size(); i += 2) {
        EXPECT_NEAR(voxels::unpackWeight(r.faces[i].offsetWeight), 1.0f, 1e-3f);
        EXPECT_EQ(voxels::unpackAlbedo(r.faces[i].albedo), glm::vec3(0, 0, 1));
        EXPECT_NEAR(voxels::unpackOffset(r.faces[i].offsetWeight), 0.4f + 0.1f - 0.5f, 1e-3f);
        EXPECT_NEAR(voxels::unpackWeight(r.faces[i + 1].offsetWeight), 1.0f, 1e-3f);
        EXPECT_EQ(voxels::unpackAlbedo(r.faces[i + 1].albedo), glm::vec3(1, 0, 0));
        EXPECT_NEAR(voxels::unpackOffset(r.faces[i + 1].offsetWeight), -(0.4f - 0.5f), 1e-3f);
    }
}

TEST_F(VoxelizeTest, TheDiagonalSectionOfAVoxelHasItsFullArea) {
    // A plane at 45 degrees through the edges of voxels: area sqrt 2, the most a voxel can hold of a plane,
    // half of it each of its two faces'.
    Scene scene;
    addInstance(scene, quadMesh(), addMaterial(scene, glm::vec3(1)),
                glm::rotate(glm::mat4(1), glm::quarter_pi<float>(), {1, 0, 0}));
    VoxelGrid grid;
    grid.origin = {-2, -2, -2 + 0.001f};
    grid.voxelSize = 0.25f;
    grid.size = glm::ivec3(16);
    const Result r = voxelize(scene, grid);
    EXPECT_NEAR(r.area, 64.0, 0.01);
    float largest = 0;
    for (std::size_t i = 0; i < r.faces.size(); ++i)
        largest = std::max(largest, voxels::unpackArea({r.sources[2 * i], r.sources[2 * i + 1]}));
    EXPECT_NEAR(2 * largest, glm::root_two<float>(), 0.01f);
}

// Planes that hold edges of voxels, or their corners: every voxel must decide alike on which side an edge is.
TEST_F(VoxelizeTest, PlanesThroughEdgesKeepTheirArea) {
    const glm::vec3 normals[] = {{0, 1, 1}, {0, 1, -1}, {1, 0, 1}, {-1, 0, 1},
                                 {1, 1, 0}, {1, -1, 0}, {1, 1, 1}};
    for (const glm::vec3& normal : normals)
        for (const float voxel : {0.25f, 0.3f, 2.0f / 7})
            for (const float side : {-1.0f, 1.0f}) {
                const glm::vec3 n = side * glm::normalize(normal);
                // An edge that lies in the plane, exactly; the other is not along the grid.
                const glm::vec3 u = normal.x == 0   ? glm::vec3(2, 0, 0)
                                    : normal.y == 0 ? glm::vec3(0, 2, 0)
                                                    : glm::vec3(normal.y, -normal.x, 0);
                const glm::vec3 v = glm::cross(n, u) + 0.3f * u;
                Scene scene;
                Mesh mesh;
                mesh.positions = {-0.5f * (u + v), 0.5f * (u - v), 0.5f * (u + v), 0.5f * (v - u)};
                mesh.indices = {0, 1, 2, 0, 2, 3};
                addInstance(scene, std::move(mesh), addMaterial(scene, glm::vec3(1)));
                const VoxelGrid grid{glm::vec3(-12 * voxel), voxel, glm::ivec3(24)};
                const double area = meshArea(referenceTriangles(scene, grid));
                EXPECT_NEAR(voxelize(scene, grid).area / area, 1.0, 2e-3)
                    << side * normal.x << ' ' << side * normal.y << ' ' << side * normal.z << ' ' << voxel;
            }
}

TEST_F(VoxelizeTest, ASurfaceExactlyOnABorderBelongsToTheUpperVoxelWhicheverWayItFaces) {
    for (const bool turned : {false, true}) {
        Scene scene;
        addInstance(scene, quadMesh(), addMaterial(scene, glm::vec3(1)),
                    turned ? glm::rotate(glm::mat4(1), glm::pi<float>(), {1, 0, 0}) : glm::mat4(1));
        for (glm::vec3& p : scene.meshes[0].positions) p.z = 0;
        if (turned) {  // an exact half turn: the rotation above leaves 1e-7 behind
            scene.instances[0].worldFromObject = glm::scale(glm::mat4(1), {1, -1, -1});
        }
        VoxelGrid grid;
        grid.origin = {-2, -2, -1};
        grid.voxelSize = 0.25f;
        grid.size = {16, 16, 8};
        const Result r = voxelize(scene, grid);
        ASSERT_EQ(r.faces.size(), 64u);
        for (const gpu::FaceRecord& face : r.faces) {
            EXPECT_EQ(voxels::unpackVoxel(face.voxel).z, 4);
            EXPECT_NEAR(voxels::unpackWeight(face.offsetWeight), 1.0f, 1e-4f);
        }
        EXPECT_NEAR(r.area, 64.0, 1e-3);
    }
}

// --- Odd input

TEST_F(VoxelizeTest, DegenerateTrianglesAddNothingAndNothingIsNan) {
    Scene plain = torus();
    Scene scene = plain;
    Mesh odd;
    odd.positions = {{0, 0, 0},    {0, 0, 0},    {0, 0, 0},          {-0.5f, 0, 0},
                     {0.5f, 0, 0}, {0.1f, 0, 0}, {0.3f, 0.3f, 0.3f}, {0.3f, 0.3f, 0.30000001f}};
    odd.indices = {0, 1, 2, 3, 4, 5, 3, 3, 4, 6, 7, 6, 6, 7, 0, 4, 3, 3};
    addInstance(scene, odd, 0);
    // Scaled flat: every triangle of a box collapses or keeps an area in one plane only.
    addInstance(scene, boxMesh(), 0, glm::scale(glm::mat4(1), {0, 0, 0}));
    const VoxelGrid grid = voxels::fitGrid(plain.bounds(), 64, 0.03f);
    const Result with = voxelize(scene, grid);
    const Result without = voxelize(plain, grid);
    EXPECT_EQ(with.faces.size(), without.faces.size());
    EXPECT_EQ(with.hash(), without.hash());
    for (const gpu::FaceRecord& face : with.faces) {
        const glm::vec3 n = math::octDecode(math::unpackSnorm2x16(face.normal));
        EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
        EXPECT_TRUE(std::isfinite(voxels::unpackRgb9e5(face.radiance).x));
    }
}

TEST_F(VoxelizeTest, InvisibleAndUnvoxelizedInstancesAreLeftOutUnlitOnesAreBlack) {
    Scene scene = rotatedBox();
    scene.materials[0].unlit = true;
    scene.materials[0].emission = glm::vec3(5);
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].worldFromObject = glm::scale(glm::mat4(1), glm::vec3(0.2f));
    scene.instances[1].voxelized = false;
    scene.instances.push_back(scene.instances[1]);
    scene.instances[2].visible = false;
    const Result r = voxelize(scene, 64);
    expectSameVoxels(scene, r);
    for (const gpu::FaceRecord& face : r.faces) {
        EXPECT_EQ(face.albedo, 0u);
        EXPECT_EQ(voxels::unpackRgb9e5(face.radiance), glm::vec3(0));
    }
}

TEST_F(VoxelizeTest, EmissionIsKeptOfTheFrontOnly) {
    Scene scene;
    addInstance(scene, quadMesh(), addMaterial(scene, glm::vec3(0.5f)));
    scene.materials[0].emission = {12.5f, 0.25f, 3.0f};
    const Result r = voxelize(scene, 64);
    ASSERT_FALSE(r.faces.empty());
    for (std::size_t i = 0; i < r.faces.size(); ++i) {
        EXPECT_GT(math::octDecode(math::unpackSnorm2x16(r.faces[i].normal)).z, 0.999f);
        const glm::vec3 e = voxels::unpackEmission({r.sources[2 * i], r.sources[2 * i + 1]});
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
    const int material = addMaterial(scene, glm::vec3(1));
    scene.materials[0].baseColorTexture.texture = 0;
    addInstance(scene, quadMesh(repeats), material, worldFromObject);
    return scene;
}

glm::dvec3 meanAlbedo(const Result& r) {
    glm::dvec3 sum(0);
    double weight = 0;
    for (const gpu::FaceRecord& face : r.faces) {
        const double w = static_cast<double>(voxels::unpackWeight(face.offsetWeight));
        sum += w * glm::dvec3(voxels::unpackAlbedo(face.albedo));
        weight += w;
    }
    return sum / weight;
}

TEST_F(VoxelizeTest, CheckerTextureAveragesToItsMean) {
    const Texture texture = checker(64, 8, {255, 0, 51, 255}, {0, 255, 102, 255});
    // Cells larger than voxels, of about their size, and far smaller.
    for (const float repeats : {1.0f, 7.3f, 90.0f}) {
        const Result r =
            voxelize(texturedQuad(texture, repeats, glm::rotate(glm::mat4(1), 0.4f, {1, 1, 0})), 64);
        const glm::dvec3 mean = meanAlbedo(r);
        EXPECT_NEAR(mean.x, 0.5, 0.01) << repeats;
        EXPECT_NEAR(mean.y, 0.5, 0.01) << repeats;
        EXPECT_NEAR(mean.z, 0.3, 0.01) << repeats;
    }
    // Large cells are seen as such, not smeared.
    const Result sharp = voxelize(texturedQuad(texture, 1), 128);
    std::size_t pure = 0;
    for (const gpu::FaceRecord& face : sharp.faces)
        pure += std::abs(voxels::unpackAlbedo(face.albedo).x - 0.5f) > 0.45f ? 1 : 0;
    EXPECT_GT(static_cast<double>(pure), 0.7 * static_cast<double>(sharp.faces.size()));
}

TEST_F(VoxelizeTest, MaskedTextureOfHalfCoverageGivesHalfTheWeight) {
    const Texture texture = checker(64, 8, {255, 0, 0, 255}, {0, 255, 0, 0});
    for (const float repeats : {2.0f, 20.0f, 300.0f}) {
        Scene scene = texturedQuad(texture, repeats);
        scene.materials[0].alphaMode = AlphaMode::Mask;
        const Result r = voxelize(scene, 64);
        Scene opaque = scene;
        opaque.materials[0].alphaMode = AlphaMode::Opaque;
        const Result all = voxelize(opaque, 64);
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

TEST_F(VoxelizeTest, VertexColoursAndBlendingCount) {
    Scene scene;
    const int material = addMaterial(scene, {0.5f, 0.5f, 0.5f});
    scene.materials[0].alphaMode = AlphaMode::Blend;
    scene.materials[0].baseColor.a = 0.25f;
    Mesh quad = quadMesh();
    quad.colors = {{0, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {0, 1, 1, 1}};  // red rises with x
    addInstance(scene, quad, material);
    const Result r = voxelize(scene, 64);
    for (const gpu::FaceRecord& face : r.faces) {
        const glm::ivec3 voxel = voxels::unpackVoxel(face.voxel);
        const float x = r.grid.worldFromGrid(glm::vec3(voxel) + 0.5f).x;
        const float weight = voxels::unpackWeight(face.offsetWeight);
        if (weight < 0.249f) continue;  // the rim
        EXPECT_NEAR(weight, 0.25f, 1e-3f);
        EXPECT_NEAR(voxels::unpackAlbedo(face.albedo).r, 0.5f * (0.5f + 0.5f * x), 0.01f);
        EXPECT_NEAR(voxels::unpackAlbedo(face.albedo).g, 0.5f, 0.002f);
    }
}

// --- The same bits

// Prints a hash when asked to; else runs itself with 0, 1 and 2 driver threads and compares.
TEST_F(VoxelizeTest, SameBitsWithAnyNumberOfThreads) {
    Scene scene = torus();
    addInstance(scene, quadMesh(), addMaterial(scene, {0.2f, 0.7f, 0.3f}, true),
                glm::rotate(glm::mat4(1), 0.6f, {1, 1, 0.3f}));
    scene.materials[0].emission = {1, 2, 3};
    const std::uint64_t mine = voxelize(scene, 128).hash();
    if (std::getenv("CONELIGHT_PRINT_HASH") != nullptr) {
        std::printf("hash=%016llx\n", static_cast<unsigned long long>(mine));
        return;
    }
    for (const int threads : {0, 1, 2}) {
        const CommandResult child = runCommand(
            "LP_NUM_THREADS=" + std::to_string(threads) + " CONELIGHT_PRINT_HASH=1 /proc/" +
            std::to_string(getpid()) + "/exe --gtest_filter=VoxelizeTest.SameBitsWithAnyNumberOfThreads");
        ASSERT_EQ(child.status, 0) << child.output;
        char expected[32];
        std::snprintf(expected, sizeof expected, "hash=%016llx", static_cast<unsigned long long>(mine));
        EXPECT_NE(child.output.find(expected), std::string::npos) << threads << " threads: " << child.output;
    }
}

TEST_F(VoxelizeTest, RebuildingGivesTheSameBitsWhateverWasBuiltBefore) {
    const Scene small = rotatedBox();
    const Scene large = torus();
    const std::uint64_t fresh = voxelize(large, 128).hash();
    const scene::GpuScene gpuSmall(small);
    const scene::GpuScene gpuLarge(large);
    voxels::SurfaceVoxels surface;
    surface.build(programs(), profiler_, gpuSmall, VoxelSettings{16, 0.03f});
    const std::uint64_t first = download(surface).hash();
    surface.build(programs(), profiler_, gpuLarge, VoxelSettings{128, 0.03f});  // every list grows
    EXPECT_EQ(download(surface).hash(), fresh);
    for (int i = 0; i < 4; ++i) {
        surface.build(programs(), profiler_, gpuLarge, VoxelSettings{128, 0.03f});
        EXPECT_EQ(download(surface).hash(), fresh);
    }
    const std::size_t objects = gl::liveObjectCount();
    surface.build(programs(), profiler_, gpuSmall, VoxelSettings{16, 0.03f});
    EXPECT_EQ(download(surface).hash(), first);
    EXPECT_EQ(gl::liveObjectCount(), objects);
}

TEST_F(VoxelizeTest, ManyTrianglesInOneVoxelAreSummedExactly) {
    // A torus of 7,200 triangles in a grid so coarse that each voxel holds hundreds.
    const Scene scene = torus();
    const Result r = voxelize(scene, 8);
    const ReferenceFaces reference = referenceFaces(scene, referenceTriangles(scene, r.grid), r.grid);
    double weight = 0, expected = 0;
    for (const gpu::FaceRecord& face : r.faces)
        weight += static_cast<double>(voxels::unpackWeight(face.offsetWeight));
    for (const auto& [key, face] : reference) expected += std::min(face.weight, 4.0);
    EXPECT_NEAR(weight / expected, 1.0, 1e-3);
    // 40 sheets in one voxel: more than the first unit of the sums can hold. The frontmost are seen.
    Scene stack;
    const int material = addMaterial(stack, {0.2f, 0.4f, 0.8f});
    for (int i = 0; i < 40; ++i)
        addInstance(stack, quadMesh(), material,
                    glm::translate(glm::mat4(1), {0, 0, 0.002f * static_cast<float>(i)}));
    VoxelGrid grid;
    grid.origin = {-2, -2, -0.1f};
    grid.voxelSize = 0.25f;
    grid.size = {16, 16, 4};
    const Result sheets = voxelize(stack, grid);
    ASSERT_EQ(sheets.faces.size(), 64u);
    for (const gpu::FaceRecord& face : sheets.faces) {
        EXPECT_NEAR(voxels::unpackWeight(face.offsetWeight), 1.0f, 1e-3f);
        EXPECT_NEAR(voxels::unpackAlbedo(face.albedo).b, 0.8f, 1e-3f);
        // A slice of depth holds the last three, 0.074 to 0.078; the plane is the rearmost's of them.
        EXPECT_NEAR(voxels::unpackOffset(face.offsetWeight), (0.1f + 0.074f) / 0.25f - 0.5f, 1e-3f);
    }
}

// --- Twins of functions in C++ and GLSL

TEST_F(VoxelizeTest, PackingFunctionsAgreeInGlsl) {
    addShader("test/pack.comp.glsl", R"(#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
layout(std430, binding = 8) readonly buffer In { vec4 values[]; };
layout(std430, binding = 9) writeonly buffer Out { uvec4 packed_[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 v = values[i];
    uvec2 source = packFaceSource(v.rgb * 1000.0, v.a * 4.0);
    ivec3 voxel = ivec3(v.xyz * 1023.0);
    packed_[2u * i] = uvec4(packOffsetWeight(v.x * 2.0 - 1.0, v.w * 4.0), packBounds(min(v.xyz, v.yzx), max(v.xyz, v.yzx)),
                            packAlbedo(v.xyz), packRgb9e5(v.xyz * exp2(floor(v.w * 40.0 - 20.0))));
    packed_[2u * i + 1u] = uvec4(source, packVoxel(voxel), bitOfVoxel(voxel) | (brickIndex(voxel >> 2, ivec3(256, 256, 256)) << 6));
})");
    constexpr std::size_t kCount = 4096;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec4> values;
    for (std::size_t i = 0; i < kCount; ++i)
        values.emplace_back(unit(random), unit(random), unit(random), unit(random));
    values[0] = {0, 0, 0, 0};
    values[1] = {1, 1, 1, 1};
    values[2] = {0.5f, 1, 0, 0.5f};
    const gl::Buffer in(values, "in");
    const gl::Buffer out(kCount * 32, "out");
    in.bindStorage(8);
    out.bindStorage(9);
    programs().compute("test/pack.comp.glsl").dispatch(static_cast<int>(kCount));
    gl::barrier(gl::Access::ShaderStorage);
    const auto got = out.read<std::uint32_t>(8 * kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        const glm::vec4& v = values[i];
        const glm::vec3 a(v);
        const glm::vec3 b(v.y, v.z, v.x);
        const glm::ivec3 voxel(a * 1023.0f);
        const auto source = voxels::packFaceSource(a * 1000.0f, v.w * 4.0f);
        const std::uint32_t expected[8] = {
            voxels::packOffsetWeight(v.x * 2.0f - 1.0f, v.w * 4.0f),
            voxels::packBounds(glm::min(a, b), glm::max(a, b)),
            voxels::packAlbedo(a),
            voxels::packRgb9e5(a * std::exp2(std::floor(v.w * 40.0f - 20.0f))),
            source[0],
            source[1],
            voxels::packVoxel(voxel),
            voxels::bitOfVoxel(voxel) | (voxels::brickIndex(voxel / 4, glm::ivec3(256)) << 6)};
        for (std::size_t k = 0; k < 8; ++k) {
            if (k == 4 || k == 5) {
                // GLSL leaves the rounding of halves to the driver: one step either way.
                EXPECT_LE(std::abs(static_cast<int>(got[8 * i + k] & 0xffffu) -
                                   static_cast<int>(expected[k] & 0xffffu)),
                          1);
                EXPECT_LE(
                    std::abs(static_cast<int>(got[8 * i + k] >> 16) - static_cast<int>(expected[k] >> 16)),
                    k == 4 ? 1 : 0);
            } else {
                EXPECT_EQ(got[8 * i + k], expected[k]);
            }
            if (HasFailure()) FAIL() << "value " << i << " word " << k;
        }
    }
}

TEST_F(VoxelizeTest, UnpackingFunctionsAndAddressesAgreeInGlsl) {
    addShader("test/unpack.comp.glsl", R"(#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
layout(std430, binding = 8) readonly buffer In { uvec4 bits[]; };
layout(std430, binding = 9) writeonly buffer Out { vec4 values[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    uvec4 b = bits[i];
    values[5u * i] = vec4(unpackOffset(b.x), unpackWeight(b.x), unpackArea(b.xy), float(brickRank(b.xy, b.z & 63u)));
    values[5u * i + 1u] = vec4(unpackAlbedo(b.x), float(faceIndex(b.x, int(b.z % 6u))));
    values[5u * i + 2u] = vec4(unpackRgb9e5(b.y), brickHas(b.xy, b.z & 63u) ? 1.0 : 0.0);
    values[5u * i + 3u] = vec4(unpackBoundsMin(b.x), 0.0);
    ivec3 brick = brickOfIndex(b.w & 0xffffu, ivec3(20, 24, 28));
    values[5u * i + 4u] = vec4(unpackBoundsMax(b.x), float(brickIndex(brick, ivec3(20, 24, 28))));
})");
    constexpr std::size_t kCount = 4096;
    std::mt19937 random(8);
    std::vector<std::uint32_t> bits(4 * kCount);
    for (std::uint32_t& b : bits) b = static_cast<std::uint32_t>(random());
    const gl::Buffer in(bits, "in");
    const gl::Buffer out(kCount * 80, "out");
    in.bindStorage(8);
    out.bindStorage(9);
    programs().compute("test/unpack.comp.glsl").dispatch(static_cast<int>(kCount));
    gl::barrier(gl::Access::ShaderStorage);
    const auto got = out.read<glm::vec4>(5 * kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        const std::uint32_t x = bits[4 * i], y = bits[4 * i + 1], z = bits[4 * i + 2], w = bits[4 * i + 3];
        const std::uint64_t mask = x | (static_cast<std::uint64_t>(y) << 32);
        const std::uint32_t bit = z & 63u;
        const glm::vec4* g = &got[5 * i];
        EXPECT_NEAR(g[0].x, voxels::unpackOffset(x), 1e-6f);
        EXPECT_NEAR(g[0].y, voxels::unpackWeight(x), 1e-6f);
        EXPECT_NEAR(g[0].z, voxels::unpackArea({x, y}), 1e-6f);
        EXPECT_EQ(static_cast<int>(g[0].w), std::popcount(mask & ((std::uint64_t{1} << bit) - 1)));
        const glm::vec3 albedo = voxels::unpackAlbedo(x);
        const glm::vec3 light = voxels::unpackRgb9e5(y);
        glm::vec3 low, high;
        voxels::unpackBounds(x, low, high);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(g[1][k], albedo[k], 1e-6f);
            EXPECT_EQ(g[2][k], light[k]);
            EXPECT_NEAR(g[3][k], low[k], 1e-6f);
            EXPECT_NEAR(g[4][k], high[k], 1e-6f);
        }
        const std::uint32_t direction = z % 6;
        EXPECT_EQ(g[1].w, static_cast<float>((x & 0x3ffffffu) + static_cast<std::uint32_t>(std::popcount(
                                                                    (x >> 26) & ((1u << direction) - 1)))));
        EXPECT_EQ(g[2].w, ((mask >> bit) & 1u) != 0 ? 1.0f : 0.0f);
        const std::uint32_t index = w & 0xffffu;
        if (index < 20 * 24 * 28) {
            EXPECT_EQ(g[4].w, static_cast<float>(index));
        }
        if (HasFailure()) FAIL() << "value " << i;
    }
}

}  // namespace
}  // namespace conelight::test
