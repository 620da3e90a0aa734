// SPDX-License-Identifier: MIT
#include "inspection_text.h"

#include <fmt/core.h>

#include <cmath>

namespace conelight::program {
namespace {

// What is only rounding is zero.
float rounded(float x) { return std::fabs(x) < 1e-9f ? 0.0f : x; }

std::string text(const glm::vec3& v) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", rounded(v.x), rounded(v.y), rounded(v.z));
}

std::string modeName(Mode mode) {
    Settings settings;
    settings.mode = mode;
    return getSetting(settings, "mode");
}

void addPart(std::vector<std::string>& lines, const char* name, const InspectedPart& part, const char* unit) {
    if (!part.used) return;
    lines.push_back(fmt::format("  {:<10} {}{}  x  {}  =  {}", name, text(part.value), unit, text(part.scale),
                                text(part.shown())));
}

std::string directionName(int direction) {
    static constexpr const char* kNames[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    return kNames[direction];
}

std::string faceText(const InspectedFace& face) {
    return fmt::format(
        "      face {} of voxel {} {} {}: normal {}, plane {:+.3f} voxels, coverage {:.3g}, albedo {}, "
        "radiance {}, irradiance / pi {}, {}",
        directionName(face.direction), face.voxel.x, face.voxel.y, face.voxel.z, text(face.normal),
        face.plane, face.coverage, text(face.albedo), text(face.radiance), text(face.irradiance),
        face.updates < 0 ? std::string("inside a closed object") : fmt::format("{} updates", face.updates));
}

nlohmann::ordered_json json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json json(const InspectedPart& part) {
    return {{"value", json(part.value)}, {"scale", json(part.scale)}, {"shown", json(part.shown())}};
}

nlohmann::ordered_json json(const InspectedStep& step) {
    return {{"kind", nameOf(step.kind)},   {"position_m", json(step.position)},
            {"distance_m", step.distance}, {"size_m", step.size},
            {"level", step.level},         {"opacity", step.opacity},
            {"total_opacity", step.total}, {"radiance", json(step.radiance)}};
}

nlohmann::ordered_json json(const InspectedFace& face) {
    return {{"voxel", {face.voxel.x, face.voxel.y, face.voxel.z}},
            {"direction", directionName(face.direction)},
            {"normal", json(face.normal)},
            {"plane_voxels", face.plane},
            {"coverage", face.coverage},
            {"albedo", json(face.albedo)},
            {"radiance", json(face.radiance)},
            {"irradiance_over_pi", json(face.irradiance)},
            {"updates", face.updates}};
}

nlohmann::ordered_json json(const InspectedPath& path) {
    nlohmann::ordered_json j{{"kind", nameOf(path.kind)},     {"end", nameOf(path.end)},
                             {"origin_m", json(path.origin)}, {"direction", json(path.direction)},
                             {"aperture_rad", path.aperture}, {"distance_m", path.distance},
                             {"weight", json(path.weight)},   {"radiance", json(path.radiance)},
                             {"opacity", path.opacity}};
    if (path.face) j["face"] = json(*path.face);
    j["steps"] = nlohmann::ordered_json::array();
    for (const InspectedStep& step : path.steps) j["steps"].push_back(json(step));
    return j;
}

}  // namespace

std::vector<std::string> inspectionText(const PixelInspection& pixel, bool steps) {
    std::vector<std::string> lines;
    lines.push_back(fmt::format("pixel {},{}  mode {}  radiance {} W/(sr m^2)", pixel.x, pixel.y,
                                modeName(pixel.mode), text(glm::vec3(pixel.picture))));
    if (pixel.seen)
        lines.push_back(fmt::format("  surface at {} m, normal {}, depth {:.4g} m", text(pixel.position),
                                    text(pixel.normal), pixel.depth));
    addPart(lines, "diffuse", pixel.diffuse, " W/(sr m^2)");
    addPart(lines, "specular", pixel.specular, " W/(sr m^2)");
    addPart(lines, "occlusion", pixel.occlusion, " open");
    if (pixel.paths.empty()) lines.push_back("  nothing was gathered for this pixel");
    int number = 0;
    for (const InspectedPath& path : pixel.paths) {
        const std::string aperture =
            path.aperture > 0 ? fmt::format(" {:.1f} deg", glm::degrees(path.aperture)) : "";
        const std::string end = path.end == PathEnd::Unused
                                    ? std::string(nameOf(path.end))
                                    : fmt::format("{} after {:.4g} m in {} steps", nameOf(path.end),
                                                  path.distance, path.steps.size());
        lines.push_back(
            fmt::format("  {:>3} {}{}: {}, direction {}, weight {}, radiance {}, opacity "
                        "{:.3f}",
                        number++, nameOf(path.kind), aperture, end, text(path.direction), text(path.weight),
                        text(path.radiance), path.opacity));
        if (path.face) lines.push_back(faceText(*path.face));
        if (!steps) continue;
        for (const InspectedStep& step : path.steps)
            lines.push_back(fmt::format(
                "      {:<6} at {:.4g} m ({}), size {:.4g} m, level {:.3g}, opacity +{:.4f} = {:.4f}, "
                "radiance +{}",
                nameOf(step.kind), step.distance, text(step.position), step.size, step.level, step.opacity,
                step.total, text(step.radiance)));
    }
    if (!pixel.complete) lines.push_back("  there were more paths or steps than are kept");
    return lines;
}

nlohmann::ordered_json inspectionJson(const PixelInspection& pixel) {
    nlohmann::ordered_json j{{"version", 1},
                             {"pixel", {pixel.x, pixel.y}},
                             {"mode", modeName(pixel.mode)},
                             {"radiance", json(glm::vec3(pixel.picture))},
                             {"seen", pixel.seen}};
    if (pixel.seen)
        j["surface"] = {
            {"position_m", json(pixel.position)}, {"normal", json(pixel.normal)}, {"depth_m", pixel.depth}};
    if (pixel.diffuse.used) j["diffuse"] = json(pixel.diffuse);
    if (pixel.specular.used) j["specular"] = json(pixel.specular);
    if (pixel.occlusion.used) j["occlusion"] = json(pixel.occlusion);
    j["complete"] = pixel.complete;
    j["paths"] = nlohmann::ordered_json::array();
    for (const InspectedPath& path : pixel.paths) j["paths"].push_back(json(path));
    return j;
}

}  // namespace conelight::program
