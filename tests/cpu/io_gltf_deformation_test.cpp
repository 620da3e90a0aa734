// SPDX-License-Identifier: MIT
// Skins and morph targets of glTF clips against their formulas, written down here once more.
#include <algorithm>
#include <cmath>
#include <limits>

#include "conelight/error.h"
#include "cpu/gltf_test_support.h"
#include "io/animation.h"

namespace conelight {
namespace {

using namespace test;
using Json = nlohmann::json;

struct Moved {
    io::SceneAnimation animation;
    Scene rest;
    Mesh at(float time, std::size_t number = 0) const {
        const io::DeformedMesh& moving = animation.meshes.at(number);
        Mesh mesh = rest.meshes.at(moving.mesh);
        io::deform(moving, io::posesAt(animation, 0, time), mesh);
        return mesh;
    }
};

Moved load(const GltfBuilder& b, const std::string& name) {
    Moved moved;
    moved.rest =
        io::loadAnimatedScene(write(folderOf("gltf") / (name + ".glb"), b.glb()), {}, moved.animation);
    moved.rest.validate();
    return moved;
}

void addChannel(GltfBuilder& b, int node, const std::string& path, const std::string& interpolation,
                const std::vector<float>& times, const std::vector<float>& values) {
    const std::size_t components = path == "weights" ? 1 : path == "rotation" ? 4 : 3;
    const int input = b.floats(times, 1), output = b.floats(values, components);
    if (!b.json.contains("animations"))
        b.json["animations"] = {{{"samplers", Json::array()}, {"channels", Json::array()}}};
    Json& clip = b.json["animations"][0];
    clip["channels"].push_back(
        {{"sampler", clip["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    clip["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

// A triangle whose first corner hangs on joint 0, its second on joint 1, its third on both by halves. Joint 1 stands
// at (0, 1, 0) of joint 0, and turns about z by 90 degrees within a second.
GltfBuilder skinned() {
    GltfBuilder b;
    Json& primitive = b.triangle();
    Json& attributes = primitive["attributes"];
    attributes["NORMAL"] = b.floats({0, 0, 1, 1, 0, 0, 0, 0, 1}, 3);
    attributes["JOINTS_0"] =
        b.accessor(b.view(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), 5121, 3, "VEC4");
    attributes["WEIGHTS_0"] = b.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, 4);
    b.node({{"children", {1, 2}}});
    b.node({{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}});
    b.node({{"translation", {0, 0, 0}}, {"children", {3}}});
    b.node({{"translation", {0, 1, 0}}});
    std::vector<float> inverse(32, 0.0f);
    for (int j = 0; j < 2; ++j)
        for (int d = 0; d < 4; ++d) inverse[std::size_t(16 * j + 5 * d)] = 1;
    inverse[16 + 13] = -1;  // joint 1: down by one
    b.json["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", b.floats(inverse, 16)}}};
    const float s = std::sqrt(0.5f);
    addChannel(b, 3, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, s, s});
    return b;
}

TEST(GltfDeformation, SkinsBlendTheirJoints) {
    const Moved moved = load(skinned(), "skin");
    ASSERT_EQ(moved.animation.meshes.size(), 1u);
    EXPECT_EQ(moved.rest.instances.at(0).worldFromObject, glm::mat4(1.0f));
    expectNear(moved.rest.meshes[0].positions[1], {1, 0, 0});
    for (const float time : {0.0f, 0.5f, 1.0f, 7.0f}) {
        const float angle = 1.57079633f * std::min(time, 1.0f), c = std::cos(angle), s = std::sin(angle);
        const Mesh mesh = moved.at(time);
        // Joint 1 turns what is one below it, and one to the right.
        expectNear(mesh.positions[0], {0, 0, 0});
        expectNear(mesh.positions[1], {c + s, 1 + s - c, 0});
        expectNear(mesh.positions[2], {0, 1, 0});
        expectNear(mesh.normals[1], {c, s, 0});
    }
}

TEST(GltfDeformation, EightJointsOfAVertex) {
    GltfBuilder b = skinned();
    Json& attributes = b.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] =
        b.accessor(b.view(std::vector<std::uint16_t>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 5123, 3, "VEC4");
    attributes["WEIGHTS_1"] = b.floats({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
    const Moved moved = load(b, "eight");
    // The first corner now hangs on both by halves: joint 1 takes (0, 0, 0) to (1, 1, 0).
    expectNear(moved.at(1).positions[0], {0.5f, 0.5f, 0});
}

// Two targets: up, and to the right.
GltfBuilder morphing() {
    GltfBuilder b;
    Json& primitive = b.triangle();
    primitive["attributes"]["NORMAL"] = b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    primitive["targets"] = {{{"POSITION", b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)}},
                            {{"POSITION", b.floats({2, 0, 0, 2, 0, 0, 2, 0, 0}, 3)},
                             {"NORMAL", b.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, 3)}}};
    b.json["meshes"][0]["weights"] = {0.25, 0};
    b.node({{"mesh", 0}, {"translation", {0, 7, 0}}});
    return b;
}

TEST(GltfDeformation, WeightsMoveMorphTargets) {
    GltfBuilder b = morphing();
    addChannel(b, 0, "weights", "LINEAR", {0, 2}, {0, 0, 1, 0.5f});
    const Moved moved = load(b, "morph");
    expectNear(moved.rest.meshes[0].positions[0], {0, 0, 0.25f});  // at rest: the mesh's own weights
    const Mesh half = moved.at(1);
    expectNear(half.positions[1], {1.5f, 0, 0.5f});
    expectNear(half.normals[1], glm::normalize(glm::vec3(0.25f, 0, 1)));
    expectNear(moved.at(5).positions[2], {1, 1, 1});

    GltfBuilder step = morphing();
    addChannel(step, 0, "weights", "STEP", {0, 2}, {0, 0, 1, 0.5f});
    expectNear(load(step, "step").at(1.9f).positions[0], {0, 0, 0});
    // w = t^3 on [0, 2] for the first target: slopes 0 and 12.
    GltfBuilder cubic = morphing();
    addChannel(cubic, 0, "weights", "CUBICSPLINE", {0, 2}, {9, 9, 0, 0, 0, 0, 12, 0, 8, 0, 9, 9});
    const Moved spline = load(cubic, "cubic");
    for (const float t : {0.0f, 0.5f, 1.5f, 2.0f}) expectNear(spline.at(t).positions[0], {0, 0, t * t * t});
}

TEST(GltfDeformation, NodesOfOneMeshMoveByThemselves) {
    GltfBuilder b = morphing();
    b.json["nodes"].push_back({{"mesh", 0}, {"scale", {-1, 1, 1}}});
    b.json["nodes"].push_back({{"mesh", 0}});
    b.json["scenes"][0]["nodes"] = {0, 1, 2};
    addChannel(b, 0, "weights", "LINEAR", {0, 1}, {0, 0, 1, 0});
    addChannel(b, 1, "weights", "LINEAR", {0, 1}, {0, 0, 0, 1});
    const Moved moved = load(b, "three");
    const auto corner = [&](std::size_t instance) {
        const Instance& placed = moved.rest.instances.at(instance);
        Mesh mesh = moved.rest.meshes[std::size_t(placed.mesh)];
        for (const io::DeformedMesh& moving : moved.animation.meshes)
            if (moving.mesh == std::size_t(placed.mesh))
                io::deform(moving, io::posesAt(moved.animation, 0, 1), mesh);
        return glm::vec3(placed.worldFromObject * glm::vec4(mesh.positions[1], 1));
    };
    expectNear(corner(0), {1, 7, 1});
    expectNear(corner(1), {-3, 0, 0});  // mirrored, and two to its right
    expectNear(corner(2), {1, 0, 0.25f});
}

TEST(GltfDeformation, APoseIsTheFileOfThatPose) {
    GltfBuilder b = morphing(), still = morphing();
    addChannel(b, 0, "weights", "LINEAR", {0, 1}, {0, 0, 0.5f, 0.75f});
    still.json["nodes"][0]["weights"] = {0.5, 0.75};
    const Mesh posed = load(b, "posed").at(1), wanted = loadGlb(still, "still").meshes.at(0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(posed.positions[i], wanted.positions[i]);
        expectNear(posed.normals[i], wanted.normals[i]);
    }
}

TEST(GltfDeformation, SplitVerticesKeepTheirJoints) {
    GltfBuilder b = skinned();
    Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["attributes"].erase("NORMAL");  // tangents need normals, which unshare the vertices
    primitive["indices"] = b.indices({2, 0, 1});
    primitive["attributes"]["TEXCOORD_0"] = b.floats({0, 0, 1, 0, 0, 1}, 2);
    primitive["material"] = 0;
    b.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    const std::string picture = png(1, 1, {128, 128, 255, 255});
    b.json["images"][0]["bufferView"] = b.view(std::vector<char>(picture.begin(), picture.end()));
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const Moved moved = load(b, "split");
    const Mesh mesh = moved.at(1);
    ASSERT_EQ(mesh.tangents.size(), 3u);
    expectNear(mesh.positions[0], {0, 1, 0});
    expectNear(mesh.positions[1], {0, 0, 0});
    expectNear(mesh.positions[2], {1, 2, 0});
}

TEST(GltfDeformation, PosesBeyondNumbersChangeNothing) {
    GltfBuilder b = morphing();
    addChannel(b, 0, "weights", "LINEAR", {0, 1}, {0, 0, 3e38f, 3e38f});
    const Moved moved = load(b, "beyond");
    Mesh mesh = moved.rest.meshes[0];
    EXPECT_FALSE(io::deform(moved.animation.meshes[0], io::posesAt(moved.animation, 0, 1), mesh));
    expectNear(mesh.positions[0], moved.rest.meshes[0].positions[0]);
}

TEST(GltfDeformation, RefusesWhatCannotBeUsed) {
    const auto refusal = [](const GltfBuilder& b) -> std::string {
        try {
            load(b, "refused");
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "(accepted)";
    };
    GltfBuilder b = morphing();
    addChannel(b, 0, "weights", "LINEAR", {0, 1}, {0, 0, 1});
    EXPECT_NE(refusal(b).find("has 3 weights; 4, for 2 morph targets, would be right"), std::string::npos)
        << refusal(b);
    b = skinned();
    b.json["skins"][0]["joints"] = {2};
    EXPECT_NE(refusal(b).find("joint 1 is out of range"), std::string::npos) << refusal(b);
    b = skinned();
    b.json["skins"][0]["joints"] = {2, 99};
    EXPECT_NE(refusal(b).find("joints[1]"), std::string::npos) << refusal(b);
    b = skinned();
    b.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = b.floats({1, 0, 0, 0}, 4);
    EXPECT_NE(refusal(b).find("as many elements as positions"), std::string::npos) << refusal(b);
    b = morphing();
    addChannel(b, 0, "weights", "LINEAR", {0, 1}, {0, 0, 1, 1});
    b.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = b.floats({0, 0, 0}, 3);
    EXPECT_NE(refusal(b).find("3 elements expected"), std::string::npos) << refusal(b);
}

}  // namespace
}  // namespace conelight
