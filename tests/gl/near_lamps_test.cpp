// SPDX-License-Identifier: MIT
// Light of lamps on voxels about them against what the lamp sends.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "light/inject_light.h"
#include "light/near_lamps.h"
#include "support/cache_rig.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

// A box of [-1,1]^3 seen from its inside.
Mesh housing() {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 k(0), u(0), v(0);
            k[axis] = side;
            u[(axis + 1) % 3] = -side;
            v[(axis + 2) % 3] = 1;
            const Mesh quad = quadMesh(k - u - v, 2.0f * u, 2.0f * v);
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(), quad.positions.begin(), quad.positions.end());
            for (const std::uint32_t i : quad.indices) mesh.indices.push_back(first + i);
        }
    return mesh;
}

// Housings as large as `halves`, in voxels, about a lamp off their middle, in a large dark room.
Scene housed(const glm::vec3& lamp, LightType type, std::initializer_list<float> halves) {
    const glm::mat4 askew = glm::rotate(glm::rotate(glm::mat4(1), 0.7f, {0.3f, 1, 0.2f}), 0.4f, {1, 0, 0.5f});
    Scene scene;
    addInstance(scene, housing(), diffuseMaterial(glm::vec3(0)), glm::scale(glm::mat4(1), glm::vec3(14)));
    for (const float half : halves)
        addInstance(scene, housing(), diffuseMaterial(glm::vec3(0.5f)),
                    glm::translate(glm::mat4(1), lamp) * askew * glm::scale(glm::mat4(1), glm::vec3(half)));
    Light light;
    light.type = type;
    light.position = lamp + glm::vec3(0.1f, 0.15f, -0.05f);
    light.intensity = glm::vec3(3);
    light.direction = {0, 0, -1};
    light.innerAngle = light.outerAngle = glm::radians(30.0f);
    scene.lights.push_back(light);
    return scene;
}

class NearLampsTest : public GlTest {
  protected:
    // Flux on all faces, before and after.
    struct Flux {
        double atMiddles, ofTriangles;
    };
    Flux fluxOf(const Scene& scene) {
        CacheRig rig(programs(), scene, 32);
        Flux flux{arriving(rig), 0};
        const light::NearLampInputs inputs{rig.scene, rig.lights, rig.voxels, rig.directLight};
        light::lightNearLamps(rig.device, inputs, rig.lit);
        light::lightNearBulbs(rig.device, inputs, rig.lit);
        flux.ofTriangles = arriving(rig);
        return flux;
    }

  private:
    static double arriving(const CacheRig& rig) {
        double sum = 0;
        for (const CachedFace& face : rig.faces())
            if (face.albedo.g > 0)
                sum += glm::pi<double>() * static_cast<double>(face.radiance.g / face.albedo.g * face.area);
        return sum;
    }
};

// A housing of a voxel and a half in six places of the grid gets all that its lamp sends. At the middles of faces it
// would get another light in each place.
TEST_F(NearLampsTest, AHousingGetsAllThatItsLampSends) {
    const double sent = 3 * 4 * glm::pi<double>();
    double worst = 0;
    for (int place = 0; place < 3; ++place) {
        const glm::vec3 lamp = glm::vec3(0.1f, -0.3f, 0.35f) * float(place + 1);
        const Flux flux = fluxOf(housed(lamp, LightType::Point, {0.7f}));
        EXPECT_NEAR(flux.ofTriangles / sent, 1, 0.01) << place;
        worst = std::max(worst, std::abs(flux.atMiddles / sent - 1));
    }
    EXPECT_GT(worst, 0.1);
}

// The same of a ball of light of a fifth of a voxel.
TEST_F(NearLampsTest, AHousingGetsAllThatItsBulbSends) {
    const double sent = 4 * glm::pi<double>() * glm::pi<double>() * 0.01 * 3;
    double worst = 0;
    for (int place = 0; place < 3; ++place) {
        Scene scene = housed(glm::vec3(0.1f, -0.3f, 0.35f) * float(place + 1), LightType::Sphere, {0.7f});
        scene.lights[0].halfU = {0.1f, 0, 0};
        const Flux flux = fluxOf(scene);
        EXPECT_NEAR(flux.ofTriangles / sent, 1, 0.02) << place;
        worst = std::max(worst, std::abs(flux.atMiddles / sent - 1));
    }
    EXPECT_GT(worst, 0.1);
}

// A second housing within the same voxels, behind the first, stays dark.
TEST_F(NearLampsTest, WhatIsHiddenGetsNoLight) {
    const Flux flux = fluxOf(housed({0.2f, 0.1f, -0.3f}, LightType::Point, {0.7f, 1.1f}));
    EXPECT_NEAR(flux.ofTriangles / (3 * 4 * glm::pi<double>()), 1, 0.03);
}

// Of a cone of 30 degrees, whose edge cuts through triangles.
TEST_F(NearLampsTest, SpotsLightTheirCone) {
    const Flux flux = fluxOf(housed({0.2f, 0.1f, -0.3f}, LightType::Spot, {0.7f}));
    const double cone = 2 * glm::pi<double>() * (1 - std::cos(glm::radians(30.0)));
    EXPECT_NEAR(flux.ofTriangles / (3 * cone), 1, 0.25);
}

}  // namespace
}  // namespace conelight::test
