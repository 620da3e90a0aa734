// SPDX-License-Identifier: MIT
// Fixture of tests of the viewer's menus, panels and dialogs: names typed, answers of commands read.
#pragma once

#include <filesystem>
#include <string>

#include "cli/viewer_test_support.h"
#include "support/program.h"

namespace conelight::test {

class ViewerPanelsTest : public ViewerTest {
  protected:
    // A scene seen from one side, panels beside it.
    void startTurned() {
        start("--window 900x600 --no-state " + kCheap + "builtin:cornell");
        viewer->send("camera orbit 30 15");
        settle();
    }
    // A name is typed into the dialog that is open, and its button pressed.
    void name(const std::string& file) {
        type(file, viewer->placeOf("dialog:name"));
        click("dialog:take");
    }
    // The answer to a command that begins with `begin`.
    std::string answer(const std::string& command, const std::string& begin) {
        viewer->send(command);
        return viewer->expect(begin);
    }
    // Whether it has said so, also while widgets were looked for.
    bool heard(const std::string& part) {
        return eventually([&] {
            viewer->status("frames");
            return viewer->output().find(part) != std::string::npos;
        });
    }
    // Whether bright pixels stand on the widget's dark ground.
    bool lettersShown(const std::string& widget) {
        const glm::ivec4 place = viewer->placeOf(widget);
        constexpr int kBright = 150, kPixels = 5;  // text is 224, grounds are below 70; a letter has more
        return eventually([&] {
            const ScreenPixels now = screen->pixels();
            int bright = 0;
            for (int y = place.y; y < place.y + place.w; ++y)
                for (int x = place.x; x < place.x + place.z; ++x) bright += now.at({x, y}).x >= kBright;
            return bright >= kPixels;
        });
    }
    // A text stands on its ground in the middle of a box.
    static bool textShown(const ScreenPixels& now, const glm::ivec4& box) {
        int letters = 0, ground = 0;
        for (int y = box.y + box.w / 4; y < box.y + box.w * 3 / 4; ++y)
            for (int x = box.x + box.z / 4; x < box.x + box.z * 3 / 4; ++x) {
                letters += now.at({x, y}).x > 150;
                ground += near(glm::vec3(now.at({x, y})), glm::vec3(29), 2);
            }
        return letters > 50 && ground > 3000;
    }
    void openMenu(const std::string& menu, const std::string& item) {
        click("menu:" + menu);
        click(item);
    }
    std::string freshFolder(const std::string& folder) {
        const std::string path = scratchPath(folder);
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
        return path;
    }
};

}  // namespace conelight::test
