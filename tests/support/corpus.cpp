// SPDX-License-Identifier: MIT
// A corpus is a valid file and what was done to it. See corpus.h.
#include "support/corpus.h"

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "cpu/io_test_support.h"
#include "io/image_file.h"

namespace conelight::test {

namespace fs = std::filesystem;

namespace {

class Corpus {
  public:
    explicit Corpus(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

    void add(const std::string& name, const std::string& text, Expect expect) {
        write(folder_ / name, text);
        files_.push_back({folder_ / name, expect});
    }
    // What a name may be instead of a file of that kind.
    void addSpecial(const std::string& ending) {
        ::mkfifo((folder_ / ("pipe" + ending)).c_str(), 0600);
        fs::create_directory(folder_ / ("folder" + ending));
        fs::create_symlink("/dev/zero", folder_ / ("zero" + ending));
        fs::create_symlink("loop" + ending, folder_ / ("loop" + ending));
        write(folder_ / ("hole" + ending), "");
        fs::resize_file(folder_ / ("hole" + ending), std::uintmax_t(1) << 40);
        for (const char* name : {"pipe", "folder", "zero", "loop", "hole", "missing"})
            files_.push_back({folder_ / (name + ending), Expect::Refused});
        add("empty" + ending, "", Expect::Refused);
        add("zeros" + ending, std::string(4096, '\0'), Expect::Refused);
        add("not utf-8 \xff\xfe name" + ending, "\xff\xfe\x80", Expect::Refused);
    }
    // Cut at several places, and damaged: no more than a crash or a hang can be ruled out.
    void addDamaged(const std::string& name, const std::string& ending, const std::string& text) {
        for (int i = 1; i < 8; ++i)
            add(name + "_cut" + std::to_string(i) + ending, text.substr(0, text.size() * std::size_t(i) / 8),
                Expect::Either);
        std::mt19937 random(17);
        for (int i = 0; i < 8; ++i)
            add(name + "_damaged" + std::to_string(i) + ending, mutated(text, random), Expect::Either);
    }
    const fs::path& folder() const { return folder_; }
    std::vector<CorpusFile> files() { return std::move(files_); }

  private:
    fs::path folder_;
    std::vector<CorpusFile> files_;
};

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

std::vector<CorpusFile> objCorpus(const fs::path& folder) {
    Corpus corpus(folder);
    corpus.addSpecial(".obj");
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::string valid = "mtllib m.mtl\nusemtl a\n" + corners + "vt 0 0\nf 1/1 2/1 3/1\n";
    write(folder / "m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd nowhere.png\n");
    corpus.add("valid.obj", valid, Expect::Loads);
    corpus.add("bom.obj", "\xEF\xBB\xBF" + valid, Expect::Loads);
    corpus.add("tabs.obj", "\tv\t0 0 0\n v 1 0 0 # x\n\tv\t.0 +.1e1 0\nf\t1 2 3 # y\n", Expect::Loads);
    corpus.add("crlf.obj", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", Expect::Loads);
    corpus.add("\xE2\x98\x83 a b.obj", valid, Expect::Loads);
    corpus.add("ngon.obj", corners + "v -1 1 0\nv -1 0 0\nf 1 2 3 4 5\n", Expect::Loads);
    corpus.add("negative.obj", corners + "f -3 -2 -1\n", Expect::Loads);
    corpus.add("beyond.obj", corners + "f 1 2 4\n", Expect::Refused);
    corpus.add("far_beyond.obj", corners + "f 1 2 99999999999999999999\n", Expect::Refused);
    corpus.add("nothing.obj", corners, Expect::Refused);
    corpus.add("huge.obj", "v 1e30 0 0\nv 0 0 0\nv 0 1e30 0\nf 1 2 3\n", Expect::Refused);
    corpus.add("nan.obj", "v nan 0 0\nv 0 inf 0\nv 0 1 0\nf 1 2 3\n", Expect::Either);
    corpus.add("flat.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", Expect::Either);
    corpus.add("long_line.obj", corners + "f 1 2 3\n# " + std::string(1 << 20, 'x') + "\n", Expect::Loads);
    corpus.add("random.obj", std::string(1000, '\x80'), Expect::Refused);
    for (const char* library : {"/dev/zero", "/etc/passwd", "../../../../etc/passwd", "pipe.obj",
                                "folder.obj", "zero.obj", "hole.obj", "loop.obj", "valid.obj"})
        corpus.add("library_" + std::to_string(std::hash<std::string>()(library)) + ".obj",
                   std::string("mtllib ") + library + "\nusemtl a\n" + corners + "f 1 2 3\n", Expect::Loads);
    corpus.addDamaged("text", ".obj", valid);
    return corpus.files();
}

std::vector<CorpusFile> thesisCorpus(const fs::path& folder) {
    Corpus corpus(folder);
    corpus.addSpecial(".txt");
    const std::string valid = "scene = { name = a model = { name = b primitive = cube } }\n";
    corpus.add("valid.txt", valid, Expect::Loads);
    corpus.add("crlf.txt", "scene = {\r\n\tmodel = {\r\n\tprimitive = cube\r\n}\r\n}\r\n", Expect::Loads);
    corpus.add("blank.txt", " \n\t# nothing\n", Expect::Refused);
    corpus.add("prose.txt", "Dear diary, today it rained.", Expect::Refused);
    corpus.add(
        "deep.txt",
        [] {
            std::string text;
            for (int i = 0; i < 100000; ++i) text += "a = { ";
            return text;
        }(),
        Expect::Refused);
    corpus.add("numbers.txt", "scene = { model = { primitive = cube scale = 1e400 position = { x = nan } } }",
               Expect::Either);
    for (const char* mesh :
         {"/etc/passwd", "../../../../../etc/passwd", "/dev/zero", "pipe.txt", "folder.txt"})
        corpus.add("mesh_" + std::to_string(std::hash<std::string>()(mesh)) + ".txt",
                   std::string("scene = { model = { path = ") + mesh + " } }", Expect::Loads);
    corpus.addDamaged("text", ".txt", valid);
    return corpus.files();
}

std::vector<CorpusFile> pictureCorpus(const fs::path& folder) {
    Corpus corpus(folder);
    const io::ByteImage bytes{24, 16, 3, std::vector<std::uint8_t>(24 * 16 * 3, 120)};
    io::FloatImage floats;
    floats.width = 24;
    floats.height = 16;
    floats.pixels.assign(24 * 16 * 3, 0.5f);
    io::writePng(folder / "valid.png", bytes);
    io::writeJpg(folder / "valid.jpg", bytes);
    io::writeExr(folder / "valid.exr", floats);
    io::writeHdr(folder / "valid.hdr", floats);
    for (const char* ending : {".png", ".jpg", ".exr", ".hdr"}) {
        corpus.addSpecial(ending);
        std::ifstream stream(folder / (std::string("valid") + ending), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        corpus.add(std::string("valid") + ending, text, Expect::Loads);
        corpus.addDamaged("picture", ending, text);
    }
    // An attribute of 400 MB in a file of 400 bytes, of which OpenEXR would ask for all.
    std::ifstream exr(folder / "valid.exr", std::ios::binary);
    std::string large{std::istreambuf_iterator<char>(exr), {}};
    large.insert(8, std::string("note\0opaque\0\0\0\0\x19", 16));
    corpus.add("large_attribute.exr", large, Expect::Refused);
    // Sizes that only the header has.
    std::string bomb = "#?RADIANCE\n\n-Y 30000 +X 30000\n";
    corpus.add("bomb.hdr", bomb, Expect::Refused);
    std::ifstream stream(folder / "valid.png", std::ios::binary);
    bomb.assign(std::istreambuf_iterator<char>(stream), {});
    bomb.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
    corpus.add("bomb.png", bomb, Expect::Refused);
    return corpus.files();
}

namespace {

std::vector<CorpusFile> jsonCorpus(const fs::path& folder, const std::string& valid,
                                   const std::vector<std::string>& wrong) {
    Corpus corpus(folder);
    corpus.addSpecial(".json");
    corpus.add("valid.json", valid, Expect::Loads);
    corpus.addDamaged("text", ".json", valid);
    corpus.add("nested.json", std::string(100000, '[') + std::string(100000, ']'), Expect::Refused);
    corpus.add("other.json", "{\"conelight\": \"something else\"}", Expect::Refused);
    corpus.add("array.json", "[]", Expect::Refused);
    corpus.add("twice.json", "{\"conelight\": 1, \"conelight\": 2}", Expect::Refused);
    int number = 0;
    for (const std::string& text : wrong)
        corpus.add("wrong" + std::to_string(number++) + ".json", text, Expect::Refused);
    return corpus.files();
}

}  // namespace

std::vector<CorpusFile> cameraPathCorpus(const fs::path& folder) {
    const auto keys = [](const std::string& text) {
        return "{\"conelight\": \"camera path\", \"keys\": " + text + "}";
    };
    return jsonCorpus(
        folder,
        keys("[{\"time\": 0, \"eye\": [0, 0, 1], \"target\": [0, 0, 0]}, "
             "{\"time\": 1, \"eye\": [0, 1, 1], \"target\": [0, 0, 0]}]"),
        {keys("[]"), keys("[7]"), keys("{}"), keys("[{\"eye\": [0, 0, 1e999], \"target\": [0, 0, 0]}]"),
         keys("[{\"eye\": [0, 0], \"target\": [0, 0, 0]}]"),
         keys("[{\"eye\": [0, 0, 0], \"target\": [0, 0, 0]}]"),
         keys("[{\"time\": -1e300, \"eye\": \"here\", \"target\": [0, 0, 0]}]")});
}

std::vector<CorpusFile> presetCorpus(const fs::path& folder) {
    const auto settings = [](const std::string& text) {
        return "{\"conelight\": \"preset\", \"settings\": " + text + "}";
    };
    return jsonCorpus(
        folder, settings("{\"mode\": \"phong\", \"voxels.size\": 32}"),
        {settings("[]"), settings("{\"voxels.size\": 1e9}"), settings("{\"voxels.size\": \"many\"}"),
         settings("{\"no.such\": 1}"), settings("{\"mode\": {}}")});
}

std::vector<CorpusFile> scriptCorpus(const fs::path& folder) {
    Corpus corpus(folder);
    corpus.add("valid.txt", "mode phong\n# a comment\r\necho hello; mode cones\n", Expect::Loads);
    corpus.add("empty.txt", "", Expect::Loads);
    corpus.add("unknown.txt", "frobnicate\n", Expect::Refused);
    corpus.add("numbers.txt", "camera orbit nan 1e999\n", Expect::Refused);
    corpus.add("quote.txt", "echo 'never closed\n", Expect::Either);
    corpus.add("open.txt", "open /dev/zero\n", Expect::Refused);
    corpus.add("binary.txt", std::string("\0\xff\x01\x80", 4) + std::string(10000, '\x7f'), Expect::Refused);
    corpus.add("long.txt", "echo " + std::string(1 << 20, 'x') + "\n", Expect::Either);
    ::mkfifo((corpus.folder() / "pipe.txt").c_str(), 0600);
    std::vector<CorpusFile> files = corpus.files();
    files.push_back({folder / "pipe.txt", Expect::Refused});
    files.push_back({"/dev/zero", Expect::Refused});
    return files;
}

}  // namespace conelight::test
