// SPDX-License-Identifier: MIT
// Baked light through the GL modes: the radiance at the pixels is that of the vertices, far above and far
// below what 8 bits hold, times the texture.
#include "reference/radiosity.h"

#include <array>
#include <cmath>

#include "conelight/renderer.h"
#include "io/generated.h"
#include "reference/path_tracer.h"
#include "support/gl_fixture.h"
#include "support/truth_rig.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using BakedLightTest = GlTest;

Image drawn(const Scene& scene, const Camera& camera, int size, Mode mode) {
    Settings settings;
    settings.mode = mode;
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(camera, size, size, settings);
    return renderer.readImage();
}

TEST_F(BakedLightTest, VertexLightKeepsItsRange) {
    for (const float scale : {1e-4f, 0.7f, 50.0f, 20000.0f}) {
        const glm::vec3 light = scale * glm::vec3(1, 0.6f, 0.3f);
        Scene scene;
        Mesh mesh = quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
        mesh.colors.assign(mesh.positions.size(), glm::vec4(light, 1));
        Material material;
        material.baseColor = {0.5f, 0.9f, 1, 1};
        material.unlit = true;
        addInstance(scene, mesh, material);
        const Image image = drawn(scene, cameraAbove({0, 0, 0}, 1, 0.5f), 8, Mode::Phong);
        const glm::dvec3 got = meanColorOf(image);
        for (int c = 0; c < 3; ++c)
            // Half a step of 9 bits of the largest channel is at most 0.2 % of it, and of the smallest 0.65
            // %.
            EXPECT_NEAR(got[c] / static_cast<double>(light[c] * material.baseColor[c]), 1,
                        c == 2 ? 0.0065 : 0.005)
                << scale << ", channel " << c;
    }
}

TEST_F(BakedLightTest, LooksTheSameInGlAndOnTheCpu) {
    Scene scene = io::generateScene("cornell");
    // Off the axis: no pixel's centre lies exactly on an edge between walls, where either wall is right.
    scene.cameras[0].eye.x += 0.003f;
    reference::RadiositySettings quick;
    quick.patchRays = quick.gatherRays = 32;
    quick.maxSubdivision = 0;
    const Scene lit = reference::bakeRadiosity(scene, quick);
    reference::PathTracerSettings few;
    few.samplesPerPixel = 2;
    const Image cpu = reference::PathTracer(lit).render(scene.cameras[0], 96, 96, few).full;
    const Image gl = drawn(lit, scene.cameras[0], 96, Mode::Phong);
    EXPECT_NEAR(meanOf(gl) / meanOf(cpu), 1, 0.002);
    // Silhouettes may fall on either side of a pixel's centre.
    std::size_t off = 0;
    for (std::size_t i = 0; i < gl.pixels.size(); ++i) {
        const glm::vec3 a(gl.pixels[i]), b(cpu.pixels[i]);
        off += glm::length(a - b) > 0.005f * (glm::length(b) + 0.01f) ? 1 : 0;
    }
    EXPECT_LT(off, gl.pixels.size() / 200);
}

}  // namespace
}  // namespace conelight::test
