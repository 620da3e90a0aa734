// SPDX-License-Identifier: MIT
// Strengths of lights in watts and lumens against formulas; colours of black bodies against tables.
#include "session/light_units.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "console_test_support.h"

namespace conelight::program {
namespace {

constexpr float kPi = glm::pi<float>();

glm::vec2 xyOf(const glm::vec3& rgb) {
    // Linear Rec.709 to CIE XYZ (IEC 61966-2-1).
    const glm::vec3 xyz(glm::dot(rgb, {0.4124f, 0.3576f, 0.1805f}),
                        glm::dot(rgb, {0.2126f, 0.7152f, 0.0722f}),
                        glm::dot(rgb, {0.0193f, 0.1192f, 0.9505f}));
    return glm::vec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

TEST(LightUnits, AreConvertedByTheLuminousEfficacy) {
    Light light;
    light.intensity = glm::vec3(2);
    EXPECT_FLOAT_EQ(strengthIn(light, LightUnit::Radiant), 2);
    EXPECT_FLOAT_EQ(strengthIn(light, LightUnit::RadiantFlux), 8 * kPi);
    EXPECT_NEAR(strengthIn(light, LightUnit::Luminous), 2 * 683, 0.1f);
    EXPECT_NEAR(strengthIn(light, LightUnit::LuminousFlux), 8 * kPi * 683, 2);
    light.intensity = {0, 1, 0};
    EXPECT_NEAR(strengthIn(light, LightUnit::Luminous), 683 * 0.7152f, 0.1f);
    setStrength(light, LightUnit::LuminousFlux, 1000);
    EXPECT_NEAR(strengthIn(light, LightUnit::LuminousFlux), 1000, 0.1f);
    EXPECT_EQ(light.intensity.r, 0) << "the colour stays";
    light.intensity = glm::vec3(0);
    setStrength(light, LightUnit::Luminous, 683);
    EXPECT_NEAR(light.intensity.b, 1, 1e-4f) << "a dark one becomes white";
    light.type = LightType::Directional;
    EXPECT_EQ(unitsOf(light).size(), 2u) << "it has no end";
    EXPECT_STREQ(unitName(light.type, LightUnit::Luminous), "lx");
    light.type = LightType::Rect;
    EXPECT_STREQ(unitName(light.type, LightUnit::Luminous), "cd/m^2");
    light.halfU = glm::vec3(0);
    setStrength(light, LightUnit::LuminousFlux, 5);
    EXPECT_TRUE(std::isfinite(light.intensity.r)) << "one without area sends nothing";
}

// Chromaticities: illuminant A is 2856 K; Planckian locus of Wyszecki and Stiles, "Color Science", 1982, 3.3.
TEST(LightUnits, ColoursOfBlackBodies) {
    EXPECT_LT(glm::distance(xyOf(blackbodyColor(2856)), {0.4476f, 0.4074f}), 0.004f);
    EXPECT_LT(glm::distance(xyOf(blackbodyColor(5000)), {0.3451f, 0.3516f}), 0.004f);
    EXPECT_LT(glm::distance(xyOf(blackbodyColor(10000)), {0.2807f, 0.2884f}), 0.004f);
    for (const float kelvin : {1200.0f, 1800.0f, 2700.0f, 4000.0f, 6500.0f, 12000.0f, 30000.0f}) {
        const auto found = kelvinOf(7.0f * blackbodyColor(kelvin));
        ASSERT_TRUE(found) << kelvin;
        EXPECT_NEAR(*found / kelvin, 1, 0.02f);
    }
    EXPECT_FALSE(kelvinOf({0.1f, 1, 0.1f})) << "no black body is green";
    EXPECT_NEAR(kelvinOf(glm::vec3(1)).value_or(0), 6500, 400) << "white is about 6500 K";
}

TEST(LightUnits, WordsOfTheConsole) {
    test::ConsoleRig rig;
    const auto light = [&]() -> const Light& { return rig.session.scene().lights[0]; };
    rig.run("light lamp falloff off; light lamp lumen 800");
    EXPECT_EQ(rig.error(), "");
    EXPECT_NEAR(strengthIn(light(), LightUnit::LuminousFlux), 800, 0.1f);
    rig.run("light lamp kelvin 2700");
    EXPECT_NEAR(strengthIn(light(), LightUnit::LuminousFlux), 800, 0.1f) << "as bright as before";
    EXPECT_NEAR(kelvinOf(light().intensity).value_or(0), 2700, 30);
    rig.run("light lamp candela 683; light lamp");
    EXPECT_NE(rig.lines.back().text.find("683 cd"), std::string::npos) << rig.lines.back().text;
    EXPECT_NE(rig.lines.back().text.find(" lm"), std::string::npos);
    EXPECT_NE(rig.lines.back().text.find("2700 K"), std::string::npos) << rig.lines.back().text;
    EXPECT_EQ(rig.error(), "");
    const std::pair<const char*, const char*> wrong[] = {
        {"light lamp kelvin 10", "1000 to 40000 K would be right"},
        {"light lamp lux 5", "a point light has none"},
        {"light lamp nit 5", "a point light has none"},
        {"light lamp lumen -1", "not usable"},
        {"light lamp falloff 1 0 1; light lamp lumen 5", "`falloff off` first would be right"}};
    for (const auto& [line, message] : wrong) {
        rig.lines.clear();
        rig.run(line);
        EXPECT_NE(rig.error().find(message), std::string::npos) << line << ": " << rig.error();
    }
}

}  // namespace
}  // namespace conelight::program
