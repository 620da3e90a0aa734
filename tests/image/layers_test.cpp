// SPDX-License-Identifier: MIT
// Coat and sheen in the GL modes against the path tracer: what coats mirror, highlights, layers over bent normals and
// behind other things, sheen under lamps and in gathered light, textures, and scenes without layers.
#include <glm/gtc/matrix_transform.hpp>

#include "io/generated.h"
#include "support/scenes.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class LayersTest : public TracedModeTest {
  protected:
    // A lit room with a ball in front of a wall of another colour.
    static Scene room(const Material& ball, bool lamp) {
        Scene scene = closedBox(diffuseMaterial(glm::vec3(0.6f)));
        scene.materials[static_cast<std::size_t>(scene.instances[0].material)].baseColor = {0.7f, 0.1f, 0.1f,
                                                                                            1};
        scene.materials[static_cast<std::size_t>(scene.instances[1].material)].baseColor = {0.1f, 0.2f, 0.7f,
                                                                                            1};
        addInstance(scene, sphereMesh(48, 24), ball,
                    glm::scale(glm::translate(glm::mat4(1), {0, -0.3f, 0}), glm::vec3(0.35f)));
        Light light;
        if (lamp) {
            light.type = LightType::Rect;
            light.position = {0, 0.99f, 0};
            light.direction = {0, -1, 0};
            light.halfU = {0.3f, 0, 0};
            light.halfV = {0, 0, 0.3f};
            light.intensity = glm::vec3(5);
        } else {
            light.position = {0.5f, 0.7f, 0.5f};
        }
        scene.lights.push_back(light);
        Camera& camera = scene.cameras.at(0);
        camera.eye = {0, -0.2f, 0.95f};
        camera.target = {0, -0.3f, 0};
        camera.fovY = 1.1f;
        return scene;
    }
    static reference::PathTracedPicture truthOf(const Scene& scene, int samples = 512) {
        reference::PathTracerSettings path;
        path.samplesPerPixel = samples;
        return reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, path);
    }
};

Light sunAbove() {
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = {0, -1, 0};
    return sun;
}

Material lacquer(float coatRoughness) {
    Material m = diffuseMaterial(glm::vec3(0.05f));
    m.specular = 0;
    m.coat = 1;
    m.coatRoughness = coatRoughness;
    return m;
}

Material velvet(float roughness) {
    Material m = diffuseMaterial({0.1f, 0.02f, 0.05f});
    m.specular = 0;
    m.sheenColor = {0.8f, 0.5f, 0.6f};
    m.sheenRoughness = roughness;
    return m;
}

// What is left is a fraction of what they are.
TEST_F(LayersTest, CoatsAndSheenAreTheTruth) {
    struct Case {
        Material ball;
        bool lamp;
    };
    for (const Case& one : {Case{lacquer(0), true}, Case{lacquer(0.3f), true}, Case{lacquer(0.3f), false},
                            Case{velvet(0.4f), true}, Case{velvet(0.9f), false}}) {
        const Scene scene = room(one.ball, one.lamp);
        const reference::PathTracedPicture truth = truthOf(scene, 256);
        const Image image = draw(scene, tracedSettings(Quality::Interactive));
        Scene bare = scene;
        bare.materials.back().coat = 0;
        bare.materials.back().sheenColor = glm::vec3(0);
        const double error = relRmse(image, truth.full);
        const double without = relRmse(draw(bare, tracedSettings(Quality::Interactive)), truth.full);
        const std::string what = std::string(one.lamp ? "lamp" : "point") + " coat " +
                                 std::to_string(one.ball.coatRoughness) + " sheen " +
                                 std::to_string(one.ball.sheenRoughness);
        RecordProperty(what, std::to_string(error));
        EXPECT_LT(error, 0.13) << what;  // 0.07 to 0.115, most of it the room's
        EXPECT_GT(without, 1.5 * error) << what;
        EXPECT_NEAR(meanOf(image) / meanOf(truth.full), 1, 0.02) << what;
    }
}

// Layers change nothing but the pixels that show them.
TEST_F(LayersTest, LayersBehindOthersAndOtherSurfacesShowNothingOfThem) {
    Scene scene = room(lacquer(0.1f), true);
    addInstance(scene, quadMesh({-0.04f, -0.9f, 0.6f}, {0.08f, 0, 0}, {0, 1.2f, 0}), diffuseMaterial());
    scene.materials.back().doubleSided = true;
    Scene plain = scene;
    for (Material& m : plain.materials) m.coat = 0;
    Settings settings = tracedSettings(Quality::Draft, Component::Direct);
    const Image with = draw(scene, settings), without = draw(plain, settings);
    int differ = 0;
    for (int y = 0; y < kTracedPixels; ++y)
        for (int x = 0; x < kTracedPixels; ++x) {
            const auto i = static_cast<std::size_t>(y * kTracedPixels + x);
            const bool other = with.pixels[i] != without.pixels[i];
            differ += other ? 1 : 0;
            // The board hides the middle of the ball.
            const bool unlayered = (x >= 20 && x < 28 && y >= 20 && y < 40) || y < 4;
            EXPECT_FALSE(other && unlayered) << x << " " << y;
        }
    EXPECT_GT(differ, 20);
}

// The base's map bends the base alone; one of the coat bends the coat.
TEST_F(LayersTest, CoatsHaveNormalsOfTheirOwn) {
    Texture leaning;
    leaning.width = leaning.height = 1;
    leaning.srgb = false;
    leaning.rgba = {190, 128, 238, 255};
    for (const bool ofCoat : {false, true}) {
        Scene scene;
        Material m = lacquer(0.25f);
        m.baseColor = {0, 0, 0, 1};
        (ofCoat ? m.coatNormalTexture : m.normalTexture).texture = 0;
        Mesh ground = groundMesh(2);
        ground.uvs.assign(4, {0.5f, 0.5f});
        ground.tangents.assign(4, {1, 0, 0, 1});
        scene.textures.push_back(leaning);
        addInstance(scene, std::move(ground), m);
        scene.lights.push_back(sunAbove());
        scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 0.1f));
        const Image image = draw(scene, tracedSettings(Quality::Draft, Component::Direct));
        const reference::PathTracedPicture truth = truthOf(scene, 4);
        EXPECT_NEAR(meanOf(image) / meanOf(truth.direct), 1, 0.02) << ofCoat;
        // Seen and lit from above, a coat that lies flat shines; one that leans by half a radian does not.
        EXPECT_EQ(meanOf(image) > 0.1, !ofCoat);
    }
}

TEST_F(LayersTest, TexturesOfLayersCount) {
    Scene scene;
    Texture halves;
    halves.width = 2;
    halves.height = 1;
    halves.srgb = false;
    halves.filter = TextureFilter::Nearest;
    halves.rgba = {255, 255, 255, 255, 0, 255, 255, 255};
    scene.textures.push_back(halves);
    Material m = lacquer(0.25f);
    m.baseColor = {0, 0, 0, 1};
    m.coatTexture.texture = 0;
    Mesh ground = groundMesh(2);
    ground.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    addInstance(scene, std::move(ground), m);
    scene.lights.push_back(sunAbove());
    scene.cameras.push_back(cameraAbove({0, 0, 0}, 2, 0.5f));
    const Image image = draw(scene, tracedSettings(Quality::Draft, Component::Direct));
    const auto columns = [&](int from, int to) {
        double sum = 0;
        for (int y = 0; y < kTracedPixels; ++y)
            for (int x = from; x < to; ++x)
                sum += static_cast<double>(image.pixels[static_cast<std::size_t>(y * kTracedPixels + x)].r);
        return sum;
    };
    EXPECT_GT(std::max(columns(0, 20), columns(28, 48)), 1);
    EXPECT_EQ(std::min(columns(0, 20), columns(28, 48)), 0);
}

// In mode cones, too, a coat mirrors the room and sheen is lit by it.
TEST_F(LayersTest, ConesShowLayers) {
    for (const Material& ball : {lacquer(0.3f), velvet(0.6f)}) {
        const Scene scene = room(ball, true);
        const reference::PathTracedPicture truth = truthOf(scene, 256);
        Settings settings = tracedSettings(Quality::Interactive);
        settings.mode = Mode::Cones;
        settings.voxels.size = 64;
        const double error = relRmse(draw(scene, settings), truth.full);
        Scene bare = scene;
        for (Material& m : bare.materials) {
            m.coat = 0;
            m.sheenColor = glm::vec3(0);
        }
        RecordProperty("error", std::to_string(error));
        EXPECT_LT(error, 0.25);
        EXPECT_LT(error, relRmse(draw(bare, settings), truth.full));
    }
}

}  // namespace
}  // namespace conelight::test
