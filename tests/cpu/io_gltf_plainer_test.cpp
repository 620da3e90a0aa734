// SPDX-License-Identifier: MIT
// Files with extensions of glTF that pictures go without: what stands beside them is read, and a note says so where
// a picture lacks something. docs/reference/gltf.md, rows "plainer" and "no picture".
#include <fmt/core.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "cpu/gltf_test_support.h"
#include "io/animation.h"
#include "io/gltf_extensions.h"

namespace conelight {
namespace {

using namespace test;

// A triangle of a red material with this extension in the file, as `add` puts it there.
GltfBuilder with(const std::string& extension, const std::function<void(Json& file)>& add) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.1, 0.1, 1}}}}}};
    b.node({{"mesh", 0}});
    b.json["extensionsUsed"] = {extension};
    add(b.json);
    return b;
}

// The triangle and its colour are there.
void expectRed(const Scene& scene) {
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(scene.instances[0].visible);
    EXPECT_NEAR(scene.materials.at(scene.instances[0].material).baseColor.r, 0.8f, kTight);
    EXPECT_NEAR(scene.materials.at(scene.instances[0].material).baseColor.g, 0.1f, kTight);
}

TEST(GltfPlainer, MaterialsKeepWhatStandsBeside) {
    const std::pair<const char*, Json> kExtensions[] = {
        {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.6}, {"anisotropyRotation", 1.57}}},
        {"KHR_materials_diffuse_transmission",
         {{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", {0.4, 0.8, 0.2}}}},
        {"KHR_materials_dispersion", {{"dispersion", 0.1}}},
        {"KHR_materials_iridescence", {{"iridescenceFactor", 1}, {"iridescenceIor", 1.3}}}};
    for (const auto& [name, content] : kExtensions) {
        const GltfBuilder b =
            with(name, [&](Json& file) { file["materials"][0]["extensions"][name] = content; });
        const Scene scene = loadGlb(b, name);
        expectRed(scene);
        EXPECT_TRUE(hasNote(scene, name));
    }
}

TEST(GltfPlainer, TheFirstVariantIsDrawn) {
    const std::string name = "KHR_materials_variants";
    const GltfBuilder b = with(name, [&](Json& file) {
        file["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.1, 0.8, 1}}}}});
        file["extensions"][name]["variants"] = {{{"name", "red"}}, {{"name", "blue"}}};
        file["meshes"][0]["primitives"][0]["extensions"][name]["mappings"] = {
            {{"material", 0}, {"variants", {0}}}, {{"material", 1}, {"variants", {1}}}};
    });
    const Scene scene = loadGlb(b, "variants");
    expectRed(scene);
    EXPECT_TRUE(hasNote(scene, name));
}

TEST(GltfPlainer, ThePlainPictureStandsForDds) {
    const std::string name = "MSFT_texture_dds";
    GltfBuilder b = with(name, [&](Json& file) {
        file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
        file["textures"] = {{{"source", 0}, {"extensions", {{name, {{"source", 1}}}}}}};
    });
    const std::string plain = png(2, 2, {10, 20, 30, 255}), dds = "DDS |";
    const int first = b.view(std::vector<char>(plain.begin(), plain.end()));
    const int second = b.view(std::vector<char>(dds.begin(), dds.end()));
    b.json["images"] = {{{"bufferView", first}, {"mimeType", "image/png"}},
                        {{"bufferView", second}, {"mimeType", "image/vnd-ms.dds"}}};
    const Scene scene = loadGlb(b, "dds");
    expectRed(scene);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].rgba.at(2), 30);
    EXPECT_TRUE(hasNote(scene, name));
}

TEST(GltfPlainer, WhatAddsNothingToAPictureIsPassedOver) {
    const std::pair<const char*, std::function<void(Json & file, const char* name)>> kExtensions[] = {
        {"KHR_audio_emitter",
         [](Json& file, const char* name) {
             file["extensions"][name] = {{"audio", {{{"uri", "horn.mp3"}}}},
                                         {"sources", {{{"audio", 0}}}},
                                         {"emitters", {{{"type", "global"}, {"sources", {0}}}}}};
             file["nodes"][0]["extensions"][name]["emitter"] = 0;
         }},
        {"KHR_xmp",
         [](Json& file, const char* name) {
             file["extensions"][name]["packets"] = {{{"dc:title", "a triangle"}}};
             file["asset"]["extensions"][name]["packet"] = 0;
         }},
        {"KHR_xmp_json_ld",
         [](Json& file, const char* name) {
             file["extensions"][name]["packets"] = {
                 {{"@context", {{"dc", "http://purl.org/dc/elements/1.1/"}}}, {"dc:title", "a triangle"}}};
             file["asset"]["extensions"][name]["packet"] = 0;
         }},
        {"VRM",
         [](Json& file, const char* name) {
             file["extensions"][name] = {{"specVersion", "0.0"}, {"meta", {{"title", "a figure"}}}};
         }},
        {"VRMC_vrm", [](Json& file, const char* name) {
             file["extensions"][name] = {{"specVersion", "1.0"},
                                         {"humanoid", {{"humanBones", Json::object()}}}};
         }}};
    for (const auto& [name, add] : kExtensions) {
        const Scene scene = loadGlb(with(name, [&](Json& file) { add(file, name); }), name);
        expectRed(scene);
        EXPECT_TRUE(scene.notes.empty()) << name;
    }
}

// A channel moves a colour, another one the node: the node moves.
TEST(GltfPlainer, PointersOfAnimationsStandStill) {
    const std::string name = "KHR_animation_pointer";
    GltfBuilder b = with(name, [](Json&) {});
    const int times = b.floats({0, 1}, 1);
    const int colours = b.floats({1, 0, 0, 1, 0, 0, 1, 1}, 4), places = b.floats({0, 0, 0, 4, 0, 0}, 3);
    const Json pointer = {{"pointer", "/materials/0/pbrMetallicRoughness/baseColorFactor"}};
    b.json["animations"] = {
        {{"name", "go"},
         {"samplers", {{{"input", times}, {"output", colours}}, {{"input", times}, {"output", places}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"path", "pointer"}, {"extensions", {{name, pointer}}}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    io::SceneAnimation animation;
    const Scene rest = io::loadAnimatedScene(write(folderOf("gltf") / "pointer.glb", b.glb()), {}, animation);
    expectRed(rest);
    ASSERT_EQ(animation.clips.size(), 1u);
    Scene posed = rest;
    io::poseScene(animation, 0, 0.5f, rest, posed);
    expectRed(posed);
    EXPECT_NEAR(posed.instances[0].worldFromObject[3].x, 2, kTight);
}

// Rows of the page are those of the importer's list, and each names tests that there are.
TEST(GltfPlainer, EachRowOfThePageHasTests) {
    std::ifstream file(std::string(CONELIGHT_SOURCE_DIR) + "/docs/reference/gltf.md");
    std::set<std::string> rows;
    std::map<std::string, std::string> suites;  // with the text of the files that have tests of them
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(CONELIGHT_SOURCE_DIR) + "/tests/cpu")) {
        std::ifstream test(entry.path());
        const std::string text{std::istreambuf_iterator<char>(test), {}};
        const std::regex names("TEST(?:_F)?\\((\\w+),");
        std::set<std::string> here;
        for (std::sregex_iterator i(text.begin(), text.end(), names), end; i != end; ++i)
            here.insert((*i)[1]);
        for (const std::string& suite : here) suites[suite] += text;
    }
    const std::regex row("\\| `(\\w+)` \\|.*\\| (?:`(\\w+)` )?\\|");
    for (std::string line; std::getline(file, line);) {
        std::smatch parts;
        if (!std::regex_match(line, parts, row)) continue;
        rows.insert(parts[1]);
        EXPECT_NE(suites[parts[2]].find(parts[1]), std::string::npos) << line;
    }
    std::set<std::string> listed;
    for (const io::GltfExtension& extension : io::gltfExtensions()) listed.emplace(extension.name);
    EXPECT_EQ(rows, listed);
}

}  // namespace
}  // namespace conelight
