// SPDX-License-Identifier: MIT
// The scene tables: bounds, what is refused and with which words, the camera that frames, and the two material
// models.
#include "conelight/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// One triangle of one material, twice in the scene.
Scene smallScene() {
    Scene scene;
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    scene.materials.emplace_back().name = "paint";
    Texture texture;
    texture.name = "wood";
    texture.width = texture.height = 1;
    texture.rgba = {1, 2, 3, 4};
    scene.textures.push_back(texture);
    scene.instances.resize(2);
    for (Instance& instance : scene.instances) instance.mesh = instance.material = 0;
    scene.instances[1].name = "far";
    scene.instances[1].worldFromObject = glm::translate(glm::mat4(1), glm::vec3(10, 0, -3));
    scene.lights.emplace_back().name = "lamp";
    return scene;
}

std::string failureOf(const std::function<void(Scene&)>& breakIt) {
    Scene scene = smallScene();
    breakIt(scene);
    try {
        scene.validate();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        return error.what();
    }
    return "";
}

}  // namespace

TEST(SceneTest, BoundsAndCountsAreOfWhatIsVisible) {
    Scene scene = smallScene();
    EXPECT_EQ(scene.bounds().min, glm::vec3(0, 0, -3));
    EXPECT_EQ(scene.bounds().max, glm::vec3(11, 2, 0));
    EXPECT_EQ(scene.triangleCount(), 2u);
    scene.instances[1].visible = false;
    EXPECT_EQ(scene.bounds().max, glm::vec3(1, 2, 0));
    EXPECT_EQ(scene.triangleCount(), 1u);
    scene.instances.clear();
    EXPECT_TRUE(scene.bounds().empty());
    EXPECT_EQ(scene.bounds().extent(), glm::vec3(0));
}

TEST(SceneTest, WhatBreaksARuleIsNamed) {
    EXPECT_EQ(failureOf([](Scene&) {}), "");
    EXPECT_EQ(failureOf([](Scene& s) { s.meshes[0].normals.resize(2); }),
              "mesh 0 'triangle': 2 normals for 3 positions; as many or none would be right");
    EXPECT_EQ(failureOf([](Scene& s) { s.meshes[0].indices.push_back(0); }),
              "mesh 0 'triangle': 4 indices; a multiple of 3 would be right");
    EXPECT_EQ(failureOf([](Scene& s) { s.meshes[0].indices[1] = 3; }),
              "mesh 0 'triangle': index 1 is 3; less than 3 would be right");
    EXPECT_EQ(failureOf([](Scene& s) { s.meshes[0].positions[2].y = kNan; }),
              "mesh 0 'triangle': position 2 is not finite");
    EXPECT_EQ(failureOf([](Scene& s) { s.textures[0].rgba.pop_back(); }),
              "texture 'wood': 1 x 1 texels and 3 bytes do not belong together");
    EXPECT_NE(failureOf([](Scene& s) { s.textures[0].width = -1; }), "");
    EXPECT_EQ(failureOf([](Scene& s) { s.materials[0].normalTexture.texture = 1; }),
              "material 'paint': normal names texture 1; less than 1 would be right");
    EXPECT_EQ(failureOf([](Scene& s) { s.instances[1].mesh = 1; }),
              "instance 1 'far': mesh 1; 0 or more and less than 1 would be right");
    EXPECT_NE(failureOf([](Scene& s) { s.instances[0].mesh = -1; }), "");
    EXPECT_EQ(failureOf([](Scene& s) { s.instances[1].material = 1; }),
              "instance 1 'far': material 1; less than 1 would be right");
    EXPECT_EQ(failureOf([](Scene& s) { s.instances[1].worldFromObject[3][0] = kNan; }),
              "instance 1 'far': the transform is not finite");
    EXPECT_EQ(failureOf([](Scene& s) { s.instances[1].worldFromObject[3][0] = 3e38f; }),
              "instance 1 'far': reaches 3e+38 m from the origin; at most 1e+15 would be right");
}

// Every number that reaches a shader: NaN would spread through the light.
TEST(SceneTest, NumbersAreFinite) {
    const std::vector<std::function<void(Scene&)>> all{
        [](Scene& s) { s.sky.y = kNan; },
        [](Scene& s) { s.materials[0].baseColor.a = kNan; },
        [](Scene& s) { s.materials[0].baseColor.r = std::numeric_limits<float>::infinity(); },
        [](Scene& s) { s.materials[0].roughness = kNan; },
        [](Scene& s) { s.materials[0].ior = kNan; },
        [](Scene& s) { s.materials[0].specular = kNan; },
        [](Scene& s) { s.materials[0].specularColor.z = kNan; },
        [](Scene& s) { s.materials[0].emission.x = kNan; },
        [](Scene& s) { s.materials[0].alphaCutoff = kNan; },
        [](Scene& s) { s.materials[0].phong.emplace().shininess = kNan; },
        [](Scene& s) { s.materials[0].phong.emplace().diffuseStrength = kNan; },
        [](Scene& s) { s.lights[0].position.x = kNan; },
        [](Scene& s) { s.lights[0].intensity.x = kNan; },
        [](Scene& s) { s.lights[0].halfU.x = kNan; },
        [](Scene& s) { s.lights[0].outerAngle = kNan; },
        [](Scene& s) { s.lights[0].range = kNan; },
        [](Scene& s) { s.lights[0].falloff.z = kNan; },
    };
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_NE(failureOf(all[i]).find("not finite"), std::string::npos) << "change " << i;
}

TEST(SceneTest, FrameCameraSeesAllCorners) {
    for (const glm::vec3& extent :
         {glm::vec3(1), glm::vec3(100, 1, 1), glm::vec3(0.01f, 5, 2), glm::vec3(3, 0, 3)}) {
        Aabb box;
        box.grow(glm::vec3(7, -2, 5));
        box.grow(glm::vec3(7, -2, 5) + extent);
        const Camera camera = frameCamera(box);
        const glm::mat4 clip = glm::perspective(camera.fovY, 1.0f, camera.zNear, camera.zFar) *
                               glm::lookAt(camera.eye, camera.target, camera.up);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec4 p = clip * glm::vec4((corner & 1) != 0 ? box.max.x : box.min.x,
                                                 (corner & 2) != 0 ? box.max.y : box.min.y,
                                                 (corner & 4) != 0 ? box.max.z : box.min.z, 1);
            EXPECT_LE(std::abs(p.x), p.w);
            EXPECT_LE(std::abs(p.y), p.w);
            EXPECT_LE(std::abs(p.z), p.w);
        }
    }
    // Nothing to see, or a single point: still a camera.
    for (const Aabb& box : {Aabb{}, Aabb{glm::vec3(1), glm::vec3(1)}}) {
        const Camera camera = frameCamera(box);
        EXPECT_TRUE(std::isfinite(glm::length(camera.eye)));
        EXPECT_GT(glm::distance(camera.eye, camera.target), 0.0f);
        EXPECT_LT(camera.zNear, camera.zFar);
    }
}

TEST(SceneTest, DiffuseMaterialsLookTheSameInBothModels) {
    Material diffuse;
    diffuse.baseColor = {0.6f, 0.3f, 0.1f, 1};
    PhongMaterial phong = phongFromPbr(diffuse);
    EXPECT_EQ(phong.color * phong.diffuseStrength, glm::vec3(0.6f, 0.3f, 0.1f));
    EXPECT_EQ(phong.ambientStrength, 0.0f);
    // And back: what the specular lobe takes, the diffuse one loses.
    Material back;
    phong.specularStrength = 0;
    setPbrFromPhong(back, phong);
    EXPECT_NEAR(glm::length(glm::vec3(back.baseColor) - glm::vec3(diffuse.baseColor)), 0.0f, 1e-6f);
    EXPECT_EQ(back.specularColor, glm::vec3(0));
    EXPECT_EQ(back.metallic, 0.0f);
    // A mirror of the thesis's scenes: smooth, and no more light out than in.
    phong.specularStrength = 1.3f;
    phong.shininess = 256;
    setPbrFromPhong(back, phong);
    EXPECT_LT(back.roughness, 0.3f);
    EXPECT_LE(0.04f * back.specularColor.x + back.baseColor.r, 1.0f);
}

TEST(SceneTest, ShininessGrowsAsRoughnessFalls) {
    float last = 0;
    for (const float roughness : {1.0f, 0.8f, 0.5f, 0.3f, 0.1f}) {
        Material material;
        material.roughness = roughness;
        const PhongMaterial phong = phongFromPbr(material);
        EXPECT_GT(phong.shininess, last);
        last = phong.shininess;
        // The inverse up to the clamps.
        Material back;
        setPbrFromPhong(back, phong);
        if (phong.shininess > 1.0f && phong.shininess < 1000.0f) {
            EXPECT_NEAR(back.roughness, roughness, 1e-3f);
        }
    }
}

// Flux is what arrives on a sphere about the light, whatever its kind.
TEST(Scene, FluxIsIntensityOverAllDirections) {
    Light light;
    light.intensity = {1, 2, 3};
    EXPECT_NEAR(radiantFlux(light)->g, 4 * 3.14159265f * 2, 1e-4f);
    light.type = LightType::Spot;
    light.innerAngle = 0.3f;
    light.outerAngle = 0.9f;
    double spot = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = 0.9 * (i + 0.5) / kSteps;
        const double ramp =
            std::clamp((std::cos(angle) - std::cos(0.9)) / (std::cos(0.3) - std::cos(0.9)), 0.0, 1.0);
        spot += ramp * ramp * 2 * 3.14159265358979 * std::sin(angle) * 0.9 / kSteps;
    }
    EXPECT_NEAR(static_cast<double>(radiantFlux(light)->r) / spot, 1, 1e-4);
    light.type = LightType::Rect;
    light.halfU = {1, 0, 0};
    light.halfV = {0, 0, 0.25f};
    EXPECT_NEAR(radiantFlux(light)->b, 3.14159265f * 3, 1e-4f);  // one square metre
    ASSERT_TRUE(setRadiantFlux(light, {3.14159265f, 0, 0}));
    EXPECT_NEAR(light.intensity.r, 1, 1e-6f);
    light.intensity = glm::vec3(1);
    light.type = LightType::Disk;
    EXPECT_NEAR(radiantFlux(light)->b, 3.14159265f * 3.14159265f * 0.25f, 1e-4f);  // half axes of 1 and 1/4 m
    light.type = LightType::Sphere;
    EXPECT_NEAR(radiantFlux(light)->b, 3.14159265f * 4 * 3.14159265f, 1e-4f);  // radius 1 m
    light.type = LightType::Directional;
    EXPECT_FALSE(radiantFlux(light));
    EXPECT_FALSE(setRadiantFlux(light, glm::vec3(1)));
    light.type = LightType::Point;
    light.customFalloff = true;
    EXPECT_FALSE(radiantFlux(light));
}

}  // namespace conelight::test
