// SPDX-License-Identifier: MIT
// glTF: every feature the importer claims, on files made here, and its refusals. Materials and textures:
// io_gltf_material_test.cpp.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "cpu/gltf_test_support.h"

namespace conelight {
namespace {

using namespace test;

glm::vec3 worldCorner(const Scene& scene, std::size_t instance, std::size_t corner) {
    const Instance& placed = scene.instances.at(instance);
    const Mesh& mesh = scene.meshes.at(std::size_t(placed.mesh));
    return glm::vec3(placed.worldFromObject * glm::vec4(mesh.positions.at(mesh.indices.at(corner)), 1.0f));
}

TEST(Gltf, PlacesNodesThroughTheHierarchy) {
    GltfBuilder b;
    b.triangle();
    const float s = std::sqrt(0.5f);
    b.node({{"translation", {1, 2, 3}},
            {"children", {1, 2}},
            {"rotation", {0, 0, s, s}}});  // 90 degrees about z
    b.node({{"mesh", 0}, {"scale", {2, 2, 2}}, {"name", "child"}});
    b.node({{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
    const Scene scene = loadGlb(b, "hierarchy");
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 1u) << "instances share the mesh";
    EXPECT_EQ(scene.instances[0].name, "child");
    expectNear(worldCorner(scene, 0, 1), {1, 4, 3});
    expectNear(worldCorner(scene, 1, 1), {1, 3, 8});
    EXPECT_TRUE(scene.meshes[0].normals.empty()) << "missing normals stay flat";
}

TEST(Gltf, UnrollsStripsAndFans) {
    const std::vector<float> square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        const int positions =
            b.floats(mode == 5 ? square : std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
        b.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}}}};
        b.node({{"mesh", 0}});
        const Scene scene = loadGlb(b, fmt::format("mode{}", mode));
        const Mesh& mesh = scene.meshes.at(0);
        ASSERT_EQ(mesh.triangleCount(), 2u);
        double area = 0;
        for (std::size_t t = 0; t < 2; ++t) {
            const glm::vec3 a = mesh.positions[mesh.indices[3 * t]],
                            p = mesh.positions[mesh.indices[3 * t + 1]],
                            q = mesh.positions[mesh.indices[3 * t + 2]];
            const glm::vec3 n = glm::cross(p - a, q - a);
            EXPECT_GT(n.z, 0.0f) << "both triangles face +z";
            area += 0.5 * glm::length(n);
        }
        EXPECT_NEAR(area, 1.0, 1e-6);
    }
}

TEST(Gltf, LeavesOutPointsWithANote) {
    GltfBuilder b;
    b.triangle()["mode"] = 0;
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "points");
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(hasNote(scene, "points or lines"));
}

TEST(Gltf, ReadsNormalizedAndStridedAttributes) {
    GltfBuilder b;
    // KHR_mesh_quantization: positions as normalized shorts with a stride of 8 bytes.
    const int positions =
        b.accessor(b.view(std::vector<std::int16_t>{0, 0, 0, 99, 32767, 0, 0, 99, 0, -32768, 16384, 99}),
                   5122, 3, "VEC3");
    b.json["accessors"][std::size_t(positions)]["normalized"] = true;
    b.json["bufferViews"][0]["byteStride"] = 8;
    const int colors =
        b.accessor(b.view(std::vector<std::uint8_t>{255, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 5121, 3, "VEC3");
    b.json["accessors"][std::size_t(colors)]["normalized"] = true;
    b.json["bufferViews"][1]["byteStride"] = 4;
    b.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}}}}}}};
    b.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "quantized");
    const Mesh& mesh = scene.meshes.at(0);
    expectNear(mesh.positions[1], {1, 0, 0});
    expectNear(mesh.positions[2], {0, -1, 16384.0f / 32767.0f});
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_NEAR(mesh.colors[0].b, 0.2f, kTight);
    EXPECT_EQ(mesh.colors[0].a, 1.0f) << "VEC3 colours are opaque";
}

TEST(Gltf, AppliesSparseAccessors) {
    GltfBuilder b;
    Json& primitive = b.triangle();
    const int indices = b.view(std::vector<std::uint8_t>{2});
    const int values = b.view(std::vector<float>{7, 8, 9});
    b.json["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", values}}}};
    (void)primitive;
    b.node({{"mesh", 0}});
    expectNear(loadGlb(b, "sparse").meshes.at(0).positions[2], {7, 8, 9});
    b.json["accessors"][0]["sparse"]["indices"]["componentType"] = 5126;
    EXPECT_TRUE(contains(glbError(b, "sparse_bad"), "index type"));
}

TEST(Gltf, MirroredNodesKeepTheirFrontOutside) {
    GltfBuilder b;
    b.triangle()["attributes"]["NORMAL"] = b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    b.node({{"mesh", 0}, {"scale", {-1, 1, 1}}});
    const Scene scene = loadGlb(b, "mirror");
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_GT(glm::determinant(scene.instances[0].worldFromObject), 0.0f);
    const glm::vec3 a = worldCorner(scene, 0, 0), p = worldCorner(scene, 0, 1), q = worldCorner(scene, 0, 2);
    EXPECT_GT(glm::cross(p - a, q - a).z, 0.0f) << "still faces +z";
    EXPECT_LT(std::min({a.x, p.x, q.x}), -0.5f) << "lies on the mirrored side";
    expectNear(glm::mat3(scene.instances[0].worldFromObject) *
                   scene.meshes[std::size_t(scene.instances[0].mesh)].normals[0],
               {0, 0, 1});
}

// One grid of 128 voxels makes rooms of 20 m; nested ones make landscapes.
TEST(Gltf, LargeScenesStartWithNestedGrids) {
    using Values = std::vector<std::pair<std::string, std::string>>;
    const Values small{{"image.exposure", "auto"}};
    const Values large{{"image.exposure", "auto"}, {"voxels.levels", "0"}};
    for (const float edge : {19.0f, 21.0f}) {
        GltfBuilder b;
        b.triangle();  // of edge 1
        b.node({{"mesh", 0}, {"scale", {edge, 1, 1}}});
        EXPECT_EQ(loadGlb(b, "large").settings, edge < 20 ? small : large) << edge << " m";
    }
    GltfBuilder own;
    own.json["asset"]["generator"] = "Conelight";
    own.triangle();
    own.node({{"mesh", 0}, {"scale", {100, 1, 1}}});
    EXPECT_TRUE(loadGlb(own, "own").settings.empty()) << "files of ours say what they want";
}

TEST(Gltf, DropsInstancesWithoutVolume) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}, {"scale", {1, 0, 1}}});
    const Scene scene = loadGlb(b, "flat");
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(hasNote(scene, "zero scale"));
}

TEST(Gltf, InstancesByExtension) {
    GltfBuilder b;
    b.triangle();
    const int t = b.floats({0, 0, 0, 5, 0, 0, 0, 6, 0}, 3);
    b.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    b.node({{"mesh", 0},
            {"translation", {0, 0, 1}},
            {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", t}}}}}}}});
    const Scene scene = loadGlb(b, "instancing");
    ASSERT_EQ(scene.instances.size(), 3u);
    expectNear(worldCorner(scene, 2, 0), {0, 6, 1});
}

TEST(Gltf, LightsKeepTheirNumbers) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 40}, {"color", {1, 0.5, 0.25}}, {"range", 3}, {"name", "bulb"}},
        {{"type", "spot"}, {"intensity", 2}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.3}}}},
        {{"type", "directional"}, {"intensity", 5}}};
    const float s = std::sqrt(0.5f);
    b.node({{"translation", {1, 2, 3}},
            {"children", {1, 2}},
            {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.node({{"rotation", {-s, 0, 0, s}},
            {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});  // -z becomes -y
    b.node({{"scale", {3, 3, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}});
    const Scene scene = loadGlb(b, "lights");
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].type, LightType::Point);
    expectNear(scene.lights[0].intensity, {40, 20, 10});
    expectNear(scene.lights[0].position, {1, 2, 3});
    EXPECT_EQ(scene.lights[0].range, 3.0f);
    EXPECT_FALSE(scene.lights[0].customFalloff);
    expectNear(scene.lights[1].direction, {0, -1, 0});
    EXPECT_FLOAT_EQ(scene.lights[1].innerAngle, 0.1f);
    EXPECT_FLOAT_EQ(scene.lights[1].outerAngle, 0.3f);
    expectNear(scene.lights[2].direction, {0, 0, -1});
    expectNear(scene.lights[2].intensity, {5, 5, 5});
}

TEST(Gltf, CamerasAndSky) {
    GltfBuilder b;
    b.json["cameras"] = {{{"type", "perspective"},
                          {"perspective", {{"yfov", 0.6}, {"znear", 0.2}, {"zfar", 50}}},
                          {"name", "eye"}},
                         {{"type", "orthographic"},
                          {"orthographic", {{"xmag", 3}, {"ymag", 1.5}, {"znear", 0}, {"zfar", 10}}}}};
    const float s = std::sqrt(0.5f);
    b.node({{"camera", 0},
            {"translation", {0, 1, 0}},
            {"rotation", {0, s, 0, s}},
            {"children", {1}}});  // looks along -x
    b.node({{"camera", 1}});
    b.json["scenes"][0]["extras"]["sky"] = {0.1, 0.2, 0.3};
    const Scene scene = loadGlb(b, "cameras");
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_FLOAT_EQ(scene.cameras[0].fovY, 0.6f);
    EXPECT_FLOAT_EQ(scene.cameras[0].zNear, 0.2f);
    EXPECT_FLOAT_EQ(scene.cameras[0].zFar, 50.0f);
    expectNear(scene.cameras[0].target - scene.cameras[0].eye, {-1, 0, 0});
    EXPECT_FALSE(scene.cameras[0].isOrthographic());
    EXPECT_FLOAT_EQ(scene.cameras[1].orthographicHeight, 3.0f);
    EXPECT_FLOAT_EQ(scene.cameras[1].zNear, 1e-3f)
        << "a ten-thousandth of the far plane, as it is to begin at the eye";
    EXPECT_FLOAT_EQ(scene.cameras[1].zFar, 10.0f);
    EXPECT_FALSE(hasNote(scene, "orthographic"));
    expectNear(scene.sky, {0.1f, 0.2f, 0.3f});
}

TEST(Gltf, SkinsAndMorphsInRestPose) {
    GltfBuilder b;
    Json& primitive = b.triangle();
    primitive["attributes"]["JOINTS_0"] =
        b.accessor(b.view(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5121, 3, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] = b.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
    primitive["targets"] = {{{"POSITION", b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)}}};
    b.json["meshes"][0]["weights"] = {0.5};
    b.json["skins"] = {{{"joints", {1, 2}}}};
    b.json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    b.node({{"mesh", 0},
            {"skin", 0},
            {"translation", {100, 0, 0}},
            {"children", {1}}});  // its own transform is ignored
    b.json["nodes"][0]["children"] = Json::array();
    b.node({{"translation", {0, 0, 0}}, {"children", {2}}});
    b.node({{"translation", {0, 10, 0}}});
    b.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = loadGlb(b, "skin");
    ASSERT_EQ(scene.instances.size(), 1u);
    expectNear(worldCorner(scene, 0, 0), {0, 0, 0.5f});
    expectNear(worldCorner(scene, 0, 1), {1, 10, 0.5f});
    EXPECT_TRUE(hasNote(scene, "rest pose"));
    EXPECT_TRUE(hasNote(scene, "animation"));
}

TEST(Gltf, ChoosesTheDefaultScene) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}, {"name", "first"}});
    b.node({{"mesh", 0}, {"name", "second"}});
    b.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    b.json["scene"] = 1;
    const Scene scene = loadGlb(b, "scenes");
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "second");
}

TEST(Gltf, TextFileWithExternalBuffer) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    const std::filesystem::path folder = folderOf("gltf_text");
    write(folder / "data one.bin", b.bytes());
    Json json = b.json;
    json["buffers"] = {{{"byteLength", b.bytes().size()}, {"uri", "data%20one.bin"}}};
    EXPECT_EQ(io::loadScene(write(folder / "a.gltf", json.dump())).triangleCount(), 1u);
    json["buffers"][0]["uri"] = "missing.bin";
    EXPECT_TRUE(contains(loadError(write(folder / "b.gltf", json.dump())), "missing.bin: no such file"));
    json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(b.bytes());
    EXPECT_EQ(io::loadScene(write(folder / "c.gltf", json.dump())).triangleCount(), 1u);
}

TEST(Gltf, RefusesWhatItCannotDo) {
    const auto changed = [](const std::string& name, const auto& change) {
        GltfBuilder b;
        b.triangle()["indices"] = b.indices({0, 1, 2});
        b.node({{"mesh", 0}});
        change(b.json);
        return glbError(b, "bad_" + name);
    };
    EXPECT_TRUE(contains(changed("required", [](Json& j) { j["extensionsRequired"] = {"EXT_unheard_of"}; }),
                         "EXT_unheard_of"));
    EXPECT_TRUE(contains(
        changed("cycle",
                [](Json& j) {
                    j["nodes"].push_back({{"children", {2}}}), j["nodes"].push_back({{"children", {1}}});
                }),
        "cycle"));
    EXPECT_TRUE(contains(changed("parents",
                                 [](Json& j) {
                                     j["nodes"][0]["children"] = {1, 1}, j["nodes"].push_back(Json::object());
                                 }),
                         "two parents"));
    EXPECT_TRUE(contains(changed("mesh", [](Json& j) { j["nodes"][0]["mesh"] = 7; }), "nodes[0].mesh"));
    EXPECT_TRUE(contains(changed("count", [](Json& j) { j["accessors"][0]["count"] = 4; }), "accessors[0]"));
    EXPECT_TRUE(
        contains(changed("huge", [](Json& j) { j["accessors"][0]["count"] = 18446744073709551615ull; }),
                 "accessors[0]"));
    EXPECT_TRUE(contains(
        changed("offset", [](Json& j) { j["bufferViews"][0]["byteOffset"] = 18446744073709551615ull; }),
        "bufferViews[0]"));
    EXPECT_TRUE(contains(changed("type", [](Json& j) { j["accessors"][0]["componentType"] = 5126; }),
                         "whole numbers"));
    EXPECT_TRUE(contains(
        changed("material", [](Json& j) { j["meshes"][0]["primitives"][0]["material"] = -1; }), "material"));
    EXPECT_TRUE(
        contains(changed("version", [](Json& j) { j["asset"]["version"] = "3.0"; }), "asset.version"));
    EXPECT_TRUE(contains(changed("scene", [](Json& j) { j["scene"] = 5; }), "scene"));
    GltfBuilder nan;
    nan.triangle()["attributes"]["POSITION"] = nan.floats({0, 0, 0, 1, NAN, 0, 0, 1, 0}, 3);
    nan.node({{"mesh", 0}});
    EXPECT_TRUE(contains(glbError(nan, "nan"), "not a finite number"));
    GltfBuilder range;
    range.triangle()["indices"] = range.indices({0, 1, 3});
    range.node({{"mesh", 0}});
    EXPECT_TRUE(contains(glbError(range, "range"), "index 3"));
    EXPECT_TRUE(
        contains(loadError(write(folderOf("gltf") / "deep.gltf", std::string(1'000'000, '['))), "nested"));
    EXPECT_TRUE(
        contains(loadError(write(folderOf("gltf") / "cut.glb", GltfBuilder().glb().substr(0, 19))), "GLB"));
}

TEST(Gltf, NamesOptionalExtensionsItLeavesOut) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    b.json["extensionsUsed"] = {"KHR_materials_iridescence", "KHR_texture_transform"};
    const Scene scene = loadGlb(b, "optional");
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_TRUE(contains(scene.notes[0], "KHR_materials_iridescence"));
}

TEST(Gltf, DeepNodeChainsDoNotOverflow) {
    GltfBuilder b;
    b.triangle();
    const int depth = 50'000;
    for (int i = 0; i < depth; ++i) b.json["nodes"].push_back({{"children", {i + 1}}});
    b.node({{"mesh", 0}});
    EXPECT_EQ(loadGlb(b, "chain").instances.size(), 1u);
}

TEST(Gltf, SurvivesDamage) {
    const std::string picture = png(2, 2, {1, 2, 3, 255});
    GltfBuilder b;
    Json& primitive = b.triangle();
    primitive["material"] = 0;
    primitive["indices"] = b.indices({0, 1, 2});
    primitive["attributes"]["TEXCOORD_0"] = b.floats({0, 0, 1, 0, 0, 1}, 2);
    const int view = b.view(std::vector<char>(picture.begin(), picture.end()));
    b.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                            {"normalTexture", {{"index", 0}}}}};
    b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.2}}}}};
    b.node({{"mesh", 0}, {"camera", 0}, {"rotation", {0, 0, 0, 1}}, {"children", {1}}});
    b.node({{"mesh", 0}, {"scale", {-1, 2, 1}}});
    const FuzzCount count = fuzz(b.glb(), folderOf("gltf") / "damaged.glb", 4000, 1);
    EXPECT_GT(count.loaded, 100) << "damage that harms nothing must not be refused";
    EXPECT_GT(count.refused, 1000);
}

TEST(Gltf, ReadsTheSharedModels) {
    const auto path = [](const char* name) { return testData(std::string("models/") + name); };
    if (!path("CesiumMan.glb")) GTEST_SKIP() << "test data absent";
    const Scene man = io::loadScene(*path("CesiumMan.glb"));
    EXPECT_EQ(man.triangleCount(), 4672u);
    EXPECT_GT(man.bounds().extent().y, 1.4f) << "stands upright, a man's height";
    const Scene helmet = io::loadScene(*path("DamagedHelmet.glb"));
    EXPECT_EQ(helmet.triangleCount(), 15452u);
    EXPECT_EQ(helmet.textures.size(), 4u);
    EXPECT_EQ(helmet.meshes.at(0).tangents.size(), helmet.meshes.at(0).positions.size());
    const Scene lights = io::loadScene(*path("lights_punctual_test.glb"));
    EXPECT_EQ(lights.lights.size(), 3u);
    EXPECT_EQ(lights.cameras.size(), 1u);
    for (const char* name : {"cornell.glb", "furnace.glb", "tunnel.glb", "two-rooms.glb"})
        EXPECT_GT(io::loadScene(*path(name)).triangleCount(), 0u) << name;
}

}  // namespace
}  // namespace conelight
