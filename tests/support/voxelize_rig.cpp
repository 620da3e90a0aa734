// SPDX-License-Identifier: MIT
#include "support/voxelize_rig.h"

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <unordered_set>

#include "scene/gpu_scene.h"

namespace conelight::test {
namespace {

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

}  // namespace

int addDiffuseMaterial(Scene& scene, const glm::vec3& albedo, bool doubleSided) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1);
    material.specular = 0;  // diffuse: reflects what its colour says
    material.doubleSided = doubleSided;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void addInstance(Scene& scene, Mesh mesh, int material, const glm::mat4& worldFromObject) {
    scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = material;
    instance.worldFromObject = worldFromObject;
    scene.instances.push_back(instance);
}

Mesh squareMesh(float repeats) {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Scene rotatedBox() {
    Scene scene;
    const glm::mat4 turn = glm::rotate(glm::rotate(glm::mat4(1), 0.7f, {0.3f, 1, 0.2f}), 0.4f, {1, 0, 0.5f});
    addInstance(scene, boxMesh(), addDiffuseMaterial(scene, {0.25f, 0.5f, 0.75f}), turn);
    return scene;
}

Scene torus() {
    Scene scene;
    addInstance(scene, torusMesh(90, 40), addDiffuseMaterial(scene, {0.9f, 0.1f, 0.4f}),
                glm::rotate(glm::mat4(1), 0.5f, {1, 0.2f, 0.1f}));
    return scene;
}

bool VoxelizeResult::has(const glm::ivec3& voxel) const {
    const std::uint32_t* word = &brickWords[4 * voxels::brickIndex(voxel / 4, grid.bricks())];
    const std::uint32_t bit = voxels::bitOfVoxel(voxel);
    return ((word[bit / 32] >> (bit % 32)) & 1u) != 0;
}

std::uint64_t VoxelizeResult::hash() const {
    std::uint64_t h = 1469598103934665603u;
    const auto add = [&](const void* data, std::size_t bytes) {
        for (std::size_t i = 0; i < bytes; ++i)
            h = (h ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211u;
    };
    add(brickWords.data(), 4 * brickWords.size());
    add(records.data(), 4 * records.size());
    add(faces.data(), sizeof(gpu::FaceRecord) * faces.size());
    add(materials.data(), sizeof(gpu::FaceMaterial) * materials.size());
    add(bricks.data(), 4 * bricks.size());
    return h;
}

VoxelizeResult download(const voxels::SurfaceVoxels& surface) {
    VoxelizeResult r;
    r.grid = surface.grid();
    r.brickWords.resize(4 * r.grid.brickCount());
    surface.brickWords().read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, r.brickWords.data(),
                              4 * r.brickWords.size());
    r.records = surface.records().read<std::uint32_t>(surface.voxelCount());
    r.faces = surface.faces().read<gpu::FaceRecord>(surface.faceCount());
    r.materials = surface.faceMaterials().read<gpu::FaceMaterial>(surface.faceCount());
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

VoxelizeResult VoxelizeTest::voxelize(const Scene& scene, int size, float padding) {
    const scene::GpuScene gpuScene(scene);
    voxels::SurfaceVoxels surface;
    surface.build(device(), gpuScene, VoxelSettings{size, padding});
    return download(surface);
}

VoxelizeResult VoxelizeTest::voxelize(const Scene& scene, const voxels::VoxelGrid& grid) {
    const scene::GpuScene gpuScene(scene);
    voxels::SurfaceVoxels surface;
    surface.build(device(), gpuScene, grid);
    return download(surface);
}

void VoxelizeTest::expectSameVoxels(const Scene& scene, const VoxelizeResult& result) {
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

}  // namespace conelight::test
