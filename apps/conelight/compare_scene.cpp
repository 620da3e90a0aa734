// SPDX-License-Identifier: MIT
#include "compare_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "command_line.h"
#include "conelight/error.h"
#include "conelight/quality.h"
#include "equal_time.h"
#include "io/image_file.h"
#include "outputs.h"
#include "report/report.h"
#include "scene_comparison_output.h"

namespace conelight::program {
namespace {

using nlohmann::ordered_json;

// Whose errors bars are held against: the whole picture's, or those of the first component where it is not measured.
std::string barsComponent(const CompareSceneOptions& options) {
    if (!options.barsOn.empty()) return options.barsOn;
    const std::vector<std::string> names = splitList(options.components);
    return std::find(names.begin(), names.end(), "full") != names.end() ? "full" : names.front();
}

std::vector<Component> componentsOf(const CompareSceneOptions& options) {
    std::vector<Component> components;
    const std::vector<std::string> names = splitList(options.components);
    const auto isLight = [](const std::string& name) {
        return name == "full" || name == "direct" || name == "indirect" || name == "diffuse" ||
               name == "specular";
    };
    for (const std::string& name : names) {
        if (!isLight(name))
            usage("--components: there is no truth for '" + name +
                  "'; full, direct, indirect, diffuse or specular would be right");
        components.push_back(componentOf(name));
    }
    if (components.empty()) usage("--components: there is none; full would be right");
    const std::string barsOn = barsComponent(options);
    if (std::find(names.begin(), names.end(), barsOn) == names.end())
        usage("--bars-on: '" + barsOn + "' is not among --components; one of " + options.components +
              " would be right");
    return components;
}

SceneComparisonRequest requestOf(const CompareSceneOptions& options) {
    SceneComparisonRequest request;
    request.variants = options.variants.variants();
    request.components = componentsOf(options);
    requireModeName(options.against);
    request.against = options.against;
    request.referenceFile = options.referenceFile;
    if (!options.referenceFile.empty() && options.scenes.size() > 1)
        usage("--reference: one picture for several scenes; one scene would be right");
    const std::string tracer = options.tracer.given();
    if (!tracer.empty() && (!options.referenceFile.empty() || options.against != "reference"))
        usage(tracer + ": no reference is traced; without --reference and --against it would be right");
    request.pixels = options.pixels;
    request.cache = options.cache.empty() ? options.comparison.report : options.cache;
    request.picture.size = parseSize(options.view.size);
    request.picture.reference = options.tracer.settings();
    request.picture.frames = options.frames;
    request.picture.timedFrames = options.timedFrames;
    request.metrics = options.comparison.metricOptions();
    request.view = options.view;
    // The same filter on both sides.
    if (request.picture.reference.filter == reference::PixelFilter::Box)
        request.view.stillViews = kStillViews;
    return request;
}

// "cones voxels.size=64, indirect: relRMSE 0.2 is above 0.1 (--max-relrmse)".
std::vector<std::string> brokenBars(const CompareSceneOptions& options, const SceneComparison& comparison) {
    std::vector<std::string> all;
    const std::string barsOn = barsComponent(options);
    for (const VariantResult& result : comparison.variants)
        for (const ComponentResult& component : result.components) {
            if (component.name != barsOn) continue;
            for (const std::string& broken : options.comparison.bars.brokenBy(component.metrics))
                all.push_back(fmt::format("{} {} {}: {}", comparison.scene, result.variant.label(),
                                          component.name, broken));
        }
    return all;
}

// Not a number where nothing was measured, which shows as such.
Image shownTruth(const SceneComparison& comparison, Component component) {
    Image truth = *comparison.reference.part(component);
    for (std::size_t i = 0; i < comparison.measured.size(); ++i)
        if (comparison.measured[i] == 0) truth.pixels[i] = glm::vec4(std::numeric_limits<float>::quiet_NaN());
    return truth;
}

void addViews(Report& report, const SceneComparison& comparison, const reference::MetricOptions& metrics,
              bool severalScenes) {
    const auto& components = comparison.variants.front().components;
    for (std::size_t c = 0; c < components.size(); ++c) {
        const Image truth = shownTruth(comparison, components[c].component);
        ReportView view;
        view.name = (severalScenes ? comparison.scene + ", " : "") + components[c].name;
        view.exposure = metrics.exposure;
        view.toneMap = getSetting(comparison.variants.front().settings, "image.tone_map");
        for (const VariantResult& result : comparison.variants) {
            const ComponentResult& component = result.components[c];
            ReportPicture picture{result.variant.label(), component.image, component.metrics, {}, {}};
            if (metrics.flip) {
                picture.flip =
                    reference::errorValues(component.image, truth, reference::ErrorMap::Flip, metrics);
                picture.hdrFlip =
                    reference::errorValues(component.image, truth, reference::ErrorMap::HdrFlip, metrics);
            }
            view.pictures.push_back(std::move(picture));
        }
        view.reference = view.pictures.size();
        view.pictures.push_back({comparison.against, truth, {}, {}, {}});
        report.views.push_back(std::move(view));
    }
}

ReportTable costTable(const std::vector<SceneComparison>& comparisons) {
    ReportTable table{"Cost of a settled frame",
                      "Process CPU time, median; on a software driver that is the whole cost.",
                      {{"scene"},
                       {"mode"},
                       {"CPU", "ms", 3, "", true},
                       {"GPU", "ms", 3, "", true},
                       {"lookups", "per pixel", 3, "texture fetches of cones", true},
                       {"memory", "MB", 3, "GL objects", true}},
                      {}};
    for (const SceneComparison& comparison : comparisons)
        for (const VariantResult& result : comparison.variants) {
            const FrameCost& cost = result.cost;
            double lookups = 0;
            for (const auto& [kind, count] : cost.lookupsPerPixel) lookups += count;
            table.rows.push_back({comparison.scene, result.variant.label(), cost.cpuMs,
                                  cost.gpuMs >= 0 ? ReportCell(cost.gpuMs) : ReportCell("not measured"),
                                  cost.lookupsPerPixel.empty() ? ReportCell("none") : ReportCell(lookups),
                                  cost.memoryBytes > 0
                                      ? ReportCell(static_cast<double>(cost.memoryBytes) / 1e6)
                                      : ReportCell("none")});
        }
    return table;
}

Report reportOf(const std::vector<SceneComparison>& comparisons, const SceneComparisonRequest& request,
                const std::string& device) {
    Report report;
    std::string scenes, modes;
    for (const SceneComparison& one : comparisons) scenes += (scenes.empty() ? "" : ", ") + one.scene;
    for (const Variant& one : request.variants) modes += (modes.empty() ? "" : ", ") + one.label();
    report.title = scenes + ": " + modes + " against " + comparisons.front().against;
    report.commands = {commandLine()};
    for (const SceneComparison& one : comparisons) {
        addViews(report, one, request.metrics, comparisons.size() > 1);
        const ReferencePicture& reference = one.reference;
        std::string text = reference.origin;
        if (reference.samplesPerPixel > 0)
            text += fmt::format("; {} samples per pixel, noise {:.2g} %", reference.samplesPerPixel,
                                100 * reference.noise);
        report.settings.emplace_back("reference of " + one.scene, text);
    }
    const SceneComparison& first = comparisons.front();
    report.summary = fmt::format("{}x{} pixels, {} variants, {} scenes.", first.size.width, first.size.height,
                                 request.variants.size(), comparisons.size());
    report.tables.push_back(costTable(comparisons));
    if (!device.empty()) report.settings.emplace_back("device", device);
    for (const std::string& set : request.view.sets) report.settings.emplace_back("set", set);
    return report;
}

// Of --equal-time: traced at its qualities, and cones, unless other modes are asked for.
SceneComparisonRequest equalTimeRequestOf(const CompareSceneOptions& options) {
    SceneComparisonRequest request = requestOf(options);
    if (!options.pixels.empty())
        usage("--pixels: pictures at equal time are measured as a whole; one of the two would be right");
    if (options.against != "reference")
        usage("--equal-time: the path tracer is the truth; without --against it would be right");
    if (!options.variants.modesGiven()) {
        request.variants.clear();
        for (const QualityInfo& info : qualityInfos())
            request.variants.push_back({"traced", {{"traced.quality", info.name}}});
        request.variants.push_back({"cones", {}});
    }
    for (const Variant& variant : request.variants)
        if (variant.mode == "reference")
            usage(
                "--modes: reference is what --equal-time holds the others against; without it would be "
                "right");
    return request;
}

Report reportOf(const std::vector<EqualTimeScene>& scenes, const SceneComparisonRequest& request) {
    Report report;
    ReportTable table{"Equal CPU time",
                      "",
                      {{"scene"}, {"picture"}, {"samples"}, {"CPU", "s"}, {"relRMSE", "%", 1}, {"relMSE"}},
                      {}};
    for (const EqualTimeScene& one : scenes) {
        report.title += (report.title.empty() ? "" : ", ") + one.scene;
        ReportView view;
        view.name = one.scene;
        view.exposure = request.metrics.exposure;
        view.toneMap = getSetting(Settings{}, "image.tone_map");
        for (const EqualTimeVariant& row : one.variants) {
            const std::string label = row.variant.label();
            const std::pair<std::string, const EqualTimePicture*> pictures[] = {
                {label, &row.mode},
                {label + ": path tracer", &row.plain},
                {label + ": denoised", &row.denoised}};
            for (const auto& [name, picture] : pictures) {
                const reference::Metrics& m = picture->metrics;
                view.pictures.push_back({name, picture->drawn.image, m, {}, {}});
                table.rows.push_back({one.scene, name, double(picture->samplesPerPixel),
                                      picture->drawn.cpuSeconds, m.relRmse, m.relMse});
            }
        }
        view.reference = view.pictures.size();
        view.pictures.push_back({"reference", one.reference.full, {}, {}, {}});
        report.views.push_back(std::move(view));
    }
    report.title += ": at equal CPU time";
    report.commands = {commandLine()};
    report.tables.push_back(std::move(table));
    return report;
}

void compareEqualTime(const CompareSceneOptions& options) {
    const SceneComparisonRequest request = equalTimeRequestOf(options);
    const std::string &jsonFile = options.comparison.jsonFile, &folder = options.comparison.report;
    std::vector<std::string> inputs = options.scenes;
    inputs.insert(inputs.end(), {options.referenceFile, options.view.preset, options.view.environment});
    checkOutputs({{"--json", jsonFile, OutputKind::Json}}, inputs);
    if (!folder.empty()) prepareReport(folder, inputs);
    Progress progress;
    const bool withFlip = request.metrics.flip;
    std::vector<EqualTimeScene> scenes;
    std::vector<std::string> broken;
    ordered_json json = {{"version", 1}, {"command", commandLine()}};
    json["scenes"] = ordered_json::array();
    for (const std::string& name : options.scenes) {
        const Scene scene = openScene(name, options.view, progress);
        const EqualTimeScene done = compareAtEqualTime(scene, name, request, options.viewWords(), progress);
        progress.finish();
        if (jsonFile != "-") printEqualTime(done, withFlip);
        json["scenes"].push_back(equalTimeJson(done, withFlip));
        for (const EqualTimeVariant& row : done.variants)
            for (const std::string& one : options.comparison.bars.brokenBy(row.mode.metrics))
                broken.push_back(fmt::format("{} {} full: {}", name, row.variant.label(), one));
        if (!folder.empty()) scenes.push_back(done);
    }
    json["broken_bars"] = broken;
    if (!jsonFile.empty()) writeComparisonJson(jsonFile, json);
    if (!folder.empty()) writeReport(folder, reportOf(scenes, request));
    requireBars("compare", broken);
}

}  // namespace

void CompareSceneOptions::addTo(CLI::App& command) {
    const std::size_t before = command.get_options().size();
    view.size = "256x256";
    variants.addTo(command, "thesis,cones");
    command.add_option("--against", against, "the mode that counts as the truth")
        ->capture_default_str()
        ->type_name("MODE");
    command
        .add_option(
            "--reference", referenceFile,
            "a picture that counts as the truth: an .exr of `render --mode reference`, with the layers "
            "direct and indirect; halves are used when it has them")
        ->type_name("FILE");
    command
        .add_option(
            "--cache", cache,
            "folder in which reference pictures are kept for the next run (default: that of --report)")
        ->type_name("DIR");
    command
        .add_option("--components", components, "what is measured: full, direct, indirect, diffuse, specular")
        ->capture_default_str()
        ->type_name("A,B");
    command
        .add_option("--bars-on", barsOn,
                    "the component that bars are held against (default: full, or the first of --components)")
        ->type_name("NAME");
    command
        .add_option("--pixels", pixels,
                    "measure pixels alone that show this before anything else: glass, solid (glass that "
                    "bends light), "
                    "pane (glass that does not) or material:NAME; the reference is traced there alone")
        ->type_name("WHAT");
    command
        .add_option("--shader-dir", shaderDirectory, "shaders from this folder instead of the built-in ones")
        ->type_name("DIR");
    command.add_option("--frames", frames, "frames until a picture has settled")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    command.add_option("--timed", timedFrames, "frames whose cost is measured; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0, 10000));
    command.add_flag("--equal-time", equalTime,
                     "each mode's still against the path tracer, plain and denoised, that is given the same "
                     "CPU time, start included (modes: traced at its qualities, and cones)");
    tracer.addTo(command,
                 "what a pixel shows, in the reference and in every mode: center (one point of it, the "
                 "default) or box (its "
                 "area; image.antialiasing of the modes is 16 unless set)");
    const std::size_t beforeView = command.get_options().size();
    view.addTo(command);
    const std::vector<CLI::Option*> all = command.get_options();
    ofView_.assign(all.begin() + std::ptrdiff_t(beforeView), all.end());
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group("Scenes");
}

std::vector<std::string> CompareSceneOptions::viewWords() const {
    std::vector<std::string> words;
    for (const CLI::Option* option : ofView_) {
        const std::string name = option->get_name();
        if (option->count() == 0 || name == "--size") continue;
        const bool isFlag = option->get_items_expected_max() == 0;
        if (isFlag) words.push_back(name);
        if (isFlag) continue;
        for (const std::string& value : option->results()) words.insert(words.end(), {name, value});
    }
    return words;
}

void compareScene(const CompareSceneOptions& options) {
    if (options.equalTime) return compareEqualTime(options);
    const SceneComparisonRequest request = requestOf(options);
    const std::string& jsonFile = options.comparison.jsonFile;
    const std::string& folder = options.comparison.report;
    std::vector<std::string> inputs = options.scenes;
    inputs.insert(inputs.end(), {options.referenceFile, options.view.preset, options.view.environment});
    checkOutputs({{"--json", jsonFile, OutputKind::Json}}, inputs);
    if (!folder.empty()) prepareReport(folder, inputs);

    PictureSource source(options.view, options.shaderDirectory);
    Progress progress;
    const bool withFlip = request.metrics.flip;
    std::vector<SceneComparison> comparisons;
    std::vector<std::string> broken;
    ordered_json json = {{"version", 1}, {"command", commandLine()}, {"device", nullptr}};
    json["scenes"] = ordered_json::array();
    for (const std::string& name : options.scenes) {
        const Scene scene = openScene(name, options.view, progress);
        comparisons.push_back(compareVariants(scene, name, request, progress, source));
        progress.finish();
        const SceneComparison& done = comparisons.back();
        if (jsonFile != "-") printComparison(done, withFlip);
        json["scenes"].push_back(comparisonJson(done, withFlip));
        if (!folder.empty()) writeVariants(done, folder, source.device());
        const std::vector<std::string> here = brokenBars(options, done);
        broken.insert(broken.end(), here.begin(), here.end());
        if (folder.empty()) comparisons.clear();  // several large pictures each
    }
    if (!source.device().empty()) json["device"] = source.device();
    json["broken_bars"] = broken;
    if (!jsonFile.empty()) writeComparisonJson(jsonFile, json);
    if (!folder.empty()) {
        progress.show("writing the report");
        writeReport(folder, reportOf(comparisons, request, source.device()));
        progress.finish();
    }
    requireBars("compare", broken);
}

}  // namespace conelight::program
