// SPDX-License-Identifier: MIT
// `conelight view` under Xvfb, driven through its console; skipped without one. Its camera moves as the
// pointer does is tested below without a window.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "io/image_file.h"
#include "support/program.h"
#include "viewer/camera_control.h"

namespace conelight::test {
namespace {

// The program on a virtual screen of its own. A driver that hangs is ended after a minute.
CommandResult view(const std::string& arguments, const std::string& input) {
    return runCommand("printf '" + input +
                      "' | timeout 60 xvfb-run -a -s '-screen 0 800x600x24' '" CONELIGHT_PROGRAM "' view " +
                      arguments + " 2>&1");
}

class ViewerTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "xvfb-run is not installed (packages xvfb, xauth)";
    }
};

TEST_F(ViewerTest, ConsoleSwitchesModesTakesAScreenshotAndQuits) {
    const std::string shot = scratchPath("viewer.png");
    std::filesystem::remove(shot);
    const CommandResult result =
        view("builtin:cornell --voxels 32 --window 640x480 --mode phong",
             "wait 2\\nmode cones\\nwait 2\\nget mode\\nscreenshot " + shot + "\\nnonsense\\nquit 7\\n");
    EXPECT_EQ(result.status, 7) << result.output;
    EXPECT_NE(result.output.find("cones"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("nonsense"), std::string::npos) << "an unknown command is named";
    const io::ByteImage picture = io::readByteImage(shot);
    double sum = 0;
    for (const std::uint8_t value : picture.pixels) sum += value;
    EXPECT_GT(sum / static_cast<double>(picture.pixels.size()), 10) << "the picture is not black";
}

TEST(CameraControl, OrbitKeepsTheDistanceAndFlyKeepsTheDirection) {
    Camera camera;
    camera.eye = {1, 2, 5};
    camera.target = {0, 1, 0};
    const float distance = glm::length(camera.target - camera.eye);
    Camera turned = camera;
    program::orbit(turned, {0.5f, -0.2f});
    EXPECT_EQ(turned.target, camera.target);
    EXPECT_NEAR(glm::length(turned.target - turned.eye), distance, 1e-4f);
    Camera flown = camera;
    program::fly(flown, {{0, 0, 1}, {0, 0}, 0.5f, 2.0f});
    const glm::vec3 before = glm::normalize(camera.target - camera.eye);
    EXPECT_NEAR(glm::dot(before, glm::normalize(flown.target - flown.eye)), 1, 1e-5f);
    EXPECT_NEAR(glm::dot(flown.eye - camera.eye, before), 1, 1e-4f);  // half a second at 2 m/s
    // Pitch stops short of the pole.
    program::orbit(turned, {0, 10});
    EXPECT_LT(std::fabs(program::viewAngles(turned).pitch), program::kMaxPitch + 1e-3f);
}

TEST(CameraControl, FocusShowsAllOfABox) {
    Camera camera;
    Aabb box;
    box.grow({-1, -2, -3});
    box.grow({4, 5, 6});
    program::focusOn(camera, box, 0.5f);
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const float half = std::atan(std::tan(0.5f * camera.fovY) * 0.5f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? 4 : -1, (corner & 2) ? 5 : -2, (corner & 4) ? 6 : -3);
        const float angle = std::acos(glm::dot(glm::normalize(p - camera.eye), forward));
        EXPECT_LT(angle, half + 1e-4f) << corner;
    }
}

}  // namespace
}  // namespace conelight::test
