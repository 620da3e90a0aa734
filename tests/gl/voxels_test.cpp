// SPDX-License-Identifier: MIT
// Voxels as a value: the revision says whether they changed, the keys of the voxels before stay readable,
// octant words and lists of a build exist only while somebody needs them.
#include "voxels/voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "gl/object.h"
#include "gl/pass.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

using voxels::Rays;
using voxels::Voxels;

// Small boxes on a floor before a wall, which say how large the grid is.
Scene boxes(int count) {
    Scene scene;
    const Material material;
    addInstance(scene, quadMesh({-1, 0.013f, 1}, {2, 0, 0}, {0, 0, -2}), material);
    addInstance(scene, quadMesh({-1, 0, -1}, {2, 0, 0}, {0, 1.7f, 0}), material);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 at(-0.7f + 0.2f * static_cast<float>(i % 8), 0.3f,
                           -0.5f + 0.2f * static_cast<float>(i / 8));
        addInstance(scene, boxMesh(), material,
                    glm::scale(glm::translate(glm::mat4(1), at), glm::vec3(0.05f)));
    }
    return scene;
}

struct VoxelsTest : public GlTest {
    VoxelSettings settings{.size = 32};

    struct KeyBits {
        voxels::VoxelGrid grid;
        std::vector<std::uint32_t> bricks, records;
        bool operator==(const KeyBits&) const = default;
    };
    // `records`: how many are in use.
    static KeyBits bitsOf(const voxels::VoxelKeys& keys, std::size_t records) {
        KeyBits bits{keys.grid, std::vector<std::uint32_t>(4 * keys.grid.brickCount()), {}};
        keys.brickWords.read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.bricks.data(), 4 * bits.bricks.size());
        bits.records = keys.records.read<std::uint32_t>(records);
        return bits;
    }
    // Makes voxels of what is there now, and expects that the keys of those before are still what they were.
    void expectPreviousKept(Voxels& voxels, const scene::GpuScene& scene) {
        const base::Revision revision = voxels.revision();
        const std::size_t records = voxels.surface().voxelCount();
        const KeyBits before = bitsOf(voxels.surface().keys(), records);
        voxels.update(device(), scene, settings, Rays::No);
        ASSERT_NE(voxels.previous(), nullptr);
        EXPECT_NE(voxels.revision(), revision);
        EXPECT_EQ(voxels.previous()->revision, revision);
        EXPECT_EQ(bitsOf(*voxels.previous(), records), before);
    }
};

TEST_F(VoxelsTest, AnUnchangedSceneKeepsThemAndRunsNoPass) {
    scene::GpuScene scene(boxes(4));
    gl::Profiler profiler;
    profiler.setEnabled(true);
    const gl::Device device{programs(), profiler};
    Voxels voxels;
    EXPECT_FALSE(voxels.revision());
    profiler.beginFrame();
    voxels.update(device, scene, settings, Rays::Yes);
    EXPECT_FALSE(profiler.endFrame().empty());
    const base::Revision first = voxels.revision();
    EXPECT_TRUE(first);

    profiler.beginFrame();
    voxels.update(device, scene, settings, Rays::Yes);
    scene.setLights({});
    scene.setSky(glm::vec3(0.5f));
    voxels.update(device, scene, settings, Rays::Yes);
    EXPECT_TRUE(profiler.endFrame().empty());
    EXPECT_EQ(voxels.revision(), first);
    EXPECT_EQ(voxels.previous(), nullptr);
}

TEST_F(VoxelsTest, EachChangeOfGeometryMaterialOrGridIsAnotherRevision) {
    Scene source = boxes(4);
    scene::GpuScene scene(source);
    Voxels voxels;
    voxels.update(device(), scene, settings, Rays::No);
    base::Revision last = voxels.revision();
    const auto expectAnother = [&](const char* what) {
        voxels.update(device(), scene, settings, Rays::No);
        EXPECT_NE(voxels.revision(), last) << what;
        last = voxels.revision();
    };
    source.instances[3].worldFromObject[3].x += 0.03f;
    scene.setInstance(3, source.instances[3]);
    expectAnother("instance");
    source.materials[0].baseColor = glm::vec4(0.2f, 0.3f, 0.4f, 1);
    scene.setMaterial(0, source.materials[0]);
    expectAnother("material");
    settings.size = 48;
    expectAnother("grid");
    voxels.build(device(), scene, settings, Rays::No);
    EXPECT_NE(voxels.revision(), last) << "build";
}

TEST_F(VoxelsTest, KeysOfTheVoxelsBeforeAreKept) {
    Scene source = boxes(8);
    scene::GpuScene scene(source);
    Voxels voxels;
    voxels.update(device(), scene, settings, Rays::No);
    for (int i = 0; i < 3; ++i) {
        source.instances[4].worldFromObject[3].y += 0.05f;
        scene.setInstance(4, source.instances[4]);
        expectPreviousKept(voxels, scene);
        EXPECT_FALSE(voxels.surface().lastUpdate().whole);
    }
    settings.size = 64;
    expectPreviousKept(voxels, scene);
    settings.size = 20;
    expectPreviousKept(voxels, scene);
    settings.size = 96;  // every list grows, some more than once
    const scene::GpuScene larger(boxes(60));
    expectPreviousKept(voxels, larger);
}

// Boxes that grow need more fragments than there is room for: the update turns into a build.
TEST_F(VoxelsTest, KeysAreKeptWhereAnUpdateFindsItsListsTooSmall) {
    Scene source = boxes(24);
    scene::GpuScene scene(source);
    Voxels voxels;
    voxels.update(device(), scene, settings, Rays::No);
    for (std::size_t i = 2; i < 12; ++i) {
        source.instances[i].worldFromObject = glm::scale(glm::translate(glm::mat4(1), glm::vec3(0, 0.85f, 0)),
                                                         glm::vec3(0.4f + 0.02f * static_cast<float>(i)));
        scene.setInstance(i, source.instances[i]);
    }
    expectPreviousKept(voxels, scene);
    EXPECT_TRUE(voxels.surface().lastUpdate().whole);
}

TEST_F(VoxelsTest, OctantWordsAreMadeForRaysOnly) {
    Scene source = boxes(4);
    scene::GpuScene scene(source);
    Voxels voxels;
    voxels.update(device(), scene, settings, Rays::No);
    const base::Revision revision = voxels.revision();
    EXPECT_FALSE(voxels.hasOctants());
    EXPECT_FALSE(voxels.octants().texture());
    voxels.update(device(), scene, settings, Rays::Yes);
    EXPECT_TRUE(voxels.hasOctants());
    EXPECT_EQ(voxels.revision(), revision);
    source.instances[3].worldFromObject[3].x += 0.03f;
    scene.setInstance(3, source.instances[3]);
    voxels.update(device(), scene, settings, Rays::No);
    EXPECT_FALSE(voxels.hasOctants());  // those there are tell of other voxels
}

// What a scene that stands still does not need is not kept; one that changes again and again keeps it.
TEST_F(VoxelsTest, ListsOfABuildAreGivenBack) {
    const auto alive = [](const char* label) {
        const std::vector<gl::LiveObject> objects = gl::liveObjects();
        return std::count_if(objects.begin(), objects.end(), [&](const gl::LiveObject& object) {
            return object.type == gl::ObjectType::Buffer && object.label == label;
        });
    };
    Scene source = boxes(4);
    scene::GpuScene scene(source);
    Voxels voxels;
    const auto expectLists = [&](int lists, int records) {
        for (const char* list : {"voxelizer tiles", "voxelizer face owners", "voxelizer layered faces"})
            EXPECT_EQ(alive(list), lists) << list;
        EXPECT_EQ(alive("voxel records"), records);
    };
    voxels.update(device(), scene, settings, Rays::No);
    expectLists(0, 1);
    source.instances[3].worldFromObject[3].x += 0.03f;
    scene.setInstance(3, source.instances[3]);
    voxels.update(device(), scene, settings, Rays::No);
    expectLists(1, 2);
}

}  // namespace
}  // namespace conelight::test
