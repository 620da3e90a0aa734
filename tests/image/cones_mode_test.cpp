// SPDX-License-Identifier: MIT
// Pictures of the cones mode against what must be so: furnace, sky, dark room, bleeding of colour, emission
// counted once, the same bits every time.
#include <algorithm>
#include <cmath>
#include <optional>

#include "conelight/renderer.h"
#include "io/generated.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 48;

Settings smallSettings(Component component = Component::Full) {
    Settings settings;
    settings.mode = Mode::Cones;
    settings.component = component;
    settings.voxels.size = 32;
    settings.cones.bounces = 1;
    settings.light.shadowSize = 256;
    settings.light.areaSamples = 4;
    return settings;
}

struct Range {
    float low = 3e38f, high = -3e38f;
    double mean = 0;
};

// Of one channel over a rectangle of pixels [x0, x1) x [y0, y1), row 0 at the top; fails on NaN and Inf.
Range rangeOf(const Image& image, int x0, int y0, int x1, int y1, int channel = 1) {
    Range range;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const glm::vec4& p =
                image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x)];
            range.low = std::min(range.low, p[channel]);
            range.high = std::max(range.high, p[channel]);
            range.mean += static_cast<double>(p[channel]) / ((x1 - x0) * (y1 - y0));
            for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(p[c])) << x << ", " << y;
        }
    return range;
}
Range rangeOf(const Image& image, int channel = 1) {
    return rangeOf(image, 0, 0, image.width, image.height, channel);
}

class ConesModeTest : public GlTest {
  protected:
    Image render(const Scene& scene, const Settings& settings) {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        return renderer.readImage();
    }
};

// In a closed box every cone ends at a wall: what is gathered is the walls' radiance e, so the diffuse part
// is albedo * e. Area: measured 0.982 at worst, in corners, where a cone leaves between two walls. No cone
// may see more than there is (half: 1 / 2048).
TEST_F(ConesModeTest, FurnaceLosesNoLight) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    for (const char* directional : {"six", "isotropic"}) {
        for (const char* set : {"1", "6", "9"}) {
            Settings settings = smallSettings(Component::Diffuse);
            setSetting(settings, "cones.directional", directional);
            setSetting(settings, "cones.diffuse_set", set);
            const Range area = rangeOf(render(scene, settings));
            EXPECT_GE(area.low, 0.5f * 0.96f) << directional << " " << set;
            EXPECT_GE(area.mean, 0.5 * 0.995) << directional << " " << set;
            EXPECT_LE(area.high, 0.5f * (1 + 1.0f / 1024)) << directional << " " << set;
            setSetting(settings, "cones.opacity", "fog");
            EXPECT_LE(rangeOf(render(scene, settings)).high, 0.5f * (1 + 1.0f / 1024)) << directional;
        }
    }
}

// Every bounce adds its power of the albedo: e (1 + a + a^2 ...), never more than e / (1 - a).
TEST_F(ConesModeTest, FurnaceBounceByBounce) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    Settings settings = smallSettings();
    double expected = 1;
    double power = 1;
    for (int bounces = 0; bounces <= 8; ++bounces) {
        settings.cones.bounces = bounces;
        if (bounces <= 2 || bounces == 8) {
            const Range full = rangeOf(render(scene, settings));
            EXPECT_NEAR(full.mean / expected, 1, 0.01) << bounces;     // corners, see FurnaceLosesNoLight
            EXPECT_LE(full.high, 2.0f * (1 + 1.0f / 256)) << bounces;  // RGB9E5 in the records
        }
        power *= 0.5;
        expected += power;
    }
}

// A furnace of rough metal: the specular cone brings the same radiance, times the lobe's albedo of nearly 1.
TEST_F(ConesModeTest, FurnaceOfMetal) {
    Material metal = diffuseMaterial({1, 1, 1}, {1, 1, 1});
    metal.metallic = 1;
    for (const float roughness : {0.05f, 0.3f, 0.6f, 1.0f}) {
        metal.roughness = roughness;
        const Image image = render(closedBox(metal), smallSettings(Component::Specular));
        // Fit of the directional albedo 1 %; the narrowest cone slips through a corner now and then: 0.972.
        EXPECT_NEAR(rangeOf(image).mean, 1, 0.04) << roughness;
        EXPECT_EQ(rangeOf(render(closedBox(metal), smallSettings(Component::Diffuse))).high, 0.0f);
    }
}

TEST_F(ConesModeTest, EmptySceneIsSky) {
    Scene scene;
    scene.sky = {0.25f, 0.5f, 2};
    scene.cameras.push_back(Camera{});
    const Image image = render(scene, smallSettings());
    for (const glm::vec4& p : image.pixels) ASSERT_EQ(p, glm::vec4(0.25f, 0.5f, 2, 0));
}

// Nothing above a plane but sky: E = pi L, whatever the cones, up to the half in which it is kept.
TEST_F(ConesModeTest, PlaneUnderTheSky) {
    for (const glm::vec3& up :
         {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::normalize(glm::vec3(1, 2, -1))}) {
        Scene scene;
        const glm::vec3 u = glm::normalize(glm::cross(up, glm::vec3(0.3f, 0.2f, 1)));
        const glm::vec3 v = glm::cross(up, u);
        addInstance(scene, quadMesh(-2.0f * (u + v), 4.0f * u, 4.0f * v),
                    diffuseMaterial({0.5f, 0.5f, 0.5f}));
        scene.sky = {1, 2, 3};
        Camera camera;
        camera.eye = up + 0.1f * u;
        camera.target = {0, 0, 0};
        camera.up = u;
        scene.cameras.push_back(camera);
        const Range seen = rangeOf(render(scene, smallSettings(Component::Diffuse)));
        // A plane along the grid is never met by its own cones. A slanted one is stairs to cones that go low
        // over it, which see the sides of the steps: measured 0.963.
        const bool alongGrid = std::abs(up.y) == 1;
        EXPECT_NEAR(seen.low, 1.0f, alongGrid ? 1.0f / 1024 : 0.06f);
        EXPECT_LE(seen.high, 1.0f + 1.0f / 1024);
        // Isotropic texels have no sides, so the plane hides sky from itself; but it never adds any.
        Settings isotropic = smallSettings(Component::Diffuse);
        isotropic.cones.directional = VolumeDirections::Isotropic;
        EXPECT_LE(rangeOf(render(scene, isotropic)).high, 1.0f + 1.0f / 1024);
    }
}

TEST_F(ConesModeTest, ClosedBlackBoxIsBlack) {
    Scene scene = closedBox(diffuseMaterial({0, 0, 0}));
    scene.sky = {100, 100, 100};
    const Image image = render(scene, smallSettings());
    for (const glm::vec4& p : image.pixels) {
        ASSERT_EQ(glm::vec3(p), glm::vec3(0));
        ASSERT_EQ(p.a, 1.0f);
    }
}

// A closed room is dark inside though the sky is bright: what leaks through its corners
// (FurnaceLosesNoLight).
TEST_F(ConesModeTest, ClosedRoomKeepsTheSkyOut) {
    Scene scene = closedBox(diffuseMaterial({0.8f, 0.8f, 0.8f}));
    scene.sky = {1, 1, 1};
    EXPECT_LE(rangeOf(render(scene, smallSettings())).mean, 0.8 * 0.005);
}

TEST_F(ConesModeTest, SameBitsEveryTime) {
    const Scene scene = io::generateScene("cornell");
    Settings settings = smallSettings();
    settings.cones.bounces = 2;
    const Image first = render(scene, settings);
    const Image second = render(scene, settings);
    EXPECT_EQ(first.pixels, second.pixels);
    EXPECT_GT(rangeOf(first).mean, 0.01);
}

// The octree changes where radiance lies, not what cones read: what is left is rounding of coordinates,
// which the halves between bounces may enlarge to 6e-5, and filters of GPUs, which mix in 8 bits, to 4e-4.
TEST_F(ConesModeTest, OctreeGivesThePictureOfTheDenseVolume) {
    for (const char* name : {"cornell", "sunroom", "spheres"}) {
        const Scene scene = io::generateScene(name);
        for (const char* directional : {"six", "isotropic"})
            for (const Component component : {Component::Indirect, Component::Occlusion, Component::Voxels}) {
                Settings settings = smallSettings(component);
                settings.voxels.size = 64;
                settings.cones.bounces = 2;
                setSetting(settings, "cones.directional", directional);
                const Image dense = render(scene, settings);
                setSetting(settings, "cones.storage", "octree");
                EXPECT_LT(relRmse(render(scene, settings), dense), 1e-3) << name << " " << directional;
            }
    }
}

// One renderer, from one storage to the other and back.
TEST_F(ConesModeTest, StorageMayChange) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    const auto picture = [&](VolumeStorage storage) {
        Settings settings = smallSettings();
        settings.cones.storage = storage;
        renderer.render(scene.cameras[0], kPixels, kPixels, settings);
        return renderer.readImage();
    };
    const Image dense = picture(VolumeStorage::Dense);
    const Image octree = picture(VolumeStorage::Octree);
    EXPECT_LT(relRmse(octree, dense), 5e-5);
    EXPECT_EQ(picture(VolumeStorage::Dense).pixels, dense.pixels);
    EXPECT_EQ(picture(VolumeStorage::Octree).pixels, octree.pixels);
}

// The parts add up to the whole, and what was built for one picture serves the next.
TEST_F(ConesModeTest, PartsAddUp) {
    const Scene scene = io::generateScene("cornell");
    Renderer renderer;
    renderer.setScene(scene);
    const auto picture = [&](Component component) {
        renderer.render(scene.cameras[0], kPixels, kPixels, smallSettings(component));
        return renderer.readImage();
    };
    // First a part that needs no voxels: they are built when they are needed.
    const Image direct = picture(Component::Direct);
    const Image full = picture(Component::Full);
    const Image diffuse = picture(Component::Diffuse);
    const Image specular = picture(Component::Specular);
    const Image indirect = picture(Component::Indirect);
    for (std::size_t i = 0; i < full.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float sum = diffuse.pixels[i][c] + specular.pixels[i][c];
            ASSERT_NEAR(indirect.pixels[i][c], sum, 1e-5f * (1 + sum));
            ASSERT_NEAR(full.pixels[i][c], direct.pixels[i][c] + sum, 1e-5f * (1 + full.pixels[i][c]));
        }
}

// The white back wall of the Cornell box is reddish beside the red wall (left) and greenish beside the green.
TEST_F(ConesModeTest, ColourBleeds) {
    const Image image = render(io::generateScene("cornell"), smallSettings(Component::Indirect));
    // Two strips of the back wall, above the boxes (picture fractions 0.23..0.28 and 0.72..0.77).
    const auto redness = [&](int x0, int x1) {
        return rangeOf(image, x0, 13, x1, 19, 0).mean / rangeOf(image, x0, 13, x1, 19, 1).mean;
    };
    EXPECT_GT(redness(11, 13), 1.15 * redness(35, 37));
}

// A lamp that is a rectangle shines exactly, by itself, and must not be met by cones a second time.
TEST_F(ConesModeTest, LampsCountOnce) {
    Scene scene = closedBox(diffuseMaterial({0, 0, 0}));
    scene.materials[2] = diffuseMaterial({0.5f, 0.5f, 0.5f});  // the floor alone is not black
    addInstance(scene, quadMesh({-0.4f, 0.9f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}),
                diffuseMaterial({0, 0, 0}, {5, 5, 5}));
    scene.cameras[0].target = {0, -1, -0.3f};
    Settings settings = smallSettings(Component::Diffuse);
    const double exact = rangeOf(render(scene, settings)).mean;
    settings.light.emissiveQuads = false;
    const double gathered = rangeOf(render(scene, settings)).mean;
    EXPECT_EQ(exact, 0.0);
    // Gathered by six cones it is rough, but there (measured 1.6 times the exact light).
    settings.component = Component::Direct;
    settings.light.emissiveQuads = true;
    const double direct = rangeOf(render(scene, settings)).mean;
    EXPECT_GT(direct, 0.02);
    EXPECT_GT(gathered, 0.5 * direct);
    EXPECT_LT(gathered, 2 * direct);
}

// The volume itself: level 0 of the furnace shows the walls' own radiance everywhere.
TEST_F(ConesModeTest, VoxelsShowTheirRadiance) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    for (int level = 0; level <= 2; ++level) {
        Settings settings = smallSettings(Component::Voxels);
        settings.cones.voxelLevel = level;
        const Image image = render(scene, settings);
        EXPECT_NEAR(rangeOf(image).low, 1, 1.0f / 256) << level;
        EXPECT_NEAR(rangeOf(image).high, 1, 1.0f / 256) << level;
        EXPECT_EQ(rangeOf(image, 3).low, 1.0f) << level;  // no hole
    }
}

// The middle of a wall is open, the corner of a room less; everything is within [0,1].
TEST_F(ConesModeTest, OcclusionDarkensCorners) {
    Scene scene = closedBox(diffuseMaterial({0.5f, 0.5f, 0.5f}));
    Settings settings = smallSettings(Component::Occlusion);
    settings.cones.occlusionDistance = {false, 0.5f};
    scene.cameras[0].eye = {0, 0, 0.9f};
    scene.cameras[0].target = {0, 0, -1};
    scene.cameras[0].fovY = 0.9f;  // the back wall and a little of the others
    const Image image = render(scene, settings);
    const int middle = kPixels / 2;
    const Range open = rangeOf(image, middle - 2, middle - 2, middle + 2, middle + 2);
    EXPECT_GT(open.low, 0.97f);
    EXPECT_LT(rangeOf(image).low, 0.8f * open.low);
    EXPECT_GE(rangeOf(image).low, 0.0f);
    EXPECT_LE(rangeOf(image).high, 1.0f + 1.0f / 1024);
}

// Rays fill the cache with all bounces: the furnace is whole, where two bounces of cones hold three quarters of it.
// What other light the volume holds is nobody else's: the bits come back.
TEST_F(ConesModeTest, ReadsTheCacheOfRays) {
    const Scene scene = io::generateScene("furnace?albedo=0.5&emission=1");
    Settings settings = smallSettings(Component::Diffuse);
    Renderer renderer;
    renderer.setScene(scene);
    const auto draw = [&] {
        renderer.render(scene.cameras.at(0), kPixels, kPixels, settings);
        return renderer.readImage();
    };
    const Image cones = draw();
    settings.cones.indirect = ConesIndirect::Cache;
    // emission / (1 - albedo) = 2, reflected by an albedo of 0.5.
    EXPECT_NEAR(rangeOf(draw()).mean, 1.0, 0.04);
    settings.cones.indirect = ConesIndirect::Cones;
    EXPECT_EQ(draw().pixels, cones.pixels);
}

// The powers of two of levels are no more than a choice of texels: a picture between levels is nearly the same.
TEST_F(ConesModeTest, FractionalLevelsChangeLittle) {
    const Scene scene = io::generateScene("cornell-point");
    Settings settings = smallSettings(Component::Diffuse);
    const Image whole = render(scene, settings);
    settings.cones.fractionalLevels = true;
    const double change = relRmse(render(scene, settings), whole);
    EXPECT_GT(change, 1e-4);  // it does something
    EXPECT_LT(change, 0.15);
}

}  // namespace
}  // namespace conelight::test
