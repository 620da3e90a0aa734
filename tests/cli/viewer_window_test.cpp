// SPDX-License-Identifier: MIT
// The viewer's window as a guest of its desktop: size, close button, dropped files, lines typed and
// remembered, and what it says of bad input.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "cli/viewer_panels_support.h"
#include "io/image_file.h"
#include "support/program.h"
#include "support/x11_client.h"

namespace conelight::test {
namespace {

TEST_F(ViewerTest, LinesAreTypedIntoTheWindowAndRemembered) {
    const std::string state = scratchPath("state");
    std::filesystem::remove_all(state);
    const std::string environment = "XDG_STATE_HOME=" + state;
    const std::string options = "--window 720x480 " + kCheap + "builtin:cornell";
    start(options, environment);
    settle();
    click("console");
    const glm::ivec4 line = viewer->placeOf("console");
    const auto enter = [&](const std::string& text) {
        type(text, line);
        screen->xdotool("key Return");
    };
    enter("set image.exposure 1.5");
    EXPECT_TRUE(eventually([&] { return viewer->setting("image.exposure") == "1.5"; })) << viewer->output();
    enter("set image.exposure 2");
    EXPECT_TRUE(eventually([&] { return viewer->setting("image.exposure") == "2"; })) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
    EXPECT_EQ(bytesOf(state + "/conelight/recent"), "builtin:cornell\n");
    EXPECT_EQ(bytesOf(state + "/conelight/history"), "set image.exposure 1.5\nset image.exposure 2\n");

    // The next run knows them: the arrow goes back past the last to the first.
    start(options, environment);
    settle();
    const glm::ivec4 box = viewer->placeOf("console");
    click("console");
    // Each step is waited for on the screen: lines of the standard input are history too.
    for (const char* action : {"type --delay 30 'set im'", "key Up", "key Up"}) {
        const ScreenPixels last = screen->pixels();
        screen->xdotool(action);
        // Text of other length: the cursor that blinks is no change.
        EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(last, box) > 2 * box.w; }))
            << action;
    }
    screen->xdotool("key Return");
    EXPECT_TRUE(eventually([&] { return viewer->setting("image.exposure") == "1.5"; })) << viewer->output();
    // And the menu has the scene.
    click("menu:File");
    click("menu:Open recent");
    click("recent:builtin:cornell");
    EXPECT_TRUE(eventually([&] {
        viewer->status("frames");
        return viewer->output().find("loaded builtin:cornell") != std::string::npos;
    })) << viewer->output();
}

TEST_F(ViewerTest, BadFilesAndBadNumbersAreLinesNotTheEnd) {
    const std::string broken = scratchPath("broken.gltf");
    std::ofstream(broken) << "{";
    start(kSmall + "builtin:cornell");
    settle();
    for (const std::string& path : {broken, scratchPath(""), scratchPath("nowhere.glb")}) {
        viewer->send("open '" + path + "'");
        EXPECT_NE(viewer->expect(path), "") << viewer->output();
    }
    viewer->send("set voxels.size 7");
    EXPECT_NE(viewer->expect("setting voxels.size"), "") << viewer->output();
    // Each is a line in the log, in the colour of errors, however long.
    EXPECT_NE(viewer->status("log").find("4 errors"), std::string::npos) << viewer->status("log");
    const glm::ivec4 box = viewer->placeOf("console");
    const auto redRows = [&] {
        const ScreenPixels now = screen->pixels();
        int rows = 0;
        for (int y = picture().y + picture().w; y < box.y; ++y)
            for (int x = box.x; x < box.x + box.z; ++x)
                if (const glm::ivec3 p = now.at({x, y}); p.x > 180 && p.z < 140) {
                    ++rows;
                    break;
                }
        return rows;
    };
    for (int i = 0; i < 12; ++i) viewer->send("echo a line without an error");
    pass();
    EXPECT_TRUE(eventually([&] { return redRows() == 0; })) << "they have gone up";
    viewer->send("open " + std::string(150, 'x'));
    EXPECT_NE(viewer->expect(std::string(150, 'x')), "") << viewer->output();
    EXPECT_TRUE(eventually([&] { return redRows() > 12; })) << "it takes two lines at least";
    // What the renderer refuses while it draws.
    viewer->send("mode reference; component voxels; wait 3; mode phong; component full; settle; echo alive");
    EXPECT_NE(viewer->expect("alive"), "") << viewer->output();
    viewer->send("where nowhere");
    EXPECT_NE(viewer->expect("where: 'nowhere' is not on the screen"), "");
    // A window of nothing draws nothing, and comes back.
    screen->xdotool("search --name Conelight windowsize 20 12");
    viewer->statusUntil("window",
                        [](const std::string& now) { return now.find("20 x 12") != std::string::npos; });
    viewer->send("mode cones; wait 2; mode phong");
    screen->xdotool("search --name Conelight windowsize 720 480");
    viewer->statusUntil("window",
                        [](const std::string& now) { return now.find("720 x 480") != std::string::npos; });
    settle();
    EXPECT_EQ(viewer->status("picture").rfind(std::to_string(picture().z) + " x", 0), 0u);
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerTest, WindowChangesSizeFillsTheScreenAndCloses) {
    start(kSmall + "--ui-scale 1.5 builtin:cornell");
    settle();
    EXPECT_NE(viewer->status("window").find("scale 1.50"), std::string::npos);
    const glm::ivec4 before = picture();
    screen->xdotool("search --name Conelight windowsize 700 500");
    const std::string small = viewer->statusUntil(
        "window", [](const std::string& now) { return now.find("700 x 500") != std::string::npos; });
    EXPECT_NE(small.find("700 x 500"), std::string::npos) << small;
    settle();
    EXPECT_LT(picture().z, before.z);
    EXPECT_NE(viewer->status("picture").find(std::to_string(picture().z) + " x"), std::string::npos)
        << "drawn at the size it is shown at";
    screen->xdotool("key F11");
    const std::string full = viewer->statusUntil(
        "window", [](const std::string& now) { return now.find("full screen") != std::string::npos; });
    EXPECT_NE(full.find("960 x 640"), std::string::npos) << full;
    viewer->send("fullscreen off; panels off");
    settle();
    EXPECT_EQ(picture().x, 0) << "the picture has the whole width";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Two sizes and two scales: letters stand where they should, as high as they should be, and the picture fills its place.
TEST_F(ViewerPanelsTest, EverySizeAndScaleIsDrawnWhole) {
    start(kSmall + "builtin:cornell");
    settle();
    const auto isRed = [](const glm::vec3& p) { return p.x > 1.5f * p.y && p.x > 40; };
    const auto isGreen = [](const glm::vec3& p) { return p.y > 1.3f * p.x && p.y > 40; };
    for (const char* size : {"720 480", "940 620"}) {
        screen->xdotool(std::string("search --name Conelight windowsize ") + size);
        const std::string wide = std::string(size).substr(0, 3) + " x " + std::string(size).substr(4);
        viewer->statusUntil("window",
                            [&](const std::string& now) { return now.find(wide) != std::string::npos; });
        int heights[2] = {0, 0};
        for (const int half : {2, 3}) {
            viewer->send(std::string("ui_scale ") + (half == 2 ? "1" : "1.5"));
            settle();
            for (const char* widget : {"menu:File", "menu:View", "tab:Scene", "tab:Image"})
                EXPECT_TRUE(lettersShown(widget)) << widget << ", " << size << ", " << half;
            heights[half - 2] = viewer->placeOf("tab:Scene").w;
            const glm::ivec4 place = picture();
            EXPECT_EQ(viewer->status("picture").rfind(fmt::format("{} x {} of", place.z, place.w), 0), 0u);
            EXPECT_TRUE(eventually([&] {
                return isRed(shownAt(inPicture(0.12f, 0.5f))) && isGreen(shownAt(inPicture(0.88f, 0.5f)));
            })) << size
                << ", " << half << ": the walls stand on both sides";
            // The file of the window shows what the screen does.
            const std::string file = scratchPath("whole.png");
            ASSERT_NE(answer("screenshot_window " + file, "written " + file), "");
            const io::ByteImage shot = io::readByteImage(file);
            const ScreenPixels now = screen->pixels();
            // But for the console, which says since that it is written.
            const glm::ivec4 line = viewer->placeOf("console");
            int different = 0;
            for (int y = 0; y < shot.height; y += 3)
                for (int x = 0; x < shot.width; x += 3) {
                    if (y >= place.y + place.w && y < line.y + line.w && x >= line.x && x < line.x + line.z)
                        continue;
                    const std::size_t i = (std::size_t(y) * std::size_t(shot.width) + std::size_t(x)) *
                                          std::size_t(shot.channels);
                    const glm::ivec3 p(shot.pixels[i], shot.pixels[i + 1], shot.pixels[i + 2]);
                    different += p != now.at({x, y});
                }
            EXPECT_LT(different, shot.width * shot.height / 9 / 500);
        }
        EXPECT_NEAR(float(heights[1]) / float(heights[0]), 1.5f, 0.1f);
    }
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerTest, TheCloseButtonEndsIt) {
    if (const std::string missing = x11Missing(); !missing.empty()) GTEST_SKIP() << missing;
    start(kSmall + "--timing builtin:cornell");
    settle();
    pressCloseButton(screen->display(), "Conelight");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    EXPECT_NE(viewer->output().find("timing: GUI"), std::string::npos) << "it ended in order";
    // Also while programs are built for the first picture.
    start(kSmall + "--gl-debug --exec quit builtin:cornell", "MESA_SHADER_CACHE_DISABLE=true");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    EXPECT_EQ(viewer->output().find("OpenGL: "), std::string::npos) << viewer->output();
}

// As a file manager drops them: the first is opened, and what cannot be is a line.
TEST_F(ViewerTest, DroppedFilesAreOpened) {
    if (const std::string missing = x11Missing(); !missing.empty()) GTEST_SKIP() << missing;
    const std::string folder = scratchPath("dropped");
    std::filesystem::create_directories(folder);
    const std::string scene = folder + "/a scene's file.glb", broken = folder + "/broken.gltf";
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("save '" + folder + "/a.glb' overwrite; echo saved");
    ASSERT_NE(viewer->expect("saved " + folder), "") << viewer->output();
    std::filesystem::rename(folder + "/a.glb", scene);
    std::ofstream(broken) << "{";
    ASSERT_TRUE(dropFiles(screen->display(), "Conelight", {scene, broken}));
    EXPECT_NE(viewer->expect("loaded " + scene), "") << viewer->output();
    EXPECT_EQ(viewer->status("scene"), scene);
    settle();
    ASSERT_TRUE(dropFiles(screen->display(), "Conelight", {broken}));
    EXPECT_NE(viewer->expect(broken), "") << viewer->output();
    EXPECT_EQ(viewer->status("scene"), scene) << "what was there stays";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

}  // namespace
}  // namespace conelight::test
