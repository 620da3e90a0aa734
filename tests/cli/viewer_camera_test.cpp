// SPDX-License-Identifier: MIT
// What the viewer lays over the picture for measure and direction, the headlight, the turntable and the strip of key
// frames: by mouse and keys, and by pixels of the screen.
#include <cmath>
#include <filesystem>

#include "cli/viewer_panels_support.h"

namespace conelight::test {
namespace {

class ViewerCameraTest : public ViewerPanelsTest {
  protected:
    // Part of the pixels of a box, in parts of the picture, that are others than before.
    double changedPart(const ScreenPixels& before, const glm::vec2& low, const glm::vec2& high) {
        const glm::ivec2 from = inPicture(low.x, low.y), size = inPicture(high.x, high.y) - from;
        return double(screen->pixels().changedFrom(before, {from, size}, 4)) / double(size.x * size.y);
    }
    // Eye, target and field of view, in degrees.
    struct Seen {
        glm::vec3 eye{0}, target{0};
        float fov = 0;
        float distance() const { return glm::distance(eye, target); }
    };
    Seen camera() {
        Seen c;
        const std::string text = viewer->status("camera");
        EXPECT_EQ(std::sscanf(text.c_str(), "eye %f %f %f target %f %f %f fov %f", &c.eye.x, &c.eye.y,
                              &c.eye.z, &c.target.x, &c.target.y, &c.target.z, &c.fov),
                  7)
            << text;
        return c;
    }
    void escape() {
        moveTo(inPicture(0.5f, 0.5f));
        screen->xdotool("key Escape");
        pass();
    }
};

// The grid lies on the floor, and blocks hide it; the bar is as long as it says; the axes' ends are buttons.
TEST_F(ViewerCameraTest, GuidesLieOverThePicture) {
    start(kSmall + "builtin:cornell");
    settle();
    EXPECT_EQ(viewer->status("guides"), "off");
    moveTo(inPicture(0.5f, 0.5f));
    pass();
    const ScreenPixels before = screen->pixels();
    screen->xdotool("key g");
    const std::string said =
        viewer->statusUntil("guides", [](const std::string& now) { return now != "off"; });
    EXPECT_EQ(said, "grid 20 cm, axes, scale 20 cm");
    pass();
    EXPECT_GT(changedPart(before, {0.35f, 0.88f}, {0.6f, 0.96f}), 0.01) << "the floor";
    EXPECT_EQ(changedPart(before, {0.56f, 0.68f}, {0.68f, 0.78f}), 0) << "the short block stands before it";
    EXPECT_EQ(changedPart(before, {0.3f, 0.1f}, {0.6f, 0.3f}), 0) << "the wall behind";

    const glm::ivec4 bar = viewer->placeOf("scale"), place = picture();
    EXPECT_EQ(screen->pixels().at(glm::ivec2(bar) + glm::ivec2(bar.z / 2, bar.w / 2)), glm::ivec3(235));
    const Seen c = camera();
    const float perPixel = 2 * c.distance() * std::tan(glm::radians(0.5f * c.fov)) / float(place.w);
    EXPECT_NEAR(float(bar.z) * perPixel, 0.2f, 0.01f);

    const glm::ivec4 ball = viewer->placeOf("axis:right");
    EXPECT_TRUE(near(shownAt(glm::ivec2(ball) + glm::ivec2(ball.z / 2, 3)), {235, 80, 70}, 20)) << "x is red";
    click("axis:top");
    const Seen above = camera();
    EXPECT_GT(above.eye.y - above.target.y, 0.99f * above.distance());
    EXPECT_EQ(viewer->status("selection"), "none") << "the click was the button's";
    click("axis:front");
    EXPECT_NEAR(camera().eye.z - camera().target.z, camera().distance(), 1e-2f);

    // Each by itself, and away without a trace.
    viewer->send("guides all off; settle");
    moveTo(inPicture(0.5f, 0.5f));
    settle();
    pass();
    const ScreenPixels front = screen->pixels();
    click("menu:View");
    click("menu:Grid");
    EXPECT_EQ(viewer->status("guides").rfind("grid", 0), 0u);
    EXPECT_EQ(viewer->status("guides").find("axes"), std::string::npos);
    screen->xdotool("key g");
    viewer->statusUntil("guides", [](const std::string& now) { return now == "off"; });
    moveTo(inPicture(0.5f, 0.5f));
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(front, place) == 0; }));
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Parallel rays and back: what is at the target keeps its size; the wheel and standard views keep the projection.
TEST_F(ViewerCameraTest, OrthographicViews) {
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("camera orbit 30 20");
    const Seen first = camera();
    const auto height = [&] {
        float value = 0;
        const std::string text = viewer->status("camera");
        const std::size_t at = text.find("orthographic ");
        if (at != std::string::npos) value = std::strtof(text.c_str() + at + 13, nullptr);
        return value;
    };
    moveTo(inPicture(0.5f, 0.5f));
    pass();
    screen->xdotool("key v");
    viewer->statusUntil("camera",
                        [](const std::string& now) { return now.find("ortho") != std::string::npos; });
    const float whole = 2 * first.distance() * std::tan(glm::radians(0.5f * first.fov));
    EXPECT_NEAR(height(), whole, 1e-3f * whole);
    screen->xdotool("click 4");
    viewer->statusUntil("camera", [&](const std::string&) { return height() < 0.95f * whole; });
    EXPECT_NEAR(height(), 0.9f * whole, 2e-3f * whole);
    screen->xdotool("key KP_5");
    viewer->statusUntil("camera",
                        [](const std::string& now) { return now.find("fov") != std::string::npos; });
    EXPECT_NEAR(camera().distance(), 0.9f * first.distance(), 5e-3f * first.distance());
    EXPECT_NEAR(camera().fov, first.fov, 1e-2f);

    // From above the room's walls are lines: all along its edges the picture is that of outside.
    screen->xdotool("key v");
    click("menu:View");
    click("menu:Orthographic");
    EXPECT_EQ(height(), 0) << "the entry switches back";
    viewer->send("camera orthographic; view_from front; settle");
    settle();
    const glm::vec3 outside = shownAt(inPicture(0.01f, 0.5f));
    const float metres =
        1.0f / height() * float(picture().w) / float(picture().z);  // the room's width in the picture
    for (const float y : {0.3f, 0.45f})
        for (const float side : {-1.0f, 1.0f}) {
            const float edge = 0.5f + side * 0.5f * metres;
            EXPECT_TRUE(near(shownAt(inPicture(edge + side * 0.02f, y)), outside, 12)) << side << " " << y;
            EXPECT_FALSE(near(shownAt(inPicture(edge - side * 0.02f, y)), outside, 12))
                << "the back wall fills it, no side wall is seen: " << side << " " << y;
        }
    viewer->send("view_from top");
    const std::string above = viewer->status("camera");
    EXPECT_NE(above.find("orthographic"), std::string::npos) << above;
    Seen c;
    std::sscanf(above.c_str(), "eye %f %f %f target %f %f %f", &c.eye.x, &c.eye.y, &c.eye.z, &c.target.x,
                &c.target.y, &c.target.z);
    EXPECT_EQ(glm::vec2(c.eye.x, c.eye.z), glm::vec2(c.target.x, c.target.z)) << "straight down";
    // A click finds what parallel rays meet, off the middle too.
    viewer->send("view_from front; pick 0.35 0.3");
    EXPECT_NE(viewer->status("pixel").find("back"), std::string::npos) << viewer->status("pixel");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// What is dark is lit from the eye, without a light and without a step; a turn goes on until it is stopped.
TEST_F(ViewerCameraTest, HeadlightAndTurntable) {
    const std::string folder = freshFolder("headlight");
    start(kSmall + "--exec 'material lamp emission 0' builtin:cornell");
    settle();
    const std::string steps = viewer->status("steps");
    const glm::vec3 dark = shownAt(inPicture(0.5f, 0.3f));
    escape();
    screen->xdotool("key l");
    viewer->statusUntil("headlight", [](const std::string& now) { return now != "off"; });
    settle();
    EXPECT_TRUE(eventually([&] { return shownAt(inPicture(0.5f, 0.3f)).y > dark.y + 60; }));
    EXPECT_EQ(viewer->status("steps"), steps);
    const std::string file = folder + "/lit.gltf";
    ASSERT_NE(answer("save " + file, "saved " + file), "");
    EXPECT_EQ(bytesOf(file).find("KHR_lights_punctual"), std::string::npos) << "it is none of the scene";
    screen->xdotool("key l");
    viewer->statusUntil("headlight", [](const std::string& now) { return now == "off"; });
    settle();
    EXPECT_TRUE(eventually([&] { return near(shownAt(inPicture(0.5f, 0.3f)), dark, 2); }));

    const Seen first = camera();
    screen->xdotool("key o");
    EXPECT_EQ(viewer->statusUntil("turntable", [](const std::string& now) { return now == "turns"; }),
              "turns");
    viewer->statusUntil("camera",
                        [&](const std::string&) { return glm::distance(camera().eye, first.eye) > 0.1f; });
    screen->xdotool("key Escape");
    EXPECT_EQ(viewer->statusUntil("turntable", [](const std::string& now) { return now == "stands"; }),
              "stands");
    const Seen last = camera();
    EXPECT_EQ(last.target, first.target);
    EXPECT_NEAR(last.eye.y, first.eye.y, 2e-3f);
    EXPECT_NEAR(last.distance(), first.distance(), 5e-3f);
    viewer->send("turntable 5; wait 2; camera eye 0 0.5 2");
    EXPECT_EQ(viewer->statusUntil("turntable", [](const std::string& now) { return now == "stands"; }),
              "stands")
        << "what moves the camera ends it";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// Keys on the strip: one is moved in one step of undo, another goes; beside them the path is scrubbed.
TEST_F(ViewerCameraTest, KeysAreMovedScrubbedAndDeletedOnTheirStrip) {
    start("--window 900x600 --no-state " + kCheap + "builtin:cornell");
    settle();
    click("header:Camera");
    viewer->send("path add; camera orbit 40; path add; camera orbit 40; path add 3; path at 0");
    EXPECT_EQ(viewer->status("path"), "3 keys, 3 s");
    const Seen first = camera();
    const auto middle = [&](const std::string& widget) { return viewer->middleOf(widget); };
    const glm::ivec2 key1 = middle("key:1"), key2 = middle("key:2");
    const int perSecond = (key2.x - key1.x) / 2;
    ASSERT_GT(perSecond, 10);
    drag(1, key1, key1 + glm::ivec2(perSecond, 0));
    moveTo(inPicture(0.5f, 0.5f));
    pass();
    EXPECT_NEAR(float(middle("key:1").x), float(key1.x + perSecond), 4.0f);
    EXPECT_TRUE(near(glm::vec3(screen->pixels().at(middle("key:1"))), {70, 190, 255}, 12))
        << "it is selected";
    EXPECT_EQ(answer("path list", "  1 ").rfind("  1    2.000 s", 0), 0u) << viewer->output();
    EXPECT_EQ(answer("undo; path list", "  1 ").rfind("  1    1.000 s", 0), 0u) << "the drag was one step";

    // Half way from the first to the second.
    const glm::ivec2 between = (middle("key:0") + middle("key:1")) / 2;
    drag(1, between - glm::ivec2(8, 0), between);
    const Seen scrubbed = camera();
    EXPECT_GT(glm::distance(scrubbed.eye, first.eye), 0.1f);
    EXPECT_EQ(viewer->status("path"), "3 keys, 3 s");
    click("key:2");
    click("key:remove");
    EXPECT_EQ(viewer->status("path"), "2 keys, 1 s");
    EXPECT_NE(answer("path move 0 4", "path move: key 0 cannot be at 4 s"), "");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

}  // namespace
}  // namespace conelight::test
