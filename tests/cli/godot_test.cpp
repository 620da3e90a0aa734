// SPDX-License-Identifier: MIT
// Light maps in Godot 3: the script of examples/godot draws the Cornell box from baked files on a screen without a
// monitor, and its picture is the path tracer's. Skipped without the engine (Debian: godot3) or Xvfb.
// CONELIGHT_SCREENSHOTS=DIR keeps the picture.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "io/image_file.h"
#include "io/scene_file.h"
#include "reference/metrics.h"
#include "reference/path_tracer.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 120;

void writeText(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

// Looks through the scene's camera, and keeps the picture after some frames.
std::string shotScript(const Camera& camera) {
    return fmt::format(R"(extends SceneTree
func _init():
    var shown = Spatial.new()
    shown.set_script(load("res://light_maps.gd"))
    get_root().add_child(shown)
    var camera = Camera.new()
    get_root().add_child(camera)
    camera.look_at_from_position(Vector3({}, {}, {}), Vector3({}, {}, {}), Vector3(0, 1, 0))
    camera.fov = {}
    camera.current = true
    for i in 8:
        yield(self, "idle_frame")
    var image = get_root().get_texture().get_data()
    image.flip_y()
    image.save_png("shot.png")
    OS.kill(OS.get_process_id())
)",
                       camera.eye.x, camera.eye.y, camera.eye.z, camera.target.x, camera.target.y,
                       camera.target.z, glm::degrees(camera.fovY));
}

// A project with what was baked, imported.
void makeProject(const std::string& folder, const Camera& camera) {
    const CommandResult baked =
        conelight("bake builtin:cornell --lightmaps --direct --samples 256 --no-check --texel 0.04 -o '" +
                  folder + "'");
    ASSERT_EQ(baked.status, 0) << baked.output;
    for (const char* name : {"lightmap_0.exr", "lightmap_0.png"}) fs::remove(folder + "/" + name);
    fs::copy_file(std::string(CONELIGHT_SOURCE_DIR) + "/examples/godot/light_maps.gd",
                  folder + "/light_maps.gd");
    writeText(folder + "/shot.gd", shotScript(camera));
    writeText(folder + "/project.godot",
              "config_version=4\n[application]\nconfig/name=\"Light maps\"\n[rendering]\n"
              "quality/driver/driver_name=\"GLES3\"\nenvironment/default_clear_color=Color(0, 0, 0, 1)\n");
    // The editor imports what is new. Debian's does not end by itself: it is ended when all is there.
    runCommand("cd '" + folder +
               "'; setsid timeout -s KILL 300 xvfb-run -a godot3 --editor >/dev/null 2>&1 & editor=$!; "
               "for i in $(seq 1200); do [ $(ls .import/*.md5 2>/dev/null | wc -l) -ge 2 ] && break; "
               "kill -0 $editor 2>/dev/null || break; sleep 0.25; done; sleep 1; kill -9 -$editor; wait");
}

TEST(GodotTest, DrawsTheCornellBoxOfThePathTracer) {
    for (const char* program : {"godot3", "xvfb-run", "timeout"})
        if (runCommand(std::string("command -v ") + program).status != 0)
            GTEST_SKIP() << "no " << program << " (Debian: godot3, xvfb)";
    const std::string folder = scratchPath("godot");
    fs::remove_all(folder);
    fs::create_directories(folder);
    const Scene scene = io::loadScene("builtin:cornell");
    makeProject(folder, scene.cameras[0]);
    runCommand("cd '" + folder +
               fmt::format("' && timeout -s KILL 300 xvfb-run -a godot3 --resolution {}x{} -s shot.gd 2>&1",
                           kWidth, kHeight));
    ASSERT_TRUE(fs::exists(folder + "/shot.png"));
    if (const char* keep = std::getenv("CONELIGHT_SCREENSHOTS"))
        fs::copy_file(folder + "/shot.png", std::string(keep) + "/godot.png",
                      fs::copy_options::overwrite_existing);
    const io::FloatImage shot = io::readImage(folder + "/shot.png");
    ASSERT_EQ(shot.width, kWidth);
    ASSERT_EQ(shot.height, kHeight);

    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 256;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras[0], kWidth, kHeight, settings);
    // What is too bright for eight bits is left out, with its edge.
    Image shown = truth.full, wanted = truth.full;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            shown.pixels[i][c] = shot.pixels[static_cast<std::size_t>(shot.channels) * i + std::size_t(c)];
        const glm::vec4 most = glm::max(shown.pixels[i], wanted.pixels[i]);
        if (std::max({most.r, most.g, most.b}) < 0.95f) {
            lit += most.r > 0.01f ? 1 : 0;
            continue;
        }
        shown.pixels[i] = wanted.pixels[i] = glm::vec4(0, 0, 0, 1);
    }
    EXPECT_GT(lit, shown.pixels.size() / 3);
    reference::MetricOptions numbers;
    numbers.flip = false;
    const reference::Metrics metrics = compareImages(shown, wanted, numbers);
    std::cout << "Godot against the path tracer: relRMSE " << 100 * metrics.relRmse << " %, 4x4 blocks "
              << 100 * metrics.blockRelRmse << " %, bias " << 100 * metrics.bias << " %\n";
    EXPECT_LT(metrics.blockRelRmse, 0.06);
    EXPECT_LT(std::abs(metrics.bias), 0.02);
}

}  // namespace
}  // namespace conelight::test
