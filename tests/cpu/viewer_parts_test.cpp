// SPDX-License-Identifier: MIT
// What of the viewer needs no window: how input moves the camera, how coarse moving pictures are, how noisy a
// picture is, what is remembered between runs; and of its session, objects that come and go.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "session/lengths.h"
#include "session/session.h"
#include "session/state_files.h"
#include "support/gl_fixture.h"
#include "viewer/camera_control.h"
#include "viewer/face_budget.h"
#include "viewer/moving_resolution.h"
#include "viewer/picture_noise.h"

namespace conelight::test {
namespace {

TEST(CameraControl, OrbitKeepsTheDistanceAndFlyKeepsTheDirection) {
    Camera camera;
    camera.eye = {1, 2, 5};
    camera.target = {0, 1, 0};
    const float distance = glm::length(camera.target - camera.eye);
    Camera turned = camera;
    program::orbit(turned, {0.5f, -0.2f});
    EXPECT_EQ(turned.target, camera.target);
    EXPECT_NEAR(glm::length(turned.target - turned.eye), distance, 1e-4f);
    Camera flown = camera;
    program::fly(flown, {{0, 0, 1}, {0, 0}, 0.5f, 2.0f});
    const glm::vec3 before = glm::normalize(camera.target - camera.eye);
    EXPECT_NEAR(glm::dot(before, glm::normalize(flown.target - flown.eye)), 1, 1e-5f);
    EXPECT_NEAR(glm::dot(flown.eye - camera.eye, before), 1, 1e-4f);  // half a second at 2 m/s
    // Pitch stops short of the pole.
    program::orbit(turned, {0, 10});
    EXPECT_LT(std::fabs(program::viewAngles(turned).pitch), program::kMaxPitch + 1e-3f);
}

TEST(CameraControl, ItsOwnUpIsKept) {
    struct Case {
        glm::vec3 eye, up, axis;
    };
    const glm::vec3 rolled = glm::normalize(glm::vec3(1, 2, 0.5f));
    const Case cases[] = {
        {{1, 2, 5}, {0, 1, 0}, {0, 1, 0}},
        {{0, 3, 3}, {0, 0.70710678f, -0.70710678f}, {0, 1, 0}},  // of a file: across the view, level
        {{4, 1, 2}, {0, 0, 1}, {0, 0, 1}},                       // z is up
        {{1, 2, 5}, {0, -1, 0}, {0, -1, 0}},                     // upside down
        {{1, 0, 5}, rolled, rolled},
        {{0, 5, 0}, {0, 0, -1}, {0, 1, 0}}};  // straight down
    for (const Case& one : cases) {
        Camera camera;
        camera.eye = one.eye;
        camera.up = one.up;
        EXPECT_NEAR(glm::distance(program::turnAxis(camera), one.axis), 0, 1e-5f);
        const float height = glm::dot(camera.eye, one.axis), distance = glm::length(camera.eye);
        for (int i = 0; i < 5; ++i) program::orbit(camera, {0.4f, 0});
        if (height < distance) {
            EXPECT_NEAR(glm::dot(camera.eye, one.axis), height, 1e-4f) << "round its axis";
        }
        EXPECT_NEAR(glm::length(camera.eye), distance, 1e-4f);
        EXPECT_NEAR(glm::distance(camera.up, one.axis), 0, 1e-5f);
        const glm::vec3 before = camera.eye;
        program::fly(camera, {{0, 1, 0}, {0, 0}, 1.0f, 2.0f});
        EXPECT_NEAR(glm::distance(camera.eye - before, 2.0f * one.axis), 0, 1e-4f) << "upwards is its own";
        program::pan(camera, {0, 100}, 100);
        EXPECT_GT(glm::dot(camera.eye - before, one.axis), 0);
    }
}

TEST(CameraControl, FocusShowsAllOfABox) {
    Camera camera;
    Aabb box;
    box.grow({-1, -2, -3});
    box.grow({4, 5, 6});
    program::focusOn(camera, box, 0.5f);
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const float half = std::atan(std::tan(0.5f * camera.fovY) * 0.5f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? 4 : -1, (corner & 2) ? 5 : -2, (corner & 4) ? 6 : -3);
        const float angle = std::acos(glm::dot(glm::normalize(p - camera.eye), forward));
        EXPECT_LT(angle, half + 1e-4f) << corner;
    }
}

TEST(Lengths, AreRoundAndHaveAUnit) {
    for (const auto& [most, round, text] : {std::tuple(0.31f, 0.2f, "20 cm"),
                                            {0.5f, 0.5f, "50 cm"},
                                            {1.0f, 1.0f, "1 m"},
                                            {4999.0f, 2000.0f, "2 km"},
                                            {0.0099f, 0.005f, "5 mm"},
                                            {3e-6f, 2e-6f, "2 um"},
                                            {73.0f, 50.0f, "50 m"}}) {
        EXPECT_NEAR(program::roundLengthBelow(most), round, 1e-4f * round);
        EXPECT_EQ(program::lengthText(round), text);
    }
}

// Frames whose cost is `fixed` plus `perPicture` at full resolution; the level after some of them.
int levelAfterFrames(program::MovingResolution& resolution, double fixed, double perPicture,
                     int frames = 40) {
    for (int i = 0; i < frames; ++i)
        resolution.measured(fixed + perPicture * resolution.scale() * resolution.scale());
    return resolution.level();
}

TEST(MovingResolution, IsAsFineAsTheTimeAllows) {
    program::MovingResolution cheap(100), dear(100);
    EXPECT_EQ(levelAfterFrames(cheap, 1, 20), 0);
    const int level = levelAfterFrames(dear, 1, 1000);
    EXPECT_LE(1 + 1000 * std::exp2(-level), 100);
    EXPECT_GT(1 + 1000 * std::exp2(-(level - 1)), 80) << "one finer would not fit";
    // Cheaper again, after the camera stood: finer again.
    dear.begin(0);
    EXPECT_EQ(levelAfterFrames(dear, 1, 20), 0);
}

TEST(MovingResolution, BeginsWhereThePictureAtRestSays) {
    program::MovingResolution resolution(100);
    resolution.begin(790);
    EXPECT_EQ(resolution.level(), 3) << "an eighth of the pixels";
    resolution.begin(20);
    EXPECT_EQ(resolution.level(), 0);
}

TEST(MovingResolution, OneSlowFrameIsForgotten) {
    program::MovingResolution resolution(100);
    resolution.begin(300);
    resolution.measured(500);
    EXPECT_EQ(levelAfterFrames(resolution, 1, 20), 0);
}

TEST(FaceBudget, KeepsUpdatesShortAndLeavesFastOnesAlone) {
    program::FaceBudget fast(25), slow(25);
    fast.measured(20);
    EXPECT_EQ(fast.faces(), 0) << "all";
    slow.measured(250);
    const double msPerFace = 0.01;
    for (int i = 0; i < 20; ++i) slow.measured(msPerFace * slow.faces());
    EXPECT_GT(slow.faces(), 0);
    EXPECT_LE(msPerFace * slow.faces(), 50);
    EXPECT_GE(msPerFace * slow.faces(), 10);
    const int settled = slow.faces();
    slow.measured(msPerFace * settled);
    EXPECT_EQ(slow.faces(), settled) << "it rests";
}

TEST(MovingResolution, FewerPixelsThanPayAreNotChosen) {
    program::MovingResolution resolution(100);
    const int level = levelAfterFrames(resolution, 300, 40);
    EXPECT_LE(level, 2) << "most of the cost is not the pixels'";
    const int later = levelAfterFrames(resolution, 300, 40, 1);
    EXPECT_EQ(level, later) << "it rests";
}

class StateFilesTest : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = scratchDir() + "/state";
        std::filesystem::remove_all(folder);
        setenv("XDG_STATE_HOME", folder.c_str(), 1);
    }
    void TearDown() override { unsetenv("XDG_STATE_HOME"); }
    std::string folder;
};

TEST_F(StateFilesTest, ScenesAndLinesAreKeptForTheNextRun) {
    program::StateFiles one(true);
    EXPECT_TRUE(one.recent().empty());
    one.opened("builtin:cornell");
    one.opened("a/../b.gltf");
    one.opened("builtin:cornell");
    one.typed("mode cones");
    program::StateFiles other(true);
    ASSERT_EQ(other.recent().size(), 2u) << "each once";
    EXPECT_EQ(other.recent()[0], "builtin:cornell") << "newest first";
    EXPECT_EQ(other.recent()[1], (std::filesystem::current_path() / "b.gltf").string());
    EXPECT_EQ(other.lines(), std::vector<std::string>{"mode cones"});
    for (std::size_t i = 0; i < 3 * program::StateFiles::kLines; ++i)
        other.typed("line " + std::to_string(i));
    EXPECT_EQ(other.lines().size(), program::StateFiles::kLines);
    EXPECT_EQ(other.lines().back(), "line " + std::to_string(3 * program::StateFiles::kLines - 1));
    for (int i = 0; i < 30; ++i) other.opened("builtin:" + std::to_string(i));
    EXPECT_EQ(program::StateFiles(true).recent().size(), program::StateFiles::kRecent);
}

TEST_F(StateFilesTest, NothingIsKeptWhenNotWanted) {
    program::StateFiles none(false);
    none.opened("builtin:cornell");
    none.typed("help");
    EXPECT_FALSE(std::filesystem::exists(folder));
    // A folder that cannot be made is no failure.
    std::ofstream(folder) << "a file";
    program::StateFiles blocked(true);
    blocked.opened("builtin:cornell");
    EXPECT_TRUE(blocked.recent().empty());
    std::filesystem::remove(folder);
}

// Means over passes of independent noise: its standard deviation falls with the root of their number.
TEST(PictureNoise, IsThatOfTheMean) {
    constexpr int kPixels = 2000, kPasses = 24;
    constexpr float kMean = 2, kDeviation = 0.5f;
    std::mt19937 random(7);
    std::normal_distribution<float> sample(kMean, kDeviation);
    Image sum{kPixels, 1, std::vector<glm::vec4>(kPixels, glm::vec4(0))}, mean = sum;
    program::PictureNoise noise;
    for (int pass = 1; pass <= kPasses; ++pass) {
        for (std::size_t i = 0; i < kPixels; ++i) {
            for (int c = 0; c < 3; ++c) sum.pixels[i][c] += sample(random);
            mean.pixels[i] = sum.pixels[i] / static_cast<float>(pass);
        }
        mean.pixels[5].x = std::numeric_limits<float>::quiet_NaN();
        noise.follow(pass, [&]() -> const Image& { return mean; });
        EXPECT_EQ(noise.value().has_value(), pass >= 12) << pass;
        if (pass != 12 && pass != 24) continue;
        const double expected = static_cast<double>(kDeviation / kMean) / std::sqrt(pass);
        EXPECT_NEAR(*noise.value(), expected, 0.05 * expected) << pass;
    }
    noise.follow(1, [&]() -> const Image& { return mean; });
    EXPECT_FALSE(noise.value()) << "another picture";
}

TEST(Session, ObjectsAreAddedAndRemovedWithUndo) {
    Scene scene;
    scene.meshes.resize(2);
    for (const char* name : {"a", "b", "c"}) scene.instances.push_back({.name = name, .mesh = 0});
    program::Session session(scene, "test", Settings{}, "", Camera{});
    const auto names = [&] {
        std::string all;
        for (const Instance& one : session.scene().instances) all += one.name;
        return all + std::to_string(session.instanceRevisions().size());
    };
    session.select({program::SelectionKind::Instance, 2});
    const std::uint64_t tables = session.revisions().sceneTables();
    session.setInstanceList({scene.instances[0], scene.instances[2]}, "delete");
    EXPECT_EQ(names(), "ac2");
    EXPECT_EQ(session.selection(), program::Selection{}) << "its number is another object's";
    EXPECT_NE(session.revisions().sceneTables(), tables);
    EXPECT_TRUE(session.unsaved());
    // As many as before, of other meshes: a renderer must take them as a new list.
    const std::uint64_t list = session.revisions().instanceList;
    session.setInstanceList({scene.instances[0], {.name = "d", .mesh = 1}}, "other");
    EXPECT_NE(session.revisions().instanceList, list);
    EXPECT_EQ(session.undo(), "other");
    EXPECT_EQ(session.undo(), "delete");
    EXPECT_EQ(names(), "abc3");
    EXPECT_FALSE(session.unsaved());
    EXPECT_EQ(session.redo(), "delete");
    EXPECT_EQ(names(), "ac2");
}

}  // namespace
}  // namespace conelight::test
