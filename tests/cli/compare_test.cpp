// SPDX-License-Identifier: MIT
// `conelight compare A B` from outside: numbers of images with known errors, bars, maps, bad input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

std::string path(const std::string& name) { return scratchDir() + "/" + name; }

CommandResult compare(const std::string& arguments) {
    return runCommand(std::string("'") + CONELIGHT_PROGRAM + "' compare " + arguments);
}

void expectOneLine(const CommandResult& result, int status, const std::string& part) {
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
}

io::FloatImage grey(float value, int width = 16, int height = 12) {
    io::FloatImage image;
    image.width = width;
    image.height = height;
    image.pixels.assign(std::size_t(3 * width * height), value);
    return image;
}

// test.exr is 0.6 everywhere (its layer "indirect" 0.2), reference.exr 0.5 (0.25).
class CompareTest : public ::testing::Test {
  protected:
    void SetUp() override {
        io::FloatImage test = grey(0.6f), reference = grey(0.5f);
        test.layers.push_back({"indirect", 3, grey(0.2f).pixels});
        reference.layers.push_back({"indirect", 3, grey(0.25f).pixels});
        io::writeExr(path("test.exr"), test);
        io::writeExr(path("reference.exr"), reference);
    }
    const std::string pair_ = "'" + path("test.exr") + "' '" + path("reference.exr") + "' ";
};

}  // namespace

TEST_F(CompareTest, TableAndJsonHaveTheKnownNumbers) {
    const CommandResult table = compare(pair_);
    EXPECT_EQ(table.status, 0);
    EXPECT_NE(table.output.find("+20.000  %"), std::string::npos) << table.output;

    const CommandResult result = compare(pair_ + "--json -");
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json json = nlohmann::json::parse(result.output);
    EXPECT_EQ(json["version"], 1);
    EXPECT_EQ(json["metrics"]["pixels"], 192);
    EXPECT_NEAR(json["metrics"]["bias"].get<double>(), 0.2, 1e-6);
    EXPECT_NEAR(json["metrics"]["relrmse"].get<double>(), 0.2, 1e-6);
    EXPECT_EQ(json["metrics"]["block_size"], 4);
    EXPECT_NEAR(json["metrics"]["block_relrmse"].get<double>(), 0.2, 1e-6);
    EXPECT_GT(json["metrics"]["flip"].get<double>(), 0.01);
    EXPECT_TRUE(json["broken_bars"].empty());
}

TEST_F(CompareTest, Layer) {
    const CommandResult result = compare(pair_ + "--layer indirect --no-flip --json -");
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_NEAR(nlohmann::json::parse(result.output)["metrics"]["bias"].get<double>(), -0.2, 1e-6);
    expectOneLine(compare(pair_ + "--layer direct"), 3, "it has indirect");
}

TEST_F(CompareTest, BarsDecideTheExitStatus) {
    EXPECT_EQ(compare(pair_ + "--max-relrmse 0.21 --max-bias 0.21 --max-bad 0 --min-psnr 10").status, 0);
    const CommandResult broken = compare(pair_ + "--max-relrmse 0.19 --max-bias 0.21");
    EXPECT_EQ(broken.status, 1);
    const CommandResult blocks = compare(pair_ + "--max-block-relrmse 0.19 --blocks 8");
    EXPECT_EQ(blocks.status, 1);
    EXPECT_NE(blocks.output.find("relRMSE of blocks 0.2 is above 0.19"), std::string::npos) << blocks.output;
    EXPECT_NE(blocks.output.find("relRMSE 8x8"), std::string::npos) << blocks.output;
    EXPECT_NE(broken.output.find("relRMSE 0.2 is above 0.19 (--max-relrmse)"), std::string::npos)
        << broken.output;
    EXPECT_EQ(broken.output.find("--max-bias"), std::string::npos) << broken.output;
    // A bias of -20 % breaks the bar like one of +20 %.
    EXPECT_EQ(compare(pair_ + "--layer indirect --no-flip --max-bias 0.19").status, 1);
    expectOneLine(compare(pair_ + "--no-flip --max-flip 1"), 2, "--no-flip");
}

TEST_F(CompareTest, PixelsThatAreNotFinite) {
    io::FloatImage image = grey(0.5f);
    image.pixels[10] = std::numeric_limits<float>::quiet_NaN();
    io::writeExr(path("nan.exr"), image);
    const std::string pair = "'" + path("nan.exr") + "' '" + path("reference.exr") + "' ";
    const CommandResult result = compare(pair);
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.output.find("191 pixels; 1 left out"), std::string::npos) << result.output;
    EXPECT_EQ(compare(pair + "--max-bad 1").status, 0);
    EXPECT_EQ(compare(pair + "--max-bad 0").status, 1);
}

TEST_F(CompareTest, Halves) {
    io::writeExr(path("half_a.exr"), grey(0.4f));
    io::writeExr(path("half_b.exr"), grey(0.6f));
    const std::string halves = "--halves '" + path("half_a.exr") + "','" + path("half_b.exr") + "' ";
    const CommandResult result = compare(pair_ + halves + "--json -");
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json json = nlohmann::json::parse(result.output);
    EXPECT_NEAR(json["metrics"]["mse"].get<double>(), (0.6 - 0.4) * (0.6 - 0.6), 1e-6);
    EXPECT_NEAR(json["metrics"]["reference_noise"].get<double>(), 0.1 / 0.5, 1e-6);
    // Halves of something else are pointed out.
    io::writeExr(path("half_b.exr"), grey(0.8f));
    EXPECT_NE(compare(pair_ + halves).output.find("--halves: their mean differs"), std::string::npos);
}

TEST_F(CompareTest, MapsAreColouredAndNamedByKind) {
    ASSERT_EQ(compare(pair_ + "--map '" + path("one.png") + "' --map-scale 1").status, 0);
    const io::ByteImage map = io::readByteImage(path("one.png"));
    EXPECT_EQ(map.width, 16);
    EXPECT_GT(map.pixels[0], map.pixels[2]);  // too bright: reddish

    ASSERT_EQ(compare(pair_ + "--map '" + path("maps.exr") + "' --map-kind signed,absolute").status, 0);
    EXPECT_NEAR(io::readExr(path("maps-signed.exr")).pixels[5], 0.2, 1e-6);
    EXPECT_NEAR(io::readExr(path("maps-absolute.exr")).pixels[5], 0.2, 1e-6);
    EXPECT_FALSE(std::filesystem::exists(path("maps.exr")));
    expectOneLine(compare(pair_ + "--map '" + path("x.png") + "' --map-kind odd"), 2,
                  "'odd' is no kind of map");
    expectOneLine(compare(pair_ + "--map '" + path("x.hdr") + "'"), 2, ".png or .exr");
}

TEST_F(CompareTest, ReportIsOnePageThatFetchesNothing) {
    ASSERT_EQ(compare(pair_ + "--report '" + path("report") + "'").status, 0);
    std::ifstream stream(path("report") + "/index.html");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(page.find("test.exr against reference.exr"), std::string::npos);
    EXPECT_NE(page.find("compare"), std::string::npos);
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    for (const char* fetched : {"http:", "https:", " src=", "@import", "{{"})
        EXPECT_EQ(page.find(fetched), std::string::npos) << fetched;
    EXPECT_TRUE(
        std::all_of(page.begin(), page.end(), [](char c) { return static_cast<unsigned char>(c) < 128; }));
    expectOneLine(compare(pair_ + "--report /proc/nowhere"), 1, "/proc/nowhere");
}

TEST_F(CompareTest, BadInputIsOneLine) {
    io::writeExr(path("small.exr"), grey(0.5f, 8, 8));
    expectOneLine(compare("'" + path("small.exr") + "' '" + path("test.exr") + "'"), 3, "is 8x8 pixels, but");
    expectOneLine(compare("'" + path("none.exr") + "' '" + path("test.exr") + "'"), 3, "none.exr");
    expectOneLine(compare("'" + path("test.exr") + "'"), 2, "second one");
    expectOneLine(compare(pair_ + "--modes cones"), 2, "scenes");
    expectOneLine(compare("builtin:cornell --halves a,b"), 2, "two pictures");
    expectOneLine(compare(pair_ + "--json /nonexistent/folder/x.json"), 1, "/nonexistent/folder");
}

}  // namespace conelight::test
