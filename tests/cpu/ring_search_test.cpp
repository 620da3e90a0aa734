// SPDX-License-Identifier: MIT
// The search for cone sets against pictures whose best set is known, and cone sets as files.
#include "reference/ring_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "conelight/error.h"
#include "cpu/io_test_support.h"
#include "gather/cone_set.h"
#include "io/cone_set_file.h"
#include "support/gl_fixture.h"

namespace conelight::reference {
namespace {

using Share = SceneFit::Share;

constexpr int kPixels = 500;

Image random(std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> value(0.1f, 1.0f);
    Image image{kPixels, 1, {}};
    for (int i = 0; i < kPixels; ++i)
        image.pixels.emplace_back(value(engine), value(engine), value(engine), 1);
    return image;
}

Image mix(const std::vector<std::pair<float, const Image*>>& parts) {
    Image sum{kPixels, 1, std::vector<glm::vec4>(kPixels, glm::vec4(0))};
    for (const auto& [weight, image] : parts)
        for (std::size_t i = 0; i < kPixels; ++i) sum.pixels[i] += weight * image->pixels[i];
    return sum;
}

// A pole, two rings of three, a ring of five.
const std::vector<Ring> kRings = {{1, 0, 1}, {3, 0.6f, 1}, {3, 1.2f, 1}, {5, 1.0f, 1}};

class RingSearch : public testing::Test {
  protected:
    RingSearch() {
        for (std::uint32_t i = 0; i < kRings.size(); ++i) pictures.push_back(random(i));
    }
    std::vector<Image> pictures;
};

TEST_F(RingSearch, FindsTheRingsAndWeightsThatMadeThePicture) {
    const Image truth = mix({{0.2f, &pictures[0]}, {0.5f, &pictures[1]}, {0.3f, &pictures[2]}});
    const SceneFit fit(pictures, truth, truth);
    const double scale = 1;
    const FoundSet found = bestSet(kRings, std::span(&fit, 1), std::span(&scale, 1), 7);
    ASSERT_EQ(found.shares.size(), 3u);
    EXPECT_NEAR(found.shares[0].weight, 0.2, 1e-5);
    EXPECT_NEAR(found.shares[1].weight, 0.5, 1e-5);
    EXPECT_NEAR(found.shares[2].weight, 0.3, 1e-5);
    EXPECT_NEAR(found.objective, 0, 1e-6);
    // With six cones the pole is one of five, or two rings of three.
    const FoundSet six = bestSet(kRings, std::span(&fit, 1), std::span(&scale, 1), 6);
    EXPECT_EQ(six.shares.size(), 2u);
    EXPECT_GT(six.objective, found.objective);
    EXPECT_TRUE(bestSet(kRings, std::span(&fit, 1), std::span(&scale, 1), 5).shares.empty());
}

TEST_F(RingSearch, ErrorIsThatOfTheMixedPictureAndWithoutTheTruthsNoise) {
    const Image truth = random(99);
    const Share shares[] = {{0, 0.4}, {3, 0.6}};
    const SceneFit fit(pictures, truth, truth);
    const Image mixed = mix({{0.4f, &pictures[0]}, {0.6f, &pictures[3]}});
    double square = 0, mean = 0;
    for (std::size_t i = 0; i < kPixels; ++i)
        for (int k = 0; k < 3; ++k) {
            square += std::pow(double(mixed.pixels[i][k] - truth.pixels[i][k]), 2);
            mean += double(truth.pixels[i][k]);
        }
    EXPECT_NEAR(fit.relMse(shares), square * 3 * kPixels / (mean * mean), 1e-5);
    // A noise of +-0.3 with opposite signs in the halves is not error: (x - a)(x - b) = (x - t)^2 - 0.09.
    Image a = truth, b = truth;
    for (glm::vec4& p : a.pixels) p += glm::vec4(0.3f, 0.3f, 0.3f, 0);
    for (glm::vec4& p : b.pixels) p -= glm::vec4(0.3f, 0.3f, 0.3f, 0);
    const double perSquare = 3.0 * kPixels * 3 * kPixels / (mean * mean);
    EXPECT_NEAR(SceneFit(pictures, a, b).relMse(shares), fit.relMse(shares) - 0.09 * perSquare, 1e-5);
}

TEST_F(RingSearch, PixelsThatAreNotFiniteAreLeftOut) {
    Image truth = mix({{1.0f, &pictures[0]}});
    pictures[1].pixels[7].x = std::nanf("");
    truth.pixels[9].y = INFINITY;
    const SceneFit fit(pictures, truth, truth);
    const Share pole{0, 1.0};
    EXPECT_NEAR(fit.relMse(std::span(&pole, 1)), 0, 1e-9);
    EXPECT_THROW(SceneFit(pictures, random(1), Image{1, 1, {glm::vec4(1)}}), Error);
    const Image black{kPixels, 1, std::vector<glm::vec4>(kPixels, glm::vec4(0))};
    EXPECT_THROW(SceneFit(pictures, black, black), Error);
}

TEST(RingCones, LieOnTheirTiltAtEvenAzimuths) {
    const std::vector<SetCone> cones = conesOf({4, 1.0f, 0.5f});
    ASSERT_EQ(cones.size(), 4u);
    glm::vec3 sum(0);
    for (const SetCone& cone : cones) {
        EXPECT_NEAR(cone.direction.z, std::cos(1.0f), 1e-6);
        EXPECT_NEAR(glm::length(cone.direction), 1, 1e-6);
        sum += cone.direction;
    }
    EXPECT_NEAR(sum.x, 0, 1e-6);
    EXPECT_NEAR(sum.y, 0, 1e-6);
}

TEST(OwnConeSet, WeightsAreScaledToPiAndAperturesKept) {
    ConesSettings settings;
    settings.diffuseSet = DiffuseSet::Own;
    settings.ownSet = {{{0, 0, 2}, 1.0f, 3}, {{1, 0, 1}, 0.5f, 1}};
    const std::vector<gather::Cone> cones = gather::coneSet(settings);
    ASSERT_EQ(cones.size(), 2u);
    EXPECT_NEAR(cones[0].weight, 0.75 * std::numbers::pi, 1e-6);
    EXPECT_NEAR(cones[1].weight, 0.25 * std::numbers::pi, 1e-6);
    EXPECT_NEAR(cones[0].direction.z, 1, 1e-6);
    EXPECT_NEAR(cones[1].cosHalfAngle, std::cos(0.25f), 1e-6);
}

std::string refusal(const ConesSettings& cones) {
    Settings settings;
    settings.cones = cones;
    try {
        validateSettings(settings);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Usage);
        return error.what();
    }
    return "";
}

TEST(OwnConeSet, WhatCannotBeTracedIsRefused) {
    ConesSettings cones;
    cones.diffuseSet = DiffuseSet::Own;
    EXPECT_EQ(refusal(cones), "");  // six cones, until some are given
    EXPECT_EQ(gather::coneSet(cones).size(), 6u);
    cones.ownSet = {{{0, 0, 1}, 1, 1}};
    EXPECT_EQ(refusal(cones), "");
    cones.ownSet = {{{0, 0, 0}, 1, 1}};
    EXPECT_NE(refusal(cones).find("direction"), std::string::npos);
    cones.ownSet = {{{0, 0, -1}, 1, 1}};
    EXPECT_NE(refusal(cones).find("direction: z"), std::string::npos);
    cones.ownSet = {{{0, 0, 1}, 3, 1}};
    EXPECT_NE(refusal(cones).find("aperture"), std::string::npos);
    cones.ownSet = {{{0, 0, 1}, 1, -1}};
    EXPECT_NE(refusal(cones).find("weight"), std::string::npos);
    cones.ownSet.assign(65, {{0, 0, 1}, 1, 1});
    EXPECT_NE(refusal(cones).find("65 cones"), std::string::npos);
    cones.diffuseSet = DiffuseSet::Six;  // not asked for
    EXPECT_EQ(refusal(cones), "");
}

TEST(ConeSetFile, ComesBackAsItWasWritten) {
    const std::string path = (test::folderOf("cone_set") / "set.json").string();
    const std::vector<SetCone> cones = {{{0, 0, 1}, 0.75f, 1.5f}, {{0.5f, 0.25f, 0.5f}, 1.25f, 0.5f}};
    io::writeConeSet(path, cones);
    EXPECT_EQ(io::readConeSet(path), cones);
}

TEST(ConeSetFile, FaultsAreNamedWithTheirLine) {
    const auto message = [](const std::string& text) {
        const std::string path = test::write(test::folderOf("cone_set_bad") / "set.json", text);
        try {
            io::readConeSet(path);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0u) << error.what();
            return std::string(error.what()).substr(path.size());
        }
        return std::string();
    };
    EXPECT_NE(message("[]").find("list 'cones'"), std::string::npos);
    EXPECT_NE(message("{\"cones\": [\n{\"direction\": [0, 0], \"aperture\": 1, \"weight\": 1}]}")
                  .find(":2: 'direction'"),
              std::string::npos);
    EXPECT_NE(message("{\"cones\": [{\"direction\": [0, 0, 1],\n\"weight\": 1}]}").find("'aperture'"),
              std::string::npos);
    EXPECT_NE(message("{\"cones\": [{\"direction\": [0, 0, 1], \"angle\": 1}]}").find("no 'angle'"),
              std::string::npos);
    EXPECT_NE(message("{\"cones\": []}").find("1 to 64 cones"), std::string::npos);
    EXPECT_NE(
        message("{\"cones\": [{\"direction\": [0, 0, 1], \"aperture\": 9, \"weight\": 1}]}").find("aperture"),
        std::string::npos);
}

}  // namespace
}  // namespace conelight::reference
