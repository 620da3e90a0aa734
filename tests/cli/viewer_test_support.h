// SPDX-License-Identifier: MIT
// Fixture of tests of the viewer's window: mouse and keys as a hand moves them, places and states by its
// console, the screen's pixels. Everything waits for a condition.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "support/virtual_screen.h"

namespace conelight::test {

inline constexpr glm::ivec2 kScreen(960, 640);
// A cheap picture, finished with its first pass, and a small window: what is tested is the window.
inline const std::string kCheap = "--voxels 32 --mode phong --set image.temporal=off ";
inline const std::string kSmall = "--window 720x480 --no-state " + kCheap;

inline bool near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    return glm::all(glm::lessThan(glm::abs(a - b), glm::vec3(tolerance)));
}

class ViewerTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const std::string missing = VirtualScreen::missing(); !missing.empty()) GTEST_SKIP() << missing;
        screen = std::make_unique<VirtualScreen>(kScreen.x, kScreen.y);
    }
    void start(const std::string& arguments, const std::string& environment = "") {
        viewer = std::make_unique<ViewerProcess>(*screen, arguments, environment);
    }
    // Until the window has looked at input that came before and has drawn what follows from it: an answer
    // comes between the two.
    void pass() {
        for (int i = 0; i < 3; ++i) viewer->status("frames");
    }
    // What xdotool is told.
    static std::string moving(const glm::ivec2& p) {
        return "mousemove " + std::to_string(p.x) + " " + std::to_string(p.y);
    }
    void moveTo(const glm::ivec2& p) { screen->xdotool(moving(p)); }
    // In steps, as a hand does: a window that looks once a frame must see the button go down first.
    void drag(int button, const glm::ivec2& from, const glm::ivec2& to) {
        moveTo(from);
        pass();
        screen->xdotool("mousedown " + std::to_string(button));
        for (int i = 1; i <= 4; ++i) {
            pass();
            moveTo(from + (to - from) * i / 4);
        }
        pass();
        screen->xdotool("mouseup " + std::to_string(button));
        pass();
    }
    void click(const glm::ivec2& p) {
        moveTo(p);
        pass();
        screen->xdotool("mousedown 1");
        pass();
        screen->xdotool("mouseup 1");
        pass();
    }
    // Where the widget is once it is there and stays: a window that opens finds its size and place over some frames.
    glm::ivec4 restingPlace(const std::string& widget) {
        glm::ivec4 place(0);
        (void)eventually([&] {
            const glm::ivec4 before = viewer->placeOf(widget);
            pass();
            place = viewer->placeOf(widget);
            return place.z > 0 && place == before;
        });
        return place;
    }
    void click(const std::string& widget) {
        const glm::ivec4 place = restingPlace(widget);
        ASSERT_GT(place.z, 0) << widget << ": " << viewer->output();
        click(glm::ivec2(place) + glm::ivec2(place.z, place.w) / 2);
    }
    // Until nothing changes in the box (x y width height) any more, looked at so many times after `looks` said so.
    bool rests(const glm::ivec4& box, int times, const std::function<bool()>& looks) {
        int still = 0;
        ScreenPixels rest = screen->pixels();
        return eventually([&] {
            if (!looks()) return false;
            const ScreenPixels now = screen->pixels();
            const bool same = now.changedFrom(rest, box) <= 2 * box.w;  // a cursor blinks
            still = same ? still + 1 : 0;
            if (!same) rest = now;
            return still == times;
        });
    }
    // As by someone who looks at the screen: waits until all of it stands in the box, that is, nothing changes there any
    // more while the program draws or waits for input. Commands may be waiting.
    void type(const std::string& text, const glm::ivec4& box) {
        screen->xdotool("type --delay 30 '" + text + "'");
        double cpuMs = viewer->cpuMs();
        EXPECT_TRUE(rests(box, 5, [&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            // 50 ms of its own time are a frame or more, chosen for the small window.
            if (!viewer->waits() && viewer->cpuMs() < cpuMs + 50) return false;
            cpuMs = viewer->cpuMs();
            return true;
        })) << text;
    }
    // The same where no command is waiting: frames are counted, of which a letter takes up to two, however slow they are.
    void typeByFrames(const std::string& text, const glm::ivec4& box) {
        screen->xdotool("type --delay 30 '" + text + "'");
        EXPECT_TRUE(rests(box, 2, [&] { return pass(), true; })) << text;
    }
    // Drags with the left button from a widget's left part, without commands between, which would end the
    // step of undo: each step is waited for on the screen.
    void dragWidget(const std::string& widget, const glm::vec2& from, const glm::ivec2& by) {
        const glm::ivec4 place = viewer->placeOf(widget);
        ASSERT_GT(place.z, 0) << widget << ": " << viewer->output();
        const glm::ivec2 at = glm::ivec2(place) + glm::ivec2(from * glm::vec2(place.z, place.w));
        moveTo(at);
        pass();
        const auto step = [&](const std::string& action) {
            const ScreenPixels last = screen->pixels();
            screen->xdotool(action);
            EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(last, place) > 0; }))
                << widget << ": " << action;
        };
        step("mousedown 1");
        for (int i = 1; i <= 3; ++i) {
            const glm::ivec2 to = at + by * i / 3;
            step("mousemove " + std::to_string(to.x) + " " + std::to_string(to.y));
        }
        screen->xdotool("mouseup 1");
        pass();
    }
    // The button at the end of the strip that says how far a bake or film is, in a picture there: `where`
    // cannot be asked meanwhile. Heights of text are 14 pixels.
    static glm::ivec2 stopAt(const glm::ivec4& place) {
        const float em = 14, strip = std::min(36 * em, static_cast<float>(place.z) - em);
        return glm::ivec2(place) + glm::ivec2(0.5f * em + strip - 2.5f * em, place.w - 1.6f * em);
    }
    // Of the button, beside its text.
    bool stopLooks(const glm::ivec4& place, float grey) {
        return near(glm::vec3(screen->pixels().at(stopAt(place) + glm::ivec2(-20, 6))), glm::vec3(grey), 3);
    }
    bool stripShown(const glm::ivec4& place) {
        return eventually([&] { return stopLooks(place, 54) || stopLooks(place, 69); });
    }
    void pressStop(const glm::ivec4& place) {
        EXPECT_TRUE(stripShown(place));
        moveTo(stopAt(place));
        EXPECT_TRUE(eventually([&] { return stopLooks(place, 69); })) << "the button is under the cursor";
        screen->xdotool("mousedown 1");
        EXPECT_TRUE(eventually([&] { return !stopLooks(place, 69); }));
        screen->xdotool("mouseup 1");
    }
    // The picture's place on the screen.
    glm::ivec4 picture() { return viewer->placeOf("picture"); }
    glm::ivec2 inPicture(float x, float y) {
        const glm::ivec4 place = picture();
        return glm::ivec2(place) + glm::ivec2(glm::vec2(place.z, place.w) * glm::vec2(x, y));
    }
    // Mean of a few pixels of the screen there.
    glm::vec3 shownAt(const glm::ivec2& p) { return screen->pixels().mean(p - 2, {5, 5}); }
    void settle() {
        viewer->send("settle; echo settled");
        ASSERT_NE(viewer->expect("settled"), "") << viewer->output();
    }

    std::unique_ptr<VirtualScreen> screen;
    std::unique_ptr<ViewerProcess> viewer;
};

}  // namespace conelight::test
