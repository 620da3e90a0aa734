// SPDX-License-Identifier: MIT
// A corpus is a valid file and what was done to it. See corpus.h; glTF: corpus_gltf.cpp.
#include "support/corpus.h"

#include "io/image_file.h"
#include "support/compressed_gltf.h"
#include "support/corpus_writer.h"

namespace conelight::test {

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
    // Kinds that have no name of their own here are read by what they hold.
    const std::string texels(std::size_t{24} * 16 * 3, '\x7f');
    const std::string bmp =
        std::string("BM\xb6\4\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x18\0\0\0\x10\0\0\0\1\0\x18\0", 30) +
        std::string(24, '\0') + texels;
    const std::string size("\x18\0\x10\0\x18\0", 6);  // 24 by 16 of 24 bits
    const std::string tga = std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + size + texels;
    const std::string packed = std::string("\0\0\x0a\0\0\0\0\0\0\0\0\0", 12) + size +
                               "\xff\1\2\3"
                               "\xff\1\2\3"
                               "\xff\1\2\3";
    for (const auto& [name, text] : {std::pair("bmp", bmp), {"tga", tga}, {"packed", packed}}) {
        corpus.add(name + std::string(".png"), text, Expect::Loads);
        corpus.addDamaged(name, ".png", text);
    }
    if (packsWebp()) {
        const std::vector<std::uint8_t> webp = webpBytes(24, 16, std::vector<std::uint8_t>(24 * 16 * 4, 99));
        corpus.add("webp.png", {webp.begin(), webp.end()}, Expect::Loads);
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

std::vector<CorpusFile> coneSetCorpus(const fs::path& folder) {
    const auto cone = [](const std::string& more) {
        return "{\"cones\": [{\"direction\": [0, 0, 1], " + more + "}]}";
    };
    return jsonCorpus(
        folder, cone("\"aperture\": 0.9, \"weight\": 1"),
        {"{\"cones\": []}", "{\"cones\": [7]}", "{\"cones\": {}}", cone("\"aperture\": 0.9"),
         cone("\"aperture\": 1e999, \"weight\": 1"), cone("\"aperture\": -1, \"weight\": 1"),
         cone("\"aperture\": 0.9, \"weight\": 0"), cone("\"aperture\": \"wide\", \"weight\": 1"),
         cone("\"aperture\": 0.9, \"weight\": 1, \"colour\": 3"),
         "{\"cones\": [{\"direction\": [0, 0, -1], \"aperture\": 1, \"weight\": 1}]}",
         "{\"cones\": [{\"direction\": [0, 0, 0], \"aperture\": 1, \"weight\": 1}]}",
         "{\"cones\": [{\"direction\": [0, 1], \"aperture\": 1, \"weight\": 1}]}"});
}

std::vector<CorpusFile> batchJobCorpus(const fs::path& folder) {
    const auto job = [](const std::string& more) {
        return "{\"conelight\": \"batch job\", \"scenes\": [\"builtin:furnace\"]" + more + "}";
    };
    const std::string small = ", \"options\": {\"size\": \"8x8\", \"mode\": \"phong\", \"voxels\": 16}";
    return jsonCorpus(
        folder, job(small + ", \"sweep\": {\"set.image.exposure\": [1, 2]}"),
        {job(", \"scene\": 1"), job(", \"sweep\": {\"seed\": {\"from\": 1, \"to\": 999999999}}"),
         job(", \"sweep\": {\"seed\": {\"from\": -9223372036854775808, \"to\": 9223372036854775807}}"),
         job(", \"sweep\": {\"seed\": {\"from\": 1, \"to\": 99999}, \"spp\": {\"from\": 1, \"to\": 99999}}"),
         job(", \"sweep\": []"), job(", \"output\": \"../../{seed}.exr\""),
         job(", \"output\": \"/etc/a.exr\""), job(", \"frames\": {\"turntable\": true, \"count\": 1e9}"),
         job(", \"options\": {\"mode\": {}}"), "{\"conelight\": \"batch job\", \"scenes\": [7]}",
         "{\"conelight\": \"batch job\", \"scenes\": [\"/dev/zero/*\"]}"});
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
