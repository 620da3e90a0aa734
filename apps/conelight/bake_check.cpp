// SPDX-License-Identifier: MIT
#include "bake_check.h"

#include <fmt/core.h>

#include "io/image_file.h"
#include "picture_file.h"
#include "reference/metrics.h"
#include "table.h"
#include "truth_options.h"

namespace conelight::program {
namespace {

// One row, and the same for --json.
nlohmann::ordered_json addErrors(Table& table, const std::string& name,
                                 const reference::BakedPicture& picture,
                                 const reference::PathTracedPicture& truth) {
    reference::MetricOptions numbers;
    numbers.flip = false;
    const reference::Metrics diffuse = compareImages(picture.diffuse, truth.diffuse, numbers);
    const reference::Metrics full = compareImages(picture.full, truth.full, numbers);
    table.add({name, percent(diffuse.relRmse), percent(diffuse.blockRelRmse), percent(diffuse.bias),
               percent(full.relRmse), percent(full.bias)});
    return {{"kind", name},
            {"diffuse_rel_rmse", diffuse.relRmse},
            {"diffuse_block_rel_rmse", diffuse.blockRelRmse},
            {"diffuse_bias", diffuse.bias},
            {"full_rel_rmse", full.relRmse},
            {"full_bias", full.bias}};
}

}  // namespace

void validateCheck(const BakeCheck& check) {
    const Size size = parseSize(check.size);
    if (check.samples < 1 || check.samples > (1 << 20))
        usage(fmt::format("--check-spp: {} is not usable; 1 to 1048576 would be right", check.samples));
    if (!check.picture.empty()) io::imageFormatOf(check.picture);
    if (size.width > 4096 || size.height > 4096)
        usage(fmt::format("--check-size: {} is too large; up to 4096x4096 would be right", check.size));
}

nlohmann::ordered_json checkBake(const Scene& scene, const BakeCheck& check, const std::string& title,
                                 const std::vector<BakedKind>& kinds, Progress& progress) {
    const Size size = parseSize(check.size);
    const Camera camera = cameraFor(scene, check.view);
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = check.samples;
    settings.bounces = parseBounces(check.bounces, 1000);
    settings.seed = check.seed + 1;  // independent of what was baked
    const reference::PathTracer tracer(scene);
    const reference::PathTracedPicture truth =
        tracer.render(camera, size.width, size.height, settings, [&](const reference::PathTracerProgress& p) {
            progress.show(fmt::format("path tracing the check, {} of {}", p.samplesDone, p.samplesPlanned));
            return !interrupted();
        });
    progress.finish();
    if (interrupted()) throw InterruptedError();
    fmt::print("against the path tracer, {}x{}, {} samples, whose own noise counts as error:\n", size.width,
               size.height, check.samples);
    Table table({title, "diffuse indirect", "4x4 blocks", "bias", "whole picture", "bias"});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const BakedKind& kind : kinds) {
        const reference::BakedPicture picture = kind.draw(camera, truth);
        json.push_back(addErrors(table, kind.name, picture, truth));
        if (!check.picture.empty() && &kind == &kinds.back())
            writePicture(check.picture, picture.full, settingsFor(scene, "", check.view).image);
    }
    table.print(1);
    return json;
}

}  // namespace conelight::program
