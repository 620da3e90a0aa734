// SPDX-License-Identifier: MIT
// The report's page in a browser, driven by real mouse and keyboard events: the divider moves, the read-out
// is the EXR's value, exposure and error maps show what they should, nothing is fetched. Skipped without a
// browser. CONELIGHT_SCREENSHOTS=DIR keeps pictures of the page.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "conelight/renderer.h"
#include "conelight/settings.h"
#include "io/image_file.h"
#include "reference/metrics.h"
#include "support/browser.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

constexpr int kWidth = 40, kHeight = 30;
constexpr int kBadX = 3, kBadY = 4;  // the pixel of the test image that is not a number

using Rgb = std::array<int, 3>;

io::FloatImage picture(bool isTest) {
    io::FloatImage image;
    image.width = kWidth;
    image.height = kHeight;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float r = 0.2f + 0.001f * float(x) + 1e-6f * float(y);
            if (isTest)
                image.pixels.insert(image.pixels.end(), {r, 0.1f, 0.05f});
            else
                image.pixels.insert(image.pixels.end(), {0.05f, 0.15f, 0.3f});
        }
    if (isTest)
        image.pixels[std::size_t(3 * (kBadY * kWidth + kBadX))] = std::numeric_limits<float>::quiet_NaN();
    return image;
}

// As `conelight render` writes it.
Rgb displayedColor(const glm::vec3& radiance) {
    const std::vector<std::uint8_t> bytes = toneMapped({1, 1, {glm::vec4(radiance, 1)}}, ImageSettings{});
    return {bytes[0], bytes[1], bytes[2]};
}

class ReportTest : public ::testing::Test {
  protected:
    void SetUp() override {
        const std::string program = Browser::find();
        if (program.empty()) GTEST_SKIP() << "no browser; scripts/install_packages --browser installs one";
        const std::string folder = scratchDir();
        io::writeExr(folder + "/test.exr", picture(true));
        io::writeExr(folder + "/reference.exr", picture(false));
        const CommandResult made =
            runCommand(std::string("'") + CONELIGHT_PROGRAM + "' compare '" + folder + "/test.exr' '" +
                       folder + "/reference.exr' --report '" + folder + "/report'");
        ASSERT_EQ(made.status, 0) << made.output;
        address_ = "file://" + folder + "/report/index.html";
        browser_ = std::make_unique<Browser>(program, 1280, 900);
        browser_->open(address_);
        browser_->waitFor("document.documentElement.dataset.draws > 0");
        const nlohmann::json box = browser_->evaluate(
            "(() => { const b = document.getElementById('canvas').getBoundingClientRect();"
            "return [b.left, b.top, b.width, b.height]; })()");
        left_ = box[0], top_ = box[1], width_ = box[2], height_ = box[3];
    }

    void TearDown() override {
        if (!browser_) return;
        for (const std::string& problem : browser_->problems())  // the advice is about shown()'s own reading
            if (problem.find("willReadFrequently") == std::string::npos) ADD_FAILURE() << problem;
        for (const std::string& request : browser_->requests())
            EXPECT_TRUE(request == address_ || request.rfind("data:", 0) == 0) << request;
    }

    // Lets the page draw what is pending.
    void settle() {
        browser_->evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
    }

    // Place of a pixel's centre in the window. The picture fills the stage's height and stands in its middle.
    double pixelX(int x) const {
        const double scale = std::min(width_ / kWidth, height_ / kHeight);
        return left_ + (width_ - scale * kWidth) / 2 + (x + 0.5) * scale;
    }
    double pixelY(int y) const {
        const double scale = std::min(width_ / kWidth, height_ / kHeight);
        return top_ + (height_ - scale * kHeight) / 2 + (y + 0.5) * scale;
    }

    // What the canvas shows at a pixel.
    Rgb shown(int x, int y) {
        settle();
        const nlohmann::json bytes =
            browser_->evaluate("Array.from(document.getElementById('canvas').getContext('2d').getImageData(" +
                               std::to_string(int(pixelX(x) - left_)) + "," +
                               std::to_string(int(pixelY(y) - top_)) + ",1,1).data)");
        return {bytes[0], bytes[1], bytes[2]};
    }

    static void expectNear(const Rgb& value, const Rgb& expected) {
        // One byte: the page's table of the sRGB curve has 16,384 steps.
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], 1) << "channel " << c;
    }

    static Rgb displayed(const io::FloatImage& image, int x, int y, float gain = 1) {
        const float* v = &image.pixels[std::size_t(3 * (y * kWidth + x))];
        return displayedColor(gain * glm::vec3(v[0], v[1], v[2]));
    }

    std::vector<std::string> readout(const std::string& row) {
        settle();
        return browser_->evaluate("Array.from(document.querySelectorAll('#" + row +
                                  " td'), (cell) => cell.textContent)");
    }

    void choose(const std::string& select, const std::string& option) {
        browser_->evaluate("(() => { const s = document.getElementById('" + select +
                           "'); const o = [...s.options].find((o) => o.textContent === '" + option +
                           "'); s.value = o.value; s.dispatchEvent(new Event('change')); })()");
    }

    void keepScreenshot(const std::string& name) {
        settle();
        if (const char* folder = std::getenv("CONELIGHT_SCREENSHOTS"))
            browser_->screenshot(std::string(folder) + "/" + name + ".png");
    }

    const io::FloatImage test_ = picture(true), reference_ = picture(false);
    std::string address_;
    std::unique_ptr<Browser> browser_;
    double left_ = 0, top_ = 0, width_ = 0, height_ = 0;
};

}  // namespace

// The page opens with the curve that `render` writes pictures with, and knows every one.
TEST(ReportPage, ToneCurvesAreThoseOfPictures) {
    const std::string folder = scratchDir();
    io::writeExr(folder + "/a.exr", picture(true));
    io::writeExr(folder + "/b.exr", picture(false));
    const CommandResult made = runCommand(std::string("'") + CONELIGHT_PROGRAM + "' compare '" + folder +
                                          "/a.exr' '" + folder + "/b.exr' --report '" + folder + "/tones'");
    ASSERT_EQ(made.status, 0) << made.output;
    std::ifstream page(folder + "/tones/index.html");
    const std::string html((std::istreambuf_iterator<char>(page)), std::istreambuf_iterator<char>());
    const std::string shown = getSetting(Settings{}, "image.tone_map");
    EXPECT_NE(html.find("\"tone\":\"" + shown + "\""), std::string::npos);
    for (const std::string& curve : findSetting("image.tone_map")->choices)
        EXPECT_NE(html.find("<option value=\"" + curve + "\">"), std::string::npos) << curve;
    if (runCommand("command -v node").status != 0) GTEST_SKIP() << "node is not installed (nodejs)";
    const Image image{
        4, 1, {{0.02f, 0.3f, 0.9f, 1}, {3, 0.5f, 0.1f, 1}, {40, 20, 10, 1}, {0.2f, 0.2f, 0.2f, 1}}};
    for (const std::string& curve : findSetting("image.tone_map")->choices) {
        std::ofstream(folder + "/tone.js")
            << std::ifstream(CONELIGHT_SOURCE_DIR "/apps/conelight/report/pixels.js").rdbuf()
            << "const out = []; pictureBytes([0.02,0.3,0.9, 3,0.5,0.1, 40,20,10, 0.2,0.2,0.2], 1, '" << curve
            << "', out); console.log(out.join(' '));\n";
        const CommandResult ran = runCommand("node '" + folder + "/tone.js'");
        ASSERT_EQ(ran.status, 0) << ran.output;
        Settings look;
        setSetting(look, "image.tone_map", curve);
        setSetting(look, "image.exposure", "1");
        const std::vector<std::uint8_t> expected = toneMapped(image, look.image);
        std::istringstream bytes(ran.output);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            int value = -1, opaque = 255;
            bytes >> value;
            EXPECT_NEAR(value, expected[i], 1) << curve << ", byte " << i;
            if (i % 3 == 2) bytes >> opaque;
            EXPECT_EQ(opaque, 255);
        }
    }
}

TEST_F(ReportTest, DividerFollowsTheMouse) {
    expectNear(shown(16, 10), displayed(test_, 16, 10));       // left of the middle: A
    expectNear(shown(24, 10), displayed(reference_, 24, 10));  // right of it: B
    keepScreenshot("start");

    const double middle = left_ + width_ / 2, y = top_ + height_ / 2;
    browser_->moveMouse(middle, y);
    browser_->pressMouse(middle, y);
    browser_->moveMouse(pixelX(15), y, true);
    browser_->moveMouse(pixelX(12), y, true);
    browser_->releaseMouse(pixelX(12), y);
    expectNear(shown(16, 10), displayed(reference_, 16, 10));
    expectNear(shown(8, 10), displayed(test_, 8, 10));
    EXPECT_NEAR(browser_->evaluate("Number(document.getElementById('split').getAttribute('aria-valuenow'))")
                    .get<double>(),
                100 * (pixelX(12) - left_) / width_, 1);

    // It has the focus now: the arrow keys move it too.
    for (int i = 0; i < 30; ++i) browser_->typeKey("ArrowRight");
    expectNear(shown(16, 10), displayed(test_, 16, 10));
}

TEST_F(ReportTest, ReadOutIsTheValueOfTheExr) {
    for (const auto& [x, y] : {std::pair{7, 5}, std::pair{33, 28}, std::pair{0, 0}}) {
        browser_->moveMouse(pixelX(x), pixelY(y));
        const std::vector<std::string> a = readout("readA"), b = readout("readB"),
                                       difference = readout("readD");
        EXPECT_EQ(browser_->evaluate("document.getElementById('pixel').textContent"),
                  std::to_string(x) + ", " + std::to_string(y));
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t i = std::size_t(3 * (y * kWidth + x)) + c;
            // Six digits are shown.
            EXPECT_NEAR(std::stod(a.at(c)), test_.pixels[i], 6e-7 * test_.pixels[i]) << x << " " << y;
            EXPECT_NEAR(std::stod(b.at(c)), reference_.pixels[i], 6e-7 * reference_.pixels[i]);
            EXPECT_NEAR(std::stod(difference.at(c)), test_.pixels[i] - reference_.pixels[i], 1e-6);
        }
    }
    browser_->moveMouse(pixelX(kBadX), pixelY(kBadY));
    EXPECT_EQ(readout("readA").at(0), "NaN");
    expectNear(shown(kBadX, kBadY), {0, 255, 0});

    // The arrow keys move the read-out once the picture has the focus.
    browser_->click(pixelX(10), pixelY(20));
    browser_->typeKey("ArrowDown");
    browser_->typeKey("ArrowLeft");
    settle();
    EXPECT_EQ(browser_->evaluate("document.getElementById('pixel').textContent"), "9, 21");
}

TEST_F(ReportTest, ExposureBrightensThePicture) {
    browser_->typeKey("]");
    browser_->typeKey("]");
    expectNear(shown(16, 10), displayed(test_, 16, 10, 2));
    EXPECT_EQ(browser_->evaluate("document.getElementById('exposureText').textContent"), "+1.0 stops");
    // By mouse: a click at the left end of the slider is its lowest value, -10 stops.
    const nlohmann::json box = browser_->evaluate(
        "(() => { const b = document.getElementById('exposure').getBoundingClientRect();"
        "return [b.left, b.top + b.height / 2]; })()");
    browser_->click(box[0].get<double>() + 2, box[1]);
    expectNear(shown(16, 10), displayed(test_, 16, 10, std::exp2(-10.0f)));
}

TEST_F(ReportTest, ErrorMapsHaveTheColoursOfTheProgram) {
    Image x{kWidth, kHeight, {}}, r{kWidth, kHeight, {}};
    for (std::size_t i = 0; i < std::size_t(kWidth * kHeight); ++i) {
        x.pixels.emplace_back(test_.pixels[3 * i], test_.pixels[3 * i + 1], test_.pixels[3 * i + 2], 1);
        r.pixels.emplace_back(reference_.pixels[3 * i], reference_.pixels[3 * i + 1],
                              reference_.pixels[3 * i + 2], 1);
    }
    const std::pair<const char*, reference::ErrorMap> maps[] = {
        {"error, signed", reference::ErrorMap::Signed},
        {"error, absolute", reference::ErrorMap::Absolute},
        {"error, relative squared", reference::ErrorMap::RelativeSquared},
        {"FLIP", reference::ErrorMap::Flip},
        {"HDR-FLIP", reference::ErrorMap::HdrFlip}};
    for (const auto& [label, kind] : maps) {
        SCOPED_TRACE(label);
        choose("pickA", label);
        const float value = reference::errorValues(x, r, kind)[10 * kWidth + 9];
        const bool isFlip = kind == reference::ErrorMap::Flip || kind == reference::ErrorMap::HdrFlip;
        std::uint8_t expected[3];
        reference::colorOfError(isFlip ? value : value / 0.5f, kind == reference::ErrorMap::Signed, expected);
        const Rgb bytes = shown(9, 10);
        // The page has 256 colours per scale, and 254 steps of FLIP: about 3 bytes each.
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(bytes[c], expected[c], 6) << "channel " << c;
        expectNear(shown(kBadX, kBadY), {0, 255, 0});
        browser_->moveMouse(pixelX(9), pixelY(10));
        EXPECT_NEAR(std::stod(readout("readA").at(0)), value, isFlip ? 0.002 : 1e-5);
        browser_->moveMouse(left_ + 1, top_ - 20);
    }
    keepScreenshot("map");
}

TEST_F(ReportTest, KeysSwapAndMagnify) {
    browser_->pressKey(" ");
    expectNear(shown(16, 10), displayed(reference_, 16, 10));
    browser_->releaseKey(" ");
    expectNear(shown(16, 10), displayed(test_, 16, 10));
    browser_->typeKey("x");
    expectNear(shown(16, 10), displayed(reference_, 16, 10));
    const auto zoom = [&] {
        settle();
        return browser_->evaluate("parseFloat(document.getElementById('zoomText').textContent)")
            .get<double>();
    };
    const double fit = zoom();
    browser_->typeKey("+");
    EXPECT_GT(zoom(), fit);
    browser_->typeKey("0");
    EXPECT_EQ(zoom(), fit);
}

TEST_F(ReportTest, TablesAreThereAndSort) {
    EXPECT_EQ(browser_->evaluate("document.querySelectorAll('#tables table').length"), 2);
    EXPECT_EQ(browser_->evaluate("document.querySelector('#tables td').textContent"), "test.exr");
    EXPECT_EQ(browser_->evaluate("document.querySelector('#commands code').textContent.includes('compare')"),
              true);
    const auto firstCells = [&] {
        return browser_
            ->evaluate(
                "Array.from(document.querySelectorAll('#tables section:last-child tbody tr'), "
                "(row) => row.cells[0].textContent)")
            .get<std::vector<std::string>>();
    };
    const std::vector<std::string> before = firstCells();
    const char* button = "document.querySelector('#tables section:last-child th button')";
    browser_->evaluate(std::string(button) + ".scrollIntoView({block: 'center'})");
    const nlohmann::json at =
        browser_->evaluate("(() => { const b = " + std::string(button) +
                           ".getBoundingClientRect(); return [b.left + 5, b.top + 5]; })()");
    browser_->click(at[0], at[1]);
    const std::vector<std::string> ascending = firstCells();
    EXPECT_NE(ascending, before);
    EXPECT_TRUE(std::is_permutation(ascending.begin(), ascending.end(), before.begin(), before.end()));
    EXPECT_EQ(ascending.front(), "bias");
    browser_->click(at[0], at[1]);
    EXPECT_EQ(firstCells().back(), "bias");
    EXPECT_EQ(browser_->evaluate(std::string(button) + ".parentElement.getAttribute('aria-sort')"),
              "descending");
}

// Above 48 MiB of values the page carries 16-bit floats: 11 bits of mantissa.
TEST_F(ReportTest, LargePicturesTravelAsHalves) {
    constexpr int kLargeWidth = 1260, kLargeHeight = 1250;  // two of them are 3.15 million pixels of 16 bytes
    io::FloatImage large;
    large.width = kLargeWidth;
    large.height = kLargeHeight;
    for (int i = 0; i < kLargeWidth * kLargeHeight; ++i) {
        const float value = 0.001f * float(i % 997) - 0.2f;
        large.pixels.insert(large.pixels.end(), {value, 60000.0f, 1e-6f});
    }
    const std::string folder = scratchDir();
    io::writeExr(folder + "/large.exr", large);
    const std::string file = "'" + folder + "/large.exr' ";
    ASSERT_EQ(runCommand(std::string("'") + CONELIGHT_PROGRAM + "' compare " + file + file +
                         "--no-flip --report '" + folder + "/report'")
                  .status,
              0);
    browser_->open(address_);
    browser_->waitFor("document.documentElement.dataset.draws > 0");
    browser_->evaluate("document.getElementById('canvas').focus()");
    browser_->typeKey("ArrowRight");  // from the middle
    const std::vector<std::string> values = readout("readA");
    const std::size_t i = std::size_t(3 * (kLargeHeight / 2 * kLargeWidth + kLargeWidth / 2 + 1));
    // Half a step of 2^-11; below 2^-14 a step is 2^-24.
    EXPECT_NEAR(std::stod(values.at(0)), large.pixels[i], std::abs(large.pixels[i]) * 6e-4);
    EXPECT_NEAR(std::stod(values.at(1)), 60000, 16);
    EXPECT_NEAR(std::stod(values.at(2)), 1e-6, 4e-8);
    EXPECT_EQ(browser_->evaluate("document.getElementById('precision').textContent.includes('16-bit')"),
              true);
}

}  // namespace conelight::test
