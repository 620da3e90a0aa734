// SPDX-License-Identifier: MIT
// Where a scene has changed: what places there are, how large, and when there are none to go by.
#include "light/edit_places.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

constexpr float kPi = 3.14159265f;

class EditPlacesTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        for (std::size_t i = 0; i < kBoxes; ++i)
            addInstance(source_, boxMesh(), diffuseMaterial(glm::vec3(0.5f)),
                        at({3.0f * static_cast<float>(i), 0, 0}));
        Material lamp;
        lamp.emission = glm::vec3(1);
        addInstance(source_, boxMesh(), lamp, at({0, 9, 0}));
        source_.lights.push_back({.intensity = glm::vec3(1), .position = {0, 5, 0}});
        scene_.emplace(source_);
    }
    void TearDown() override {
        scene_.reset();
        GlTest::TearDown();
    }
    static glm::mat4 at(const glm::vec3& position) { return glm::translate(glm::mat4(1), position); }
    void move(std::size_t index, const glm::vec3& by) {
        Instance moved = scene_->source().instances[index];
        moved.worldFromObject = at(by) * moved.worldFromObject;
        scene_->setInstance(index, moved);
    }

    std::optional<std::vector<light::EditSphere>> spheres() {
        const light::SceneEdits edits = places_.look(*scene_);
        return edits ? std::optional(edits->places) : std::nullopt;
    }

    static constexpr std::size_t kMost = light::EditPlaces::kMost, kBoxes = 3 * kMost;
    Scene source_;
    std::optional<scene::GpuScene> scene_;
    light::EditPlaces places_;
};

TEST_F(EditPlacesTest, NothingToGoByAtFirst) {
    EXPECT_FALSE(places_.look(*scene_));
    ASSERT_TRUE(places_.look(*scene_));
    EXPECT_TRUE(places_.look(*scene_)->empty());
}

// The part of its cross-section is that by which it moved of its size.
TEST_F(EditPlacesTest, SmallMovesAreSmallPlaces) {
    places_.look(*scene_);
    const float radius = 0.5f * glm::length(scene_->instanceBounds(2).extent());
    move(2, {0.01f, 0, 0});
    const auto small = spheres();
    ASSERT_TRUE(small && small->size() == 1);
    EXPECT_NEAR(small->front().center.x, 6, 0.1);
    EXPECT_NEAR(small->front().radius, radius, 0.01f);
    EXPECT_NEAR(small->front().part, 0.01f / (2 * radius), 1e-4f);
    move(2, {0, 40, 0});
    const auto large = spheres();
    ASSERT_TRUE(large && large->size() == 1);
    EXPECT_GT(large->front().radius, 20);  // where it was and where it is
    EXPECT_EQ(large->front().part, 1);
}

// By the farthest way of a vertex. Of two changes between looks only the last is known.
TEST_F(EditPlacesTest, SmallBendsAreSmallPlaces) {
    places_.look(*scene_);
    const auto bend = [&](float by) {
        Mesh bent = scene_->source().meshes[2];
        bent.positions[0].y -= by;
        scene_->setMesh(2, bent);
    };
    bend(0.01f);
    const auto once = spheres();
    ASSERT_TRUE(once && once->size() == 1);
    EXPECT_NEAR(once->front().part, 0.01f / (2 * once->front().radius), 1e-4f);
    bend(0.01f);
    bend(0.01f);
    const auto twice = spheres();
    ASSERT_TRUE(twice && twice->size() == 1);
    EXPECT_EQ(twice->front().part, 1);
}

// Each lies in a sphere of its neighbours, and from afar all are what they are one by one.
TEST_F(EditPlacesTest, OfManyThoseNearEachOtherAreOne) {
    places_.look(*scene_);
    for (std::size_t i = 0; i < kMost; ++i) move(i, {0, 0.01f, 0});
    const auto few = spheres();
    ASSERT_TRUE(few && few->size() == kMost);
    for (std::size_t i = 0; i < kBoxes; ++i) move(i, {0, 0.01f, 0});
    const auto many = spheres();
    ASSERT_TRUE(many && many->size() == kMost);
    const auto area = [](const light::EditSphere& place) { return place.part * place.radius * place.radius; };
    double seen = 0;
    for (const light::EditSphere& place : *many) {
        seen += area(place);
        EXPECT_LT(place.radius, 8);  // of 144 m in all
    }
    EXPECT_NEAR(seen, kBoxes * area(few->front()), 1e-3 * seen);
    for (std::size_t i = 0; i < kBoxes; ++i)
        EXPECT_TRUE(std::any_of(many->begin(), many->end(), [&](const light::EditSphere& place) {
            const glm::vec3 apart = scene_->instanceBounds(i).center() - place.center;
            return glm::length(apart) + few->front().radius <= place.radius + 0.02f;
        })) << i;
}

// A crowd in one point, of which one goes away.
TEST_F(EditPlacesTest, ThingsInOnePlaceAreTakenTogether) {
    for (std::size_t i = 0; i < kBoxes; ++i) move(i, {-3.0f * static_cast<float>(i), 0, 0});
    places_.look(*scene_);
    for (std::size_t i = 0; i < kBoxes; ++i) move(i, {0, i == 5 ? 30 : 0.01f, 0});
    const auto many = spheres();
    ASSERT_TRUE(many && many->size() == kMost);
    const auto whole = std::count_if(many->begin(), many->end(),
                                     [](const light::EditSphere& place) { return place.radius > 5; });
    EXPECT_EQ(whole, 1);
}

TEST_F(EditPlacesTest, WhatIsUnlitAndASkyThatComesChangeEverything) {
    places_.look(*scene_);
    Material unlit = source_.materials[0];
    unlit.unlit = true;
    scene_->setMaterial(0, unlit);
    EXPECT_FALSE(places_.look(*scene_));
    scene_->setSky(glm::vec3(1));
    EXPECT_FALSE(places_.look(*scene_));
    EXPECT_TRUE(places_.look(*scene_));
}

TEST_F(EditPlacesTest, LampsArePlaces) {
    places_.look(*scene_);
    std::vector<Light> lights = source_.lights;
    lights[0].intensity = glm::vec3(0.8f);
    scene_->setLights(lights);
    const light::SceneEdits dimmed = places_.look(*scene_);
    ASSERT_TRUE(dimmed && dimmed->lights.size() == 1 && dimmed->places.empty());
    EXPECT_FALSE(dimmed->most);
    EXPECT_NEAR(dimmed->lights[0].flux, 4 * kPi * 0.2f, 1e-4f);
    lights[0].intensity = glm::vec3(40);  // and the cube, which counts as 10
    scene_->setLights(lights);
    EXPECT_TRUE(places_.look(*scene_)->most);
    scene_->setSky(glm::vec3(0.1f));
    places_.look(*scene_);
    lights[0].intensity = glm::vec3(1);
    scene_->setLights(lights);
    EXPECT_FALSE(places_.look(*scene_)->most);
}

TEST_F(EditPlacesTest, SunsAndSkiesAreEverywhere) {
    scene_->setSky(glm::vec3(1));
    places_.look(*scene_);
    scene_->setSky(glm::vec3(0.9f));
    const light::SceneEdits little = places_.look(*scene_);
    ASSERT_TRUE(little && little->lights.empty() && little->places.empty());
    EXPECT_NEAR(little->everywherePart, 0.1f, 1e-4f);
    EXPECT_TRUE(little->ofLight() && !little->most);
    scene_->setSky(glm::vec3(2));
    const light::SceneEdits twice = places_.look(*scene_);
    ASSERT_TRUE(twice && twice->scaled);
    EXPECT_NEAR(twice->scaled->scale.g, 2 / 0.9f, 1e-5f);
    EXPECT_EQ(twice->scaled->everywhere, 0);
    EXPECT_EQ(twice->scaled->lights.size(), 2u);  // which are not twice as bright
    EXPECT_FALSE(twice->most);
    scene_->setSky(glm::vec3(0));  // all of it: half of the light there was is left as well
    EXPECT_TRUE(places_.look(*scene_)->most);
}

// What is all of the light changes by a factor. So does what emits.
TEST_F(EditPlacesTest, OnlyLampIsScaled) {
    std::vector<Light> lights = source_.lights;
    lights[0].intensity = glm::vec3(100);
    scene_->setLights(lights);
    places_.look(*scene_);
    lights[0].intensity = {10, 20, 30};
    scene_->setLights(lights);
    const light::SceneEdits dimmed = places_.look(*scene_);
    ASSERT_TRUE(dimmed && dimmed->scaled);
    EXPECT_NEAR(dimmed->scaled->scale.g, 0.2f, 1e-5f);
    ASSERT_EQ(dimmed->scaled->lights.size(), 1u);  // the cube that emits
    EXPECT_NEAR(dimmed->scaled->lights[0].flux, 0.8f * kPi * 24, 0.1f);
    EXPECT_FALSE(dimmed->most);
    Material darker = source_.materials.back();
    darker.emission = glm::vec3(0.5f);
    scene_->setMaterial(source_.materials.size() - 1, darker);
    const light::SceneEdits both = places_.look(*scene_);
    ASSERT_TRUE(both && both->scaled);
    EXPECT_NEAR(both->scaled->scale.r, 0.5f, 1e-5f);
    EXPECT_EQ(both->scaled->lights.size(), 1u);  // the lamp
    EXPECT_FALSE(places_.look(*scene_)->scaled);
}

// A cube of edge 2 and emission 1, as a light.
TEST_F(EditPlacesTest, WhatEmitsIsALightAndAThing) {
    constexpr float kFlux = kPi * 24;
    places_.look(*scene_);
    move(kBoxes, {0.01f, 0, 0});
    const light::SceneEdits moved = places_.look(*scene_);
    ASSERT_TRUE(moved && moved->lights.size() == 1 && moved->places.size() == 1);
    EXPECT_NEAR(moved->lights[0].flux, kFlux, 0.01f);
    EXPECT_NEAR(moved->lights[0].reach, 0.02f, 1e-3f);
    move(kBoxes, {20, 0, 0});  // somewhere else: its light is gone here and is there
    const light::SceneEdits gone = places_.look(*scene_);
    ASSERT_TRUE(gone && gone->lights.size() == 2);
    EXPECT_NEAR(gone->lights[1].center.x - gone->lights[0].center.x, 20, 1e-3f);
    EXPECT_GT(gone->lights[0].reach, 1e9f);
    EXPECT_GT(gone->lights[1].part, 1e9f);
    scene_->setSky(glm::vec3(0.1f));
    places_.look(*scene_);
    Material brighter = source_.materials.back();
    brighter.emission = glm::vec3(1.5f);
    scene_->setMaterial(source_.materials.size() - 1, brighter);
    const light::SceneEdits lit = places_.look(*scene_);
    ASSERT_TRUE(lit && lit->lights.size() == 1);
    EXPECT_NEAR(lit->lights[0].flux, 0.5f * kFlux, 0.01f);
    EXPECT_GT(lit->lights[0].reach, 1e9f);
    EXPECT_NEAR(lit->lights[0].center.y, 9, 0.01f);
}

TEST_F(EditPlacesTest, ComingAndGoingArePlacesOfFullSize) {
    places_.look(*scene_);
    scene_->removeInstance(1);
    const auto gone = spheres();
    ASSERT_TRUE(gone && gone->size() == 1);
    EXPECT_NEAR(gone->front().center.x, 3, 1e-3);
    scene_->addInstance(source_.instances[1]);
    const auto come = spheres();
    ASSERT_TRUE(come && come->size() == 1);
    EXPECT_NEAR(come->front().radius, gone->front().radius, 1e-3);
}

}  // namespace
}  // namespace conelight::test
