// SPDX-License-Identifier: MIT
// What the program writes: never over what it reads or over files of another kind, never over files of the
// user beside it; out of memory and files that may not grow end with one line and leave nothing.
#include <filesystem>
#include <fstream>

#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

std::string path(const std::string& name) { return scratchPath(name); }

void put(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

// The command is refused with one line that says so, and the file has the bytes it had.
void expectKept(const std::string& file, const std::string& arguments, const std::string& why) {
    const std::string before = bytesOf(file);
    expectOneLine(conelight(arguments), 2, why);
    EXPECT_TRUE(bytesOf(file) == before) << arguments;
}

class OutputsTest : public GlTest {};

TEST_F(OutputsTest, NothingIsWrittenOverWhatIsRead) {
    const std::string scene = path("s.glb"), a = path("a.exr"), b = path("b.exr"), preset = path("p.json");
    ASSERT_EQ(conelight("convert builtin:cornell " + scene).status, 0);
    ASSERT_EQ(conelight("render builtin:furnace --mode phong --size 16x16 -o " + a).status, 0);
    fs::copy_file(a, b);
    fs::create_hard_link(a, path("hard.exr"));
    fs::create_symlink("a.exr", path("soft.exr"));
    put(preset, "{\"conelight\": \"preset\", \"settings\": {}}");
    for (const std::string& name : {a, b, path("hard.exr"), path("soft.exr"), path("./a.exr")}) {
        expectKept(a, "compare " + a + " " + b + " --json " + name, "is read by the same command");
        expectKept(a, "compare " + a + " " + b + " --map " + name, "is read by the same command");
    }
    expectKept(scene, "bench " + scene + " --json " + scene, "is read by the same command");
    expectKept(scene, "render " + scene + " --stats " + scene + " -o " + path("o.png"),
               "is read by the same");
    expectKept(preset,
               "render " + scene + " --preset " + preset + " --stats " + preset + " -o " + path("o.png"),
               "is read by the same command");
    expectKept(scene, "render " + scene + " --mode radiosity --bake " + scene + " --overwrite",
               "is read by the same command");
    EXPECT_FALSE(fs::exists(path("o.png")));
}

// A model without light is seen in a studio, on a ground; both are said, and no file gets them.
TEST_F(OutputsTest, TheStudioIsSaidAndNotConverted) {
    const std::string model = path("m.obj"), out = path("m.glb");
    put(model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const std::string draw = " --size 16x16 --voxels 16 --quality draft -o " + path("m.png");
    EXPECT_NE(conelight("render " + model + draw).output.find("a studio with a ground was added"),
              std::string::npos);
    EXPECT_NE(conelight("render " + model + " --no-ground" + draw).output.find("a studio was added"),
              std::string::npos);
    EXPECT_NE(conelight("render builtin:furnace --no-ground --exec 'open " + model + "'" + draw)
                  .output.find("a studio was added"),
              std::string::npos);
    EXPECT_NE(conelight("info " + model).output.find("a studio with a ground was added"), std::string::npos);
    ASSERT_EQ(conelight("convert " + model + " " + out).status, 0);
    const std::string converted = conelight("info " + out).output;
    EXPECT_NE(converted.find("4 drawn"), std::string::npos) << converted;
    EXPECT_NE(converted.find("lights     0"), std::string::npos) << converted;
}

// A stranger's scene does not carry files of the user away, whichever command opens it.
TEST_F(OutputsTest, WhatLiesOutsideIsReadWhenAllowed) {
    fs::create_directories(path("scene"));
    ASSERT_EQ(conelight("convert builtin:furnace " + path("scene/s.gltf")).status, 0);
    fs::rename(path("scene/s.bin"), path("s.bin"));
    fs::create_symlink("../s.bin", path("scene/s.bin"));
    const std::string scene = path("scene/s.gltf"), out = path("o.glb"), picture = path("o.png");
    const std::string draw = " --mode phong --size 16x16 -o " + picture;
    for (const std::string& command :
         {"info " + scene, "convert " + scene + " " + out, "render " + scene + draw,
          "render builtin:furnace --exec 'open " + scene + "'" + draw}) {
        expectOneLine(conelight(command), 3, "lies outside the scene's folder");
        EXPECT_FALSE(fs::exists(out) || fs::exists(picture)) << command;
        EXPECT_EQ(conelight(command + " --allow-outside").status, 0) << command;
        fs::remove(out);
        fs::remove(picture);
    }
}

TEST_F(OutputsTest, NothingIsWrittenOverAnotherKind) {
    const std::string notes = path("notes.txt"), model = path("model.obj");
    put(notes, "dear diary");
    put(model, "v 0 0 0\n");
    expectKept(notes, "bench builtin:furnace --json " + notes, "holds no JSON");
    expectKept(model, "bench builtin:furnace --json " + model, "name of a picture or scene");
    expectOneLine(conelight("bench builtin:furnace --json " + path("new.glb")), 2,
                  "name of a picture or scene");
    ASSERT_EQ(conelight("render builtin:furnace --mode phong --size 16x16 -o " + path("a.png")).status, 0);
    fs::create_directory(path("site"));
    put(path("site/index.html"), "<html>my own</html>");
    const std::string compare = "compare " + path("a.png") + " " + path("a.png");
    expectKept(path("site/index.html"), compare + " --report " + path("site"), "no report of this program");
    // Its own are written anew.
    for (int i = 0; i < 2; ++i) {
        const std::string all = compare + " --report " + path("page") + " --json " + path("n.json");
        EXPECT_EQ(conelight(all).status, 0) << i;
    }
}

// Whatever the names of temporary files were once.
TEST_F(OutputsTest, FilesBesideAnOutputAreTheUsers) {
    const std::string picture = path("o.png"), film = path("film.mp4");
    const std::vector<std::string> names = {".probe.o.png", "film.partial.mp4", ".probe.film.mp4"};
    for (const std::string& name : names) put(path(name), "mine");
    fs::create_directory(path("bin"));
    put(path("bin/ffmpeg"), "#!/bin/sh\nfor f; do :; done\ncat > \"$f\"\n");
    fs::permissions(path("bin/ffmpeg"), fs::perms::owner_all);
    const std::string small = "render builtin:furnace --mode phong --size 16x16 ";
    ASSERT_EQ(conelight(small + "-o " + picture).status, 0);
    ASSERT_EQ(conelight(small + "--turntable --frames 2 -o " + film, "PATH=" + path("bin") + ":$PATH").status,
              0);
    for (const std::string& name : names) EXPECT_EQ(bytesOf(path(name)), "mine") << name;
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratchDir())) ++files;
    EXPECT_EQ(files, names.size() + 3) << "the program, the picture and the film";
}

TEST_F(OutputsTest, AFileThatMayNotGrowLeavesNothing) {
    const std::string file = path("large.glb");
    const CommandResult result =
        runCommand("bash -c 'ulimit -f 64; exec \"" + std::string(CONELIGHT_PROGRAM) +
                   "\" convert builtin:atrium?triangles=20000 " + file + "' 2>&1 | grep -v kept");
    EXPECT_NE(result.output.find("large.glb: cannot be written: file too large"), std::string::npos)
        << result.output;
    EXPECT_TRUE(fs::is_empty(scratchDir()));
}

// At every stage: while the program starts, while a scene is made, while threads work.
TEST_F(OutputsTest, OutOfMemoryIsOneLine) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer reserves terabytes";
#endif
    int refused = 0;
    const std::string traced =
        "render builtin:cornell --mode reference --spp 1 --size 3000x3000 -o " + path("o.exr");
    for (const int megabytes : {280, 300, 320, 400, 600, 800})
        for (const std::string& command : {std::string("info builtin:atrium?triangles=2000000"), traced}) {
            const CommandResult result =
                runCommand("bash -c 'ulimit -v " + std::to_string(1024 * megabytes) + "; exec \"" +
                           std::string(CONELIGHT_PROGRAM) + "\" " + command + "'");
            if (result.status == 0 || result.status == 127) continue;  // 127: even the loader had too little
            ++refused;
            expectOneLine(result, 1, "memory");
        }
    EXPECT_GT(refused, 1);
}

// --memory: what is drawn with less is said in one line, what cannot fit is one.
TEST_F(OutputsTest, MemoryIsKeptWithin) {
    const std::string picture = path("m.png"),
                      small = " --size 64x48 --aa 0 --set traced.passes=1 -o " + picture;
    const CommandResult whole = conelight("render builtin:cornell --memory 1024" + small);
    EXPECT_EQ(whole.status, 0) << whole.output;
    EXPECT_EQ(whole.output.find("memory"), std::string::npos) << whole.output;
    const CommandResult less = conelight("render builtin:cornell --memory 12" + small);
    EXPECT_EQ(less.status, 0) << less.output;
    EXPECT_NE(less.output.find("conelight: memory: within 12 MB by voxels.size "), std::string::npos)
        << less.output;
    EXPECT_NE(less.output.find("light.shadow_size "), std::string::npos) << less.output;
    fs::remove(picture);
    expectOneLine(conelight("render builtin:cornell --mode phong --memory 8 --size 2000x2000 -o " + picture),
                  1, "does not fit into the limit of 8 MiB");
    EXPECT_FALSE(fs::exists(picture));
    expectOneLine(conelight("render builtin:cornell --memory 1" + small), 2, "--memory");
#if !defined(__SANITIZE_ADDRESS__)
    expectOneLine(
        conelight("render builtin:cornell --mode reference --spp 1 --size 4000x4000 --memory 256 -o " +
                  path("m.exr")),
        1, "--memory is 256 MB");
#endif
}

TEST_F(OutputsTest, PicturesSayHowTheyWereMade) {
    for (const char* name : {"made.png", "made.exr"}) {
        const std::string picture = scratchPath(name);
        ASSERT_EQ(conelight("render builtin:cornell --mode phong --size 16x12 --eye 0,1,2 --target 0,0.5,0 "
                            "--set image.exposure=2 --environment builtin:sky --rotate 30 --no-ground "
                            "--exec 'rotate \"short block\" y 20' -o '" +
                            picture + "'")
                      .status,
                  0);
        const std::string said = conelight("info '" + picture + "'").output;
        for (const char* line :
             {"size       16 x 12, 3 channels", "Software   Conelight ", "Scene      builtin:cornell",
              "Mode       phong", "--eye 0,1,2 --target 0,0.5,0", "Size       16x12", "image.exposure=2",
              "Options    --environment builtin:sky --rotate 30 --no-ground",
              "Commands   rotate \"short block\" y 20", "Device     "})
            EXPECT_NE(said.find(line), std::string::npos) << line << " in\n" << said;
    }
    const std::string traced = scratchPath("made_traced.exr");
    ASSERT_EQ(
        conelight("render builtin:cornell --mode reference --spp 6 --seed 5 --size 8x8 -o '" + traced + "'")
            .status,
        0);
    const std::string said = conelight("info '" + traced + "'").output;
    for (const char* line : {"Samples    6", "Seed       5", "Device     CPU"})
        EXPECT_NE(said.find(line), std::string::npos) << line << " in\n" << said;
}

}  // namespace
}  // namespace conelight::test
