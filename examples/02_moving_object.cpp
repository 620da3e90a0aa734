// SPDX-License-Identifier: MIT
// Things that move: a box slides over a floor under a lamp, frame by frame; only what it touches is made
// anew.
//   example_02_moving_object [OUT.png]
// Writes the last frame.
#include <conelight/error.h>
#include <conelight/renderer.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "io/image_file.h"
#include "platform/headless_context.h"

namespace {

// A floor, two walls and a box; instance 3 is the box.
conelight::Scene corner() {
    conelight::Scene scene;
    const auto add = [&](conelight::Mesh mesh, glm::vec3 albedo) {
        const int index = static_cast<int>(scene.meshes.size());
        scene.meshes.push_back(std::move(mesh));
        scene.materials.push_back({.baseColor = glm::vec4(albedo, 1)});
        scene.instances.push_back({.mesh = index, .material = index});
    };
    const auto quad = [](glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
        conelight::Mesh mesh;
        mesh.positions = {corner, corner + u, corner + u + v, corner + v};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        return mesh;
    };
    add(quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), {0.8f, 0.8f, 0.8f});  // metres
    add(quad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}), {0.8f, 0.05f, 0.05f});
    add(quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}), {0.7f, 0.7f, 0.7f});
    conelight::Mesh box;
    for (int i = 0; i < 8; ++i)
        box.positions.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    box.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    add(box, {0.1f, 0.4f, 0.8f});
    scene.lights.push_back({.intensity = glm::vec3(8), .position = {0.3f, 1.8f, 0.2f}});  // W/sr
    return scene;
}

// [sample]
// The box slides from right to left while its lamp dims. An OpenGL 4.5 core context is current.
conelight::Image drawSlide(int frames) {
    const conelight::Camera camera{.eye = {1.2f, 1.6f, 3}, .target = {0, 0.6f, 0}};
    conelight::Renderer renderer;
    renderer.setScene(corner());
    conelight::Instance box = renderer.scene().instances[3];
    conelight::Light lamp = renderer.scene().lights[0];
    for (int frame = 0; frame < frames; ++frame) {
        const float x = 0.6f - 1.2f * static_cast<float>(frame) / static_cast<float>(frames - 1);
        box.worldFromObject = glm::scale(glm::translate(glm::mat4(1), {x, 0.25f, 0}), glm::vec3(0.25f));
        renderer.setInstance(3, box);  // one matrix is uploaded
        lamp.intensity *= 0.95f;
        renderer.setLight(0, lamp);
        renderer.render(camera, 320, 240, conelight::Settings{});  // voxels around the box are made anew
    }
    return renderer.readImage();  // linear radiance, W/(sr m^2)
}
// [/sample]

}  // namespace

int main(int argc, char** argv) try {
    const char* path = argc > 1 ? argv[1] : "02_moving_object.png";
    const conelight::platform::HeadlessContext context;
    const conelight::Image image = drawSlide(5);
    const conelight::io::ByteImage bytes{image.width, image.height, 3,
                                         conelight::toneMapped(image, conelight::ImageSettings{})};
    conelight::io::writePng(path, bytes);
    std::printf("picture at %s\n", path);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "02_moving_object: %s\n", error.what());
    return 1;
}
