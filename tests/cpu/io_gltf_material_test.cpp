// SPDX-License-Identifier: MIT
// glTF: materials with their extensions, textures from every source, tangents of normal maps.
#include <cstddef>

#include "cpu/gltf_test_support.h"
#include "io/scene_file.h"
#include "io/scene_write.h"

namespace conelight {
namespace {

using namespace test;

TEST(Gltf, MaterialsWithExtensions) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["materials"] = {
        {{"name", "m"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.75},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_specular", {{"specularFactor", 0.3}, {"specularColorFactor", {1, 2, 3}}}},
           {"KHR_materials_unlit", Json::object()}}}}};
    b.node({{"mesh", 0}});
    const Material m = loadGlb(b, "material").materials.at(0);
    EXPECT_EQ(m.name, "m");
    expectNear(glm::vec3(m.baseColor), {0.1f, 0.2f, 0.3f});
    EXPECT_FLOAT_EQ(m.baseColor.a, 0.4f);
    EXPECT_FLOAT_EQ(m.metallic, 0.5f);
    EXPECT_FLOAT_EQ(m.roughness, 0.25f);
    expectNear(m.emission, {8, 4, 0});
    EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
    EXPECT_FLOAT_EQ(m.alphaCutoff, 0.75f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(m.unlit);
    EXPECT_FLOAT_EQ(m.ior, 1.33f);
    EXPECT_FLOAT_EQ(m.specular, 0.3f);
    expectNear(m.specularColor, {1, 2, 3});
}

// A dielectric of that reflectance; glossiness of a picture's alpha becomes a picture of roughness.
TEST(Gltf, ReadsSpecularGlossiness) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    const std::string picture = png(1, 1, {200, 100, 50, 102});
    b.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
    b.json["textures"] = {{{"source", 0}}};
    const char* extension = "KHR_materials_pbrSpecularGlossiness";
    const Json plain = {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                        {"specularFactor", {0.02, 0.04, 0.08}},
                        {"glossinessFactor", 0.75}};
    Json textured = plain;
    textured["specularGlossinessTexture"] = {{"index", 0}};
    b.json["materials"] = {{{"name", "plain"}, {"extensions", {{extension, plain}}}},
                           {{"name", "textured"}, {"extensions", {{extension, textured}}}}};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "specular_glossiness");
    const Material& m = scene.materials.at(0);
    expectNear(glm::vec3(m.baseColor), {0.1f, 0.2f, 0.3f});
    EXPECT_FLOAT_EQ(m.baseColor.a, 0.4f);
    EXPECT_FLOAT_EQ(m.metallic, 0);
    EXPECT_FLOAT_EQ(m.roughness, 0.25f);
    expectNear(m.specularColor, {0.5f, 1, 2});
    const Material& t = scene.materials.at(1);
    ASSERT_TRUE(t.specularColorTexture.used() && t.metallicRoughnessTexture.used());
    EXPECT_FLOAT_EQ(t.roughness, 1);
    // 1 - 0.75 * 102 / 255
    EXPECT_EQ(scene.textures.at(static_cast<std::size_t>(t.metallicRoughnessTexture.texture)).rgba.at(1),
              179);
}

TEST(Gltf, ReadsGlass) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["materials"] = {
        {{"name", "glass"},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 0.5}, {"attenuationDistance", 2}, {"attenuationColor", {0.5, 0, 1}}}},
           {"KHR_materials_ior", {{"ior", 1.4}}}}}},
        {{"name", "pane"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 7}}}}}}};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "glass");
    const Material& glass = scene.materials.at(0);
    EXPECT_FLOAT_EQ(glass.transmission, 0.9f);
    EXPECT_FLOAT_EQ(glass.thickness, 0.5f);
    EXPECT_FLOAT_EQ(glass.attenuationDistance, 2);
    EXPECT_FLOAT_EQ(glass.ior, 1.4f);
    // Black would absorb without end.
    expectNear(glass.attenuationColor, {0.5f, 1e-4f, 1});
    EXPECT_TRUE(scene.notes.empty());
    const Material& pane = scene.materials.at(1);
    EXPECT_FLOAT_EQ(pane.transmission, 1);
    EXPECT_FLOAT_EQ(pane.thickness, 0);
}

// One material with all of coat and sheen, one of glass with a coat.
GltfBuilder layeredMaterials() {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = b.floats({0, 0, 1, 0, 0, 1}, 2);
    b.json["images"] = {{{"uri", "data:image/png;base64," + base64(png(1, 1, {200, 100, 50, 102}))}}};
    b.json["textures"] = {{{"source", 0}}};
    const Json map = {{"index", 0}};
    Json normals = map;
    normals["scale"] = 0.5;
    b.json["materials"] = {{{"name", "both"},
                            {"extensions",
                             {{"KHR_materials_clearcoat",
                               {{"clearcoatFactor", 0.8},
                                {"clearcoatRoughnessFactor", 0.1},
                                {"clearcoatTexture", map},
                                {"clearcoatRoughnessTexture", map},
                                {"clearcoatNormalTexture", normals}}},
                              {"KHR_materials_sheen",
                               {{"sheenColorFactor", {0.1, 0.2, 3}},
                                {"sheenRoughnessFactor", 0.6},
                                {"sheenColorTexture", map},
                                {"sheenRoughnessTexture", map}}}}}},
                           {{"name", "lacquered glass"},
                            {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                            {"extensions",
                             {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}},
                              {"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}}};
    b.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_sheen",
                                "KHR_materials_transmission"};
    b.node({{"mesh", 0}});
    return b;
}

TEST(Gltf, ReadsCoatAndSheen) {
    const GltfBuilder b = layeredMaterials();
    const Scene scene = loadGlb(b, "layers");
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(hasLayers(m));
    EXPECT_FLOAT_EQ(m.coat, 0.8f);
    EXPECT_FLOAT_EQ(m.coatRoughness, 0.1f);
    EXPECT_FLOAT_EQ(m.coatNormalScale, 0.5f);
    expectNear(m.sheenColor, {0.1f, 0.2f, 1});
    EXPECT_FLOAT_EQ(m.sheenRoughness, 0.6f);
    for (const TextureRef* use : {&m.coatTexture, &m.coatRoughnessTexture, &m.coatNormalTexture,
                                  &m.sheenColorTexture, &m.sheenRoughnessTexture})
        ASSERT_TRUE(use->used());
    EXPECT_TRUE(scene.textures.at(std::size_t(m.sheenColorTexture.texture)).srgb);
    EXPECT_FALSE(scene.textures.at(std::size_t(m.sheenRoughnessTexture.texture)).srgb);
    EXPECT_FALSE(scene.textures.at(std::size_t(m.coatTexture.texture)).srgb);
    // A map of the coat alone needs tangents.
    EXPECT_EQ(scene.meshes.at(0).tangents.size(), 3u);
    // Glass is drawn without: said once, of the material that loses it.
    EXPECT_FALSE(hasLayers(scene.materials.at(1)));
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_TRUE(contains(scene.notes[0], "'lacquered glass': glass is drawn without its clear coat"));

    const std::filesystem::path path = folderOf("gltf") / "layers_again.glb";
    io::writeScene(path.string(), scene, true);
    const Material again = io::loadScene(path.string()).materials.at(0);
    EXPECT_EQ(again.coat, m.coat);
    EXPECT_EQ(again.coatRoughness, m.coatRoughness);
    EXPECT_EQ(again.coatNormalScale, m.coatNormalScale);
    EXPECT_EQ(again.sheenColor, m.sheenColor);
    EXPECT_EQ(again.sheenRoughness, m.sheenRoughness);
    EXPECT_TRUE(again.coatTexture.used() && again.coatRoughnessTexture.used() &&
                again.coatNormalTexture.used() && again.sheenColorTexture.used() &&
                again.sheenRoughnessTexture.used());
}

TEST(Gltf, PrimitiveWithoutMaterialGetsTheFormatsDefault) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "default");
    const Material& m = scene.materials.at(std::size_t(scene.instances.at(0).material));
    EXPECT_EQ(m.baseColor, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
}

TEST(Gltf, TexturesFromBufferUriAndFile) {
    const std::string picture = png(2, 3, {10, 20, 30, 40});
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = b.floats({0, 0, 1, 0, 0, 1}, 2);
    const int view = b.view(std::vector<char>(picture.begin(), picture.end()));
    write(folderOf("gltf") / "with space.png", picture);
    b.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}},
                        {{"uri", "data:image/png;base64," + base64(picture)}},
                        {{"uri", "with%20space.png"}}};
    b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    b.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 2}}};
    b.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"emissiveTexture", {{"index", 2}}}}};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "textures");
    ASSERT_EQ(scene.textures.size(), 3u);
    for (const Texture& t : scene.textures) {
        EXPECT_EQ(t.width, 2);
        EXPECT_EQ(t.height, 3);
        ASSERT_EQ(t.rgba.size(), 24u);
        EXPECT_EQ(t.rgba[1], 20);
    }
    const Material& m = scene.materials[0];
    const Texture& base = scene.textures[std::size_t(m.baseColorTexture.texture)];
    EXPECT_TRUE(base.srgb);
    EXPECT_EQ(base.wrapU, TextureWrap::Clamp);
    EXPECT_EQ(base.wrapV, TextureWrap::Mirror);
    EXPECT_EQ(base.filter, TextureFilter::Nearest);
    EXPECT_FALSE(scene.textures[std::size_t(m.metallicRoughnessTexture.texture)].srgb);
    EXPECT_TRUE(scene.textures[std::size_t(m.emissiveTexture.texture)].srgb);
}

TEST(Gltf, BrokenPictureIsANote) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "broken_picture");
    EXPECT_FALSE(scene.materials[0].baseColorTexture.used());
    EXPECT_TRUE(hasNote(scene, "images[0]"));
}

// Numbers of the extension's own test model: its arrow's tip at uv (0.778, 0.778) must show up, turned
// by 22.5 degrees, at uv (0.421, 1.016).
TEST(Gltf, TextureTransformTurnsAsTheTestModelSays) {
    const std::string picture = png(1, 1, {255, 255, 255, 255});
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
    b.json["textures"] = {{{"source", 0}}};
    const auto material = [](const Json& transform) {
        return Json{
            {"pbrMetallicRoughness",
             {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}};
    };
    b.json["materials"] = {material({{"rotation", 0.39269908}}),
                           material({{"offset", {0.5, 0.25}}, {"scale", {2, 3}}})};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "transform");
    const glm::vec3 turned = scene.materials[0].baseColorTexture.uvFromUv * glm::vec3(0.42095f, 1.01627f, 1);
    EXPECT_NEAR(turned.x, 0.7778f, 1e-3f);
    EXPECT_NEAR(turned.y, 0.7778f, 1e-3f);
    expectNear(scene.materials[1].baseColorTexture.uvFromUv * glm::vec3(1, 1, 1), {2.5f, 3.25f, 1});
}

TEST(Gltf, MakesTangentsForNormalMaps) {
    const std::string picture = png(1, 1, {128, 128, 255, 255});
    GltfBuilder b;
    b.triangle()["material"] = 0;
    // Upright mapping: u to the right, v down; the bitangent must point up.
    b.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = b.floats({0, 1, 1, 1, 0, 0}, 2);
    b.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"normalTexture", {{"index", 0}, {"scale", 0.5}}}}};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "tangents");
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.tangents.size(), 3u);
    EXPECT_FLOAT_EQ(scene.materials[0].normalScale, 0.5f);
    for (std::size_t i = 0; i < 3; ++i) {
        expectNear(glm::vec3(mesh.tangents[i]), {1, 0, 0});
        expectNear(mesh.tangents[i].w * glm::cross(mesh.normals[i], glm::vec3(mesh.tangents[i])), {0, 1, 0});
    }
}

TEST(Gltf, SplitsVerticesWhereTheMappingIsMirrored) {
    const std::string picture = png(1, 1, {128, 128, 255, 255});
    GltfBuilder b;
    const int positions = b.floats({-1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0}, 3);
    const int uvs = b.floats({1, 1, 0, 1, 0, 0, 1, 1}, 2);  // u grows away from the middle on both sides
    const int indices = b.indices({0, 1, 2, 1, 3, 2});
    b.json["meshes"] = {{{"primitives",
                          {{{"attributes",
                             {{"POSITION", positions},
                              {"TEXCOORD_0", uvs},
                              {"NORMAL", b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)}}},
                            {"indices", indices},
                            {"material", 0}}}}}};
    b.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    b.node({{"mesh", 0}});
    const Mesh mesh = loadGlb(b, "mirrored_uv").meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), 6u) << "the two shared vertices exist twice";
    for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t at = mesh.indices[3 * t + c];
            EXPECT_NEAR(mesh.tangents[at].x, t == 0 ? -1.0f : 1.0f, kTight);
            EXPECT_EQ(mesh.tangents[at].w, t == 0 ? -1.0f : 1.0f);
        }
}

}  // namespace
}  // namespace conelight
