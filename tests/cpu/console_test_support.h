// SPDX-License-Identifier: MIT
// A console on a small scene: two unit cubes in front of each other, a lamp, a camera; mode thesis.
#pragma once

#include <fmt/core.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "conelight/thesis/settings.h"
#include "console/console.h"
#include "thesis/format/scene.h"

namespace conelight::test {

inline Scene consoleScene() {
    Scene scene;
    scene.name = "boxes";
    scene.meshes.push_back(thesis::thesisCube());
    scene.materials.resize(2);
    scene.materials[0].name = "white";
    setPbrFromPhong(scene.materials[0], scene.materials[0].phong.emplace());
    scene.materials[1].name = "blue";
    scene.materials[1].baseColor = {0.1f, 0.2f, 0.9f, 1};
    scene.instances.push_back({"box", 0, 0});
    scene.instances.push_back({"lid", 0, 1, glm::translate(glm::mat4(1), {0, 0, -2})});
    scene.lights.emplace_back();
    scene.lights[0].name = "lamp";
    scene.lights[0].position = {0, 2, 2};
    scene.cameras.push_back(Camera{"main"});
    return scene;
}

struct ConsoleRig {
    program::Session session;
    std::vector<program::ConsoleLine> lines;
    program::Console console;

    ConsoleRig()
        : session(consoleScene(), "boxes.txt", settings(), "", Camera{"main"}),
          console(session, [this](const program::ConsoleLine& line) { lines.push_back(line); }) {}
    ConsoleRig(const ConsoleRig&) = delete;

    static Settings settings() {
        Settings start;
        start.mode = thesis::kMode;
        return start;
    }
    void run(const std::string& text) {
        console.submit(text);
        console.runQueued();
    }
    std::string error() const {
        for (const program::ConsoleLine& line : lines)
            if (line.isError) return line.text;
        return {};
    }
};

}  // namespace conelight::test
