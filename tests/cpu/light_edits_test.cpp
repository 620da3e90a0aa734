// SPDX-License-Identifier: MIT
// Lights that changed: where, by how much, and how far that reaches.
#include "light/light_edits.h"

#include <gtest/gtest.h>
#include <cmath>
#include <memory>

#include "light/sky_edits.h"

namespace conelight::test {
namespace {

constexpr float kPi = 3.14159265f, kExtent = 10;

Light lampAt(const glm::vec3& position, float intensity) {
    return {.intensity = glm::vec3(intensity), .position = position};
}

Light sunAt(float angle) {
    return {.type = LightType::Directional,
            .intensity = glm::vec3(3),
            .direction = {std::sin(angle), -std::cos(angle), 0}};
}

class LightEditsTest : public ::testing::Test {
  protected:
    light::LightEdits::Change look() { return edits_.look(lights_); }
    std::vector<Light> lights_ = {lampAt({0, 0, 0}, 1), lampAt({4, 0, 0}, 2), lampAt({8, 0, 0}, 3)};
    light::LightEdits edits_;
};

TEST_F(LightEditsTest, OnlyWhatChangedIsFound) {
    EXPECT_EQ(look().lights.size(), 3u);  // all have come
    EXPECT_TRUE(look().lights.empty());
    lights_[1].intensity.r = 3.5f;
    const auto brighter = look();
    ASSERT_EQ(brighter.lights.size(), 1u);
    EXPECT_EQ(brighter.lights[0].center, lights_[1].position);
    EXPECT_NEAR(brighter.lights[0].flux, 4 * kPi * 0.5f, 1e-5f);
    EXPECT_NEAR(light::changedFlux(brighter.lights, kExtent), 4 * kPi * 0.5f, 1e-5f);
    EXPECT_NEAR(edits_.flux(), 4 * kPi * 6.5f, 1e-4f);
    lights_[2].enabled = false;
    const auto off = look();
    ASSERT_EQ(off.lights.size(), 1u);
    EXPECT_NEAR(off.lights[0].flux, 4 * kPi * 3, 1e-4f);
    lights_[2].intensity = glm::vec3(5);  // while it is off
    EXPECT_TRUE(look().lights.empty());
}

TEST_F(LightEditsTest, ThoseThatGoLeaveTheOthers) {
    look();
    lights_.erase(lights_.begin());
    const auto gone = look();
    ASSERT_EQ(gone.lights.size(), 1u);
    EXPECT_EQ(gone.lights[0].center, glm::vec3(0));
    lights_.insert(lights_.begin() + 1, lampAt({6, 0, 0}, 7));
    const auto come = look();
    ASSERT_EQ(come.lights.size(), 1u);
    EXPECT_NEAR(come.lights[0].flux, 4 * kPi * 7, 1e-4f);
}

// A lamp that goes on by 1 cm is another by 2 cm / d of what it brings; one that is elsewhere in another colour is two.
TEST_F(LightEditsTest, StepsReachLessFar) {
    look();
    lights_[0].position.x += 0.01f;
    const auto step = look();
    ASSERT_EQ(step.lights.size(), 1u);
    EXPECT_NEAR(step.lights[0].reach, 0.02f, 1e-6f);
    EXPECT_NEAR(light::changedFlux(step.lights, kExtent), 4 * kPi * 0.02f / kExtent, 1e-5f);
    lights_[0].position.y = 2;
    lights_[0].intensity.b = 0;
    EXPECT_EQ(look().lights.size(), 2u);
}

// What a beam shines on is anywhere along it. A turn changes as much of it as it sweeps.
TEST_F(LightEditsTest, SpotsAreBeams) {
    lights_ = {lampAt({0, 5, 0}, 1)};
    lights_[0].type = LightType::Spot;
    lights_[0].innerAngle = lights_[0].outerAngle = 0.5f;
    const auto on = look();
    ASSERT_EQ(on.lights.size(), 1u);
    EXPECT_EQ(on.lights[0].axis, glm::vec3(0, -1, 0));
    EXPECT_NEAR(on.lights[0].flux, 2 * kPi * (1 - std::cos(0.5f)), 1e-5f);
    lights_[0].direction = {std::sin(0.05f), -std::cos(0.05f), 0};
    const auto turned = look();
    ASSERT_EQ(turned.lights.size(), 1u);
    EXPECT_NEAR(turned.lights[0].flux, 0.1f * on.lights[0].flux, 1e-3f);
    EXPECT_NEAR(turned.lights[0].part, 0.1f, 1e-3f);
    lights_[0].position.x += 0.03f;  // somebody walks with it, and looks about
    lights_[0].direction = {0, -1, 0};
    const auto carried = look();
    ASSERT_EQ(carried.lights.size(), 2u);
    EXPECT_NEAR(carried.lights[0].part, 0.1f, 1e-3f);
    EXPECT_NEAR(carried.lights[1].reach, 0.06f, 1e-4f);
    EXPECT_NEAR(carried.lights[1].flux, on.lights[0].flux, 1e-4f);
}

TEST_F(LightEditsTest, AreasShineByTheirFlux) {
    const Light rect{.type = LightType::Rect, .halfU = {0.5f, 0, 0}, .halfV = {0, 0, 1}};
    EXPECT_NEAR(light::placeOf(rect)->flux, kPi * 2, 1e-5f);
    const Light sphere{.type = LightType::Sphere, .halfU = {0.5f, 0, 0}};
    EXPECT_NEAR(light::placeOf(sphere)->flux, kPi * 4 * kPi * 0.25f, 1e-4f);
    Light old = lampAt({0, 0, 0}, 1);
    old.customFalloff = true;
    EXPECT_NEAR(light::placeOf(old)->flux, 4 * kPi / 0.45f, 1e-3f);
    old.falloff.z = 0;  // it does not fall off as light does
    EXPECT_FALSE(light::placeOf(old));
}

// However much a lamp brings, by half of it nothing changes by more than half.
TEST_F(LightEditsTest, DimmedLampsChangeAPart) {
    look();
    lights_[0].intensity = {1, 1, 0.5f};
    EXPECT_NEAR(look().lights[0].part, 0.5f, 1e-6f);
    lights_[0].intensity = {1, 1, 0.6f};
    EXPECT_NEAR(look().lights[0].part, 0.2f, 1e-6f);
    lights_[0].intensity = glm::vec3(0);
    EXPECT_NEAR(look().lights[0].part, 1, 1e-6f);
    lights_[0].intensity = glm::vec3(0.1f);
    EXPECT_GT(look().lights[0].part, 1e30f);
}

// The sun is everywhere. What it brings changes by the angle.
TEST_F(LightEditsTest, SunsChangeEverywhere) {
    lights_ = {sunAt(0.2f)};
    EXPECT_TRUE(look().isAnything);
    lights_ = {sunAt(0.21f)};
    const auto later = look();
    EXPECT_FALSE(later.isAnything);
    EXPECT_TRUE(later.lights.empty());
    EXPECT_NEAR(later.everywhere, 0.03f, 1e-4f);
    EXPECT_NEAR(later.everywherePart, 0.04f, 1e-4f);
    lights_[0].intensity = glm::vec3(2);
    EXPECT_NEAR(look().everywherePart, 1.0f / 3, 1e-4f);
    lights_.clear();
    EXPECT_TRUE(look().isAnything);
}

Environment pictureOf(const std::vector<glm::vec3>& radiance) {
    Environment environment;
    environment.image = std::make_shared<EnvironmentImage>(EnvironmentImage{2, 2, radiance});
    return environment;
}

TEST(SkyEditsTest, SkiesChangeByTheirMean) {
    light::SkyEdits edits;
    const glm::vec3 one(1), two(2);
    EXPECT_TRUE(edits.look(one, {}).isAnything);
    const auto brighter = edits.look({1.1f, 1.1f, 1.1f}, {});
    EXPECT_NEAR(brighter.irradiance, 2 * kPi * 0.1f, 1e-4f);
    EXPECT_NEAR(brighter.part, 0.1f, 1e-4f);
    EXPECT_EQ(edits.look({1.1f, 1.1f, 1.1f}, {}).part, 0);
    EXPECT_TRUE(edits.look({0, 0, 0}, pictureOf({one, one, one, one})).isAnything);
    EXPECT_NEAR(edits.look({0, 0, 0}, pictureOf({one, two, one, one})).part, 0.25f, 1e-4f);
    Environment dimmed = pictureOf({one, two, one, one});
    dimmed.strength = 0.8f;  // of another picture that is the same, and of one
    EXPECT_NEAR(edits.look({0, 0, 0}, dimmed).part, 0.2f, 1e-4f);
    dimmed.strength = 0.6f;
    const auto darker = edits.look({0, 0, 0}, dimmed);
    EXPECT_NEAR(darker.part, 0.25f, 1e-4f);
    EXPECT_NEAR(darker.irradiance, 2 * kPi * 1.25f * 0.2f, 1e-4f);
    dimmed.rotation = 0.1f;
    EXPECT_TRUE(edits.look({0, 0, 0}, dimmed).isAnything);
}

}  // namespace
}  // namespace conelight::test
