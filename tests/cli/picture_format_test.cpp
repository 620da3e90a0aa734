// SPDX-License-Identifier: MIT
// Pictures and films of a size, with alpha, 16 bits and a rate, by commands without a window.
#include <filesystem>
#include <fstream>

#include "io/image_file.h"
#include "support/gl_fixture.h"
#include "support/moving_scene.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

class PictureFormatTest : public GlTest {
  protected:
    static std::string path(const std::string& name) { return scratchPath("format_" + name); }
    static CommandResult run(const std::string& commands, const std::string& environment = "") {
        return conelight(
            "render builtin:cornell --size 48x32 --voxels 32 --eye 0,0.5,4 --target 0,0.5,0 --exec 'mode "
            "phong; " +
                commands + "'",
            environment);
    }
};

// Of an 8-bit picture with 4 channels.
glm::ivec4 at(const io::ByteImage& image, int x, int y) {
    const std::size_t i = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return {image.pixels.at(i), image.pixels.at(i + 1), image.pixels.at(i + 2), image.pixels.at(i + 3)};
}

TEST_F(PictureFormatTest, TheSkyIsClearWithAlpha) {
    const CommandResult result =
        run("set image.tone_map agx; screenshot " + path("a.png") + " 64x40 alpha; screenshot " +
            path("a16.png") + " 64x40 alpha 16bit; screenshot " + path("a.exr") +
            " 64x40 alpha; screenshot " + path("plain.png") + " 64x40");
    ASSERT_EQ(result.status, 0) << result.output;
    const io::ByteImage clear = io::readByteImage(path("a.png")),
                        plain = io::readByteImage(path("plain.png"));
    ASSERT_EQ(clear.channels, 4);
    ASSERT_EQ(plain.channels, 3);
    EXPECT_EQ(glm::ivec2(clear.width, clear.height), glm::ivec2(64, 40));
    EXPECT_EQ(at(clear, 2, 2), glm::ivec4(0)) << "nothing is there";
    const std::size_t middle = 20 * 64 + 32;
    EXPECT_EQ(at(clear, 32, 20).a, 255);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(clear.pixels[4 * middle + i], plain.pixels[3 * middle + i])
            << "what is there looks the same";
    const std::string words = bytesOf(path("a16.png"));
    EXPECT_EQ(words.at(24), 16) << "bits of a channel";
    EXPECT_NE(words.find("Conelight"), std::string::npos) << "how it was made";
    const io::FloatImage linear = io::readExr(path("a.exr"));
    ASSERT_EQ(linear.channels, 4);
    EXPECT_EQ(linear.pixels.at(3), 0);
    EXPECT_EQ(linear.pixels.at(4 * middle + 3), 1);
}

TEST_F(PictureFormatTest, FilmsHaveTheirSizeRateAndKind) {
    const std::string folder = path("bin");
    fs::create_directories(folder);
    std::ofstream(folder + "/ffmpeg")
        << "#!/bin/sh\nfor f; do :; done\necho \"$*\" > " << path("told") << "\ncat > \"$f\"\n";
    fs::permissions(folder + "/ffmpeg", fs::perms::owner_all);
    const CommandResult film =
        run("record " + path("film.mov") + " 2 turntable 32x20 12fps alpha", "PATH=" + folder + ":$PATH");
    ASSERT_EQ(film.status, 0) << film.output;
    EXPECT_EQ(fs::file_size(path("film.mov")), 2u * 32 * 20 * 4);
    const std::string told = bytesOf(path("told"));
    for (const char* part : {"-pix_fmt rgba -s 32x20 -r 12 ", "prores_ks", "yuva444p10le"})
        EXPECT_NE(told.find(part), std::string::npos) << told;
    // Numbered pictures, and the size of before behind them.
    const CommandResult frames =
        run("record " + path("n%d.png") + " 2 32x20 alpha; screenshot " + path("after.png"));
    ASSERT_EQ(frames.status, 0) << frames.output;
    EXPECT_EQ(io::readByteImage(path("n1.png")).channels, 4);
    EXPECT_EQ(io::readByteImage(path("after.png")).width, 48);
}

// By the ffmpeg that is there: what another program reads of it.
TEST_F(PictureFormatTest, FilmsAreReadByOtherPrograms) {
    if (runCommand("command -v ffmpeg && command -v ffprobe").status != 0) GTEST_SKIP() << "no ffmpeg";
    for (const char* ending : {".mp4", ".gif", ".mov"}) {
        const std::string film = path(std::string("real") + ending);
        const CommandResult result = run("record " + film + " 3 turntable 32x20 12fps");
        ASSERT_EQ(result.status, 0) << result.output;
        const std::string read = runCommand(
                                     "ffprobe -v error -count_frames -of csv=p=0 -show_entries "
                                     "stream=width,height,r_frame_rate,nb_read_frames '" +
                                     film + "'")
                                     .output;
        EXPECT_EQ(read.rfind("32,20,", 0), 0u) << ending << ": " << read;
        EXPECT_NE(read.find(",3\n"), std::string::npos) << ending << ": " << read;
        const bool keepsRate = ending != std::string(".gif");  // hundredths of a second
        EXPECT_TRUE(!keepsRate || read.find("12/1") != std::string::npos) << read;
    }
}

TEST_F(PictureFormatTest, ClipsAreRecorded) {
    const std::string scene = risingBlock("format_moving.gltf");
    const CommandResult result =
        conelight("render '" + scene + "' --size 48x32 --voxels 32 --exec 'mode phong; record " +
                  path("clip%d.png") + " 2 clip 2fps'");
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_NE(pixelsOf(path("clip0.png")), pixelsOf(path("clip1.png")));
    expectOneLine(run("record " + path("c%d.png") + " 2 clip"), 2, "no clip");
}

TEST_F(PictureFormatTest, WhatCannotBeIsOneLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"screenshot never.jpg alpha", "alpha is kept in .png, .exr and .mov"},
        {"screenshot never.exr 16bit", "16bit is for .png"},
        {"screenshot never.png 0x40", "edges of 2 to 16384"},
        {"screenshot never.png blue", "a size as 1920x1080, alpha or 16bit would be right"},
        {"record never.mp4 2 alpha", "alpha is kept in"},
        {"record never%d.png 2 999fps", "1fps to 240fps"},
        {"record never%d.png 2 sideways", "turntable, path, clip"}};
    for (const auto& [command, part] : cases) expectOneLine(run(command), 2, part);
}

}  // namespace
}  // namespace conelight::test
