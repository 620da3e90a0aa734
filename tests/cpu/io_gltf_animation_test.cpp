// SPDX-License-Identifier: MIT
// Clips of glTF files: each interpolation against its closed form, hierarchy, lights, cameras, refusals.
#include <cmath>
#include <functional>
#include <limits>

#include "conelight/error.h"
#include "cpu/gltf_test_support.h"
#include "io/animation.h"

namespace conelight {
namespace {

using namespace test;
using Json = nlohmann::json;

// Node 0 (moved) with a triangle as child at x = 1, a camera and a spot.
GltfBuilder movedNode() {
    GltfBuilder b;
    b.triangle();
    b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    b.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "spot"}}}}}}};
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.node({{"children", {1}}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.node({{"mesh", 0}, {"translation", {1, 0, 0}}});
    b.json["animations"] = {{{"name", "go"}, {"samplers", Json::array()}, {"channels", Json::array()}}};
    return b;
}

Json& addTrack(GltfBuilder& b, const std::string& path, const std::string& interpolation,
               const std::vector<float>& times, const std::vector<float>& values) {
    const int input = b.floats(times, 1), output = b.floats(values, path == "rotation" ? 4 : 3);
    Json& clip = b.json["animations"][0];
    clip["channels"].push_back(
        {{"sampler", clip["samplers"].size()}, {"target", {{"node", 0}, {"path", path}}}});
    clip["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    return clip["samplers"].back();
}

struct Moved {
    io::SceneAnimation animation;
    Scene rest;
    Scene at(float time) const {
        Scene scene = rest;
        io::poseScene(animation, 0, time, rest, scene);
        return scene;
    }
    glm::vec3 origin(float time) const { return glm::vec3(at(time).instances.at(0).worldFromObject[3]); }
};

Moved load(const GltfBuilder& b, const std::string& name) {
    Moved moved;
    moved.rest =
        io::loadAnimatedScene(write(folderOf("gltf") / (name + ".glb"), b.glb()), {}, moved.animation);
    return moved;
}

TEST(GltfAnimation, StepHoldsTheKeyBefore) {
    GltfBuilder b = movedNode();
    addTrack(b, "translation", "STEP", {1, 2}, {0, 5, 0, 0, 7, 0});
    const Moved moved = load(b, "step");
    expectNear(moved.origin(0), {1, 5, 0});
    expectNear(moved.origin(1.99f), {1, 5, 0});
    expectNear(moved.origin(2), {1, 7, 0});
    expectNear(moved.origin(9), {1, 7, 0});
    EXPECT_EQ(moved.animation.clips.at(0).duration, 2);
}

TEST(GltfAnimation, LinearMovesCameraAndLightToo) {
    GltfBuilder b = movedNode();
    addTrack(b, "translation", "LINEAR", {0, 2}, {0, 0, 0, 0, 4, 8});
    addTrack(b, "scale", "LINEAR", {0, 2}, {1, 1, 1, 3, 1, 1});
    const Moved moved = load(b, "linear");
    expectNear(moved.origin(0.5f), {1.5f, 1, 2});
    const Scene scene = moved.at(0.5f);
    expectNear(scene.cameras.at(0).eye, {0, 1, 2});
    expectNear(scene.cameras.at(0).target, {0, 1, 1});
    expectNear(scene.lights.at(0).position, {0, 1, 2});
    expectNear(scene.lights.at(0).direction, {0, 0, -1});
}

TEST(GltfAnimation, RotationsTurnEvenlyTheShortWay) {
    GltfBuilder b = movedNode();
    const float s = std::sqrt(0.5f);
    addTrack(b, "rotation", "LINEAR", {0, 3}, {0, 0, 0, 1, 0, 0, -s, -s});  // 90 degrees about z, negated
    const Moved moved = load(b, "slerp");
    const float angle = 3.14159265f / 6;
    expectNear(moved.origin(1), {std::cos(angle), std::sin(angle), 0});
    expectNear(moved.origin(3), {0, 1, 0});
}

TEST(GltfAnimation, CubicSplinesFollowTheirSlopes) {
    GltfBuilder b = movedNode();
    // y = t^3 on [0, 2]: slopes 0 and 12 per second, values 0 and 8.
    addTrack(b, "translation", "CUBICSPLINE", {0, 2},
             {0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 9, 0});
    const Moved moved = load(b, "cubic");
    for (const float t : {0.0f, 0.25f, 1.0f, 1.5f, 2.0f}) expectNear(moved.origin(t), {1, t * t * t, 0});
}

TEST(GltfAnimation, APoseIsTheFileOfThatPoseBitForBit) {
    GltfBuilder b = movedNode();
    addTrack(b, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0.5f, 1, -2});
    addTrack(b, "scale", "LINEAR", {0, 1}, {1, 1, 1, -2, 1, 3});
    b.json["nodes"][1]["scale"] = {-1, 1, 1};  // the importer mirrors the mesh instead
    b.json["nodes"][0]["scale"] = {2, 1, 1};
    GltfBuilder still = b;
    b.json["animations"][0]["channels"].erase(1);
    still.json.erase("animations");
    still.json["nodes"][0]["translation"] = {0.25, 0.5, -1};
    const Scene posed = load(b, "posed").at(0.5f);
    Scene wanted = loadGlb(still, "still");
    wanted.instances.at(0).dynamic = true;  // that of the clip is
    EXPECT_TRUE(posed.instances == wanted.instances);
    EXPECT_TRUE(posed.cameras == wanted.cameras);
    EXPECT_TRUE(posed.lights == wanted.lights);
}

TEST(GltfAnimation, WhatAClipMovesIsDynamic) {
    GltfBuilder b = movedNode();
    b.node({{"mesh", 0}});  // stands still
    b.json["scenes"][0]["nodes"] = {0, 2};
    EXPECT_FALSE(load(b, "unmoved").rest.instances.at(0).dynamic);
    addTrack(b, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0});
    const Scene scene = load(b, "moving").rest;
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_TRUE(scene.instances[0].dynamic);  // below the node that moves
    EXPECT_FALSE(scene.instances[1].dynamic);
}

TEST(GltfAnimation, AnInstanceOfNoSizeIsInvisible) {
    GltfBuilder b = movedNode();
    addTrack(b, "scale", "LINEAR", {0, 1}, {1, 1, 1, 0, 0, 0});
    const Moved moved = load(b, "vanishes");
    EXPECT_TRUE(moved.at(0.5f).instances[0].visible);
    const Scene gone = moved.at(1);
    EXPECT_FALSE(gone.instances[0].visible);
    EXPECT_NO_THROW(gone.validate());
}

TEST(GltfAnimation, ClipsHaveNamesAndNumbers) {
    GltfBuilder b = movedNode();
    const Moved moved = load(b, "names");
    EXPECT_EQ(io::clipNumber(moved.animation, "go"), 0u);
    EXPECT_EQ(io::clipNumber(moved.animation, "0"), 0u);
    for (const char* wrong : {"1", "gone", "-1", ""}) try {
            io::clipNumber(moved.animation, wrong);
            ADD_FAILURE() << wrong;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("go (0)"), std::string::npos) << error.what();
        }
}

std::string refusal(const GltfBuilder& b) {
    try {
        load(b, "refused");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        return error.what();
    }
    return "(accepted)";
}

void expectRefused(const std::vector<float>& times, const std::vector<float>& values, const std::string& why,
                   const std::function<void(Json& sampler, Json& file)>& spoil = nullptr) {
    GltfBuilder b = movedNode();
    Json sampler = addTrack(b, "translation", "LINEAR", times, values);
    if (spoil) spoil(sampler, b.json);
    b.json["animations"][0]["samplers"][0] = sampler;
    const std::string said = refusal(b);
    EXPECT_NE(said.find(why), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
}

TEST(GltfAnimation, RefusesWhatCannotBeUsed) {
    const std::vector<float> two = {0, 0, 0, 1, 1, 1};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expectRefused({1, 1}, two, "is not after the one before");
    expectRefused({2, 1}, two, "is not after the one before");
    expectRefused({-1, 1}, two, "time 0 is negative");
    expectRefused({0, nan}, two, "is not a finite number");
    expectRefused({0, 1}, {0, 0, 0, nan, 0, 0}, "is not a finite number");
    expectRefused({0, 1, 2}, two, "has 2 values; 3 would be right");
    expectRefused({0, 1}, two, "interpolation", [](Json& s, Json&) { s["interpolation"] = "SMOOTH"; });
    expectRefused({0, 1}, two, "samplers[0].input", [](Json& s, Json&) { s["input"] = 999; });
    expectRefused({0, 1}, two, "samplers[0].output", [](Json& s, Json&) { s.erase("output"); });
    expectRefused({0, 1}, two, "componentType", [](Json& s, Json& file) {
        file["accessors"][s["input"].get<std::size_t>()]["componentType"] = 5125;
    });
    expectRefused({0, 1}, two, "path", [](Json&, Json& file) {
        file["animations"][0]["channels"][0]["target"]["path"] = "colour";
    });
    expectRefused({0, 1}, two, "channels[0].sampler",
                  [](Json&, Json& file) { file["animations"][0]["channels"][0]["sampler"] = 4; });
}

}  // namespace
}  // namespace conelight
