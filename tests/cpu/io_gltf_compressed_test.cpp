// SPDX-License-Identifier: MIT
// glTF files that are compressed: meshes by Draco and meshoptimizer, pictures as WebP. What is decoded is what
// was encoded, to the precision of the encoding; what is damaged is refused.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "cpu/gltf_test_support.h"
#ifdef CONELIGHT_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef CONELIGHT_HAS_MESHOPT
#include <meshoptimizer.h>
#endif
#ifdef CONELIGHT_HAS_WEBP
#include <webp/encode.h>
#endif

namespace conelight {
namespace {

using namespace test;

// A grid of (n+1)^2 vertices over a wavy square.
struct Sheet {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;
};

Sheet sheet(int n) {
    Sheet out;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const glm::vec2 uv(float(x) / float(n), float(y) / float(n));
            const float slope = std::cos(glm::two_pi<float>() * uv.x);
            out.positions.emplace_back(uv, 0.1f * std::sin(glm::two_pi<float>() * uv.x));
            out.normals.push_back(glm::normalize(glm::vec3(-0.2f * glm::pi<float>() * slope, 0, 1)));
            out.uvs.push_back(uv);
        }
    const auto at = [&](int x, int y) { return std::uint32_t(y * (n + 1) + x); };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (const std::uint32_t index :
                 {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)})
                out.indices.push_back(index);
    return out;
}

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

#ifdef CONELIGHT_HAS_DRACO

struct Packed {
    std::vector<char> bytes;
    std::size_t points = 0;
};

Packed dracoBytes(const Sheet& from) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(int(from.indices.size() / 3));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    for (std::size_t f = 0; f < from.indices.size() / 3; ++f) {
        const std::uint32_t* const c = &from.indices[3 * f];
        const draco::FaceIndex face{std::uint32_t(f)};
        builder.SetAttributeValuesForFace(position, face, &from.positions[c[0]], &from.positions[c[1]],
                                          &from.positions[c[2]]);
        builder.SetAttributeValuesForFace(normal, face, &from.normals[c[0]], &from.normals[c[1]],
                                          &from.normals[c[2]]);
        builder.SetAttributeValuesForFace(uv, face, &from.uvs[c[0]], &from.uvs[c[1]], &from.uvs[c[2]]);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 14);
    encoder.SetTrackEncodedProperties(true);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {{buffer.data(), buffer.data() + buffer.size()}, encoder.num_encoded_points()};
}

GltfBuilder dracoFile(const Sheet& from, const Packed& packed) {
    GltfBuilder b;
    const int view = b.view(packed.bytes);
    const auto accessor = [&](std::size_t count, int type, const char* kind) {
        b.json["accessors"].push_back({{"componentType", type}, {"count", count}, {"type", kind}});
        return int(b.json["accessors"].size()) - 1;
    };
    const int indices = accessor(from.indices.size(), 5123, "SCALAR");
    const int positions = accessor(packed.points, 5126, "VEC3");
    const int normals = accessor(packed.points, 5126, "VEC3");
    const int uvs = accessor(packed.points, 5126, "VEC2");
    b.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
            {"indices", indices},
            {"extensions",
             {{"KHR_draco_mesh_compression",
               {{"bufferView", view},
                {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}}}}}}}}}};
    b.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    b.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    b.node({{"mesh", 0}});
    return b;
}

TEST(GltfDraco, GivesWhatWasEncoded) {
    const Sheet from = sheet(20);
    const Scene scene = loadGlb(dracoFile(from, dracoBytes(from)), "draco");
    EXPECT_TRUE(scene.notes.empty());
    // A part in 4096 of a normal is the coarsest.
    expectSheet(scene.meshes.at(0), from, 1e-3f);
}

TEST(GltfDraco, ReadsAFileOfAnotherProgram) {
    const std::filesystem::path path = "/usr/share/assimp/models/glTF2/draco/2CylinderEngine.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no assimp-testmodels";
    const Scene scene = io::loadScene(path);
    EXPECT_EQ(scene.triangleCount(), 110'336u);
    EXPECT_GT(scene.instances.size(), 30u);
}

TEST(GltfDraco, RefusesWhatIsDamaged) {
    const Sheet from = sheet(20);
    const Packed packed = dracoBytes(from);
    Packed cut = packed;
    cut.bytes.resize(cut.bytes.size() / 2);
    EXPECT_TRUE(contains(glbError(dracoFile(from, cut), "draco_cut"), "KHR_draco_mesh_compression"));
    Packed fewer = packed;
    --fewer.points;
    EXPECT_TRUE(contains(glbError(dracoFile(from, fewer), "draco_count"), "vertices; the accessor says"));
    GltfBuilder unknown = dracoFile(from, packed);
    unknown.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
                ["NORMAL"] = 77;
    EXPECT_TRUE(contains(glbError(unknown, "draco_attribute"), "attribute 77"));
    // Every byte turned, one after the other: loaded, or one line.
    for (std::size_t i = 0; i < packed.bytes.size(); i += 37) {
        Packed damaged = packed;
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

#endif

#ifdef CONELIGHT_HAS_MESHOPT

// A buffer view that is compressed, into the buffer of the file.
int packedView(GltfBuilder& b, const std::vector<unsigned char>& packed, std::size_t count,
               std::size_t stride, const char* mode, const char* filter = "NONE") {
    const int inner = b.view(packed);
    Json& from = b.json["bufferViews"][std::size_t(inner)];
    // The view itself names a buffer that has no bytes, as files that have nothing else do.
    Json view = {{"buffer", 1}, {"byteLength", count * stride}};
    if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", from["byteOffset"]},
                                                     {"byteLength", from["byteLength"]},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode},
                                                     {"filter", filter}};
    from = std::move(view);
    return inner;
}

std::vector<unsigned char> packedVertices(const void* data, std::size_t count, std::size_t stride) {
    std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
    return out;
}

GltfBuilder meshoptFile(const Sheet& from, bool sequence) {
    GltfBuilder b;
    const std::size_t count = from.positions.size();
    // Positions with 23 bits of mantissa, normals in 8 bits, coordinates as they are.
    std::vector<unsigned char> positions(12 * count), normals(4 * count);
    meshopt_encodeFilterExp(positions.data(), count, 12, 23, &from.positions[0].x);
    std::vector<glm::vec4> four;
    for (const glm::vec3& n : from.normals) four.emplace_back(n, 0);
    meshopt_encodeFilterOct(normals.data(), count, 4, 8, &four[0].x);
    const int position = b.accessor(
        packedView(b, packedVertices(positions.data(), count, 12), count, 12, "ATTRIBUTES", "EXPONENTIAL"),
        5126, count, "VEC3");
    const int normal = b.accessor(
        packedView(b, packedVertices(normals.data(), count, 4), count, 4, "ATTRIBUTES", "OCTAHEDRAL"), 5120,
        count, "VEC3");
    b.json["accessors"][std::size_t(normal)]["normalized"] = true;
    const int uv =
        b.accessor(packedView(b, packedVertices(from.uvs.data(), count, 8), count, 8, "ATTRIBUTES"), 5126,
                   count, "VEC2");
    std::vector<unsigned char> indices;
    if (sequence) {
        indices.resize(meshopt_encodeIndexSequenceBound(from.indices.size(), count));
        indices.resize(meshopt_encodeIndexSequence(indices.data(), indices.size(), from.indices.data(),
                                                   from.indices.size()));
    } else {
        indices.resize(meshopt_encodeIndexBufferBound(from.indices.size(), count));
        indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), from.indices.data(),
                                                 from.indices.size()));
    }
    const int index =
        b.accessor(packedView(b, indices, from.indices.size(), 4, sequence ? "INDICES" : "TRIANGLES"), 5125,
                   from.indices.size(), "SCALAR");
    b.json["meshes"] = {{{"primitives",
                          {{{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
                            {"indices", index}}}}}};
    b.json["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    b.json["extensionsRequired"] = b.json["extensionsUsed"];
    b.node({{"mesh", 0}});
    return b;
}

TEST(GltfMeshopt, GivesWhatWasEncoded) {
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

#endif

#ifdef CONELIGHT_HAS_WEBP

TEST(GltfWebp, IsTakenBeforeThePlainPicture) {
    const std::vector<std::uint8_t> texels = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 255, 9, 9, 9, 255};
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(texels.data(), 2, 2, 8, &encoded);
    ASSERT_GT(size, 0u);
    const std::vector<std::uint8_t> webp(encoded, encoded + size);
    WebPFree(encoded);
    const std::string plain = png(1, 1, {1, 2, 3, 255});

    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["images"] = {
        {{"bufferView", b.view(std::vector<char>(plain.begin(), plain.end()))}, {"mimeType", "image/png"}},
        {{"bufferView", b.view(webp)}, {"mimeType", "image/webp"}}};
    b.json["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    b.json["extensionsUsed"] = {"EXT_texture_webp"};
    b.node({{"mesh", 0}});
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

#endif

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
