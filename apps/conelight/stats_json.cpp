// SPDX-License-Identifier: MIT
#include "stats_json.h"

#include "command.h"
#include "io/files.h"

namespace conelight::program {

nlohmann::ordered_json memoryJson(const FrameStats& stats) {
    // Objects of equal label (textures of one kind) are added up.
    nlohmann::ordered_json memory = nlohmann::ordered_json::object();
    std::size_t total = 0;
    for (const MemoryStats& object : stats.memory) {
        memory[object.label] =
            (memory.contains(object.label) ? memory[object.label].get<std::size_t>() : 0) + object.bytes;
        total += object.bytes;
    }
    memory["total"] = total;
    return memory;
}

nlohmann::ordered_json lookupsJson(const FrameStats& stats) {
    nlohmann::ordered_json lookups = nlohmann::ordered_json::object();
    for (const auto& [kind, count] : stats.lookupsPerPixel) lookups[kind] = count;
    return lookups;
}

nlohmann::ordered_json tracedJson(const reference::PathTracedPicture& picture) {
    return {{"samples_per_pixel", picture.samplesPerPixel},
            {"noise", picture.noise},
            {"rays", picture.rays},
            {"rays_per_second",
             picture.wallSeconds > 0 ? static_cast<double>(picture.rays) / picture.wallSeconds : 0.0},
            {"cpu_seconds", picture.cpuSeconds},
            {"wall_seconds", picture.wallSeconds}};
}

nlohmann::ordered_json beamsJson(const reference::BeamStats& stats) {
    return {{"polygons", stats.polygons},
            {"ordered_parts", stats.orderedParts},
            {"beams", stats.beams},
            {"parts", stats.parts},
            {"lamp_beams", stats.lampBeams},
            {"lit_parts", stats.litParts},
            {"cpu_seconds", stats.cpuSeconds},
            {"wall_seconds", stats.wallSeconds}};
}

nlohmann::ordered_json bakeJson(const reference::RadiosityStats& stats) {
    return {{"patches", stats.patches},        {"elements", stats.elements},
            {"vertices", stats.vertices},      {"iterations", stats.iterations},
            {"residual", stats.residual},      {"rays", stats.rays},
            {"cpu_seconds", stats.cpuSeconds}, {"wall_seconds", stats.wallSeconds}};
}

void writeJson(const std::string& path, const nlohmann::ordered_json& json) {
    const WritingScope writing;
    const std::string text = json.dump(2) + "\n";
    io::writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

nlohmann::ordered_json statsJson(const FrameStats& stats) {
    nlohmann::ordered_json json;
    json["device"] = stats.device;
    json["frame"] = {{"cpu_ms", stats.cpuMs}, {"wall_ms", stats.wallMs}};
    json["passes"] = nlohmann::ordered_json::array();
    for (const PassStats& pass : stats.passes)
        json["passes"].push_back(
            {{"name", pass.name},
             {"cpu_ms", pass.cpuMs},
             {"wall_ms", pass.wallMs},
             {"gpu_ms", pass.gpuMs >= 0 ? nlohmann::ordered_json(pass.gpuMs) : nlohmann::ordered_json()}});
    json["draw_calls"] = stats.drawCalls;
    json["waits"] = stats.waits;
    json["lookups_per_pixel"] = lookupsJson(stats);
    json["memory_bytes"] = memoryJson(stats);
    const ProgramStats programs = programStats();
    json["programs"] = {{"built", programs.built}, {"loaded", programs.loaded}};
    return json;
}

}  // namespace conelight::program
