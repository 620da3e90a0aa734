// SPDX-License-Identifier: MIT
// Work on objects in the viewer: several selected in the picture and in the tree, moved together; the menu of the
// right button; lights as icons; materials that are shared; shapes and files that are added.
#include <fstream>
#include <nlohmann/json.hpp>

#include <filesystem>

#include "cli/viewer_panels_support.h"
#include "io/scene_write.h"
#include "support/x11_client.h"

namespace conelight::test {
namespace {

class ViewerSelectionTest : public ViewerPanelsTest {
  protected:
    void startRoom() {
        start("--window 900x620 --no-state " + kCheap + "builtin:cornell");
        settle();
    }
    void pressAt(const glm::ivec2& p, int button) {
        moveTo(p);
        pass();
        screen->xdotool("mousedown " + std::to_string(button));
        pass();
        screen->xdotool("mouseup " + std::to_string(button));
        pass();
        pass();
    }
    void clickWith(const std::string& modifier, const glm::ivec2& p) {
        screen->xdotool("keydown " + modifier);
        pass();
        click(p);
        screen->xdotool("keyup " + modifier);
        pass();
    }
    glm::ivec2 row(const std::string& object) { return viewer->middleOf("object:" + object); }
    // Pixels of the picture in a colour.
    int count(const glm::vec3& color, float tolerance = 25) {
        const glm::ivec4 place = picture();
        const ScreenPixels now = screen->pixels();
        int found = 0;
        for (int y = place.y; y < place.y + place.w; ++y)
            for (int x = place.x; x < place.x + place.z; ++x)
                found += near(glm::vec3(now.at({x, y})), color, tolerance);
        return found;
    }
    // The box with its blocks in a group, and that in one of everything.
    void startGrouped(const std::string& folder) {
        const std::string file = folder + "/room.gltf";
        start("--window 900x600 --no-state " + kCheap + "--exec 'save " + file + "' builtin:cornell");
        settle();
        std::ifstream stream(file);
        nlohmann::json json = nlohmann::json::parse(stream);
        nlohmann::json blocks, others;
        for (std::size_t i = 0; i < json["nodes"].size(); ++i) {
            const bool block =
                json["nodes"][i]["name"].get<std::string>().find(" block") != std::string::npos;
            if (json["nodes"][i].contains("mesh")) (block ? blocks : others).push_back(i);
        }
        ASSERT_EQ(blocks.size(), 2u);
        const std::size_t count = json["nodes"].size();
        others.push_back(count);
        json["nodes"].push_back({{"name", "blocks"}, {"children", blocks}});
        json["nodes"].push_back({{"name", "room"}, {"children", others}});
        json["scenes"][0]["nodes"] = {count + 1};
        for (std::size_t i = 0; i < count; ++i)
            if (json["nodes"][i].contains("camera")) json["scenes"][0]["nodes"].push_back(i);
        const std::string grouped = folder + "/grouped.gltf";
        std::ofstream(grouped) << json.dump();
        viewer->send("open '" + grouped + "'; settle; echo grouped");
        ASSERT_NE(viewer->expect("grouped"), "") << viewer->output();
    }
    void end() {
        viewer->send("quit");
        EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    }
};

TEST_F(ViewerSelectionTest, SeveralAreSelectedAndMovedTogether) {
    startRoom();
    const glm::ivec2 tall = inPicture(0.4f, 0.6f), small = inPicture(0.62f, 0.8f);
    click(tall);
    EXPECT_NE(viewer->status("selection").find("tall block"), std::string::npos);
    clickWith("ctrl", small);
    EXPECT_EQ(viewer->status("selection"), "2 objects, 0 lights");
    settle();
    const std::string far = answer("list", "  6 tall block"), nearer = viewer->expect("  7 short block");
    const glm::ivec2 handle = viewer->middleOf("gizmo:y");
    ASSERT_GT(handle.x, 0) << viewer->output();
    const std::string steps = viewer->status("steps");
    drag(1, handle, handle - glm::ivec2(0, 40));
    EXPECT_NE(answer("list", "  6 tall block"), far);
    EXPECT_NE(viewer->expect("  7 short block"), nearer) << "both";
    EXPECT_NE(viewer->status("steps"), steps);
    moveTo(inPicture(0.1f, 0.1f));
    screen->xdotool("key ctrl+z");
    EXPECT_EQ(viewer->statusUntil("steps", [&](const std::string& now) { return now[0] == steps[0]; })[0],
              steps[0]);
    EXPECT_EQ(answer("list", "  6 tall block"), far) << "one step";
    EXPECT_EQ(viewer->expect("  7 short block"), nearer);

    // In the tree: a range, one out of it, all, none, the others.
    click(row("floor"));
    clickWith("shift", row("ceiling"));
    EXPECT_EQ(viewer->status("selection"), "5 objects, 0 lights");
    clickWith("ctrl", row("left wall"));
    EXPECT_EQ(viewer->status("selection"), "4 objects, 0 lights");
    moveTo(inPicture(0.1f, 0.1f));
    screen->xdotool("key ctrl+i");
    EXPECT_EQ(viewer->statusUntil("selection", [](const std::string& s) { return s[0] != '5'; }),
              "4 objects, 0 lights");
    screen->xdotool("key ctrl+a");
    EXPECT_EQ(viewer->statusUntil("selection", [](const std::string& s) { return s[0] == '8'; }),
              "8 objects, 0 lights");
    const glm::ivec2 floor = inPicture(0.45f, 0.93f);
    const auto isLit = [&] { return shownAt(floor).x > 20; };
    EXPECT_TRUE(isLit());
    screen->xdotool("key Delete");
    EXPECT_TRUE(eventually([&] { return shownAt(floor) == glm::vec3(0); })) << "all are gone";
    screen->xdotool("key ctrl+z");
    EXPECT_TRUE(eventually(isLit));
    end();
}

// A file's groups: folded, found by a click into the picture, selected, moved, hidden and deleted as one.
TEST_F(ViewerSelectionTest, GroupsOfAFileAreATree) {
    const std::string folder = freshFolder("groups");
    startGrouped(folder);
    EXPECT_NE(viewer->status("mode").find("phong"), std::string::npos) << "the mode that was chosen stays";

    moveTo(inPicture(0.1f, 0.1f));
    EXPECT_GT(viewer->placeOf("object:tall block").z, 0);
    EXPECT_GT(viewer->placeOf("object:tall block").x, viewer->placeOf("object:floor").x) << "further in";
    click("fold:blocks");
    EXPECT_EQ(viewer->placeOf("object:tall block").z, 0);
    EXPECT_EQ(viewer->status("selection"), "none") << "the arrow only folds";
    const ScreenPixels whole = screen->pixels();
    click(viewer->middleOf("group:blocks") + glm::ivec2(-10, 0));
    EXPECT_EQ(viewer->status("selection"), "2 objects, 0 lights");
    EXPECT_EQ(viewer->placeOf("object:tall block").z, 0) << "it stays folded";
    click("group:room");
    EXPECT_EQ(viewer->status("selection"), "8 objects, 0 lights");
    clickWith("ctrl", viewer->middleOf("group:blocks"));
    EXPECT_EQ(viewer->status("selection"), "6 objects, 0 lights");
    // What is chosen in the picture is unfolded.
    click(inPicture(0.62f, 0.8f));
    EXPECT_NE(viewer->status("selection").find("short block"), std::string::npos);
    EXPECT_GT(viewer->placeOf("object:short block").z, 0);

    viewer->send("select none; settle");
    click("visible:blocks/");
    settle();
    moveTo(inPicture(0.1f, 0.1f));
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(whole, picture(), 25) > 1000; }));
    viewer->send("undo; settle");
    click("group:blocks");
    const glm::ivec2 handle = viewer->middleOf("gizmo:y");
    ASSERT_GT(handle.x, 0);
    const std::string before = answer("list", "  6 "), other = viewer->expect("  7 ");
    drag(1, handle, handle - glm::ivec2(0, 40));
    EXPECT_NE(answer("list", "  6 "), before);
    EXPECT_NE(viewer->expect("  7 "), other) << "both";
    screen->xdotool("key Delete");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("group:blocks").z == 0; }));
    viewer->send("undo; save '" + folder + "/again.glb'; open '" + folder + "/again.glb'; echo again");
    ASSERT_NE(viewer->expect("again"), "") << viewer->output();
    EXPECT_GT(viewer->placeOf("group:blocks").z, 0) << "it is in the file";
    viewer->send("screenshot_window '" + folder + "/window.png'");
    end();
}

// The right button without a drag: what is under it is selected, and the menu acts on it. With a drag it looks round.
TEST_F(ViewerSelectionTest, TheRightButtonOpensAMenu) {
    startRoom();
    const std::string camera = viewer->status("camera");
    const ScreenPixels all = screen->pixels();
    const glm::ivec4 place = picture();
    pressAt(inPicture(0.62f, 0.8f), 3);
    EXPECT_NE(viewer->status("selection").find("short block"), std::string::npos);
    EXPECT_EQ(viewer->status("camera"), camera);
    EXPECT_TRUE(lettersShown("item:Hide"));
    click("item:Hide");
    EXPECT_EQ(viewer->placeOf("item:Hide").z, 0) << "closed";
    viewer->send("select none");
    settle();
    moveTo(inPicture(0.1f, 0.02f));
    const glm::ivec4 block{place.x + place.z / 2, place.y + place.w * 7 / 10, place.z / 5, place.w / 5};
    EXPECT_TRUE(eventually([&] { return screen->pixels().changedFrom(all, block, 25) > 500; })) << "hidden";
    viewer->send("undo");
    moveTo(inPicture(0.3f, 0.5f));
    pass();
    screen->xdotool("mousedown 3");
    screen->xdotool("keydown w");
    EXPECT_NE(viewer->statusUntil("camera", [&](const std::string& now) { return now != camera; }), camera);
    screen->xdotool("keyup w");
    screen->xdotool("mouseup 3");
    pass();
    EXPECT_EQ(viewer->placeOf("item:Show all").z, 0) << "a flight opens none";

    // A row of the tree; a name is typed.
    pressAt(row("tall block"), 3);
    EXPECT_NE(viewer->status("selection").find("tall block"), std::string::npos);
    click("item:name");
    screen->xdotool("key ctrl+a");
    type("tower", viewer->placeOf("item:name"));
    screen->xdotool("key Return");
    EXPECT_NE(viewer->statusUntil("selection", [](const std::string& s) { return s.find("tower") != s.npos; })
                  .find("tower"),
              std::string::npos);
    // Nothing under it.
    viewer->send("select all; hide; select none; settle");
    pressAt(inPicture(0.5f, 0.5f), 3);
    EXPECT_TRUE(lettersShown("item:Show all"));
    EXPECT_EQ(viewer->placeOf("item:Delete").z, 0);
    screen->xdotool("key Escape");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("item:Show all").z == 0; }));
    end();
}

// A long list is scrolled to what is selected elsewhere.
TEST_F(ViewerSelectionTest, TheTreeFollowsTheSelection) {
    startRoom();
    viewer->send(
        "select all; duplicate; select all; duplicate; select all; duplicate; select all; duplicate");
    viewer->send("resolution 0.25");
    viewer->send("select all; duplicate; select all; duplicate; select none");
    settle();
    const std::string last = "short block 2 2";
    viewer->send("select floor");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("object:" + last).z == 0; })) << "it is not seen";
    viewer->send("select '" + last + "'");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("object:" + last).z > 0; })) << viewer->output();
    EXPECT_EQ(viewer->placeOf("object:floor").z, 0);
    viewer->send("select floor");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("object:floor").z > 0; }))
        << viewer->status("selection");
    end();
}

// Icons of lights win over what is behind them; the selected one has the colour of the selection.
TEST_F(ViewerSelectionTest, LightsAreSeenAndClicked) {
    startRoom();
    viewer->send("light add spot beam; light beam position -0.2 0.7 0.2; light beam direction 0.3 -1 0");
    viewer->send("light add rect panel; light panel position 0.3 0.5 0; light panel size 0.4 0.2");
    viewer->send(
        "light add directional sun; light add point bulb; light bulb position 0.2 0.3 0.6; select none");
    settle();
    const glm::vec3 lamp(255, 214, 110), blue(70, 190, 255);
    moveTo(inPicture(0.5f, 0.97f));
    EXPECT_TRUE(eventually([&] { return count(lamp) > 60; })) << count(lamp);
    EXPECT_EQ(count(blue), 0);
    for (const auto& [name, index] : {std::pair("beam", 0), std::pair("panel", 1), std::pair("bulb", 3)}) {
        click(viewer->middleOf(std::string("light:") + name));
        EXPECT_EQ(viewer->status("selection"), "light " + std::to_string(index));
        EXPECT_TRUE(eventually([&] { return count(blue) > 20; })) << name;
    }
    moveTo(inPicture(0.5f, 0.97f));
    screen->xdotool("key shift+l");
    EXPECT_TRUE(eventually([&] { return count(lamp) == 0 && viewer->placeOf("light:beam").z == 0; }));
    viewer->send("light_shapes on");
    EXPECT_TRUE(eventually([&] { return count(lamp) > 40; }));

    // Strength and colour in other units.
    click(viewer->middleOf("light:bulb"));
    EXPECT_TRUE(lettersShown("edit:unit"));
    click("edit:unit");
    click("unit:lm");
    const std::string before = answer("light bulb", "  3 bulb");
    dragWidget("edit:strength", {0.2f, 0.5f}, {40, 0});
    const std::string stronger = answer("light bulb", "  3 bulb");
    EXPECT_NE(stronger, before);
    click("edit:by temperature");
    dragWidget("edit:temperature", {0.6f, 0.5f}, {-40, 0});
    const std::string warm = answer("light bulb", "  3 bulb");
    EXPECT_NE(warm.find(" K"), std::string::npos) << warm;
    const auto lumen = [](const std::string& line) {
        const std::size_t at = line.find(" lm");
        return line.substr(line.rfind(' ', at - 1), at - line.rfind(' ', at - 1));
    };
    EXPECT_EQ(lumen(warm), lumen(stronger)) << "as bright as before";
    end();
}

TEST_F(ViewerSelectionTest, SharedMaterialsAreMadeSingle) {
    startRoom();
    viewer->send("light add point; light light0 intensity 4; select none");
    click(row("short block"));
    EXPECT_GT(viewer->placeOf("shared").z, 0);
    settle();
    const glm::vec3 before = shownAt(inPicture(0.4f, 0.6f));
    click("edit:make single");
    EXPECT_EQ(viewer->placeOf("edit:make single").z, 0) << "no other object has it";
    viewer->send("material 'short block' color 0.1 0.2 0.9; select none");
    settle();
    EXPECT_TRUE(near(shownAt(inPicture(0.4f, 0.6f)), before, 3)) << "the other block is as it was";
    const glm::vec3 block = shownAt(inPicture(0.62f, 0.8f));
    EXPECT_GT(block.z, block.x + 40);
    viewer->send("undo; undo; select 'short block'");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("edit:make single").z > 0; }));
    end();
}

// Left red, right green: as a thumbnail, and large in a window of its own.
TEST_F(ViewerSelectionTest, MaterialsShowTheirTextures) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    scene.textures.push_back(
        {"halves", 2, 1, true, {}, {}, TextureFilter::Nearest, {200, 20, 20, 255, 20, 200, 20, 255}});
    scene.materials.emplace_back();
    scene.materials[0].baseColorTexture.texture = 0;
    scene.instances.push_back({"card", 0, 0});
    const std::string file = freshFolder("textures") + "/card.glb";
    io::writeScene(file, scene, true);
    start("--window 900x620 --no-state " + kCheap + file);
    settle();
    click(row("card"));
    click("edit:material");
    const glm::ivec4 thumbnail = viewer->placeOf("texture:base colour");
    ASSERT_GT(thumbnail.z, 10) << viewer->output();
    const auto showsHalves = [&](const glm::ivec4& place) {
        return eventually([&] {
            const ScreenPixels now = screen->pixels();
            const glm::ivec2 at(place), eighth(place.z / 8, place.w / 2);
            return near(glm::vec3(now.at(at + eighth)), {200, 20, 20}, 3) &&
                   near(glm::vec3(now.at(at + eighth * glm::ivec2(7, 1))), {20, 200, 20}, 3);
        });
    };
    EXPECT_TRUE(showsHalves(thumbnail));
    click("texture:base colour");
    const glm::ivec4 large = viewer->placeOf("texture view");
    EXPECT_GT(large.z, 4 * thumbnail.z);
    EXPECT_TRUE(showsHalves(large));
    click("texture channel:red");
    EXPECT_TRUE(eventually([&] {
        return near(glm::vec3(screen->pixels().at(glm::ivec2(large) + glm::ivec2(large.z / 8, large.w / 2))),
                    glm::vec3(200), 3);
    }));
    end();
}

// The outline of many triangles is the line round what they cover.
TEST_F(ViewerSelectionTest, ShapesAndFilesAreAdded) {
    if (const std::string missing = x11Missing(); !missing.empty()) GTEST_SKIP() << missing;
    startRoom();
    viewer->send("light add point; light light0 intensity 4; select none");
    settle();
    const glm::ivec4 place = picture();
    const ScreenPixels room = screen->pixels();
    openMenu("Add", "menu:Torus");
    EXPECT_NE(
        viewer->statusUntil("selection", [](const std::string& s) { return s != "none"; }).find("torus"),
        std::string::npos);
    settle();
    EXPECT_GT(screen->pixels().changedFrom(room, place, 20), 1000);
    const glm::vec3 blue(70, 190, 255);
    const int line = count(blue);
    EXPECT_GT(line, 100);
    viewer->send("save '" + freshFolder("added") + "/torus.glb'; undo; settle; echo saved");
    ASSERT_NE(viewer->expect("saved"), "") << viewer->output();
    EXPECT_EQ(viewer->status("selection"), "none");
    // Dropped with Shift it is added, all of it is selected: the room and the torus, above what is drawn as lines.
    screen->xdotool("keydown shift");
    pass();
    ASSERT_TRUE(dropFiles(screen->display(), "Conelight", {scratchPath("added") + "/torus.glb"}));
    EXPECT_NE(viewer->expect("imported "), "") << viewer->output();
    screen->xdotool("keyup shift");
    EXPECT_EQ(viewer->status("selection"), "9 objects, 1 lights");
    EXPECT_EQ(viewer->status("scene"), "builtin:cornell");
    viewer->send(
        "undo; add sphere; duplicate; select all; duplicate; select all; duplicate; select all; settle");
    viewer->send("echo many");
    ASSERT_NE(viewer->expect("many"), "") << viewer->output();
    EXPECT_TRUE(eventually([&] { return count(blue) > 100; })) << count(blue);
    end();
}

}  // namespace
}  // namespace conelight::test
