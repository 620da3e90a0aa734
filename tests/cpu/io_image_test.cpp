// SPDX-License-Identifier: MIT
// Image files: what is written comes back, files appear whole or not at all, errors say what is wrong.
#include <cstdio>  // jpeglib.h needs it

#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>

#include "cpu/io_test_support.h"
#include "io/files.h"
#include "io/image_file.h"
#include "io/picture_codec.h"

namespace conelight {
namespace {

using namespace test;

std::string imageError(const std::function<void()>& work, ErrorKind kind) {
    try {
        work();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

std::size_t filesIn(const std::filesystem::path& folder) {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

TEST(ImageFile, PngComesBackBitByBit) {
    for (const int channels : {1, 3, 4}) {
        io::ByteImage image{7, 5, channels, {}};
        for (int i = 0; i < 7 * 5 * channels; ++i) image.pixels.push_back(std::uint8_t(i * 37));
        const std::filesystem::path path = folderOf("png") / ("c" + std::to_string(channels) + ".png");
        io::writePng(path, image);
        const io::ByteImage back = io::readByteImage(path);
        EXPECT_EQ(back.width, 7);
        EXPECT_EQ(back.height, 5);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.pixels, image.pixels);
    }
}

TEST(ImageFile, PngKeepsTexts) {
    const auto path = std::filesystem::path(scratchDir()) / "texts.png";
    io::ByteImage image{2, 1, 1, {7, 9}, {{"Software", "a program"}, {"Place", "K\xc3\xb6ln\nat night"}}};
    io::writePng(path, image);
    const io::ByteImage read = io::readByteImage(path);
    EXPECT_EQ(read.attributes, image.attributes);
    EXPECT_EQ(read.pixels, image.pixels);
}

TEST(ImageFile, ExrKeepsEveryFloatAndLayer) {
    io::FloatImage image{5, 3, 4, {}, {}, {}};
    for (int i = 0; i < 5 * 3 * 4; ++i) image.pixels.push_back(1e-3f * float(i * i) - 0.01f);
    image.pixels[0] = 1e30f;
    image.pixels[1] = std::numeric_limits<float>::infinity();
    io::ImageLayer depth{"depth", 1, {}}, normal{"normal", 3, {}};
    for (int i = 0; i < 15; ++i) depth.pixels.push_back(float(i));
    for (int i = 0; i < 45; ++i) normal.pixels.push_back(float(-i));
    image.layers = {normal, depth};
    image.attributes = {{"conelight:command", "render x"}};
    const std::filesystem::path path = folderOf("exr") / "a.exr";
    io::writeExr(path, image);
    const io::FloatImage back = io::readExr(path);
    EXPECT_EQ(back.width, 5);
    EXPECT_EQ(back.height, 3);
    EXPECT_EQ(back.channels, 4);
    EXPECT_EQ(back.pixels, image.pixels);
    ASSERT_EQ(back.layers.size(), 2u);
    EXPECT_EQ(back.layers[0].name, "depth");
    EXPECT_EQ(back.layers[0].pixels, depth.pixels);
    EXPECT_EQ(back.layers[1].name, "normal");
    EXPECT_EQ(back.layers[1].channels, 3);
    EXPECT_EQ(back.layers[1].pixels, normal.pixels);
    EXPECT_EQ(back.attributes, image.attributes);
    // Twice the same bytes.
    const io::Bytes first = io::readFile(path);
    io::writeExr(path, image);
    EXPECT_EQ(io::readFile(path), first);
}

TEST(ImageFile, ExrIsScanlineZipFirstRowOnTop) {
    io::FloatImage image{2, 2, 3, {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}, {}, {}};
    const std::filesystem::path path = folderOf("exr") / "rows.exr";
    io::writeExr(path, image);
    const io::Bytes bytes = io::readFile(path);
    // Version field: 2 and no flag (tiled, long names, deep, multi-part); attributes as the format spells
    // them.
    ASSERT_GT(bytes.size(), 8u);
    EXPECT_EQ(bytes[4], 2);
    EXPECT_EQ(bytes[5], 0);
    const std::string text(bytes.begin(), bytes.end());
    const auto valueOf = [&](const std::string& name, const std::string& type) {
        return text.at(text.find(name + '\0' + type + '\0') + name.size() + type.size() + 2 + 4);
    };
    EXPECT_EQ(valueOf("compression", "compression"), 3) << "ZIP";
    EXPECT_EQ(valueOf("lineOrder", "lineOrder"), 0) << "increasing y";
    EXPECT_NE(text.find("chromaticities"), std::string::npos);
    EXPECT_EQ(io::readImage(path).pixels[0], 1.0f) << "first row on top";
}

TEST(ImageFile, HdrKeepsEightBitsOfMantissa) {
    io::FloatImage image{16, 2, 3, {}, {}, {}};
    for (int i = 0; i < 96; ++i) image.pixels.push_back(std::exp2(float(i % 20) - 10.0f));
    image.pixels[5] = -1.0f;
    const std::filesystem::path path = folderOf("hdr") / "a.hdr";
    io::writeHdr(path, image);
    const io::FloatImage back = io::readImage(path);
    ASSERT_EQ(back.pixels.size(), 96u);
    for (std::size_t pixel = 0; pixel < 32; ++pixel) {
        const float strongest =
            std::max({image.pixels[3 * pixel], image.pixels[3 * pixel + 1], image.pixels[3 * pixel + 2]});
        // RGBE shares the exponent of the strongest channel: one step is 1/128 of it at most.
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(back.pixels[3 * pixel + c], std::max(image.pixels[3 * pixel + c], 0.0f),
                        strongest / 128.0f);
    }
}

TEST(ImageFile, JpgIsClose) {
    io::ByteImage image{32, 32, 3, std::vector<std::uint8_t>(32 * 32 * 3, 128)};
    const std::filesystem::path path = folderOf("jpg") / "a.JPG";
    EXPECT_EQ(io::imageFormatOf(path), io::ImageFormat::Jpg);
    io::writeJpg(path, image);
    const io::FloatImage back = io::readImage(path);
    EXPECT_NEAR(back.pixels[100], io::linearFromSrgb(128.0f / 255.0f), 0.01f);
}

TEST(ImageFile, SrgbCurve) {
    EXPECT_NEAR(io::linearFromSrgb(0.5f), 0.21404f, 1e-5f);
    for (int i = 0; i < 256; ++i)
        EXPECT_NEAR(io::srgbFromLinear(io::linearFromSrgb(float(i) / 255.0f)), float(i) / 255.0f, 1e-5f);
}

TEST(ImageFile, ErrorsNameThePathAndWhatWouldBeRight) {
    const io::ByteImage image{1, 1, 3, {1, 2, 3}};
    EXPECT_TRUE(contains(imageError([] { io::imageFormatOf("out.gif"); }, ErrorKind::Usage),
                         "out.gif: unknown picture extension '.gif'; known: .png .jpg .jpeg .exr .hdr"));
    EXPECT_TRUE(
        contains(imageError([&] { io::writePng("/nonexistent/folder/a.png", image); }, ErrorKind::Runtime),
                 "/nonexistent/folder/a.png: cannot be written: folder /nonexistent/folder does not exist"));
    const std::filesystem::path folder = folderOf("image_folder.png");
    EXPECT_TRUE(
        contains(imageError([&] { io::writePng(folder, image); }, ErrorKind::Runtime), "it is a folder"));
    EXPECT_TRUE(contains(imageError([] { io::checkWritable("/nonexistent/a.png"); }, ErrorKind::Runtime),
                         "/nonexistent/a.png: cannot be written"));
    EXPECT_NO_THROW(io::checkWritable(folder / "new.png"));
    EXPECT_EQ(filesIn(folder), 0u) << "the probe is gone";
    EXPECT_TRUE(contains(imageError([] { io::readImage("none.png"); }, ErrorKind::BadInput),
                         "none.png: no such file"));
    const std::string text = write(folderOf("image_bad") / "text.png", "hello");
    EXPECT_TRUE(contains(imageError([&] { io::readImage(text); }, ErrorKind::BadInput), "is not a PNG"));
    const std::string exr = write(folderOf("image_bad") / "text.exr", "hello");
    EXPECT_TRUE(contains(imageError([&] { io::readImage(exr); }, ErrorKind::BadInput), "not a usable EXR"));
}

TEST(ImageFile, FailedWritesLeaveTheOldFileAndNothingElse) {
    const std::filesystem::path folder = folderOf("atomic");
    const std::filesystem::path path = folder / "a.png";
    io::writePng(path, {1, 1, 3, {1, 2, 3}});
    const io::Bytes before = io::readFile(path);
    io::writePng(path, {1, 1, 3, {4, 5, 6}});
    EXPECT_NE(io::readFile(path), before);
    EXPECT_EQ(filesIn(folder), 1u);
    // A full disk: /dev/full accepts no byte; as a special file it is written directly.
    EXPECT_TRUE(
        contains(imageError([] { io::writeFile("/dev/full", io::Bytes(1 << 16)); }, ErrorKind::Runtime),
                 "/dev/full: cannot be written"));
    // A link stays a link.
    std::filesystem::create_symlink("a.png", folder / "link.png");
    io::writePng(folder / "link.png", {1, 1, 3, {7, 8, 9}});
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
    EXPECT_EQ(io::readByteImage(path).pixels[0], 7);
}

TEST(ImageFile, DamagedFilesAreErrors) {
    io::FloatImage image{17, 19, 3, std::vector<float>(17 * 19 * 3, 0.5f), {}, {}};
    const std::filesystem::path folder = folderOf("image_damaged");
    io::writeExr(folder / "a.exr", image);
    io::writeHdr(folder / "a.hdr", image);
    io::writePng(folder / "a.png", {17, 19, 3, std::vector<std::uint8_t>(17 * 19 * 3, 77)});
    io::writeJpg(folder / "a.jpg", {17, 19, 3, std::vector<std::uint8_t>(17 * 19 * 3, 77)});
    for (const char* name : {"a.exr", "a.hdr", "a.png", "a.jpg"}) {
        const io::Bytes bytes = io::readFile(folder / name);
        const std::string original(bytes.begin(), bytes.end());
        std::mt19937 random(5);
        int refused = 0;
        for (int i = 0; i < 200; ++i) {
            const std::string path =
                write(folder / (std::string("damaged_") + name), mutated(original, random));
            try {
                const io::FloatImage back = io::readImage(path);
                EXPECT_EQ(back.pixels.size(),
                          std::size_t(back.width) * std::size_t(back.height) * std::size_t(back.channels));
            } catch (const Error& error) {
                EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0u) << error.what();
                ++refused;
            }
        }
        EXPECT_GT(refused, 20) << name;
    }
}

// Codes of a Huffman table beyond 256 led an earlier decoder out of its tables; half a file is no picture.
TEST(ImageFile, BrokenJpegsAreRefused) {
    const std::filesystem::path folder = folderOf("jpeg_broken");
    io::writeJpg(folder / "a.jpg", {40, 30, 3, std::vector<std::uint8_t>(40 * 30 * 3, 77)});
    const io::Bytes whole = io::readFile(folder / "a.jpg");
    io::Bytes tables = whole;
    for (std::size_t i = 0; i + 20 < tables.size(); ++i)
        if (tables[i] == 0xFF && tables[i + 1] == 0xC4) {
            std::fill_n(tables.begin() + std::ptrdiff_t(i + 5), 16, std::uint8_t(255));
            break;
        }
    EXPECT_THROW(io::decodeRgba(tables, "x"), Error);
    for (std::size_t size = 0; size + 2 < whole.size(); size += 7)
        EXPECT_THROW(io::decodeRgba({whole.data(), size}, "x"), Error) << size;
    EXPECT_EQ(io::decodeRgba(whole, "x").pixels.size(), 40u * 30 * 4);
}

// One colour, as libjpeg writes it.
io::Bytes jpegOf(const std::vector<std::uint8_t>& texel, J_COLOR_SPACE space, bool progressive) {
    jpeg_compress_struct jpeg = {};
    jpeg_error_mgr errors = {};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* out = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &out, &size);
    jpeg.image_width = 20;
    jpeg.image_height = 12;
    jpeg.input_components = int(texel.size());
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<std::uint8_t> row;
    for (int x = 0; x < 20; ++x) row.insert(row.end(), texel.begin(), texel.end());
    for (int y = 0; y < 12; ++y) {
        JSAMPROW line = row.data();
        jpeg_write_scanlines(&jpeg, &line, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const io::Bytes bytes(out, out + size);
    std::free(out);
    return bytes;
}

TEST(ImageFile, JpegsOfAllKinds) {
    const struct {
        io::Bytes file;
        std::array<int, 3> rgb;
    } kinds[] = {{jpegOf({90, 160, 30}, JCS_RGB, false), {90, 160, 30}},
                 {jpegOf({90, 160, 30}, JCS_RGB, true), {90, 160, 30}},
                 {jpegOf({77}, JCS_GRAYSCALE, false), {77, 77, 77}},
                 // Inks with Adobe's marker, which libjpeg writes, are stored inverted.
                 {jpegOf({200, 100, 50, 255}, JCS_CMYK, false), {200, 100, 50}},
                 {jpegOf({200, 100, 50, 128}, JCS_CMYK, true), {100, 50, 25}}};
    for (const auto& kind : kinds) {
        const io::ByteImage image = io::decodeRgba(kind.file, "x");
        ASSERT_EQ(image.pixels.size(), 20u * 12 * 4);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            EXPECT_NEAR(image.pixels[i], i % 4 == 3 ? 255 : kind.rgb[i % 4], 2);
    }
}

TEST(ImageFile, LargePicturesAreMadeSmallerWhileTheyAreRead) {
    const std::filesystem::path folder = folderOf("image_shrunk");
    io::ByteImage image{13, 9, 3, {}};
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 13; ++x)
            for (const int value : {x < 8 ? 40 : 200, 10 * (x % 2), 99})
                image.pixels.push_back(std::uint8_t(value));
    io::writePng(folder / "a.png", image);
    io::writeJpg(folder / "a.jpg", image, 100);
    for (const char* name : {"a.png", "a.jpg"}) {
        io::ByteImage small;
        const io::DecodeResult result = io::decodePicture(io::readFile(folder / name), {4, 7 * 5}, small);
        EXPECT_EQ(result.failure, "");
        EXPECT_EQ(result.width, 13);
        ASSERT_EQ(small.width, 7);
        ASSERT_EQ(small.height, 5);
        // JPEG leaves some error, also in what it leaves out.
        const int tolerance = name == std::string("a.png") ? 0 : 12;
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x) {
                const std::uint8_t* texel = &small.pixels[std::size_t(4 * (7 * y + x))];
                EXPECT_NEAR(texel[0], x < 4 ? 40 : 200, tolerance) << name << x << y;
                EXPECT_NEAR(texel[1], x < 6 ? 5 : 0, tolerance) << name << x << y;
                EXPECT_NEAR(texel[2], 99, tolerance) << name << x << y;
                EXPECT_EQ(texel[3], 255);
            }
    }
}

// Whatever the channels and the number of halvings; squares at the edges have fewer texels.
TEST(ImageFile, SmallerPicturesAreMeansOfSquares) {
    constexpr int kWidth = 21, kHeight = 14;
    for (const int channels : {1, 3, 4})
        for (const int halvings : {0, 1, 2, 3}) {
            const auto texel = [&](int x, int y, int c) { return (37 * x + 91 * y + 53 * c) % 256; };
            io::ByteImage small;
            io::RowShrinker shrinker(kWidth, kHeight, channels, halvings, small);
            for (int y = 0; y < kHeight; ++y) {
                std::vector<std::uint8_t> row;
                for (int x = 0; x < kWidth; ++x)
                    for (int c = 0; c < channels; ++c) row.push_back(std::uint8_t(texel(x, y, c)));
                shrinker.add(row.data());
            }
            const int step = 1 << halvings;
            ASSERT_EQ(small.pixels.size(), std::size_t(small.width * small.height * channels));
            for (int i = 0; i < int(small.pixels.size()); ++i) {
                const int c = i % channels, x = i / channels % small.width, y = i / channels / small.width;
                int sum = 0, count = 0;
                for (int v = step * y; v < std::min(step * (y + 1), kHeight); ++v)
                    for (int u = step * x; u < std::min(step * (x + 1), kWidth); ++u, ++count)
                        sum += texel(u, v, c);
                EXPECT_EQ(small.pixels[std::size_t(i)], (sum + count / 2) / count)
                    << channels << " channels, " << halvings << " halvings, " << x << ", " << y;
            }
        }
}

TEST(Files, DecodesUriText) {
    EXPECT_EQ(io::percentDecoded("a%20b%2Fc%zz%4"), "a b/c%zz%4");
    const io::Bytes expected = {'M', 'a', 'n', 0};
    EXPECT_EQ(io::base64Decoded("TWFu\nAA=="), expected);
    EXPECT_FALSE(io::base64Decoded("T*Fu"));
    EXPECT_EQ(io::oneLine("a\nb\tc", 10), "a b c");
}

}  // namespace
}  // namespace conelight
