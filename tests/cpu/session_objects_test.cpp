// SPDX-License-Identifier: MIT
// Several things selected and changed together, materials made single, shapes and scenes added; the line round what
// is selected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>

#include "console_test_support.h"
#include "cpu/io_test_support.h"
#include "io/scene_file.h"
#include "io/scene_write.h"
#include "session/addition.h"
#include "session/material_edit.h"
#include "session/silhouette.h"
#include "session/texture_preview.h"

namespace conelight::program {
namespace {

using test::ConsoleRig;
constexpr auto kInstance = SelectionKind::Instance;
constexpr auto kLight = SelectionKind::Light;

std::string selectedText(const Session& session) {
    std::string text;
    for (const Selection& one : session.selected())
        text += (one.kind == kInstance ? "o" : one.kind == kLight ? "l" : "m") + std::to_string(one.index);
    return text;
}

TEST(SeveralSelected, AreSortedAndForgottenWhenTheyGo) {
    ConsoleRig rig;
    Session& s = rig.session;
    s.selectAll({{kInstance, 1}, {kLight, 0}, {SelectionKind::Material, 0}, {kInstance, 0}});
    EXPECT_EQ(selectedText(s), "o0o1l0") << "materials stand alone";
    EXPECT_EQ(s.selection(), (Selection{kInstance, 0})) << "the last one";
    s.toggleSelected({kInstance, 0});
    EXPECT_EQ(selectedText(s), "o1l0");
    EXPECT_EQ(s.selection(), (Selection{kLight, 0}));
    EXPECT_TRUE(s.isSelected({kInstance, 1}));
    EXPECT_FALSE(s.isSelected({kInstance, 0}));
    s.setLights({}, "dark");
    EXPECT_EQ(selectedText(s), "o1");
    EXPECT_EQ(s.selection(), (Selection{kInstance, 1}));
    s.select({SelectionKind::Material, 1});
    s.toggleSelected({kInstance, 1});
    EXPECT_EQ(selectedText(s), "o1");
    const std::uint64_t revision = s.revisions().selection;
    s.select({kInstance, 1});
    EXPECT_EQ(s.revisions().selection, revision) << "the same is no change";
    s.setInstanceList({}, "empty");
    EXPECT_EQ(s.selection(), Selection{});
    EXPECT_TRUE(s.selected().empty());
}

TEST(SeveralSelected, WordsSelect) {
    ConsoleRig rig;
    for (const auto& [line, selected] :
         {std::pair("select all", "o0o1l0"), std::pair("select box", "o0"),
          std::pair("select invert", "o1l0"), std::pair("select lid box", "o0o1"),
          std::pair("select blue", "m1"), std::pair("select none", "")}) {
        rig.run(line);
        EXPECT_EQ(selectedText(rig.session), selected) << line;
    }
    rig.run("select lid box");
    EXPECT_EQ(rig.session.selection(), (Selection{kInstance, 1})) << "the first that was named";
    EXPECT_EQ(rig.error(), "");
}

TEST(SeveralSelected, CommandsActOnAllInOneStep) {
    ConsoleRig rig;
    Session& s = rig.session;
    const auto counts = [&] { return std::pair(s.scene().instances.size(), s.scene().lights.size()); };
    rig.run("select all; hide");
    EXPECT_EQ(s.undoSteps(), 1u);
    EXPECT_FALSE(s.scene().instances[0].visible || s.scene().instances[1].visible);
    EXPECT_FALSE(s.scene().lights[0].enabled);
    rig.run("show");
    EXPECT_TRUE(s.scene().instances[1].visible && s.scene().lights[0].enabled);
    s.undo();
    s.undo();
    EXPECT_TRUE(s.scene().lights[0].enabled);

    rig.run("duplicate");
    EXPECT_EQ(s.undoSteps(), 1u);
    EXPECT_EQ(counts(), std::pair(std::size_t(4), std::size_t(2)));
    EXPECT_EQ(selectedText(s), "o2o3l1") << "the copies";
    EXPECT_EQ(s.scene().instances[3].name, "lid 2");
    const float width =
        s.scene().instances[2].worldFromObject[3].x - s.scene().instances[0].worldFromObject[3].x;
    EXPECT_GT(width, 0.5f);
    EXPECT_FLOAT_EQ(s.scene().instances[3].worldFromObject[3].x - s.scene().instances[1].worldFromObject[3].x,
                    width)
        << "they stay beside each other";
    rig.run("delete");
    EXPECT_EQ(counts(), std::pair(std::size_t(2), std::size_t(1)));
    s.undo();
    EXPECT_EQ(counts(), std::pair(std::size_t(4), std::size_t(2)));
    s.undo();
    EXPECT_EQ(counts(), std::pair(std::size_t(2), std::size_t(1)));
    EXPECT_EQ(rig.error(), "");
    rig.run("select none; delete");
    EXPECT_NE(rig.error().find("delete: no object is selected"), std::string::npos);
}

TEST(Rename, GivesThingsOtherNames) {
    ConsoleRig rig;
    rig.run("rename box crate; rename lamp sun; rename blue navy");
    EXPECT_EQ(rig.error(), "");
    EXPECT_EQ(rig.session.scene().instances[0].name, "crate");
    EXPECT_EQ(rig.session.scene().lights[0].name, "sun");
    EXPECT_EQ(rig.session.scene().materials[1].name, "navy");
    EXPECT_EQ(rig.session.undoSteps(), 3u);
    rig.session.undo();
    EXPECT_EQ(rig.session.scene().materials[1].name, "blue");
    rig.run("rename nobody x");
    EXPECT_NE(rig.error().find("there is no object, light or material 'nobody'"), std::string::npos);
}

TEST(SingleMaterial, IsACopyForThoseThatAreMeant) {
    ConsoleRig rig;
    Session& s = rig.session;
    std::vector<Instance> three(3, s.scene().instances[0]);
    three[1].name = "second";
    three[2].name = "third";
    s.setInstanceList(three, "three");
    EXPECT_EQ(usesOfMaterials(s.scene()), (std::vector<std::size_t>{3, 0}));
    rig.run("select second third; single_material");
    EXPECT_EQ(s.undoSteps(), 2u);
    ASSERT_EQ(s.scene().materials.size(), 3u);
    EXPECT_EQ(s.scene().materials[2].name, "white 2");
    EXPECT_EQ(s.scene().materials[2].phong, s.scene().materials[0].phong);
    EXPECT_EQ(usesOfMaterials(s.scene()), (std::vector<std::size_t>{1, 0, 2}));
    rig.run("single_material");
    EXPECT_EQ(rig.lines.back().text, "single_material: no other object has the material");
    EXPECT_EQ(s.undoSteps(), 2u);
    s.select({SelectionKind::Material, 2});
    s.undo();
    EXPECT_EQ(s.scene().materials.size(), 2u);
    EXPECT_EQ(s.selection(), Selection{}) << "what is gone is not selected";
    EXPECT_EQ(usesOfMaterials(s.scene()), (std::vector<std::size_t>{3, 0}));
}

// Six times the volume, by the divergence theorem: positive when all triangles face outward.
double volumeOf(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                         c = mesh.positions[mesh.indices[i + 2]];
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

TEST(Shapes, AreClosedAndStandOnTheGround) {
    constexpr double kPi = glm::pi<double>();
    const std::pair<const char*, double> volumes[] = {{"plane", 0},
                                                      {"box", 1},
                                                      {"sphere", kPi / 6},
                                                      {"cylinder", kPi / 4},
                                                      {"torus", 2 * kPi * kPi * 0.36 * 0.14 * 0.14}};
    ASSERT_EQ(shapeKinds().size(), std::size(volumes));
    for (const auto& [kind, volume] : volumes) {
        SCOPED_TRACE(kind);
        const Scene scene = shapeOf(kind, 2);
        EXPECT_NO_THROW(scene.validate());
        const Mesh& mesh = scene.meshes[0];
        EXPECT_NEAR(volumeOf(mesh), 8 * volume, 0.02 * 8 * volume);
        EXPECT_NEAR(mesh.bounds().min.y, 0, 1e-6);
        EXPECT_NEAR(mesh.bounds().extent().x, 2, 0.01);
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
            const glm::vec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
            EXPECT_GT(glm::dot(normal, mesh.normals[mesh.indices[i]]), 0) << i;
        }
    }
}

// Two cubes of 1 m along the view of a camera at (0, 0, 3) that looks at the origin.
TEST(AddCommand, PlacesWhatIsAddedWhereTheViewLooks) {
    ConsoleRig rig;
    Session& s = rig.session;
    rig.run("add sphere");
    ASSERT_EQ(s.scene().instances.size(), 3u) << rig.error();
    EXPECT_EQ(selectedText(s), "o2");
    const Aabb wall = s.scene().meshes[0].bounds();
    const glm::vec3 before(s.scene().instances[2].worldFromObject[3]);
    EXPECT_GT(before.z, wall.max.z) << "the view meets a wall: before it";
    rig.run("camera eye 0 3 0.001; camera target 0 0 0; add box crate");
    EXPECT_NEAR(s.scene().instances[3].worldFromObject[3].y, wall.max.y, 1e-4f) << "on what is level";
    EXPECT_EQ(s.scene().instances[3].name, "crate");
    rig.run("add box crate");
    EXPECT_EQ(s.scene().instances[4].name, "crate 2");
    rig.run("camera eye 50 3 0; camera target 50 2 0.1; add torus");
    EXPECT_NEAR(s.scene().instances[5].worldFromObject[3].x, 50, 1e-4f) << "nothing there: the target";
    EXPECT_EQ(rig.error(), "");
    rig.run("add cube");
    EXPECT_NE(rig.error().find("plane, box, sphere, cylinder or torus would be right"), std::string::npos);
}

// As programs without a window carry it out.
void runImport(ConsoleRig& rig, const std::string& line) {
    rig.run(line);
    const std::optional<Request> request = rig.session.takeRequest();
    ASSERT_TRUE(request && request->kind == RequestKind::Import);
    for (const std::string& said : addImported(rig.session, rig.console.picker(),
                                               readPart(request->file, rig.session.openHow()), request->file))
        rig.console.print(said);
}

TEST(ImportCommand, AppendsAFileAndUndoTakesItAway) {
    Scene file = shapeOf("box", 1);
    file.textures.push_back({"grid", 1, 1, true, {}, {}, {}, {9, 8, 7, 255}});
    file.materials[0].baseColorTexture.texture = 0;
    file.instances[0].name = "lid";
    file.instances[0].worldFromObject[3] = {7, 8, 9, 1};
    file.lights.emplace_back();
    file.lights[0].name = "lamp";
    const std::string path = (test::folderOf("session_objects") / "part.glb").string();
    io::writeScene(path, file, true);
    ConsoleRig rig;
    Session& s = rig.session;
    rig.run("camera eye 0 3 0.001; camera target 0 0 0");
    s.finishPlaying();
    const auto counts = [&] {
        const Scene& scene = s.scene();
        return std::vector<std::size_t>{scene.meshes.size(), scene.materials.size(), scene.textures.size(),
                                        scene.instances.size(), scene.lights.size()};
    };
    const std::vector<std::size_t> before = counts();
    runImport(rig, "import '" + path + "'");
    EXPECT_EQ(rig.error(), "");
    EXPECT_EQ(rig.lines.back().text, "imported " + path + ": 1 object, 1 light");
    EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 3, 1, 3, 2}));
    EXPECT_NO_THROW(s.scene().validate());
    EXPECT_EQ(s.scene().instances[2].name, "lid 2");
    EXPECT_EQ(s.scene().instances[2].mesh, 1);
    EXPECT_EQ(s.scene().instances[2].material, 2);
    EXPECT_EQ(s.scene().materials[2].baseColorTexture.texture, 0);
    EXPECT_EQ(selectedText(s), "o2l1");
    EXPECT_TRUE(s.unsaved());
    EXPECT_NEAR(s.scene().meshes[1].bounds().transformed(s.scene().instances[2].worldFromObject).min.y,
                s.scene().meshes[0].bounds().max.y, 1e-4f);
    const std::uint64_t revision = s.meshRevisions()[1];
    s.undo();
    EXPECT_EQ(counts(), before);
    EXPECT_TRUE(s.selected().empty());
    s.redo();
    EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 3, 1, 3, 2}));
    EXPECT_NE(s.meshRevisions()[1], revision) << "it may be another one";
    // Two things are a group.
    ASSERT_EQ(s.scene().groups.size(), 1u);
    EXPECT_EQ(s.scene().groups[0].name, "part");
    EXPECT_EQ(s.scene().instances[2].group, 0);
    EXPECT_EQ(s.scene().lights[1].group, 0);
    EXPECT_THROW(readPart("/no/such.glb", s.openHow()), Error);
}

TEST(TexturePreview, KeepsProportionsAndMeans) {
    Texture texture;
    texture.name = "stripes";
    texture.width = 6;
    texture.height = 2;
    texture.wrapV = TextureWrap::Clamp;
    for (int i = 0; i < 12; ++i)
        for (const int value : {i % 2 == 0 ? 200 : 100, 10 * i, 7, 255 - i})
            texture.rgba.push_back(static_cast<std::uint8_t>(value));
    EXPECT_EQ(previewSize(texture, 100), glm::ivec2(6, 2)) << "never larger";
    EXPECT_EQ(previewSize(texture, 3), glm::ivec2(3, 1));
    EXPECT_EQ(previewSize(texture, 1), glm::ivec2(1, 1));
    const std::vector<std::uint8_t> small = previewOf(texture, {3, 1}, TextureChannel::Color);
    // Of texels 0, 1, 6 and 7.
    EXPECT_EQ(std::vector<int>(small.begin(), small.begin() + 3), (std::vector<int>{150, 35, 7}));
    const std::vector<std::uint8_t> opacity = previewOf(texture, {6, 2}, TextureChannel::Opacity);
    EXPECT_EQ(std::vector<int>(opacity.begin() + 9, opacity.begin() + 12), (std::vector<int>{252, 252, 252}));
    EXPECT_EQ(describe(texture), "stripes, 6 x 2, sRGB, repeated and clamped");
    Material material;
    material.emissiveTexture.texture = 4;
    EXPECT_EQ(texturesOf(material)[3].texture, 4);
    EXPECT_STREQ(texturesOf(material)[3].name, "emission");
}

// The pixels that rays find, and the line beside them.
TEST(SelectionSilhouette, IsWhatRaysFind) {
    Scene scene = shapeOf("torus", 1);
    Camera camera;
    camera.eye = {0.3f, 1.1f, 1.2f};
    camera.target = {0.1f, 0, 0};
    constexpr int kWidth = 80, kHeight = 60;
    const Session session(scene, "torus", Settings{}, "", camera);
    Picker picker;
    const auto differing = [&](const Camera& eye) {
        Session at = session;
        at.moveCamera(eye);
        const Silhouette shape = silhouetteOf(scene, {0}, eye, kWidth, kHeight);
        int different = 0, inside = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const bool in = shape.object[static_cast<std::size_t>(y * kWidth + x)] != 0;
                inside += in;
                different += in != picker.atPixel(at, kWidth, kHeight, x, y).has_value();
            }
        EXPECT_GT(inside, 100);
        return static_cast<float>(different) / static_cast<float>(inside);
    };
    EXPECT_LT(differing(camera), 0.1f) << "a vertex covers its pixel: a little more";
    camera.eye = {0.36f, 0.2f, 0};  // within the tube: triangles reach behind the eye
    camera.target = {0.36f, 0.1f, -1};
    const std::vector<std::uint32_t> within = silhouetteOf(scene, {0}, camera, kWidth, kHeight).object;
    EXPECT_EQ(std::count(within.begin(), within.end(), 1u), kWidth * kHeight) << "it is all around";
    // Of two the nearer one.
    scene = shapeOf("box", 1);
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].worldFromObject[3].y = 0.4f;
    camera.eye = {0.01f, 3, 0};
    camera.target = glm::vec3(0);
    const std::vector<std::uint32_t> two = silhouetteOf(scene, {0, 1}, camera, kWidth, kHeight).object;
    EXPECT_EQ(std::count(two.begin(), two.end(), 1u), 0);
    EXPECT_GT(std::count(two.begin(), two.end(), 2u), 100);

    Silhouette dot{7, 5, std::vector<std::uint32_t>(35, 0)};
    dot.object[2 * 7 + 3] = 1;
    const std::vector<std::uint8_t> line = outlineOf(dot, {1, 2, 3});
    const auto opacity = [&](int x, int y) { return line[static_cast<std::size_t>(4 * (y * 7 + x) + 3)]; };
    EXPECT_EQ(opacity(3, 2), 0) << "not on it";
    EXPECT_EQ(opacity(4, 2), 255);
    EXPECT_EQ(opacity(4, 3), 255);
    EXPECT_GT(opacity(5, 2), 100);
    EXPECT_LT(opacity(5, 2), 200);
    EXPECT_EQ(opacity(6, 2), 0);
}

}  // namespace
}  // namespace conelight::program
