// SPDX-License-Identifier: MIT
#include "scene_comparison_output.h"

#include <fmt/core.h>

#include <filesystem>

#include "comparison.h"
#include "provenance.h"
#include "stats_json.h"
#include "table.h"

namespace conelight::program {
namespace {

using nlohmann::ordered_json;

double lookupsOf(const FrameCost& cost) {
    double sum = 0;
    for (const auto& [kind, count] : cost.lookupsPerPixel) sum += count;
    return sum;
}

std::string referenceLine(const ReferencePicture& reference) {
    std::string text = reference.origin;
    if (reference.samplesPerPixel > 0)
        text += fmt::format(", {} samples per pixel, noise {:.2g} %, {:.3g} CPU s", reference.samplesPerPixel,
                            100 * reference.noise, reference.cpuSeconds);
    return text;
}

// How many pixels were measured, and what the reference's own noise leaves open there.
void printPixels(const SceneComparison& comparison) {
    for (const VariantResult& result : comparison.variants)
        for (const ComponentResult& component : result.components) {
            const reference::Metrics& m = component.metrics;
            fmt::print("{} pixels of {}: {}, {}", m.pixels, comparison.pixels, result.variant.label(),
                       component.name);
            if (component.withHalves)
                fmt::print(": relRMSE within {} to {}, without noise of {} that the reference has there",
                           percent(m.relRmseLow), percent(m.relRmseHigh), percent(m.referenceNoise));
            fmt::print("\n");
        }
}

ordered_json vectorJson(const glm::vec3& v) { return {v.x, v.y, v.z}; }

ordered_json variantJson(const VariantResult& result, bool withFlip) {
    ordered_json json = {{"mode", result.variant.mode}, {"label", result.variant.label()}};
    json["settings"] = ordered_json::object();
    for (const auto& [key, value] : result.variant.values) json["settings"][key] = value;
    if (isRendererMode(result.variant.mode)) json["voxels"] = result.settings.voxels.size;
    for (const ComponentResult& component : result.components)
        json["components"][component.name] = metricsJson(component.metrics, withFlip, component.withHalves);
    const FrameCost& cost = result.cost;
    json["frame"] = {{"cpu_ms", cost.cpuMs},
                     {"wall_ms", cost.wallMs},
                     {"gpu_ms", cost.gpuMs >= 0 ? ordered_json(cost.gpuMs) : ordered_json()}};
    json["lookups_per_pixel"] = ordered_json::object();
    for (const auto& [kind, count] : cost.lookupsPerPixel) json["lookups_per_pixel"][kind] = count;
    json["memory_bytes"] = cost.memoryBytes > 0 ? ordered_json(cost.memoryBytes) : ordered_json();
    if (result.baked) json["radiosity"] = bakeJson(*result.baked);
    if (result.beams) json["beams"] = beamsJson(*result.beams);
    return json;
}

}  // namespace

void printComparison(const SceneComparison& comparison, bool withFlip) {
    fmt::print("{}  {} x {}  against {}: {}\n", comparison.scene, comparison.size.width,
               comparison.size.height, comparison.against, referenceLine(comparison.reference));
    std::vector<std::string> head = {
        "mode", "component", "relRMSE", blocksText(comparison.variants.front().components.front().metrics),
        "bias", "PSNR",      "SSIM"};
    if (withFlip) head.insert(head.end(), {"FLIP", "HDR-FLIP"});
    head.insert(head.end(), {"CPU ms", "GPU ms", "lookups", "MB"});
    Table table(head);
    std::size_t bad = 0;
    for (const VariantResult& result : comparison.variants) {
        bool first = true;
        for (const ComponentResult& component : result.components) {
            const reference::Metrics& m = component.metrics;
            bad += m.badPixels;
            std::vector<std::string> row = {first ? result.variant.label() : "",
                                            component.name,
                                            percent(m.relRmse),
                                            percent(m.blockRelRmse),
                                            percent(m.bias),
                                            fmt::format("{:.1f}", m.psnr),
                                            fmt::format("{:.3f}", m.ssim)};
            if (withFlip)
                row.insert(row.end(), {fmt::format("{:.3f}", m.flip), fmt::format("{:.3f}", m.hdrFlip)});
            if (first) {
                const FrameCost& cost = result.cost;
                row.push_back(number(cost.cpuMs));
                row.push_back(cost.gpuMs >= 0 ? number(cost.gpuMs) : "-");
                row.push_back(cost.lookupsPerPixel.empty() ? "-" : number(lookupsOf(cost)));
                row.push_back(cost.memoryBytes > 0 ? number(static_cast<double>(cost.memoryBytes) / 1e6)
                                                   : "-");
            }
            table.add(row);
            first = false;
        }
    }
    table.print(2);
    if (!comparison.pixels.empty()) printPixels(comparison);
    if (bad > 0) fmt::print("{} values of pixels that are not finite were left out\n", bad);
}

ordered_json comparisonJson(const SceneComparison& comparison, bool withFlip) {
    ordered_json json;
    json["scene"] = comparison.scene;
    json["against"] = comparison.against;
    const Camera& camera = comparison.camera;
    json["camera"] = {{"name", camera.name},
                      {"eye", vectorJson(camera.eye)},
                      {"target", vectorJson(camera.target)},
                      {"fov_deg", glm::degrees(camera.fovY)}};
    if (camera.isOrthographic()) json["camera"]["orthographic_height"] = camera.orthographicHeight;
    json["size"] = {comparison.size.width, comparison.size.height};
    if (!comparison.pixels.empty()) json["pixels"] = comparison.pixels;
    const ReferencePicture& reference = comparison.reference;
    json["reference"] = {{"origin", reference.origin}};
    if (reference.samplesPerPixel > 0)
        json["reference"].update({{"samples_per_pixel", reference.samplesPerPixel},
                                  {"noise", reference.noise},
                                  {"cpu_seconds", reference.cpuSeconds},
                                  {"rays", reference.rays}});
    json["variants"] = ordered_json::array();
    for (const VariantResult& result : comparison.variants)
        json["variants"].push_back(variantJson(result, withFlip));
    return json;
}

std::vector<std::string> writeVariants(const SceneComparison& comparison, const std::string& directory,
                                       const std::string& device) {
    std::vector<std::string> files;
    for (const VariantResult& result : comparison.variants) {
        const std::string stem = fileStem(comparison.scene + "-" + result.variant.label());
        const std::string file = (std::filesystem::path(directory) / (stem + ".exr")).string();
        std::vector<std::pair<std::string, Image>> layers;
        for (std::size_t i = 1; i < result.components.size(); ++i)
            layers.emplace_back(result.components[i].name, result.components[i].image);
        PictureRequest drawn;
        drawn.mode = result.variant.mode;
        drawn.settings = result.settings;
        drawn.camera = comparison.camera;
        drawn.size = comparison.size;
        drawn.reference.samplesPerPixel = 0;
        writePicture(file, result.components.front().image, result.settings.image,
                     provenanceOf(drawn, comparison.scene, device), layers);
        files.push_back(file);
    }
    return files;
}

}  // namespace conelight::program
