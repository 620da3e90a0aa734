// SPDX-License-Identifier: MIT
// What the viewer's window writes and keeps: pictures and films by its dialog, preferences from run to run, changes
// behind a crash.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/viewer_panels_support.h"
#include "io/image_file.h"
#include "session/thumbnail_files.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

class ViewerFilesTest : public ViewerPanelsTest {
  protected:
    void startWith(const std::string& state, const std::string& options = "--window 720x480 ") {
        start(options + kCheap + "builtin:cornell", "XDG_STATE_HOME=" + state);
        settle();
    }
    // Into a field of a dialog, over what is there. Ctrl is up again before the program looks.
    void fill(const std::string& field, const std::string& text) {
        click(field);
        viewer->pause();
        screen->xdotool("key ctrl+a");
        viewer->resume();
        typeByFrames(text, viewer->placeOf(field));
        screen->xdotool("key Tab");
        pass();
    }
    void choose(const std::string& list, const std::string& choice) {
        click(list);
        click("choice:" + choice);
    }
    void quit() {
        viewer->send("quit");
        EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    }
};

TEST_F(ViewerFilesTest, PicturesAndFilmsAreWrittenByADialog) {
    const std::string folder = freshFolder("written");
    start(kSmall + "builtin:cornell");
    viewer->send("camera orbit 30");
    settle();
    const std::string shown = viewer->status("picture");
    screen->xdotool("key ctrl+p");
    choose("picture:size", "other");
    fill("picture:width", "96");
    fill("picture:height", "40");
    choose("picture:kind", "PNG, 16 bits");
    click("picture:alpha");
    fill("picture:name", folder + "/wide.png");
    click("picture:take");
    EXPECT_TRUE(heard("written " + folder + "/wide.png (96 x 40)")) << viewer->output();
    const io::ByteImage wide = io::readByteImage(folder + "/wide.png");
    EXPECT_EQ(glm::ivec3(wide.width, wide.height, wide.channels), glm::ivec3(96, 40, 4));
    EXPECT_EQ(bytesOf(folder + "/wide.png").at(24), 16);
    EXPECT_EQ(wide.pixels.at(3), 0) << "nothing is in the corner";
    EXPECT_EQ(wide.pixels.at(4 * (20 * 96 + 48) + 3), 255);
    settle();
    EXPECT_EQ(viewer->status("picture"), shown) << "the window is as it was";

    screen->xdotool("key ctrl+shift+p");
    choose("picture:size", "other");
    fill("picture:rate", "4");
    fill("picture:seconds", "0.75");
    choose("picture:kind", "EXR, numbered");
    fill("picture:name", folder + "/turn%d.exr");
    click("picture:take");
    EXPECT_TRUE(heard("written " + folder + "/turn%d.exr (3 frames)")) << viewer->output();
    EXPECT_NE(bytesOf(folder + "/turn0.exr"), bytesOf(folder + "/turn2.exr"));
    EXPECT_EQ(io::readExr(folder + "/turn1.exr").width, 96);
    quit();
}

TEST_F(ViewerFilesTest, PreferencesAreKeptAndADamagedFileIsOneLine) {
    const std::string state = freshFolder("preferences"), file = state + "/conelight/preferences";
    startWith(state);
    EXPECT_FALSE(fs::exists(file)) << "nothing was changed";
    const glm::ivec4 narrow = viewer->placeOf("picture");
    const glm::vec3 dark = shownAt({40, 300});
    viewer->send("ui_scale 0.8; theme light");
    drag(1, viewer->middleOf("border:right border"),
         viewer->middleOf("border:right border") + glm::ivec2(60, 0));
    screen->xdotool("key Tab");
    EXPECT_TRUE(eventually([&] { return bytesOf(file).find("side_panels off") != std::string::npos; }));
    quit();
    const std::string kept = bytesOf(file);
    for (const char* line : {"ui_scale 0.8\n", "theme light\n", "window_width 0\n"})
        EXPECT_NE(kept.find(line), std::string::npos) << kept;

    startWith(state);
    EXPECT_NE(viewer->status("window").find("scale 0.80"), std::string::npos);
    EXPECT_GT(viewer->placeOf("picture").z, narrow.z + 200) << "there are no panels";
    screen->xdotool("key Tab");
    pass();
    EXPECT_GT(viewer->placeOf("picture").z, narrow.z + 20) << "narrower panels";
    EXPECT_GT(glm::length(shownAt({40, 300})), 3 * glm::length(dark)) << "on light grey";
    quit();

    std::ofstream(file) << "conelight preferences\ntheme light\nui_scale banana\n";
    startWith(state);
    EXPECT_TRUE(heard(file + ": line 3 is not usable; the window begins with its defaults"))
        << viewer->output();
    EXPECT_EQ(viewer->placeOf("picture"), narrow);
    quit();
}

TEST_F(ViewerFilesTest, TheWindowHasTheSizeItHad) {
    const std::string state = freshFolder("sizes"), file = state + "/conelight/preferences";
    startWith(state);
    screen->xdotool("search --name Conelight windowsize 640 400");
    EXPECT_TRUE(eventually([&] { return bytesOf(file).find("window_height 400\n") != std::string::npos; }))
        << bytesOf(file);
    quit();
    startWith(state, "");
    EXPECT_EQ(viewer->status("window").rfind("640 x 400", 0), 0u) << viewer->status("window");
    quit();
}

TEST_F(ViewerFilesTest, ChangesBehindACrashAreOfferedOnce) {
    const std::string state = freshFolder("recovery"), folder = state + "/conelight/recovery";
    const auto kept = [&] {
        std::error_code code;
        int count = 0;
        for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
            count += entry->path().extension() == ".glb" && entry->path().filename().string()[0] != '.';
        return count;
    };
    const auto crashAfterAnEdit = [&] {
        viewer->send("delete 'short block'");
        EXPECT_TRUE(eventually([&] { return viewer->status("frames"), kept() == 1; }));
        viewer->crash();
    };
    startWith(state);
    EXPECT_EQ(viewer->placeOf("recovery:take").z, 0);
    crashAfterAnEdit();

    startWith(state);
    EXPECT_TRUE(heard("recovery: changes of builtin:cornell of 20")) << viewer->output();
    click("recovery:take");
    EXPECT_TRUE(heard("recovered builtin:cornell")) << viewer->output();
    EXPECT_EQ(viewer->status("scene"), "builtin:cornell");
    viewer->send("select 'short block'");
    EXPECT_TRUE(heard("short block")) << viewer->output();
    EXPECT_EQ(kept(), 1) << "until it is saved";
    viewer->crash();

    // What cannot be read is asked about again, in the same session.
    std::string file;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".glb") file = entry.path().string();
    const std::string whole = bytesOf(file);
    std::ofstream(file, std::ios::binary) << "no scene";
    startWith(state);
    click("recovery:take");
    EXPECT_TRUE(heard(file)) << viewer->output();
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("recovery:take").z > 0; })) << viewer->output();
    std::ofstream(file, std::ios::binary) << whole;
    click("recovery:take");
    EXPECT_TRUE(heard("recovered builtin:cornell")) << viewer->output();
    viewer->crash();

    startWith(state);
    click("recovery:delete");
    EXPECT_TRUE(eventually([&] { return viewer->status("frames"), kept() == 0; }));
    // What is given up leaves nothing.
    viewer->send("delete 'tall block'");
    EXPECT_TRUE(eventually([&] { return viewer->status("frames"), kept() == 1; }));
    quit();
    EXPECT_FALSE(fs::exists(folder));
    startWith(state);
    EXPECT_EQ(viewer->placeOf("recovery:take").z, 0);
    quit();
}

TEST_F(ViewerFilesTest, ScenesAreFoundInTheDialog) {
    const std::string folder = freshFolder("dialog"), a = folder + "/a_room.glb", b = folder + "/b_room.glb";
    start("--window 860x560 " + kCheap + "builtin:cornell",
          "XDG_STATE_HOME=" + folder + "/state XDG_CACHE_HOME=" + folder + "/cache");
    viewer->send("save " + a + "; save " + b);
    settle();
    // A path is completed as far as it is clear.
    screen->xdotool("key ctrl+o");
    pass();
    type(folder + "/b_", viewer->placeOf("dialog:name"));
    screen->xdotool("key Tab");
    pass();
    screen->xdotool("key Return");
    EXPECT_TRUE(heard("loaded " + b)) << viewer->output();

    // Where the scene is from: sorted, the other way round, elsewhere and back.
    screen->xdotool("key ctrl+o");
    pass();
    EXPECT_LT(viewer->placeOf("file:a_room.glb").y, viewer->placeOf("file:b_room.glb").y);
    click("sort:name");
    EXPECT_GT(viewer->placeOf("file:a_room.glb").y, viewer->placeOf("file:b_room.glb").y);
    click("place:working folder");
    EXPECT_EQ(viewer->placeOf("file:a_room.glb").z, 0);
    click("place:dialog");  // of a recent scene
    // What lies under the mouse is shown, and kept for everyone.
    moveTo(viewer->middleOf("file:a_room.glb"));
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("thumbnail").z > 0; })) << viewer->output();
    const std::string kept = folder + "/cache/thumbnails/large/" + program::md5Of(program::uriOf(a)) + ".png";
    EXPECT_TRUE(fs::exists(kept)) << kept;
    // Part of a name leaves those that have it; arrows and Return choose.
    click("dialog:name");
    type("A_", viewer->placeOf("dialog:name"));
    EXPECT_EQ(viewer->placeOf("file:b_room.glb").z, 0);
    screen->xdotool("key Down key Down key Return");
    EXPECT_TRUE(heard("loaded " + a)) << viewer->output();
    // Recent scenes have the same pictures.
    click("menu:File");
    click("menu:Open recent");
    EXPECT_EQ(viewer->placeOf("thumbnail").z, 0);
    moveTo(viewer->middleOf("recent:" + a));
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("thumbnail").z > 0; })) << viewer->output();
    screen->xdotool("key Escape");
    quit();
}

TEST_F(ViewerFilesTest, EveryMenuIsReachedByKeys) {
    const std::string folder = freshFolder("keys");
    std::ofstream(folder + "/xdg-open") << "#!/bin/sh\necho \"$1\" > " << folder << "/opened\n";
    fs::permissions(folder + "/xdg-open", fs::perms::owner_all);
    start(kSmall + "builtin:cornell", "PATH=" + folder + ":" + std::getenv("PATH"));
    settle();
    const auto press = [&](const std::string& key) {
        screen->xdotool("key " + key);
        pass();
    };
    const auto opens = [&](const std::string& entry) {
        EXPECT_TRUE(eventually([&] { return viewer->placeOf("menu:" + entry).z > 0; })) << entry;
    };
    press("F10");
    opens("Open");
    for (const char* entry : {"Undo", "Sphere", "Light theme", "Keep as A", "Guide"}) {
        press("Right");
        opens(entry);
    }
    press("x");
    EXPECT_EQ(viewer->status("split"), "off") << "letters are the menu's";
    press("Escape");
    EXPECT_EQ(viewer->placeOf("menu:Guide").z, 0);
    for (const auto& [key, entry] :
         {std::pair("alt+f", "Open"), std::pair("alt+e", "Undo"), std::pair("alt+a", "Sphere"),
          std::pair("alt+v", "Light theme"), std::pair("alt+p", "Keep as A"), std::pair("alt+h", "Guide")}) {
        press(key);
        opens(entry);
        press("Escape");
    }
    press("alt+h");
    press("Down");
    press("Return");
    EXPECT_GT(viewer->placeOf("keys").z, 0) << "the second entry";
    press("Escape");
    press("shift+F1");
    EXPECT_TRUE(eventually([&] { return bytesOf(folder + "/opened").ends_with("/guide/viewer.md\n"); }))
        << bytesOf(folder + "/opened") << viewer->output();
    press("ctrl+F1");
    EXPECT_GT(viewer->placeOf("about:version").z, 0);
    press("Escape");
    EXPECT_EQ(viewer->placeOf("about:version").z, 0);
    // Into the panel on the left; letters are the viewer's all the same.
    const ScreenPixels before = screen->pixels();
    press("F6");
    press("Down");
    press("Down");
    EXPECT_GT(screen->pixels().changedFrom(before, {0, 20, 200, 460}, 40), 50) << "something is marked";
    press("x");
    EXPECT_NE(viewer->status("split"), "off");
    // Panels that come while a dialog is open leave it its keys.
    viewer->send("panels off");
    press("ctrl+o");
    viewer->send("panels on");
    EXPECT_GT(viewer->placeOf("dialog:name").z, 0);
    press("Escape");
    EXPECT_EQ(viewer->placeOf("dialog:name").z, 0);
    press("ctrl+q");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

}  // namespace
}  // namespace conelight::test
