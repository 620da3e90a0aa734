// SPDX-License-Identifier: MIT
// Views that look inside, by pixels of scenes whose answer is known: edges of triangles and shadow maps.
#include <algorithm>

#include "conelight/error.h"
#include "support/truth_rig.h"
#include "support/views_rig.h"

namespace conelight::test {
namespace {

constexpr int kPixels = kViewPixels;

// One quad that fills the view: its diagonal is an edge, the middles of its halves are not.
TEST_F(ViewsTest, EdgesLieWhereTrianglesMeet) {
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial(glm::vec3(0.5f)));
    scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 2));
    scene.sky = glm::vec3(0.25f);
    Settings settings = viewSettings(Mode::Phong, Component::Albedo);
    const Image plain = draw(scene, settings);
    settings.view.wireframe = Wireframe::Over;
    const Image over = draw(scene, settings);
    int onDiagonals = 0;
    for (int i = 8; i < kPixels - 8; ++i) {
        onDiagonals += glm::length(colorAt(over, i, i) - colorAt(plain, i, i)) > 0.05f ? 1 : 0;
        onDiagonals +=
            glm::length(colorAt(over, i, kPixels - 1 - i) - colorAt(plain, i, kPixels - 1 - i)) > 0.05f;
    }
    EXPECT_GE(onDiagonals, kPixels - 16);  // one of the two diagonals, all along
    EXPECT_LE(onDiagonals, kPixels - 12);  // not the other
    for (const glm::ivec2 p :
         {glm::ivec2(32, 10), glm::ivec2(10, 32), glm::ivec2(54, 32), glm::ivec2(32, 54)})
        EXPECT_EQ(colorAt(over, p.x, p.y), colorAt(plain, p.x, p.y));
    settings.view.wireframe = Wireframe::Alone;
    const Image alone = draw(scene, settings);
    EXPECT_EQ(colorAt(alone, 32, 10), glm::vec3(0.25f));  // the sky, not the surface
    EXPECT_GT(differing(alone, plain), 0.9);
    // As bright on the screen whatever the exposure.
    settings.image.exposure = {false, 3};
    const Image exposed = draw(scene, settings);
    float brightest = 0, brightestExposed = 0;
    for (int i = 8; i < kPixels - 8; ++i)
        for (const int x : {i, kPixels - 1 - i}) {
            brightest = std::max(brightest, colorAt(alone, x, i).x);
            brightestExposed = std::max(brightestExposed, colorAt(exposed, x, i).x);
        }
    EXPECT_GT(brightest, 0.3f);
    EXPECT_LT(brightestExposed, brightest);
}

// A square of two triangles, seen straight: each keeps the square of what is left of its extent, about its middle.
TEST_F(ViewsTest, ShrunkTrianglesStayAboutTheirMiddles) {
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial(glm::vec3(0.5f)));
    scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 2));
    Settings settings = viewSettings(Mode::Phong, Component::Albedo);
    const double whole = covered(draw(scene, settings));
    ASSERT_GT(whole, 0.5);
    for (const float shrink : {0.25f, 0.5f}) {
        settings.view.shrink = shrink;
        const Image small = draw(scene, settings);
        // Outlines of six edges, each off by less than half a pixel.
        EXPECT_NEAR(covered(small) / whole, (1 - shrink) * (1 - shrink), 6 * 0.5 / kPixels) << shrink;
        EXPECT_EQ(colorAt(small, kPixels / 2, kPixels / 2), glm::vec3(0)) << "their common edge";
    }
    settings.image.antialiasing = 4;
    EXPECT_NEAR(covered(draw(scene, settings)) / whole, 0.25, 8 * 0.5 / kPixels)
        << "in every view of a still";
}

// Over: edges behind surfaces are hidden; alone: they are not. A far cube's edges behind a near quad.
TEST_F(ViewsTest, HiddenEdgesAreLeftOutUnlessAlone) {
    Scene scene = redCube();
    Settings settings = viewSettings(Mode::Phong, Component::Albedo);
    settings.view.wireframe = Wireframe::Over;
    const double visible = differing(draw(scene, settings), [&] {
        Settings without = settings;
        without.view.wireframe = Wireframe::Off;
        return draw(scene, without);
    }());
    settings.view.wireframe = Wireframe::Alone;
    const double all = differing(draw(scene, settings), [&] {
        Scene empty = scene;
        for (Instance& instance : empty.instances) instance.visible = false;
        return draw(empty, settings);
    }());
    EXPECT_GT(visible, 0.02);
    EXPECT_GT(all, 1.2 * visible);  // six sides and not three
}

// A light 1.5 above a floor: below it the map holds that distance along its axis.
TEST_F(ViewsTest, ShadowMapsHoldDistances) {
    Scene scene;
    addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), diffuseMaterial(glm::vec3(0.5f)));
    scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 2));
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(1);
    scene.lights.push_back(sun);
    Light point;
    point.type = LightType::Point;
    point.position = {0, 1.5f, 0};
    point.intensity = glm::vec3(1);
    scene.lights.push_back(point);
    for (const Mode mode : {Mode::Traced, Mode::Phong}) {
        Settings settings = viewSettings(mode, Component::ShadowMap);
        settings.view.light = 1;  // second in the scene, first in the table, which is sorted by kind
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), 96, 64, settings);
        const Image image = renderer.readImage();
        // +x -x +y above, -y +z -z below, tiles of 32 pixels.
        EXPECT_NEAR(colorAt(image, 16, 48).x, 1.5f,
                    0.01f);  // -y: all floor, at the same distance along the axis
        EXPECT_NEAR(colorAt(image, 6, 38).x, 1.5f, 0.01f);
        EXPECT_EQ(colorAt(image, 80, 16), glm::vec3(0));  // +y: nothing
        settings.view.light = 7;                          // beyond the last: the last
        renderer.render(scene.cameras.at(0), 96, 64, settings);
        EXPECT_EQ(renderer.readImage().pixels, image.pixels);
        settings.view.light = 0;  // one map: all of it is floor at one distance
        renderer.render(scene.cameras.at(0), 96, 64, settings);
        const Image single = renderer.readImage();
        EXPECT_GT(colorAt(single, 48, 32).x, 0);
        EXPECT_NEAR(colorAt(single, 40, 20).x, colorAt(single, 48, 32).x, 0.01f);
        EXPECT_EQ(colorAt(single, 2, 32), glm::vec3(0));  // beside the square map
    }
}

// A light at the eye: what faces it sends its irradiance back, what is seen aslant less. It goes with the camera, and
// nothing in the scene is made anew for it.
TEST_F(ViewsTest, TheHeadlightGoesWithTheEye) {
    constexpr float kPi = 3.1415927f;
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial(glm::vec3(0.5f)));
    scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 2));
    for (const Mode mode : {Mode::Traced, Mode::Cones, Mode::Hybrid, Mode::Phong}) {
        Settings settings = viewSettings(mode, Component::Full);
        SCOPED_TRACE(getSetting(settings, "mode"));
        Renderer renderer;
        renderer.setScene(scene);
        renderer.setProfiling(true, false);
        Camera camera = scene.cameras.front();
        const auto drawn = [&] {
            renderer.render(camera, kPixels, kPixels, settings);
            return renderer.readImage();
        };
        const Image dark = drawn();
        EXPECT_LT(colorAt(dark, 32, 32).x, 1e-3f);
        renderer.setHeadlight(kPi);
        EXPECT_NEAR(colorAt(drawn(), 32, 32).x, 0.5f, 0.01f);
        // From 60 degrees beside.
        camera.eye = camera.target + glm::length(camera.eye - camera.target) * glm::vec3(0.8660254f, 0.5f, 0);
        EXPECT_NEAR(colorAt(drawn(), 32, 32).x, 0.25f, 0.01f);
        for (const PassStats& pass : renderer.stats().passes) {
            EXPECT_EQ(pass.name.find("voxels"), std::string::npos) << pass.name;
            EXPECT_EQ(pass.name.find("update"), std::string::npos) << pass.name;
        }
        EXPECT_TRUE(renderer.scene().lights.empty());
        settings.component = Component::Indirect;
        EXPECT_LT(colorAt(drawn(), 32, 32).x, 1e-3f) << "it bounces nowhere";
        settings.component = Component::Full;
        camera = scene.cameras.front();
        renderer.setHeadlight(0);
        EXPECT_EQ(differing(drawn(), dark), 0);
        EXPECT_THROW(renderer.setHeadlight(-1), Error);
    }
}

}  // namespace
}  // namespace conelight::test
