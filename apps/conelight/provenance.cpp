// SPDX-License-Identifier: MIT
#include "provenance.h"

#include <fmt/core.h>

#include <glm/trigonometric.hpp>

#include "command_line.h"
#include "conelight/version.h"
#include "conelight_commit.h"
#include "session/preset.h"

namespace conelight::program {
namespace {

std::string textOf(const glm::vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

std::string settingsText(const PictureRequest& request) {
    std::string text;
    Settings settings = request.settings;
    if (request.mode == "traced" && settings.image.antialiasing == 0)
        settings.image.antialiasing = request.tracedViews;
    for (const auto& [key, value] : differences(Settings{}, settings)) {
        if (key == "mode") continue;
        text += (text.empty() ? "" : " ") + shellWord(key + "=" + value);
    }
    return text;
}

}  // namespace

std::string sceneOptionsOf(const ViewOptions& view) {
    std::string text;
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : " ") + words; };
    if (!view.sky.empty()) add("--sky " + shellWord(view.sky));
    if (!view.environment.empty()) {
        add("--environment " + shellWord(view.environment));
        if (view.rotateDeg != 0) add(fmt::format("--rotate {}", view.rotateDeg));
        if (view.environmentStrength != 1)
            add(fmt::format("--environment-strength {}", view.environmentStrength));
        if (view.splitsSun) add("--split-sun");
    }
    if (view.noGround) add("--no-ground");
    if (view.up != io::UpAxis::Auto) add("--up " + wordOf(view.up));
    return text;
}

std::string commandsOf(const ScriptOptions& script) {
    std::string text;
    for (const std::string& file : script.files)
        text += (text.empty() ? "" : "; ") + ("script " + shellWord(file));
    for (const std::string& command : script.commands) text += (text.empty() ? "" : "; ") + command;
    return text;
}

std::string softwareName() {
    const std::string name = std::string("Conelight ") + CONELIGHT_VERSION_STRING;
    const std::string commit = CONELIGHT_COMMIT;
    return commit.empty() ? name : name + " (" + commit + ")";
}

namespace {

std::string lensText(const Camera& camera) {
    if (camera.isOrthographic()) return fmt::format(" --orthographic {}", camera.orthographicHeight);
    if (!camera.hasLens()) return {};
    return fmt::format(" --lens {} --focus {}", camera.lensDiameter, camera.focus());
}

}  // namespace

PictureTexts provenanceOf(const PictureRequest& request, const std::string& scene,
                          const std::string& device) {
    const Camera& camera = request.camera;
    PictureTexts texts = {
        {"Software", softwareName()},
        {"Scene", scene},
        {"Mode", request.mode},
        {"Camera", fmt::format("--eye {} --target {} --fov {}{}", textOf(camera.eye), textOf(camera.target),
                               glm::degrees(camera.fovY), lensText(camera))},
        {"Size", fmt::format("{}x{}", request.size.width, request.size.height)},
    };
    if (const std::string settings = settingsText(request); !settings.empty())
        texts.emplace_back("Settings", settings);
    if (!request.sceneOptions.empty()) texts.emplace_back("Options", request.sceneOptions);
    if (!request.commands.empty()) texts.emplace_back("Commands", request.commands);
    if (request.mode == "reference" && request.reference.samplesPerPixel > 0) {
        texts.emplace_back("Samples", std::to_string(request.reference.samplesPerPixel));
        texts.emplace_back("Seed", std::to_string(request.reference.seed));
        if (request.denoiser != reference::Denoiser::None)
            texts.emplace_back("Denoiser", request.denoiser == reference::Denoiser::Own ? "own" : "oidn");
    } else if (request.mode == "radiosity") {
        texts.emplace_back("Seed", std::to_string(request.radiosity.seed));
    }
    if (!isRendererMode(request.mode))
        texts.emplace_back("Device", "CPU");
    else if (!device.empty())
        texts.emplace_back("Device", device);
    return texts;
}

}  // namespace conelight::program
