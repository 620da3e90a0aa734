// SPDX-License-Identifier: MIT
// Cones and rays as lines over a picture: where they start and end, what is hidden, what stands out.
#include <algorithm>

#include <gtest/gtest.h>

#include "session/inspection_lines.h"

namespace conelight::program {
namespace {

Camera camera() {
    Camera c;
    c.eye = {0, 0, 5};
    c.target = {0, 0, 0};
    c.fovY = 2 * std::atan(0.2f);  // the plane z = 0 is 2 high
    return c;
}

TEST(InspectionLines, PointsFallWhereTheCameraSeesThem) {
    const auto middle = pictureOf(camera(), 2, {0, 0, 0});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, 0.5f, 1e-5f);
    EXPECT_NEAR(middle->y, 0.5f, 1e-5f);
    const auto corner = pictureOf(camera(), 2, {2, 1, 0});  // upper right
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->x, 1, 1e-5f);
    EXPECT_NEAR(corner->y, 0, 1e-5f);
    EXPECT_FALSE(pictureOf(camera(), 2, {0, 0, 6}));  // behind the eye
}

TEST(InspectionLines, AxesFootprintsAndHiddenPieces) {
    PixelInspection pixel;
    InspectedPath cone;
    cone.origin = {-1, 0, 0};
    cone.direction = {1, 0, 0};
    cone.distance = 2;
    cone.aperture = 0.5f;
    cone.steps.resize(3);
    for (int i = 0; i < 3; ++i) {
        cone.steps[static_cast<std::size_t>(i)].position = {-1 + 0.5f * static_cast<float>(i + 1), 0, 0};
        cone.steps[static_cast<std::size_t>(i)].distance = 0.5f * static_cast<float>(i + 1);
    }
    pixel.paths = {cone, cone};
    pixel.paths[1].end = PathEnd::Unused;
    // Right of x = 0 a surface is in front.
    const auto sees = [](const glm::vec3& p) { return p.x < 0; };
    const std::vector<PictureLine> lines = inspectionLines(pixel, camera(), 2, -1, sees);
    ASSERT_EQ(lines.size(), 10u + 3 * 20u);  // one axis, three footprints; the unused one is left out
    EXPECT_NEAR(lines.front().from.x, 0.25f, 1e-5f);
    EXPECT_NEAR(lines[9].to.x, 0.75f, 1e-5f);
    EXPECT_GT(lines.front().opacity, 5 * lines[9].opacity);
    float widest = 0;
    for (const PictureLine& line : lines) widest = std::max(widest, std::abs(line.from.y - 0.5f));
    EXPECT_NEAR(widest, 0.5f * 1.5f * std::tan(0.25f), 0.03f);  // of the last footprint, on a picture 2 high
    pixel.paths[1].end = PathEnd::Open;
    EXPECT_LT(inspectionLines(pixel, camera(), 2, 1, {}).front().opacity, 0.5f);  // the other one stands out
}

}  // namespace
}  // namespace conelight::program
