// SPDX-License-Identifier: MIT
// The viewer's scene tree and its editors of objects, materials, lights and the camera.
#include <fstream>

#include "cli/viewer_panels_support.h"
#include "support/lamp_files.h"
#include "support/x11_client.h"

namespace conelight::test {
namespace {

TEST_F(ViewerPanelsTest, SceneTreeAndEditorsChangeTheScene) {
    startTurned();
    const glm::ivec4 place = picture();
    click("object:tall block");
    EXPECT_NE(viewer->status("selection").find("tall block"), std::string::npos);
    const ScreenPixels last = screen->pixels();
    click("visible:tall block");
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(last, place, 20) > 2000; })) << "gone";
    viewer->send("undo");
    const std::string before = viewer->status("selection");
    dragWidget("edit:position", {0.1f, 0.5f}, {30, 0});
    EXPECT_NE(viewer->status("selection"), before);
    EXPECT_EQ(viewer->status("steps").substr(0, 1), "2")
        << "camera, and one drag: " << viewer->status("steps");
    openMenu("Edit", "menu:Undo");
    EXPECT_TRUE(eventually([&] { return viewer->status("selection") == before; }));
    screen->xdotool("key ctrl+y");
    EXPECT_TRUE(eventually([&] { return viewer->status("selection") != before; }));

    click("menu:Edit");
    EXPECT_GT(viewer->placeOf("menu:Undo").z, 0);
    screen->xdotool("key Escape");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("menu:Undo").z == 0; })) << "Escape closes menus";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

TEST_F(ViewerPanelsTest, MaterialsAreEdited) {
    startTurned();
    click("object:tall block");
    click("edit:material");
    EXPECT_NE(viewer->status("selection").find("material"), std::string::npos);
    const std::string colour = answer("material white", "  color");
    ASSERT_NE(colour, "") << viewer->output();
    dragWidget("edit:base colour", {0.05f, 0.5f}, {-40, 0});
    EXPECT_NE(viewer->status("selection").find("material"), std::string::npos)
        << "a drag that ends over the picture is no click into it";
    EXPECT_NE(answer("material white", "  color"), colour);
    const std::string rough = answer("material white", "  roughness");
    dragWidget("edit:roughness", {0.5f, 0.5f}, {-30, 0});
    EXPECT_NE(answer("material white", "  roughness"), rough);
    dragWidget("edit:coat", {0.02f, 0.5f}, {40, 0});
    const std::string coat = answer("material white", "  coat ");
    dragWidget("edit:coat roughness", {0.02f, 0.5f}, {40, 0});
    EXPECT_NE(answer("material white", "  coat "), coat);

    // What glows stands with the lights.
    click("entry:lamp (glows)");
    EXPECT_NE(viewer->status("selection").find("material"), std::string::npos) << viewer->status("selection");
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// A light is added where the eye is, moved away from there by its handle, its strength dragged, deleted.
TEST_F(ViewerPanelsTest, LightsAreAddedMovedAndDeleted) {
    startTurned();
    const glm::ivec4 place = picture();
    const std::string camera = viewer->status("camera");
    click("add light");
    click("add light:point");
    EXPECT_EQ(viewer->status("selection"), "light 0");
    viewer->send("light light0 position 0 0.6 0.4");
    settle();
    const std::string light = answer("light light0", "  0 light0");
    const glm::ivec2 handle = viewer->middleOf("gizmo:y");
    ASSERT_GT(handle.x, 0) << viewer->output();
    drag(1, handle, handle + glm::ivec2(0, 40));
    const std::string moved = answer("light light0", "  0 light0");
    EXPECT_NE(moved, light);
    EXPECT_EQ(moved.substr(0, moved.find("at ")), light.substr(0, light.find("at "))) << "its place alone";
    EXPECT_EQ(viewer->status("camera"), camera) << "the handle took the drag";
    settle();
    const ScreenPixels last = screen->pixels();
    dragWidget("edit:strength", {0.2f, 0.5f}, {60, 0});
    EXPECT_NE(answer("light light0", "  0 light0"), moved);
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(last, place, 8) > 2000; }))
        << "brighter";
    click("edit:delete");
    EXPECT_EQ(answer("light", "no lights"), "no lights") << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// A profile is dropped on the light that is selected, or typed; one that cannot be read changes nothing and says why.
TEST_F(ViewerPanelsTest, LightsTakeProfilesAndRadii) {
    const std::string washer = scratchPath("washer.ies"), broken = scratchPath("broken.ies");
    std::ofstream(washer) << kWallWasher;
    std::ofstream(broken) << "IESNA91\n";
    startTurned();
    viewer->send("light add point bulb; light bulb position 0 0.5 0.3; settle");
    const auto bulb = [&] { return answer("light bulb", "  0 bulb"); };
    const std::string plain = bulb();
    EXPECT_EQ(plain.find("profile"), std::string::npos) << plain;
    viewer->send("select none");
    ASSERT_TRUE(dropFiles(screen->display(), "Conelight", {washer}));
    EXPECT_TRUE(heard("select one first"));
    EXPECT_EQ(bulb(), plain);
    click("entry:bulb");
    settle();
    const ScreenPixels even = screen->pixels();
    ASSERT_TRUE(dropFiles(screen->display(), "Conelight", {washer}));
    EXPECT_TRUE(eventually([&] { return bulb().find("profile " + washer) != std::string::npos; })) << bulb();
    settle();
    EXPECT_GT(screen->pixels().changedFrom(even, picture(), 8), 2000) << "the streak lights other walls";
    // Typed over in its field.
    const std::string washed = bulb();
    const auto write = [&](const std::string& file) {
        click("edit:profile");
        screen->xdotool("key ctrl+a");
        type(file, viewer->placeOf("edit:profile"));
        screen->xdotool("key Return");
    };
    write(broken);
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("profile problem").z > 0; }));
    EXPECT_EQ(bulb(), washed);
    viewer->send("undo");
    EXPECT_TRUE(eventually([&] { return bulb() == plain; })) << "one step, the drop's: " << bulb();

    viewer->send("light add sphere ball; light ball radius 0.1; settle");
    click("entry:ball");
    dragWidget("edit:radius", {0.2f, 0.5f}, {40, 0});
    const std::string ball = answer("light ball", "  1 ball");
    EXPECT_EQ(ball.find("radius 0.1 m"), std::string::npos) << ball;
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

TEST_F(ViewerPanelsTest, CameraIsEditedByNumbers) {
    startTurned();
    const std::string camera = viewer->status("camera");
    click("header:Camera");
    dragWidget("edit:eye", {0.1f, 0.5f}, {30, 0});
    EXPECT_NE(viewer->status("camera"), camera);
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

}  // namespace
}  // namespace conelight::test
