// SPDX-License-Identifier: MIT
// Every file of Debian's assimp-testmodels (about 600, many broken on purpose) either renders or fails with
// one clear line; none crashes, hangs, or draws a pixel that is not finite. Skipped when the package is
// absent.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "conelight/error.h"
#include "conelight/renderer.h"
#include "io/scene_file.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> modelFiles() {
    const char* folder = std::getenv("CONELIGHT_ASSIMP_MODELS");
    std::vector<fs::path> files;
    std::error_code missing;
    for (const auto& entry :
         fs::recursive_directory_iterator(folder != nullptr ? folder : "/usr/share/assimp/models", missing))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class ForeignModelsTest : public GlTest {};

TEST_F(ForeignModelsTest, EachRendersOrFailsWithOneLine) {
    const std::vector<fs::path> files = modelFiles();
    if (files.empty()) GTEST_SKIP() << "package assimp-testmodels is not installed";
    Renderer renderer;
    Settings settings;
    settings.mode = Mode::Cones;
    settings.voxels.size = 16;
    settings.light.shadowSize = 64;
    settings.light.areaSamples = 1;
    int drawn = 0, refused = 0;
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.string());
        try {
            io::LoadOptions load;
            load.timeLimitSeconds = 8;
            Scene scene = io::loadScene(file.string(), load);
            completeScene(scene);
            renderer.setScene(scene);
            renderer.render(scene.cameras.front(), 32, 24, settings);
            for (const glm::vec4& pixel : renderer.readImage().pixels) {
                if (std::isfinite(pixel.x + pixel.y + pixel.z)) continue;
                ADD_FAILURE() << "a pixel is not finite";
                break;
            }
            ++drawn;
        } catch (const Error& error) {
            const std::string line = error.what();
            EXPECT_EQ(line.find('\n'), std::string::npos) << line;
            EXPECT_LT(line.size(), 600u) << line;
            EXPECT_NE(line.find(file.filename().string()), std::string::npos) << line;
            ++refused;
        }
    }
    std::cout << drawn << " files drawn, " << refused << " refused with one line\n";
    EXPECT_GT(drawn, 200);
}

}  // namespace
}  // namespace conelight::test
