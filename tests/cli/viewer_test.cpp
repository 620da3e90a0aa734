// SPDX-License-Identifier: MIT
// `conelight view` on a screen without a monitor, driven by mouse, keys and its console, watched by what it
// prints and by the screen's pixels. The window itself: viewer_window_test.cpp. Skipped where Xvfb or xdotool
// is not installed.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "cli/viewer_test_support.h"
#include "io/image_file.h"
#include "support/program.h"
#include "support/x11_client.h"

namespace conelight::test {
namespace {

TEST_F(ViewerTest, ConsoleSwitchesModesTakesAScreenshotAndQuits) {
    const std::string shot = scratchPath("viewer.png");
    std::filesystem::remove(shot);
    start(kSmall + "builtin:cornell");
    viewer->send("mode cones; settle; screenshot " + shot);
    EXPECT_NE(viewer->expect("written " + shot), "") << viewer->output();
    EXPECT_EQ(viewer->setting("mode"), "cones");
    const io::ByteImage picture = io::readByteImage(shot);
    const glm::ivec4 place = this->picture();
    EXPECT_EQ(picture.width, place.z);
    EXPECT_EQ(picture.height, place.w);
    // The screen shows the same picture.
    const glm::ivec2 at(picture.width / 3, picture.height / 3);
    const std::size_t index = 3 * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(at.x));
    const glm::vec3 written(picture.pixels[index], picture.pixels[index + 1], picture.pixels[index + 2]);
    EXPECT_GT(written.x, 10);
    EXPECT_TRUE(near(written, shownAt(glm::ivec2(place) + at), 6));
    viewer->send("nonsense");
    EXPECT_NE(viewer->expect("unknown command 'nonsense'"), "") << "an unknown command is named";
    viewer->send("quit 7");
    EXPECT_EQ(viewer->exitStatus(), 7);
}

TEST_F(ViewerTest, MouseAndKeysMoveTheCameraAndChooseObjects) {
    start(kSmall + "builtin:cornell");
    settle();
    const std::string first = viewer->status("camera");
    const glm::ivec2 middle = inPicture(0.5f, 0.5f);

    // A click chooses what lies there, and says what it is.
    EXPECT_EQ(viewer->status("selection"), "none");
    click(inPicture(0.6f, 0.75f));
    EXPECT_NE(viewer->status("selection").find("short block"), std::string::npos)
        << viewer->status("selection");
    EXPECT_NE(viewer->status("pixel").find("short block"), std::string::npos);
    EXPECT_EQ(viewer->status("camera"), first) << "a click does not move the camera";

    // Left drag: round the target. The picture follows.
    const ScreenPixels before = screen->pixels();
    drag(1, middle, middle + glm::ivec2(80, 0));
    const std::string orbited = viewer->status("camera");
    EXPECT_NE(orbited, first);
    settle();
    const glm::ivec4 place = picture();
    EXPECT_GT(screen->pixels().changedFrom(before, place, 12), place.z * place.w / 10) << "a tenth of it";

    // Right button and W: forward.
    moveTo(middle);
    pass();
    screen->xdotool("mousedown 3");
    screen->xdotool("keydown w");
    const std::string flown =
        viewer->statusUntil("camera", [&](const std::string& now) { return now != orbited; });
    screen->xdotool("keyup w");
    screen->xdotool("mouseup 3");
    EXPECT_NE(flown, orbited);

    // F: the camera sees all of the selection; that can be taken back.
    settle();
    const std::string rest = viewer->status("camera");
    screen->xdotool("key f");
    EXPECT_NE(viewer->statusUntil("camera", [&](const std::string& now) { return now != rest; }), rest);
    screen->xdotool("key ctrl+z");
    EXPECT_EQ(viewer->statusUntil("camera", [&](const std::string& now) { return now == rest; }), rest);
}

// "at x y z" and "x axis x y z" of what is selected.
std::vector<float> placeAndAxis(const std::string& text) {
    std::vector<float> found;
    for (const char* word : {" at ", "x axis "}) {
        std::istringstream stream(text.substr(std::min(text.size(), text.find(word) + std::strlen(word))));
        float value = 0;
        for (int i = 0; i < 3 && stream >> value; ++i) {
            found.push_back(value);
            if (stream.peek() == ',') break;
        }
    }
    found.resize(6);
    return found;
}

// A tool by its key, one of its handles, and how far that is dragged, in pixels.
struct HandleDrag {
    const char *key, *handle;
    glm::ivec2 by;
};

// Tool 1 moves, tool 2 turns, tool 3 scales.
void expectDone(const HandleDrag& drag, const std::vector<float>& first, const std::vector<float>& now) {
    const glm::vec3 move(now[0] - first[0], now[1] - first[1], now[2] - first[2]);
    const glm::vec3 axis(now[3], now[4], now[5]), axisBefore(first[3], first[4], first[5]);
    if (drag.key[0] == '1') {
        const int c = drag.handle[6] - 'x';
        EXPECT_GT(move[c], 0.02f) << "towards the arrow";
        EXPECT_NEAR(glm::length(move), std::fabs(move[c]), 1e-4f) << "along the axis alone";
        EXPECT_EQ(axis, axisBefore);
    } else if (drag.key[0] == '2') {
        EXPECT_GT(glm::length(axis - axisBefore), 0.1f);
        EXPECT_NEAR(glm::length(axis), glm::length(axisBefore), 1e-3f) << "turned, not scaled";
        EXPECT_NEAR(axis.y, axisBefore.y, 1e-3f);
    } else {
        EXPECT_GT(glm::length(axis), 1.1f * glm::length(axisBefore));
    }
}

// Handles on what is selected: each tool by the mouse, each drag one step of undo, and the camera stays.
TEST_F(ViewerTest, HandlesMoveTurnAndScaleTheSelection) {
    start(kSmall + "builtin:cornell");
    viewer->send("camera orbit 30 20; select 'short block'");
    settle();
    const auto numbers = [&] { return placeAndAxis(viewer->status("selection")); };
    const std::vector<float> first = numbers();
    const std::string camera = viewer->status("camera");
    for (const HandleDrag& one : {HandleDrag{"1", "gizmo:x", {25, 0}}, HandleDrag{"1", "gizmo:y", {0, -25}},
                                  HandleDrag{"2", "gizmo:y", {-20, 8}}, HandleDrag{"3", "gizmo:x", {20, 0}},
                                  HandleDrag{"3", "gizmo:all", {40, 0}}}) {
        SCOPED_TRACE(std::string(one.key) + one.handle);
        moveTo(inPicture(0.5f, 0.95f));
        screen->xdotool(std::string("key ") + one.key);
        pass();
        const std::string steps = viewer->status("steps");
        const glm::ivec2 from = viewer->middleOf(one.handle);
        ASSERT_GT(from.x, 0) << viewer->output();
        // Each step is waited for on the screen: a command between them would end the step of undo.
        const glm::ivec4 place = picture();
        const auto expectChange = [&](const std::string& action) {
            const ScreenPixels last = screen->pixels();
            screen->xdotool(action);
            EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(last, place) > 10; })) << action;
        };
        expectChange(moving(from));
        screen->xdotool("mousedown 1");
        pass();  // nothing is seen of a button; the step of undo begins with the first move
        expectChange(moving(from + one.by / 2));
        expectChange(moving(from + one.by));
        screen->xdotool("mouseup 1");
        pass();
        const std::vector<float> now = numbers();
        EXPECT_NE(viewer->status("steps"), steps);
        expectDone(one, first, now);
        EXPECT_EQ(viewer->status("camera"), camera);
        viewer->send("undo");
        EXPECT_EQ(numbers(), first) << "one step";
    }
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

TEST_F(ViewerTest, SlidersAreDraggedAndUndone) {
    start(kSmall + "builtin:cornell");
    settle();
    click("tab:Image");
    const glm::ivec4 slider = viewer->placeOf("image.exposure");
    ASSERT_GT(slider.z, 20) << viewer->output();
    const glm::ivec2 at = inPicture(0.5f, 0.35f);
    const glm::vec3 dark = shownAt(at);
    // Each step is waited for on the screen: a command between them would end the step of undo.
    const auto shows = [&] { return screen->pixels().mean({slider.x, slider.y}, {slider.z, slider.w}); };
    const auto expectChange = [&](const std::string& action) {
        const glm::vec3 last = shows();
        screen->xdotool(action);
        EXPECT_TRUE(eventually([&] { return shows() != last; })) << action;
    };
    const auto to = [&](int percent) {
        return "mousemove " + std::to_string(slider.x + slider.z * percent / 100) + " " +
               std::to_string(slider.y + slider.w / 2);
    };
    expectChange(to(50));
    expectChange("mousedown 1");
    expectChange(to(52));
    expectChange(to(55));
    screen->xdotool("mouseup 1");
    const float exposure = std::strtof(viewer->setting("image.exposure").c_str(), nullptr);
    EXPECT_GT(exposure, 0.5f);
    settle();
    EXPECT_GT(glm::length(shownAt(at)), glm::length(dark) * 1.1f);
    EXPECT_EQ(viewer->status("steps").substr(0, 1), "1") << "a drag is one step of undo";
    viewer->send("undo");
    EXPECT_EQ(std::strtof(viewer->setting("image.exposure").c_str(), nullptr), 0.0f);
    settle();
    EXPECT_TRUE(near(shownAt(at), dark, 3));
}

// At a few frames a second a shortcut goes down and up between two of them, in any order.
TEST_F(ViewerTest, KeysLetGoWithinOneFrameDoNotStick) {
    start("--window 720x480 --voxels 64 --mode cones --no-state builtin:cornell");
    settle();
    click("tab:Image");
    // Frames that take a while, without end. Ctrl and Y go down and Ctrl up before one, Y up before the next.
    viewer->send("vox_freq 0.01; dynamic; set image.exposure 1");
    viewer->send("undo");
    pass();
    EXPECT_EQ(viewer->setting("image.exposure"), "0");
    viewer->pause();
    screen->xdotool("keydown ctrl keydown y keyup ctrl");
    viewer->send("status frames");
    viewer->resume();
    viewer->expect("status frames");
    screen->xdotool("keyup y");
    pass();
    viewer->send("dynamic");
    EXPECT_EQ(viewer->setting("image.exposure"), "1") << "redone";
    // With a Ctrl that nobody holds a slider would ask for a number in letters.
    dragWidget("image.exposure", {0.6f, 0.5f}, {30, 0});
    EXPECT_GT(std::strtof(viewer->setting("image.exposure").c_str(), nullptr), 1.5f) << viewer->output();
}

TEST_F(ViewerTest, TwoModesSideBySide) {
    start(kSmall + "--exec 'resolution 0.25' builtin:cornell");
    settle();
    const glm::ivec4 place = picture();
    // The background of mode phong and the path tracer's bounced light differ on the ceiling's edge.
    const glm::ivec2 at = inPicture(0.8f, 0.5f);
    const glm::vec3 phong = shownAt(at);
    viewer->send("split reference 0.5");
    settle();
    EXPECT_NE(viewer->status("split").find("reference at 0.500, shown"), std::string::npos)
        << viewer->output();
    EXPECT_TRUE(eventually([&] { return !near(shownAt(at), phong, 4); }))
        << "the right side is the path tracer's";

    // The line between is dragged; where it was, the left picture is.
    drag(1, viewer->middleOf("split"), {place.x + place.z * 9 / 10, place.y + place.w / 2});
    const std::string split = viewer->status("split");
    ASSERT_EQ(split.rfind("reference at ", 0), 0u) << split;
    EXPECT_NEAR(std::strtof(split.c_str() + 13, nullptr), 0.9f, 0.02f);
    EXPECT_TRUE(eventually([&] { return near(shownAt(at), phong, 4); }));

    // Errors: the right side in blue and red.
    viewer->send("split reference 0; error on");
    const glm::ivec2 size(place.z / 2, place.w / 2);
    EXPECT_TRUE(eventually([&] {
        const glm::vec3 mean = screen->pixels().mean(glm::ivec2(place) + size / 2, size);
        return std::fabs(mean.x - mean.z) > 8;
    })) << "mode phong lacks light: it is too dark";
    viewer->send("error off; split radiosity 0");
    settle();
    EXPECT_NE(viewer->status("split").find("radiosity at 0.000, shown"), std::string::npos)
        << viewer->output();
    EXPECT_TRUE(eventually([&] { return !near(shownAt(at), phong, 4); })) << "bounced light";
    viewer->send("split off; quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerTest, ModesOfTheProcessorInTheWindow) {
    start(kSmall + "--exec 'resolution 0.25' builtin:cornell");
    settle();
    const glm::ivec2 at = inPicture(0.8f, 0.5f);
    const glm::vec3 phong = shownAt(at);
    viewer->send("mode reference");
    settle();
    EXPECT_EQ(viewer->status("mode").substr(0, 9), "reference") << viewer->output();
    EXPECT_TRUE(eventually([&] { return !near(shownAt(at), phong, 4); })) << "bounced light";
    viewer->send("mode phong; split radiosity 0");
    EXPECT_NE(
        viewer
            ->statusUntil("split",
                          [](const std::string& now) { return now.find("not yet") != std::string::npos; })
            .find("not yet"),
        std::string::npos)
        << "until it is baked the left picture is shown";
    settle();
    EXPECT_NE(viewer->status("split").find("radiosity at 0.000, shown"), std::string::npos)
        << viewer->output();
    EXPECT_TRUE(eventually([&] { return !near(shownAt(at), phong, 4); })) << "bounced light";
    // The scene is edited while they work: they begin again, and nothing ends.
    viewer->send("material white color 0.1 0.1 0.1; mode radiosity; wait 3; mode phong; split off");
    settle();
    EXPECT_FALSE(near(shownAt(at), phong, 4)) << "the walls are darker";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// The window draws, follows the mouse and answers while it bakes; commands behind it wait, and it can be
// stopped.
TEST_F(ViewerTest, BakesInTheBackground) {
    const std::string file = scratchPath("baked.glb");
    std::filesystem::remove(file);
    start(kSmall + "--subdivide 1 --visibility-rays 64 builtin:cornell");
    settle();
    viewer->send("bake " + file + "; echo behind");
    EXPECT_NE(viewer->expect("written " + file), "") << viewer->output();
    EXPECT_NE(viewer->expect("behind"), "") << "what waited runs then";
    EXPECT_GT(std::filesystem::file_size(file), 10000u);
    viewer->send("bake " + file + "; echo refused");
    EXPECT_NE(viewer->expect(file), "") << "what exists is left alone";
    ASSERT_NE(viewer->expect("refused"), "");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();

    // So much to bake that no machine is done before it is stopped.
    start(kSmall + "--subdivide 6 --visibility-rays 4096 builtin:cornell");
    settle();
    const std::string before = viewer->status("camera");
    const glm::ivec4 place = picture();
    const auto written = std::filesystem::last_write_time(file);
    viewer->send("bake " + file + " overwrite; status camera");
    const glm::ivec2 middle = glm::ivec2(place) + glm::ivec2(place.z, place.w) / 2;
    const ScreenPixels still = screen->pixels();
    moveTo(middle);
    // Nothing says here when a frame was drawn: on a busy machine the button may be up again before one sees
    // it.
    const auto turned = [&] {
        return !near(screen->pixels().mean(middle - 40, {80, 80}), still.mean(middle - 40, {80, 80}), 0.5f);
    };
    EXPECT_TRUE(eventually([&] {
        moveTo(middle);
        screen->xdotool("mousedown 1");
        for (int i = 1; i <= 8; ++i) {
            moveTo(middle + glm::ivec2(10 * i, 0));
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
        }
        screen->xdotool("mouseup 1");
        return turned();
    })) << "the picture turns";
    pressStop(place);
    EXPECT_NE(viewer->expect("bake: stopped"), "") << viewer->output();
    const std::string after = viewer->expect("status camera: ");
    ASSERT_NE(after, "") << "what is behind it runs";
    EXPECT_EQ(after.find(before), std::string::npos) << "the drag moved the camera meanwhile";
    EXPECT_EQ(std::filesystem::last_write_time(file), written) << "nothing was written";
    // Who closes the window in the midst of it has closed it.
    viewer->send("bake " + file + " overwrite");
    EXPECT_TRUE(stripShown(place));
    if (x11Missing().empty())
        pressCloseButton(screen->display(), "Conelight");
    else
        pressStop(place), viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    EXPECT_EQ(std::filesystem::last_write_time(file), written) << "nothing was written";
}

// A click lists the rays of the pixel and draws them; one in the list stands out and shows its steps.
TEST_F(ViewerTest, InspectorListsAndDrawsRays) {
    screen = std::make_unique<VirtualScreen>(960, 960);
    start("--window 960x960 --voxels 32 --mode traced --no-state --exec 'resolution 0.25' builtin:cornell");
    settle();
    const ScreenPixels before = screen->pixels();
    const glm::ivec4 place = picture();
    click(inPicture(0.62f, 0.72f));
    EXPECT_NE(viewer->status("pixel").find("short block"), std::string::npos);
    settle();
    // Pixels of the picture in the rays' yellow.
    const auto yellow = [&] {
        const ScreenPixels now = screen->pixels();
        int count = 0;
        for (int y = place.y; y < place.y + place.w; ++y)
            for (int x = place.x; x < place.x + place.z; ++x) {
                const glm::ivec3 p = now.at({x, y});
                count += p != before.at({x, y}) && p.x > 200 && p.y > 150 && p.y < 215 && p.z < 110;
            }
        return count;
    };
    EXPECT_TRUE(eventually([&] { return yellow() > 100; })) << yellow();
    const int all = yellow();
    const glm::ivec4 line = viewer->placeOf("path:0");
    ASSERT_GT(line.z, 0) << "rays are listed: " << viewer->output();
    click(glm::ivec2{line.x + 20, line.y + line.w / 2});
    EXPECT_TRUE(eventually([&] { return yellow() < all / 2; })) << "the others step back";
    EXPECT_GT(viewer->placeOf("step:0").z, 0) << "its steps are listed";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// Right button and W held, at the size that people have: picture follows picture, and when it is over the
// last one is as fine as its place. How coarse those between are: MovingResolution of tests/cpu.
TEST_F(ViewerTest, FliesWhileAKeyIsHeld) {
    screen = std::make_unique<VirtualScreen>(960, 540);
    for (const char* scene : {"builtin:cornell", "builtin:atrium?triangles=20000"}) {
        start(std::string("--window 960x540 --voxels 64 --mode traced --no-state ") + scene);
        viewer->send("wait 1; echo drawn");
        ASSERT_NE(viewer->expect("drawn"), "") << viewer->output();
        const glm::ivec4 full = picture();
        const std::string before = viewer->status("camera");
        moveTo(inPicture(0.5f, 0.5f));
        pass();
        screen->xdotool("mousedown 3");
        screen->xdotool("keydown w");
        // "F frames/s, longest wait MS ms, W x H pixels (N pictures in S s)"
        const auto pictures = [](const std::string& now) {
            const std::size_t bracket = now.find('(');
            return bracket == std::string::npos ? 0 : std::strtol(now.c_str() + bracket + 1, nullptr, 10);
        };
        const std::string said =
            viewer->statusUntil("moving", [&](const std::string& now) { return pictures(now) >= 12; });
        screen->xdotool("keyup w");
        screen->xdotool("mouseup 3");
        std::printf("%s: %s\n", scene, said.c_str());
        EXPECT_GE(pictures(said), 12) << scene << ": " << viewer->output();
        EXPECT_NE(viewer->status("camera"), before) << "it has flown";
        const std::string wide = std::to_string(full.z) + " x";
        EXPECT_EQ(
            viewer->statusUntil("picture", [&](const std::string& now) { return now.rfind(wide, 0) == 0; })
                .rfind(wide, 0),
            0u)
            << "at rest it is as fine as its place";
        viewer->send("quit");
        EXPECT_EQ(viewer->exitStatus(), 0);
    }
}

// Median CPU time of the panels and time to the first picture, as --timing prints them. How long they may
// take is for a quiet machine to say: the goals are 3 s and 1 ms.
TEST_F(ViewerTest, TimingSaysHowSoonItStartsAndWhatPanelsCost) {
    const auto printed = [&](const std::string& arguments, const std::string& begin) {
        start("--window 960x640 --voxels 64 --no-state --timing builtin:cornell " + arguments);
        const std::string line = viewer->expect("timing: " + begin);
        EXPECT_NE(line, "") << viewer->output();
        EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
        std::printf("%s\n", line.c_str());
        return std::strtof(line.c_str() + std::min(line.size(), line.find_first_of("0123456789")), nullptr);
    };
    EXPECT_GT(printed("--exec 'wait 1; quit'", "first frame after "), 0);
    EXPECT_GT(printed("--mode phong --exec 'wait 30; quit'", "GUI "), 0);
}

}  // namespace
}  // namespace conelight::test
