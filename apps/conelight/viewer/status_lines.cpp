// SPDX-License-Identifier: MIT
#include "viewer/status_lines.h"

#include <fmt/core.h>

#include <algorithm>

#include "session/projection.h"

namespace conelight::program {
namespace {

std::string windowText(const platform::Window& window, const Gui& gui) {
    const glm::ivec2 size = window.size(), pixels = window.framebufferSize();
    return fmt::format("{} x {}, {} x {} pixels, scale {:.2f}, {}", size.x, size.y, pixels.x, pixels.y,
                       gui.scale(), window.fullscreen() ? "full screen" : "windowed");
}

std::string pictureText(const PictureView& view, const glm::vec2& at) {
    const glm::ivec2 size = view.pictureSize(), full = view.fullSize();
    return fmt::format("{} x {} of {} x {} pixels, at {:.0f} {:.0f}", size.x, size.y, full.x, full.y, at.x,
                       at.y);
}

std::string splitText(PictureView& view) {
    if (!view.split.on) return "off";
    if (view.split.mode == "kept")
        return fmt::format("kept at {:.3f}{}", view.split.position, view.split.errors ? ", errors" : "");
    PictureSlot& right = view.slot(true);
    return fmt::format("{} at {:.3f}{}, {}, {} x {} pixels", view.split.mode, view.split.position,
                       view.split.errors ? ", errors" : "", right.ownPicture() ? "shown" : "not yet",
                       right.width(), right.height());
}

std::string selectionText(const Session& session) {
    if (const std::size_t count = session.selected().size(); count > 1)
        return fmt::format("{} objects, {} lights", session.selectedOf(SelectionKind::Instance).size(),
                           session.selectedOf(SelectionKind::Light).size());
    const Selection& selection = session.selection();
    const Scene& scene = session.scene();
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

std::string cameraText(const Camera& c) {
    return fmt::format("eye {:.4g} {:.4g} {:.4g} target {:.4g} {:.4g} {:.4g} {}", c.eye.x, c.eye.y, c.eye.z,
                       c.target.x, c.target.y, c.target.z, projectionText(c));
}

std::string pathText(const Session& session) {
    const CameraPath& path = session.cameraPath();
    return fmt::format("{} keys, {:g} s{}", path.keys().size(), path.end() - path.start(),
                       session.playing() ? ", playing" : "");
}

std::string movingText(const PictureView::Movement& m) {
    return fmt::format("{:.1f} frames/s, longest wait {:.0f} ms, {} x {} pixels ({} pictures in {:.1f} s)",
                       m.pictures / std::max(m.seconds, 1e-3), 1e3 * m.longest, m.sizePx.x, m.sizePx.y,
                       m.pictures, m.seconds);
}

std::string pixelText(const std::optional<Inspection>& found) {
    if (!found) return "none";
    const glm::vec4& radiance = found->radiance;
    return fmt::format("{} {} radiance {:.4g} {:.4g} {:.4g} {}", found->pixel.x, found->pixel.y, radiance.x,
                       radiance.y, radiance.z, found->hit ? found->hit->object : "(sky)");
}

}  // namespace

std::vector<std::pair<std::string, std::string>> statusLines(const StatusInputs& in) {
    const PictureSlot& left = in.view.slot(false);
    const FrameTimes& gui = in.timings.gui();
    const Timings::Pauses& pauses = in.timings.pauses();
    return {
        {"scene", in.session.path()},
        {"window", windowText(in.window, in.gui)},
        {"picture", pictureText(in.view, in.panels.layout().pictureAt())},
        {"mode", left.label()},
        {"split", splitText(in.view)},
        {"kept", in.view.kept.text()},
        {"work", in.view.halted()      ? "stopped"
                 : left.work().empty() ? "none"
                                       : left.work()},
        {"settled", in.view.finished() ? "yes" : "no"},
        {"selection", selectionText(in.session)},
        {"camera", cameraText(in.session.camera())},
        {"steps", fmt::format("{} to undo, {} to redo", in.session.undoSteps(), in.session.redoSteps())},
        {"path", pathText(in.session)},
        {"log", fmt::format("{} lines, {} errors", in.console.panel().lines(), in.console.panel().errors())},
        {"hint", in.hint ? *in.hint : "none"},
        {"guides", in.view.guides.text(in.session.camera(), in.panels.layout().pictureSize())},
        {"headlight", in.view.headlight > 0 ? fmt::format("{:.4g} W/m^2", in.view.headlight) : "off"},
        {"turntable", in.view.turntable.turns() ? "turns" : "stands"},
        {"frames",
         fmt::format("{} pictures, {:.1f} ms (median)", left.version(), in.session.frameTimes().median())},
        {"moving", movingText(in.view.movement())},
        {"pauses", fmt::format("longest {:.0f} ms between {} looks for input since the last `status pauses`",
                               pauses.longestMs, pauses.looks)},
        {"gui", fmt::format("{:.3f} ms of CPU a frame (median of {})", gui.median(), gui.all().size())},
        {"first_frame", fmt::format("{:.2f} s after the start", 1e-3 * in.timings.firstPictureMs())},
        {"pixel", pixelText(in.probe.found())}};
}

}  // namespace conelight::program
