// SPDX-License-Identifier: MIT
// Every file of the corpus (support/corpus.h) loads, or is refused with one line and exit status 3, within 10 s
// of processor time and 4 GiB; what is refused leaves no output.
#include <png.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "cpu/io_test_support.h"
#include "support/corpus.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__)
constexpr const char* kMemoryLimit = "";
#else
constexpr const char* kMemoryLimit = " -v 4194304";
#endif

class CorpusTest : public GlTest {
  protected:
    // `command` with %s for the file. Scripts end with 2 when a command is wrong.
    void check(const std::vector<CorpusFile>& files, const std::string& command, std::size_t least = 10,
               bool script = false) {
        for (const CorpusFile& file : files) {
            std::string line = command;
            line.replace(line.find("%s"), 2, "'" + file.path.string() + "'");
            fs::remove_all(outputs());
            fs::create_directories(outputs());
            const std::string limits = "ulimit -t " + seconds() + kMemoryLimit + "; exec ";
            const CommandResult result =
                runCommand("bash -c \"" + limits + "'" + CONELIGHT_PROGRAM + "' " + line + "\" < /dev/null");
            if (file.expect == Expect::Loads || (file.expect == Expect::Either && result.status == 0)) {
                EXPECT_EQ(result.status, 0) << file.path << result.output.substr(0, 500);
                continue;
            }
            EXPECT_TRUE(result.status == 3 || (script && result.status == 2))
                << file.path << ": status " << result.status << ": " << result.output.substr(0, 500);
            EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1)
                << file.path << result.output.substr(0, 500);
            EXPECT_EQ(result.output.rfind("conelight: ", 0), 0u) << result.output.substr(0, 500);
            EXPECT_TRUE(fs::is_empty(outputs())) << file.path;
        }
        EXPECT_GE(files.size(), least);
    }
    // Of processor time. What is promised is 10 s, on a machine that does nothing else; beside other work all takes longer.
    static std::string seconds() {
        const char* asked = std::getenv("CONELIGHT_CORPUS_SECONDS");
        return asked ? asked : "60";
    }
    static fs::path outputs() { return scratchPath("outputs"); }
    static fs::path folder() { return scratchPath("corpus"); }
    static std::string drawing(const std::string& option) {
        return "render builtin:furnace --size 8x8 --voxels 16 --mode phong " + option + " %s -o " +
               (outputs() / "picture.png").string();
    }
};

// Black texels of three bytes: 16,384 squared are 800 KB.
void writeBlackPng(const fs::path& file, int side) {
    std::FILE* out = std::fopen(file.c_str(), "wb");
    ASSERT_NE(out, nullptr);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    const auto edge = static_cast<png_uint_32>(side);
    png_set_IHDR(png, info, edge, edge, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    const std::vector<std::uint8_t> row(std::size_t(edge) * 3);
    for (int y = 0; y < side; ++y) png_write_row(png, row.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(out);
}

// Thirty textures of 16,384 squared, of which each would be a gigabyte: two are read, made smaller, and the
// others are left out with a note.
TEST_F(CorpusTest, HugeTextures) {
    fs::create_directories(folder());
    writeBlackPng(folder() / "huge.png", 16384);
    EXPECT_LT(fs::file_size(folder() / "huge.png"), 900000u);
    GltfBuilder builder;
    builder.triangle();
    builder.node({{"mesh", 0}});
    for (int i = 0; i < 30; ++i) {
        builder.json["images"].push_back({{"uri", "huge.png"}});
        builder.json["textures"].push_back({{"source", i}});
        builder.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
    }
    builder.json["meshes"][0]["primitives"][0]["material"] = 29;
    const fs::path scene = folder() / "huge.glb";
    write(scene, builder.glb());
    check({{scene, Expect::Loads}}, "info %s", 1);
}

TEST_F(CorpusTest, Gltf) { check(gltfCorpus(folder()), "info %s"); }
TEST_F(CorpusTest, Compressed) {
    check(compressedCorpus(folder(), {Packing::Draco, Packing::Meshopt, Packing::Webp}), "info %s");
}
TEST_F(CorpusTest, Obj) { check(objCorpus(folder()), "info %s"); }
TEST_F(CorpusTest, Thesis) { check(thesisCorpus(folder()), "info %s"); }
TEST_F(CorpusTest, Presets) { check(presetCorpus(folder()), drawing("--preset")); }
TEST_F(CorpusTest, ConeSets) {
    check(coneSetCorpus(folder()),
          "render builtin:furnace --size 8x8 --voxels 16 --mode cones --set cones.diffuse_set=own "
          "--cone-set %s -o " +
              (outputs() / "picture.png").string());
}
TEST_F(CorpusTest, BatchJobs) {
    check(batchJobCorpus(folder()), "batch --jobs 1 %s -o " + (outputs() / "pictures").string());
}
TEST_F(CorpusTest, Scripts) { check(scriptCorpus(folder()), drawing("--script"), 10, true); }
TEST_F(CorpusTest, Pictures) {
    fs::create_directories(folder());
    check(pictureCorpus(folder()), "compare --no-flip %s " + (folder() / "valid.exr").string());
}
TEST_F(CorpusTest, CameraPaths) {
    const std::string frames = (outputs() / "f%d.png").string();
    check(cameraPathCorpus(folder()),
          "render builtin:furnace --size 8x8 --voxels 16 --mode phong --frames 2 --path %s -o " + frames);
}

}  // namespace
}  // namespace conelight::test
