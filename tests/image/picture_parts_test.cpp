// SPDX-License-Identifier: MIT
// Pictures in parts: they have the bits of those that are drawn at once; one that is dropped harms no other.
#include <algorithm>
#include <cstring>

#include "conelight/error.h"
#include "conelight/quality.h"
#include "conelight/renderer.h"
#include "conelight/thesis/settings.h"
#include "gl/program.h"
#include "io/generated.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

constexpr int kWidth = 48, kHeight = 36;

Settings partSettings(Mode mode) {
    Settings settings;
    settings.mode = mode;
    applyQuality(settings.traced, Quality::Interactive);
    settings.traced.budgeted = true;
    settings.traced.cacheUpdates = 3;
    settings.voxels.size = 24;
    settings.light.shadowSize = 256;
    settings.image.antialiasing = 0;
    return settings;
}

bool sameBits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec4)) == 0;
}

class PicturePartsTest : public GlTest {
  protected:
    // In parts that are as short as they come; returns how many there were.
    static int drawInParts(Renderer& renderer, const Camera& camera, const Settings& settings) {
        renderer.begin(camera, kWidth, kHeight, settings);
        int parts = 1;
        while (!renderer.goOn(0)) ++parts;
        EXPECT_FALSE(renderer.drawing());
        return parts;
    }
};

TEST_F(PicturePartsTest, HaveTheBitsOfTheWhole) {
    Settings stills = partSettings(Mode::Traced), smooth = stills, cones = partSettings(Mode::Cones),
             cache = cones;
    cache.cones.indirect = ConesIndirect::Cache;
    stills.traced.budgeted = false;
    stills.traced.passes = 2;
    stills.image.antialiasing = 3;
    smooth.image.temporal = cones.image.temporal = Toggle::On;
    struct Case {
        const char* scene;
        Settings settings;
        int parts;  // at least
    };
    for (const Case& one : {Case{"glass", partSettings(Mode::Traced), 10}, Case{"spheres", stills, 10},
                            Case{"yard", smooth, 10}, Case{"glass", cones, 20},
                            Case{"cornell-point", cache, 20}, Case{"glass", partSettings(Mode::Phong), 10},
                            Case{"cornell-point", partSettings(thesis::kMode), 10}}) {
        const Scene scene = io::generateScene(one.scene);
        Camera camera = scene.cameras.front();
        Renderer whole({"", true}), parts({"", true});
        whole.setScene(scene);
        parts.setScene(scene);
        for (int frame = 0; frame < 3; ++frame) {
            if (frame == 2) camera.eye += glm::vec3(0.01f, 0.02f, 0);
            whole.render(camera, kWidth, kHeight, one.settings);
            EXPECT_GE(drawInParts(parts, camera, one.settings), one.parts) << one.scene;
            EXPECT_TRUE(sameBits(whole.readImage(), parts.readImage())) << one.scene << ", frame " << frame;
        }
    }
}

// Until a picture is finished, the one before is what is shown, read and inspected.
TEST_F(PicturePartsTest, ThePictureBeforeStays) {
    const Scene scene = io::generateScene("spheres");
    const Settings settings = partSettings(Mode::Traced);
    Camera camera = scene.cameras.front();
    Renderer renderer({"", true});
    EXPECT_THROW(renderer.goOn(1), Error);
    EXPECT_THROW(renderer.begin(camera, kWidth, kHeight, settings), Error) << "without a scene";
    renderer.setScene(scene);
    EXPECT_THROW(renderer.begin(camera, 0, kHeight, settings), Error);
    renderer.render(camera, kWidth, kHeight, settings);
    const Image before = renderer.readImage();
    renderer.setProfiling(true, false);
    camera.eye.y += 0.3f;
    renderer.begin(camera, kWidth, kHeight, settings);
    bool finished = false;
    for (int parts = 0; !finished; ++parts) {
        if (parts % 5 == 0) {
            EXPECT_TRUE(sameBits(renderer.readImage(), before)) << parts;
            EXPECT_NE(renderer.displayTexture(settings.image), 0u);
        }
        finished = renderer.goOn(0);
    }
    EXPECT_FALSE(sameBits(renderer.readImage(), before));
    int diffuse = 0;
    for (const PassStats& pass : renderer.stats().passes) diffuse += pass.name == "diffuse rays";
    EXPECT_EQ(diffuse, 1) << "the pieces of a pass are one";

    // A pixel is one of the last picture, whatever was begun.
    const PixelInspection expected = renderer.inspectPixel(24, 26);
    renderer.begin(scene.cameras.front(), kWidth, kHeight, settings);
    for (int parts = 0; parts < 6; ++parts) renderer.goOn(0);
    const PixelInspection found = renderer.inspectPixel(24, 26);
    EXPECT_FALSE(renderer.drawing());
    EXPECT_EQ(found.position, expected.position);
    EXPECT_EQ(found.picture, expected.picture);
    EXPECT_THROW(renderer.goOn(1), Error) << "it was dropped";
}

// Dropped after any number of parts, by another picture or by a change of the scene.
TEST_F(PicturePartsTest, DroppedOnesHarmNoOther) {
    const Scene scene = io::generateScene("cornell-point");
    Settings settings = partSettings(Mode::Traced);
    settings.traced.cacheUpdates = 1;  // light is finished with the first picture
    const Camera camera = scene.cameras.front();
    Camera other = camera;
    other.eye.x += 0.1f;
    Renderer plain({"", true});
    plain.setScene(scene);
    plain.render(camera, kWidth, kHeight, settings);
    plain.render(camera, kWidth, kHeight, settings);
    const Image expected = plain.readImage();
    Renderer renderer({"", true});
    for (const int parts : {0, 1, 3, 5, 8}) {
        renderer.setScene(scene);
        renderer.render(camera, kWidth, kHeight, settings);
        renderer.begin(other, kWidth, kHeight, settings);
        for (int i = 0; i < parts; ++i) EXPECT_FALSE(renderer.goOn(0));
        renderer.drop();
        EXPECT_FALSE(renderer.drawing());
        renderer.render(camera, kWidth, kHeight, settings);
        // What was gathered for the other view is taken up, once it is whole.
        if (parts < 6)
            EXPECT_TRUE(sameBits(renderer.readImage(), expected)) << parts;
        else
            EXPECT_LT(relRmse(renderer.readImage(), expected), 0.1) << parts;
    }
}

// In the midst of an update of the light, and while an object goes away and comes back.
TEST_F(PicturePartsTest, DroppedOnesLeaveNoTraceOfWhatMoved) {
    const Scene scene = io::generateScene("cornell-point");
    const Settings settings = partSettings(Mode::Traced);
    const Camera camera = scene.cameras.front();
    const std::size_t last = scene.instances.size() - 1;
    Instance away = scene.instances[last];
    away.worldFromObject[3].x += 0.2f;
    const auto moved = [&](int parts) {
        Renderer renderer({"", true});
        renderer.setScene(scene);
        renderer.render(camera, kWidth, kHeight, settings);
        for (const Instance& place : {away, scene.instances[last]}) {
            renderer.begin(camera, kWidth, kHeight, settings);
            for (int i = 0; i < parts && renderer.drawing(); ++i) renderer.goOn(0);
            renderer.setInstance(last, place);
            EXPECT_FALSE(renderer.drawing());
        }
        for (int i = 0; i < 4; ++i) renderer.render(camera, kWidth, kHeight, settings);
        return renderer.readImage();
    };
    const Image expected = moved(0);
    for (const int parts : {1, 6, 13, 21, 26, 31, 37, 45})
        EXPECT_LT(relRmse(moved(parts), expected), 0.12) << parts;
}

// Modes without a memory: whatever was dropped while things moved, the picture is that of the scene as it is.
TEST_F(PicturePartsTest, DroppedOnesLeaveTheBitsOfOtherModes) {
    const Scene scene = io::generateScene("cornell-point");
    const Camera camera = scene.cameras.front();
    const std::size_t last = scene.instances.size() - 1;
    Instance away = scene.instances[last];
    away.worldFromObject[3].x += 0.2f;
    for (const Mode mode : {Mode::Cones, Mode::Phong, thesis::kMode}) {
        Settings settings = partSettings(mode), others = settings;
        others.voxels.size = 32;
        Renderer renderer({"", true});
        renderer.setScene(scene);
        renderer.render(camera, kWidth, kHeight, settings);
        const Image expected = renderer.readImage();
        int whole = 0;
        for (int parts = 1; parts < 60 && (whole == 0 || parts <= whole); parts += 4) {
            renderer.setInstance(last, away);
            renderer.begin(camera, kWidth, kHeight, parts % 8 == 1 ? settings : others);
            for (int i = 0; i < parts && renderer.drawing(); ++i)
                if (renderer.goOn(0)) whole = parts;
            renderer.setInstance(last, scene.instances[last]);
            renderer.render(camera, kWidth, kHeight, settings);
            EXPECT_TRUE(sameBits(renderer.readImage(), expected)) << parts << " of mode " << mode.name();
        }
    }
}

// The work between two rests, counted: a driver without a cache takes some 50 to 400 ms of CPU for each program that it has
// not met, as long as for the rest of a small picture.
TEST_F(PicturePartsTest, EachDoesLittle) {
    const Scene scene = io::generateScene("cornell-point");
    const Camera camera = scene.cameras.front();
    const std::size_t last = scene.instances.size() - 1;
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Settings settings = partSettings(mode);
        settings.image.temporal = Toggle::On;
        Renderer renderer({"", true});
        renderer.setScene(scene);
        std::uint64_t mostBuilt = 0, mostUsed = 0, built = 0;
        for (int frame = 0; frame < 2; ++frame) {
            Instance moved = scene.instances[last];
            moved.worldFromObject[3].x += 0.1f * static_cast<float>(frame);
            if (frame > 0) renderer.setInstance(last, moved);
            renderer.begin(camera, kWidth, kHeight, settings);
            for (bool finished = false; !finished;) {
                const gl::ProgramCounts before = gl::programCounts();
                finished = renderer.goOn(0);
                const gl::ProgramCounts after = gl::programCounts();
                mostBuilt = std::max(mostBuilt, after.built - before.built);
                mostUsed = std::max(mostUsed, after.used - before.used);
                built += after.built - before.built;
            }
        }
        EXPECT_LE(mostBuilt, 2u) << "of " << built << ", mode " << mode.name();
        EXPECT_LE(mostUsed, 8u) << "mode " << mode.name();
    }
}

// What a renderer is at, by its name: textures by how many there are, then passes in their order.
TEST_F(PicturePartsTest, TheirWorkIsTold) {
    Scene scene = io::generateScene("cornell-point");
    for (const char* name : {"a", "b", "c"})
        scene.textures.push_back({name, 1, 1, true, {}, {}, TextureFilter::Nearest, {255, 255, 255, 255}});
    Renderer renderer({"", true});
    EXPECT_EQ(renderer.work().name, "");
    renderer.setScene(scene);
    const PictureWork taken = renderer.work();
    EXPECT_EQ(taken.name, "textures");
    EXPECT_EQ(taken.done, 3u);
    EXPECT_EQ(taken.total, 3u);
    renderer.begin(scene.cameras.front(), kWidth, kHeight, partSettings(Mode::Traced));
    EXPECT_EQ(renderer.work().name, "") << "a picture begins with nothing";
    std::vector<std::string> told;
    for (bool finished = false; !finished;) {
        finished = renderer.goOn(0);
        if (const std::string name = renderer.work().name; told.empty() || told.back() != name)
            told.push_back(name);
    }
    auto at = told.begin();
    for (const char* name : {"gbuffer", "voxelize: mark", "irradiance: update", "diffuse rays"}) {
        at = std::find(at, told.end(), name);
        EXPECT_NE(at, told.end()) << name;
    }
}

}  // namespace
}  // namespace conelight::test
