// SPDX-License-Identifier: MIT
// Camera paths: what they pass through, how smoothly, and what a file of one may hold.
#include "session/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "conelight/error.h"
#include "cpu/io_test_support.h"
#include "io/files.h"

namespace conelight::program {
namespace {

Camera looking(const glm::vec3& eye, const glm::vec3& target, float fovDeg = 45) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.fovY = glm::radians(fovDeg);
    return camera;
}

CameraPath walk() {
    CameraPath path;
    path.add(0, looking({0, 1, 5}, {0, 1, 0}));
    path.add(1, looking({2, 1, 4}, {2, 1, 0}, 50));
    path.add(3, looking({2.2f, 1.5f, 3.9f}, {5, 1, 3.9f}, 60));
    path.add(4, looking({6, 1, 0}, {6, 1, -3}, 30));
    return path;
}

bool same(const Camera& a, const Camera& b) {
    return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fovY == b.fovY && a.zNear == b.zNear &&
           a.zFar == b.zFar;
}

glm::dvec3 direction(const Camera& camera) {
    return glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
}

TEST(CameraPath, PassesThroughItsKeysBitForBitAndStaysAtItsEnds) {
    const CameraPath path = walk();
    for (const PathKey& key : path.keys()) EXPECT_TRUE(same(path.at(key.seconds), key.camera)) << key.seconds;
    EXPECT_TRUE(same(path.at(-1), path.keys().front().camera));
    EXPECT_TRUE(same(path.at(99), path.keys().back().camera));
    EXPECT_TRUE(same(path.frame(0, 5), path.at(0)));
    EXPECT_TRUE(same(path.frame(1, 5), path.at(1)));
    EXPECT_TRUE(same(path.frame(4, 5), path.at(4)));
    EXPECT_TRUE(same(path.frame(0, 1), path.at(0)));
}

// Position, direction and field of view have no jump in value or in speed, at the keys above all.
TEST(CameraPath, ValuesAndSpeedsAreContinuous) {
    const CameraPath path = walk();
    constexpr double kStep = 1e-3;
    const auto speed = [&](double t, auto of) { return (of(path.at(t + kStep)) - of(path.at(t))) / kStep; };
    const auto eye = [](const Camera& c) { return glm::dvec3(c.eye); };
    const auto view = [](const Camera& c) { return direction(c); };
    for (const double key : {1.0, 3.0}) {
        EXPECT_LT(glm::distance(speed(key - kStep, eye), speed(key, eye)), 0.08) << key;
        EXPECT_LT(glm::distance(speed(key - kStep, view), speed(key, view)), 0.05) << key;
    }
    for (double t = 0; t < 4; t += 0.01) {
        EXPECT_LT(glm::length(eye(path.at(t + 0.01)) - eye(path.at(t))), 0.15) << t;
        EXPECT_LT(glm::length(view(path.at(t + 0.01)) - view(path.at(t))), 0.06) << t;
    }
}

TEST(CameraPath, NothingOvershoots) {
    const CameraPath path = walk();
    double before = -1;
    for (double t = 0; t <= 4; t += 0.02) {
        const Camera camera = path.at(t);
        const double fov = glm::degrees(camera.fovY);
        if (t <= 1) {
            EXPECT_TRUE(fov >= 45 - 1e-4 && fov <= 50 + 1e-4) << t;
        }
        EXPECT_TRUE(fov >= 30 - 1e-4 && fov <= 60 + 1e-4) << t;
        // All keys go to the right: so does the way, without turning back.
        EXPECT_GE(camera.eye.x, before - 1e-5) << t;
        before = camera.eye.x;
        EXPECT_EQ(camera.up, glm::vec3(0, 1, 0)) << t;  // level keys, level camera
    }
}

TEST(CameraPath, AStandingCameraTurnsOnTheSpotAndEvenBackward) {
    CameraPath path;
    path.add(0, looking({1, 2, 3}, {1, 2, 0}));
    path.add(1, looking({1, 2, 3}, {4, 2, 3}));
    path.add(2, looking({1, 2, 3}, {1, 2, 6}));
    for (double t = 0; t <= 2; t += 0.05) {
        const Camera camera = path.at(t);
        EXPECT_LT(glm::distance(camera.eye, glm::vec3(1, 2, 3)), 1e-6f);
        EXPECT_NEAR(glm::length(camera.target - camera.eye), 3, 1e-4);
        EXPECT_NEAR(camera.target.y, 2, 1e-4) << t;  // stays level
    }
    // Equal turns in equal times: a constant 90 degrees a second.
    const glm::dvec3 half = direction(path.at(0.5));
    EXPECT_NEAR(half.x, std::sqrt(0.5), 1e-4);
    EXPECT_NEAR(half.z, -std::sqrt(0.5), 1e-4);
}

TEST(CameraPath, OneTargetStaysInTheMiddle) {
    CameraPath path;
    for (int i = 0; i < 4; ++i) {
        const float a = 1.2f * static_cast<float>(i);
        path.add(i, looking({3 * std::sin(a), 1, 3 * std::cos(a)}, {0, 0.5f, 0}));
    }
    for (double t = 0; t <= 3; t += 0.1) EXPECT_EQ(path.at(t).target, glm::vec3(0, 0.5f, 0)) << t;
}

TEST(CameraPath, TimesAreKeptInOrderAndReplaced) {
    CameraPath path;
    path.add(2, looking({2, 0, 0}, {0, 0, 0}));
    path.add(1, looking({1, 0, 0}, {0, 0, 0}));
    path.add(2, looking({3, 0, 0}, {0, 0, 0}));
    ASSERT_EQ(path.keys().size(), 2u);
    EXPECT_EQ(path.keys()[0].seconds, 1);
    EXPECT_EQ(path.keys()[1].camera.eye.x, 3);
    path.remove(0);
    EXPECT_EQ(path.start(), 2);
}

TEST(CameraPath, HoursRunBetweenTheKeysThatHaveOne) {
    CameraPath path = walk();
    EXPECT_FALSE(path.hourAt(1));
    path.add(1, looking({2, 1, 4}, {2, 1, 0}), 12);
    path.add(4, looking({6, 1, 0}, {6, 1, -3}), 30);
    EXPECT_EQ(path.hourAt(0), 12);  // before the first of them
    EXPECT_EQ(path.hourAt(1), 12);
    EXPECT_EQ(path.hourAt(4), 6);  // of the next day
    double before = 12;
    for (double t = 1; t < 3; t += 0.1) {
        EXPECT_GE(*path.hourAt(t), before) << t;
        before = *path.hourAt(t);
    }
    path.add(4, looking({6, 1, 0}, {6, 1, -2}));  // another view keeps the hour
    EXPECT_EQ(path.hourAt(4), 6);
}

TEST(CameraPathFile, ComesBackBitForBit) {
    const std::string file = (test::folderOf("camera_path") / "walk.json").string();
    std::filesystem::remove(file);
    CameraPath path = walk();
    path.add(0.1, looking({1.0f / 3, 1e-7f, 12345.678f}, {0.1f, 0.2f, 0.3f}, 33.3f), 20.1);
    writeCameraPath(file, path, false);
    const CameraPath read = readCameraPath(file);
    ASSERT_EQ(read.keys().size(), path.keys().size());
    for (std::size_t i = 0; i < path.keys().size(); ++i) {
        EXPECT_EQ(read.keys()[i].seconds, path.keys()[i].seconds);
        EXPECT_TRUE(same(read.keys()[i].camera, path.keys()[i].camera)) << i;
        EXPECT_EQ(read.keys()[i].hour, path.keys()[i].hour) << i;
    }
    EXPECT_THROW(writeCameraPath(file, path, false), Error);
    EXPECT_NO_THROW(writeCameraPath(file, path, true));
}

TEST(CameraPathFile, BadOnesAreRefusedByOneLineWithItsNumber) {
    const std::string file = (test::folderOf("camera_path") / "bad.json").string();
    const std::string head = "{\n \"conelight\": \"camera path\",\n \"keys\": [\n";
    const std::string key = "  {\"eye\": [0,0,1], \"target\": [0,0,0]}";
    const std::pair<std::string, std::string> cases[] = {
        {"{", ":1: is not JSON"},
        {"{}", "is no camera path"},
        {"[]", "is no camera path"},
        {"{\"conelight\": \"camera path\"}", "at least one key"},
        {head + "]\n}", ":3: keys: a list of at least one key"},
        {head + key + ",\n  7]}", ":5: key 1 is no object"},
        {head + key + ",\n  {\"eye\": [0,0,1]}]}", ":5: key 1 has no target"},
        {head + key + ",\n  {\"eye\": [0,0,1], \"target\": [0,0,1]}]}",
         ":5: key 1: eye and target are the same"},
        {head + "  {\"eye\": [0,0,1],\n   \"target\": [0,0]}]}", ":5: key 0, target: [0,0] is not usable"},
        {head + "  {\"eye\": [0,0,1],\n   \"target\": [0,\n0,\n\"a\"]}]}",
         ":7: key 0, target: \"a\" is not usable"},
        {head + "  {\"eye\": [0,0,1], \"target\": [0,0,0],\n   \"fov\": 0}]}",
         ":5: key 0, fov: 0 is not usable"},
        {head + "  {\"eye\": [0,0,1], \"target\": [0,0,0],\n   \"zoom\": 0}]}",
         ":5: key 0 has no field 'zoom'"},
        {head + "  {\"eye\": [0,0,1], \"target\": [0,0,0], \"hour\": 49}]}",
         ":4: key 0, hour: 49 is not usable"},
        {head + "  {\"eye\": [0,0,1], \"eye\": [0,0,0]}]}", ":4: 'eye' stands twice"},
        {head + "  {\"eye\": [0,0,1], \"target\": [0,0,0], \"up\": [0,0,0]}]}",
         ":4: key 0: up has no length"},
        {head + "  {\"time\": 1, \"eye\": [0,0,1], \"target\": [0,0,0]},\n  {\"time\": 1, \"eye\": [0,0,1], "
                "\"target\": [0,0,0]}]}",
         ":5: key 1: time 1 s is not later"},
        {head + "  {\"time\": -1, \"eye\": [0,0,1], \"target\": [0,0,0]}]}", "time: -1 is not usable"},
    };
    for (const auto& [text, expected] : cases) {
        std::ofstream(file) << text;
        try {
            readCameraPath(file);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(error.kind(), ErrorKind::BadInput) << message;
            EXPECT_EQ(message.rfind(file, 0), 0u) << message;
            EXPECT_NE(message.find(expected), std::string::npos) << message << "\nfor\n" << text;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
    EXPECT_THROW(readCameraPath("/nonexistent.json"), Error);
}

}  // namespace
}  // namespace conelight::program
