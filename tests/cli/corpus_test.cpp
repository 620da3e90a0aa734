// SPDX-License-Identifier: MIT
// Every file of the corpus (support/corpus.h) loads, or is refused with one line and exit status 3, within 10 s
// of processor time and 4 GiB; what is refused leaves no output.
#include <algorithm>
#include <filesystem>

#include "support/corpus.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

class CorpusTest : public GlTest {
  protected:
    // `command` with %s for the file. Scripts end with 2 when a command is wrong.
    void check(const std::vector<CorpusFile>& files, const std::string& command, bool script = false) {
        for (const CorpusFile& file : files) {
            std::string line = command;
            line.replace(line.find("%s"), 2, "'" + file.path.string() + "'");
            fs::remove_all(outputs());
            fs::create_directories(outputs());
#if defined(__SANITIZE_ADDRESS__)
            const std::string limits = "ulimit -t 60; exec ";
#else
            const std::string limits = "ulimit -t 10 -v 4194304; exec ";
#endif
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
        EXPECT_GT(files.size(), 9u);
    }
    static fs::path outputs() { return scratchPath("outputs"); }
    static fs::path folder() { return scratchPath("corpus"); }
    static std::string drawing(const std::string& option) {
        return "render builtin:furnace --size 8x8 --voxels 16 --mode phong " + option + " %s -o " +
               (outputs() / "picture.png").string();
    }
};

TEST_F(CorpusTest, Gltf) { check(gltfCorpus(folder()), "info %s"); }
TEST_F(CorpusTest, Obj) { check(objCorpus(folder()), "info %s"); }
TEST_F(CorpusTest, Thesis) { check(thesisCorpus(folder()), "info %s"); }
TEST_F(CorpusTest, Presets) { check(presetCorpus(folder()), drawing("--preset")); }
TEST_F(CorpusTest, Scripts) { check(scriptCorpus(folder()), drawing("--script"), true); }
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
