// SPDX-License-Identifier: MIT
// Figure 47: the methods side by side as bars: error against the path tracer, time of a picture, memory.
// All numbers are measured here and now.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "figures/drawings/drawing.h"
#include "figures/renders.h"
#include "reference/metrics.h"

namespace conelight::figures {
namespace {

constexpr const char* kRoom = "builtin:cornell";
constexpr const char* kModes[] = {"phong", "radiosity", "beams",  "thesis",
                                  "cones", "hybrid",    "traced", "reference"};

// Numbers, not a picture to look at: a quarter of the pixels of the others is enough, and keeps the path tracer short.
constexpr int kLargest = 256;

program::PictureRequest requestOf(const Studio& studio, const std::string& mode, int samples,
                                  const Scene& scene) {
    program::PictureRequest request =
        studio.requestOf(Shot{.scene = kRoom, .mode = mode, .samples = samples}, scene);
    request.size = {std::min(request.size.width, kLargest), std::min(request.size.height, kLargest)};
    return request;
}

struct Row {
    std::string mode;
    double error = 0;       // relRMSE; of the reference: its own noise
    double seconds = 0;     // CPU time of the first picture, voxels and light included
    double frameMs = -1;    // CPU time of a further frame; < 0: there is none
    double megabytes = -1;  // of GL objects; < 0: none
    const char* moving;
};

const char* movingOf(const std::string& mode) {
    if (mode == "radiosity") return "camera only";
    return mode == "reference" || mode == "beams" ? "all, drawn anew" : "all";
}

Row measure(Studio& studio, const std::string& mode, const Image& truth, const Scene& scene,
            std::string& device) {
    program::PictureRequest request = requestOf(studio, mode, 128, scene);
    const bool onCpu = !program::isRendererMode(mode);
    program::PictureSource fresh(studio.view());  // nothing of other modes: what it holds is its own
    fresh.setScene(scene);
    // CPU time of the whole process: all threads, shaders and voxels included.
    const std::clock_t start = std::clock();
    const program::Picture picture = fresh.draw(request, &studio.progress());
    if (picture.stopped) throw program::InterruptedError();
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    if (!onCpu) device = fresh.device();
    Row row{.mode = mode, .moving = movingOf(mode)};
    reference::MetricOptions options;
    options.flip = false;
    row.error = reference::compareImages(picture.images.front(), truth, options).relRmse;
    row.seconds = seconds;
    if (!onCpu) {
        request.timedFrames = studio.small() ? 1 : 5;
        const program::FrameCost cost = fresh.draw(request, &studio.progress()).cost;
        row.frameMs = cost.cpuMs;
        row.megabytes = 1e-6 * double(cost.memoryBytes);
    }
    return row;
}

// Bars on a logarithmic scale, one per mode that has a value.
void drawBars(Drawing& d, double x, const std::string& title, const std::vector<Row>& rows, const char* tint,
              const std::function<std::pair<double, std::string>(const Row&)>& valueOf) {
    double low = 1e30, high = 0;
    for (const Row& row : rows) {
        const double value = valueOf(row).first;
        if (value <= 0) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    constexpr double kWide = 170;
    const double from = std::log10(low) - 0.25, to = std::max(std::log10(high), from + 0.5);
    d.text({x, -16}, title, {.size = 14, .anchor = Anchor::Start, .bold = true});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto [value, label] = valueOf(rows[i]);
        const double y = 40.0 * double(i);
        const double length = value > 0 ? kWide * (std::log10(value) - from) / (to - from) : 0;
        if (value > 0) d.rect({x, y}, {std::max(length, 2.0), 22}, filled(tint), 2);
        d.text({x + length + 7, y + 16}, label,
               {.size = 13, .anchor = Anchor::Start, .colour = colour::kNote});
    }
}

}  // namespace

Panels plotComparison(Studio& studio) {
    const Scene scene = studio.scene(kRoom);
    studio.restart();
    program::PictureRequest request = requestOf(studio, "reference", 512, scene);
    request.reference.seed = 2;  // other noise than the one that is measured
    program::PictureSource source(studio.view());
    source.setScene(scene);
    const program::Picture truth = source.draw(request, &studio.progress());
    if (truth.stopped) throw program::InterruptedError();
    std::vector<Row> rows;
    std::string device;
    for (const char* mode : kModes)
        rows.push_back(measure(studio, mode, truth.images.front(), scene, device));
    Drawing d;
    for (std::size_t i = 0; i < rows.size(); ++i)
        d.text({-14, 40.0 * double(i) + 16}, rows[i].mode, {.size = 15, .anchor = Anchor::End, .bold = true});
    drawBars(d, 0, "error, relRMSE", rows, colour::kRed,
             [](const Row& r) { return std::pair(r.error, fmt::format("{:.2g} %", 100 * r.error)); });
    drawBars(d, 280, "first picture, CPU s", rows, colour::kBlue,
             [](const Row& r) { return std::pair(r.seconds, fmt::format("{:.2g} s", r.seconds)); });
    drawBars(d, 560, "further frame, CPU ms", rows, colour::kSky, [](const Row& r) {
        return std::pair(r.frameMs,
                         r.frameMs < 0 ? std::string("as the first") : fmt::format("{:.3g} ms", r.frameMs));
    });
    drawBars(d, 850, "GL memory, MB", rows, colour::kGreen, [](const Row& r) {
        return std::pair(r.megabytes,
                         r.megabytes < 0 ? std::string("none") : fmt::format("{:.3g} MB", r.megabytes));
    });
    d.text({1120, -16}, "may move", {.size = 14, .anchor = Anchor::Start, .bold = true});
    for (std::size_t i = 0; i < rows.size(); ++i)
        d.text({1120, 40.0 * double(i) + 16}, rows[i].moving,
               {.size = 13, .anchor = Anchor::Start, .colour = colour::kNote});
    d.text({-110, 40.0 * double(rows.size()) + 30},
           fmt::format("{}, {} x {}, against {} samples per pixel; scales are logarithmic; {}", kRoom,
                       request.size.width, request.size.height, request.reference.samplesPerPixel, device),
           {.size = 12, .anchor = Anchor::Start, .colour = colour::kNote});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Row& r : rows)
        json.push_back(
            {{"mode", r.mode},
             {"relrmse", r.error},
             {"first_cpu_s", r.seconds},
             {"frame_cpu_ms", r.frameMs < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(r.frameMs)},
             {"gl_megabytes",
              r.megabytes < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(r.megabytes)}});
    const std::string svg = d.svg("Methods of global illumination compared"), numbers = json.dump(1) + "\n";
    return {{"", ".svg", {svg.begin(), svg.end()}}, {"numbers", ".json", {numbers.begin(), numbers.end()}}};
}

}  // namespace conelight::figures
