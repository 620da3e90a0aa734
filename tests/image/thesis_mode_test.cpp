// SPDX-License-Identifier: MIT
// Mode `thesis` as pictures: the original's faults can be seen when switched on, and not when mended.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "conelight/renderer.h"

#include "conelight/thesis/settings.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

void addQuad(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, int material) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.normals.assign(4, glm::normalize(glm::cross(u, v)));
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = material;
    scene.instances.push_back(instance);
}

int addMaterial(Scene& scene, const glm::vec3& color, float shininess, float specular) {
    Material material;
    material.phong.emplace().color = color;
    material.phong->shininess = shininess;
    material.phong->specularStrength = specular;
    setPbrFromPhong(material, *material.phong);
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void addSphere(Scene& scene, const glm::vec3& center, float radius, int material) {
    constexpr int kRings = 16, kSectors = 24;
    Mesh mesh;
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j <= kSectors; ++j) {
            const float theta = std::numbers::pi_v<float> * static_cast<float>(i) / kRings;
            const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(j) / kSectors;
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi));
            mesh.positions.push_back(center + radius * n);
            mesh.normals.push_back(n);
        }
    for (std::uint32_t i = 0; i < kRings; ++i)
        for (std::uint32_t j = 0; j < kSectors; ++j) {
            const std::uint32_t a = i * (kSectors + 1) + j, b = a + kSectors + 1;
            for (const std::uint32_t k : {a, a + 1, b, b, a + 1, b + 1}) mesh.indices.push_back(k);
        }
    scene.meshes.push_back(mesh);
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = material;
    scene.instances.push_back(instance);
}

Light lamp(const glm::vec3& position, const glm::vec3& color) {
    Light light;
    light.position = position;
    light.intensity = color * std::numbers::pi_v<float>;
    light.customFalloff = true;
    return light;
}

// The thesis's empty room: a cube of edge 1 with red and green side walls, its right wall at `right`.
Scene room(float right = 0.5f) {
    Scene scene;
    scene.format = "thesis";
    const int grey = addMaterial(scene, glm::vec3(0.85f), 1, 0.01f);
    const int red = addMaterial(scene, {1, 0.4f, 0.4f}, 1, 0.01f);
    const int green = addMaterial(scene, {0.4f, 1, 0.4f}, 1, 0.01f);
    const float a = 0.5f;
    addQuad(scene, {-a, a, -a}, {1, 0, 0}, {0, 0, 1}, grey);       // top
    addQuad(scene, {-a, -a, -a}, {1, 0, 0}, {0, 1, 0}, grey);      // back
    addQuad(scene, {-a, -a, a}, {1, 0, 0}, {0, 0, -1}, grey);      // bottom
    addQuad(scene, {a, -a, a}, {-1, 0, 0}, {0, 1, 0}, grey);       // front
    addQuad(scene, {right, -a, -a}, {0, 0, 1}, {0, 1, 0}, green);  // right
    addQuad(scene, {-a, -a, a}, {0, 0, -1}, {0, 1, 0}, red);       // left
    scene.lights.push_back(lamp({0, 0.4f, 0.4f}, glm::vec3(1)));
    return scene;
}

// With things in it that give every defect something to spoil: mirror, thin strips, an emitter, a second
// lamp.
Scene furnishedRoom() {
    Scene scene = room();
    const int mirror = addMaterial(scene, glm::vec3(0.8f), 256, 1.3f);
    const int gloss = addMaterial(scene, {0.9f, 0.7f, 0.4f}, 20, 0.8f);
    scene.materials[static_cast<std::size_t>(gloss)].phong->diffuseStrength = 2.0f;
    const int glow = addMaterial(scene, {0.2f, 0.4f, 1.0f}, 1, 0.0f);
    scene.materials[static_cast<std::size_t>(glow)].emission = {0.5f, 1.0f, 2.0f};
    addSphere(scene, {-0.33f, -0.1f, 0.0f}, 0.16f, mirror);
    addSphere(scene, {0.2f, -0.3f, 0.1f}, 0.17f, gloss);
    addQuad(scene, {0.1f, 0.1f, -0.45f}, {0.2f, 0.05f, 0}, {0, 0.2f, 0.02f}, glow);
    for (int i = 0; i < 6; ++i)
        addQuad(scene, {-0.1f + 0.03f * static_cast<float>(i), -0.48f, -0.2f}, {0.004f, 0, 0},
                {0, 0.4f, 0.05f}, gloss);
    scene.lights.push_back(lamp({-0.3f, 0.3f, -0.2f}, {0.3f, 0.8f, 1.0f}));
    return scene;
}

Camera pos2() {
    Camera camera;
    camera.eye = {0, 0, 1.8f};
    camera.target = {0, 0, 0};
    return camera;
}

Settings thesisSettings(int voxels = 64) {
    Settings settings;
    settings.mode = thesis::kMode;
    settings.voxels.size = voxels;
    settings.light.shadowSize = 256;
    return settings;
}

class ThesisModeTest : public GlTest {
  protected:
    static Image render(const Scene& scene, const Settings& settings, const Camera& camera = pos2(),
                        int width = 96, int height = 72) {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(camera, width, height, settings);
        return renderer.readImage();
    }
    static double meanOf(const Image& image) {
        double sum = 0, count = 0;
        for (const glm::vec4& p : image.pixels)
            if (p.a > 0) {
                sum += (p.r + p.g + p.b) / 3;
                ++count;
            }
        return sum / std::max(count, 1.0);
    }
    static double largestDifference(const Image& a, const Image& b) {
        double largest = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(double(a.pixels[i][c]) - double(b.pixels[i][c])));
        return largest;
    }
};

// Visibility of the third light of the thesis's complex scene along a line of its ceiling, where the
// original's rings were counted: how often does a pixel differ from the middle of its neighbours by more than
// `jump`?
Camera ceilingCamera() {
    Camera camera;
    camera.eye = {0, 0.05f, 0.3f};
    camera.target = {0, 0.5f, 0.3f};
    camera.up = {0, 0, -1};
    camera.fovY = 0.066f;  // 32 times wider than high: the ceiling from wall to wall
    return camera;
}

constexpr glm::vec3 kCornerLamp(-0.4f, 0.4f, 0.3f);

// Distances to the lamp at which visibility jumps by more than `jump` beyond what the slopes on both sides
// explain.
std::vector<double> jumpsAlongTheCeiling(const Image& image, const Camera& camera, float jump) {
    const int row = image.height / 2;
    const double halfWidth = 0.45 * std::tan(0.5 * double(camera.fovY)) * image.width / image.height;
    std::vector<double> distances;
    for (int x = 2; x + 2 < image.width; ++x) {
        const auto at = [&](int dx) {
            return image.pixels[static_cast<std::size_t>(row * image.width + x + dx)].r;
        };
        const float before = at(0) - at(-1), step = at(1) - at(0), after = at(2) - at(1);
        const bool steepest = std::abs(step) > std::abs(before) && std::abs(step) > std::abs(after);
        if (!steepest || std::abs(step - 0.5f * (before + after)) <= jump) continue;
        // The border of two pixels; the picture's right is the world's left.
        const double along = -halfWidth * (2.0 * (x + 1) / image.width - 1.0);
        distances.push_back(std::hypot(along - double(kCornerLamp.x), 0.5 - double(kCornerLamp.y)));
    }
    return distances;
}

}  // namespace

TEST_F(ThesisModeTest, RingsAroundTheLampAppearAndDisappear) {
    Scene scene = room();
    scene.lights = {lamp(kCornerLamp, glm::vec3(1))};
    Settings settings = thesisSettings();
    settings.component = Component::Occlusion;
    const Camera camera = ceilingCamera();
    const auto jumps = [&] {
        return jumpsAlongTheCeiling(render(scene, settings, camera, 512, 16), camera, 0.03f);
    };
    EXPECT_EQ(jumps().size(), 0u) << "mended";

    // The published march samples at t_k = 0.08 r^k and has one sample more wherever the lamp's distance
    // passes one of them.
    settings.groups.of<thesis::ThesisSettings>().published = true;
    const std::vector<double> published = jumps();
    EXPECT_GE(published.size(), 8u);
    const double ratio = 1 + 0.35 * 2 * std::tan(0.2);
    for (const double distance : published) {
        const double k = std::log(distance / 0.08) / std::log(ratio);
        EXPECT_NEAR(k, std::round(k), 0.06) << "at " << distance;
    }

    // The cut last step alone makes the rings: with all else as published, weighting it removes them.
    settings.groups.of<thesis::ThesisSettings>().published = false;
    for (bool* flag : thesis::thesisDefectFlags(settings.groups.of<thesis::ThesisSettings>().defects))
        *flag = true;
    settings.groups.of<thesis::ThesisSettings>().defects.lastStep = false;
    EXPECT_EQ(jumps().size(), 0u);
}

TEST_F(ThesisModeTest, MendedPicturesAreFinite) {
    const Scene scene = furnishedRoom();
    for (const Component component :
         {Component::Full, Component::Direct, Component::Indirect, Component::Diffuse, Component::Specular,
          Component::Occlusion, Component::Voxels}) {
        Settings settings = thesisSettings();
        settings.component = component;
        const Image image = render(scene, settings);
        for (const glm::vec4& p : image.pixels)
            ASSERT_TRUE(std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && p.r >= 0)
                << int(component);
        EXPECT_GT(meanOf(image), 1e-4) << int(component);
    }
    // All diffuse cones off is a picture too: the original divides by their number.
    Settings none = thesisSettings();
    none.groups.of<thesis::ThesisSettings>().frontCone =
        none.groups.of<thesis::ThesisSettings>().intermediateCones = false;
    for (const bool published : {false, true}) {
        none.groups.of<thesis::ThesisSettings>().published = published;
        for (const glm::vec4& p : render(scene, none).pixels) ASSERT_TRUE(std::isfinite(p.r));
    }
}

TEST_F(ThesisModeTest, ComponentsAddUpToThePicture) {
    const Scene scene = furnishedRoom();
    for (const bool published : {false, true}) {
        Settings settings = thesisSettings();
        settings.groups.of<thesis::ThesisSettings>().published = published;
        // The one thing in a published picture that two runs may differ in.
        if (published) {
            settings.groups.of<thesis::ThesisSettings>().published = false;
            for (bool* flag : thesis::thesisDefectFlags(settings.groups.of<thesis::ThesisSettings>().defects))
                *flag = true;
            settings.groups.of<thesis::ThesisSettings>().defects.racingStores = false;
        }
        const auto part = [&](Component component) {
            settings.component = component;
            return render(scene, settings);
        };
        const Image full = part(Component::Full), direct = part(Component::Direct),
                    diffuse = part(Component::Diffuse);
        const Image specular = part(Component::Specular), indirect = part(Component::Indirect);
        double largest = 0;
        for (std::size_t i = 0; i < full.pixels.size(); ++i) {
            const glm::vec4 sum = direct.pixels[i] + diffuse.pixels[i] + specular.pixels[i];
            const glm::vec4 both = direct.pixels[i] + indirect.pixels[i];
            for (int c = 0; c < 3; ++c) {
                largest = std::max(largest, double(std::abs(full.pixels[i][c] - sum[c])));
                largest = std::max(largest, double(std::abs(full.pixels[i][c] - both[c])));
            }
        }
        EXPECT_LT(largest, 1e-5) << (published ? "published" : "mended");
        EXPECT_GT(meanOf(diffuse), 1e-3);
        EXPECT_GT(meanOf(specular), 1e-4);
    }
}

TEST_F(ThesisModeTest, EverySwitchOfThePictureDoesSomething) {
    const Scene scene = furnishedRoom();
    const Settings settings = thesisSettings();
    const Image usual = render(scene, settings);
    for (const char* key : {"phong", "phong_diffuse", "phong_specular", "vox_diffuse", "vox_specular",
                            "vox_shadows", "front_cone", "side_cones", "intermediate_cones"}) {
        Settings other = settings;
        const std::string name = std::string("thesis.") + key;
        setSetting(other, name, getSetting(other, name) == "true" ? "false" : "true");
        EXPECT_GT(largestDifference(usual, render(scene, other)), 0.01) << name;
    }
    for (const auto& [key, value] : {std::pair{"voxelize_along", "x"}, {"filter", "nearest"}}) {
        Settings other = settings;
        setSetting(other, std::string("thesis.") + key, value);
        EXPECT_GT(largestDifference(usual, render(scene, other)), 0.01) << key;
    }
    for (const char* key : {"diffuse", "specular", "occlusion"}) {
        // The first hit of a diffuse cone differs from a march through where it is one sample.
        Settings one = settings;
        one.groups.of<thesis::ThesisSettings>().defects.hardFirstHit = true;
        Settings other = one;
        setSetting(other, std::string("thesis.") + key + ".variant", "regular");
        EXPECT_GT(largestDifference(render(scene, one), render(scene, other)), 0.005) << key;
    }
    // Ambient light shows only where no cones bring indirect light.
    Settings local = settings, dark = settings;
    local.groups.of<thesis::ThesisSettings>().voxDiffuse =
        dark.groups.of<thesis::ThesisSettings>().voxDiffuse = false;
    dark.groups.of<thesis::ThesisSettings>().phongAmbient = false;
    EXPECT_GT(largestDifference(render(scene, local), render(scene, dark)), 0.01);
}

// Each defect, switched on in the mended picture or off in the published one, is seen in at least one of
// them.
TEST_F(ThesisModeTest, EveryDefectChangesThePicture) {
    Scene scene = furnishedRoom();
    for (int i = 0; i < 9; ++i)  // an eleventh lamp, for the defect that stops at ten
        scene.lights.push_back(lamp({0.3f, 0.3f, -0.3f}, glm::vec3(0.02f)));
    Renderer renderer;
    renderer.setScene(scene);
    int size = 64;
    const auto picture = [&](const thesis::ThesisDefects& defects) {
        Settings settings = thesisSettings(size);
        // They can graze.
        settings.groups.of<thesis::ThesisSettings>().sideCones = true;
        settings.groups.of<thesis::ThesisSettings>().minSpecular = 0;
        settings.groups.of<thesis::ThesisSettings>().defects = defects;
        renderer.render(pos2(), 48, 36, settings);
        return renderer.readImage();
    };
    thesis::ThesisDefects none, all;
    for (bool* flag : thesis::thesisDefectFlags(all)) *flag = true;
    // Stores that race differ from run to run anyway.
    all.racingStores = false;
    Image mended = picture(none), published = picture(all);
    std::vector<std::string> names;
    for (const SettingInfo& info : settingInfos())
        if (info.key.rfind("thesis.defects.", 0) == 0) names.push_back(info.key);
    ASSERT_EQ(names.size(), thesis::thesisDefectFlags(none).size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        thesis::ThesisDefects one = none, others = all;
        if (names[i] == "thesis.defects.capped_levels") {
            // 64 voxels have no more levels than seven.
            size = 256;
            mended = picture(none);
            published = picture(all);
        }
        *thesis::thesisDefectFlags(one)[i] = true;
        double difference = largestDifference(mended, picture(one));
        if (difference < 1e-3) {
            *thesis::thesisDefectFlags(others)[i] = !*thesis::thesisDefectFlags(others)[i];
            difference = largestDifference(published, picture(others));
        }
        EXPECT_GT(difference, 1e-3) << names[i];
        if (size != 64) {
            size = 64;
            mended = picture(none);
            published = picture(all);
        }
    }
}

TEST_F(ThesisModeTest, SameBitsEveryTime) {
    const Scene scene = furnishedRoom();
    const Settings settings = thesisSettings();
    const Image a = render(scene, settings), b = render(scene, settings);
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec4)), 0);
}

TEST_F(ThesisModeTest, AHairOfShiftDoesNotMoveTheShade) {
    // Seen: the right wall's visibility of the lamp.
    Camera camera;
    camera.eye = {-0.3f, 0, 0};
    camera.target = {0.5f, 0, 0};
    Settings settings = thesisSettings();
    settings.component = Component::Occlusion;
    const auto shift = [&] {
        return std::abs(meanOf(render(room(0.5f), settings, camera)) -
                        meanOf(render(room(0.499999f), settings, camera)));
    };
    EXPECT_LT(shift(), 0.01);
    // The grid of the original has its faces on the walls.
    settings.groups.of<thesis::ThesisSettings>().defects.wholeGrid = true;
    EXPECT_LT(shift(), 0.01);
    settings.groups.of<thesis::ThesisSettings>().published = true;
    EXPECT_GT(shift(), 0.1);
}

TEST_F(ThesisModeTest, AnEmptyRoomShadowsNothing) {
    // The floor away from the corners, from above.
    Camera camera;
    camera.eye = {0, 0.3f, 0};
    camera.target = {0, -0.5f, 0};
    camera.up = {0, 0, -1};
    camera.fovY = 0.7f;
    Settings settings = thesisSettings();
    settings.component = Component::Occlusion;
    EXPECT_GT(meanOf(render(room(), settings, camera)), 0.95);
    settings.groups.of<thesis::ThesisSettings>().published = true;
    EXPECT_LT(meanOf(render(room(), settings, camera)), 0.6);
}

TEST_F(ThesisModeTest, BrightnessDoesNotDependOnTheSize) {
    Settings settings = thesisSettings();
    settings.component = Component::Diffuse;
    const auto mean = [&](int size) {
        settings.voxels.size = size;
        return meanOf(render(room(), settings));
    };
    const double coarse = mean(64), fine = mean(128);
    EXPECT_NEAR(fine / coarse, 1.0, 0.15);
    // The original's first hit fades with the size (the weight by occlusion would hide some of it).
    for (bool* flag : thesis::thesisDefectFlags(settings.groups.of<thesis::ThesisSettings>().defects))
        *flag = true;
    settings.groups.of<thesis::ThesisSettings>().defects.occludedIndirect = false;
    setSetting(settings, "thesis.diffuse.dist_factor", "0.1");
    const double dimCoarse = mean(64), dimFine = mean(128);
    EXPECT_LT(dimFine / dimCoarse, 0.75);
}

TEST_F(ThesisModeTest, LeftIsRedRightIsGreen) {
    const Image image = render(room(), thesisSettings());
    const auto at = [&](int x) {
        return image.pixels[static_cast<std::size_t>(image.height / 2 * image.width + x)];
    };
    EXPECT_GT(at(20).r, 1.5f * at(20).g);
    EXPECT_GT(at(image.width - 21).g, 1.5f * at(image.width - 21).r);
}

TEST_F(ThesisModeTest, LookupsAreCounted) {
    Renderer renderer;
    renderer.setScene(room());
    renderer.setProfiling(true, true);
    Settings settings = thesisSettings();
    const auto lookups = [&] {
        renderer.render(pos2(), 64, 48, settings);
        double sum = 0;
        for (const auto& [kind, mean] : renderer.stats().lookupsPerPixel) sum += mean;
        return sum;
    };
    const double usual = lookups();
    EXPECT_GT(usual, 5.0);
    settings.groups.of<thesis::ThesisSettings>().voxSpecular =
        settings.groups.of<thesis::ThesisSettings>().voxShadows = false;
    const double diffuse = lookups();
    EXPECT_LT(diffuse, usual);
    settings.groups.of<thesis::ThesisSettings>().voxDiffuse = false;
    EXPECT_EQ(lookups(), 0.0);
}

}  // namespace conelight::test
