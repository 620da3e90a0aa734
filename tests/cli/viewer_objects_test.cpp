// SPDX-License-Identifier: MIT
// Objects and views by keys: hidden, isolated, deleted, duplicated, each a step of undo that the picture
// follows; views along the axes, kept cameras, the list of keys.
#include "cli/viewer_panels_support.h"

namespace conelight::test {
namespace {

class ViewerObjectsTest : public ViewerPanelsTest {
  protected:
    void press(const std::string& keys) {
        screen->xdotool("key " + keys);
        pass();
        settle();
    }
};

TEST_F(ViewerObjectsTest, ObjectsComeAndGoByKeys) {
    start(kSmall + "builtin:cornell");
    viewer->send("select 'short block'");
    settle();
    const glm::ivec4 place = picture();
    moveTo(inPicture(0.5f, 0.95f));
    const ScreenPixels all = screen->pixels();
    // Where the block is, a picture without handles: nothing is selected.
    const auto changed = [&] {
        viewer->send("select none");
        settle();
        return screen->pixels().changedFrom(
            all, {place.x + place.z / 2, place.y + place.w * 6 / 10, place.z / 4, place.w / 4}, 25);
    };
    const int handles = changed();
    const auto selectBlock = [&] {
        viewer->send("select 'short block'");
        settle();
    };
    for (const auto& [keys, undo] :
         {std::pair("h", "ctrl+h"), std::pair("Delete", "ctrl+z"), std::pair("shift+h", "ctrl+z")}) {
        SCOPED_TRACE(keys);
        selectBlock();
        press(keys);
        EXPECT_GT(changed(), handles + place.z * place.w / 200) << "it, or what was round it, is gone";
        press(undo);
        EXPECT_EQ(changed(), handles) << "and is back";
    }
    selectBlock();
    press("ctrl+d");
    EXPECT_NE(viewer->status("selection").find("short block 2"), std::string::npos)
        << viewer->status("selection");
    EXPECT_NE(answer("list", "  8 ").find("short block 2"), std::string::npos) << viewer->output();
    press("ctrl+z");
    viewer->send("select 'short block 2'");
    EXPECT_NE(viewer->expect("select: there is no"), "") << "undone";
    viewer->send("select none; hide");
    EXPECT_NE(viewer->expect("hide: no object is selected"), "");
    viewer->send("quit");
    viewer->exitStatus();
}

// The outline of what is selected, and of nothing else, also where another object is before it.
TEST_F(ViewerObjectsTest, TheSelectionIsOutlined) {
    start(kSmall + "builtin:cornell");
    settle();
    const glm::ivec4 place = picture();
    const auto blue = [&] {
        const ScreenPixels now = screen->pixels();
        int count = 0;
        for (int y = place.y; y < place.y + place.w; ++y)
            for (int x = place.x; x < place.x + place.z; ++x)
                count += near(glm::vec3(now.at({x, y})), glm::vec3(70, 190, 255), 25);
        return count;
    };
    EXPECT_EQ(blue(), 0);
    viewer->send("select 'back wall'");
    const glm::ivec2 size(place.z, place.w);
    EXPECT_TRUE(eventually([&] { return blue() > size.x / 2; })) << blue();
    viewer->send("select none");
    EXPECT_TRUE(eventually([&] { return blue() == 0; }));
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerObjectsTest, ViewsAlongTheAxesAndKeptCameras) {
    start(kSmall + "builtin:cornell");
    settle();
    moveTo(inPicture(0.5f, 0.95f));
    // Eye less target, in lengths of that.
    const auto direction = [&] {
        glm::vec3 eye(0), target(0);
        std::sscanf(viewer->status("camera").c_str(), "eye %f %f %f target %f %f %f", &eye.x, &eye.y, &eye.z,
                    &target.x, &target.y, &target.z);
        return glm::normalize(eye - target);
    };
    const std::string before = viewer->status("camera");
    const std::pair<const char*, glm::vec3> views[] = {
        {"n", {0, 0, 1}},        {"shift+n", {0, 0, -1}}, {"r", {1, 0, 0}},
        {"shift+r", {-1, 0, 0}}, {"t", {0, 1, 0}},        {"shift+t", {0, -1, 0}},
        {"KP_1", {0, 0, 1}},     {"KP_3", {1, 0, 0}},     {"KP_7", {0, 1, 0}}};
    for (const auto& [key, from] : views) {
        press(key);
        EXPECT_TRUE(near(direction(), from, 0.03f)) << key << ": " << viewer->status("camera");
    }
    viewer->send("view_from left");
    settle();
    const std::string left = viewer->status("camera");
    EXPECT_TRUE(near(direction(), {-1, 0, 0}, 0.03f));
    press("b");
    press("Page_Down");
    EXPECT_EQ(viewer->status("camera"), before) << "the scene's own";
    press("Page_Up");
    EXPECT_EQ(viewer->status("camera"), left) << "the one that was kept";

    EXPECT_EQ(viewer->placeOf("keys").z, 0);
    press("F1");
    EXPECT_GT(viewer->placeOf("keys").z, 0);
    EXPECT_TRUE(lettersShown("keys"));
    press("Escape");
    EXPECT_EQ(viewer->placeOf("keys").z, 0);
    press("question");
    EXPECT_GT(viewer->placeOf("keys").z, 0);
    viewer->send("quit");
    viewer->exitStatus();
}

}  // namespace
}  // namespace conelight::test
