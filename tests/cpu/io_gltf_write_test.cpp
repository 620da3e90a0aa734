// SPDX-License-Identifier: MIT
// Scenes written as glTF and read back: the same scene, for every generated one and for what glTF has no
// words for.
#include <fmt/core.h>

#include "cpu/io_test_support.h"
#include "io/files.h"
#include "io/gltf_write.h"
#include "io/scene_file.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace conelight {
namespace {

using namespace test;

Scene roundTrip(const Scene& scene, const std::string& file) {
    const std::filesystem::path path = folderOf("gltf_write") / file;
    io::writeGltf(path, scene);
    return io::loadScene(path.string());
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance, const std::string& what) {
    EXPECT_LE(glm::length(a - b), tolerance * std::max(1.0f, glm::length(b))) << what;
}

glm::vec3 corner(const Scene& scene, const Instance& instance, std::size_t index) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    return glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[mesh.indices[index]], 1));
}

void expectSameMaterial(const Material& a, const Material& b, const Scene& from, const Scene& to) {
    expectNear(glm::vec3(a.baseColor), glm::vec3(b.baseColor), 1e-6f, b.name + " base colour");
    EXPECT_EQ(a.baseColor.a, b.baseColor.a);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.roughness, b.roughness);
    EXPECT_EQ(a.ior, b.ior);
    EXPECT_EQ(a.specular, b.specular);
    EXPECT_EQ(a.coat, b.coat);
    EXPECT_EQ(a.coatRoughness, b.coatRoughness);
    EXPECT_EQ(a.sheenColor, b.sheenColor);
    EXPECT_EQ(a.sheenRoughness, b.sheenRoughness);
    expectNear(a.emission, b.emission, 1e-6f, b.name + " emission");
    EXPECT_EQ(a.alphaMode, b.alphaMode);
    EXPECT_EQ(a.doubleSided, b.doubleSided);
    EXPECT_EQ(a.unlit, b.unlit);
    ASSERT_EQ(a.phong.has_value(), b.phong.has_value());
    if (b.phong) {
        EXPECT_EQ(a.phong->color, b.phong->color);
        EXPECT_EQ(a.phong->shininess, b.phong->shininess);
        EXPECT_EQ(a.phong->specularStrength, b.phong->specularStrength);
    }
    ASSERT_EQ(a.baseColorTexture.used(), b.baseColorTexture.used());
    if (!b.baseColorTexture.used()) return;
    const Texture& ta = from.textures[static_cast<std::size_t>(a.baseColorTexture.texture)];
    const Texture& tb = to.textures[static_cast<std::size_t>(b.baseColorTexture.texture)];
    EXPECT_EQ(ta.rgba, tb.rgba);
    EXPECT_EQ(ta.srgb, tb.srgb);
    EXPECT_EQ(ta.wrapU, tb.wrapU);
    EXPECT_EQ(ta.filter, tb.filter);
    for (int c = 0; c < 3; ++c)
        expectNear(a.baseColorTexture.uvFromUv[c], b.baseColorTexture.uvFromUv[c], 1e-5f, "uv transform");
}

void expectSame(const Scene& read, const Scene& written) {
    EXPECT_EQ(read.sky, written.sky);
    EXPECT_EQ(read.format, written.format);
    EXPECT_EQ(read.settings, written.settings);
    ASSERT_EQ(read.instances.size(), written.instances.size());
    EXPECT_EQ(read.triangleCount(), written.triangleCount());
    for (std::size_t i = 0; i < read.instances.size(); ++i) {
        const Instance &a = read.instances[i], &b = written.instances[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.visible, b.visible);
        EXPECT_EQ(a.voxelized, b.voxelized);
        EXPECT_EQ(a.castsShadow, b.castsShadow);
        EXPECT_EQ(a.dynamic, b.dynamic);
        const Mesh& mesh = written.meshes[static_cast<std::size_t>(b.mesh)];
        for (std::size_t k = 0; k < mesh.indices.size(); k += 1 + mesh.indices.size() / 50)
            expectNear(corner(read, a, k), corner(written, b, k), 1e-6f, b.name);
        if (b.material >= 0)
            expectSameMaterial(read.materials[static_cast<std::size_t>(a.material)],
                               written.materials[static_cast<std::size_t>(b.material)], read, written);
    }
    ASSERT_EQ(read.lights.size(), written.lights.size());
    for (std::size_t i = 0; i < read.lights.size(); ++i) {
        const Light &a = read.lights[i], &b = written.lights[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.type, b.type);
        expectNear(a.intensity, b.intensity, 1e-6f, b.name + " intensity");
        if (b.type != LightType::Directional) {
            EXPECT_EQ(a.position, b.position);
        }
        if (b.type != LightType::Point) expectNear(a.direction, b.direction, 1e-6f, b.name + " direction");
        EXPECT_EQ(a.range, b.range);
        EXPECT_EQ(a.enabled, b.enabled);
        EXPECT_EQ(a.castsShadow, b.castsShadow);
        EXPECT_EQ(a.customFalloff, b.customFalloff);
        if (b.customFalloff) {
            EXPECT_EQ(a.falloff, b.falloff);
        }
        if (hasArea(b.type)) {
            EXPECT_EQ(a.halfU, b.halfU);
            EXPECT_EQ(a.halfV, b.halfV);
        }
        if (b.type == LightType::Spot) {
            EXPECT_EQ(a.outerAngle, b.outerAngle);
        }
    }
    ASSERT_EQ(read.cameras.size(), written.cameras.size());
    for (std::size_t i = 0; i < read.cameras.size(); ++i) {
        EXPECT_EQ(read.cameras[i].name, written.cameras[i].name);
        EXPECT_EQ(read.cameras[i].eye, written.cameras[i].eye);
        expectNear(read.cameras[i].target, written.cameras[i].target, 1e-5f, "target");
        EXPECT_EQ(read.cameras[i].fovY, written.cameras[i].fovY);
        EXPECT_EQ(read.cameras[i].zNear, written.cameras[i].zNear);
        EXPECT_EQ(read.cameras[i].zFar, written.cameras[i].zFar);
        EXPECT_EQ(read.cameras[i].lensDiameter, written.cameras[i].lensDiameter);
        EXPECT_EQ(read.cameras[i].focusDistance, written.cameras[i].focusDistance);
        EXPECT_EQ(read.cameras[i].orthographicHeight, written.cameras[i].orthographicHeight);
    }
}

TEST(GltfWrite, EveryGeneratedSceneComesBack) {
    for (const char* name : {"cornell", "cornell-point", "furnace", "leak", "sunroom", "corridor",
                             "atrium?triangles=10000", "glossy", "spheres"}) {
        SCOPED_TRACE(name);
        const Scene scene = io::loadScene(fmt::format("builtin:{}", name));
        expectSame(roundTrip(scene, "generated.glb"), scene);
    }
}

TEST(GltfWrite, WhatGltfHasNoWordsForComesBackAndIsNamed) {
    Scene scene = io::loadScene("builtin:cornell");
    scene.format = "thesis";
    scene.settings = {{"voxels.size", "64"}, {"image.exposure", "1"}};
    scene.sky = {0.25f, 0.5f, 1};
    scene.instances[0].castsShadow = false;
    scene.instances[1].dynamic = true;
    scene.materials[0].phong.emplace().shininess = 17;
    Light rect;
    rect.name = "panel";
    rect.type = LightType::Rect;
    rect.intensity = {3, 2, 1};
    rect.position = {0.1f, 0.2f, 0.3f};
    rect.direction = glm::normalize(glm::vec3(1, -2, 0.5f));
    rect.enabled = false;
    Light lamp;
    lamp.name = "lamp";
    lamp.customFalloff = true;
    lamp.falloff = {1, 0.2f, 0.3f};
    lamp.castsShadow = false;
    Light spot;
    spot.name = "spot";
    spot.type = LightType::Spot;
    spot.outerAngle = 0.4f;
    Light disk = rect, sphere = rect;
    disk.type = LightType::Disk;
    disk.halfV = {0, 0, 0.2f};
    sphere.type = LightType::Sphere;
    sphere.halfU = {0.3f, 0, 0};
    scene.lights = {rect, lamp, spot, disk, sphere};
    Camera lens = scene.cameras.front();  // in focus elsewhere than at its target
    lens.name = "lens";
    lens.lensDiameter = 0.05f;
    lens.focusDistance = 1.75f;
    Camera at = lens;  // in focus at its target
    at.name = "at target";
    at.focusDistance = 0;
    Camera parallel = lens;
    parallel.name = "parallel";
    parallel.orthographicHeight = 2.5f;
    scene.cameras.insert(scene.cameras.end(), {lens, at, parallel});
    const std::filesystem::path path = folderOf("gltf_write") / "own.gltf";
    EXPECT_EQ(io::writeGltf(path, scene).size(), 3u);
    expectSame(io::loadScene(path.string()), scene);
}

TEST(GltfWrite, BrightVertexColoursKeepTheirValue) {
    Scene scene = io::loadScene("builtin:furnace");
    Mesh& mesh = scene.meshes[0];
    mesh.colors.assign(mesh.positions.size(), glm::vec4(12.5f, 0.001f, 3, 1));
    const Scene read = roundTrip(scene, "colours.glb");
    ASSERT_FALSE(read.meshes[0].colors.empty());
    EXPECT_EQ(read.meshes[0].colors[0], glm::vec4(12.5f, 0.001f, 3, 1));
}

std::string contentOf(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

std::size_t filesIn(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

TEST(GltfWrite, ABufferBesideIsReplacedOnlyWhereItIsItsOwn) {
    const std::filesystem::path folder = folderOf("gltf_beside");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const Scene scene = io::loadScene("builtin:cornell");
    Scene moved = scene;
    moved.meshes[0].positions[0].x += 0.5f;
    io::writeGltf(folder / "a.gltf", scene);
    const std::string first = contentOf(folder / "a.bin");
    io::writeGltf(folder / "a.gltf", moved);  // its own
    EXPECT_NE(contentOf(folder / "a.bin"), first);

    std::ofstream(folder / "b.bin") << "another's";
    EXPECT_THROW(io::writeGltf(folder / "b.gltf", scene), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.gltf"));
    std::ofstream(folder / "b.gltf") << R"({"asset":{"version":"2.0"},"buffers":[{"uri":"c.bin"}]})";
    EXPECT_THROW(io::writeGltf(folder / "b.gltf", scene), Error);
    std::ofstream(folder / "b.gltf") << "no glTF at all";
    EXPECT_THROW(io::writeGltf(folder / "b.gltf", scene), Error);
    EXPECT_EQ(contentOf(folder / "b.bin"), "another's");
    EXPECT_EQ(contentOf(folder / "b.gltf"), "no glTF at all");
    EXPECT_NO_THROW(io::writeGltf(folder / "b.glb", scene));  // has no need of it
    io::writeGltf(folder / "b.gltf", scene, true);
    EXPECT_EQ(io::loadScene((folder / "b.gltf").string()).instances.size(), scene.instances.size());
    EXPECT_EQ(filesIn(folder), 5u);  // nothing is left beside: a.gltf a.bin b.gltf b.bin b.glb
}

TEST(GltfWrite, BothFilesOrNeither) {
    const std::filesystem::path folder = folderOf("gltf_both");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "a.gltf");  // the second of the two cannot be written
    EXPECT_THROW(io::writeGltf(folder / "a.gltf", io::loadScene("builtin:cornell")), Error);
    EXPECT_EQ(filesIn(folder), 1u);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.bin"));
}

TEST(WriteFiles, WhatWasThereStaysWhenOneFails) {
    const std::filesystem::path folder = folderOf("write_files");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "folder");
    std::ofstream(folder / "old") << "old";
    EXPECT_THROW(
        io::writeFiles({{folder / "old", {'n'}}, {folder / "new", {'n'}}, {folder / "folder", {'n'}}}),
        Error);
    EXPECT_THROW(io::writeFiles({{folder / "old", {'n'}}, {folder / "missing" / "x", {'n'}}}), Error);
    EXPECT_EQ(contentOf(folder / "old"), "old");
    EXPECT_EQ(filesIn(folder), 2u);
    io::writeFiles({{folder / "old", {'n'}}, {folder / "new", {'m'}}});
    EXPECT_EQ(contentOf(folder / "old"), "n");
    EXPECT_EQ(contentOf(folder / "new"), "m");
    EXPECT_EQ(filesIn(folder), 3u);
}

TEST(GltfWrite, RefusesAFolderThatDoesNotExist) {
    const Scene scene = io::loadScene("builtin:furnace");
    EXPECT_THROW(io::writeGltf(folderOf("gltf_write") / "missing" / "a.glb", scene), Error);
}

}  // namespace
}  // namespace conelight
