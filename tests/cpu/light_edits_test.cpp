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
    light::LightChange look(const glm::vec3& scale = glm::vec3(1)) {
        edits_.look(lights_);
        return edits_.change(scale);
    }
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

class SkyEditsTest : public ::testing::Test {
  protected:
    light::LightChange look(const glm::vec3& sky, const Environment& environment,
                            const glm::vec3& scale = glm::vec3(1)) {
        edits_.look(sky, environment);
        return edits_.change(scale);
    }
    const glm::vec3 one_ = glm::vec3(1), two_ = glm::vec3(2);
    light::SkyEdits edits_;
};

TEST_F(SkyEditsTest, SkiesChangeByTheirMean) {
    EXPECT_TRUE(look(one_, {}).isAnything);
    const auto brighter = look({1.1f, 1.1f, 1.1f}, {});
    EXPECT_NEAR(brighter.everywhere, 2 * kPi * 0.1f, 1e-4f);
    EXPECT_NEAR(brighter.everywherePart, 0.1f, 1e-4f);
    EXPECT_EQ(look({1.1f, 1.1f, 1.1f}, {}).everywherePart, 0);
    EXPECT_TRUE(look({0, 0, 0}, pictureOf({one_, one_, one_, one_})).isAnything);
    EXPECT_NEAR(look({0, 0, 0}, pictureOf({one_, two_, one_, one_})).everywherePart, 0.25f, 1e-4f);
    Environment dimmed = pictureOf({one_, two_, one_, one_});
    dimmed.strength = 0.8f;  // of another picture that is the same, and of one
    EXPECT_NEAR(look({0, 0, 0}, dimmed).everywherePart, 0.2f, 1e-4f);
    dimmed.strength = 0.6f;
    const auto darker = look({0, 0, 0}, dimmed);
    EXPECT_NEAR(darker.everywherePart, 0.25f, 1e-4f);
    EXPECT_NEAR(darker.everywhere, 2 * kPi * 1.25f * 0.2f, 1e-4f);
    dimmed.rotation = 0.1f;
    EXPECT_TRUE(look({0, 0, 0}, dimmed).isAnything);
}

// One that is only brighter or darker is no other when it is scaled, and one that stays is.
TEST_F(SkyEditsTest, ScaledSkiesStayTheSame) {
    look(one_, pictureOf({one_, two_, one_, one_}));
    Environment dimmed = pictureOf({0.5f * one_, one_, 0.5f * one_, 0.5f * one_});
    EXPECT_NEAR(look(0.5f * one_, dimmed, glm::vec3(0.5f)).everywhere, 0, 1e-6f);
    dimmed.strength = 2;
    EXPECT_NEAR(look(one_, dimmed, glm::vec3(2)).everywhere, 0, 1e-6f);
    edits_.keep();
    EXPECT_EQ(edits_.change().everywhere, 0);
    // 1 + 1.25 of half of it is missing.
    EXPECT_NEAR(edits_.change(glm::vec3(0.5f)).everywhere, 2 * kPi * 0.5f * 2.25f, 1e-4f);
    EXPECT_NEAR(edits_.change(glm::vec3(0.5f)).everywherePart, 1, 1e-5f);
}

// A lamp that is dimmed is none to look at when light is scaled by as much, and the others are.
TEST_F(LightEditsTest, ScaledLampsStayTheSame) {
    look();
    lights_[1].intensity *= 0.5f;
    lights_[2].position.x += 0.01f;
    const auto left = look(glm::vec3(0.5f));
    ASSERT_EQ(left.lights.size(),
              3u);  // the third is as bright as it was, not half as bright, and stands elsewhere
    EXPECT_EQ(left.lights[0].center, lights_[0].position);
    EXPECT_NEAR(left.lights[0].flux, 4 * kPi * 0.5f, 1e-5f);
    EXPECT_NEAR(left.lights[0].part, 1, 1e-6f);
    edits_.keep();
    EXPECT_TRUE(edits_.change().lights.empty());
    EXPECT_EQ(edits_.change(glm::vec3(0.5f)).lights.size(), 3u);
}

TEST(CommonScaleTest, MostOfWhatChangedSays) {
    using light::LightSource;
    const glm::vec3 one(1);
    EXPECT_EQ(light::commonScale({}), one);
    EXPECT_EQ(light::commonScale({{one, one}, {glm::vec3(0), one}}), one);
    // What stays does not count, nor what has come.
    EXPECT_EQ(light::commonScale({{9.0f * one, 9.0f * one}, {one, 0.25f * one}, {glm::vec3(0), 7.0f * one}}),
              0.25f * one);
    EXPECT_EQ(light::commonScale({{3.0f * one, 6.0f * one}, {one, one * 0.5f}, {one, glm::vec3(0)}}),
              2.0f * one);
    EXPECT_EQ(light::commonScale({{{4, 4, 4}, {2, 4, 8}}}), glm::vec3(0.5f, 1, 2));
}

// In a scene of the radius 2 m: a lamp, one that went out, a sun.
TEST_F(LightEditsTest, SourcesSendOutAllTheirLight) {
    lights_[0].enabled = false;
    lights_[2] = sunAt(0);
    look();
    lights_[1].intensity = {1, 0, 0};
    look();
    std::vector<light::LightSource> sources;
    edits_.addSources(sources, 2);
    ASSERT_EQ(sources.size(), 3u);
    EXPECT_EQ(sources[0].was, glm::vec3(0));
    EXPECT_NEAR(sources[1].was.g, 4 * kPi * 2, 1e-4f);
    EXPECT_NEAR(sources[1].is.r, 4 * kPi, 1e-4f);
    EXPECT_EQ(sources[1].is.g, 0);
    EXPECT_NEAR(sources[2].is.b, 3 * kPi * 4, 1e-4f);
}

}  // namespace
}  // namespace conelight::test
