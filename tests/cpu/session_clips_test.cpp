// SPDX-License-Identifier: MIT
// Clips in a session: poses, the clock, rest, the camera that goes along, what is refused; and as commands.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "console/console.h"
#include "session/session.h"

namespace conelight::program {
namespace {

// A triangle, a lamp and a camera on node 0, which moves by 2 m along x within a second; and, without movement, a
// triangle that grows by a morph target meanwhile. A second clip holds still.
Session movingSession() {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    scene.meshes = {mesh, mesh};
    scene.materials.resize(1);
    scene.instances = {{"moves", 0, 0, glm::mat4(1)}, {"grows", 1, 0, glm::mat4(1)}};
    scene.lights.emplace_back();
    scene.lights[0].position = {0, 0, 0};
    scene.cameras.push_back(Camera{"front"});
    io::SceneAnimation animation;
    animation.nodes.resize(2);
    animation.parentsFirst = {0, 1};
    io::NodeTrack moves, grows;
    moves.times = grows.times = {0, 1};
    moves.values = {{0, 0, 0, 0}, {2, 0, 0, 0}};
    grows.node = 1;
    grows.value = io::NodeValue::Weights;
    grows.weights = {0, 1};
    animation.clips = {{"go", 1, {moves, grows}}, {"stay", 0.5f, {}}};
    animation.instances = {{0, 0}, {1, 1}};
    animation.lights = {{0, 0}};
    animation.cameras = {{0, 0}};
    io::DeformedMesh moving;
    moving.mesh = 1;
    moving.node = 1;
    moving.bind.positions = mesh.positions;
    moving.weights = {0};
    moving.targets.push_back({{{0, 0, 4}, {0, 0, 4}, {0, 0, 4}}, {}, {}});
    animation.meshes.push_back(moving);
    io::placeCamera(scene.cameras[0], glm::mat4(1), 1);
    const Camera camera = scene.cameras[0];
    Session session(std::move(scene), "moving.glb", Settings{}, "phong", camera);
    session.setAnimation(animation);
    return session;
}

float place(const Session& session) { return session.scene().instances[0].worldFromObject[3].x; }
float height(const Session& session) { return session.scene().meshes[1].positions[0].z; }

TEST(SessionClips, APoseMovesAllThatHangsOnIt) {
    Session session = movingSession();
    const Revisions before = session.revisions();
    session.poseClip(0, 0.25);
    EXPECT_FLOAT_EQ(place(session), 0.5f);
    EXPECT_FLOAT_EQ(height(session), 1);
    EXPECT_FLOAT_EQ(session.scene().lights[0].position.x, 0.5f);
    EXPECT_FLOAT_EQ(session.camera().eye.x, 0.5f);
    const Revisions& now = session.revisions();
    EXPECT_GT(now.transforms, before.transforms);
    EXPECT_GT(now.meshes, before.meshes);
    EXPECT_GT(now.lights, before.lights);
    EXPECT_EQ(now.materials, before.materials);
    EXPECT_EQ(session.meshRevisions()[0], 0u);
    EXPECT_EQ(session.meshRevisions()[1], 1u);
    EXPECT_EQ(session.undoSteps(), 0u);
    EXPECT_FALSE(session.unsaved());
    session.poseClip(0, 0.25);  // the same: nothing is made anew
    EXPECT_EQ(session.revisions(), now);
    session.restClip();
    EXPECT_EQ(place(session), 0);
    EXPECT_EQ(height(session), 0);
    EXPECT_EQ(session.camera().eye.x, 0);
}

TEST(SessionClips, WhoLooksElsewhereIsNotMoved) {
    Session session = movingSession();
    session.poseClip(0, 0.5);
    Camera own = session.camera();
    own.eye.y += 3;
    session.moveCamera(own);
    session.poseClip(0, 1);
    EXPECT_EQ(session.camera(), own);
}

TEST(SessionClips, TheClockPlaysLoopsAndHolds) {
    Session session = movingSession();
    session.stepClip(0.3);
    EXPECT_EQ(place(session), 0);  // nothing plays
    session.playClip(0);
    session.stepClip(0.25);
    session.stepClip(0.25);
    EXPECT_FLOAT_EQ(place(session), 1);
    session.stepClip(0.75);
    EXPECT_FLOAT_EQ(place(session), 0.5f);  // begun again
    session.stopClip();
    session.stepClip(0.25);
    EXPECT_FLOAT_EQ(place(session), 0.5f);
    session.setClipLoops(false);
    session.playClip(0);  // goes on
    session.stepClip(5);
    EXPECT_FLOAT_EQ(place(session), 2);
    EXPECT_FALSE(session.clipState().playing);
    session.playClip(0);  // from the start
    EXPECT_EQ(place(session), 0);
}

TEST(SessionClips, HiddenObjectsStayHidden) {
    Session session = movingSession();
    Instance hidden = session.scene().instances[0];
    hidden.visible = false;
    session.setInstances({{0, hidden}}, "hide");
    session.poseClip(0, 1);
    EXPECT_FALSE(session.scene().instances[0].visible);
    EXPECT_FLOAT_EQ(place(session), 2);
}

TEST(SessionClips, WhatTheClipDoesNotMoveStaysWhereItWasPut) {
    Session session = movingSession();
    Instance put = session.scene().instances[1];
    put.worldFromObject = glm::translate(glm::mat4(1), {0, 0, 9});
    session.setInstances({{1, put}}, "translate");
    session.poseClip(0, 0.5);
    session.poseClip(0, 1);
    session.restClip();
    EXPECT_EQ(session.scene().instances[1].worldFromObject[3].z, 9);
    EXPECT_EQ(place(session), 0);
    Light lamp = session.scene().lights[0];
    lamp.position = {0, 5, 0};
    session.setLights({lamp}, "translate");
    session.poseClip(1, 0.25);  // which moves nothing
    EXPECT_EQ(session.scene().lights[0].position.y, 5);
}

TEST(SessionClips, PlayingEndsWhenObjectsComeOrGo) {
    Session session = movingSession();
    session.playClip(0);
    session.setInstanceList({session.scene().instances[0]}, "delete");
    EXPECT_NO_THROW(session.stepClip(0.25));
    EXPECT_FALSE(session.clipState().playing);
    EXPECT_FALSE(session.clipsFit());
}

TEST(SessionClips, RefusesWhatDoesNotFit) {
    Session session = movingSession();
    EXPECT_THROW(session.poseClip(7, 0), Error);
    session.setInstanceList({session.scene().instances[1]}, "remove");
    EXPECT_THROW(session.poseClip(0, 0), Error);
    session.restClip();  // nothing happens
    Session still;
    EXPECT_THROW(still.playClip(0), Error);
}

TEST(SessionClips, Commands) {
    Session session = movingSession();
    std::string said, failed;
    Console console(session,
                    [&](const ConsoleLine& line) { (line.isError ? failed : said) += line.text + "\n"; });
    const auto run = [&](const std::string& line) {
        said.clear();
        failed.clear();
        console.submit(line, "test");
        console.runQueued();
    };
    run("clip at 0.5; clip");
    EXPECT_FLOAT_EQ(place(session), 1);
    EXPECT_NE(said.find("0 go: 1 s, at 0.500 s"), std::string::npos) << said;
    EXPECT_NE(said.find("1 stay: 0.5 s"), std::string::npos) << said;
    run("clip play stay");
    EXPECT_TRUE(session.clipState().playing);
    EXPECT_EQ(session.clipState().clip, 1u);
    run("clip stop; clip loop off; clip show go");
    EXPECT_FALSE(session.clipState().playing || session.clipState().loops);
    EXPECT_EQ(place(session), 0);
    for (const char* wrong :
         {"clip show run", "clip at", "clip at x", "clip at -1", "clip loop maybe", "clip jump"}) {
        run(wrong);
        EXPECT_NE(failed, "") << wrong;
    }
    run("clip at 1; clip rest");
    EXPECT_EQ(place(session), 0);
    EXPECT_FALSE(session.clipState().posed);
}

}  // namespace
}  // namespace conelight::program
