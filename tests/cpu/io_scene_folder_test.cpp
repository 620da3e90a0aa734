// SPDX-License-Identifier: MIT
// Files that a scene names: those in its folder are read, those outside are refused by every importer
// whatever the spelling, pipes and devices are refused at once, and too large files are not read.
#include <sys/stat.h>

#include "cpu/io_test_support.h"
#include "io/files.h"
#include "io/image_file.h"
#include "io/scene_folder.h"

namespace conelight {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

void savePixel(const fs::path& file) {
    fs::create_directories(file.parent_path());
    io::writePng(file, {1, 1, 4, {200, 100, 50, 255}});
}

// A triangle whose buffer and picture are named so.
std::string gltf(const std::string& buffer, const std::string& picture) {
    GltfBuilder builder;
    builder.triangle()["material"] = 0;
    builder.node({{"mesh", 0}});
    Json json = builder.json;
    json["buffers"] = {{{"byteLength", builder.bytes().size()}, {"uri", buffer}}};
    json["images"] = {{{"uri", picture}}};
    json["textures"] = {{{"source", 0}}};
    json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return json.dump();
}

std::string triangleBytes() {
    GltfBuilder builder;
    builder.triangle();
    return builder.bytes();
}

io::LoadOptions allowed() {
    io::LoadOptions options;
    options.allowOutside = true;
    return options;
}

// A folder `scene` with what is beside it: a buffer, a picture, a mesh.
struct Places {
    explicit Places(const std::string& name) : all(folderOf(name)), scene(all / "a/scene") {
        write(scene / "in.bin", triangleBytes());
        write(all / "secret.bin", triangleBytes());
        write(all / "secret.obj", kObj);
        savePixel(scene / "in.png");
        savePixel(all / "secret.png");
        fs::create_symlink(all / "secret.bin", scene / "link.bin");
        fs::create_symlink(all / "secret.png", scene / "link.png");
        fs::create_symlink(all / "secret.obj", scene / "link.obj");
    }
    fs::path all, scene;
};

TEST(SceneFolder, GltfReadsItsOwnFolderOnly) {
    const Places at("gltf_outside");
    const auto file = [&](const std::string& buffer, const std::string& picture) {
        return write(at.scene / "s.gltf", gltf(buffer, picture));
    };
    EXPECT_EQ(io::loadScene(file("in.bin", "./in.png")).textures.size(), 1u);
    EXPECT_EQ(io::loadScene(file("../scene/in.bin", "in.png")).textures.size(), 1u);
    const std::string absolute = (at.all / "secret").string();
    for (const std::string& spelled : {std::string("../../secret"), std::string("%2E%2E/%2e./secret"),
                                       absolute, std::string("link"), "./../scene/" + absolute}) {
        const std::string path = file(spelled + ".bin", "in.png");
        if (spelled.rfind("./..", 0) == 0) {
            EXPECT_TRUE(contains(loadError(path), "no such file"));
            continue;
        }
        EXPECT_TRUE(contains(loadError(path), "lies outside")) << spelled;
        EXPECT_EQ(io::loadScene(path, allowed()).triangleCount(), 1u) << spelled;
        const Scene scene = io::loadScene(file("in.bin", spelled + ".png"));
        EXPECT_TRUE(scene.textures.empty()) << spelled;
        EXPECT_TRUE(hasNote(scene, "--allow-outside")) << spelled;
        EXPECT_EQ(io::loadScene(file("in.bin", spelled + ".png"), allowed()).textures.size(), 1u) << spelled;
    }
    EXPECT_TRUE(contains(loadError(file("in.bin%00.txt", "in.png")), "zero byte"));
}

TEST(SceneFolder, ObjReadsItsOwnFolderOnly) {
    const Places at("obj_outside");
    write(at.all / "secret.mtl", "newmtl m\nKd 0 1 0\n");
    const std::string escaping =
        write(at.scene / "s.obj", std::string("mtllib ../../secret.mtl\nusemtl m\n") + kObj);
    const Scene without = io::loadScene(escaping);
    EXPECT_TRUE(hasNote(without, "secret.mtl: lies outside")) << without.notes.size();
    for (const Material& material : without.materials) EXPECT_NE(material.baseColor.g, 1.0f);
    const Scene with = io::loadScene(escaping, allowed());
    EXPECT_EQ(with.materials.at(std::size_t(with.instances.at(0).material)).baseColor.g, 1.0f);

    const std::string textured = write(at.scene / "t.obj", std::string("mtllib t.mtl\nusemtl m\n") + kObj);
    for (const std::string& name :
         {std::string("../../secret.png"), (at.all / "secret.png").string(), std::string("link.png")}) {
        write(at.scene / "t.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + name + "\n");
        const Scene scene = io::loadScene(textured);
        EXPECT_TRUE(scene.textures.empty()) << name;
        EXPECT_TRUE(hasNote(scene, "lies outside")) << name;
        EXPECT_EQ(io::loadScene(textured, allowed()).textures.size(), 1u) << name;
    }
}

// The format's documented places: the working folder, the scene's, and the one above it.
TEST(SceneFolder, ThesisReadsTheFolderAboveToo) {
    const Places at("thesis_outside");
    write(at.scene / "in.obj", kObj);
    write(at.scene.parent_path() / "models/above.obj", kObj);
    const auto file = [&](const std::string& mesh) {
        return write(at.scene / "s.txt", "scene = { model = { name = m path = " + mesh + " } }");
    };
    for (const char* name : {"in.obj", "models/above.obj", "../models/above.obj"})
        EXPECT_EQ(io::loadScene(file(name)).triangleCount(), 1u) << name;
    for (const std::string& name :
         {std::string("../../secret.obj"), (at.all / "secret.obj").string(), std::string("link.obj")}) {
        const Scene scene = io::loadScene(file(name));
        EXPECT_EQ(scene.triangleCount(), 0u) << name;
        EXPECT_TRUE(hasNote(scene, "lies outside")) << name;
        EXPECT_EQ(io::loadScene(file(name), allowed()).triangleCount(), 1u) << name;
    }
    io::SceneFolder root(at.scene / "s.txt", false);
    root.alsoBelow("/");
    EXPECT_FALSE(root.refusal(at.all / "secret.obj").empty()) << "/ lets in nothing";
}

// Each of these would wait or never end.
TEST(SceneFolder, PipesDevicesAndFoldersAreRefused) {
    const Places at("special");
    ASSERT_EQ(::mkfifo((at.scene / "pipe").c_str(), 0600), 0);
    fs::create_directory(at.scene / "folder.bin");
    for (const char* name : {"pipe", "/dev/zero", "/dev/random", "/dev/full", "folder.bin"}) {
        const std::string path = write(at.scene / "s.gltf", gltf(name, "in.png"));
        EXPECT_TRUE(contains(loadError(path, allowed()), "a file is needed") ||
                    contains(loadError(path, allowed()), "only regular files"))
            << name;
        EXPECT_TRUE(hasNote(io::loadScene(write(at.scene / "s.gltf", gltf("in.bin", name)), allowed()),
                            "picture left out"))
            << name;
        const std::string obj =
            write(at.scene / "s.obj", std::string("mtllib ") + name + "\nusemtl m\n" + kObj);
        EXPECT_EQ(io::loadScene(obj, allowed()).triangleCount(), 1u) << name;
    }
    // The scene itself, in each format.
    for (const char* name : {"s.glb", "s.gltf", "s.obj", "s.ply", "s.txt", "s.fbx"}) {
        const fs::path pipe = at.scene / name;
        fs::remove(pipe);
        ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        EXPECT_TRUE(contains(loadError(pipe.string()), "only regular files")) << name;
        fs::remove(pipe);
        fs::create_symlink("/dev/zero", pipe);
        EXPECT_TRUE(contains(loadError(pipe.string()), "only regular files")) << name;
        fs::remove(pipe);
        fs::create_directory(pipe);
        EXPECT_TRUE(contains(loadError(pipe.string()), "folder")) << name;
        fs::remove(pipe);
    }
}

// A stranger's few bytes may ask for gigabytes of texels.
TEST(SceneFolder, TexturesShareABudget) {
    const fs::path folder = folderOf("budget");
    write(folder / "in.bin", triangleBytes());
    const std::size_t side = 256;
    io::writePng(folder / "t.png",
                 {int(side), int(side), 3, std::vector<std::uint8_t>(side * side * 3, 200)});
    Json json = Json::parse(gltf("in.bin", "t.png"));
    for (int i = 1; i < 5; ++i) {
        json["images"].push_back({{"uri", "t.png"}});
        json["textures"].push_back({{"source", i}});
        json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
    }
    const std::string path = write(folder / "s.gltf", json.dump());
    io::LoadOptions tight;
    tight.maxTexels = 2 * side * side;
    const Scene scene = io::loadScene(path, tight);
    ASSERT_EQ(scene.textures.size(), 5u);
    std::size_t texels = 0;
    for (const Texture& texture : scene.textures) {
        texels += texture.rgba.size() / 4;
        EXPECT_EQ(texture.rgba.at(1), 200);
    }
    EXPECT_LE(texels, tight.maxTexels);
    EXPECT_EQ(scene.textures[0].width, 256);
    EXPECT_TRUE(hasNote(scene, "images[1]: has 256x256 pixels, read as 128x128"));
    io::LoadOptions tighter;
    tighter.maxTexels =
        side * side;  // such pictures unpack to three times as many bytes, and five times is the most
    const Scene few = io::loadScene(path, tighter);
    EXPECT_GE(few.textures.size(), 2u);
    EXPECT_LT(few.textures.size(), 5u);
    EXPECT_TRUE(hasNote(few, "images[4]: is left out"));
    for (const Texture& texture : io::loadScene(path).textures) EXPECT_EQ(texture.width, 256);

    // Pictures whose files are about as large as their pixels are all read.
    std::vector<std::uint8_t> noise(side * side * 3);
    std::uint32_t seed = 1;
    for (std::uint8_t& byte : noise) byte = std::uint8_t((seed = seed * 1664525u + 1013904223u) >> 24);
    io::writePng(folder / "t.png", {int(side), int(side), 3, noise});
    EXPECT_EQ(io::loadScene(path, tighter).textures.size(), 5u);
    io::writePng(folder / "t.png",
                 {int(side), int(side), 3, std::vector<std::uint8_t>(side * side * 3, 200)});

    write(folder / "m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd t.png\n");
    tight.maxTexels = side * side;
    const Scene obj =
        io::loadScene(write(folder / "s.obj", std::string("mtllib m.mtl\nusemtl m\n") + kObj), tight);
    EXPECT_EQ(obj.textures.at(0).width, 128);
    EXPECT_TRUE(hasNote(obj, "texture t.png: picture: has 256x256 pixels"));
}

// Files that are holes: large on paper, nothing on the disk.
TEST(SceneFolder, TooLargeFilesAreNotRead) {
    const Places at("large");
    for (const char* name : {"s.glb", "s.obj", "s.txt", "huge.bin"}) {
        const std::string path = write(at.scene / name, "x");
        fs::resize_file(path, io::kMostFileBytes + 1);
        if (std::string(name) != "huge.bin")
            EXPECT_TRUE(contains(loadError(path), "at most")) << name;
        else
            EXPECT_TRUE(contains(loadError(write(at.scene / "s.gltf", gltf(name, "in.png"))), "at most"));
        fs::resize_file(path, 0);
    }
    EXPECT_THROW(io::readFile(write(at.scene / "five", "12345"), 4), Error);
    EXPECT_EQ(io::readFile(at.scene / "five", 5).size(), 5u);
}

}  // namespace
}  // namespace conelight
