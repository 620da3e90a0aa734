// SPDX-License-Identifier: MIT
// The smallest use of the library: a scene made by hand -> one picture.
//   example_01_minimal [OUT.png]
// A host with a window uses its own context instead of HeadlessContext. docs/guide/embed.md explains the
// steps.
#include <conelight/error.h>
#include <conelight/renderer.h>

#include <cstdio>

#include "io/image_file.h"
#include "platform/headless_context.h"

namespace {

// [sample]
// A white floor and a red wall under a lamp; an OpenGL 4.5 core context is current.
conelight::Image drawCorner() {
    conelight::Scene scene;
    const auto addQuad = [&](glm::vec3 corner, glm::vec3 u, glm::vec3 v, glm::vec3 albedo) {
        const int index = static_cast<int>(scene.meshes.size());
        conelight::Mesh mesh;
        mesh.positions = {corner, corner + u, corner + u + v, corner + v};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        scene.meshes.push_back(mesh);
        scene.materials.push_back({.baseColor = glm::vec4(albedo, 1)});
        scene.instances.push_back({.mesh = index, .material = index});
    };
    addQuad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, {0.8f, 0.8f, 0.8f});  // metres
    addQuad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, {0.8f, 0.05f, 0.05f});
    scene.lights.push_back({.intensity = glm::vec3(8), .position = {0.3f, 1.5f, 0}});  // W/sr

    conelight::Renderer renderer;
    renderer.setScene(scene);
    renderer.render({.eye = {1.2f, 1.6f, 3}, .target = {0, 0.6f, 0}}, 640, 480, conelight::Settings{});
    return renderer.readImage();  // linear radiance, W/(sr m^2)
}
// [/sample]

}  // namespace

int main(int argc, char** argv) try {
    const char* path = argc > 1 ? argv[1] : "01_minimal.png";
    const conelight::platform::HeadlessContext context;
    const conelight::Image image = drawCorner();
    const conelight::io::ByteImage bytes{image.width, image.height, 3,
                                         conelight::toneMapped(image, conelight::ImageSettings{})};
    conelight::io::writePng(path, bytes);
    std::printf("picture at %s\n", path);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "01_minimal: %s\n", error.what());
    return 1;
}
