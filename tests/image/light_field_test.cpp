// SPDX-License-Identifier: MIT
// LightField: a host draws depth, normals and so on with shaders of its own; what it is told of the light at its
// pixels is what Renderer shows of the same scene.
#include <cmath>
#include <optional>
#include <thread>

#include "conelight/error.h"
#include "platform/headless_context.h"
#include "support/light_field_rig.h"

namespace conelight::test {
namespace {

class LightFieldTest : public LightFieldRig {
  protected:
    // Irradiance over pi, and the radiance of lobes, as Renderer has them; the lowest row first.
    std::vector<glm::vec4> truth(const Settings& settings, Component component) {
        Renderer renderer;
        renderer.setScene(scene_);
        Settings shown = settings;
        shown.component = component;
        shown.light.emissiveQuads = false;
        renderer.render(scene_.cameras.front(), kHostWidth, kHostHeight, shown);
        const Image image = renderer.readImage();
        std::vector<glm::vec4> pixels;
        for (int y = kHostHeight - 1; y >= 0; --y)
            pixels.insert(pixels.end(), image.pixels.begin() + y * kHostWidth,
                          image.pixels.begin() + (y + 1) * kHostWidth);
        if (component == Component::Diffuse)
            for (std::size_t i = 0; i < pixels.size(); ++i)
                pixels[i] /= scene_.materials[instanceAt(i)].baseColor;
        return pixels;
    }
};

// The same pixels, drawn by others: differences are those of depths and rounding.
TEST_F(LightFieldTest, TellsWhatRendererShows) {
    const Settings settings = hostSettings();
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    const GatheredLight light = field.gather(field.addView(), host.surfaces());
    EXPECT_EQ(light.width, kHostWidth);
    const double diffuse =
        hostDifference(pixelsOf(light.diffuse), truth(settings, Component::Diffuse), onMetal(false));
    const double specular =
        hostDifference(pixelsOf(light.specular), truth(settings, Component::Specular), onMetal(true));
    RecordProperty("diffuse", std::to_string(diffuse));
    RecordProperty("specular", std::to_string(specular));
    EXPECT_LT(diffuse, 1e-3);
    EXPECT_LT(specular, 1e-3);
}

// Nested grids round an anchor: as Renderer has them, whose eye is elsewhere.
TEST_F(LightFieldTest, HasNestedGridsRoundAnAnchor) {
    Settings settings = hostSettings();
    settings.voxels.size = 24;
    settings.voxels.levels = 2;
    settings.traced.pixelRays = settings.traced.specularRays = 0;  // the cache alone
    settings.traced.cacheUpdates = 4;
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    const std::size_t oneGrid = field.stats().faces;
    settings.voxels.anchor = VoxelAnchor::at({0.3f, -0.4f, 0.2f});
    field.setSettings(settings);
    field.update();
    EXPECT_GT(field.stats().faces, oneGrid);
    HostPicture host(scene_, lens());
    drawn(host);
    const GatheredLight light = field.gather(field.addView(), host.surfaces());
    EXPECT_LT(hostDifference(pixelsOf(light.diffuse), truth(settings, Component::Diffuse), onMetal(false)),
              1e-3);
    // One grid again.
    settings.voxels.anchor = {};
    field.setSettings(settings);
    field.update();
    EXPECT_EQ(field.stats().faces, oneGrid);
}

// Matrices of other kinds see the same: reversed and infinite depth in [0,1]; normals of triangles from depths.
TEST_F(LightFieldTest, TakesTheHostsMatrices) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(hostSettings());
    field.update();
    HostPicture plain(scene_, lens());
    drawn(plain);
    const std::vector<glm::vec4> expected = pixelsOf(field.gather(field.addView(), plain.surfaces()).diffuse);

    glm::mat4 infinite = lens();
    infinite[2][2] = 0;
    infinite[3][2] = scene_.cameras.front().zNear;
    HostPicture reversed(scene_, infinite, true);
    drawn(reversed);
    const auto all = [](std::size_t) { return true; };
    EXPECT_LT(
        hostDifference(pixelsOf(field.gather(field.addView(), reversed.surfaces()).diffuse), expected, all),
        2e-3);

    plain.surfaces().geometricNormal = 0;
    EXPECT_LT(
        hostDifference(pixelsOf(field.gather(field.addView(), plain.surfaces()).diffuse), expected, all),
        2e-2);
}

// With rays for a quarter of the pixels the others take what their neighbours found.
TEST_F(LightFieldTest, FillsInWhatIsReduced) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(hostSettings());
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> whole = diffuseOf(field, host);
    for (const int reduction : {2, 3}) {
        const GatheredLight light = field.gather(field.addView(), host.surfaces(), {.reduction = reduction});
        EXPECT_EQ(light.height, kHostHeight);
        const double error = hostDifference(pixelsOf(light.diffuse), whole, onMetal(false));
        RecordProperty("reduction" + std::to_string(reduction), std::to_string(error));
        EXPECT_LT(error, 0.09) << reduction;
    }
}

// By one update and one pass a call it comes to the same light, and follows a lamp that goes out.
TEST_F(LightFieldTest, ComesToTheSameByABudget) {
    const Settings finished = hostSettings();
    Settings budgeted = finished;
    budgeted.traced.budgeted = true;
    LightField field;
    field.setScene(scene_);
    field.setSettings(finished);
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> expected = diffuseOf(field, host);

    LightField slow;
    slow.setScene(scene_);
    slow.setSettings(budgeted);
    const int view = slow.addView();
    GatheredLight light;
    EXPECT_EQ(slow.update({.updates = 3}), 3);
    for (int frame = 0; frame < 40; ++frame) {
        slow.update({.updates = 2, .faces = 4000});
        light = slow.gather(view, host.surfaces());
    }
    EXPECT_LT(hostDifference(pixelsOf(light.diffuse), expected, onMetal(false)), 0.05);

    slow.setLights({});
    for (int frame = 0; frame < 20; ++frame) {
        slow.update({.updates = 4});
        light = slow.gather(view, host.surfaces());
    }
    EXPECT_LT(hostMean(pixelsOf(light.diffuse)), 0.05 * hostMean(expected));
}

// The room bends: the light is that of a field which has never seen it straight.
TEST_F(LightFieldTest, FollowsMeshesThatBend) {
    const Settings settings = hostSettings();
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    for (glm::vec3& p : scene_.meshes[kHostMetal].positions) p.y = p.y > 0 ? 3 * p.y : p.y;
    field.setMesh(kHostMetal, scene_.meshes[kHostMetal]);
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> image = diffuseOf(field, host);
    LightField fresh;
    fresh.setScene(scene_);
    fresh.setSettings(settings);
    fresh.update();
    const auto all = [](std::size_t) { return true; };
    EXPECT_LT(hostDifference(image, pixelsOf(fresh.gather(fresh.addView(), host.surfaces()).diffuse), all),
              0.03);
}

// A normal that is not a number is that of the triangle.
TEST_F(LightFieldTest, TakesSliversWithoutNormals) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(hostSettings());
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    host.surfaces().roughness = 0;
    const std::vector<glm::vec4> expected = diffuseOf(field, host);
    host.surfaces().geometricNormal = host.surfaces().normal;
    const float nan[4] = {NAN, NAN, NAN, 1};
    gl::Texture none({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "no normals");
    none.clear(0, GL_RGBA, GL_FLOAT, nan);
    host.surfaces().normal = none.name();
    const std::vector<glm::vec4> image = diffuseOf(field, host);
    EXPECT_LT(hostDifference(image, expected, [](std::size_t) { return true; }), 1e-3);
}

// Its context is gone, or current on another thread: calls say so, and the end is quiet.
TEST_F(LightFieldTest, MayEndWithoutItsContext) {
    std::optional<LightField> field;
    {
        const platform::HeadlessContext own;
        field.emplace();
        field->setScene(scene_);
        field->setSettings(hostSettings());
        field->update();
    }
    std::thread([&] {
        EXPECT_THROW(field->update(), Error);
        EXPECT_THROW(field->setInstance(0, scene_.instances[0]), Error);
        EXPECT_THROW(field->addMesh(scene_.meshes[0]), Error);
        EXPECT_THROW(field->bindLookups(), Error);
        field.reset();
    }).join();
}

TEST_F(LightFieldTest, SaysWhatIsWrong) {
    LightField field;
    const auto refused = [](const char* words, const std::function<void()>& call) {
        try {
            call();
            ADD_FAILURE() << "not refused: " << words;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    HostSurfaces surfaces;
    refused("setScene before it", [&] { field.update(); });
    field.setScene(scene_);
    const int view = field.addView();
    refused("update before it", [&] { field.gather(view, surfaces); });
    field.setSettings(hostSettings());
    field.update();
    refused("no view 7", [&] { field.gather(7, surfaces); });
    EXPECT_EQ(field.gather(view, surfaces).diffuse, 0u);  // 0 x 0: a window that is minimised
    surfaces.width = surfaces.height = -1;
    refused("surfaces of -1 x -1", [&] { field.gather(view, surfaces); });
    HostPicture host(scene_, lens());
    drawn(host);
    refused("reduction of 5", [&] { field.gather(view, host.surfaces(), {.reduction = 5}); });
    surfaces = host.surfaces();
    surfaces.normal = 0;
    refused("no texture of normal", [&] { field.gather(view, surfaces); });
    surfaces = host.surfaces();
    surfaces.clipFromView = glm::mat4(0);
    refused("sees no space", [&] { field.gather(view, surfaces); });
    surfaces.clipFromView[0][0] = NAN;
    refused("sees no space", [&] { field.gather(view, surfaces); });
    refused("budget", [&] { field.update({.updates = -1}); });
    field.removeView(view);
    refused("no view", [&] { field.gather(view, host.surfaces()); });
    refused("no view", [&] { field.removeView(view); });
}

}  // namespace
}  // namespace conelight::test
