// SPDX-License-Identifier: MIT
#include "hour_of_day.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>

#include "io/environment_file.h"
#include "io/generated.h"
#include "io/generated_surroundings.h"

namespace conelight::program {
namespace {

// Whether `spec` is "builtin:NAME" of one that has an hour.
bool hasHour(std::string_view spec, std::span<const io::GeneratedSceneInfo> known) {
    if (spec.substr(0, io::kBuiltin.size()) != io::kBuiltin) return false;
    spec.remove_prefix(io::kBuiltin.size());
    const std::string_view name = spec.substr(0, spec.find('?'));
    return std::any_of(known.begin(), known.end(), [&](const io::GeneratedSceneInfo& info) {
        return info.name == name &&
               std::any_of(info.parameters.begin(), info.parameters.end(),
                           [](const io::GeneratedParameter& p) { return p.name == "hour"; });
    });
}

// "builtin:NAME?a=1&hour=2" at another hour.
std::string withHour(std::string_view spec, double hour) {
    const std::size_t mark = std::min(spec.find('?'), spec.size());
    std::string text(spec.substr(0, mark)), values;
    for (std::size_t from = mark + 1; from < spec.size();) {
        const std::size_t end = std::min(spec.find('&', from), spec.size());
        const std::string_view one = spec.substr(from, end - from);
        if (one.substr(0, 5) != "hour=") values += fmt::format("{}&", one);
        from = end + 1;
    }
    return fmt::format("{}?{}hour={}", text, values, hour);
}

}  // namespace

HourOfDay::HourOfDay(const std::string& from, std::string scene, const ViewOptions& view)
    : scene_(std::move(scene)),
      view_(view),
      ofScene_(hasHour(scene_, io::generatedScenes())),
      ofSky_(hasHour(view.environment, io::generatedSurroundings())) {
    if (!ofScene_ && !ofSky_)
        usage(from + ": it sets the hour of the day, which this scene has none of; builtin:town, or " +
              "--environment builtin:sky, would be right");
}

Scene HourOfDay::at(const Scene& scene, double hour) const {
    ViewOptions view = view_;
    if (ofSky_) view.environment = withHour(view.environment, hour);
    if (ofScene_) {
        Progress quiet;
        return openScene(withHour(scene_, hour), view, quiet);
    }
    Scene lit = scene;
    io::useEnvironment(lit, io::loadEnvironment(view.environment),
                       glm::radians(static_cast<float>(view.rotateDeg)),
                       static_cast<float>(view.environmentStrength));
    return lit;
}

std::optional<HourOfDay> hoursOf(const CameraPath& path, const std::string& file, const std::string& scene,
                                 const ViewOptions& view) {
    if (!path.hourAt(path.start())) return {};
    return HourOfDay("--path: " + file, scene, view);
}

void addHours(std::function<void(Session&, int frame)>& beforeFrame, const std::string& file,
              const Session& session, const ViewOptions& view, const Request& film) {
    const std::optional<HourOfDay> hours = hoursOf(session.cameraPath(), file, session.path(), view);
    if (!hours) return;
    const int total = film.total > 0 ? film.total : film.count;
    const auto shown = std::make_shared<Scene>(session.scene());
    beforeFrame = [=, others = beforeFrame](Session& live, int frame) {
        if (others) others(live, frame);
        const CameraPath& keys = live.cameraPath();
        Scene now = hours->at(*shown, *keys.hourAt(keys.frameSeconds(frame, total)));
        live.takeChanges(*shown, now);
        *shown = std::move(now);
    };
}

}  // namespace conelight::program
