// SPDX-License-Identifier: MIT
// Pictures in parts: they have the bits of those that are drawn at once; one that is dropped harms no other.
#include <cstring>

#include "conelight/error.h"
#include "conelight/quality.h"
#include "conelight/renderer.h"
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
    Settings stills = partSettings(Mode::Traced), smooth = stills, cones = partSettings(Mode::Cones);
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
                            Case{"yard", smooth, 10}, Case{"cornell-point", cones, 2}}) {
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
            for (int i = 0; i < parts; ++i) renderer.goOn(0);
            renderer.setInstance(last, place);
            EXPECT_FALSE(renderer.drawing());
        }
        for (int i = 0; i < 4; ++i) renderer.render(camera, kWidth, kHeight, settings);
        return renderer.readImage();
    };
    const Image expected = moved(0);
    for (const int parts : {3, 5, 7}) EXPECT_LT(relRmse(moved(parts), expected), 0.12) << parts;
}

}  // namespace
}  // namespace conelight::test
