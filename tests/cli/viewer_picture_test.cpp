// SPDX-License-Identifier: MIT
// The picture in the viewer's window as a photographer looks at it: smooth edges and depth of field at rest, white
// balance, instruments, a kept picture beside the live one.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/viewer_panels_support.h"
#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

class ViewerPictureTest : public ViewerPanelsTest {
  protected:
    io::FloatImage pictureNow(const std::string& file) {
        settle();
        viewer->send("screenshot " + file);
        EXPECT_TRUE(heard("written " + file)) << viewer->output();
        return io::readImage(file);
    }
};

// As a screen without a tone map shows it.
float shown(const io::FloatImage& image, std::size_t i) { return std::min(image.pixels.at(i), 1.0f); }

// RMS difference from the truth where the picture with stairs is far off, that is at edges.
double errorAtEdges(const io::FloatImage& image, const io::FloatImage& stairs, const io::FloatImage& truth) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        if (std::fabs(shown(stairs, i) - shown(truth, i)) < 0.05f) continue;
        const double error = static_cast<double>(shown(image, i) - shown(truth, i));
        sum += error * error;
        ++count;
    }
    EXPECT_GT(count, 200);
    return std::sqrt(sum / std::max(count, 1.0));
}

TEST_F(ViewerPictureTest, EdgesAreSmoothAndLensesFocusInTheDefaultMode) {
    const std::string folder = freshFolder("edges");
    start(
        "--window 480x320 --voxels 32 --mode traced --no-state --exec 'panels off; resolution 0.5' "
        "builtin:cornell");
    viewer->send("set image.temporal off");
    const io::FloatImage stairs = pictureNow(folder + "/stairs.exr");
    viewer->send("set image.temporal auto");
    viewer->statusUntil("mode",
                        [](const std::string& now) { return now.find("edges: view") != std::string::npos; });
    EXPECT_NE(viewer->output().find("edges: view"), std::string::npos);
    const io::FloatImage smooth = pictureNow(folder + "/smooth.exr");
    EXPECT_NE(viewer->status("mode").find("done"), std::string::npos);
    const auto still = [&](const std::string& options) {
        const std::string file = folder + "/still.exr";
        const std::string size = std::to_string(smooth.width) + "x" + std::to_string(smooth.height);
        EXPECT_EQ(conelight("render builtin:cornell --voxels 32 --mode traced --aa 64 --size " + size +
                            options + " -o '" + file + "'")
                      .status,
                  0);
        return io::readImage(file);
    };
    const io::FloatImage truth = still("");
    const double without = errorAtEdges(stairs, stairs, truth), with = errorAtEdges(smooth, stairs, truth);
    EXPECT_LT(with, 0.2 * without) << with << " against " << without;

    viewer->send("camera lens 0.2; camera focus 1.6");
    const io::FloatImage blurred = pictureNow(folder + "/lens.exr");
    const io::FloatImage focused = still(" --lens 0.2 --focus 1.6");
    const double sharp = errorAtEdges(smooth, smooth, focused), lens = errorAtEdges(blurred, smooth, focused);
    EXPECT_LT(lens, 0.2 * sharp) << lens << " against " << sharp;
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0);
}

// Parts of the pixels that are white in a channel, and black, in percent.
glm::dvec2 clippedIn(const io::ByteImage& image) {
    glm::dvec2 count(0);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const std::uint8_t* p = &image.pixels[i];
        count += glm::dvec2(std::max({p[0], p[1], p[2]}) == 255, std::max({p[0], p[1], p[2]}) == 0);
    }
    return 300.0 * count / static_cast<double>(image.pixels.size());
}

TEST_F(ViewerPictureTest, ExposureIsJudgedByMarksColoursAndHistograms) {
    const std::string shot = freshFolder("exposure") + "/shot.png";
    start(kSmall + "builtin:cornell");
    settle();
    viewer->send("screenshot " + shot);
    EXPECT_TRUE(heard("written " + shot)) << viewer->output();
    const glm::dvec2 clipped = clippedIn(io::readByteImage(shot));
    const std::string counted = answer("histogram", "histogram: ");
    double median = 0;
    glm::dvec2 told(-1);
    ASSERT_EQ(std::sscanf(counted.c_str(), "histogram: median %lf stops, %lf %% over, %lf %% under", &median,
                          &told.x, &told.y),
              3)
        << counted;
    EXPECT_NEAR(told.x, clipped.x, 0.01 + 0.01 * clipped.x);
    EXPECT_NEAR(told.y, clipped.y, 0.01 + 0.01 * clipped.y);
    EXPECT_GT(clipped.x, 0.1);

    // Stripes on what is lost, a colour per stop, and the key to these colours.
    const glm::ivec4 place = picture();
    const auto count = [&](const glm::ivec3& color) {
        const ScreenPixels now = screen->pixels();
        int found = 0;
        for (int y = place.y; y < place.y + place.w; ++y)
            for (int x = place.x; x < place.x + place.z; ++x) found += now.at({x, y}) == color;
        return found;
    };
    const glm::ivec3 red(255, 0, 64), grey(128);
    EXPECT_EQ(count(red), 0);
    screen->xdotool("key z");
    EXPECT_TRUE(eventually([&] { return count(red) > 50; }));
    screen->xdotool("key z");
    EXPECT_TRUE(eventually([&] { return count(red) == 0 && count(grey) > 50; }));
    EXPECT_EQ(viewer->setting("image.check"), "false_color");
    EXPECT_TRUE(near(glm::vec3(screen->pixels().at(viewer->middleOf("false colors"))), glm::vec3(grey), 1));
    screen->xdotool("key z");
    EXPECT_TRUE(eventually([&] { return count(grey) < 50; }));

    screen->xdotool("key i");
    EXPECT_TRUE(eventually([&] { return viewer->placeOf("scopes:waveform").z > 0; })) << viewer->output();
    const glm::ivec4 bars = viewer->placeOf("scopes:luminance"), waves = viewer->placeOf("scopes:waveform");
    const ScreenPixels first = screen->pixels();
    viewer->send("set image.exposure 3");
    EXPECT_TRUE(eventually([&] {
        const ScreenPixels now = screen->pixels();
        return now.changedFrom(first, bars, 40) > 200 && now.changedFrom(first, waves, 40) > 200;
    })) << "they follow the picture";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerPictureTest, AKeptPictureStandsBesideTheLiveOne) {
    start(kSmall + "builtin:cornell");
    viewer->send("flip");
    EXPECT_TRUE(heard("flip: nothing is kept")) << viewer->output();
    settle();
    const glm::ivec2 at = inPicture(0.5f, 0.35f), right = inPicture(0.6f, 0.35f);
    const glm::vec3 bright = shownAt(at);
    screen->xdotool("key k");
    EXPECT_TRUE(heard("kept A: phong")) << viewer->output();
    viewer->send("material white color 0.2 0.2 0.2");
    settle();
    const glm::vec3 dark = shownAt(at);
    EXPECT_LT(glm::length(dark), 0.8f * glm::length(bright));
    screen->xdotool("key c");
    EXPECT_TRUE(eventually([&] { return near(shownAt(at), bright, 2); }));
    screen->xdotool("key c");
    EXPECT_TRUE(eventually([&] { return near(shownAt(at), dark, 2); }));
    viewer->send("split kept 0.5");
    EXPECT_TRUE(eventually([&] { return near(shownAt(right), bright, 12); }));
    viewer->send("error on");
    EXPECT_TRUE(eventually([&] {
        const glm::vec3 shown = shownAt(right);
        return shown.z > shown.x + 30;
    })) << "blue: the live one is darker";
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
}

TEST_F(ViewerPictureTest, PictureFilesAreShownWithLayersAndNumbers) {
    const std::string folder = freshFolder("files"), file = folder + "/small.exr";
    io::FloatImage image{4, 3, 3, std::vector<float>(36, 0.05f), {}, {}};
    image.pixels[3] = image.pixels[4] = image.pixels[5] = 0.5f;  // the second pixel of the first row
    image.layers = {{"depth", 1, std::vector<float>(12, 0.2f)}, {"motion", 2, std::vector<float>(24, 0.8f)}};
    io::writeExr(file, image);
    start("--window 720x480 --no-state --exec 'set image.tone_map none' '" + file + "'");
    const std::string first = viewer->statusUntil(
        "kept", [](const std::string& now) { return now.find("shown") != std::string::npos; });
    EXPECT_NE(first.find("small.exr, layer 1 of 3, 4 x 3 pixels, shown, zoom 1"), std::string::npos) << first;
    // The middle of a pixel, its lower right part: without numbers.
    const auto pixelAt = [&](int x, int y) {
        const glm::ivec4 place = viewer->placeOf("kept");
        return glm::ivec2(place) +
               glm::ivec2(glm::vec2(place.z, place.w) *
                          glm::vec2((static_cast<float>(x) + 0.8f) / 4, (static_cast<float>(y) + 0.9f) / 3));
    };
    EXPECT_TRUE(near(shownAt(pixelAt(1, 0)), glm::vec3(188), 1)) << "0.5 by sRGB";
    EXPECT_TRUE(near(shownAt(pixelAt(1, 1)), glm::vec3(63), 1)) << "0.05";
    click("layer:depth");
    EXPECT_TRUE(eventually([&] { return near(shownAt(pixelAt(1, 0)), glm::vec3(124), 1); })) << "0.2";
    EXPECT_NE(viewer->status("kept").find("depth, layer 2 of 3"), std::string::npos)
        << viewer->status("kept");
    // Enlarged, about the cursor, and with numbers.
    moveTo(pixelAt(2, 1));
    pass();
    for (int i = 0; i < 3; ++i) screen->xdotool("click 4");
    EXPECT_NE(
        viewer
            ->statusUntil("kept",
                          [](const std::string& now) { return now.find("zoom 1.95") != std::string::npos; })
            .find("zoom 1.95"),
        std::string::npos);
    EXPECT_GT(viewer->placeOf("kept:pixel").z, 0);
    const glm::ivec4 place = viewer->placeOf("kept");
    const glm::ivec4 numbers(place.x + place.z / 2 + 4, place.y + place.w / 3 + 4, 40, 40);
    const ScreenPixels now = screen->pixels();
    int white = 0;
    for (int y = numbers.y; y < numbers.y + numbers.w; ++y)
        for (int x = numbers.x; x < numbers.x + numbers.z; ++x) white += now.at({x, y}).x > 200;
    EXPECT_GT(white, 10) << "letters";
    viewer->send("keep " + file + " normal");
    EXPECT_TRUE(heard("has no layer 'normal'; depth, motion would be right")) << viewer->output();
    viewer->send("quit");
    EXPECT_EQ(viewer->exitStatus(), 0) << viewer->output();
    expectOneLine(conelight("view --no-state '" + folder + "/none.exr'"), 3, "none.exr");
}

}  // namespace
}  // namespace conelight::test
