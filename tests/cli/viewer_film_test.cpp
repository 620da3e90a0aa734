// SPDX-License-Identifier: MIT
// Key frames and films in the viewer's window: paths kept and played, films of every kind of mode, waits
// ended by hand.
#include <cstdio>
#include <filesystem>

#include "cli/viewer_panels_support.h"
#include "io/image_file.h"
#include "support/moving_scene.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

TEST_F(ViewerPanelsTest, KeyFramesAreKeptPlayedSavedAndRecorded) {
    const std::string folder = freshFolder("path");
    start(kSmall + "builtin:cornell");
    settle();
    const std::string first = viewer->status("camera");
    click("header:Camera");
    click("path:add");
    EXPECT_EQ(viewer->status("path"), "1 keys, 0 s");
    viewer->send("camera orbit 40");
    const std::string second = viewer->status("camera");
    click("path:add");
    EXPECT_EQ(viewer->status("path"), "2 keys, 1 s");
    click("key:0");
    EXPECT_EQ(viewer->status("camera"), first) << "a click on a key goes there";

    settle();
    ScreenPixels last = screen->pixels();
    const glm::ivec4 place = picture();
    click("path:play");  // commands wait until it has arrived
    EXPECT_EQ(viewer->status("camera"), second);
    settle();
    EXPECT_GT(screen->pixels().changedFrom(last, place, 12), place.z * place.w / 10);

    click("path:save");
    name(folder + "/way.json");
    EXPECT_TRUE(heard("saved " + folder)) << viewer->output();
    click("path:clear");
    EXPECT_EQ(viewer->status("path"), "0 keys, 0 s");
    click("path:load");
    type(folder + "/way.json", viewer->placeOf("dialog:name"));
    screen->xdotool("key Return");
    EXPECT_TRUE(heard("2 keys, 1 s")) << viewer->output();
    EXPECT_EQ(viewer->status("path"), "2 keys, 1 s");

    // A film: the window shows how far it is and can end it; what was asked for behind it comes then.
    viewer->send("camera orbit 5");
    const std::string before = viewer->status("camera");
    click("path:record");
    type(folder + "/frame%03d.png", viewer->placeOf("dialog:name"));
    moveTo(viewer->middleOf("dialog:take"));
    pass();
    screen->xdotool("mousedown 1");
    pass();
    screen->xdotool("mouseup 1");  // from here on commands wait for the film
    EXPECT_TRUE(eventually([&] { return fs::exists(folder + "/frame003.png"); })) << viewer->output();
    pressStop(place);
    EXPECT_TRUE(heard("record: stopped at frame")) << viewer->output();
    EXPECT_EQ(viewer->status("camera"), before) << "it is where it was";
    EXPECT_FALSE(fs::exists(folder + "/frame119.png"));
    viewer->send("record " + folder + "/turn%d.png 3 turntable; echo behind");
    EXPECT_TRUE(heard("written " + folder + "/turn%d.png (3 frames)")) << viewer->output();
    EXPECT_TRUE(heard("behind"));
    EXPECT_EQ(viewer->status("camera"), before);
    EXPECT_NE(bytesOf(folder + "/turn0.png"), bytesOf(folder + "/turn1.png"));
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// What is waited for can be ended by whoever sits in front of it; a script's commands wait.
TEST_F(ViewerPanelsTest, WaitsAreEndedByHand) {
    const std::string folder = freshFolder("stop");
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("path add; camera orbit 40; path add");
    const glm::ivec4 box = viewer->placeOf("console");
    click("console");
    const auto enter = [&](const std::string& line) {
        type(line, box);
        screen->xdotool("key Return");
    };
    // Of 3,000 s: who waits for the end of it does not get an answer.
    enter("path play 3000");
    enter("path stop");
    EXPECT_EQ(viewer->status("path"), "2 keys, 1 s");
    enter("path play 3000");
    screen->xdotool("key Escape");
    EXPECT_EQ(viewer->status("path"), "2 keys, 1 s");
    // The line still has the keys; what is queued goes on.
    enter("path play 3000; echo behind");
    enter("stop");
    EXPECT_TRUE(heard("stopped\nbehind")) << viewer->output();
    enter("record " + folder + "/%d.png 99999 path");
    EXPECT_TRUE(eventually([&] { return fs::exists(folder + "/1.png"); })) << viewer->output();
    enter("stop");
    EXPECT_TRUE(heard("record: stopped at frame")) << viewer->output();
    enter("stop");
    EXPECT_TRUE(heard("stop: nothing is waited for")) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

TEST_F(ViewerPanelsTest, ClipsPlayHoldAndEndWithTheirObjects) {
    start("--window 900x700 --no-state " + kCheap + "'" + risingBlock("viewer_rise.gltf") + "'");
    settle();
    EXPECT_NE(answer("clip", "  0 rise").find("1 s"), std::string::npos);
    click("clip:play");
    EXPECT_NE(answer("clip", "  0 rise").find("playing"), std::string::npos);
    click("clip:play");
    EXPECT_EQ(answer("clip", "  0 rise").find("playing"), std::string::npos);
    click("clip:time");  // its middle
    EXPECT_TRUE(eventually([&] { return answer("clip", "  0 rise").find("at 0.5") != std::string::npos; }));
    click("clip:rest");
    EXPECT_TRUE(eventually([&] { return answer("clip", "  0 rise").find("at ") == std::string::npos; }));
    viewer->send("clip play");
    viewer->send("delete 'tall block'");
    EXPECT_GT(viewer->placeOf("clip:unfit").z, 0);
    viewer->send("clip play");
    EXPECT_TRUE(heard("objects were added or removed")) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// They are those of the program without a window, bit for bit.
TEST_F(ViewerPanelsTest, FilmsOfThePathTracerAreDrawnInTheWindow) {
    const std::string folder = freshFolder("cpu_film"), way = folder + "/way.json";
    start("--window 720x600 --no-state " + kCheap + "--spp 2 builtin:cornell");
    settle();
    viewer->send("path add; camera orbit 30; path add; path save " + way);
    const std::string picture = viewer->status("picture");
    int width = 0, height = 0;
    ASSERT_EQ(std::sscanf(picture.c_str(), "%*d x %*d of %d x %d", &width, &height), 2) << picture;
    viewer->send("mode reference; record " + folder + "/window%d.exr 2 path");
    EXPECT_TRUE(heard("written " + folder + "/window%d.exr (2 frames)")) << viewer->output();
    const CommandResult alone =
        conelight("render builtin:cornell --mode reference --filter center --spp 2 --path " + way +
                  " --frames 2 --size " + std::to_string(width / 2 * 2) + "x" +
                  std::to_string(height / 2 * 2) + " -o " + folder + "/alone%d.exr");
    EXPECT_EQ(alone.status, 0) << alone.output;
    for (const char* frame : {"0", "1"}) {
        const std::vector<float> drawn = pixelsOf(folder + "/window" + frame + ".exr");
        EXPECT_FALSE(drawn.empty());
        EXPECT_TRUE(drawn == pixelsOf(folder + "/alone" + frame + ".exr")) << frame;
    }
    EXPECT_NE(bytesOf(folder + "/window0.exr"), bytesOf(folder + "/window1.exr"));
    click("header:Camera");
    EXPECT_GT(viewer->placeOf("film samples").z, 0);
    // The strip stops one within a frame.
    const glm::ivec4 place = viewer->placeOf("picture");
    viewer->send("record " + folder + "/%d.png 99999 turntable");
    pressStop(place);
    EXPECT_TRUE(heard("record: stopped at frame")) << viewer->output();
    EXPECT_FALSE(fs::exists(folder + "/99998.png"));
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// A film of mode radiosity waits for the bake: none of its frames is a picture without bounced light.
TEST_F(ViewerPanelsTest, FilmsOfRadiosityBeginWhenItIsBaked) {
    const std::string folder = freshFolder("baked_film");
    start("--window 720x480 --no-state " + kCheap +
          "--patch 0.25 --subdivide 0 --gather-rays 64 "
          "builtin:cornell");
    settle();
    const auto film = [&](const std::string& mode) {
        viewer->send("mode " + mode + "; record " + folder + "/" + mode + "%d.exr 2 turntable");
        EXPECT_TRUE(heard("written " + folder + "/" + mode + "%d.exr (2 frames)")) << viewer->output();
    };
    film("phong");
    film("radiosity");
    const auto sum = [&](const std::string& frame) {
        double all = 0;
        for (const float value : io::readExr(folder + "/" + frame + ".exr").pixels) all += double(value);
        return all;
    };
    for (const char* frame : {"0", "1"})
        EXPECT_GT(sum(std::string("radiosity") + frame), 1.1 * sum(std::string("phong") + frame)) << frame;
    EXPECT_NE(bytesOf(folder + "/radiosity0.exr"), bytesOf(folder + "/radiosity1.exr"));
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

}  // namespace
}  // namespace conelight::test
