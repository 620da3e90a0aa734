// SPDX-License-Identifier: MIT
// Indirect light for a renderer of one's own: this one draws depth, normals and colours with its own shaders,
// asks a LightField what arrives at each pixel, and shades. A box rises while frames pass.
//   example_04_light_field [OUT.png]
// Writes the last frame: to the left without, to the right with indirect light.
#include <conelight/error.h>
#include <conelight/light_field.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "host_renderer.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "platform/headless_context.h"

namespace {

constexpr int kWidth = 320, kHeight = 240;

std::vector<glm::vec4> drawFrames(int frames) {
    conelight::Scene scene = conelight::io::loadScene("builtin:cornell-point");
    const conelight::Camera& camera = scene.cameras[0];
    const Host host(kWidth, kHeight);

    // [load]
    conelight::LightField field;
    field.setScene(scene);
    const int view = field.addView();
    conelight::HostSurfaces surfaces{.width = kWidth, .height = kHeight};
    surfaces.viewFromWorld = glm::lookAt(camera.eye, camera.target, camera.up);
    surfaces.clipFromView = glm::perspective(camera.fovY, float(kWidth) / float(kHeight), 0.05f, 20.0f);
    surfaces.depth = host.depth;
    surfaces.normal = host.normal;
    // [/load]
    const glm::mat4 clipFromWorld = surfaces.clipFromView * surfaces.viewFromWorld;
    const std::size_t box = scene.instances.size() - 1;
    for (int frame = 0; frame < frames; ++frame) {
        // [frame]
        scene.instances[box].worldFromObject[3].y += 0.004f;
        field.setInstance(box, scene.instances[box]);
        field.update({.updates = 2});  // of the light of all voxel faces
        host.drawSurfaces(scene, clipFromWorld);
        const conelight::GatheredLight light = field.gather(view, surfaces);  // a pass of rays
        host.drawPicture(scene.lights[0], clipFromWorld, light.diffuse);      // albedo * (direct + diffuse)
        // [/frame]
    }
    std::vector<glm::vec4> pixels(std::size_t(kWidth * kHeight));
    glGetTextureImage(host.picture, 0, GL_RGBA, GL_FLOAT, GLsizei(16 * pixels.size()), pixels.data());
    return pixels;
}

}  // namespace

int main(int argc, char** argv) try {
    const char* path = argc > 1 ? argv[1] : "04_light_field.png";
    const conelight::platform::HeadlessContext context;
    const std::vector<glm::vec4> pixels = drawFrames(24);
    conelight::Image image{kWidth, kHeight, {}};
    for (int y = kHeight - 1; y >= 0; --y)
        image.pixels.insert(image.pixels.end(), pixels.begin() + y * kWidth,
                            pixels.begin() + (y + 1) * kWidth);
    conelight::io::writePng(path, {kWidth, kHeight, 3, conelight::toneMapped(image, {})});
    std::printf("picture at %s\n", path);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "04_light_field: %s\n", error.what());
    return 1;
}
