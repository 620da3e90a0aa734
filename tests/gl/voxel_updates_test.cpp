// SPDX-License-Identifier: MIT
// Updates of the surface voxels: after any sequence of changes they are, bit for bit, what a build of the
// same scene makes; they do no more than what changed asks for; they say where that was.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>

#include "gl/late_words.h"
#include "gl/pass.h"
#include "io/scene_file.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"
#include "voxels/surface_voxels.h"
#include "voxels/voxel_grid.h"

namespace conelight::test {
namespace {

using voxels::SurfaceVoxels;

struct Content {
    std::vector<std::uint32_t> bricks, records, faces, materials, occupied;
    bool operator==(const Content&) const = default;
};

Content download(const SurfaceVoxels& surface) {
    Content c;
    c.bricks.resize(4 * surface.grid().brickCount());
    surface.brickWords().read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, c.bricks.data(), 4 * c.bricks.size());
    c.records = surface.records().read<std::uint32_t>(surface.voxelCount());
    c.faces = surface.faces().read<std::uint32_t>(4 * std::size_t{surface.faceCount()});
    c.materials = surface.faceMaterials().read<std::uint32_t>(4 * std::size_t{surface.faceCount()});
    c.occupied = surface.occupiedBricks().read<std::uint32_t>(surface.occupiedBrickCount());
    return c;
}

// What lies in each brick, without the places of records and faces, which move with what is before them.
std::map<std::uint32_t, std::vector<std::uint32_t>> byBrick(const SurfaceVoxels& surface, const Content& c) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> bricks;
    for (std::size_t i = 0; i < c.bricks.size() / 4; ++i)
        if ((c.bricks[4 * i] | c.bricks[4 * i + 1]) != 0)
            bricks[static_cast<std::uint32_t>(i)] = {c.bricks[4 * i], c.bricks[4 * i + 1]};
    for (std::size_t face = 0; face < c.faces.size() / 4; ++face) {
        const glm::ivec3 voxel = voxels::unpackVoxel(c.faces[4 * face + 3] & 0x3fffffffu);
        std::vector<std::uint32_t>& words = bricks[voxels::brickIndex(voxel / 4, surface.grid().bricks())];
        words.insert(words.end(), &c.faces[4 * face], &c.faces[4 * face] + 4);
        words.insert(words.end(), &c.materials[4 * face], &c.materials[4 * face] + 4);
    }
    return bricks;
}

// A floor that many things stand on, in and above: voxels shared by several instances are the hard case.
Scene crowd() {
    Scene scene;
    Material material;
    material.doubleSided = true;
    addInstance(scene, quadMesh({-1, 0.013f, 1}, {2, 0, 0}, {0, 0, -2}), material);
    addInstance(scene, quadMesh({-1, 0, -1}, {2, 0, 0}, {0, 1.7f, 0}), material);
    material.doubleSided = false;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 12; ++i) {
        material.baseColor = glm::vec4(unit(random), unit(random), unit(random), 1);
        material.emission = i % 4 == 0 ? glm::vec3(unit(random)) : glm::vec3(0);
        const glm::vec3 at(1.4f * unit(random) - 0.7f, unit(random), 1.4f * unit(random) - 0.7f);
        addInstance(scene, boxMesh(), material,
                    glm::scale(glm::rotate(glm::translate(glm::mat4(1), at), 6 * unit(random),
                                           glm::normalize(glm::vec3(unit(random), 1, unit(random)))),
                               glm::vec3(0.05f + 0.2f * unit(random))));
    }
    return scene;
}

// One change of an instance or material of `scene`, handed to the table on the GPU.
void changeSomething(Scene& scene, scene::GpuScene& gpu, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const std::size_t index = random() % scene.instances.size();
    Instance& instance = scene.instances[index];
    glm::mat4& m = instance.worldFromObject;
    switch (random() % 8) {
        case 0:
            instance.visible = !instance.visible;
            break;
        case 1:
            instance.voxelized = !instance.voxelized;
            break;
        case 2:
            instance.material = static_cast<int>(random() % scene.materials.size());
            break;
        case 3: {
            const std::size_t material = random() % scene.materials.size();
            scene.materials[material].baseColor = glm::vec4(unit(random), unit(random), unit(random), 1);
            if (random() % 2 == 0) scene.materials[material].emission = glm::vec3(unit(random));
            if (random() % 4 == 0)
                scene.materials[material].doubleSided = !scene.materials[material].doubleSided;
            gpu.setMaterial(material, scene.materials[material]);
            return;
        }
        case 4:
            m = m * glm::mat4(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0),
                              glm::vec4(0, 0, 0, 1));
            break;
        case 5:
            m = glm::rotate(m, unit(random), {0, 1, 0});
            break;
        default:
            m[3] += glm::vec4(0.2f * unit(random) - 0.1f, 0.2f * unit(random) - 0.1f,
                              0.2f * unit(random) - 0.1f, 0);
    }
    gpu.setInstance(index, instance);
}

struct VoxelUpdates : public GlTest {
    VoxelSettings settings{.size = 32};

    gl::Device deviceOfGpu() {
        gl::Device gpu = device();
        gpu.profile = gl::ExecutionProfile::Gpu;
        return gpu;
    }

    Content built(const scene::GpuScene& scene) {
        SurfaceVoxels surface;
        surface.build(device(), scene, settings);
        return download(surface);
    }
    // 20 steps of one to three changes each; returns how many of them were updates, not builds.
    int checkSequence(Scene scene, unsigned seed) {
        scene::GpuScene gpu(scene);
        SurfaceVoxels surface;
        surface.update(device(), gpu, settings);
        EXPECT_TRUE(surface.lastUpdate().whole);
        EXPECT_EQ(download(surface), built(gpu));
        std::mt19937 random(seed);
        int updates = 0;
        for (int step = 0; step < 20; ++step) {
            for (unsigned i = 0; i <= random() % 3; ++i) changeSomething(scene, gpu, random);
            surface.update(device(), gpu, settings);
            updates += surface.lastUpdate().whole ? 0 : 1;
            EXPECT_EQ(download(surface), built(gpu)) << "seed " << seed << ", step " << step;
            if (HasFailure()) break;
        }
        return updates;
    }
};

TEST_F(VoxelUpdates, AnySequenceGivesTheBitsOfABuild) {
    int updates = 0;
    for (const unsigned seed : {1u, 2u, 3u}) updates += checkSequence(crowd(), seed);
    EXPECT_GT(updates, 30);  // of 60: the rest moved out of the grid or were too much at once
}

// Slots that one update frees are taken by a later one, whose lists have grown in between.
TEST_F(VoxelUpdates, FreeSlotsOutlastGrowth) {
    const gl::Device gpuDevice = deviceOfGpu();
    Scene scene = crowd();
    scene::GpuScene gpu(scene);
    SurfaceVoxels surface;
    const auto update = [&](std::size_t index) {
        gpu.setInstance(index, scene.instances[index]);
        surface.update(gpuDevice, gpu, settings);
        EXPECT_FALSE(surface.lastUpdate().whole);
        return surface.mostFragmentSlots();
    };
    surface.update(gpuDevice, gpu, settings);
    scene.instances[3].visible = false;
    const std::uint32_t before = update(3);
    for (const std::size_t index : {4u, 5u, 6u}) {
        glm::mat4& m = scene.instances[index].worldFromObject;
        m = glm::translate(glm::mat4(1), glm::vec3(0, 0.6f, 0)) * glm::scale(glm::mat4(1), glm::vec3(0.3f));
        gpu.setInstance(index, scene.instances[index]);
    }
    EXPECT_GT(update(6), before);
    EXPECT_EQ(download(surface), built(gpu));
}

// On a GPU counts come a frame later: shaders have them, the CPU knows a bound until it asks.
TEST_F(VoxelUpdates, OnAGpuNobodyWaitsForThem) {
    const gl::Device gpuDevice = deviceOfGpu();
    Scene scene = crowd();
    scene::GpuScene gpu(scene);
    SurfaceVoxels surface;
    surface.update(gpuDevice, gpu, settings);
    std::mt19937 random(4);
    int late = 0;
    for (int step = 0; step < 40; ++step) {
        for (unsigned i = 0; i <= random() % 3; ++i) changeSomething(scene, gpu, random);
        gl::beginFrame();
        const std::uint64_t waits = gl::waitCount();
        surface.update(gpuDevice, gpu, settings);
        if (surface.isLate()) {
            ++late;
            EXPECT_EQ(gl::waitCount(), waits) << step;
            const std::uint32_t most[] = {surface.mostVoxels(), surface.mostFaces(),
                                          surface.mostOccupiedBricks(), surface.mostFragmentSlots()};
            // Some are asked at once, some frames later.
            if (step % 3 != 0) continue;
            EXPECT_LE(surface.voxelCount(), most[0]);
            EXPECT_EQ(gl::waitCount(), waits + 1);
            EXPECT_LE(surface.faceCount(), most[1]);
            EXPECT_LE(surface.occupiedBrickCount(), most[2]);
            EXPECT_LE(surface.fragmentSlots(), most[3]);
        }
        ASSERT_EQ(download(surface), built(gpu)) << step;
    }
    EXPECT_GT(late, 15);  // of 40: the rest moved out of the grid or were too much at once
}

// Textures, masks, big meshes in many instances.
TEST_F(VoxelUpdates, OfATexturedSceneToo) {
    settings.size = 48;
    EXPECT_GT(checkSequence(io::loadScene("builtin:atrium?triangles=20000"), 4), 10);
}

// Adds an instance, of a mesh that may be new, or removes one; of the first two, the large ones, none.
void comeOrGo(scene::GpuScene& gpu, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const std::size_t count = gpu.source().instances.size();
    if (random() % 2 == 0) {
        const std::size_t index = 2 + random() % (count - 2);
        if (!gpu.isRemovedInstance(index)) gpu.removeInstance(index);
        return;
    }
    Instance instance = gpu.source().instances[2 + random() % (count - 2)];
    instance.visible = true;
    if (random() % 2 == 0)
        instance.mesh = static_cast<int>(gpu.addMesh(sphereMesh(4 + static_cast<int>(random() % 9), 5)));
    Material material;
    material.baseColor = glm::vec4(unit(random), unit(random), unit(random), 1);
    if (random() % 2 == 0) instance.material = static_cast<int>(gpu.addMaterial(material));
    if (random() % 4 == 0) instance.material = -1;
    instance.worldFromObject[3] += glm::vec4(0.4f * unit(random) - 0.2f, 0, 0.4f * unit(random) - 0.2f, 0);
    gpu.addInstance(instance);
}

// As if the scene had been handed over as it is.
TEST_F(VoxelUpdates, OfWhatComesAndGoesToo) {
    const Aabb room{{-1.1f, -0.1f, -1.1f}, {1.1f, 1.8f, 1.1f}};
    scene::GpuScene gpu(crowd());
    gpu.setRegion(room);
    SurfaceVoxels surface;
    surface.update(device(), gpu, settings);
    std::mt19937 random(5);
    int updates = 0;
    for (int step = 0; step < 60; ++step) {
        comeOrGo(gpu, random);
        surface.update(device(), gpu, settings);
        updates += surface.lastUpdate().whole ? 0 : 1;
        ASSERT_EQ(download(surface), built(gpu)) << step;
        scene::GpuScene fresh(gpu.source());
        fresh.setRegion(room);
        ASSERT_EQ(download(surface), built(fresh)) << step;
    }
    EXPECT_GT(updates, 30);  // of 60: the rest were too much at once
}

// Tables stop growing where as much goes as comes.
TEST_F(VoxelUpdates, TablesDoNotGrowForEver) {
    scene::GpuScene gpu(crowd());
    SurfaceVoxels surface;
    const auto turn = [&](int columns) {
        Instance instance = gpu.source().instances[2];
        const std::size_t mesh = gpu.addMesh(sphereMesh(columns, 6));
        instance.mesh = static_cast<int>(mesh);
        const std::size_t index = gpu.addInstance(instance);
        surface.update(device(), gpu, settings);
        gpu.removeInstance(index);
        gpu.removeMesh(mesh);
        surface.update(device(), gpu, settings);
    };
    const auto bytes = [] {
        std::size_t sum = 0;
        for (const gl::LiveObject& object : gl::liveObjects()) sum += object.bytes;
        return sum;
    };
    // Other numbers of triangles each time: entries cannot be used again until there are many
    for (int i = 0; i < 300; ++i) turn(4 + i % 32);
    const std::size_t objects = gl::liveObjects().size(), before = bytes();
    const Content last = download(surface);
    for (int i = 0; i < 300; ++i) turn(4 + (7 * i) % 32);
    EXPECT_EQ(gl::liveObjects().size(), objects);
    EXPECT_EQ(bytes(), before);
    EXPECT_EQ(download(surface), last);
    EXPECT_LT(gpu.source().instances.size(), 160u);
    EXPECT_LT(gpu.source().meshes.size(), 60u);
}

TEST_F(VoxelUpdates, DoNoMoreThanWasChanged) {
    settings.size = 64;
    Scene scene = crowd();
    scene::GpuScene gpu(scene);
    SurfaceVoxels surface;
    surface.build(device(), gpu, settings);
    const voxels::SurfaceUpdate whole = surface.lastUpdate();
    const Content first = download(surface);

    surface.update(device(), gpu, settings);
    EXPECT_EQ(surface.lastUpdate().triangles + surface.lastUpdate().fragments + surface.lastUpdate().faces,
              0u);

    const glm::mat4 home = scene.instances[5].worldFromObject;
    for (int i = 1; i <= 30; ++i) {
        scene.instances[5].worldFromObject[3] = home[3] + 0.003f * static_cast<float>(i);
        gpu.setInstance(5, scene.instances[5]);
        const auto before = byBrick(surface, download(surface));
        surface.update(device(), gpu, settings);
        ASSERT_FALSE(surface.lastUpdate().whole) << i;  // slots are used again: no list fills up
        EXPECT_EQ(surface.lastUpdate().triangles, 12u);
        EXPECT_LT(surface.lastUpdate().fragments, whole.fragments / 5);
        EXPECT_LT(surface.lastUpdate().faces, whole.faces / 5);
        // A brick whose content is another than before is among the changed ones, and these are few.
        const auto after = byBrick(surface, download(surface));
        const std::vector<std::uint32_t> changed =
            surface.changedBricks().read<std::uint32_t>((surface.grid().brickCount() + 31) / 32);
        std::size_t marked = 0;
        for (std::uint32_t brick = 0; brick < surface.grid().brickCount(); ++brick) {
            const bool says = (changed[brick / 32] >> (brick % 32) & 1u) != 0;
            marked += says ? 1 : 0;
            const auto a = before.find(brick);
            const auto b = after.find(brick);
            const bool same =
                (a == before.end()) == (b == after.end()) && (a == before.end() || a->second == b->second);
            EXPECT_TRUE(same || says) << brick;
        }
        EXPECT_GT(marked, 0u);
        EXPECT_LT(marked, after.size() / 5);
    }
    // And back.
    scene.instances[5].worldFromObject = home;
    gpu.setInstance(5, scene.instances[5]);
    surface.update(device(), gpu, settings);
    EXPECT_EQ(download(surface), first);
}

// Faces in which nothing changed are taken over as they are: each is marked, and all that are not summed up
// again keep their marks.
TEST_F(VoxelUpdates, TakeOverFacesInWhichNothingChanged) {
    Scene scene = crowd();
    scene::GpuScene gpu(scene);
    SurfaceVoxels surface;
    surface.build(device(), gpu, settings);
    const auto faces = [&] { return surface.faces().read<gpu::FaceRecord>(surface.faceCount()); };
    const auto materials = [&] {
        return surface.faceMaterials().read<gpu::FaceMaterial>(surface.faceCount());
    };
    const auto mark = [](const gpu::FaceRecord& face) { return 7u * face.voxel + face.normal; };
    const std::vector<gpu::FaceRecord> old = faces();
    std::vector<gpu::FaceMaterial> marked = materials();
    for (std::size_t i = 0; i < old.size(); ++i) marked[i].lobe = mark(old[i]);
    const_cast<gl::Buffer&>(surface.faceMaterials())
        .update(0, marked.data(), marked.size() * sizeof marked[0]);

    scene.instances[5].worldFromObject[3].x += 0.05f;
    gpu.setInstance(5, scene.instances[5]);
    surface.update(device(), gpu, settings);
    std::uint32_t fresh = 0;
    const std::vector<gpu::FaceRecord> records = faces();
    marked = materials();
    for (std::size_t i = 0; i < records.size(); ++i) {
        EXPECT_TRUE(marked[i].lobe == mark(records[i]) || marked[i].lobe == 0);
        fresh += marked[i].lobe == 0 ? 1 : 0;
    }
    EXPECT_EQ(fresh, surface.lastUpdate().faces);
}

}  // namespace
}  // namespace conelight::test
