// SPDX-License-Identifier: MIT
// What has become of instances between two looks: which came, moved or bent, and where they were.
#include "scene/instance_history.h"

#include <glm/gtc/matrix_transform.hpp>

#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

class InstanceHistoryTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        Scene source;
        for (int i = 0; i < 3; ++i)
            addInstance(source, boxMesh(), diffuseMaterial(glm::vec3(0.5f)), at(static_cast<float>(i)));
        source.lights.push_back({.intensity = glm::vec3(1), .position = {0, 5, 0}});
        scene_.emplace(source);
        history_.look(*scene_);
    }
    void TearDown() override {
        scene_.reset();
        GlTest::TearDown();
    }
    static glm::mat4 at(float x) { return glm::translate(glm::mat4(1), {x, 0, 0}); }
    void move(std::size_t index, float x) {
        Instance moved = scene_->source().instances[index];
        moved.worldFromObject = at(x);
        scene_->setInstance(index, moved);
    }
    void bend(std::size_t mesh) {
        Mesh bent = scene_->source().meshes[mesh];
        bent.positions[0].y -= 0.01f;
        scene_->setMesh(mesh, bent);
    }

    std::optional<scene::GpuScene> scene_;
    scene::InstanceHistory history_;
};

TEST_F(InstanceHistoryTest, AtFirstAllHaveCome) {
    scene::InstanceHistory other;
    EXPECT_FALSE(other.at());
    EXPECT_EQ(other.look(*scene_).size(), 3u);
    for (const scene::InstanceChange& change : other.look(*scene_)) EXPECT_TRUE(change.came);
    EXPECT_TRUE(other.look(*scene_).empty());
    EXPECT_EQ(other.at(), scene_->geometryRevision());
}

TEST_F(InstanceHistoryTest, OneThatMovedIsToldWithItsOldPlace) {
    move(1, 4);
    const std::vector<scene::InstanceChange> changes = history_.look(*scene_);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].index, 1u);
    EXPECT_TRUE(changes[0].moved && !changes[0].came && !changes[0].reshaped);
    EXPECT_EQ(changes[0].worldFromObject, at(1));
    const std::vector<glm::mat4> old = scene::oldFromWorld(*scene_, changes);
    EXPECT_EQ(old[0], glm::mat4(1));
    EXPECT_EQ(old[1], at(-3));
    EXPECT_TRUE(history_.look(*scene_).empty());
}

// A look of its own for each: what one has seen, another has not.
TEST_F(InstanceHistoryTest, MovesAddUpBetweenLooks) {
    scene::InstanceHistory rare;
    rare.look(*scene_);
    move(2, 5);
    history_.look(*scene_);
    move(2, 7);
    EXPECT_EQ(history_.look(*scene_).at(0).worldFromObject, at(5));
    EXPECT_EQ(rare.look(*scene_).at(0).worldFromObject, at(2));
}

TEST_F(InstanceHistoryTest, VerticesOfTheLastLookAreKeptForOneChange) {
    bend(0);
    const scene::InstanceChange once = history_.look(*scene_).at(0);
    EXPECT_TRUE(once.reshaped && once.keepsVertices && !once.moved);
    bend(0);
    bend(0);
    const scene::InstanceChange twice = history_.look(*scene_).at(0);
    EXPECT_TRUE(twice.reshaped && !twice.keepsVertices);
}

// In the place of one that has gone another stands, which has no past.
TEST_F(InstanceHistoryTest, OneInThePlaceOfAnotherHasCome) {
    Instance next = scene_->source().instances[1];
    scene_->removeInstance(1);
    next.worldFromObject = at(9);
    ASSERT_EQ(scene_->addInstance(next), 1u);
    const std::vector<scene::InstanceChange> changes = history_.look(*scene_);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_TRUE(changes[0].came && !changes[0].moved && !changes[0].reshaped);
    EXPECT_EQ(scene::oldFromWorld(*scene_, changes)[1], glm::mat4(1));
    EXPECT_FALSE(history_.fewer());
}

}  // namespace
}  // namespace conelight::test
