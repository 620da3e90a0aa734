// SPDX-License-Identifier: MIT
// Scenes written to the thesis's format and read back: the same triangles in the world, materials, lights,
// cameras, sky and settings; what cannot be kept is said; nothing is written over.
#include "thesis/format/write.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <sstream>

#include "conelight/error.h"
#include "io/scene_file.h"
#include "io/scene_write.h"

namespace conelight::io {
namespace {

std::string place(const std::string& name) {
    const std::string folder = testing::TempDir() + "/thesis_write_" + name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder + "/scene.txt";
}

std::vector<glm::vec3> corners(const Scene& scene, std::size_t instance) {
    const Instance& one = scene.instances[instance];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(one.mesh)];
    std::vector<glm::vec3> out;
    for (const std::uint32_t index : mesh.indices)
        out.push_back(glm::vec3(one.worldFromObject * glm::vec4(mesh.positions[index], 1)));
    return out;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance, const std::string& what) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << what << ": " << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

void expectSameMaterial(Material a, const Material& b, const std::string& name) {
    EXPECT_TRUE(b.phong.has_value()) << name;
    a.phong = phongOf(a);
    expectNear(a.phong->color, b.phong->color, 1e-6f, name);
    EXPECT_EQ(a.phong->shininess, b.phong->shininess) << name;
    EXPECT_EQ(a.phong->ambientStrength, b.phong->ambientStrength) << name;
    EXPECT_EQ(a.phong->diffuseStrength, b.phong->diffuseStrength) << name;
    EXPECT_EQ(a.phong->specularStrength, b.phong->specularStrength) << name;
    EXPECT_EQ(a.roughness, b.roughness) << name;
    EXPECT_EQ(a.metallic, b.metallic) << name;
    EXPECT_EQ(a.ior, b.ior) << name;
    EXPECT_EQ(a.specular, b.specular) << name;
    expectNear(glm::vec3(a.baseColor), glm::vec3(b.baseColor), 1e-6f, name);
    EXPECT_EQ(a.emission, b.emission) << name;
    EXPECT_EQ(a.doubleSided, b.doubleSided) << name;
    EXPECT_EQ(a.unlit, b.unlit) << name;
}

void expectSameLight(const Light& a, const Light& b) {
    EXPECT_EQ(a.type, b.type) << a.name;
    EXPECT_EQ(a.intensity, b.intensity) << a.name;
    EXPECT_EQ(a.customFalloff, b.customFalloff) << a.name;
    if (a.customFalloff) {
        EXPECT_EQ(a.falloff, b.falloff) << a.name;
    }
    EXPECT_EQ(a.enabled, b.enabled) << a.name;
    EXPECT_EQ(a.castsShadow, b.castsShadow) << a.name;
    EXPECT_EQ(a.range, b.range) << a.name;
    if (a.type != LightType::Directional) {
        EXPECT_EQ(a.position, b.position) << a.name;
    }
    if (hasDirection(a.type)) expectNear(a.direction, b.direction, 1e-6f, a.name);
    if (a.type == LightType::Spot) {
        EXPECT_NEAR(a.innerAngle, b.innerAngle, 1e-6f);
        EXPECT_NEAR(a.outerAngle, b.outerAngle, 1e-6f);
    }
    if (a.type == LightType::Sphere) {
        EXPECT_NEAR(glm::length(a.halfU), glm::length(b.halfU), 1e-5f) << a.name;
    }
    if (a.type == LightType::Rect || a.type == LightType::Disk) {
        // A half edge and its opposite span the same rectangle.
        EXPECT_NEAR(std::abs(glm::dot(a.halfU, b.halfU)), glm::dot(a.halfU, a.halfU), 1e-5f) << a.name;
        EXPECT_NEAR(std::abs(glm::dot(a.halfV, b.halfV)), glm::dot(a.halfV, a.halfV), 1e-5f) << a.name;
    }
}

// Names are single words in this format.
std::string oneWord(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}
// What was lost, but for spaces.
std::string losses(const std::vector<std::string>& notes) {
    std::string all;
    for (const std::string& note : notes)
        if (note.rfind("the name '", 0) != 0) all += note + "\n";
    return all;
}

void expectSame(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.instances.size(), b.instances.size());
    const float size = glm::length(a.bounds().extent());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
        const Instance &x = a.instances[i], &y = b.instances[i];
        EXPECT_EQ(oneWord(x.name), y.name);
        EXPECT_EQ(x.visible, y.visible) << x.name;
        EXPECT_EQ(x.voxelized, y.voxelized) << x.name;
        EXPECT_EQ(x.castsShadow, y.castsShadow) << x.name;
        EXPECT_EQ(x.dynamic, y.dynamic) << x.name;
        const std::vector<glm::vec3> p = corners(a, i), q = corners(b, i);
        ASSERT_EQ(p.size(), q.size()) << x.name;
        float worst = 0;
        for (std::size_t k = 0; k < p.size(); ++k) worst = std::max(worst, glm::length(p[k] - q[k]));
        EXPECT_LE(worst, 2e-6f * size) << x.name;
        const Material fallback;
        expectSameMaterial(x.material < 0 ? fallback : a.materials[std::size_t(x.material)],
                           b.materials[std::size_t(y.material)], x.name);
    }
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) expectSameLight(a.lights[i], b.lights[i]);
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(oneWord(a.cameras[i].name), b.cameras[i].name);
        EXPECT_EQ(a.cameras[i].eye, b.cameras[i].eye);
        EXPECT_EQ(a.cameras[i].target, b.cameras[i].target);
        EXPECT_NEAR(a.cameras[i].fovY, b.cameras[i].fovY, 1e-6f);
        EXPECT_EQ(a.cameras[i].zNear, b.cameras[i].zNear);
    }
    EXPECT_EQ(a.sky, b.sky);
}

TEST(ThesisWrite, GeneratedRoomsComeBack) {
    for (const char* name : {"builtin:cornell", "builtin:cornell-point", "builtin:sunroom"}) {
        const Scene scene = loadScene(name);
        const std::string file = place("rooms");
        const std::vector<std::string> notes = writeScene(file, scene, false);
        EXPECT_EQ(losses(notes), "") << name;
        const Scene back = loadScene(file);
        EXPECT_TRUE(back.notes.empty()) << name << ": " << back.notes.front();
        expectSame(scene, back);
    }
}

TEST(ThesisWrite, EveryFieldComesBack) {
    Scene scene = loadScene("builtin:cornell");
    scene.sky = {0.1f, 0.2f, 0.3f};
    scene.settings = {{"thesis.diffuse.aperture", "0.55"}, {"voxels.size", "64"}};
    glm::mat4 m = glm::translate(glm::mat4(1), {1, -2, 3});
    m = glm::rotate(m, 1.1f, glm::normalize(glm::vec3(1, 2, 3)));
    scene.instances[0].worldFromObject = glm::scale(m, {0.5f, 2, 3});
    scene.instances[1].worldFromObject = glm::rotate(glm::mat4(1), 1.5707963f, {0, 1, 0});
    scene.instances[1].visible = false;
    scene.instances[2].voxelized = false;
    scene.instances[2].dynamic = true;
    scene.instances[3].castsShadow = false;
    scene.instances[3].material = -1;
    glm::mat4 sheared(1);
    sheared[1][0] = 0.5f;
    scene.instances[4].worldFromObject = sheared;
    Material& material = scene.materials[0];
    material.baseColor = {0.1f, 0.6f, 0.9f, 1};
    material.metallic = 0.5f;
    material.roughness = 0.3f;
    material.ior = 1.8f;
    material.specular = 0.25f;
    material.specularColor = {1, 0.5f, 0.25f};
    material.emission = {1, 2, 3};
    material.doubleSided = true;
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Directional, LightType::Rect,
                                 LightType::Disk, LightType::Sphere}) {
        Light light;
        light.type = type;
        light.name = "light" + std::to_string(scene.lights.size());
        light.intensity = {1.5f, 2, 2.5f};
        light.position = {0.1f, 0.2f, 0.3f};
        light.direction = glm::normalize(glm::vec3(1, -2, 0.5f));
        light.innerAngle = 0.2f;
        light.outerAngle = 0.7f;
        light.range = 12;
        light.enabled = type != LightType::Point;
        light.castsShadow = type != LightType::Spot;
        light.customFalloff = type == LightType::Point;
        light.halfU = 0.3f * glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 1, 0)));
        light.halfV = 0.7f * glm::normalize(glm::cross(light.direction, light.halfU));
        scene.lights.push_back(light);
    }
    const std::string file = place("fields");
    EXPECT_EQ(losses(writeScene(file, scene, false)), "");
    const Scene back = loadScene(file);
    expectSame(scene, back);
    for (const auto& setting : scene.settings)
        EXPECT_NE(std::find(back.settings.begin(), back.settings.end(), setting), back.settings.end())
            << setting.first;
}

TEST(ThesisWrite, LossesAreSaid) {
    Scene scene = loadScene("builtin:cornell");
    scene.instances[0].name = "my wall {1}";
    scene.materials[0].name = "painted";
    scene.textures.push_back({"t", 1, 1});
    scene.textures[0].rgba = {1, 2, 3, 4};
    scene.materials[0].baseColorTexture.texture = 0;
    scene.materials[1].name = "glass";
    scene.materials[1].alphaMode = AlphaMode::Blend;
    const std::string file = place("losses");
    std::string notes;
    for (const std::string& note : writeScene(file, scene, false)) notes += note + "\n";
    EXPECT_NE(notes.find("'my wall {1}' is written as my_wall__1_"), std::string::npos) << notes;
    EXPECT_NE(notes.find("material painted: textures are left out"), std::string::npos) << notes;
    EXPECT_NE(notes.find("material glass: opacity is left out"), std::string::npos) << notes;
    EXPECT_EQ(loadScene(file).instances[0].name, "my_wall__1_");
}

TEST(ThesisWrite, NothingIsWrittenOver) {
    const Scene scene = loadScene("builtin:cornell");
    const std::string file = place("force");
    writeScene(file, scene, false);
    const auto read = [&] {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    };
    const std::string before = read();
    Scene other = scene;
    other.sky = {9, 9, 9};
    EXPECT_THROW(writeScene(file, other, false), Error);
    EXPECT_EQ(read(), before);
    // Its meshes are files too.
    std::filesystem::remove(file);
    EXPECT_THROW(writeScene(file, other, false), Error);
    EXPECT_FALSE(std::filesystem::exists(file));
    writeScene(file, other, true);
    EXPECT_NE(read(), before);
    EXPECT_THROW(writeScene("x.obj", scene, true), Error);
    EXPECT_THROW(writeScene("/nonexistent/folder/x.txt", scene, true), Error);
}

}  // namespace
}  // namespace conelight::io
