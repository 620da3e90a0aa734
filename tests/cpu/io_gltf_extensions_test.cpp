// SPDX-License-Identifier: MIT
// Surroundings and visibility in glTF files of other programs, and the page that lists the extensions.
#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <glm/gtc/constants.hpp>

#include "cpu/gltf_test_support.h"
#include "io/gltf_extensions.h"
#include "io/scene_write.h"

namespace conelight {
namespace {

using namespace test;

// Radiance from a direction, by the rule of scene.h: the middle is seen along -z, the right half towards +x.
glm::vec3 radianceFrom(const EnvironmentImage& image, const glm::vec3& direction) {
    const glm::vec3 d = glm::normalize(direction);
    const float u = 0.5f + std::atan2(d.x, -d.z) / glm::two_pi<float>();
    const float v = std::acos(d.y) / glm::pi<float>();
    const int x = std::min(int(u * float(image.width)), image.width - 1);
    const int y = std::min(int(v * float(image.height)), image.height - 1);
    return image.radiance.at(std::size_t(y) * std::size_t(image.width) + std::size_t(x));
}

std::string facePng(int size, const std::function<std::array<std::uint8_t, 4>(int x, int y)>& texel) {
    io::ByteImage image{size, size, 4, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto value = texel(x, y);
            image.pixels.insert(image.pixels.end(), value.begin(), value.end());
        }
    const std::vector<std::uint8_t> bytes = io::pngBytes(image);
    return {bytes.begin(), bytes.end()};
}

// Each face has its number in red; green grows to the right as seen from inside, blue downwards.
GltfBuilder surrounded(const std::vector<float>& rotation, float intensity) {
    constexpr int kSize = 16;
    GltfBuilder b;
    b.triangle();
    Json faces = Json::array();
    for (int f = 0; f < 6; ++f) {
        const std::string bytes = facePng(kSize, [&](int x, int y) {
            return std::array<std::uint8_t, 4>{std::uint8_t(40 * (f + 1)),
                                               std::uint8_t(x < kSize / 2 ? 0 : 255),
                                               std::uint8_t(y < kSize / 2 ? 0 : 255), 255};
        });
        b.json["images"].push_back({{"bufferView", b.view(std::vector<char>(bytes.begin(), bytes.end()))}});
        faces.push_back(f);
    }
    b.json["extensions"]["EXT_lights_image_based"]["lights"] = {{{"name", "hall"},
                                                                 {"intensity", intensity},
                                                                 {"rotation", rotation},
                                                                 {"specularImageSize", kSize},
                                                                 {"specularImages", {faces}}}};
    b.json["extensionsUsed"] = {"EXT_lights_image_based"};
    b.node({{"mesh", 0}});
    b.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return b;
}

int faceIn(const EnvironmentImage& image, const glm::vec3& direction) {
    const float red = radianceFrom(image, direction).r;
    for (int f = 0; f < 6; ++f)
        if (std::abs(red - io::linearFromSrgb(float(40 * (f + 1)) / 255.0f)) < 1e-3f) return f;
    return -1;
}

TEST(GltfSurroundings, ACubeStandsAsItsSidesSay) {
    const Scene scene = loadGlb(surrounded({0, 0, 0, 1}, 2.0f), "surrounded");
    ASSERT_TRUE(scene.environment.used());
    EXPECT_EQ(scene.environment.strength, 2.0f);
    EXPECT_EQ(scene.environment.file, "hall");
    const EnvironmentImage& image = *scene.environment.image;
    const glm::vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int f = 0; f < 6; ++f)
        EXPECT_EQ(faceIn(image, axes[f] + glm::vec3(0.1f, 0.07f, 0.05f)), f) << "face " << f;
    // Seen from inside along -z, +x is to the right and +y up; along +x, +z is to the right.
    EXPECT_GT(radianceFrom(image, {0.5f, 0, -1}).g, 0.9f);
    EXPECT_LT(radianceFrom(image, {-0.5f, 0, -1}).g, 0.1f);
    EXPECT_LT(radianceFrom(image, {0.1f, 0.5f, -1}).b, 0.1f);
    EXPECT_GT(radianceFrom(image, {0.1f, -0.5f, -1}).b, 0.9f);
    EXPECT_GT(radianceFrom(image, {1, 0, 0.5f}).g, 0.9f);
    EXPECT_GT(radianceFrom(image, {-1, 0, -0.5f}).g, 0.9f);
}

TEST(GltfSurroundings, ACubeIsTurned) {
    // A quarter turn about +y, counter-clockwise seen from above: what was at +x is at -z.
    const float half = std::sqrt(0.5f);
    const Scene scene = loadGlb(surrounded({0, half, 0, half}, 1.0f), "turned");
    EXPECT_EQ(faceIn(*scene.environment.image, {0.1f, 0.1f, -1}), 0);
    EXPECT_EQ(faceIn(*scene.environment.image, {0.1f, 1, 0.1f}), 2);
}

TEST(GltfSurroundings, AlphaDividesColour) {
    GltfBuilder b = surrounded({0, 0, 0, 1}, 1.0f);
    const std::string bright = facePng(16, [](int, int) {
        return std::array<std::uint8_t, 4>{255, 255, 255, 17};
    });
    b.json["images"][4]["bufferView"] = b.view(std::vector<char>(bright.begin(), bright.end()));
    EXPECT_NEAR(radianceFrom(*loadGlb(b, "rgbd").environment.image, {0, 0, 1}).r, 15.0f, 1e-3f);
}

TEST(GltfSurroundings, AreKeptWhenTheSceneIsWritten) {
    const Scene scene = loadGlb(surrounded({0, 0, 0, 1}, 2.0f), "kept");
    const std::filesystem::path path = folderOf("gltf") / "kept_again.glb";
    io::writeScene(path.string(), scene, true);
    const Scene again = io::loadScene(path);
    ASSERT_TRUE(again.environment.used());
    EXPECT_EQ(again.environment.image->radiance, scene.environment.image->radiance);
    EXPECT_EQ(again.environment.strength, 2.0f);
}

TEST(GltfSurroundings, WrongOnesAreRefused) {
    GltfBuilder five = surrounded({0, 0, 0, 1}, 1.0f);
    five.json["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0].erase(5);
    EXPECT_TRUE(contains(glbError(five, "five"), "six pictures"));
    GltfBuilder zero = surrounded({0, 0, 0, 0}, 1.0f);
    EXPECT_TRUE(contains(glbError(zero, "zero"), "rotation"));
    GltfBuilder sizes = surrounded({0, 0, 0, 1}, 1.0f);
    const std::string small = facePng(8, [](int, int) { return std::array<std::uint8_t, 4>{1, 2, 3, 255}; });
    sizes.json["images"][2]["bufferView"] = sizes.view(std::vector<char>(small.begin(), small.end()));
    EXPECT_TRUE(contains(glbError(sizes, "sizes"), "the same for all six"));
}

TEST(GltfExtensions, HiddenNodesHideWhatIsBelow) {
    GltfBuilder b;
    b.triangle();
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 5}}};
    b.node({{"children", {1, 2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    b.node({{"mesh", 0}});
    b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.node({{"mesh", 0}});
    b.json["scenes"][0]["nodes"] = {0, 3};
    b.json["extensionsUsed"] = {"KHR_node_visibility", "KHR_lights_punctual"};
    const Scene scene = loadGlb(b, "hidden");
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_FALSE(scene.instances[0].visible);
    EXPECT_TRUE(scene.instances[1].visible);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_FALSE(scene.lights[0].enabled);
    EXPECT_TRUE(scene.notes.empty());
}

TEST(GltfExtensions, ThePageHasEveryOne) {
    std::ifstream file(std::string(CONELIGHT_SOURCE_DIR) + "/docs/reference/gltf.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    const auto word = [](io::GltfSupport support) {
        switch (support) {
            case io::GltfSupport::Read:
                return "read";
            case io::GltfSupport::Harmless:
                return "no picture";
            case io::GltfSupport::Fallback:
                return "plainer";
            case io::GltfSupport::None:
                break;
        }
        return "refused";
    };
    std::string last;
    for (const io::GltfExtension& extension : io::gltfExtensions()) {
        EXPECT_TRUE(contains(page, fmt::format("| `{}` | {} |", extension.name, word(extension.support))))
            << extension.name;
        EXPECT_LT(last, extension.name) << "in the order of their names";
        last = extension.name;
    }
}

TEST(GltfExtensions, ARequiredOneThatHasAFallbackIsDrawnPlainer) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    b.json["extensionsUsed"] = {"KHR_materials_anisotropy"};
    b.json["extensionsRequired"] = {"KHR_materials_anisotropy"};
    EXPECT_TRUE(hasNote(loadGlb(b, "anisotropy"), "KHR_materials_anisotropy"));
    b.json["extensionsRequired"] = {"EXT_unheard_of"};
    EXPECT_TRUE(contains(glbError(b, "unheard"), "EXT_unheard_of"));
}

}  // namespace
}  // namespace conelight
