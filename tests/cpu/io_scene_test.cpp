// SPDX-License-Identifier: MIT
// Choice of the reader, and a scene in words.
#include <algorithm>
#include <filesystem>

#include "cpu/io_test_support.h"
#include "io/animation.h"
#include "io/gltf_write.h"
#include "io/scene_info.h"

namespace conelight {
namespace {

using namespace test;

TEST(SceneFile, NamesWhatItKnows) {
    const std::string unknown = write(folderOf("scene") / "a.xyzzy", "hello");
    EXPECT_TRUE(contains(loadError(unknown), "unknown scene extension '.xyzzy'; known: .gltf .glb, .txt"));
    EXPECT_TRUE(contains(loadError("no/such/file.glb"), "no such file"));
    EXPECT_TRUE(contains(loadError("no/such/file.obj"), "no such file"));
    EXPECT_TRUE(contains(loadError("no/such/file.txt"), "no such file"));
    const std::string folder = (folderOf("scene") / "folder.obj").string();
    std::filesystem::create_directories(folder);
    EXPECT_TRUE(contains(loadError(folder), "is a folder"));
    EXPECT_TRUE(contains(loadError("builtin:nothing"), "nothing"));
    EXPECT_FALSE(io::loadScene("builtin:cornell").instances.empty());
    const std::vector<std::string> known = io::sceneExtensions();
    for (const char* extension :
         {".glb", ".gltf", ".txt", ".obj", ".fbx", ".ply", ".stl", ".dae", ".3ds", ".ifc"})
        EXPECT_NE(std::find(known.begin(), known.end(), extension), known.end()) << extension;
}

// LoadOptions::progress is told how far a load is, and stops it wherever it says so.
TEST(SceneFile, TellsHowFarItIsAndStops) {
    const std::filesystem::path folder = folderOf("load_progress");
    const std::string gltf = (folder / "atrium.glb").string();
    io::writeGltf(gltf, io::loadScene("builtin:atrium?triangles=10000"), true);
    const std::string obj = write(folder / "one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string& file : {gltf, obj, std::string("builtin:cornell")}) {
        std::vector<std::string> names;
        io::LoadOptions options;
        options.progress = [&](const io::LoadStep& step) {
            EXPECT_TRUE(step.total == 0 || step.done < step.total) << step.name;
            if (names.empty() || names.back() != step.name) names.emplace_back(step.name);
            return true;
        };
        const Scene whole = io::loadScene(file, options);
        const std::vector<std::string> wanted =
            file == gltf  ? std::vector<std::string>{"reading", "pictures", "meshes"}
            : file == obj ? std::vector<std::string>{"reading", "importing"}
                          : std::vector<std::string>{"reading"};
        EXPECT_EQ(names, wanted) << file;
        for (const std::string& last : wanted) {
            bool goesOn = true;
            options.progress = [&](const io::LoadStep& step) {
                EXPECT_TRUE(goesOn) << "asked again";
                return goesOn = step.name != last;
            };
            io::SceneAnimation animation;
            try {
                io::loadMovingScene(file, options, animation);
                ADD_FAILURE() << file << " goes on after " << last;
            } catch (const io::LoadStopped& stopped) {
                EXPECT_EQ(std::string(stopped.what()), file + ": stopped; nothing is loaded");
            }
        }
    }
}

TEST(SceneInfo, SaysWhatIsInAScene) {
    const std::string path = write(folderOf("scene") / "info.txt",
                                   "scene = { name = S sky = { 1 2 3 } model = { primitive = cube name = box "
                                   "} model = { primitive = cube static = true }\n"
                                   "model = { primitive = cube active = false } light = { type = spot name = "
                                   "lamp intensity = { 1 2 3 } } odd = 1 settings = { a = b } }");
    const std::string text = io::describeScene(io::loadScene(path), 2);
    for (const char* part :
         {"scene      S (thesis's format)", "triangles  24 drawn, 12 voxelized, 0 emissive",
          "instances  3, 1 hidden", "-0.5 -0.5 -0.5 to 0.5 0.5 0.5 m", "sky        1 2 3 W/(sr m^2)",
          "materials  3", "... 1 more", "box: base", "lamp: spot, 1 2 3 W/sr", "cone 0 to 45 deg",
          "cameras    3", "a = b", "unknown key 'odd'"})
        EXPECT_TRUE(contains(text, part)) << part << " is missing in\n" << text;
    EXPECT_TRUE(contains(io::describeScene(Scene()), "bounds     empty"));
}

}  // namespace
}  // namespace conelight
