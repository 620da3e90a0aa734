// SPDX-License-Identifier: MIT
// Which small bulbs become lights, and what the tables hold then.
#include "scene/small_lamps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "io/generated.h"
#include "light/lights.h"
#include "light/shadow_layout.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr float kRadius = 0.03f;
const glm::vec3 kPlace(0.5f, 1, -0.25f);

glm::mat4 bulbAt(const glm::vec3& place, const glm::vec3& size = glm::vec3(kRadius)) {
    return glm::scale(glm::translate(glm::mat4(1), place), size);
}

Material glow() { return diffuseMaterial(glm::vec3(0), {3, 2, 1}); }

// A floor of 4 m, and a bulb over it: less than two of 128 voxels wide.
Scene bulbScene(const Mesh& mesh = sphereMesh(24, 12), const glm::mat4& placed = bulbAt(kPlace)) {
    Scene scene;
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), diffuseMaterial());
    addInstance(scene, mesh, glow(), placed);
    return scene;
}

TEST(EmissiveSpheresTest, ABulbBecomesALightOfItsArea) {
    const Scene scene = bulbScene();
    const auto spheres = scene::smallLamps(scene);
    ASSERT_EQ(spheres.size(), 1u);
    EXPECT_EQ(spheres[0].instance, 1u);
    const Light& light = spheres[0].light;
    EXPECT_EQ(light.type, LightType::Sphere);
    EXPECT_EQ(light.intensity, glm::vec3(3, 2, 1));
    EXPECT_NEAR(glm::length(light.position - kPlace), 0, 1e-5f);
    const Mesh& mesh = scene.meshes[1];
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        area += 0.5 * static_cast<double>(glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                                                 mesh.positions[mesh.indices[i + 2]] - a)));
    }
    const double radius = static_cast<double>(kRadius) * std::sqrt(area / (4 * std::numbers::pi));
    EXPECT_NEAR(static_cast<double>(glm::length(light.halfU)) / radius, 1, 1e-4);
    EXPECT_LT(light.halfU.x, kRadius);
}

TEST(EmissiveSpheresTest, CoarseAndMirroredBallsAreBallsToo) {
    EXPECT_EQ(scene::smallLamps(bulbScene(sphereMesh(8, 5))).size(), 1u);
    const Mesh ball = sphereMesh(16, 8);
    Mesh inside = ball;
    for (std::size_t i = 0; i < inside.indices.size(); i += 3)
        std::swap(inside.indices[i], inside.indices[i + 1]);
    const glm::mat4 mirrored = bulbAt(kPlace, kRadius * glm::vec3(1, -1, 1));
    EXPECT_EQ(scene::smallLamps(bulbScene(ball, mirrored)).size(), 1u);
    EXPECT_EQ(scene::smallLamps(bulbScene(inside)).size(), 0u);  // shines inwards
}

TEST(EmissiveSpheresTest, OthersAreLeftToTheVoxels) {
    const Mesh ball = sphereMesh(24, 12);
    EXPECT_EQ(scene::smallLamps(bulbScene(ball, bulbAt(kPlace, kRadius * glm::vec3(1, 1.1f, 1)))).size(), 0u);
    EXPECT_EQ(scene::smallLamps(bulbScene(ball, bulbAt(kPlace, glm::vec3(0.04f)))).size(), 0u);  // wide
    Mesh open = ball;
    open.indices.resize(open.indices.size() * 9 / 10);
    EXPECT_EQ(scene::smallLamps(bulbScene(open)).size(), 0u);
    const auto with = [](const std::function<void(Instance&, Material&)>& change) {
        Scene scene = bulbScene();
        change(scene.instances[1], scene.materials[1]);
        return scene::smallLamps(scene).size();
    };
    EXPECT_EQ(with([](Instance&, Material&) {}), 1u);
    EXPECT_EQ(with([](Instance& i, Material&) { i.visible = false; }), 0u);
    EXPECT_EQ(with([](Instance& i, Material&) { i.voxelized = false; }), 0u);
    EXPECT_EQ(with([](Instance&, Material& m) { m.emission = glm::vec3(0); }), 0u);
    EXPECT_EQ(with([](Instance&, Material& m) { m.unlit = true; }), 0u);
    EXPECT_EQ(with([](Instance&, Material& m) { m.emissiveTexture.texture = 0; }), 0u);
}

TEST(EmissiveSpheresTest, ManyBulbsAreLeftToTheVoxels) {
    Scene scene = bulbScene();
    for (std::size_t i = 1; i <= scene::kMostEmissiveSpheres; ++i) {
        EXPECT_EQ(scene::smallLamps(scene).size(), i);
        scene.instances.push_back(scene.instances[1]);
    }
    EXPECT_EQ(scene::smallLamps(scene).size(), 0u);
}

class EmissiveSphereTableTest : public GlTest {};

TEST_F(EmissiveSphereTableTest, TablesFollowTheSwitch) {
    scene::GpuScene gpuScene(bulbScene());
    light::Lights lights;
    lights.update(device(), gpuScene, {.smallLamps = true});
    ASSERT_EQ(lights.table().size(), 1u);
    EXPECT_EQ(lights.table()[0].type, LIGHT_RECT);
    EXPECT_EQ(lights.table()[0].flags & (LIGHT_SPHERE | LIGHT_FROM_EMITTER),
              LIGHT_SPHERE | LIGHT_FROM_EMITTER);
    EXPECT_TRUE(lights.areInTable(1));
    EXPECT_FALSE(lights.areInTable(0));
    lights.update(device(), gpuScene, {.smallLamps = false});
    EXPECT_TRUE(lights.table().empty());
    EXPECT_FALSE(lights.areInTable(1));
}

// Wires of a cage and the bulb share voxels, whose faces hold light of both. None of the bulb's is left there: it would
// come twice.
TEST_F(EmissiveSphereTableTest, VoxelsLeaveItsLightOut) {
    Scene scene = io::generateScene("cellar");
    scene.sky = glm::vec3(0);
    scene.lights.clear();
    for (Material& material : scene.materials) {
        material.baseColor = {0, 0, 0, 1};
        material.metallic = material.specular = 0;
    }
    for (const bool spheres : {false, true}) {
        CacheRig rig(programs(), scene, 128);
        rig.light.smallLamps = spheres;
        rig.relight();
        const auto faces = rig.faces();
        const auto shining = std::count_if(faces.begin(), faces.end(),
                                           [](const CachedFace& face) { return face.radiance.r > 0; });
        EXPECT_EQ(shining > 0, !spheres) << shining;
    }
}

// The points that maps are drawn from lie within the ball: it alone casts no shadow into them.
TEST_F(EmissiveSphereTableTest, ABulbDoesNotHideItself) {
    const Scene scene = bulbScene();
    scene::GpuScene gpuScene(scene);
    light::Lights lights;
    lights.update(device(), gpuScene, {.smallLamps = true});
    std::vector<gpu::Light> table = lights.table();
    const light::ShadowLayout layout = light::layOutShadows(scene.bounds(), scene.bounds(), {}, table);
    ASSERT_EQ(layout.views.size(), 96u);
    for (const light::ShadowView& view : layout.views) EXPECT_EQ(view.without, 1);
}

}  // namespace
}  // namespace conelight::test
