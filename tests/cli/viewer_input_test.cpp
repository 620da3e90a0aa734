// SPDX-License-Identifier: MIT
// The viewer while it is busy: it says what it loads, keeps clicks that come meanwhile, is coarse while a
// handle is dragged, and says how far a picture is. What a click found goes away again.
#include <chrono>
#include <thread>

#include "cli/viewer_panels_support.h"

namespace conelight::test {
namespace {

class ViewerInputTest : public ViewerPanelsTest {
  protected:
    // Pixels of the picture in the rays' yellow that were not there.
    int yellow(const ScreenPixels& before, const glm::ivec4& place) {
        const ScreenPixels now = screen->pixels();
        int count = 0;
        for (int y = place.y; y < place.y + place.w; ++y)
            for (int x = place.x; x < place.x + place.z; ++x) {
                const glm::ivec3 p = now.at({x, y});
                count += p != before.at({x, y}) && p.x > 200 && p.y > 150 && p.y < 215 && p.z < 110;
            }
        return count;
    }
};

// Escape, a word, a button and every change of the scene take the rays off the picture; the sky has none.
TEST_F(ViewerInputTest, WhatAClickFoundGoesAway) {
    screen = std::make_unique<VirtualScreen>(960, 960);
    start("--size 960x960 --voxels 32 --mode traced --no-state --exec 'resolution 0.25' builtin:cornell");
    settle();
    EXPECT_EQ(viewer->status("window").rfind("960 x 960,", 0), 0u) << "--size is the window's";
    const glm::ivec4 place = picture();
    const ScreenPixels before = screen->pixels();
    const auto shows = [&] { return eventually([&] { return yellow(before, place) > 100; }); };
    const auto gone = [&] { return eventually([&] { return yellow(before, place) == 0; }); };
    click(inPicture(0.62f, 0.72f));
    EXPECT_TRUE(shows());
    EXPECT_GT(viewer->placeOf("path:0").z, 0);
    moveTo(inPicture(0.5f, 0.95f));
    screen->xdotool("key Escape");
    EXPECT_TRUE(gone());
    EXPECT_EQ(viewer->placeOf("path:0").z, 0) << "nor are they listed";
    EXPECT_NE(viewer->status("selection"), "none");
    screen->xdotool("key Escape");
    EXPECT_EQ(viewer->statusUntil("selection", [](const std::string& now) { return now == "none"; }), "none");

    viewer->send("pick 0.62 0.72; select none");
    EXPECT_TRUE(shows());
    viewer->send("pick");
    EXPECT_TRUE(gone());
    viewer->send("pick 0.62 0.72");
    EXPECT_TRUE(shows());
    click("inspector:clear");
    EXPECT_TRUE(gone());

    viewer->send("pick 0.62 0.72");
    EXPECT_TRUE(shows());
    viewer->send("set image.exposure 0.1");
    pass();
    EXPECT_NE(viewer->status("pixel"), "none") << "the look changes no ray";
    viewer->send("undo; material white color 0.4 0.5 0.6");
    EXPECT_EQ(viewer->statusUntil("pixel", [](const std::string& now) { return now == "none"; }), "none");
    viewer->send("undo; camera eye 0 0.5 6; settle; pick 0.02 0.5");
    EXPECT_NE(viewer->status("pixel").find("(sky)"), std::string::npos) << viewer->status("pixel");
    EXPECT_EQ(viewer->placeOf("path:0").z, 0) << "nothing gathers there";
    viewer->send("pick 0.5");
    EXPECT_NE(viewer->expect("pick: Y is missing"), "") << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Before work that holds the window a frame says what it is: at the start, and when another scene is opened,
// whose lists do not stand beside the old picture.
TEST_F(ViewerInputTest, SaysWhatItLoads) {
    start(
        "--size 900x600 --voxels 32 --mode traced --no-state --exec 'resolution 0.25' "
        "'builtin:atrium?triangles=20000'");
    const glm::ivec4 window(0, 0, 900, 600);
    EXPECT_TRUE(eventually([&] { return textShown(screen->pixels(), window); })) << "at the start";
    viewer->send("wait 1; echo drawn");
    ASSERT_NE(viewer->expect("drawn"), "") << viewer->output();
    const glm::ivec4 place = picture();
    const glm::ivec2 corner = glm::ivec2(place) + glm::ivec2(12, place.w - 12);
    EXPECT_TRUE(eventually([&] { return !textShown(screen->pixels(), place); })) << "and then no more";
    const glm::vec3 ground(33);  // of a window without a picture
    EXPECT_FALSE(near(shownAt(corner), ground, 4));
    viewer->send("open builtin:study; wait 1; echo loaded it");
    EXPECT_TRUE(eventually([&] {
        const ScreenPixels now = screen->pixels();
        return textShown(now, place) && near(now.mean(corner - 2, {5, 5}), ground, 2);
    })) << "the old picture is gone while the new one is made";
    ASSERT_NE(viewer->expect("loaded it"), "") << viewer->output();
    EXPECT_TRUE(eventually([&] { return !textShown(screen->pixels(), place); }));
    viewer->send("open nowhere.glb");
    EXPECT_NE(viewer->expect("nowhere.glb"), "");
    pass();
    EXPECT_TRUE(eventually([&] { return !textShown(screen->pixels(), place); })) << "what fails is over";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// What comes while a picture is drawn reaches the window at once when it looks again.
TEST_F(ViewerInputTest, ClicksWhileItIsBusyAreKept) {
    start(kSmall + "builtin:cornell");
    settle();
    const glm::ivec2 block = inPicture(0.6f, 0.75f), wall = inPicture(0.05f, 0.5f);
    moveTo(wall);
    pass();
    viewer->pause();
    screen->xdotool(moving(block) + " click 1 " + moving(wall));
    viewer->resume();
    EXPECT_NE(viewer
                  ->statusUntil("selection",
                                [](const std::string& now) { return now.find("short") != std::string::npos; })
                  .find("short block"),
              std::string::npos)
        << "what was under the cursor then";
    const std::string camera = viewer->status("camera");
    viewer->pause();
    screen->xdotool(moving(wall) + " mousedown 1 " + moving(block) + " mouseup 1");
    viewer->resume();
    pass();
    pass();
    EXPECT_NE(viewer->status("selection").find("short block"), std::string::npos) << "a drag is no click";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Keys are taken in their order, each where the ones before it have led: lines one after the other, also the
// same key twice; Escape ends what the line before it has started.
TEST_F(ViewerInputTest, LinesWhileItIsBusyAreKept) {
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("path add; camera orbit 40; path add");
    click("console");
    viewer->pause();
    screen->xdotool("type 'echo one'");
    screen->xdotool("key Return");
    screen->xdotool("type 'echo twoo'");
    screen->xdotool("key BackSpace key Return key Up key Up key Return");
    viewer->resume();
    for (const char* line : {"one", "two", "one"}) EXPECT_EQ(viewer->expect(line), line) << viewer->output();
    viewer->pause();
    screen->xdotool("type 'path play 3000'");
    screen->xdotool("key Return key Escape");
    screen->xdotool("type 'echo behind'");
    screen->xdotool("key Return");
    viewer->resume();
    EXPECT_EQ(viewer->expect("behind"), "behind") << viewer->output();
    EXPECT_EQ(viewer->status("path"), "2 keys, 1 s") << "it does not play";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// A click and what is typed behind it, in one frame: the text is the clicked field's, not keys of the window; and a click
// behind a line does not come before it.
TEST_F(ViewerInputTest, ClicksAndKeysKeepTheirOrder) {
    start(kSmall + "builtin:cornell");
    settle();
    const glm::ivec2 console = viewer->middleOf("console"), wall = inPicture(0.05f, 0.5f);
    const auto clickOn = [](const glm::ivec2& p) { return moving(p) + " click 1"; };
    moveTo(wall);
    pass();
    viewer->pause();
    screen->xdotool(clickOn(console) + " type 'echo first'");
    screen->xdotool("key Return");
    screen->xdotool("type 'echo second'");
    screen->xdotool("key Return " + clickOn(wall));
    viewer->resume();
    for (int i = 0; i < 20; ++i) pass();
    viewer->send("echo afterwards");
    viewer->expect("afterwards");
    for (const char* line : {"first\n", "second\n"})
        EXPECT_NE(viewer->output().find(line), std::string::npos) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Not only its first picture.
TEST_F(ViewerInputTest, HandlesAreDraggedAtTheResolutionOfMovement) {
    start("--size 900x600 --voxels 64 --mode traced --no-state builtin:cornell");
    viewer->send("camera orbit 30 20; select 'short block'; wait 1; echo drawn");
    ASSERT_NE(viewer->expect("drawn"), "") << viewer->output();
    const auto fine = [&] {
        const std::string now = viewer->status("picture");  // "W x H of W x H pixels, ..."
        const std::size_t of = now.find(" of ");
        return now.compare(of + 4, of, now, 0, of) == 0;
    };
    EXPECT_TRUE(fine()) << viewer->status("picture");
    const glm::ivec2 from = viewer->middleOf("gizmo:x");
    ASSERT_GT(from.x, 0);
    moveTo(from);
    pass();
    screen->xdotool("mousedown 1");
    int moves = 0;
    const auto fineAfterAMove = [&] {
        moveTo(from + glm::ivec2(++moves % 20, 0));
        return fine();
    };
    // The window takes the button when it looks at input next, and shows a picture when there is one.
    ASSERT_TRUE(eventually([&] { return !fineAfterAMove(); })) << viewer->status("picture");
    int between = 0;
    for (int i = 0; i < 40; ++i) between += fineAfterAMove();
    EXPECT_EQ(between, 0) << "pictures at full resolution in the midst of the drag";
    // A hand that rests on the handle for longer than a picture at rest waits for.
    for (int i = 0; i < 20; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        between += fine();
    }
    EXPECT_EQ(between, 0) << "it is held still";
    screen->xdotool("mouseup 1");
    EXPECT_TRUE(eventually(fine)) << "at rest it is as fine as its place";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Down, along and up while a picture is drawn: what was held lies where it was let go, by one step of undo; a click on a
// handle is none.
TEST_F(ViewerInputTest, HandlesFollowToWhereTheyAreLetGo) {
    start(kSmall + "builtin:cornell");
    viewer->send("camera orbit 30 20; select 'short block'");
    settle();
    const glm::ivec2 from = viewer->middleOf("gizmo:x"), to = from + glm::ivec2(25, 0);
    ASSERT_GT(from.x, 0);
    const std::string before = viewer->status("selection"), steps = viewer->status("steps");
    moveTo(from);
    pass();
    viewer->pause();
    screen->xdotool("mousedown 1 mouseup 1");
    viewer->resume();
    pass();
    EXPECT_EQ(viewer->status("selection"), before);
    EXPECT_EQ(viewer->status("steps"), steps);
    viewer->pause();
    screen->xdotool("mousedown 1 " + moving(to) + " mouseup 1");
    viewer->resume();
    EXPECT_NE(viewer->statusUntil("selection", [&](const std::string& now) { return now != before; }),
              before);
    viewer->send("undo");
    EXPECT_EQ(viewer->status("selection"), before) << "one step";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerInputTest, SaysHowFarThePictureIs) {
    start("--size 720x480 --voxels 32 --mode traced --no-state --exec 'resolution 0.25' builtin:cornell");
    const auto mode = [&](const std::string& part) {
        const std::string now = viewer->statusUntil(
            "mode", [&](const std::string& text) { return text.find(part) != std::string::npos; });
        EXPECT_NE(now.find(part), std::string::npos) << now;
        return now;
    };
    mode("traced  pass ");
    const std::string refined = mode(" of 24  noise ");
    settle();
    const std::string done = mode("  done");
    EXPECT_EQ(done.rfind("traced  noise ", 0), 0u) << done;
    const float noise = std::strtof(done.c_str() + 14, nullptr);
    EXPECT_GT(noise, 0);
    EXPECT_LT(noise, 5) << "percent, of a closed room";
    viewer->send("camera orbit 5 0");
    mode("pass ");
    settle();
    mode("  done");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

}  // namespace
}  // namespace conelight::test
