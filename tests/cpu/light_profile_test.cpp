// SPDX-License-Identifier: MIT
// Profiles of lamps: IES files of every symmetry, files that are wrong, and what lights do with a profile on the CPU.
#include "io/light_profile_file.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/gtc/constants.hpp>

#include "conelight/error.h"
#include "console_test_support.h"
#include "io/files.h"
#include "io/scene_file.h"
#include "io/scene_write.h"
#include "io_test_support.h"
#include "reference/lights.h"
#include "support/lamp_files.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

// With type C and no tilt: `sizes` are the numbers of angles.
std::string ies(const std::string& sizes, const std::string& rest, const std::string& multiplier = "1") {
    return "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n1 -1 " + multiplier + " " + sizes +
           " 1 2 0 0 0\n1 1 20\n" + rest;
}

std::shared_ptr<const LightProfile> parsed(const std::string& text) {
    return io::parseLightProfile("a.ies", text);
}

// Candela along an angle from the axis and one about it, degrees.
float candela(const std::shared_ptr<const LightProfile>& profile, float vertical, float horizontal) {
    Light light;
    io::setLightProfile(light, profile);
    light.direction = {0, 0, -1};
    light.halfU = {1, 0, 0};
    const float theta = glm::radians(vertical), phi = glm::radians(horizontal);
    const glm::vec3 away(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta));
    return profile->candela * intensityFactor(light, away);
}

TEST(LightProfiles, SymmetryUnfolds) {
    const auto round = parsed(ies("3 1", "0 45 90\n0\n100 50 0\n", "2"));
    EXPECT_FLOAT_EQ(round->candela, 200);
    for (const float about : {0.0f, 77.0f, 200.0f, 359.0f}) {
        EXPECT_NEAR(candela(round, 0, about), 200, 1e-2f);
        EXPECT_NEAR(candela(round, 45, about), 100, 1e-2f);
        EXPECT_NEAR(candela(round, 67.5f, about), 50, 1e-2f);
        EXPECT_EQ(candela(round, 120, about), 0);
    }
    const auto quarter = parsed(ies("2 3", "0,90\n0 45 90\n10 10\n10 20\n10 40\n"));
    for (const float about : {30.0f, 150.0f, 210.0f, 330.0f})
        EXPECT_NEAR(candela(quarter, 90, about), 50 / 3.0f, 0.01f);
    EXPECT_NEAR(candela(quarter, 90, 270), 40, 0.01f);
    const auto half = parsed(ies("2 3", "0 90\n0 90 180\n10 10\n10 20\n10 40\n"));
    EXPECT_NEAR(candela(half, 90, 45), 15, 0.01f);
    EXPECT_NEAR(candela(half, 90, 315), 15, 0.01f);
    EXPECT_NEAR(candela(half, 90, 180), 40, 0.01f);
    const auto whole = parsed(ies("2 5", "0 90\n0 90 180 270 360\n10 10\n10 20\n10 40\n10 60\n10 10\n"));
    EXPECT_NEAR(candela(whole, 90, 270), 60, 0.01f);
    EXPECT_NEAR(candela(whole, 90, 315), 35, 0.01f);
    // Some files leave the last plane out.
    const auto open = parsed(ies("2 4", "0 90\n0 90 180 270\n10 10\n10 20\n10 40\n10 60\n"));
    EXPECT_NEAR(candela(open, 90, 315), 35, 0.01f);
}

// Lines that end as those of other systems, commas, values over several lines, ballast factors; planes of 90 to 270.
TEST(LightProfiles, TheWallWasherIsRead) {
    const auto profile = parsed(kWallWasher);
    EXPECT_FLOAT_EQ(profile->candela, 900);
    EXPECT_NEAR(candela(profile, 30, 90), 900, 0.1f);
    EXPECT_NEAR(candela(profile, 30, 270), 50, 0.1f);
    EXPECT_NEAR(candela(profile, 75, 45), 60, 0.1f);
    EXPECT_NEAR(candela(profile, 75, 135), 60, 0.1f);
    EXPECT_NEAR(candela(profile, 30, 0), 200, 0.1f);
}

TEST(LightProfiles, OldFilesAndTiltsAreRead) {
    const auto old =
        parsed("a lamp\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 1 1 2 1 1 1 0 0 0 1 1 20\n0 180\n0\n5 5\n");
    EXPECT_NEAR(candela(old, 100, 10), 5, 1e-4f);
}

TEST(LightProfiles, WrongFilesAreRefusedInOneLine) {
    const std::pair<std::string, const char*> cases[] = {
        {"", "a.ies: line 0: the file is empty"},
        {"hello\nworld\n", "a.ies: line 2: this is no IES file: there is no line TILT="},
        {"IESNA91\n[A] b\n", "a.ies: line 2: there is no line TILT="},
        {ies("3 1", "0 45 90\n0\n100 x 0\n"), "a.ies: line 8: candela value: 'x' is no number"},
        {ies("3 1", "0 45 90\n0\n100 50\n"), "a.ies: line 8: the file ends before candela value"},
        {ies("3 1", "0 45 40\n0\n100 50 0\n"),
         "a.ies: line 6: vertical angle: 40 follows 45; rising ones would be right"},
        {ies("2 1", "0 200\n0\n1 1\n"),
         "a.ies: line 7: vertical angles: two or more from 0 to 180 degrees would be right"},
        {ies("2 2", "0 90\n0 60\n1 1 1 1\n"),
         "a.ies: line 7: horizontal angles from 0 to 60; 0 to 0, 90, 180 or 360 would be right"},
        {ies("1e9 1", ""),
         "a.ies: line 4: number of vertical angles: 1000000000 is not usable; a whole number from 1 to 4096 "
         "would be "
         "right"},
        {ies("2 1", "0 90\n0\n0 0\n"), "a.ies: line 8: all candela values are 0"},
        {ies("2 1", "0 90\n0\n5 -1\n"), "a.ies: line 8: a candela value is below 0"},
        {ies("2 1", "0 90\n0\n5 nan\n"), "a.ies: line 8: candela value: 'nan' is no number"},
        {ies("2 1", "0 90\n0\n5 5\n", "0"),
         "a.ies: line 5: the candela multiplier times the ballast factors is not above 0"},
        {"IESNA:LM-63-1995\nTILT=NONE\n1 1 1 2 1 2 1 0 0 0\n",
         "a.ies: line 3: photometric type 2; type C, which is 1, would be right"},
    };
    for (const auto& [text, message] : cases) {
        try {
            parsed(text);
            ADD_FAILURE() << message;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            EXPECT_STREQ(error.what(), message);
        }
    }
}

// What it sends out is what arrives on a sphere about it.
TEST(LightProfiles, FluxIsTheIntegral) {
    for (const LightType type : {LightType::Point, LightType::Spot}) {
        Light light;
        io::setLightProfile(light, parsed(kWallWasher));
        light.type = type;
        light.outerAngle = 0.9f;
        light.innerAngle = 0.5f;
        light.direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
        constexpr int kPoints = 20000;
        double sum = 0;
        for (int i = 0; i < kPoints; ++i) {
            const double z = 1 - 2 * (i + 0.5) / kPoints, r = std::sqrt(1 - z * z),
                         phi = 2.399963229728653 * i;
            reference::LightSample sample;
            const glm::vec3 from(r * std::cos(phi), z, r * std::sin(phi));
            if (reference::sampleLight(light, from, sample)) sum += static_cast<double>(sample.radiance.g);
        }
        EXPECT_NEAR(sum / kPoints * 4 * glm::pi<double>() / static_cast<double>(radiantFlux(light)->g), 1,
                    3e-3);
        EXPECT_TRUE(setRadiantFlux(light, glm::vec3(7)));
        EXPECT_NEAR(radiantFlux(light)->r, 7, 1e-4f);
    }
    // An even one is a point light of as many candela.
    Light even;
    io::setLightProfile(even, parsed(ies("2 1", "0 180\n0\n683 683\n")));
    EXPECT_NEAR(even.intensity.g, 1, 1e-6f);
    EXPECT_NEAR(radiantFlux(even)->g, 4 * glm::pi<float>(), 1e-3f);
}

void expectSameProfile(const Light& a, const Light& b) {
    ASSERT_TRUE(a.profile != nullptr && b.profile != nullptr);
    EXPECT_EQ(a.type, b.type);
    EXPECT_EQ(a.profile->text, b.profile->text);
    EXPECT_EQ(a.profile->factors, b.profile->factors);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.intensity[c] / b.intensity[c], 1, 1e-5f);
    // The same light everywhere.
    for (const glm::vec3 way : {glm::vec3(1, -1, 0), glm::vec3(0, -1, 1), glm::vec3(-1, -2, 0.3f)})
        EXPECT_NEAR(intensityFactor(a, glm::normalize(way)), intensityFactor(b, glm::normalize(way)), 2e-3f);
}

Scene lampScene() {
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial());
    Light light;
    light.name = "washer";
    io::setLightProfile(light, parsed(kWallWasher));
    light.intensity *= glm::vec3(1, 0.5f, 0.25f);
    light.position = {0, 1, 0};
    light.direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f));
    light.halfU = {0.3f, 0, 1};
    scene.lights = {light, light};
    scene.lights[1].type = LightType::Spot;
    scene.lights[1].outerAngle = 1;
    scene.cameras.resize(1);
    return scene;
}

TEST(LightProfiles, ScenesKeepThem) {
    const Scene scene = lampScene();
    const std::filesystem::path folder = folderOf("light_profiles");
    for (const char* name : {"lamps.glb", "lamps.gltf", "lamps.txt"}) {
        const std::string file = (folder / name).string();
        std::filesystem::remove(file);
        io::writeScene(file, scene, true);
        const Scene back = io::loadScene(file);
        ASSERT_EQ(back.lights.size(), 2u) << name;
        for (std::size_t i = 0; i < 2; ++i) expectSameProfile(back.lights[i], scene.lights[i]);
        EXPECT_NEAR(back.lights[1].outerAngle, 1, 1e-5f);
    }
    std::ifstream gltf(folder / "lamps.gltf");
    const std::string text{std::istreambuf_iterator<char>(gltf), {}};
    EXPECT_NE(text.find("\"EXT_lights_ies\""), std::string::npos);
}

TEST(LightProfiles, TheConsoleSetsThem) {
    const std::filesystem::path file = folderOf("light_profiles") / "washer.ies";
    const std::string text = kWallWasher;
    io::writeFile(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    ConsoleRig rig;
    rig.run("light lamp profile " + file.string());
    EXPECT_EQ(rig.error(), "");
    const Light& lamp = rig.session.scene().lights[0];
    ASSERT_TRUE(lamp.profile != nullptr);
    EXPECT_NEAR(lamp.intensity.g, 900 / 683.0f, 1e-5f);
    rig.run("light lamp direction 1 0 0");
    EXPECT_EQ(rig.session.scene().lights[0].direction, glm::vec3(1, 0, 0));
    rig.run("undo; undo");
    EXPECT_TRUE(rig.session.scene().lights[0].profile == nullptr);
    rig.run("light lamp profile nowhere.ies");
    EXPECT_NE(rig.error().find("nowhere.ies"), std::string::npos);
}

}  // namespace
}  // namespace conelight::test
