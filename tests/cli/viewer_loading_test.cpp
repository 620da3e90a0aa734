// SPDX-License-Identifier: MIT
// Scenes that the window reads in the background: the old one stays in use meanwhile, a strip says what is read
// and stops it. A file of a foreign format is read by a process of its own, which the tests hold.
#include <fstream>

#include "cli/viewer_panels_support.h"

namespace conelight::test {
namespace {

class ViewerLoadingTest : public ViewerPanelsTest {
  protected:
    // A wavy sheet, large enough that the process that reads it is seen.
    static std::string largeModel(const std::string& name) {
        constexpr int kEdge = 250;
        const std::string file = scratchPath(name);
        std::ofstream out(file);
        for (int y = 0; y < kEdge; ++y)
            for (int x = 0; x < kEdge; ++x)
                out << "v " << x << " " << (x * 7 + y * 3) % 11 << " " << y << "\n";
        for (int y = 1; y < kEdge; ++y)
            for (int x = 1; x < kEdge; ++x) {
                const int corner = y * kEdge + x + 1;
                out << "f " << corner << " " << corner - 1 << " " << corner - kEdge - 1 << " "
                    << corner - kEdge << "\n";
            }
        return file;
    }
    // Turns the view with the mouse, without a command between, until the picture is another.
    bool turnsTheView(const glm::ivec4& place) {
        const ScreenPixels before = screen->pixels();
        glm::ivec2 at = glm::ivec2(place) + glm::ivec2(place.z, place.w) / 2;
        moveTo(at);
        screen->xdotool("mousedown 1");
        const bool turned = eventually([&] {
            at.x = at.x > place.x + place.z - 60 ? place.x + 60 : at.x + 20;
            moveTo(at);
            return screen->pixels().changedFrom(before, place, 20) > place.z * place.w / 10;
        });
        screen->xdotool("mouseup 1");
        return turned;
    }
};

TEST_F(ViewerLoadingTest, TheOldSceneStaysInUseUntilTheNewOneIsThere) {
    const std::string model = largeModel("viewer_loading.obj");
    start(kSmall + "--gl-debug builtin:cornell");
    settle();
    const glm::ivec4 place = picture();
    const std::string camera = viewer->status("camera");
    // Held: the view turns, the strip is there, Escape ends it.
    viewer->send("open '" + model + "'; echo went on");
    ASSERT_TRUE(viewer->holdChild()) << viewer->output();
    EXPECT_TRUE(stripShown(place));
    EXPECT_TRUE(turnsTheView(place));
    EXPECT_EQ(viewer->output().find("went on"), std::string::npos) << "commands wait";
    screen->xdotool("key Escape");
    EXPECT_NE(viewer->expect("viewer_loading.obj: stopped; nothing is loaded"), "") << viewer->output();
    EXPECT_NE(viewer->expect("went on"), "");
    EXPECT_EQ(viewer->status("scene"), "builtin:cornell");
    EXPECT_NE(viewer->status("camera"), camera);
    EXPECT_EQ(viewer->output().find("loaded"), viewer->output().find("loaded\n")) << viewer->output();

    // By the button; then to its end.
    viewer->send("open '" + model + "'; echo went on again");
    ASSERT_TRUE(viewer->holdChild());
    pressStop(place);
    EXPECT_NE(viewer->expect("viewer_loading.obj: stopped; nothing is loaded"), "") << viewer->output();
    EXPECT_NE(viewer->expect("went on again"), "");
    viewer->send("open '" + model + "'; echo has it");
    ASSERT_TRUE(viewer->holdChild());
    viewer->releaseChild();
    EXPECT_NE(viewer->expect("loaded " + model), "") << viewer->output();
    EXPECT_NE(viewer->expect("has it"), "");
    EXPECT_EQ(viewer->status("scene"), model);
    viewer->send("open nowhere.obj; echo behind");
    EXPECT_NE(viewer->expect("nowhere.obj: no such file"), "");
    EXPECT_NE(viewer->expect("behind"), "");
    EXPECT_EQ(viewer->status("scene"), model) << "what fails leaves the old scene";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    EXPECT_EQ(viewer->output().find("OpenGL: "), std::string::npos) << viewer->output();
}

// What was changed while another scene was read is not lost without a question.
TEST_F(ViewerLoadingTest, ChangesMadeMeanwhileAreAskedAbout) {
    const std::string model = largeModel("viewer_loading_changed.obj");
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("select 'short block'");
    const glm::ivec4 place = picture();
    const glm::ivec2 middle = glm::ivec2(place) + glm::ivec2(place.z, place.w) / 2;
    moveTo(middle);
    pass();
    viewer->send("open '" + model + "'");
    ASSERT_TRUE(viewer->holdChild()) << viewer->output();
    const ScreenPixels before = screen->pixels();
    screen->xdotool("key Delete");
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(before, place, 20) > 300; }));
    viewer->releaseChild();
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("unsaved:stay").z > 0; })) << viewer->output();
    EXPECT_EQ(viewer->status("scene"), "builtin:cornell");
    click("unsaved:stay");
    EXPECT_EQ(viewer->status("scene"), "builtin:cornell");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// A file that is added is read in the background, too; commands wait, the view turns, the button ends it.
TEST_F(ViewerLoadingTest, AFileThatIsAddedIsReadInTheBackground) {
    const std::string model = largeModel("viewer_import.obj");
    start(kSmall + "builtin:cornell");
    settle();
    const glm::ivec4 place = picture();
    viewer->send("import '" + model + "'; echo went on");
    ASSERT_TRUE(viewer->holdChild()) << viewer->output();
    EXPECT_TRUE(turnsTheView(place));
    EXPECT_EQ(viewer->output().find("went on"), std::string::npos) << "commands wait";
    pressStop(place);
    EXPECT_NE(viewer->expect("viewer_import.obj: stopped; nothing is loaded"), "") << viewer->output();
    EXPECT_NE(viewer->expect("went on"), "");
    EXPECT_EQ(viewer->status("selection"), "none");
    viewer->send("import '" + model + "'; echo has it");
    ASSERT_TRUE(viewer->holdChild());
    viewer->releaseChild();
    EXPECT_NE(viewer->expect("imported " + model + ": 1 object, 0 lights"), "") << viewer->output();
    EXPECT_NE(viewer->expect("has it"), "");
    EXPECT_EQ(viewer->status("scene"), "builtin:cornell");
    EXPECT_NE(viewer->status("selection"), "none");
    viewer->send("import nowhere.obj; echo behind");
    EXPECT_NE(viewer->expect("nowhere.obj: no such file"), "");
    EXPECT_NE(viewer->expect("behind"), "");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// What the first picture is at is told; stopped, the window answers, and draws when something changes. Each program takes the
// driver a while that has none of them.
TEST_F(ViewerLoadingTest, TheFirstPictureSaysWhatItIsAtAndIsStopped) {
    start("--window 720x480 --voxels 32 --mode traced --no-state builtin:cornell",
          "MESA_SHADER_CACHE_DISABLE=true");
    const auto works = [&](const std::string& part) {
        return viewer
                   ->statusUntil("work",
                                 [&](const std::string& now) { return now.find(part) != std::string::npos; })
                   .find(part) != std::string::npos;
    };
    EXPECT_TRUE(works("building programs, ")) << viewer->output();
    EXPECT_TRUE(lettersShown("work:stop"));
    click("work:stop");
    EXPECT_EQ(viewer->status("work"), "stopped");
    EXPECT_EQ(viewer->status("frames").rfind("0 pictures", 0), 0u) << viewer->status("frames");
    EXPECT_EQ(viewer->placeOf("work:stop").z, 0);
    click("work:go on");
    const auto goesOn = [](const std::string& now) { return now != "stopped"; };
    EXPECT_TRUE(goesOn(viewer->statusUntil("work", goesOn)));
    screen->xdotool("mousemove 300 200 key Escape");
    EXPECT_TRUE(works("stopped"));
    viewer->send("settle; echo ends");
    EXPECT_NE(viewer->expect("ends"), "") << "nothing is waited for";
    viewer->send("mode phong; set image.temporal off; settle; echo drawn");
    EXPECT_NE(viewer->expect("drawn"), "") << viewer->output();
    EXPECT_NE(viewer->status("frames").rfind("0 pictures", 0), 0u);
    EXPECT_EQ(viewer->status("work"), "none");
    EXPECT_EQ(viewer->placeOf("work:go on").z, 0);
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

// The window is there at once and says what it reads; stopped, it is an empty one.
TEST_F(ViewerLoadingTest, AStartShowsTheWindowAtOnce) {
    const std::string model = largeModel("viewer_loading_start.obj");
    start("--window 720x480 --no-state " + kCheap + "'" + model + "'");
    ASSERT_TRUE(viewer->holdChild()) << viewer->output();
    const glm::ivec4 window(0, 0, 720, 480);
    EXPECT_TRUE(eventually([&] { return textShown(screen->pixels(), window); }));
    screen->xdotool("mousemove 300 200 key Escape");
    EXPECT_NE(viewer->expect("viewer_loading_start.obj: stopped; nothing is loaded"), "") << viewer->output();
    EXPECT_EQ(viewer->status("scene"), "");
    viewer->send("open builtin:cornell; mode phong; settle; echo opened");
    EXPECT_NE(viewer->expect("opened"), "") << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

}  // namespace
}  // namespace conelight::test
