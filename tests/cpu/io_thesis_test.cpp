// SPDX-License-Identifier: MIT
// The thesis's text format: read as the original program reads it, its crashes turned into messages, and the
// additions.
#include <clocale>
#include <cmath>

#include "cpu/io_test_support.h"

#include <glm/gtc/constants.hpp>

namespace conelight {
namespace {

using namespace test;

Scene loadText(const std::string& text, const std::string& name = "scene") {
    return io::loadScene(write(folderOf("thesis") / (name + ".txt"), text));
}
std::string textError(const std::string& text) {
    return loadError(write(folderOf("thesis") / "bad.txt", text));
}
// One model with the given body.
Scene loadModel(const std::string& body) {
    return loadText("scene = { model = { primitive = cube " + body + " } }");
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "component " << c;
}

TEST(Thesis, DefaultsOfModelMaterialAndLight) {
    const Scene scene = loadText("scene = { model = { primitive = cube } light = { name = l } }");
    EXPECT_EQ(scene.format, "thesis");
    EXPECT_EQ(scene.name, "unnamedScene");
    ASSERT_EQ(scene.instances.size(), 1u);
    const Instance& instance = scene.instances[0];
    EXPECT_EQ(instance.name, "UnnamedModel");
    EXPECT_TRUE(instance.visible);
    EXPECT_TRUE(instance.voxelized);
    EXPECT_EQ(instance.worldFromObject, glm::mat4(1.0f));
    const Material& m = scene.materials.at(std::size_t(instance.material));
    ASSERT_TRUE(m.phong.has_value());
    EXPECT_FALSE(m.unlit);
    expectNear(m.phong->color, {0.85f, 0.85f, 0.85f});
    EXPECT_EQ(m.phong->shininess, 32.0f);
    EXPECT_EQ(m.phong->ambientStrength, 0.08f);
    EXPECT_EQ(m.phong->diffuseStrength, 1.0f);
    EXPECT_EQ(m.phong->specularStrength, 0.5f);
    ASSERT_EQ(scene.lights.size(), 1u);
    expectNear(scene.lights[0].intensity, {glm::pi<float>(), glm::pi<float>(), glm::pi<float>()});
    expectNear(scene.lights[0].position, {0, 0, 0});
    EXPECT_TRUE(scene.lights[0].customFalloff);
    expectNear(scene.lights[0].falloff, {1.0f, 0.15f, 0.45f});
    EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
}

TEST(Thesis, CubeHasSharedCornersAndFacesOut) {
    const Mesh cube = loadModel("").meshes.at(0);
    ASSERT_EQ(cube.positions.size(), 8u);
    ASSERT_EQ(cube.triangleCount(), 12u);
    for (std::size_t i = 0; i < 8; ++i) expectNear(cube.normals[i], glm::normalize(cube.positions[i]));
    for (std::size_t t = 0; t < 12; ++t) {
        const glm::vec3 a = cube.positions[cube.indices[3 * t]], b = cube.positions[cube.indices[3 * t + 1]],
                        c = cube.positions[cube.indices[3 * t + 2]];
        EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f) << "triangle " << t;
        EXPECT_NEAR(glm::length(glm::cross(b - a, c - a)), 1.0f, 1e-6f);
    }
}

// Scaled, turned about z, then y, then x, then moved; scale_y multiplies onto scale.
TEST(Thesis, TransformOrder) {
    const Scene scene = loadModel(
        "position = { x = 10 y = 20 z = 30 } rotation = { x = 90 y = 0 z = 90 } scale = 2 scale_y = 0.5");
    const glm::mat4 m = scene.instances.at(0).worldFromObject;
    // e_x scaled by 2 -> z-turn: +y -> x-turn: +z.
    expectNear(glm::vec3(m * glm::vec4(1, 0, 0, 1)), {10, 20, 32});
    // e_y scaled by 1 -> z-turn: -x -> x-turn: -x.
    expectNear(glm::vec3(m * glm::vec4(0, 1, 0, 1)), {9, 20, 30});
}

TEST(Thesis, LexingQuirksOfTheOriginal) {
    // Trailing text after numbers, commas, stray words and punctuation, first of doubled keys, key order.
    const Scene scene = loadText(
        "stray words scene = {\n name = s , ; remark model = { scale = 0.5abc scale = 9 primitive = cube "
        "name = A\n"
        " material = { color = { b = 1.0, r = 0.4f, g = .5F } } active = false } model = { primitive = cube "
        "name = A active = True } }");
    ASSERT_EQ(scene.instances.size(), 2u) << "models are all used, names may repeat";
    EXPECT_EQ(scene.name, "s");
    EXPECT_FLOAT_EQ(scene.instances[0].worldFromObject[0][0], 0.5f);
    expectNear(scene.materials[0].phong->color, {0.4f, 0.5f, 1.0f});
    EXPECT_FALSE(scene.instances[0].visible);
    EXPECT_FALSE(scene.instances[1].visible) << "only 'true' is true";
    EXPECT_TRUE(hasNote(scene, "only 'true' is true"));
}

TEST(Thesis, NumbersAreStrtofInTheCLocale) {
    const char* const before =
        std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // may be absent; then nothing is shown
    const Scene scene = loadModel("position = { x = 1.5 y = -2e1 z = 0x10 } scale = word");
    if (before != nullptr) std::setlocale(LC_NUMERIC, "C");
    // scale = 0 has no volume: the instance goes, with two notes.
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(hasNote(scene, "'word' is no number"));
    expectNear(
        glm::vec3(loadModel("position = { x = 1.5 y = -2e1 z = 0x10 }").instances.at(0).worldFromObject[3]),
        {1.5f, -20, 16});
    EXPECT_TRUE(
        contains(textError("scene = { model = { primitive = cube scale = nan } }"), "not a finite number"));
}

TEST(Thesis, FlagsAndShaders) {
    const Scene lamp =
        loadModel("static = true shader = EMIT material = { color = { r = 1 g = 0.5 b = 0.25 } }");
    EXPECT_FALSE(lamp.instances.at(0).voxelized);
    EXPECT_FALSE(lamp.instances.at(0).castsShadow);
    EXPECT_TRUE(lamp.instances.at(0).visible);
    EXPECT_TRUE(lamp.materials.at(0).unlit);
    expectNear(glm::vec3(lamp.materials.at(0).baseColor), {1, 0.5f, 0.25f});
    EXPECT_EQ(lamp.materials.at(0).emission, glm::vec3(0)) << "EMIT lights nothing";
    EXPECT_FALSE(loadModel("shader = EMITRGBA").instances.at(0).visible);
    const Scene odd = loadModel("shader = SHINY");
    EXPECT_FALSE(odd.materials.at(0).unlit);
    EXPECT_TRUE(hasNote(odd, "drawn as COLOR"));
}

TEST(Thesis, CommentsBomAndGluedPunctuation) {
    const Scene scene = loadText(
        "\xEF\xBB\xBF# name = hidden }\nscene={ // model = { primitive = cube }\n model={primitive=cube "
        "scale=2 name = A,}\n"
        "light={position={x=1 y=2 z=3}}}\n");
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "A");
    EXPECT_FLOAT_EQ(scene.instances[0].worldFromObject[0][0], 2.0f);
    expectNear(scene.lights.at(0).position, {1, 2, 3});
}

TEST(Thesis, MessagesInsteadOfCrashesAndSilence) {
    EXPECT_TRUE(hasNote(loadModel("position = { x = 1 }"), "line 1: position: 'y' is missing; read as 0"));
    expectNear(glm::vec3(loadModel("position = { x = 1 }").instances.at(0).worldFromObject[3]), {1, 0, 0});
    EXPECT_TRUE(hasNote(loadModel("position = { }"), "empty block"));
    EXPECT_TRUE(hasNote(loadModel("colour = { r = 1 } size = 3"), "unknown key 'colour'"));
    EXPECT_TRUE(hasNote(loadText("scene = { model = { name = N } }"), "neither path nor primitive"));
    EXPECT_TRUE(hasNote(loadText("scene = { model = { primitive = ball } }"), "'ball' is unknown"));
    EXPECT_TRUE(hasNote(loadText("scene = { }\nscene = { }"), "only the first is used"));
    EXPECT_TRUE(contains(loadError(write(folderOf("thesis") / "nothing.txt", "")), "is empty"));
    EXPECT_TRUE(contains(loadError(write(folderOf("thesis") / "blank.txt", " \n# a\n")), "is empty"));
    EXPECT_TRUE(contains(textError("scene = {\n model = {\n"), "bad.txt:2: '{' of model is never closed"));
    EXPECT_TRUE(contains(textError("= 3"), ":1: '=' without a key"));
    EXPECT_TRUE(contains(textError("scene = { name ="), "where a value should be"));
    EXPECT_TRUE(contains(textError("\n\nscene = { model = { scale = { x = 1 } primitive = cube } }"),
                         ":3: scale: a single word expected"));
    EXPECT_TRUE(contains(textError("scene = { model = word }"), "'{' expected"));
    EXPECT_TRUE(contains(textError("}"), "'}' without a '{'"));
    EXPECT_TRUE(contains(textError("hello world"), "no 'scene"));
    EXPECT_TRUE(contains(textError(std::string("scene = {\0}", 11)), "zero byte"));
    std::string deep = "scene = ";
    for (int i = 0; i < 100'000; ++i) deep += "{ a = ";
    EXPECT_TRUE(contains(textError(deep), "1000 nested"));
}

TEST(Thesis, BareTopLevelItemLoads) {
    EXPECT_EQ(loadText("model = { primitive = cube }").instances.size(), 1u);
    EXPECT_EQ(loadText("light = { color = { r = 1 g = 1 b = 1 } }").lights.size(), 1u);
}

TEST(Thesis, MeshesAreFoundBesideTheSceneAndItsParent) {
    const std::filesystem::path folder = folderOf("thesis_paths");
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write(folder / "models/up.obj", triangle);
    write(folder / "scenes/models/beside.obj", triangle);
    // Two objects and an offset node: only the first object, as it is in the file.
    write(folder / "models/two.obj",
          "o a\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\no b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 5 6\n");
    const Scene scene = io::loadScene(write(
        folder / "scenes/s.txt",
        "scene = { model = { name = a path = models/up.obj } model = { path = models\\beside.obj } model = { "
        "path = models/up.obj }\n"
        "model = { name = c path = models/two.obj }\n model = { name = lost path = models/none.obj } }"));
    ASSERT_EQ(scene.instances.size(), 4u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh) << "the same file is one mesh";
    const Mesh& two = scene.meshes.at(std::size_t(scene.instances[3].mesh));
    EXPECT_EQ(two.triangleCount(), 1u);
    EXPECT_FLOAT_EQ(two.bounds().min.x, 5.0f);
    EXPECT_EQ(two.normals.size(), two.positions.size()) << "missing normals are made";
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_EQ(scene.notes[0], "line 3: model lost: models/none.obj: no such file; model skipped");
}

TEST(Thesis, CamerasOfTheProgramAreAdded) {
    const Scene scene = loadText("scene = { }");
    ASSERT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.cameras[0].name, "start");
    EXPECT_EQ(scene.cameras[1].name, "pos1");
    EXPECT_EQ(scene.cameras[2].name, "pos2");
    for (const Camera& camera : scene.cameras) {
        EXPECT_FLOAT_EQ(camera.fovY, glm::pi<float>() / 4);
        EXPECT_FLOAT_EQ(camera.zNear, 0.1f);
        EXPECT_FLOAT_EQ(camera.zFar, 100.0f);
    }
    expectNear(scene.cameras[0].eye, {0, 0, 3});
    expectNear(scene.cameras[2].target - scene.cameras[2].eye, {0, 0, -1});
    const float yaw = -126 * glm::pi<float>() / 180, pitch = -4 * glm::pi<float>() / 180;
    expectNear(scene.cameras[1].target - scene.cameras[1].eye,
               {std::cos(yaw) * std::cos(pitch), std::sin(pitch), std::sin(yaw) * std::cos(pitch)});
}

TEST(Thesis, Additions) {
    const Scene scene = loadText(R"(
scene = {
    sky = { 0.1 0.2 0.3 }
    camera = { name = a position = { 0 1 5 } target = { 0 1 0 } fov = 60 near = 0.5 far = 20 }
    camera = { name = b position = { x = 1 y = 1 z = 1 } yaw = 0 }
    settings = { voxels = 128 thesis = { defects = { rings = true } } }
    light = { type = spot intensity = { 1 2 3 } direction = { 0 0 -2 } inner_angle = 10 outer_angle = 20 }
    light = { type = directional color = { 1 1 1 } direction = { 1 -1 0 } }
    light = { type = rect intensity = { 5 5 5 } position = { 0 2 0 } direction = { 0 -1 0 } width = 2 height = 4 }
    light = { intensity = { 1 1 1 } att_constant = 2 }
    model = { primitive = cube dynamic = true casts_shadow = false material = { emission = { 1 2 3 } roughness = 0.25 metallic = 1 double_sided = true } }
})");
    EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
    expectNear(scene.sky, {0.1f, 0.2f, 0.3f});
    ASSERT_EQ(scene.cameras.size(), 2u) << "own cameras replace the program's";
    expectNear(scene.cameras[0].target, {0, 1, 0});
    EXPECT_FLOAT_EQ(scene.cameras[0].fovY, glm::pi<float>() / 3);
    expectNear(scene.cameras[1].target - scene.cameras[1].eye, {1, 0, 0});
    using Pair = std::pair<std::string, std::string>;
    EXPECT_EQ(scene.settings, (std::vector<Pair>{{"voxels", "128"}, {"thesis.defects.rings", "true"}}));
    ASSERT_EQ(scene.lights.size(), 4u);
    EXPECT_EQ(scene.lights[0].type, LightType::Spot);
    EXPECT_FALSE(scene.lights[0].customFalloff) << "a radiometric intensity falls by the inverse square";
    expectNear(scene.lights[0].intensity, {1, 2, 3});
    expectNear(scene.lights[0].direction, {0, 0, -1});
    EXPECT_NEAR(scene.lights[0].innerAngle, 10 * glm::pi<float>() / 180, 1e-6);
    EXPECT_NEAR(scene.lights[0].outerAngle, 20 * glm::pi<float>() / 180, 1e-6);
    EXPECT_EQ(scene.lights[1].type, LightType::Directional);
    expectNear(scene.lights[1].intensity, {glm::pi<float>(), glm::pi<float>(), glm::pi<float>()});
    EXPECT_EQ(scene.lights[2].type, LightType::Rect);
    EXPECT_NEAR(glm::length(scene.lights[2].halfU), 1.0f, 1e-6);
    EXPECT_NEAR(glm::length(scene.lights[2].halfV), 2.0f, 1e-6);
    EXPECT_NEAR(glm::dot(scene.lights[2].halfU, scene.lights[2].direction), 0.0f, 1e-6);
    EXPECT_TRUE(scene.lights[3].customFalloff);
    EXPECT_FLOAT_EQ(scene.lights[3].falloff.x, 2.0f);
    EXPECT_TRUE(scene.instances.at(0).dynamic);
    EXPECT_FALSE(scene.instances.at(0).castsShadow);
    const Material& m = scene.materials.at(0);
    expectNear(m.emission, {1, 2, 3});
    EXPECT_FLOAT_EQ(m.roughness, 0.25f);
    EXPECT_FLOAT_EQ(m.metallic, 1.0f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(contains(textError("scene = { light = { type = laser } }"), "'laser' is unknown"));
    EXPECT_TRUE(contains(textError("scene = { camera = { fov = 200 } }"), "fov"));
}

TEST(Thesis, SurvivesDamage) {
    const std::string text = R"(scene = {
  name = mainScene
  model = { name = A active = true primitive = cube position = { x = 0.0f, y = -0.5f z = 0.0f } shader = EMIT static = true
    material = { shininess = 32.0f color = { r = 0.4f, g = 1.0, b = 0.4 } } }
  light = { position = { x = 0.3f y = 0.3f z = -0.2f } color = { r = 0.3f g = 0.8f b = 1.0f } att_linear = 0.2 }
  camera = { name = c target = { 0 0 0 } } settings = { a = { b = c } } sky = { 1 1 1 } })";
    const FuzzCount count = fuzz(text, folderOf("thesis") / "damaged.txt", 5000, 2);
    EXPECT_GT(count.loaded, 500);
    EXPECT_GT(count.refused, 500);
}

TEST(Thesis, ReadsTheOriginalsScenes) {
    const auto path = testData("vxct/scenes/scene.txt");
    if (!path) GTEST_SKIP() << "test data absent";
    const auto voxelized = [](const Scene& scene) {
        std::size_t count = 0;
        for (const Instance& instance : scene.instances)
            if (instance.visible && instance.voxelized)
                count += scene.meshes[std::size_t(instance.mesh)].triangleCount();
        return count;
    };
    const Scene scene = io::loadScene(*path);
    EXPECT_EQ(scene.instances.size(), 8u);
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(voxelized(scene), 29'877u);
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_EQ(scene.name, "mainScene");
    const Scene complex = io::loadScene(*testData("vxct/scenes/scene_complex.txt"));
    EXPECT_EQ(complex.instances.size(), 13u);
    EXPECT_EQ(complex.lights.size(), 3u);
    EXPECT_EQ(voxelized(complex), 59'277u);
    ASSERT_EQ(complex.notes.size(), 1u);
    EXPECT_TRUE(contains(complex.notes[0], "stan_dragon.obj: no such file"));
    // RightWall's colour is written with commas.
    bool found = false;
    for (const Material& material : complex.materials)
        if (material.name == "RightWall") {
            found = true;
            expectNear(material.phong->color, {0.4f, 1.0f, 0.4f});
        }
    EXPECT_TRUE(found);
}

}  // namespace
}  // namespace conelight
