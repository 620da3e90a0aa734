// SPDX-License-Identifier: MIT
// Which thin boxes that shine become lights, and what the tables hold then.
#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "light/lights.h"
#include "light/shadow_layout.h"
#include "scene/small_lamps.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

const glm::vec3 kHalf(0.3f, 0.025f, 0.1f);
const glm::vec3 kPlace(0.5f, 1, -0.25f);

glm::mat4 boxAt(const glm::vec3& place, const glm::vec3& half = kHalf) {
    return glm::scale(glm::translate(glm::mat4(1), place), half);
}

// A floor of 4 m, and a box over it that is less than two of 128 voxels thick.
Scene boxScene(const Mesh& mesh = boxMesh(), const glm::mat4& placed = boxAt(kPlace)) {
    Scene scene;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), diffuseMaterial());
    addInstance(scene, mesh, diffuseMaterial(glm::vec3(0), {3, 2, 1}), placed);
    return scene;
}

Mesh flipped(Mesh mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
    return mesh;
}

// Sides whose sum of areas is that of the box, each looking outwards.
void expectSides(const std::vector<scene::SmallLamp>& lamps, const glm::mat4& placed) {
    ASSERT_EQ(lamps.size(), 6u);
    const auto edge = [&](int axis) { return 2.0f * glm::vec3(placed[axis]); };
    float whole = 0;
    for (int axis = 0; axis < 3; ++axis)
        whole += 2 * glm::length(glm::cross(edge(axis), edge((axis + 1) % 3)));
    float sum = 0;
    for (const scene::SmallLamp& lamp : lamps) {
        const Light& side = lamp.light;
        EXPECT_EQ(lamp.instance, 1u);
        EXPECT_EQ(side.type, LightType::Rect);
        EXPECT_EQ(side.intensity, glm::vec3(3, 2, 1));
        EXPECT_GT(glm::dot(side.position - glm::vec3(placed[3]), side.direction), 0);
        EXPECT_NEAR(glm::dot(side.direction, side.halfU), 0, 1e-5f);
        EXPECT_NEAR(glm::dot(side.direction, side.halfV), 0, 1e-5f);
        sum += 4 * glm::length(glm::cross(side.halfU, side.halfV));
    }
    EXPECT_NEAR(sum / whole, 1, 1e-4f);
}

TEST(EmissiveBoxesTest, ABoxBecomesALightForEachSide) {
    const glm::mat4 turned = boxAt(kPlace) * glm::rotate(glm::mat4(1), 0.7f, glm::vec3(0.3f, 1, 0.2f));
    glm::mat4 sheared = boxAt(kPlace);
    sheared[1] += glm::vec4(0.02f, 0, 0, 0);
    const glm::mat4 mirrored = boxAt(kPlace, kHalf * glm::vec3(1, -1, 1));
    for (const glm::mat4& placed : {boxAt(kPlace), turned, sheared, mirrored})
        expectSides(scene::smallLamps(boxScene(boxMesh(), placed)), placed);
}

// Files may have been put in another order for a cache of vertices.
TEST(EmissiveBoxesTest, TrianglesMayComeInAnyOrder) {
    Mesh mesh = boxMesh();
    const std::size_t count = mesh.triangleCount();
    std::vector<std::uint32_t> mixed;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < 3; ++k) mixed.push_back(mesh.indices[3 * (5 * i % count) + k]);
    mesh.indices = mixed;
    expectSides(scene::smallLamps(boxScene(mesh)), boxAt(kPlace));
}

TEST(EmissiveBoxesTest, OthersAreLeftToTheVoxels) {
    const auto lampsOf = [](const Mesh& mesh, const glm::mat4& placed = boxAt(kPlace)) {
        return scene::smallLamps(boxScene(mesh, placed)).size();
    };
    EXPECT_EQ(lampsOf(boxMesh()), 6u);
    EXPECT_EQ(lampsOf(flipped(boxMesh())), 0u);                         // shines inwards
    EXPECT_EQ(lampsOf(boxMesh(), boxAt(kPlace, glm::vec3(0.1f))), 0u);  // thick
    EXPECT_EQ(lampsOf(boxMesh(), boxAt(kPlace, {0.3f, 0, 0.1f})), 0u);  // flat
    Mesh open = boxMesh();
    open.indices.resize(open.indices.size() - 6);
    EXPECT_EQ(lampsOf(open), 0u);
    // Two of its sides apart from the others.
    Mesh apart = boxMesh();
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::vec3 place = apart.positions[apart.indices[i]];
        apart.indices[i] = static_cast<std::uint32_t>(apart.positions.size());
        apart.positions.push_back(1.1f * place);
    }
    EXPECT_EQ(lampsOf(apart), 0u);
    const auto with = [](const std::function<void(Instance&, Material&)>& change) {
        Scene scene = boxScene();
        change(scene.instances[1], scene.materials[1]);
        return scene::smallLamps(scene).size();
    };
    EXPECT_EQ(with([](Instance& i, Material&) { i.visible = false; }), 0u);
    EXPECT_EQ(with([](Instance& i, Material&) { i.voxelized = false; }), 0u);
    EXPECT_EQ(with([](Instance&, Material& m) { m.emission = glm::vec3(0); }), 0u);
    EXPECT_EQ(with([](Instance&, Material& m) { m.emissiveTexture.texture = 0; }), 0u);
}

TEST(EmissiveBoxesTest, ManyBoxesAreLeftToTheVoxels) {
    Scene scene = boxScene();
    for (std::size_t i = 1; i <= scene::kMostEmissiveBoxes; ++i) {
        EXPECT_EQ(scene::smallLamps(scene).size(), 6 * i);
        scene.instances.push_back(scene.instances[1]);
    }
    EXPECT_EQ(scene::smallLamps(scene).size(), 0u);
}

class EmissiveBoxTableTest : public GlTest {};

// All sides that are seen from a place have about as many points as one light.
TEST_F(EmissiveBoxTableTest, SidesSharePointsByArea) {
    const auto pointsOf = [&](const glm::vec3& half) {
        const Scene scene = boxScene(boxMesh(), boxAt(kPlace, half));
        scene::GpuScene gpuScene(scene);
        light::Lights lights;
        lights.update(device(), gpuScene, {.smallLamps = true});
        EXPECT_TRUE(lights.areInTable(1));
        std::vector<gpu::Light> table = lights.table();
        light::layOutShadows(scene.bounds(), scene.bounds(), {}, table);
        std::vector<int> points;
        for (const gpu::Light& side : table) {
            EXPECT_EQ(side.flags & (LIGHT_SIDE | LIGHT_FROM_EMITTER), LIGHT_SIDE | LIGHT_FROM_EMITTER);
            points.push_back(static_cast<int>(side.sampleGrid * side.sampleGrid));
        }
        std::sort(points.begin(), points.end());
        return points;
    };
    EXPECT_EQ(pointsOf(kHalf), (std::vector<int>{4, 4, 4, 4, 16, 16}));
    EXPECT_EQ(pointsOf(glm::vec3(0.025f)), std::vector<int>(6, 9));
}

// Voxels at its edges hold light of several sides, in faces that look another way than these.
TEST_F(EmissiveBoxTableTest, VoxelsLeaveItsLightOut) {
    Scene scene = boxScene(boxMesh(), glm::translate(glm::mat4(1), kPlace) *
                                          glm::rotate(glm::mat4(1), 0.7f, glm::vec3(0.3f, 1, 0.2f)) *
                                          boxAt(glm::vec3(0)));
    scene.materials[0] = diffuseMaterial(glm::vec3(0));
    for (const bool lamps : {false, true}) {
        CacheRig rig(programs(), scene, 128);
        rig.light.smallLamps = lamps;
        rig.relight();
        const auto faces = rig.faces();
        const auto shining = std::count_if(faces.begin(), faces.end(),
                                           [](const CachedFace& face) { return face.radiance.r > 0; });
        EXPECT_EQ(shining > 0, !lamps) << shining;
    }
}

}  // namespace
}  // namespace conelight::test
