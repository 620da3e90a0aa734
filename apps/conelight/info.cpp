// SPDX-License-Identifier: MIT
// `conelight info [SCENE]`: the OpenGL device, or what a scene holds. `conelight info builtin:` lists the
// generated scenes.
#include <epoxy/gl.h>
#include <fmt/core.h>

#include "command.h"
#include "conelight/error.h"
#include "io/generated.h"
#include "io/scene_file.h"
#include "io/scene_info.h"
#include "platform/headless_context.h"

namespace conelight::program {
namespace {

struct InfoOptions {
    std::string scene;
    int device = -1;
};

void printDevice(int device) {
    for (const std::string& line : platform::listDevices()) fmt::print("EGL device {}\n", line);
    platform::HeadlessOptions options;
    options.device = device;
    const platform::HeadlessContext context(options);
    fmt::print("in use: {}\n", context.description());
    const auto limit = [](const char* name, GLenum key, int needed) {
        GLint value = 0;
        glGetIntegerv(key, &value);
        fmt::print("  {:<44} {:>12}  (used: up to {})\n", name, value, needed);
    };
    limit("3D texture edge", GL_MAX_3D_TEXTURE_SIZE, 2048);
    limit("2D texture edge", GL_MAX_TEXTURE_SIZE, 16384);
    limit("storage blocks per compute shader", GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 16);
    limit("texture units", GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 32);
    limit("image units", GL_MAX_IMAGE_UNITS, 8);
    limit("storage block bytes", GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 1 << 27);
    limit("texture buffer texels", GL_MAX_TEXTURE_BUFFER_SIZE, 1 << 26);
    fmt::print("  optional extension GL_ARB_shader_viewport_layer_array: {}\n",
               epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array") ? "used"
                                                                            : "absent (six passes instead)");
}

void run(const InfoOptions& options) {
    if (options.scene.empty()) {
        printDevice(options.device);
    } else if (options.scene == "builtin:" || options.scene == "builtin") {
        for (const io::GeneratedSceneInfo& scene : io::generatedScenes()) {
            fmt::print("builtin:{:<16} {}\n", scene.name, scene.description);
            for (const auto& parameter : scene.parameters)
                fmt::print("    ?{}={:g}  {:g} to {:g}: {}\n", parameter.name, parameter.defaultValue,
                           parameter.min, parameter.max, parameter.meaning);
        }
    } else {
        fmt::print("{}", io::describeScene(io::loadScene(options.scene)));
    }
}

}  // namespace

void addInfo(CLI::App& app) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = app.add_subcommand("info", "the OpenGL device, or what a scene holds");
    command->add_option("scene", options->scene, "a scene file, builtin:NAME, or builtin: for a list");
    command->add_option("--device", options->device, "EGL device")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
