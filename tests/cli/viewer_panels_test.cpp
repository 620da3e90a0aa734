// SPDX-License-Identifier: MIT
// The viewer's menus, panels and dialogs on a screen without a monitor: what they change is asked of the
// console, read from files, and seen on the screen. Films: viewer_film_test.cpp.
#include <filesystem>
#include <fstream>

#include "cli/viewer_panels_support.h"
#include "support/x11_client.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

TEST_F(ViewerPanelsTest, PresetsAreSavedAndLoadedInTheMenu) {
    const std::string file = freshFolder("presets") + "/look.json";
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("set image.exposure 1");
    click("menu:File");
    openMenu("Presets", "menu:Save settings");
    name(file);
    EXPECT_TRUE(heard("saved " + file)) << viewer->output();
    EXPECT_NE(bytesOf(file).find("image.exposure"), std::string::npos) << bytesOf(file);

    // What is there is replaced by the button that says so, not by Return alone.
    viewer->send("set image.exposure 2");
    click("menu:File");
    openMenu("Presets", "menu:Save settings");
    type(file, viewer->placeOf("dialog:name"));
    const std::string before = bytesOf(file);
    screen->xdotool("key Return");
    pass();
    EXPECT_GT(viewer->placeOf("dialog:take").z, 0) << "the dialog stays";
    EXPECT_EQ(bytesOf(file), before);
    click("dialog:take");
    EXPECT_TRUE(eventually([&] { return bytesOf(file) != before; })) << viewer->output();

    viewer->send("reset image.exposure");
    const glm::ivec2 at = inPicture(0.5f, 0.35f);
    settle();
    const glm::vec3 dark = shownAt(at);
    click("menu:File");
    openMenu("Presets", "menu:Load preset");
    type(file, viewer->placeOf("dialog:name"));
    screen->xdotool("key Return");
    EXPECT_TRUE(eventually([&] { return viewer->setting("image.exposure") == "2"; })) << viewer->output();
    settle();
    EXPECT_GT(glm::length(shownAt(at)), 1.2f * glm::length(dark));
    // One step of undo, by the menu; again by key.
    openMenu("Edit", "menu:Undo");
    EXPECT_TRUE(eventually([&] { return viewer->setting("image.exposure") == "0"; })) << viewer->output();
    screen->xdotool("key ctrl+y");
    EXPECT_TRUE(eventually([&] { return viewer->setting("image.exposure") == "2"; })) << viewer->output();
    // Escape leaves the dialog and nothing else.
    screen->xdotool("key ctrl+s");
    pass();
    EXPECT_GT(viewer->placeOf("dialog:take").z, 0) << viewer->output();
    screen->xdotool("key Escape");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("dialog:take").z == 0; })) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// Where someone looks for them who has just chosen component voxels.
TEST_F(ViewerPanelsTest, HowVoxelsAreShownStandsWithVoxels) {
    start(kSmall + "builtin:cornell");
    settle();
    click("tab:Voxels");
    for (const char* key : {"voxels.size", "view.voxels", "view.voxel_data", "view.voxel_shape"})
        EXPECT_GT(viewer->placeOf(key).z, 0) << key;
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

TEST_F(ViewerPanelsTest, ScenesAreSavedOpenedAndReloaded) {
    const std::string folder = freshFolder("scenes"), scene = folder + "/room.glb";
    start(kSmall + "builtin:cornell");
    viewer->send("material white color 0.2 0.2 0.2");
    settle();
    const glm::ivec2 at = inPicture(0.5f, 0.35f);
    const glm::vec3 grey = shownAt(at);
    screen->xdotool("key ctrl+s");
    pass();
    name(scene);
    EXPECT_TRUE(heard("saved " + scene)) << viewer->output();
    viewer->send("save " + folder + "/as_it_was.glb; undo");
    EXPECT_TRUE(heard("saved " + folder)) << viewer->output();
    settle();
    EXPECT_GT(glm::length(shownAt(at)), 1.2f * glm::length(grey));

    openMenu("File", "menu:Open");
    type(scene, viewer->placeOf("dialog:name"));
    screen->xdotool("key Return");
    pass();
    click("unsaved:lose");  // it was saved before the undo
    EXPECT_TRUE(heard("loaded " + scene)) << viewer->output();
    settle();
    EXPECT_TRUE(near(shownAt(at), grey, 4)) << "the edit was saved";

    // What another program writes is loaded again, with camera and settings as they are; what is saved from
    // here is not: undo would be lost.
    viewer->send("material white color 0.8 0.8 0.8; save " + scene + " overwrite; set image.exposure 1");
    EXPECT_TRUE(heard("saved " + scene)) << viewer->output();
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // files are looked at twice a second
    EXPECT_EQ(viewer->status("steps").substr(0, 1), "2") << viewer->output();
    const std::size_t until = viewer->output().size();
    fs::copy_file(folder + "/as_it_was.glb", scene, fs::copy_options::overwrite_existing);
    fs::last_write_time(scene, fs::file_time_type::clock::now());
    EXPECT_TRUE(eventually([&] {
        viewer->status("frames");
        return viewer->output().find("loaded " + scene, until) != std::string::npos;
    })) << viewer->output();
    EXPECT_EQ(viewer->setting("image.exposure"), "1");
    viewer->send("set image.exposure 0");
    settle();
    EXPECT_TRUE(near(shownAt(at), grey, 4)) << "as it was";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// Closing, opening another scene, and a file that changes on disk wait for an answer where changes of the
// scene would be lost.
TEST_F(ViewerPanelsTest, ChangesAreNotLostUnasked) {
    if (const std::string missing = x11Missing(); !missing.empty()) GTEST_SKIP() << missing;
    const std::string folder = freshFolder("unsaved"), scene = folder + "/room.glb",
                      kept = folder + "/kept.glb";
    start(kSmall + "builtin:cornell");
    viewer->send("save " + scene + "; load " + scene + "; set image.exposure 0.5");
    EXPECT_TRUE(heard("loaded " + scene)) << viewer->output();
    settle();
    viewer->send("material white color 0.1 0.1 0.9");
    settle();

    // The file changes: what is in the window stays.
    fs::last_write_time(scene, fs::file_time_type::clock::now() + std::chrono::seconds(2));
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("unsaved:stay").z > 0; })) << viewer->output();
    click("unsaved:stay");
    EXPECT_EQ(viewer->status("steps").substr(0, 1), "2") << viewer->output();

    ASSERT_TRUE(dropFiles(screen->display(), "Conelight", {scene}));
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("unsaved:stay").z > 0; })) << viewer->output();
    screen->xdotool("key Escape");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("unsaved:stay").z == 0; })) << viewer->output();
    EXPECT_EQ(viewer->status("steps").substr(0, 1), "2") << viewer->output();

    // Closed: the changes are saved first, and then it ends.
    pressCloseButton(screen->display(), "Conelight");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("unsaved:save").z > 0; })) << viewer->output();
    click("unsaved:save");
    pass();
    name(kept);
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    EXPECT_NE(bytesOf(kept), bytesOf(scene));
    EXPECT_FALSE(bytesOf(kept).empty());
}

TEST_F(ViewerPanelsTest, MeasuresToolTipsAndViewsOfVoxels) {
    start("--window 900x600 --no-state " + kCheap + "builtin:cornell");
    settle();
    // Times of frames and passes, memory by object.
    EXPECT_GT(viewer->placeOf("frame graph").z, 50) << viewer->output();
    EXPECT_GT(viewer->placeOf("pass:phong").z, 0) << viewer->output();
    const glm::ivec4 memory = viewer->placeOf("memory");
    const glm::ivec4 table(memory.x, memory.y + memory.w, memory.z, 60);
    const ScreenPixels closed = screen->pixels();
    click("memory");
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(closed, table, 40) > 200; })) << "lines";
    // A setting's tool tip comes up beside the cursor.
    click("tab:Image");
    const glm::ivec4 exposure = viewer->placeOf("image.exposure");
    moveTo(inPicture(0.5f, 0.9f));
    pass();
    const ScreenPixels last = screen->pixels();
    moveTo({exposure.x + exposure.z / 2, exposure.y + exposure.w / 2});
    const glm::ivec4 below(exposure.x, exposure.y + 20, 200, 80);
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(last, below, 8) > 1000; }));

    // Wheel and middle button.
    const std::string camera = viewer->status("camera");
    moveTo(inPicture(0.5f, 0.5f));
    pass();
    screen->xdotool("click 4");
    const std::string nearer =
        viewer->statusUntil("camera", [&](const std::string& now) { return now != camera; });
    EXPECT_NE(nearer, camera);
    EXPECT_EQ(nearer.substr(nearer.find("target")), camera.substr(camera.find("target")));
    drag(2, inPicture(0.5f, 0.5f), inPicture(0.6f, 0.5f));
    const std::string panned = viewer->status("camera");
    EXPECT_NE(panned.substr(panned.find("target")), camera.substr(camera.find("target")));
    viewer->send("undo; reset; camera orbit 0");

    // Each of the views of voxels is a picture of its own.
    viewer->send("mode traced; component voxels; resolution 0.25; set view.voxel_shape cubes");
    settle();
    const glm::ivec4 place = picture();
    ScreenPixels shown = screen->pixels();
    for (const char* change : {"view.voxel_data age", "view.voxel_data bricks", "view.voxel_data normal",
                               "view.voxel_level 2", "view.voxel_shape volume", "view.voxel_aperture 0.3"}) {
        viewer->send(std::string("set ") + change);
        EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(shown, place, 8) > 500; }))
            << change;
        viewer->send("wait 1; echo drawn");
        ASSERT_NE(viewer->expect("drawn"), "") << viewer->output();
        shown = screen->pixels();
    }
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// What is black says why, in words, on the picture.
TEST_F(ViewerPanelsTest, ABlackPictureSaysWhy) {
    start(kSmall + "builtin:cornell");
    settle();
    EXPECT_EQ(viewer->status("hint"), "none");
    const struct {
        const char *command, *reason, *back;
    } cases[] = {{"set image.exposure -20", "exposure: ", "undo"},
                 {"material lamp emission 0", "light: every lamp is off or dark", "undo"},
                 {"camera target 0 1 100; camera eye 0 1 50", "camera: nothing is in view", "undo; undo"},
                 {"objs", "objects: drawing them is off", "undo"}};
    for (const auto& one : cases) {
        viewer->send(one.command);
        settle();
        const std::string hint = viewer->statusUntil(
            "hint", [&](const std::string& now) { return now != "none" && !now.empty(); });
        EXPECT_NE(viewer->output().find(one.reason), std::string::npos) << one.command << ": " << hint;
        const glm::ivec4 place = picture();
        EXPECT_TRUE(eventually([&] {  // letters on it
            return screen->pixels()
                       .mean(glm::ivec2(place) + glm::ivec2(place.z, place.w) / 2 - 60, {120, 120})
                       .x > 20;
        })) << one.command;
        viewer->send(one.back);
        settle();
        EXPECT_EQ(viewer->statusUntil("hint", [](const std::string& now) { return now == "none"; }), "none");
    }
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// On a screen of 192 dots an inch text and widgets are twice as large; the size can be changed while it runs.
TEST_F(ViewerPanelsTest, TextFollowsTheScreensScale) {
    if (const std::string missing = x11Missing(); !missing.empty()) GTEST_SKIP() << missing;
    setScreenDpi(screen->display(), 192);
    start("--window 420x300 --no-state " + kCheap + "builtin:cornell");  // 840 x 600 on this screen
    settle();
    EXPECT_NE(viewer->status("window").find("scale 2.00"), std::string::npos) << viewer->status("window");
    const glm::ivec4 large = viewer->placeOf("tab:Scene");
    viewer->send("ui_scale 1");
    settle();
    const glm::ivec4 small = viewer->placeOf("tab:Scene");
    EXPECT_NEAR(large.w, 2 * small.w, 2);
    EXPECT_TRUE(lettersShown("tab:Scene"));
    moveTo(inPicture(0.5f, 0.5f));
    screen->xdotool("key ctrl+equal");
    EXPECT_NE(
        viewer
            ->statusUntil("window",
                          [](const std::string& now) { return now.find("scale 1.10") != std::string::npos; })
            .find("scale 1.10"),
        std::string::npos);
    screen->xdotool("key ctrl+minus");
    EXPECT_NE(
        viewer
            ->statusUntil("window",
                          [](const std::string& now) { return now.find("scale 1.00") != std::string::npos; })
            .find("scale 1.00"),
        std::string::npos);
    // Sizes up and down again: the letters are on the screen, whatever the program says of them.
    for (const char* scale : {"1.5", "0.8", "2", "1", "0.5", "1"}) {
        viewer->send(std::string("ui_scale ") + scale);
        settle();
        EXPECT_TRUE(lettersShown("tab:Scene")) << scale;
    }
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// Shaders of a folder are built again when they change; one that is broken is named, and the picture stays.
TEST_F(ViewerPanelsTest, ShadersAreBuiltAgainWhenTheyChange) {
    const std::string folder = freshFolder("shaders");
    fs::copy(CONELIGHT_SOURCE_DIR "/shaders", folder,
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    start(kSmall + "--shader-dir '" + folder + "' builtin:cornell");
    settle();
    const glm::ivec2 at = inPicture(0.5f, 0.35f);
    const glm::vec3 lit = shownAt(at);
    const std::string file = folder + "/gather/phong_shade.comp.glsl";
    const std::string text = bytesOf(file);
    ASSERT_NE(text, "");
    // Until it has looked at the folder once, a change is none: the file is written again until one was seen.
    const auto writeUntil = [&](const std::string& content, const std::string& line) {
        const std::size_t from = viewer->output().size();
        return eventually([&] {
            std::ofstream(file) << content;
            for (int i = 0; i < 20 && viewer->output().find(line, from) == std::string::npos; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
                viewer->status("frames");
            }
            return viewer->output().find(line, from) != std::string::npos;
        });
    };
    EXPECT_TRUE(writeUntil(text + "\nbroken", "phong_shade.comp.glsl: does not compile")) << viewer->output();
    settle();
    EXPECT_TRUE(near(shownAt(at), lit, 3)) << "the picture stays";
    EXPECT_TRUE(writeUntil(text, "shaders: built again")) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

}  // namespace
}  // namespace conelight::test
