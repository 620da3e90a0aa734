// SPDX-License-Identifier: MIT
// A picture at rest is drawn in parts: the window answers clicks, keys and drags before the picture is finished.
#include "cli/viewer_panels_support.h"

namespace conelight::test {
namespace {

class ViewerAnswersTest : public ViewerPanelsTest {
  protected:
    int pictures() { return std::stoi(viewer->status("frames")); }
    // The answer to `input`, which comes while a pass of the picture is drawn, before that is finished. Where a pass
    // happens to end between two questions, another try shows it; a window that draws on would never answer before.
    std::string answerTo(const std::string& input, const std::string& key) {
        for (int tries = 0; tries < 10; ++tries) {
            viewer->send("set traced.pixel_rays " + std::to_string(11 + tries % 2));  // passes begin again
            const int first = pictures();
            EXPECT_TRUE(eventually([&] { return pictures() > first; })) << "passes go on";
            const int before = pictures();
            viewer->pause();
            screen->xdotool(input);
            viewer->resume();
            viewer->status("mode");
            viewer->status("mode");
            const std::string answer = viewer->status(key);
            if (pictures() == before) return answer;
        }
        ADD_FAILURE() << input << ": " << viewer->output();
        return {};
    }
};

TEST_F(ViewerAnswersTest, BeforeThePictureIsFinished) {
    start(
        "--window 720x480 --voxels 32 --mode traced --no-state --gl-debug --set traced.pixel_rays=12 "
        "builtin:cornell");
    EXPECT_TRUE(eventually([&] { return pictures() > 0; }));
    // A click, a key, a double-click with what is typed into the number that it opens. Each makes passes anew.
    const std::string block = moving(inPicture(0.62f, 0.72f)), beside = moving(inPicture(0.9f, 0.1f));
    EXPECT_NE(answerTo(block + " click 1", "selection").find("short block"), std::string::npos);
    const glm::ivec4 number = viewer->placeOf("edit:position");
    ASSERT_GT(number.z, 0) << viewer->output();
    moveTo(glm::ivec2(number) + glm::ivec2(number.z / 8, number.w / 2));
    pass();
    answerTo("click --repeat 2 --delay 40 1", "selection");
    screen->xdotool("type 0.25");
    screen->xdotool("key Return");
    EXPECT_NE(
        viewer->statusUntil("selection",
                            [](const std::string& now) { return now.find("at 0.25") != std::string::npos; }),
        "")
        << viewer->output();
    const std::string camera = viewer->status("camera");
    EXPECT_NE(answerTo(beside + " key r", "camera"), camera);
    EXPECT_EQ(viewer->status("pauses").rfind("longest ", 0), 0u);
    viewer->send("set traced.pixel_rays 0; set traced.specular_rays 0; settle; echo settled");
    EXPECT_NE(viewer->expect("settled"), "") << viewer->output();
    EXPECT_NE(viewer->status("mode").find("done"), std::string::npos);
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    EXPECT_EQ(viewer->output().find("OpenGL: "), std::string::npos) << viewer->output();
}

// tools/measure_viewer works in the window, too: one round of its steps.
TEST_F(ViewerAnswersTest, TheToolMeasuresARound) {
    const std::string out = scratchPath("measured_viewer");
    const CommandResult result =
        runCommand("'" CONELIGHT_SOURCE_DIR "/tools/measure_viewer' --minutes 0 --program '" CONELIGHT_PROGRAM
                   "' --window 720x480 --other builtin:cornell-point --out '" +
                   out + "' -- --voxels 24 --mode phong --set image.temporal=off");
    EXPECT_EQ(result.status, 0) << result.output;
    const std::string page = bytesOf(out + ".md");
    for (const char* part : {"from a click until", "| orbit | ", "| open | ", "ms of CPU a frame"})
        EXPECT_NE(page.find(part), std::string::npos) << part << " is missing in\n" << page;
}

}  // namespace
}  // namespace conelight::test
