// SPDX-License-Identifier: MIT
// Commands that are the window's own (console/commands_window.cpp), and what it answers.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "viewer/viewer_window.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

bool switched(const std::vector<std::string>& words, bool now) {
    return words.size() > 1 ? words[1] == "on" : !now;
}

}  // namespace

void Viewer::windowCommand(const Request& request) {
    const std::vector<std::string>& words = request.words;
    const std::string& name = words.front();
    if (name == "split") {
        splitCommand(words);
    } else if (name == "error") {
        view_.split.errors = switched(words, view_.split.errors);
        if (view_.split.errors) view_.split.on = true;
        if (words.size() > 2) view_.split.errorScale = std::strtof(words[2].c_str(), nullptr);
    } else if (name == "fullscreen") {
        window_.setFullscreen(switched(words, window_.fullscreen()));
    } else if (name == "panels") {
        showSide_ = showConsole_ = switched(words, showSide_);
    } else if (name == "focus") {
        focus();
    } else if (name == "pick") {
        inspect({{std::strtof(words[1].c_str(), nullptr), std::strtof(words[2].c_str(), nullptr)}});
    } else if (name == "resolution") {
        if (words.size() > 1) view_.resolutionScale = std::strtof(words[1].c_str(), nullptr);
        print({false, fmt::format("resolution: {:g}", view_.resolutionScale)});
    } else if (name == "ui_scale") {
        if (words.size() > 1) gui_.setScale(std::strtof(words[1].c_str(), nullptr));
    } else if (name == "settle") {
        settling_ = true;
    } else if (name == "stop") {
        stopWaiting();
    } else if (name == "status") {
        status(words.size() > 1 ? words[1] : "");
    } else if (name == "screenshot_window") {
        windowShot_ = words[1];
    } else if (name == "where") {
        std::string widget = words[1];
        for (std::size_t i = 2; i < words.size(); ++i) widget += " " + words[i];
        wanted_.push_back(widget);
        askForPlaces();
        placesAsked_ = true;
    }
}

void Viewer::splitCommand(const std::vector<std::string>& words) {
    if (words.size() == 1) {
        view_.split.on = !view_.split.on;
        return;
    }
    view_.split.on = words[1] != "off";
    if (view_.split.on) view_.split.mode = words[1];
    if (words.size() > 2) view_.split.position = std::strtof(words[2].c_str(), nullptr);
}

void Viewer::answerPlaces() {
    if (!placesRecorded_) return;
    placesRecorded_ = false;
    for (const std::string& name : std::exchange(wanted_, {})) {
        if (const std::optional<WidgetPlace> place = placeOf(name))
            print(
                {false, fmt::format("where {}: {:.0f} {:.0f} {:.0f} {:.0f}", name, place->low.x, place->low.y,
                                    place->high.x - place->low.x, place->high.y - place->low.y)});
        else
            fail(fmt::format("where: '{}' is not on the screen", name));
    }
}

std::string Viewer::splitText() {
    if (!view_.split.on) return "off";
    PictureSlot& right = view_.slot(true);
    return fmt::format("{} at {:.3f}{}, {}, {} x {} pixels", view_.split.mode, view_.split.position,
                       view_.split.errors ? ", errors" : "", right.ownPicture() ? "shown" : "not yet",
                       right.width(), right.height());
}

std::string Viewer::pathText() const {
    const CameraPath& path = session_.cameraPath();
    return fmt::format("{} keys, {:g} s{}", path.keys().size(), path.end() - path.start(),
                       session_.playing() ? ", playing" : "");
}

std::string Viewer::movingText() const {
    const PictureView::Movement& m = view_.movement();
    return fmt::format("{:.1f} frames/s, longest wait {:.0f} ms, {} x {} pixels ({} pictures in {:.1f} s)",
                       m.pictures / std::max(m.seconds, 1e-3), 1e3 * m.longest, m.sizePx.x, m.sizePx.y,
                       m.pictures, m.seconds);
}

std::string Viewer::selectionText() const {
    const Selection& selection = session_.selection();
    const Scene& scene = session_.scene();
    if (selection.kind == SelectionKind::Instance) {
        const Instance& instance = scene.instances[selection.index];
        const glm::mat4& m = instance.worldFromObject;
        return fmt::format("object {} {} at {:.4f} {:.4f} {:.4f}, x axis {:.4f} {:.4f} {:.4f}",
                           selection.index, instance.name, m[3].x, m[3].y, m[3].z, m[0].x, m[0].y, m[0].z);
    }
    if (selection.kind == SelectionKind::Light) return fmt::format("light {}", selection.index);
    if (selection.kind == SelectionKind::Material)
        return fmt::format("material {} {}", selection.index, scene.materials[selection.index].name);
    return "none";
}

void Viewer::status(const std::string& key) {
    const glm::ivec2 window = window_.size(), pixels = window_.framebufferSize();
    const Layout places = layout();
    const Camera& c = session_.camera();
    std::vector<std::pair<std::string, std::string>> lines = {
        {"scene", session_.path()},
        {"window", fmt::format("{} x {}, {} x {} pixels, scale {:.2f}, {}", window.x, window.y, pixels.x,
                               pixels.y, gui_.scale(), window_.fullscreen() ? "full screen" : "windowed")},
        {"picture",
         fmt::format("{} x {} of {} x {} pixels, at {:.0f} {:.0f}", view_.pictureSize().x,
                     view_.pictureSize().y, view_.fullSize().x, view_.fullSize().y, places.left, places.top)},
        {"mode", view_.slot(false).label()},
        {"split", splitText()},
        {"settled", view_.finished() ? "yes" : "no"},
        {"selection", selectionText()},
        {"camera", fmt::format("eye {:.4g} {:.4g} {:.4g} target {:.4g} {:.4g} {:.4g} fov {:.4g} deg", c.eye.x,
                               c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z, glm::degrees(c.fovY))},
        {"steps", fmt::format("{} to undo, {} to redo", session_.undoSteps(), session_.redoSteps())},
        {"path", pathText()},
        {"log", fmt::format("{} lines, {} errors", console_.lines(), console_.errors())},
        {"hint", hint_ ? *hint_ : "none"},
        {"frames", fmt::format("{} pictures, {:.1f} ms (median)", view_.slot(false).version(),
                               median(session_.frameTimes()))},
        {"moving", movingText()},
        {"gui",
         fmt::format("{:.3f} ms of CPU a frame (median of {})", median(guiTimes_), guiTimes_.all().size())},
        {"first_frame", fmt::format("{:.2f} s after the start", 1e-3 * firstFrameMs_)}};
    if (inspection_) {
        const Inspection& i = *inspection_;
        lines.emplace_back(
            "pixel", fmt::format("{} {} radiance {:.4g} {:.4g} {:.4g} {}", i.pixel.x, i.pixel.y, i.radiance.x,
                                 i.radiance.y, i.radiance.z, i.hit ? i.hit->object : "(sky)"));
    } else {
        lines.emplace_back("pixel", "none");
    }
    for (const auto& [name, text] : lines)
        if (key.empty() || key == name) print({false, "status " + name + ": " + text});
}

}  // namespace conelight::program
