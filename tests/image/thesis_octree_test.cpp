// SPDX-License-Identifier: MIT
// Mode thesis with its volume in an octree (thesis.storage): the picture of the dense textures, from less memory,
// whatever was drawn before.
#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "gl/pass.h"
#include "io/generated.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 64;

Settings storageSettings(VolumeStorage storage, int size = 64) {
    Settings settings;
    settings.mode = thesis::kMode;
    settings.voxels.size = size;
    settings.light.shadowSize = 128;
    settings.groups.of<thesis::ThesisSettings>().storage = storage;
    return settings;
}

Image draw(const Scene& scene, const Settings& settings) {
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kPixels, kPixels, settings);
    return renderer.readImage();
}

// Level 1 of the dense volume is made with level 0, before a driver rounds that in its own way to halves; the octree's
// is made of what was stored. A GPU filters dense textures with weights of 8 bits, the octree is filtered by the shader.
// The rest is equal.
double rounding() { return gl::isSoftwareDriver() ? 1e-3 : 4e-3; }

// Of the octree's picture from the dense one, with the setting `text` ("key=value", or empty) in both.
double difference(const Scene& scene, const std::vector<std::string>& texts, Component component,
                  int size = 64) {
    Image images[2];
    for (const VolumeStorage storage : {VolumeStorage::Dense, VolumeStorage::Octree}) {
        Settings settings = storageSettings(storage, size);
        settings.component = component;
        for (const std::string& text : texts)
            setSetting(settings, text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
        images[storage == VolumeStorage::Octree] = draw(scene, settings);
    }
    return relRmse(images[1], images[0]);
}

using ThesisOctreeTest = GlTest;

}  // namespace

TEST_F(ThesisOctreeTest, GivesThePictureOfTheDenseVolume) {
    for (const char* name : {"cornell", "thesis-room", "spheres"}) {
        const Scene scene = io::generateScene(name);
        for (const Component component : {Component::Full, Component::Occlusion, Component::Voxels})
            EXPECT_LT(difference(scene, {}, component), rounding()) << name;
        EXPECT_LT(
            difference(scene, {"thesis.voxel_view=surfaces", "thesis.voxel_level=2"}, Component::Voxels),
            rounding())
            << name;
    }
}

TEST_F(ThesisOctreeTest, WithBouncesAndAtAnySize) {
    const Scene scene = io::generateScene("cornell");
    EXPECT_LT(difference(scene, {"thesis.bounces=3"}, Component::Indirect), rounding());
    for (const int size : {8, 36, 100})
        EXPECT_LT(difference(scene, {}, Component::Full, size), rounding()) << size;
    // Nothing to be voxelized: the one light is beside the point.
    Scene empty;
    empty.cameras = scene.cameras;
    for (const glm::vec4& pixel : draw(empty, storageSettings(VolumeStorage::Octree)).pixels)
        EXPECT_EQ(pixel.a, 0.0f);
}

// The original's faults are in the octree, too. Its 8-bit texels are interpolated with fewer digits by llvmpipe
// where levels are those of one texture, so two storages differ by parts of 1/256 there.
TEST_F(ThesisOctreeTest, PublishedPictures) {
    const Scene scene = io::generateScene("thesis-room");
    EXPECT_LT(difference(scene,
                         {"thesis.defects.face_rounding=true", "thesis.defects.center_coverage=true",
                          "thesis.defects.isotropic_opacity=true", "thesis.defects.volume_mips=true"},
                         Component::Full),
              1e-3);
    std::vector<std::string> inOrder;
    thesis::ThesisDefects defects;
    for (const SettingInfo& info : settingInfos())
        if (info.key.starts_with("thesis.defects.") && info.key != "thesis.defects.racing_stores")
            inOrder.push_back(info.key + "=true");
    ASSERT_EQ(inOrder.size() + 1, thesis::thesisDefectFlags(defects).size());
    EXPECT_LT(difference(scene, inOrder, Component::Full), 2e-2);
    // One voxel whose last writer changes moves a picture of this size by 8e-3 in one and the same storage.
    EXPECT_LT(difference(scene, {"thesis.defects.racing_stores=true"}, Component::Full), 4e-2);
    EXPECT_LT(difference(scene, {"thesis.published=true"}, Component::Full), 4e-2);
}

// One renderer, from one storage to the other and back, and from one scene to another.
TEST_F(ThesisOctreeTest, StorageAndSceneMayChange) {
    const Scene cornell = io::generateScene("cornell"), spheres = io::generateScene("spheres");
    Renderer renderer;
    const auto picture = [&](const Scene& scene, VolumeStorage storage, int size) {
        renderer.setScene(scene);
        renderer.render(scene.cameras.front(), kPixels, kPixels, storageSettings(storage, size));
        return renderer.readImage();
    };
    const Image octree = picture(cornell, VolumeStorage::Octree, 64);
    const Image dense = picture(cornell, VolumeStorage::Dense, 64);
    picture(spheres, VolumeStorage::Octree, 32);
    EXPECT_EQ(picture(cornell, VolumeStorage::Octree, 64).pixels, octree.pixels);
    picture(spheres, VolumeStorage::Dense, 32);
    EXPECT_EQ(picture(cornell, VolumeStorage::Dense, 64).pixels, dense.pixels);
    EXPECT_EQ(picture(cornell, VolumeStorage::Octree, 64).pixels, octree.pixels);
}

// A fraction of the bytes, and the rest goes with the surface, not with the space about it.
TEST_F(ThesisOctreeTest, TakesLessMemory) {
    const Scene scene = io::generateScene("thesis-room");
    const auto bytes = [&](VolumeStorage storage, int size) {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.front(), 8, 8, storageSettings(storage, size));
        double sum = 0;
        for (const MemoryStats& object : renderer.stats().memory)
            if (object.label.starts_with("thesis") || object.label.starts_with("octree"))
                sum += static_cast<double>(object.bytes);
        return sum;
    };
    const double at128 = bytes(VolumeStorage::Octree, 128), at256 = bytes(VolumeStorage::Octree, 256);
    EXPECT_LT(at256, 5 * at128);  // four times for a surface, eight for space
    EXPECT_LT(2 * at128, bytes(VolumeStorage::Dense, 128));
}

}  // namespace conelight::test
