// SPDX-License-Identifier: MIT
// See compressed_gltf.h. The definitions CONELIGHT_HAS_* are this file's alone (tests/CMakeLists.txt).
#include "support/compressed_gltf.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

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

namespace conelight::test {

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

#ifdef CONELIGHT_HAS_DRACO

bool packsDraco() { return true; }

DracoBytes dracoBytes(const Sheet& from) {
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

#else

bool packsDraco() { return false; }
DracoBytes dracoBytes(const Sheet&) { return {}; }

#endif

GltfBuilder dracoFile(const Sheet& from, const DracoBytes& packed) {
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

#ifdef CONELIGHT_HAS_MESHOPT

bool packsMeshopt() { return true; }

namespace {

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

// Vectors of three floats, of a mantissa of 23 bits and an exponent that the three share.
void encodePositions(std::vector<unsigned char>& out, const std::vector<glm::vec3>& from) {
#if MESHOPTIMIZER_VERSION < 190  // knows no other kind
    meshopt_encodeFilterExp(out.data(), from.size(), 12, 23, &from[0].x);
#else
    meshopt_encodeFilterExp(out.data(), from.size(), 12, 23, &from[0].x, meshopt_EncodeExpSharedVector);
#endif
}

}  // namespace

GltfBuilder meshoptFile(const Sheet& from, bool sequence) {
    GltfBuilder b;
    const std::size_t count = from.positions.size();
    // Positions with 23 bits of mantissa, normals in 8 bits, coordinates as they are.
    std::vector<unsigned char> positions(12 * count), normals(4 * count);
    encodePositions(positions, from.positions);
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

#else

bool packsMeshopt() { return false; }
GltfBuilder meshoptFile(const Sheet&, bool) { return {}; }

#endif

#ifdef CONELIGHT_HAS_WEBP

bool packsWebp() { return true; }

std::vector<std::uint8_t> webpBytes(int width, int height, const std::vector<std::uint8_t>& rgba) {
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &encoded);
    EXPECT_GT(size, 0u);
    std::vector<std::uint8_t> webp(encoded, encoded + size);
    WebPFree(encoded);
    return webp;
}

#else

bool packsWebp() { return false; }
std::vector<std::uint8_t> webpBytes(int, int, const std::vector<std::uint8_t>&) { return {}; }

#endif

GltfBuilder webpFile(const std::vector<std::uint8_t>& webp, const std::string& png) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.json["images"] = {
        {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}, {"mimeType", "image/png"}},
        {{"bufferView", b.view(webp)}, {"mimeType", "image/webp"}}};
    b.json["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    b.json["extensionsUsed"] = {"EXT_texture_webp"};
    b.node({{"mesh", 0}});
    return b;
}

}  // namespace conelight::test
