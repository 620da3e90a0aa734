// SPDX-License-Identifier: MIT
// Rays for fewer pixels (TracedSettings::reduction): the picture is that of all pixels but for noise, at any size, as a
// still and while the eye moves, and what looks at it leaves it alone.
#include <cmath>

#include "io/generated.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

// Odd, so that the last of the fewer pixels lie across the rim.
constexpr int kWidth = 97, kHeight = 73;

class ReductionTest : public TracedModeTest {
  protected:
    static Settings settings(int reduction) {
        Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
        settings.traced.reduction = reduction;
        return settings;
    }
    static Image drawn(Renderer& renderer, const Camera& camera, const Settings& settings) {
        renderer.render(camera, kWidth, kHeight, settings);
        return renderer.readImage();
    }
    static Image drawn(const Scene& scene, const Settings& settings) {
        Renderer renderer;
        renderer.setScene(scene);
        return drawn(renderer, scene.cameras.front(), settings);
    }
    // At voxels and light, of a pixel's rays for irradiance.
    static double lookups(const Scene& scene, const Settings& settings) {
        Renderer renderer;
        renderer.setScene(scene);
        renderer.setProfiling(true, true);
        drawn(renderer, scene.cameras.front(), settings);
        double sum = 0;
        for (const auto& [name, count] : renderer.stats().lookupsPerPixel)
            if (name == "diffuse") sum += count;
        return sum;
    }
    // Root mean square of what two pictures differ by, over the mean of the second.
    static double difference(const Image& a, const Image& b) {
        double square = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            const glm::dvec3 apart(a.pixels[i] - b.pixels[i]);
            square += glm::dot(apart, apart) / (3.0 * static_cast<double>(a.pixels.size()));
        }
        return std::sqrt(square) / meanOf(b);
    }
    // Pixels that are darker than a third of what they should be.
    static int holes(const Image& image, const Image& whole) {
        const double least = 0.1 * meanOf(whole);
        int count = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double own = static_cast<double>(image.pixels[i].g);
            const double wanted = static_cast<double>(whole.pixels[i].g);
            count += wanted > least && own < wanted / 3 ? 1 : 0;
        }
        return count;
    }
};

TEST_F(ReductionTest, PicturesAreThoseOfAllPixels) {
    const Scene scene = io::generateScene("study");
    const Image whole = drawn(scene, settings(1));
    const double most = lookups(scene, settings(1));
    for (const int reduction : {2, 3, 4}) {
        const Image image = drawn(scene, settings(reduction));
        const double apart = difference(image, whole);
        RecordProperty("apart" + std::to_string(reduction), std::to_string(apart));
        EXPECT_LT(apart, 0.025 * reduction) << reduction;
        EXPECT_NEAR(meanOf(image) / meanOf(whole), 1, 0.01) << reduction;
        EXPECT_EQ(holes(image, whole), 0) << reduction;
        // What is taken over is looked up, too.
        EXPECT_LT(lookups(scene, settings(reduction)), (1.1 / (reduction * reduction) + 0.06) * most)
            << reduction;
    }
}

// Balusters and leaves are finer than the pixels that gather: they take what is beside them, or the cache.
TEST_F(ReductionTest, ThinThingsAreLit) {
    const Scene scene = io::generateScene("atrium?triangles=20000");
    const Image whole = drawn(scene, settings(1));
    const Image image = drawn(scene, settings(2));
    const double apart = difference(image, whole);
    RecordProperty("apart", std::to_string(apart));
    RecordProperty("holes", std::to_string(holes(image, whole)));
    EXPECT_LT(apart, 0.4);                                   // 0.6 if nothing stood in
    EXPECT_LT(holes(image, whole), kWidth * kHeight / 100);  // 989 then
}

// Views beside the pixels' centres go on from what fewer pixels gathered.
TEST_F(ReductionTest, EdgesOfStillsAreSmoothed) {
    const Scene scene = io::generateScene("study");
    Settings all = settings(1), fewer = settings(2);
    all.image.antialiasing = fewer.image.antialiasing = 4;
    EXPECT_LT(difference(drawn(scene, fewer), drawn(scene, all)), 0.06);
}

// One pass a frame, and an eye that goes aside: at rest again it comes to the light of a finished picture.
TEST_F(ReductionTest, MeansFollowTheEye) {
    const Scene scene = io::generateScene("study");
    Settings moving = settings(2);
    moving.traced.budgeted = true;
    Renderer renderer;
    renderer.setScene(scene);
    Camera camera = scene.cameras.front();
    for (int frame = 0; frame < 24; ++frame) {
        camera.eye.x += frame < 12 ? 0.01f : 0.0f;
        drawn(renderer, camera, moving);
    }
    const Image image = renderer.readImage();
    Renderer other;
    other.setScene(scene);
    const Image whole = drawn(other, camera, settings(1));
    const double apart = difference(image, whole);
    RecordProperty("apart", std::to_string(apart));
    EXPECT_LT(apart, 0.08);
    EXPECT_EQ(holes(image, whole), 0);
}

// What a pixel gathers is told at the place of the pixel; the next frame is as if nobody had asked.
TEST_F(ReductionTest, InspectionsLeaveThePictureAlone) {
    const Scene scene = io::generateScene("study");
    Settings moving = settings(2);
    moving.traced.budgeted = true;
    const auto frames = [&](bool inspects) {
        Renderer renderer;
        renderer.setScene(scene);
        for (int frame = 0; frame < 4; ++frame) {
            drawn(renderer, scene.cameras.front(), moving);
            if (!inspects) continue;
            EXPECT_FALSE(renderer.inspectPixel(kWidth - 1, kHeight - 1).paths.empty());
        }
        return renderer.readImage();
    };
    EXPECT_EQ(frames(true).pixels, frames(false).pixels);
}

// All pixels gather again, as if they had never done otherwise.
TEST_F(ReductionTest, IsTakenBack) {
    const Scene scene = io::generateScene("glossy");
    Renderer renderer;
    renderer.setScene(scene);
    drawn(renderer, scene.cameras.front(), settings(4));
    const Image again = drawn(renderer, scene.cameras.front(), settings(1));
    EXPECT_EQ(again.pixels, drawn(scene, settings(1)).pixels);
}

}  // namespace
}  // namespace conelight::test
