// SPDX-License-Identifier: MIT
// Which emitters become lights, and what the tables hold then.
#include "light/lights.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/emissive_quads.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

Material emitter() {
    Material material;
    material.emission = {3, 2, 1};
    return material;
}

TEST(EmissiveQuadsTest, AParallelogramBecomesALightOfItsFront) {
    Scene scene;
    glm::mat4 placed = glm::translate(glm::mat4(1), glm::vec3(0, 5, 0));
    addInstance(scene, quadMesh({-1, 0, -2}, {2, 0, 0}, {0, 0, 4}), emitter(), placed);
    const auto quads = scene::emissiveQuads(scene);
    ASSERT_EQ(quads.size(), 1u);
    const Light& light = quads[0].light;
    EXPECT_EQ(light.type, LightType::Rect);
    EXPECT_EQ(light.intensity, glm::vec3(3, 2, 1));
    EXPECT_NEAR(glm::length(light.position - glm::vec3(0, 5, 0)), 0, 1e-6f);
    EXPECT_NEAR(glm::length(light.direction - glm::vec3(0, -1, 0)), 0, 1e-6f);
    EXPECT_NEAR(4 * glm::length(glm::cross(light.halfU, light.halfV)), 8, 1e-5f);
    // Mirrored: still the object's front. y -> -y turns it up.
    scene.instances[0].worldFromObject = glm::scale(placed, glm::vec3(1, -1, 1));
    EXPECT_NEAR(scene::emissiveQuads(scene)[0].light.direction.y, 1, 1e-6f);
    scene.instances[0].worldFromObject = glm::scale(placed, glm::vec3(-1, 1, 1));
    EXPECT_NEAR(scene::emissiveQuads(scene)[0].light.direction.y, -1, 1e-6f);
    scene.materials[0].doubleSided = true;
    EXPECT_EQ(scene::emissiveQuads(scene).size(), 2u);
}

TEST(EmissiveQuadsTest, EveryOrderOfIndicesIsUnderstood) {
    for (std::uint32_t i = 0; i < 3; ++i)
        for (std::uint32_t j = 0; j < 3; ++j) {
            Scene scene;
            Mesh mesh = quadMesh({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
            const std::uint32_t first[3] = {0, 1, 2}, second[3] = {0, 2, 3};
            mesh.indices.clear();
            for (std::uint32_t k = 0; k < 3; ++k) mesh.indices.push_back(first[(i + k) % 3]);
            for (std::uint32_t k = 0; k < 3; ++k) mesh.indices.push_back(second[(j + k) % 3]);
            addInstance(scene, mesh, emitter());
            const auto quads = scene::emissiveQuads(scene);
            ASSERT_EQ(quads.size(), 1u) << i << ' ' << j;
            EXPECT_NEAR(quads[0].light.direction.z, 1, 1e-6f);
            EXPECT_NEAR(4 * glm::length(glm::cross(quads[0].light.halfU, quads[0].light.halfV)), 2, 1e-5f);
        }
}

TEST(EmissiveQuadsTest, OthersAreLeftToTheVoxels) {
    Scene scene;
    const Mesh quad = quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Mesh trapezium = quad, bent = quad, opposite = quad;
    trapezium.positions[2].x = 0.5f;
    bent.positions[2].z = 0.3f;
    opposite.indices = {0, 1, 2, 0, 3, 2};  // the second triangle faces away
    for (const Mesh& mesh : {trapezium, bent, opposite}) addInstance(scene, mesh, emitter());
    addInstance(scene, quad, Material{});
    addInstance(scene, quad, emitter());
    scene.instances.back().visible = false;
    Material textured = emitter();
    textured.emissiveTexture.texture = 0;
    addInstance(scene, quad, textured);
    addInstance(scene, quad, emitter(), glm::scale(glm::mat4(1), glm::vec3(1, 0, 1)));
    EXPECT_EQ(scene::emissiveQuads(scene).size(), 0u);
}

class EmissiveQuadTableTest : public GlTest {};

TEST_F(EmissiveQuadTableTest, TablesFollowTheSwitch) {
    Scene scene;
    addInstance(scene, quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), emitter());
    scene.lights.emplace_back();
    scene::GpuScene gpuScene(scene);
    light::Lights lights;
    for (int round = 0; round < 2; ++round) {
        lights.update(device(), gpuScene, {.emissiveQuads = true});
        ASSERT_EQ(lights.table().size(), 2u);
        EXPECT_EQ(lights.table()[1].type, LIGHT_RECT);
        EXPECT_TRUE(lights.areInTable(0));
        lights.update(device(), gpuScene, {.emissiveQuads = false});
        EXPECT_EQ(lights.table().size(), 1u);
        EXPECT_FALSE(lights.areInTable(0));
    }
}

// Returns at once where nothing changed, and sees each change that lights are made from.
TEST_F(EmissiveQuadTableTest, LightsAreMadeAnewWhereSomethingChanged) {
    Scene scene;
    addInstance(scene, quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), Material{});
    scene.lights.emplace_back();
    scene::GpuScene gpuScene(scene);
    light::Lights lights;
    light::LightsWanted wanted;
    EXPECT_FALSE(lights.revision());
    const auto changes = [&] {
        const base::Revision before = lights.revision();
        lights.update(device(), gpuScene, wanted);
        return lights.revision() != before;
    };
    EXPECT_TRUE(changes());
    EXPECT_FALSE(changes());
    gpuScene.setSky(glm::vec3(1));
    EXPECT_TRUE(changes());
    gpuScene.setLights(scene.lights);
    EXPECT_TRUE(changes());
    Instance moved = scene.instances[0];
    moved.worldFromObject[3].x = 1;
    gpuScene.setInstance(0, moved);
    EXPECT_TRUE(changes());
    gpuScene.setInstance(0, moved);
    EXPECT_FALSE(changes());
    gpuScene.setMaterial(0, scene.materials[0]);
    EXPECT_TRUE(changes());
    wanted.settings.shadowFilter = 1;
    EXPECT_TRUE(changes());
    wanted.shadowMaps = false;
    EXPECT_TRUE(changes());
    EXPECT_FALSE(changes());
}

}  // namespace
}  // namespace conelight::test
