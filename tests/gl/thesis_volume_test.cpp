// SPDX-License-Identifier: MIT
// The thesis's volume: what lands in it, whatever the order of threads and the place of the grid.
#include "thesis/render/volume.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <random>
#include "conelight/thesis/settings.h"

#include "conelight/error.h"
#include "support/gl_fixture.h"
#include "thesis/render/cones.h"

namespace conelight::test {
namespace {

using thesis::ThesisVolume;
using thesis::ThesisVolumeOptions;

// A parallelogram as two triangles, white and diffuse, counter-clockwise from `normal`'s side.
void addQuad(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = 0;
    scene.instances.push_back(instance);
}

Scene whiteScene() {
    Scene scene;
    Material material;
    material.phong.emplace().color = glm::vec3(1);
    material.phong->ambientStrength = 0;
    scene.materials.push_back(material);
    Light light;
    light.type = LightType::Directional;
    light.direction = glm::normalize(glm::vec3(0.2f, -1.0f, 0.3f));
    light.intensity = glm::vec3(3.14159265f);
    scene.lights.push_back(light);
    return scene;
}

// A lump of small triangles in all directions.
Scene blobScene() {
    Scene scene = whiteScene();
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    Mesh mesh;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 center =
            0.3f * glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        for (int k = 0; k < 3; ++k) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(center +
                                     0.02f * glm::vec3(normal(random), normal(random), normal(random)));
        }
    }
    scene.meshes.push_back(mesh);
    Instance instance;
    instance.mesh = 0;
    instance.material = 0;
    scene.instances.push_back(instance);
    return scene;
}

ThesisVolumeOptions optionsOf(int size, bool unitGrid = true) {
    ThesisVolumeOptions options;
    options.size = size;
    options.unitGrid = unitGrid;
    options.shadows = false;
    return options;
}

class ThesisVolumeTest : public GlTest {
  protected:
    // All texels of a level.
    std::vector<glm::vec4> build(const Scene& source, const ThesisVolumeOptions& options, int level = 0) {
        const scene::GpuScene scene(source);
        light::Lights lights;
        lights.update(device(), scene, {.emissiveQuads = false, .shadowMaps = false});
        ThesisVolume volume;
        volume.build(device(), {scene, lights}, options);
        return read(volume, level);
    }
    static std::vector<glm::vec4> read(const ThesisVolume& volume, int level) {
        const std::size_t edge = static_cast<std::size_t>(volume.texture().width(level));
        std::vector<glm::vec4> texels(edge * edge * edge);
        volume.texture().read(level, GL_RGBA, GL_FLOAT, texels.data(), texels.size() * sizeof(glm::vec4));
        return texels;
    }
    static double opacitySum(const std::vector<glm::vec4>& texels) {
        double sum = 0;
        for (const glm::vec4& texel : texels) sum += texel.a;
        return sum;
    }
};

}  // namespace

TEST_F(ThesisVolumeTest, OpacityIsProjectedArea) {
    // An axis-aligned rectangle that ends inside voxels: area / h^2, in whatever layers. Half floats cut up
    // to 1/2048 off.
    Scene scene = whiteScene();
    addQuad(scene, {-0.413f, 0.1234f, -0.377f}, {0, 0, 0.711f}, {0.823f, 0, 0});
    for (const int size : {16, 64}) {
        const float h = 2.0f / static_cast<float>(size);
        EXPECT_NEAR(opacitySum(build(scene, optionsOf(size))) * h * h, 0.711 * 0.823, 6e-4 * 0.585) << size;
    }
    // Many triangles thinner than a voxel: not one is lost.
    Scene strips = whiteScene();
    double area = 0;
    for (int i = 0; i < 40; ++i) {
        addQuad(strips, {-0.8f + 0.04f * static_cast<float>(i), -0.31f, -0.5f}, {0, 0, 0.9f}, {0.003f, 0, 0});
        area += 0.9 * 0.003;
    }
    const double h = 2.0 / 32;
    EXPECT_NEAR(opacitySum(build(strips, optionsOf(32))) * h * h, area, 0.01 * area);
    // The original's raster misses most of them.
    ThesisVolumeOptions original = optionsOf(32);
    original.defects.centerCoverage = true;
    const auto occupied = [](const std::vector<glm::vec4>& texels) {
        int count = 0;
        for (const glm::vec4& texel : texels) count += texel.a > 0 ? 1 : 0;
        return count;
    };
    EXPECT_LT(4 * occupied(build(strips, original)), occupied(build(strips, optionsOf(32))));
}

TEST_F(ThesisVolumeTest, RadianceIsTheLightOfTheSurface) {
    Scene scene = whiteScene();
    addQuad(scene, {-0.5f, 0.1f, -0.5f}, {0, 0, 1}, {1, 0, 0});
    const float expected = glm::dot(-scene.lights[0].direction, glm::vec3(0, 1, 0));
    int occupied = 0;
    for (const glm::vec4& texel : build(scene, optionsOf(32)))
        if (texel.a > 1e-3f) {
            ++occupied;
            ASSERT_NEAR(texel.r / texel.a, expected, 2e-3f);
            ASSERT_NEAR(texel.b / texel.a, expected, 2e-3f);
        }
    EXPECT_GE(occupied, 16 * 16);
}

// A slanted sheet: each axis sees the part of its area that its normal says, and one along the sheet nothing. Three
// passes share it, so that it counts as much as along its dominant axis.
TEST_F(ThesisVolumeTest, AxesSeeTheirPartOfASurface) {
    Scene scene = whiteScene();
    addQuad(scene, {-0.413f, 0.1234f, -0.377f}, {0, 0, 0.711f}, {0.8f, 0.3f, 0});
    const double h = 2.0 / 64;
    for (const bool areas : {false, true}) {
        ThesisVolumeOptions options = optionsOf(64);
        options.defects.isotropicOpacity = !areas;
        const auto area = [&](thesis::VoxelizationAxis along) {
            options.along = along;
            return opacitySum(build(scene, options)) * h * h;
        };
        const double dominant = area(thesis::VoxelizationAxis::Dominant);
        EXPECT_NEAR(dominant, 0.711 * 0.8, 6e-3 * dominant);
        EXPECT_EQ(area(thesis::VoxelizationAxis::Y), dominant);
        EXPECT_EQ(area(thesis::VoxelizationAxis::Z), 0);
        // Areas along the axes are rounded up by chance, and a pass along x fills a third of the voxels.
        if (!areas) {
            EXPECT_NEAR(area(thesis::VoxelizationAxis::X), 0.711 * 0.3, 6e-3 * dominant);
        }
        // Where a pass along x puts several columns into one voxel, that is full before all of it is in.
        EXPECT_NEAR(area(thesis::VoxelizationAxis::Three), dominant, 0.03 * dominant);
    }
    // As published, the raster leaves holes along x, which the other passes fill.
    const auto occupied = [&](thesis::VoxelizationAxis along) {
        ThesisVolumeOptions options = optionsOf(64);
        options.defects.centerCoverage = options.defects.racingStores = true;
        options.along = along;
        int count = 0;
        for (const glm::vec4& texel : build(scene, options)) count += texel.a > 0 ? 1 : 0;
        return count;
    };
    const int dominant = occupied(thesis::VoxelizationAxis::Dominant);
    EXPECT_LT(occupied(thesis::VoxelizationAxis::X), dominant / 2);
    EXPECT_EQ(occupied(thesis::VoxelizationAxis::Y), dominant);
    EXPECT_GE(occupied(thesis::VoxelizationAxis::Three), dominant);
}

TEST_F(ThesisVolumeTest, PlanesKeepTheirOpacityInCoarseLevels) {
    Scene scene = whiteScene();
    addQuad(scene, {-0.75f, 0.03f, -0.75f}, {0, 0, 1.5f}, {1.5f, 0, 0});
    // Through the middle of the plane: opacities of all layers together.
    const auto column = [](const std::vector<glm::vec4>& texels, int edge) {
        float sum = 0;
        for (int y = 0; y < edge; ++y)
            sum += texels[static_cast<std::size_t>((edge / 2 * edge + y) * edge + edge / 2)].a;
        return sum;
    };
    ThesisVolumeOptions faded = optionsOf(64);
    faded.defects.volumeMips = true;
    for (int level = 0; level <= 4; ++level) {
        EXPECT_NEAR(column(build(scene, optionsOf(64), level), 64 >> level), 1.0f, 0.01f) << level;
        EXPECT_NEAR(column(build(scene, faded, level), 64 >> level), std::exp2(-static_cast<float>(level)),
                    0.01f)
            << level;
    }
}

TEST_F(ThesisVolumeTest, SameBitsEveryTime) {
    const Scene scene = blobScene();
    for (const bool original : {false, true}) {
        ThesisVolumeOptions options = optionsOf(64, false);
        if (original) {
            // All that concerns the volume but the racing stores themselves.
            options.defects.centerCoverage = options.defects.binaryOpacity = options.defects.faceRounding =
                true;
            options.defects.clippedRadiance = options.defects.volumeMips = true;
        }
        for (const int level : {0, 3}) {
            const std::vector<glm::vec4> first = build(scene, options, level);
            const std::vector<glm::vec4> second = build(scene, options, level);
            ASSERT_EQ(first.size(), second.size());
            EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(glm::vec4)), 0)
                << original;
            EXPECT_GT(opacitySum(first), 1.0);
        }
    }
}

TEST_F(ThesisVolumeTest, BuildingAgainLeavesNothingBehind) {
    const Scene blob = blobScene();
    Scene plane = whiteScene();
    addQuad(plane, {-0.25f, 0.1f, -0.25f}, {0, 0, 0.5f}, {0.5f, 0, 0});
    ThesisVolume used, fresh;
    const scene::GpuScene blobTables(blob), planeTables(plane);
    light::Lights blobLights, planeLights;
    blobLights.update(device(), blobTables, {.shadowMaps = false});
    planeLights.update(device(), planeTables, {.shadowMaps = false});
    used.build(device(), {blobTables, blobLights}, optionsOf(32));
    used.build(device(), {planeTables, planeLights}, optionsOf(32));
    fresh.build(device(), {planeTables, planeLights}, optionsOf(32));
    for (int level = 0; level < 6; ++level) {
        const std::vector<glm::vec4> a = read(used, level), b = read(fresh, level);
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec4)), 0) << level;
    }
}

TEST_F(ThesisVolumeTest, AHairOfShiftMovesAHairOfOpacity) {
    // A wall on a voxel face, as the walls of the thesis's rooms lie for every size, and 1e-6 beside it.
    const auto wall = [](float x) {
        Scene scene = whiteScene();
        addQuad(scene, {x, -0.5f, -0.5f}, {0, 0, 1}, {0, 1, 0});
        return scene;
    };
    const auto difference = [](const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i].a - b[i].a);
        return sum;
    };
    const double whole = 32 * 32;  // voxels of one layer
    EXPECT_LT(difference(build(wall(0.5f), optionsOf(64)), build(wall(0.499999f), optionsOf(64))),
              0.01 * whole);
    ThesisVolumeOptions original = optionsOf(64);
    original.defects.faceRounding = true;
    EXPECT_GT(difference(build(wall(0.5f), original), build(wall(0.499999f), original)), 1.9 * whole);
}

TEST_F(ThesisVolumeTest, TrianglesLargerThanTheGrid) {
    // A plane that cuts the whole of [-1,1]^3 obliquely, far beyond it on all sides.
    Scene scene = whiteScene();
    addQuad(scene, {-40, -1.3f, -40}, {0, 0, 80}, {80, 2.4f, 0});
    const std::vector<glm::vec4> texels = build(scene, optionsOf(32));
    // Dominant axis y: every column of the grid is covered once where the plane is inside.
    for (int z = 2; z < 30; ++z)
        for (int x = 2; x < 30; ++x) {
            float sum = 0;
            for (int y = 0; y < 32; ++y) sum += texels[static_cast<std::size_t>((z * 32 + y) * 32 + x)].a;
            ASSERT_NEAR(sum, 1.0f, 0.01f) << x << " " << z;
        }
}

TEST_F(ThesisVolumeTest, GridHoldsTheSceneAndHalvesEvenly) {
    Aabb box;
    box.grow(glm::vec3(-3, 1, 0));
    box.grow(glm::vec3(5, 2, 4));
    for (const int size : {8, 12, 36, 64, 100, 128, 256, 512}) {
        const gpu::ThesisGrid grid = ThesisVolume::fitGrid(box, optionsOf(size, false));
        EXPECT_GE(grid.size, static_cast<float>(size));
        EXPECT_EQ(static_cast<int>(grid.size) % (1 << static_cast<int>(grid.maxLevel)), 0);
        EXPECT_NEAR(grid.voxelSize * grid.size, grid.edge, 1e-4f);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(grid.origin[axis] + grid.voxelSize, box.min[axis] + 1e-4f) << size;
            EXPECT_GE(grid.origin[axis] + grid.edge - grid.voxelSize, box.max[axis] - 1e-4f) << size;
            EXPECT_EQ(grid.boxMin[axis] % THESIS_BRICK, 0);
            EXPECT_EQ(grid.boxSize[axis] % THESIS_BRICK, 0);
            EXPECT_LE(grid.boxMin[axis] + grid.boxSize[axis], static_cast<int>(grid.size));
        }
    }
}

// The original's tables, and what replaces them.
TEST(ThesisConstantsTest, AutomaticNumbersFollowTheTable) {
    thesis::ThesisSettings published;
    published.published = true;
    gpu::ThesisGrid grid{};
    grid.voxelSize = 0.01f;
    const auto spread = [](float aperture) { return 2.0f * std::tan(0.5f * aperture); };
    const struct {
        int size;
        float diffuseFactor, occlusionFactor, specularFactor, specularOffset, specularAperture, falloff;
    } table[] = {{64, 0.1f, 0.35f, 0.8f, 0.15f, 0.04f, 3},
                 {128, 0.01f, 0.35f, 0.3f, 0.15f, 0.02f, 3},
                 {256, 0.1f, 0.1f, 0.15f, 0.05f, 0.01f, 2}};
    for (const auto& row : table) {
        const gpu::ThesisConstants c = thesis::thesisConstants(published, grid, row.size);
        EXPECT_FLOAT_EQ(c.diffuseCone.y, row.diffuseFactor);
        EXPECT_FLOAT_EQ(c.occlusionCone.y, row.occlusionFactor);
        EXPECT_FLOAT_EQ(c.specularCone.y, row.specularFactor);
        EXPECT_FLOAT_EQ(c.specularCone.z, row.specularOffset);
        EXPECT_FLOAT_EQ(c.specularCone.x, spread(row.specularAperture));
        EXPECT_FLOAT_EQ(c.diffuseCone.x, spread(0.55f));
        EXPECT_FLOAT_EQ(c.occlusionCone.x, spread(0.4f));
        EXPECT_FLOAT_EQ(c.diffuseCone.z, 0.19f);
        EXPECT_FLOAT_EQ(c.occlusionCone.z, 0.08f);
        EXPECT_FLOAT_EQ(c.originOffset, 0.05f);
        EXPECT_FLOAT_EQ(c.shininessFalloff, row.falloff);
    }
    // Between the tuned sizes the numbers lie between.
    const float between = thesis::thesisConstants(published, grid, 96).specularCone.y;
    EXPECT_GT(between, 0.3f);
    EXPECT_LT(between, 0.8f);
    // A number wins over the table.
    published.diffuse.aperture = {false, 0.7f};
    EXPECT_FLOAT_EQ(thesis::thesisConstants(published, grid, 64).diffuseCone.x, spread(0.7f));
}

TEST(ThesisConstantsTest, MarchesThatWouldNotEndAreRefused) {
    Settings settings;
    for (const char* cone : {"diffuse", "specular", "occlusion"})
        for (const char* name : {"offset", "aperture", "dist_factor"})
            for (const char* value : {"0", "-1", "nan", "x"})
                EXPECT_THROW(setSetting(settings, std::string("thesis.") + cone + "." + name, value), Error)
                    << cone << "." << name << " = " << value;
    EXPECT_THROW(setSetting(settings, "thesis.max_samples", "0"), Error);
    // Also when set past the list of settings.
    thesis::ThesisSettings direct;
    direct.specular.offset = {false, 0.0f};
    EXPECT_THROW(thesis::thesisConstants(direct, gpu::ThesisGrid{}, 64), Error);
}

}  // namespace conelight::test
