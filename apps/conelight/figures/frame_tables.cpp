// SPDX-License-Identifier: MIT
// Tables 1 and 2: mean time of a frame of the room with three lamps at three voxel sizes, with voxels made
// once and made in every frame. The thesis's numbers are of a GTX 1070 (its chapter 6).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "figures/renders.h"

namespace conelight::figures {
namespace {

constexpr const char* kComplexRoom = "builtin:thesis-complex";
constexpr std::array<int, 3> kSizes = {64, 128, 256};
constexpr std::array<double, 3> kPrintedStill = {0.01666, 0.0313, 0.1274};
constexpr std::array<double, 3> kPrintedDynamic = {0.02039, 0.06301, 0.33401};
// CPU ms of the original program's frame and voxel pass on llvmpipe, 800 x 600, without its dragon
// (docs/measurements/thesis_baselines.md).
constexpr std::array<double, 3> kOriginalFrame = {2298, 9165, 41294};
constexpr std::array<double, 3> kOriginalVoxels = {15.2, 40, 183};
constexpr program::Size kPrintedSize{800, 600};
constexpr int kFrames = 100;         // as in the thesis
constexpr double kMostSeconds = 10;  // per cell: software drivers measure fewer frames
constexpr int kFewest = 3, kSmallFrames = 2;

struct Cell {
    int voxels = 0, frames = 0;
    bool published = false;
    double wallMs = 0, cpuMs = 0, gpuMs = -1;  // means
};

program::Size sizeOf(const Studio& studio) { return studio.small() ? studio.size() : kPrintedSize; }

Cell measure(Studio& studio, const Scene& scene, int voxels, bool published, bool dynamic) {
    Shot shot{.scene = kComplexRoom,
              .mode = "thesis",
              .camera = "pos2",
              .settings = {{"thesis.published", published ? "true" : "false"}},
              .voxels = voxels};
    program::PictureRequest request = studio.requestOf(shot, scene);
    setSetting(request.settings, "mode", "thesis");
    request.settings.voxels.size = voxels;
    request.size = sizeOf(studio);
    Renderer renderer;
    renderer.setScene(scene);
    const auto frame = [&] {
        renderer.render(request.camera, request.size.width, request.size.height, request.settings);
    };
    studio.progress().show(fmt::format("{} voxels{}: warming up", voxels, published ? ", published" : ""));
    renderer.setProfiling(true, false);
    renderer.setDynamic(dynamic);
    frame();
    frame();
    Cell cell{.voxels = voxels, .published = published, .gpuMs = 0};
    const int wanted = studio.small() ? kSmallFrames : kFrames;
    while (cell.frames < wanted && (cell.frames < kFewest || cell.wallMs < 1e3 * kMostSeconds)) {
        studio.progress().show(fmt::format("{} voxels{}: frame {} of {}", voxels,
                                           published ? ", published" : "", cell.frames + 1, wanted));
        frame();
        const FrameStats& stats = renderer.stats();
        cell.wallMs += stats.wallMs;
        cell.cpuMs += stats.cpuMs;
        double gpu = 0;
        bool timed = !stats.passes.empty();
        for (const PassStats& pass : stats.passes) {
            gpu += pass.gpuMs;
            timed = timed && pass.gpuMs >= 0;
        }
        cell.gpuMs = timed && cell.gpuMs >= 0 ? cell.gpuMs + gpu : -1;
        ++cell.frames;
    }
    cell.wallMs /= cell.frames;
    cell.cpuMs /= cell.frames;
    if (cell.gpuMs >= 0) cell.gpuMs /= cell.frames;
    return cell;
}

// What others took for the same cell.
struct Others {
    double printed;     // in the thesis, s
    double originalMs;  // of CPU, by the original program
};

Others othersOf(std::size_t size, bool dynamic) {
    return {(dynamic ? kPrintedDynamic : kPrintedStill)[size],
            kOriginalFrame[size] + (dynamic ? kOriginalVoxels[size] : 0.0)};
}

std::string rowOf(const Cell& cell, const Others& others) {
    const std::string gpu = cell.gpuMs >= 0 ? fmt::format("{:.3f}", cell.gpuMs) : "not measured";
    return fmt::format("| {} | {} | {} | {:.5f} | {:.2f} | {:.1f} | {} | {:.5f} | {:.2f} | {:.0f} |\n",
                       cell.voxels, cell.published ? "published" : "mended", cell.frames, 1e-3 * cell.wallMs,
                       1e3 / cell.wallMs, cell.cpuMs, gpu, others.printed, 1 / others.printed,
                       others.originalMs);
}

Panels tableOf(Studio& studio, bool dynamic) {
    const Scene scene = studio.scene(kComplexRoom);
    studio.restart();
    // The context lives in a source of its own: cells are renderers of their own.
    const std::unique_ptr<platform::HeadlessContext> context = program::openContext(studio.view());
    std::string text = fmt::format(
        "# Table {}\n\n{}, mode `thesis`, {} x {}, camera `pos2`, voxels made {}. Means over frames.\n"
        "Device: {}. Times of the thesis: NVIDIA GTX 1070, its own scene of the same plan. Original: CPU "
        "time of "
        "its program by llvmpipe on two cores, 800 x 600, that scene without its dragon.\n\n"
        "| voxels | variant | frames | s per frame | frames/s | CPU ms | GPU ms | thesis: s | thesis: "
        "frames/s | original: CPU ms |\n"
        "|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        dynamic ? 2 : 1, kComplexRoom, sizeOf(studio).width, sizeOf(studio).height,
        dynamic ? "anew in each frame" : "once", context->description());
    nlohmann::ordered_json json;
    json["device"] = context->description();
    json["scene"] = kComplexRoom;
    json["dynamic"] = dynamic;
    json["size"] = {sizeOf(studio).width, sizeOf(studio).height};
    json["cells"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < kSizes.size(); ++i)
        for (const bool published : {true, false}) {
            const Cell cell = measure(studio, scene, kSizes[i], published, dynamic);
            const Others others = othersOf(i, dynamic);
            text += rowOf(cell, others);
            json["cells"].push_back(
                {{"voxels", cell.voxels},
                 {"variant", published ? "published" : "mended"},
                 {"frames", cell.frames},
                 {"wall_ms", cell.wallMs},
                 {"cpu_ms", cell.cpuMs},
                 {"gpu_ms", cell.gpuMs >= 0 ? nlohmann::ordered_json(cell.gpuMs) : nlohmann::ordered_json()},
                 {"thesis_s", others.printed},
                 {"original_cpu_ms", others.originalMs}});
        }
    const std::string numbers = json.dump(1) + "\n";
    return {{"", ".md", {text.begin(), text.end()}}, {"numbers", ".json", {numbers.begin(), numbers.end()}}};
}

}  // namespace

Panels measureStill(Studio& studio) { return tableOf(studio, false); }
Panels measureDynamic(Studio& studio) { return tableOf(studio, true); }

}  // namespace conelight::figures
