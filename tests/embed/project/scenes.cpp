// SPDX-License-Identifier: MIT
// A host program outside the project that reads and writes scenes and pictures, and draws in a context of the library's.
// Input: the name of a folder. Output: a scene and a picture there, exit status 0; else the reason and status 1.
#include <conelight/error.h>
#include <conelight/io/animation.h>
#include <conelight/io/environment_file.h>
#include <conelight/io/image_file.h>
#include <conelight/io/scene_file.h>
#include <conelight/io/scene_write.h>
#include <conelight/platform/headless_context.h>
#include <conelight/renderer.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) try {
    const std::string folder = argc > 1 ? argv[1] : ".";
    const conelight::Scene box = conelight::io::loadScene("builtin:cornell");
    conelight::io::writeScene(folder + "/box.glb", box, true);
    conelight::io::SceneAnimation animation;
    conelight::Scene read = conelight::io::loadAnimatedScene(folder + "/box.glb", {}, animation);
    if (read.triangleCount() != box.triangleCount() || read.cameras.empty()) {
        std::puts("scenes: what was written is not what is read");
        return 1;
    }
    conelight::io::useEnvironment(read, conelight::io::loadEnvironment("builtin:sky"), 0, 1);
    const conelight::platform::HeadlessContext context;
    conelight::Renderer renderer;
    renderer.setScene(read);
    conelight::Settings settings;
    settings.mode = conelight::Mode::Phong;
    renderer.render(read.cameras.front(), 32, 32, settings);
    conelight::io::writePng(folder + "/box.png",
                            {32, 32, 3, conelight::toneMapped(renderer.readImage(), settings.image)});
    // An error that crosses from one library into another.
    try {
        conelight::io::readByteImage(folder + "/nothing.png");
    } catch (const conelight::Error& error) {
        return error.kind() == conelight::ErrorKind::BadInput ? 0 : 1;
    }
    return 1;
} catch (const conelight::Error& error) {
    std::printf("scenes: %s\n", error.what());
    return 1;
}
