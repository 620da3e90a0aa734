// SPDX-License-Identifier: MIT
// glTF files that are compressed: meshes by Draco and meshoptimizer, pictures as WebP. What is decoded is what
// was encoded, to the precision of the encoding; what is damaged is refused.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "cpu/gltf_test_support.h"
#include "support/compressed_gltf.h"

namespace conelight {
namespace {

using namespace test;

// Corners of triangles in an order that does not depend on that of vertices and triangles.
std::vector<std::array<float, 8>> cornersOf(const Mesh& mesh) {
    std::vector<std::array<float, 8>> out;
    for (const std::uint32_t i : mesh.indices) {
        const glm::vec3 p = mesh.positions.at(i), n = mesh.normals.at(i);
        const glm::vec2 uv = mesh.uvs.at(i);
        out.push_back({std::round(p.x * 100), std::round(p.y * 100), p.z, n.x, n.y, n.z, uv.x, uv.y});
    }
    std::sort(out.begin(), out.end(),
              [](const auto& a, const auto& b) { return std::pair(a[0], a[1]) < std::pair(b[0], b[1]); });
    return out;
}

void expectSheet(const Mesh& mesh, const Sheet& from, float tolerance) {
    Mesh plain;
    plain.positions = from.positions;
    plain.normals = from.normals;
    plain.uvs = from.uvs;
    plain.indices = from.indices;
    const auto expected = cornersOf(plain), found = cornersOf(mesh);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t c = 0; c < found[i].size(); ++c)
            ASSERT_NEAR(found[i][c], expected[i][c], tolerance) << "corner " << i << ", number " << c;
}

TEST(GltfDraco, GivesWhatWasEncoded) {
    if (!packsDraco()) GTEST_SKIP() << "built without it";
    const Sheet from = sheet(20);
    const Scene scene = loadGlb(dracoFile(from, dracoBytes(from)), "draco");
    EXPECT_TRUE(scene.notes.empty());
    // A part in 4096 of a normal is the coarsest.
    expectSheet(scene.meshes.at(0), from, 1e-3f);
}

TEST(GltfDraco, ReadsAFileOfAnotherProgram) {
    if (!packsDraco()) GTEST_SKIP() << "built without it";
    const std::filesystem::path path = "/usr/share/assimp/models/glTF2/draco/2CylinderEngine.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no assimp-testmodels";
    const Scene scene = io::loadScene(path);
    EXPECT_EQ(scene.triangleCount(), 110'336u);
    EXPECT_GT(scene.instances.size(), 30u);
}

TEST(GltfDraco, RefusesWhatIsDamaged) {
    if (!packsDraco()) GTEST_SKIP() << "built without it";
    const Sheet from = sheet(20);
    const DracoBytes packed = dracoBytes(from);
    DracoBytes cut = packed;
    cut.bytes.resize(cut.bytes.size() / 2);
    EXPECT_TRUE(contains(glbError(dracoFile(from, cut), "draco_cut"), "KHR_draco_mesh_compression"));
    DracoBytes fewer = packed;
    --fewer.points;
    EXPECT_TRUE(contains(glbError(dracoFile(from, fewer), "draco_count"), "vertices; the accessor says"));
    GltfBuilder unknown = dracoFile(from, packed);
    unknown.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
                ["NORMAL"] = 77;
    EXPECT_TRUE(contains(glbError(unknown, "draco_attribute"), "attribute 77"));
    // Every byte turned, one after the other: loaded, or one line.
    for (std::size_t i = 0; i < packed.bytes.size(); i += 37) {
        DracoBytes damaged = packed;
        damaged.bytes[i] = char(~damaged.bytes[i]);
        const std::filesystem::path path =
            write(folderOf("gltf") / "draco_damaged.glb", dracoFile(from, damaged).glb());
        try {
            io::loadScene(path);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput) << error.what();
        }
    }
}

TEST(GltfMeshopt, GivesWhatWasEncoded) {
    if (!packsMeshopt()) GTEST_SKIP() << "built without it";
    const Sheet from = sheet(20);
    for (const bool sequence : {false, true}) {
        const Scene scene = loadGlb(meshoptFile(from, sequence), "meshopt");
        EXPECT_TRUE(scene.notes.empty());
        expectSheet(scene.meshes.at(0), from, 2e-2f);  // normals of 8 bits
        for (const glm::vec3& p : scene.meshes.at(0).positions)
            EXPECT_NEAR(p.z, 0.1f * std::sin(glm::two_pi<float>() * p.x), 1e-5f);
    }
}

TEST(GltfMeshopt, RefusesWhatIsDamaged) {
    if (!packsMeshopt()) GTEST_SKIP() << "built without it";
    const Sheet from = sheet(20);
    const auto changed = [&](const std::function<void(Json&)>& change) {
        GltfBuilder b = meshoptFile(from, false);
        change(b.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
        return glbError(b, "meshopt_bad");
    };
    EXPECT_TRUE(contains(changed([](Json& e) { e["mode"] = "BOXES"; }), "'BOXES' is unknown"));
    EXPECT_TRUE(contains(changed([](Json& e) { e["filter"] = "BLUR"; }), "'BLUR'"));
    EXPECT_TRUE(contains(changed([](Json& e) { e["count"] = 1'000'000'000; }), "cannot be in"));
    EXPECT_TRUE(contains(changed([](Json& e) { e["byteStride"] = 6; }), "multiple of 4"));
    EXPECT_TRUE(contains(changed([](Json& e) { e["byteLength"] = 20; }), "bufferViews[0]"));
    EXPECT_TRUE(contains(changed([](Json& e) { e["buffer"] = 9; }), "out of range"));
}

TEST(GltfWebp, IsTakenBeforeThePlainPicture) {
    if (!packsWebp()) GTEST_SKIP() << "built without it";
    const std::vector<std::uint8_t> texels = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 255, 9, 9, 9, 255};
    const std::vector<std::uint8_t> webp = webpBytes(2, 2, texels);
    const GltfBuilder b = webpFile(webp, png(1, 1, {1, 2, 3, 255}));
    ASSERT_EQ(b.json["extensionsUsed"], Json({"EXT_texture_webp"}));
    const Scene scene = loadGlb(b, "webp");
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].width, 2);
    EXPECT_EQ(scene.textures[0].rgba, texels);
    EXPECT_TRUE(scene.notes.empty());

    // Cut: named, and the surface is drawn without.
    GltfBuilder cut = b;
    cut.json["bufferViews"][2]["byteLength"] = webp.size() / 2;
    const Scene without = loadGlb(cut, "webp_cut");
    EXPECT_TRUE(hasNote(without, "images[1]"));
    EXPECT_FALSE(without.materials.at(0).baseColorTexture.used());
}

TEST(GltfCompressed, Ktx2IsNamed) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    const std::string ktx = "\xABKTX 20\xBB\r\n\x1A\n and more";
    b.json["images"] = {{{"bufferView", b.view(std::vector<char>(ktx.begin(), ktx.end()))}}};
    b.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    b.json["extensionsUsed"] = {"KHR_texture_basisu"};
    b.json["extensionsRequired"] = {"KHR_texture_basisu"};
    b.node({{"mesh", 0}});
    const Scene scene = loadGlb(b, "ktx2");
    EXPECT_TRUE(hasNote(scene, "is KTX2"));
    EXPECT_FALSE(scene.materials.at(0).baseColorTexture.used());
    EXPECT_EQ(scene.instances.size(), 1u);
}

}  // namespace
}  // namespace conelight
