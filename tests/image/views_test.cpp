// SPDX-License-Identifier: MIT
// Views that look inside, by pixels of scenes whose answer is known: edges of triangles, shadow maps, voxels
// at every level, alone and among the objects.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "conelight/renderer.h"

#include "conelight/thesis/settings.h"
#include "gl/pass.h"
#include "io/generated_shapes.h"
#include "scene/gpu_scene.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"
#include "voxels/surface_voxels.h"
#include "voxels/thesis_volume.h"

namespace conelight::test {
namespace {

constexpr int kPixels = 64;

glm::vec3 at(const Image& image, int x, int y) {
    return glm::vec3(image.pixels[static_cast<std::size_t>(y * image.width + x)]);
}

// Part of the picture that is covered.
double covered(const Image& image) {
    double sum = 0;
    for (const glm::vec4& p : image.pixels) sum += p.a;
    return sum / static_cast<double>(image.pixels.size());
}

double differing(const Image& a, const Image& b) {
    double count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += glm::length(glm::vec3(a.pixels[i] - b.pixels[i])) > 1e-3f ? 1 : 0;
    return count / static_cast<double>(a.pixels.size());
}

Settings settingsOf(Mode mode, Component component) {
    Settings settings;
    settings.mode = mode;
    settings.component = component;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    settings.cones.bounces = 1;
    settings.traced.cacheUpdates = 4;
    settings.traced.passes = 1;
    return settings;
}

// A red cube of edge 1 about the origin, in front of nothing, seen from +z and a little above and beside.
Scene redCube() {
    Scene outside;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            const glm::vec3 corner = 0.5f * n - 0.5f * (u + v);
            addInstance(outside, side > 0 ? quadMesh(corner, u, v) : quadMesh(corner, v, u),
                        mattMaterial({0.8f, 0.1f, 0.05f}));
        }
    Light light;
    light.type = LightType::Point;
    light.position = {0.4f, 0.6f, 3};
    light.intensity = glm::vec3(10);
    outside.lights.push_back(light);
    Camera camera;
    camera.eye = {0.2f, 0.3f, 3};
    camera.target = {0, 0, 0};
    camera.fovY = 0.5f;
    outside.cameras.push_back(camera);
    return outside;
}

class ViewsTest : public GlTest {
  protected:
    void TearDown() override {
        renderer_.reset();
        GlTest::TearDown();
    }
    // One renderer for all pictures of a test: programs are built once.
    Image draw(const Scene& scene, const Settings& settings) {
        if (!renderer_) renderer_ = std::make_unique<Renderer>();
        renderer_->setScene(scene);
        return again(scene, settings);
    }
    // The scene of the last draw.
    Image again(const Scene& scene, const Settings& settings) {
        renderer_->render(scene.cameras.at(0), kPixels, kPixels, settings);
        return renderer_->readImage();
    }

  private:
    std::unique_ptr<Renderer> renderer_;
};

// One quad that fills the view: its diagonal is an edge, the middles of its halves are not.
TEST_F(ViewsTest, EdgesLieWhereTrianglesMeet) {
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), mattMaterial(glm::vec3(0.5f)));
    scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 2));
    scene.sky = glm::vec3(0.25f);
    Settings settings = settingsOf(Mode::Phong, Component::Albedo);
    const Image plain = draw(scene, settings);
    settings.view.wireframe = Wireframe::Over;
    const Image over = draw(scene, settings);
    int onDiagonals = 0;
    for (int i = 8; i < kPixels - 8; ++i) {
        onDiagonals += glm::length(at(over, i, i) - at(plain, i, i)) > 0.05f ? 1 : 0;
        onDiagonals += glm::length(at(over, i, kPixels - 1 - i) - at(plain, i, kPixels - 1 - i)) > 0.05f;
    }
    EXPECT_GE(onDiagonals, kPixels - 16);  // one of the two diagonals, all along
    EXPECT_LE(onDiagonals, kPixels - 12);  // not the other
    for (const glm::ivec2 p :
         {glm::ivec2(32, 10), glm::ivec2(10, 32), glm::ivec2(54, 32), glm::ivec2(32, 54)})
        EXPECT_EQ(at(over, p.x, p.y), at(plain, p.x, p.y));
    settings.view.wireframe = Wireframe::Alone;
    const Image alone = draw(scene, settings);
    EXPECT_EQ(at(alone, 32, 10), glm::vec3(0.25f));  // the sky, not the surface
    EXPECT_GT(differing(alone, plain), 0.9);
    // As bright on the screen whatever the exposure.
    settings.image.exposure = 3;
    const Image exposed = draw(scene, settings);
    float brightest = 0, brightestExposed = 0;
    for (int i = 8; i < kPixels - 8; ++i)
        for (const int x : {i, kPixels - 1 - i}) {
            brightest = std::max(brightest, at(alone, x, i).x);
            brightestExposed = std::max(brightestExposed, at(exposed, x, i).x);
        }
    EXPECT_GT(brightest, 0.3f);
    EXPECT_LT(brightestExposed, brightest);
}

// Over: edges behind surfaces are hidden; alone: they are not. A far cube's edges behind a near quad.
TEST_F(ViewsTest, HiddenEdgesAreLeftOutUnlessAlone) {
    Scene scene = redCube();
    Settings settings = settingsOf(Mode::Phong, Component::Albedo);
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
    addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), mattMaterial(glm::vec3(0.5f)));
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
        Settings settings = settingsOf(mode, Component::ShadowMap);
        settings.view.light = 1;  // second in the scene, first in the table, which is sorted by kind
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(scene.cameras.at(0), 96, 64, settings);
        const Image image = renderer.readImage();
        // +x -x +y above, -y +z -z below, tiles of 32 pixels.
        EXPECT_NEAR(at(image, 16, 48).x, 1.5f, 0.01f);  // -y: all floor, at the same distance along the axis
        EXPECT_NEAR(at(image, 6, 38).x, 1.5f, 0.01f);
        EXPECT_EQ(at(image, 80, 16), glm::vec3(0));  // +y: nothing
        settings.view.light = 7;                     // beyond the last: the last
        renderer.render(scene.cameras.at(0), 96, 64, settings);
        EXPECT_EQ(renderer.readImage().pixels, image.pixels);
        settings.view.light = 0;  // one map: all of it is floor at one distance
        renderer.render(scene.cameras.at(0), 96, 64, settings);
        const Image single = renderer.readImage();
        EXPECT_GT(at(single, 48, 32).x, 0);
        EXPECT_NEAR(at(single, 40, 20).x, at(single, 48, 32).x, 0.01f);
        EXPECT_EQ(at(single, 2, 32), glm::vec3(0));  // beside the square map
    }
}

// The cube is as large in voxels as it is, to about a voxel, at every level; and has its colour and normals.
TEST_F(ViewsTest, VoxelsShowTheCubeAtEveryLevel) {
    const Scene scene = redCube();
    const double truth = covered(draw(scene, settingsOf(Mode::Phong, Component::Albedo)));
    for (const Mode mode : {Mode::Traced, Mode::Cones}) {
        Settings settings = settingsOf(mode, Component::Voxels);
        settings.view.voxelShape = VoxelShape::Cubes;
        settings.view.voxelData = VoxelData::Albedo;
        for (int level = 0; level <= 3; ++level) {
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            const Image image = draw(scene, settings);
            // 32 voxels are 1.06 m: cubes of 2^level stick out by less than one on each side.
            const double edge = 1 + 2 * 0.033 * (1 << level);
            EXPECT_GE(covered(image), 0.97 * truth) << level;
            EXPECT_LE(covered(image), 1.05 * truth * edge * edge) << level;
            EXPECT_NEAR(at(image, 32, 32).x, 0.8f, 0.01f) << level;
            EXPECT_NEAR(at(image, 32, 32).y, 0.1f, 0.01f) << level;
        }
        settings.view.voxelLevel = {};
        settings.view.voxelData = VoxelData::Normal;
        EXPECT_NEAR(at(draw(scene, settings), 32, 32).z, 1.0f, 0.02f);  // +z
        settings.view.voxelData = VoxelData::Coverage;
        EXPECT_NEAR(at(draw(scene, settings), 32, 32).x, 1.0f, 0.05f);
        settings.view.voxelData = VoxelData::Level;
        EXPECT_EQ(at(draw(scene, settings), 32, 32), glm::vec3(0, 0, 1));  // level 0 is blue
    }
}

TEST_F(ViewsTest, EveryShapeAndKindOfDataDraws) {
    const Scene scene = redCube();
    const double truth = covered(draw(scene, settingsOf(Mode::Phong, Component::Albedo)));
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        Settings settings = settingsOf(mode, Component::Voxels);
        draw(scene, settings);
        for (const VoxelShape shape : {VoxelShape::Auto, VoxelShape::Cubes, VoxelShape::Edges,
                                       VoxelShape::Faces, VoxelShape::Volume, VoxelShape::Surfaces})
            for (int data = 0; data <= static_cast<int>(VoxelData::Level); ++data) {
                settings.view.voxelShape = shape;
                settings.view.voxelData = static_cast<VoxelData>(data);
                const Image image = again(scene, settings);
                SCOPED_TRACE(testing::Message() << "mode " << mode.name() << " shape "
                                                << static_cast<int>(shape) << " data " << data);
                const double part = covered(image);
                EXPECT_GT(part, shape == VoxelShape::Edges ? 0.02 : 0.15);
                EXPECT_LT(part, 1.3 * truth);  // bricks stick out by up to four voxels
                for (const glm::vec4& p : image.pixels)
                    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(p[c]));
            }
    }
}

// Age is the number of updates; the cache's irradiance alone is dark where there is nothing to reflect.
// A lamp that is a light itself: rays count it as that, and its voxels were black once.
TEST_F(ViewsTest, LampsGlow) {
    const glm::vec3 emission(3, 2, 1);
    Scene scene = redCube();
    for (Material& material : scene.materials) material.emission = emission;
    for (const int level : {0, 2}) {
        Settings settings = settingsOf(Mode::Traced, Component::Voxels);
        settings.traced.bounces = 0;
        settings.view.voxelLevel.value = static_cast<float>(level);
        const Image image = draw(scene, settings);
        const glm::vec3 shown = at(image, kPixels / 2, kPixels / 2);
        // On top of its own light what it reflects of the lamp of the scene: at most 0.8 * 10 / 2.5^2 / pi.
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(shown[c], 0.95f * emission[c]) << "level " << level;
            EXPECT_LT(shown[c], 1.05f * emission[c] + 0.45f) << "level " << level;
        }
    }
}

TEST_F(ViewsTest, AgeCountsUpdates) {
    const Scene scene = closedBox(mattMaterial(glm::vec3(0.5f), glm::vec3(1)));
    Settings settings = settingsOf(Mode::Traced, Component::Voxels);
    settings.view.voxelData = VoxelData::Age;
    settings.traced.cacheUpdates = 1;
    const glm::vec3 young = at(draw(scene, settings), 32, 32);  // log2(2) / 8: much blue
    settings.traced.cacheUpdates = 255;
    settings.traced.cacheRays = 1;
    settings.voxels.size = 16;
    const glm::vec3 old = at(draw(scene, settings), 32, 32);  // log2(256) / 8: red
    EXPECT_GT(young.z, 0.9f);
    EXPECT_LT(young.x, 0.1f);
    EXPECT_NEAR(old.x, 1.0f, 0.05f);
    EXPECT_NEAR(old.z, 0.0f, 0.05f);
    settings.view.voxelData = VoxelData::Irradiance;  // e / (1 - rho) arrives from everywhere
    settings.light.emissiveQuads = false;
    EXPECT_NEAR(at(draw(scene, settings), 32, 32).x, 2.0f, 0.1f);
}

// A cone of the aperture has the diameter of a voxel at one distance, and of two at twice that.
TEST_F(ViewsTest, TheLevelGrowsWithTheDistance) {
    Scene scene;
    addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), mattMaterial(glm::vec3(0.5f)));
    Camera camera;
    camera.eye = {0, 0.8f, 3.9f};
    camera.target = {0, 0.3f, 0};
    camera.fovY = 1.2f;
    scene.cameras.push_back(camera);
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode})
        for (const VoxelShape shape : {VoxelShape::Cubes, VoxelShape::Surfaces}) {
            Settings settings = settingsOf(mode, Component::Voxels);
            settings.view.voxelShape = shape;
            settings.view.voxelData = VoxelData::Level;
            settings.view.voxelAperture = 0.4f;
            const Image image = draw(scene, settings);
            // From blue (low) below to redder or greener ones above: green never falls on the way up.
            float last = -1;
            int levels = 0;
            for (int y = kPixels - 1; y > 0 && image.pixels[static_cast<std::size_t>(y * kPixels + 32)].a > 0;
                 --y) {
                const glm::vec3 color = at(image, 32, y);
                const float order = color.y - color.z + 2 * color.x;
                EXPECT_GE(order, last - 1e-4f) << y;
                levels += order > last + 1e-4f ? 1 : 0;
                last = std::max(last, order);
            }
            EXPECT_GE(levels, 3) << mode.name() << " " << static_cast<int>(shape);
        }
}

// Cubes stick out of the surface by up to a voxel: among the objects some are in front and some are not; what
// is nearer than both stays.
TEST_F(ViewsTest, VoxelsStandAmongTheObjects) {
    Scene scene = redCube();
    // A plate in front of the cube's left half that is not voxelized.
    const std::size_t plate =
        addInstance(scene, quadMesh({-1, -1, 1}, {1, 0, 0}, {0, 2, 0}), mattMaterial({0, 0, 1}));
    scene.instances[plate].voxelized = false;
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode}) {
        Settings settings = settingsOf(mode, Component::Albedo);
        const Image picture = draw(scene, settings);
        settings.view.voxels = true;
        settings.view.voxelShape = VoxelShape::Cubes;
        settings.view.voxelData = VoxelData::Level;
        const Image among = draw(scene, settings);
        EXPECT_EQ(at(among, 16, 32), at(picture, 16, 32)) << mode.name();  // the plate is in front
        EXPECT_EQ(at(picture, 16, 32), glm::vec3(0, 0, 1));
        EXPECT_GT(differing(among, picture), 0.05) << mode.name();
    }
}

// Patches of all directions and colours, far apart: most of the grid is empty.
// Not every seed will do: corners of patches that a coarse cell holds nothing of but a millionth are not
// drawn (kLeastOpacity of voxel_view.comp.glsl), though a ray meets their cube.
Scene scatteredPatches() {
    constexpr std::uint32_t kSeed = 1;
    Scene scene;
    for (int i = 0; i < 24; ++i) {
        const auto hash = [i](std::uint32_t k) {
            return io::shapes::unitFloat(io::shapes::hash(static_cast<std::uint32_t>(i), k, kSeed));
        };
        const glm::vec3 place(2 * hash(0) - 1, 2 * hash(1) - 1, 2 * hash(2) - 1);
        const glm::vec3 u = 0.1f * glm::normalize(glm::vec3(hash(3), hash(4), hash(5)) - 0.5f);
        const glm::vec3 v = glm::normalize(glm::cross(u, glm::vec3(hash(6), hash(7), 0.3f))) * 0.15f;
        Material material = mattMaterial({0.1f + 0.8f * hash(8), 0.1f + 0.8f * hash(9), 0.5f});
        material.doubleSided = true;
        addInstance(scene, quadMesh(place, u, v), material);
    }
    Camera camera;
    camera.eye = {1.6f, 0.9f, 2.5f};
    camera.target = {0, 0, 0};
    camera.fovY = 0.9f;
    scene.cameras.push_back(camera);
    return scene;
}

// What rays may meet, m.
struct Cubes {
    std::vector<glm::dvec3> lows, highs;
    // Distance along `ray` to the nearest; none: infinity. All are tried: nothing is skipped.
    double meet(const glm::dvec3& eye, const glm::dvec3& ray) const {
        double nearest = INFINITY;
        for (std::size_t i = 0; i < lows.size(); ++i) {
            const glm::dvec3 a = (lows[i] - eye) / ray, b = (highs[i] - eye) / ray;
            const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
            const double in = std::max({enter.x, enter.y, enter.z});
            if (in < std::min({leave.x, leave.y, leave.z}) && in > 0) nearest = std::min(nearest, in);
        }
        return nearest;
    }
};

// What is drawn is what a ray meets that tries every cube, though rays leap over what is empty.
TEST_F(ViewsTest, RaysThatLeapMeetWhatRaysMeetThatDoNot) {
    Scene scene = scatteredPatches();
    const Camera& camera = scene.cameras[0];
    Settings settings = settingsOf(Mode::Traced, Component::Voxels);
    settings.voxels.size = 64;
    settings.light.shadowSize = 0;
    settings.traced.bounces = 0;
    settings.view.voxelShape = VoxelShape::Cubes;
    gl::Profiler profiler;
    ViewRig rig(scene, camera, kPixels, kPixels);
    rig.draw(programs());
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode})
        for (const int level : {0, 1, 2, 3}) {
            SCOPED_TRACE(testing::Message() << "mode " << mode.name() << " level " << level);
            Cubes cubes;
            const auto add = [&](const glm::vec3& origin, float edge, const glm::ivec3& voxel,
                                 const glm::ivec3& end) {
                const glm::ivec3 low = voxel >> level << level;
                const glm::ivec3 high = glm::min(low + (1 << level), end);
                cubes.lows.push_back(glm::dvec3(origin) + static_cast<double>(edge) * glm::dvec3(low));
                cubes.highs.push_back(glm::dvec3(origin) + static_cast<double>(edge) * glm::dvec3(high));
            };
            if (mode == thesis::kMode) {
                voxels::ThesisVolumeOptions options;
                options.size = settings.voxels.size;
                options.padding = settings.voxels.padding;
                options.shadows = false;
                voxels::ThesisVolume volume;
                rig.draw(programs());
                volume.build(programs(), profiler, rig.gpuScene, options);
                const auto n = static_cast<int>(volume.grid().size);
                std::vector<glm::vec4> texels(static_cast<std::size_t>(n) * n * n);
                volume.texture().read(0, GL_RGBA, GL_FLOAT, texels.data(), texels.size() * sizeof(glm::vec4));
                for (int i = 0; i < n * n * n; ++i)
                    if (texels[static_cast<std::size_t>(i)].a > 0)
                        add(volume.grid().origin, volume.grid().voxelSize, {i % n, i / n % n, i / (n * n)},
                            glm::ivec3(n));
            } else {
                voxels::SurfaceVoxels surface;
                surface.build(programs(), profiler, rig.gpuScene, settings.voxels);
                const voxels::VoxelGrid& grid = surface.grid();
                // The volume of mode cones has whole texels at its border.
                const glm::ivec3 end = mode == Mode::Cones ? 2 * grid.size : grid.size;
                std::vector<glm::uvec4> words(grid.brickCount());
                surface.brickWords().read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, words.data(),
                                          words.size() * sizeof(glm::uvec4));
                for (std::size_t i = 0; i < words.size(); ++i) {
                    const int b = static_cast<int>(i);
                    const glm::ivec3 n = grid.bricks(), brick(b % n.x, b / n.x % n.y, b / (n.x * n.y));
                    for (std::uint32_t bit = 0; bit < 64; ++bit)
                        if (((bit < 32 ? words[i].x : words[i].y) >> (bit % 32) & 1) != 0)
                            add(grid.origin, grid.voxelSize, voxels::voxelOfBit(brick, bit), end);
                }
            }
            settings.mode = mode;
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            const Image image = draw(scene, settings);
            int met = 0, wrong = 0;
            for (int y = 0; y < kPixels; ++y)
                for (int x = 0; x < kPixels; ++x) {
                    const glm::dvec3 forward =
                        glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
                    const glm::dvec3 at = pixelOnPlane(camera, kPixels, kPixels, x, y, forward,
                                                       glm::dot(forward, glm::dvec3(camera.eye)) + 1);
                    const bool meets = std::isfinite(cubes.meet(camera.eye, at - glm::dvec3(camera.eye)));
                    const bool drawn =
                        image.pixels[static_cast<std::size_t>((kPixels - 1 - y) * kPixels + x)].a > 0;
                    met += meets;
                    wrong += meets != drawn;
                }
            EXPECT_GT(met, 100);
            EXPECT_LT(met, kPixels * kPixels * 3 / 4);
            EXPECT_LE(wrong, 4);  // rays along an edge
        }
}

// The coarser levels and what is empty are kept from frame to frame: not when the scene or its light changes.
TEST_F(ViewsTest, WhatIsKeptForVoxelsFollowsTheScene) {
    for (const Mode mode : {Mode::Traced, Mode::Cones, thesis::kMode})
        for (const int level : {0, 2}) {
            SCOPED_TRACE(testing::Message() << "mode " << mode.name() << " level " << level);
            Scene scene = redCube();
            Settings settings = settingsOf(mode, Component::Voxels);
            settings.traced.bounces = 0;
            settings.view.voxelShape = VoxelShape::Cubes;
            settings.view.voxelLevel = {false, static_cast<float>(level)};
            Renderer kept;
            kept.setScene(scene);
            const auto drawWith = [&](Renderer& renderer) {
                renderer.render(scene.cameras[0], kPixels, kPixels, settings);
                return renderer.readImage();
            };
            const auto drawAnew = [&] {
                Renderer fresh;
                fresh.setScene(scene);
                return drawWith(fresh);
            };
            const Image before = drawWith(kept);
            // The side towards the camera goes in, within the bounds: the grid stays.
            scene.instances.back().worldFromObject = glm::translate(glm::mat4(1), glm::vec3(0, 0, -0.4f));
            kept.setInstance(scene.instances.size() - 1, scene.instances.back());
            const Image moved = drawWith(kept);
            EXPECT_GT(differing(before, moved), 0.01);
            EXPECT_LT(differing(moved, drawAnew()), 0.005);
            scene.lights[0].intensity *= 3.0f;
            kept.setLight(0, scene.lights[0]);
            const Image lit = drawWith(kept);
            EXPECT_GT(differing(moved, lit), 0.01);
            EXPECT_LT(differing(lit, drawAnew()), 0.005);
        }
}

// Edges leave the cubes open, and the ray meets the same cubes as a volume does.
TEST_F(ViewsTest, EdgesAreOpenAndVolumesThin) {
    Scene scene = redCube();
    scene.cameras[0].fovY = 0.25f;  // cubes of 11 pixels: their edges are 1.5 wide
    Settings settings = settingsOf(Mode::Traced, Component::Voxels);
    settings.voxels.size = 8;
    settings.view.voxelShape = VoxelShape::Cubes;
    const double cubes = covered(draw(scene, settings));
    settings.view.voxelShape = VoxelShape::Edges;
    EXPECT_LT(covered(draw(scene, settings)), 0.7 * cubes);
    settings.view.voxelShape = VoxelShape::Volume;
    settings.view.voxelDensity = 1;
    const double dense = covered(draw(scene, settings));
    settings.view.voxelDensity = 0.02f;
    const double thin = covered(draw(scene, settings));
    EXPECT_GT(dense, 0.8 * cubes);
    EXPECT_LT(thin, 0.5 * dense);
    EXPECT_GT(thin, 0.01);
}

}  // namespace
}  // namespace conelight::test
