// SPDX-License-Identifier: MIT
// Direct light of mode cones against the path tracer's, same scene and camera (docs/design: bias within 1 %,
// relRMSE away from shadow edges within 2 %). Two independent ways to the same picture: shadow maps and
// closed forms there, rays and random numbers here; units, materials, falloffs and cameras must agree for it.
#include <algorithm>
#include <cmath>

#include "conelight/renderer.h"
#include "io/generated.h"
#include "io/scene_file.h"
#include "reference/path_tracer.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

struct Difference {
    double bias = 0;     // over all pixels
    double whole = 0;    // relRMSE over all pixels
    double relRmse = 0;  // over pixels away from edges
    double kept = 0;     // share of those
};

// Whether no pixel within two steps of (x, y) differs by more than a third. Shadow maps are filtered, and
// textures in GL as well.
bool isAwayFromEdges(const Image& image, int x, int y) {
    float low = 1e30f, high = 0;
    for (int v = std::max(y - 2, 0); v <= std::min(y + 2, image.height - 1); ++v)
        for (int u = std::max(x - 2, 0); u <= std::min(x + 2, image.width - 1); ++u) {
            const float g = image.pixels[static_cast<std::size_t>(v * image.width + u)].g;
            low = std::min(low, g);
            high = std::max(high, g);
        }
    return high <= 1.33f * low;
}

Difference difference(const Image& gl, const Image& truth) {
    Difference d;
    double squares = 0, kept = 0, keptSum = 0;
    d.whole = relRmse(gl, truth);
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            if (!isAwayFromEdges(truth, x, y) || !isAwayFromEdges(gl, x, y)) continue;
            const auto i = static_cast<std::size_t>(y * truth.width + x);
            const glm::dvec3 error = glm::dvec3(gl.pixels[i]) - glm::dvec3(truth.pixels[i]);
            squares += glm::dot(error, error) / 3;
            keptSum += static_cast<double>(truth.pixels[i].r + truth.pixels[i].g + truth.pixels[i].b) / 3;
            kept += 1;
        }
    d.bias = meanOf(gl) / meanOf(truth) - 1;
    d.kept = kept / static_cast<double>(truth.pixels.size());
    d.relRmse = std::sqrt(squares / kept) / (keptSum / kept);
    return d;
}

class PathTracerDirectTest : public GlTest {
  protected:
    Difference compare(const Scene& scene, const Camera& camera, int samples, int shadowSize = 2048,
                       int pixels = 96) {
        Settings settings;
        settings.mode = Mode::Cones;
        settings.component = Component::Direct;
        settings.voxels.size = 32;  // not looked at by direct light
        settings.light.shadowSize = shadowSize;
        Renderer renderer;
        renderer.setScene(scene);
        renderer.render(camera, pixels, pixels, settings);
        const Image image = renderer.readImage();
        reference::PathTracerSettings truth;
        truth.samplesPerPixel = samples;
        truth.bounces = 0;
        const reference::PathTracedPicture picture =
            reference::PathTracer(scene).render(camera, pixels, pixels, truth);
        return difference(image, picture.direct);
    }
};

void expectSame(const Difference& d, double kept) {
    EXPECT_LT(std::abs(d.bias), 0.01);
    EXPECT_LT(d.relRmse, 0.02);
    EXPECT_GT(d.kept, kept);
}

TEST_F(PathTracerDirectTest, GeneratedScenes) {
    struct Case {
        const char* spec;
        int samples;
    };
    for (const Case& c : {Case{"cornell-point", 2}, Case{"cornell", 128}, Case{"leak", 2}, Case{"sunroom", 2},
                          Case{"glossy", 128}, Case{"spheres", 128}}) {
        SCOPED_TRACE(c.spec);
        const Scene scene = io::generateScene(c.spec);
        expectSame(compare(scene, scene.cameras.at(0), c.samples), 0.2);
    }
}

// At default settings, shadow edges included: outlines are those of the triangles that cast them. In the
// sunroom `whole` was 26 % with outlines as coarse as the map's texels, and 73 % with a filter over them. The
// atrium has mouldings and leaves smaller than a texel, whose foot the light must not pass.
TEST_F(PathTracerDirectTest, SunAtDefaultSettings) {
    const int size = LightSettings{}.shadowSize;
    const Scene room = io::generateScene("sunroom");
    // So many pixels that none tells alone: one at the sun's edge is thirty times as bright as the mean.
    const Difference inRoom = compare(room, room.cameras.at(0), 2, size, 384);
    expectSame(inRoom, 0.2);
    EXPECT_LT(inRoom.whole, 0.15);
    const Scene atrium = io::generateScene("atrium?triangles=50000");
    const Difference inAtrium = compare(atrium, atrium.cameras.at(0), 2, size);
    EXPECT_LT(std::abs(inAtrium.bias), 0.01);
    EXPECT_LT(inAtrium.relRmse, 0.02);
    EXPECT_GT(inAtrium.kept, 0.05);
    EXPECT_LT(inAtrium.whole, 0.4);
    RecordProperty("room", std::to_string(inRoom.whole));
    RecordProperty("atrium", std::to_string(inAtrium.whole));
}

// Spots with soft edges, a narrow and a wide one (which GL gives the six maps of a point light), one with
// glTF's range, one with the thesis's falloff.
TEST_F(PathTracerDirectTest, Spots) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.7f, 0.5f, 0.3f)));
    scene.materials[3].specular = 1;
    scene.materials[3].roughness = 0.5f;
    glm::mat4 place(0.3f);
    place[3] = {0, -0.5f, -0.3f, 1};
    scene.instances.push_back(scene.instances[0]);
    scene.meshes.push_back(sphereMesh(48, 24));
    scene.instances.back().mesh = static_cast<int>(scene.meshes.size()) - 1;
    scene.instances.back().worldFromObject = place;
    const float kinds[4][2] = {{0.1f, 0.5f}, {0.2f, 0.9f}, {0.5f, 1.3f}, {0, 0.7f}};
    for (int i = 0; i < 4; ++i) {
        Light light;
        light.type = LightType::Spot;
        light.position = {0.5f * static_cast<float>(i) - 0.75f, 0.9f, 0.2f};
        light.direction = glm::normalize(glm::vec3(0.2f - 0.1f * static_cast<float>(i), -1, -0.3f));
        light.innerAngle = kinds[i][0];
        light.outerAngle = kinds[i][1];
        light.intensity = glm::vec3(2);
        light.range = i == 1 ? 3.0f : 0.0f;
        light.customFalloff = i == 3;
        scene.lights.push_back(light);
    }
    expectSame(compare(scene, scene.cameras.at(0), 2), 0.2);
}

// The thesis's own scene: intensities of pi * colour, the constant-linear-quadratic falloff, Phong materials
// mapped.
TEST_F(PathTracerDirectTest, TheThesisScene) {
    const std::optional<std::string> file = testData("vxct/scenes/scene.txt");
    if (!file) GTEST_SKIP() << "no vxct/scenes/scene.txt in the test data";
    const Scene scene = io::loadScene(*file);
    // Half its camera's angle, so that the statue's thin shadows are wider than a pixel.
    Camera camera = scene.cameras.at(0);
    camera.fovY *= 0.5f;
    expectSame(compare(scene, camera, 2), 0.2);
}

}  // namespace
}  // namespace conelight::test
