// SPDX-License-Identifier: MIT
// The part of the corpus (corpus.h) that is glTF, plain and compressed.
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/image_file.h"
#include "support/compressed_gltf.h"
#include "support/corpus_writer.h"

namespace conelight::test {

namespace {

// A textured triangle with its data in the file.
Json validGltf() {
    GltfBuilder builder;
    Json& primitive = builder.triangle();
    primitive["indices"] = builder.indices({0, 1, 2});
    builder.node({{"mesh", 0}});
    Json json = builder.json;
    json["buffers"] = {{{"byteLength", builder.bytes().size()},
                        {"uri", "data:application/octet-stream;base64," + base64(builder.bytes())}}};
    return json;
}

Json withPositions(const std::vector<float>& positions) {
    GltfBuilder builder;
    const int accessor = builder.floats(positions, 3);
    builder.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", accessor}}}}}}}};
    builder.node({{"mesh", 0}});
    Json json = builder.json;
    json["buffers"] = {{{"byteLength", builder.bytes().size()},
                        {"uri", "data:application/octet-stream;base64," + base64(builder.bytes())}}};
    return json;
}

// One field of the valid file changed.
void addLies(Corpus& corpus) {
    const struct {
        const char* pointer;
        Json value;
        Expect expect;
    } lies[] = {
        {"/accessors/0/count", 4000000000u, Expect::Refused},
        {"/accessors/0/count", -1, Expect::Refused},
        {"/accessors/0/byteOffset", 18446744073709551612u, Expect::Refused},
        {"/accessors/0/componentType", 7, Expect::Refused},
        {"/accessors/0/type", "VEC9", Expect::Refused},
        {"/accessors/0/bufferView", 99, Expect::Refused},
        {"/bufferViews/0/byteLength", 1000000, Expect::Refused},
        {"/bufferViews/0/byteOffset", 18446744073709551615u, Expect::Refused},
        {"/bufferViews/0/byteStride", 1, Expect::Refused},
        {"/bufferViews/0/byteStride", 18446744073709551615u, Expect::Refused},
        {"/bufferViews/0/buffer", -3, Expect::Refused},
        {"/buffers/0/byteLength", 1e18, Expect::Refused},
        {"/buffers/0/uri", "data:;base64,!!!!", Expect::Refused},
        {"/buffers/0/uri", "http://example.com/a.bin", Expect::Refused},
        {"/buffers/0/uri", "../../../../../../../../../../etc/passwd", Expect::Refused},
        {"/buffers/0/uri", "/etc/passwd", Expect::Refused},
        {"/buffers/0/uri", "/dev/zero", Expect::Refused},
        {"/buffers/0/uri", "pipe.gltf", Expect::Refused},
        {"/buffers/0/uri", "a%00b", Expect::Refused},
        {"/meshes/0/primitives/0/attributes/POSITION", 5, Expect::Refused},
        {"/meshes/0/primitives/0/indices", 77, Expect::Refused},
        {"/meshes/0/primitives/0/mode", 99, Expect::Either},
        {"/meshes/0/primitives", "none", Expect::Refused},
        {"/nodes/0/mesh", 12, Expect::Refused},
        {"/nodes/0/children", Json::array({0}), Expect::Refused},
        {"/nodes/0/children", Json::array({5}), Expect::Refused},
        {"/nodes/0/matrix", Json::array({1, 2, 3}), Expect::Refused},
        {"/nodes/0/rotation", Json::array({0, 0, 0, 0}), Expect::Refused},
        {"/nodes/0/scale", Json::array({1e38, 1e38, 1e38}), Expect::Loads},
        {"/nodes/0/scale", Json::array({0, 0, 0}), Expect::Either},
        {"/nodes/0/translation", Json::array({"a", 0, 0}), Expect::Refused},
        {"/scene", 3, Expect::Refused},
        {"/asset/version", "9.9", Expect::Refused},
        {"/asset", 7, Expect::Refused},
        {"/extensionsRequired", Json::array({"EXT_unheard_of"}), Expect::Refused},
    };
    int number = 0;
    for (const auto& lie : lies) {
        Json json = validGltf();
        json[Json::json_pointer(lie.pointer)] = lie.value;
        corpus.add("lie" + std::to_string(number++) + ".gltf", json.dump(), lie.expect);
    }
}

void addNodeTrees(Corpus& corpus) {
    for (const bool cyclic : {false, true}) {
        Json json = validGltf();
        constexpr int kDeep = 10000;
        for (int i = 0; i < kDeep; ++i) json["nodes"].push_back({{"children", {i + 2}}});
        json["nodes"].push_back({{"mesh", 0}});
        if (cyclic) json["nodes"].back()["children"] = {1};
        json["scenes"][0]["nodes"] = {1};
        corpus.add(cyclic ? "cyclic.gltf" : "deep.gltf", json.dump(),
                   cyclic ? Expect::Refused : Expect::Loads);
    }
    corpus.add("nested.gltf", std::string(100000, '[') + std::string(100000, ']'), Expect::Refused);
}

}  // namespace

std::vector<CorpusFile> gltfCorpus(const fs::path& folder) {
    Corpus corpus(folder);
    const std::string valid = validGltf().dump();
    corpus.addSpecial(".gltf");
    corpus.addSpecial(".glb");
    corpus.add("valid.gltf", valid, Expect::Loads);
    corpus.add("bom.gltf", "\xEF\xBB\xBF" + valid, Expect::Loads);
    corpus.add("crlf.gltf", "\r\n\t " + valid + "\r\n", Expect::Loads);
    corpus.add("Unicode \xE2\x98\x83 and blanks.gltf", valid, Expect::Loads);
    corpus.addDamaged("text", ".gltf", valid);
    GltfBuilder builder;
    builder.triangle();
    builder.node({{"mesh", 0}});
    corpus.add("valid.glb", builder.glb(), Expect::Loads);
    corpus.addDamaged("binary", ".glb", builder.glb());
    addLies(corpus);
    addNodeTrees(corpus);
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, inf, 1e30f})
        corpus.add("number" + std::to_string(int(std::isnan(bad)) + 2 * int(std::isinf(bad))) + ".gltf",
                   withPositions({0, 0, 0, bad, 0, 0, 0, 1, 0}).dump(), Expect::Refused);
    corpus.add("flat.gltf", withPositions({0, 0, 0, 1, 0, 0, 2, 0, 0}).dump(), Expect::Either);
    corpus.add("point.gltf", withPositions(std::vector<float>(9, 1.0f)).dump(), Expect::Either);
    return corpus.files();
}

namespace {

std::string bytesAt(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Lie {
    const char* pointer;
    Json value;
    Expect expect;
};

void addLies(Corpus& corpus, const std::string& name, const GltfBuilder& valid,
             const std::vector<Lie>& lies) {
    int number = 0;
    for (const Lie& lie : lies) {
        GltfBuilder builder = valid;
        builder.json[Json::json_pointer(lie.pointer)] = lie.value;
        corpus.add(name + "_lie" + std::to_string(number++) + ".glb", builder.glb(), lie.expect);
    }
}

// The bytes of a coder, cut, damaged and with numbers at their start that are too large.
template <typename T>
std::vector<std::vector<T>> damagedBytes(const std::vector<T>& valid) {
    std::vector<std::vector<T>> all;
    for (std::size_t i = 0; i < 8; ++i)
        all.emplace_back(valid.begin(), valid.begin() + std::ptrdiff_t(valid.size() * i / 8));
    std::mt19937 random(23);
    for (int i = 0; i < 12; ++i) {
        const std::string text = mutated({valid.begin(), valid.end()}, random);
        all.emplace_back(text.begin(), text.end());
    }
    for (std::size_t at = 0; at + 4 < std::min<std::size_t>(valid.size(), 40); at += 2) {
        all.push_back(valid);
        std::fill_n(all.back().begin() + std::ptrdiff_t(at), 4, T(0xff));
    }
    return all;
}

void addDraco(Corpus& corpus) {
    const Sheet from = sheet(4);
    const DracoBytes packed = dracoBytes(from);
    const GltfBuilder valid = dracoFile(from, packed);
    corpus.add("draco.glb", valid.glb(), Expect::Loads);
    const std::string extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    const std::string view = extension + "/bufferView", position = extension + "/attributes/POSITION",
                      attributes = extension + "/attributes";
    addLies(corpus, "draco", valid,
            {{"/accessors/0/count", 4000000000u, Expect::Refused},
             {"/accessors/0/count", 3, Expect::Refused},
             {"/accessors/1/count", 4000000000u, Expect::Refused},
             {"/accessors/1/count", packed.points - 1, Expect::Refused},
             {"/accessors/1/type", "MAT4", Expect::Refused},
             {"/accessors/0/componentType", 5121, Expect::Loads},
             {"/bufferViews/0/byteLength", 1000000, Expect::Refused},
             {"/bufferViews/0/byteLength", 0, Expect::Refused},
             {view.c_str(), 99, Expect::Refused},
             {view.c_str(), -1, Expect::Refused},
             {position.c_str(), 77, Expect::Refused},
             {position.c_str(), 18446744073709551615u, Expect::Refused},
             {attributes.c_str(), 7, Expect::Refused}});
    int number = 0;
    for (const std::vector<char>& bytes : damagedBytes(packed.bytes))
        corpus.add("draco_bytes" + std::to_string(number++) + ".glb",
                   dracoFile(from, {bytes, packed.points}).glb(), Expect::Either);
    // A billion triangles and vertices in a few bytes, kept one after the other.
    const std::string bomb = std::string("DRACO\2\2\1\0\0\0", 11) + "\xff\xff\xff\xff\3\xff\xff\xff\xff\3\1" +
                             std::string(200, '\0');
    corpus.add("draco_bomb.glb", dracoFile(from, {{bomb.begin(), bomb.end()}, packed.points}).glb(),
               Expect::Refused);
}

void addMeshopt(Corpus& corpus) {
    for (const bool sequence : {false, true}) {
        const GltfBuilder valid = meshoptFile(sheet(4), sequence);
        const std::string name = sequence ? "meshopt_sequence" : "meshopt";
        corpus.add(name + ".glb", valid.glb(), Expect::Loads);
        const std::string views = "/bufferViews/";
        std::vector<std::string> pointers;
        std::vector<Lie> lies;
        for (const char* view : {"0", "3"})
            for (const char* member : {"count", "byteStride", "byteLength", "byteOffset"})
                pointers.push_back(views + view + "/extensions/EXT_meshopt_compression/" + member);
        for (const std::string& pointer : pointers)
            for (const Json& value : {Json(-1), Json(4294967295u), Json(18446744073709551615u)})
                lies.push_back({pointer.c_str(), value, Expect::Either});
        lies.push_back({"/bufferViews/0/byteLength", 1, Expect::Either});
        lies.push_back(
            {"/bufferViews/0/extensions/EXT_meshopt_compression/count", 1'000'000'000, Expect::Refused});
        addLies(corpus, name, valid, lies);
        // The coder's bytes, in place.
        const std::size_t start = valid.glb().size() - valid.bytes().size();
        std::mt19937 random(29);
        for (int i = 0; i < 12; ++i) {
            std::string text = valid.glb();
            for (int j = 0; j < 1 + i % 4; ++j)
                text[start + random() % (text.size() - start)] = char(random());
            corpus.add(name + "_bytes" + std::to_string(i) + ".glb", text, Expect::Either);
        }
    }
}

// A picture that cannot be decoded is left out with a note.
void addWebp(Corpus& corpus) {
    io::writePng(corpus.folder() / "webp.png", {1, 1, 4, {1, 2, 3, 255}});
    const std::string png = bytesAt(corpus.folder() / "webp.png");
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 4 * 16 * 16; ++i) texels.push_back(std::uint8_t(i * i / 7));
    const std::vector<std::uint8_t> webp = webpBytes(16, 16, texels);
    corpus.add("webp.glb", webpFile(webp, png).glb(), Expect::Loads);
    int number = 0;
    for (const std::vector<std::uint8_t>& bytes : damagedBytes(webp))
        corpus.add("webp_bytes" + std::to_string(number++) + ".glb", webpFile(bytes, png).glb(),
                   bytes.empty() ? Expect::Either : Expect::Loads);
    // A canvas of 16,384 squared in the header of a file of 60 bytes.
    std::string bomb("RIFF\x20\0\0\0WEBPVP8L\x14\0\0\0\x2f\xff\xff\xff\x0f", 25);
    bomb += std::string(35, '\0');
    corpus.add("webp_bomb.glb", webpFile({bomb.begin(), bomb.end()}, png).glb(), Expect::Loads);
    addLies(corpus, "webp", webpFile(webp, png),
            {{"/textures/0/extensions/EXT_texture_webp/source", 9, Expect::Refused},
             {"/textures/0/extensions/EXT_texture_webp", 9, Expect::Either},
             {"/bufferViews/2/byteLength", 1000000, Expect::Loads}});
}

}  // namespace

std::vector<CorpusFile> compressedCorpus(const fs::path& folder, const std::vector<Packing>& packings) {
    Corpus corpus(folder);
    for (const Packing packing : packings) {
        if (packing == Packing::Draco && packsDraco()) addDraco(corpus);
        if (packing == Packing::Meshopt && packsMeshopt()) addMeshopt(corpus);
        if (packing == Packing::Webp && packsWebp()) addWebp(corpus);
    }
    return corpus.files();
}

}  // namespace conelight::test
