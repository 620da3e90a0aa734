// SPDX-License-Identifier: MIT
// Groups: from a file's nodes and back into one, as lines of the list of objects, and in the console.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cpu/console_test_support.h"
#include "cpu/gltf_test_support.h"
#include "io/gltf_write.h"
#include "io/scene_stream.h"
#include "viewer/object_tree.h"

namespace conelight::test {
namespace {

using program::ObjectTree;

// A floor by itself; a house with a table of a top and two legs, and a lamp that is a mesh with a light below.
GltfBuilder house() {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", "bulb"}}};
    b.triangle();
    const int mesh = 0;
    b.node({{"name", "floor"}, {"mesh", mesh}});
    b.node({{"name", "house"}, {"children", {2, 5}}, {"translation", {0, 1, 0}}});
    b.node({{"name", "table"}, {"mesh", mesh}, {"children", {3, 4}}, {"translation", {2, 0, 0}}});
    b.node({{"name", "left leg"}, {"mesh", mesh}});
    b.node({{"name", "right leg"}, {"mesh", mesh}, {"translation", {0.5, 0, 0}}});
    b.node({{"name", "lamp"}, {"mesh", mesh}, {"children", {6}}});
    b.node({{"name", "bulb"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.json["scenes"][0]["nodes"] = {0, 1};
    return b;
}

// "house/table" of an object or light.
template <class T>
std::string pathOf(const Scene& scene, const T& thing) {
    std::string path;
    for (int group = thing.group; group >= 0; group = scene.groups[static_cast<std::size_t>(group)].parent)
        path = scene.groups[static_cast<std::size_t>(group)].name + (path.empty() ? "" : "/") + path;
    return path;
}

void expectHouse(const Scene& scene) {
    ASSERT_EQ(scene.instances.size(), 5u);
    const char* const kPaths[] = {"", "house/table", "house/table", "house/table", "house/lamp"};
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_EQ(pathOf(scene, scene.instances[i]), kPaths[i]) << scene.instances[i].name;
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(pathOf(scene, scene.lights[0]), "house/lamp");
    EXPECT_EQ(scene.groups.size(), 3u);
    expectNear(glm::vec3(scene.instances[3].worldFromObject[3]), {2.5f, 1, 0});
}

TEST(Groups, AreTheNodesThatHoldSeveralThings) {
    const Scene scene = loadGlb(house(), "house");
    expectHouse(scene);
    expectHouse(io::sceneFromBytes(io::bytesFromScene(scene)));
    const std::filesystem::path copy = folderOf("groups") / "house.glb";
    io::writeGltf(copy, scene, true);
    expectHouse(io::loadScene(copy.string()));
}

TEST(Groups, FlatFilesHaveNone) {
    GltfBuilder b;
    b.triangle();
    b.node({{"name", "floor"}, {"mesh", 0}});
    b.node({{"name", "wall"}, {"mesh", 0}});
    b.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_TRUE(loadGlb(b, "flat").groups.empty());
}

TEST(Groups, ThatAreNotThereAreRefused) {
    Scene scene = consoleScene();
    scene.instances[1].group = 0;
    EXPECT_THROW(scene.validate(), Error);
    scene.groups = {{"both", 0}};
    EXPECT_THROW(scene.validate(), Error) << "in itself";
    scene.groups = {{"both", -1}};
    EXPECT_NO_THROW(scene.validate());
}

std::string textOf(const Scene& scene, const ObjectTree& tree) {
    std::string text;
    for (const ObjectTree::Line& line : tree.lines())
        text +=
            std::string(static_cast<std::size_t>(line.depth), '.') +
            (line.isGroup ? scene.groups[line.index].name + "/" : program::objectLabel(scene, line.index)) +
            " ";
    return text;
}

TEST(ObjectTree, LinesAreWhatIsUnfoldedAndFound) {
    const Scene scene = loadGlb(house(), "house");
    ObjectTree tree;
    tree.update(scene, 1, "");
    EXPECT_EQ(textOf(scene, tree), "floor house/ .table/ ..table ..left leg ..right leg .lamp/ ..lamp ");
    const auto group = [&](const char* name) {
        const auto found = std::find_if(scene.groups.begin(), scene.groups.end(),
                                        [&](const Group& one) { return one.name == name; });
        return static_cast<std::size_t>(found - scene.groups.begin());
    };
    tree.fold(group("table"), false);
    EXPECT_EQ(textOf(scene, tree), "floor house/ .table/ .lamp/ ..lamp ");
    tree.fold(group("house"), false);
    EXPECT_EQ(textOf(scene, tree), "floor house/ ");
    EXPECT_EQ(tree.lineOf(3), tree.lines().size());
    tree.reveal(scene, 3);
    EXPECT_EQ(tree.lines()[tree.lineOf(3)].index, 3u);
    tree.fold(group("house"), false);
    tree.update(scene, 1, "leg");
    EXPECT_EQ(textOf(scene, tree), "house/ .table/ ..left leg ..right leg ");
    tree.update(scene, 1, "tab");
    EXPECT_EQ(textOf(scene, tree), "house/ .table/ ..table ..left leg ..right leg ");
    // Of the same groups after an edit, folded as they were.
    Scene edited = scene;
    edited.instances[0].visible = edited.instances[2].visible = false;
    tree.update(edited, 2, "");
    EXPECT_EQ(textOf(edited, tree), "floor house/ ");
    EXPECT_EQ(tree.countOf(group("house")).all, 5u);
    EXPECT_EQ(tree.countOf(group("house")).objects, 4u);
    EXPECT_EQ(tree.countOf(group("table")).visible, 2u);
    const std::vector<program::Selection> parts = tree.partsOf(edited, group("lamp"));
    EXPECT_EQ(parts.size(), 2u);
    tree.countSelected(edited, parts);
    EXPECT_EQ(tree.countOf(group("house")).selected, 2u);
    EXPECT_EQ(tree.countOf(group("lamp")).selected, tree.countOf(group("lamp")).all);
}

TEST(ObjectTree, LargeScenesBeginFolded) {
    Scene scene;
    scene.groups = {{"all", -1}, {"half", 0}, {"rest", 0}};
    for (int i = 0; i < 100; ++i) {
        scene.instances.emplace_back();
        scene.instances.back().group = i < 50 ? 1 : 2;
    }
    ObjectTree tree;
    tree.update(scene, 1, "");
    EXPECT_EQ(textOf(scene, tree), "all/ .half/ .rest/ ");
}

TEST(ConsoleGroups, NamesWithASlashMeanAllThatIsInThem) {
    ConsoleRig rig;
    Scene scene = consoleScene();
    scene.groups = {{"things", -1}, {"inner", 0}};
    scene.instances[1].group = 1;
    scene.lights[0].group = 0;
    scene.instances.push_back({"other", 0, 0});
    program::OpenedScene opened;
    opened.scene = scene;
    rig.session.take(std::move(opened), true);
    rig.run("select things/");
    EXPECT_EQ(rig.session.selected().size(), 2u);
    rig.run("hide things/");
    EXPECT_FALSE(rig.session.scene().instances[1].visible);
    EXPECT_TRUE(rig.session.scene().instances[0].visible);
    EXPECT_FALSE(rig.session.scene().lights[0].enabled);
    rig.run("undo; translate inner/ y 2");
    EXPECT_TRUE(rig.session.scene().instances[1].visible);
    EXPECT_EQ(rig.session.scene().instances[1].worldFromObject[3].y, 2);
    EXPECT_EQ(rig.error(), "");
    rig.run("hide thing/");
    EXPECT_NE(rig.error().find("things/"), std::string::npos) << rig.error();
    rig.lines.clear();
    rig.run("hide 4");
    EXPECT_NE(rig.error(), "") << "groups have no numbers";
    rig.lines.clear();
    rig.run("delete things/");
    EXPECT_EQ(rig.session.scene().instances.size(), 2u);
    EXPECT_TRUE(rig.session.scene().lights.empty());
}

}  // namespace
}  // namespace conelight::test
