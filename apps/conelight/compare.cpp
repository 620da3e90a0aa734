// SPDX-License-Identifier: MIT
// `conelight compare A B`: metrics of two pictures as a table or JSON, error maps, a report, bars with exit
// status. With one argument, which then is a scene, compare_scene.h does the work.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command.h"
#include "command_line.h"
#include "compare_scene.h"
#include "comparison.h"
#include "conelight/error.h"
#include "io/image_file.h"
#include "outputs.h"
#include "picture_input.h"
#include "report/report.h"

namespace conelight::program {
namespace {

using nlohmann::ordered_json;
using reference::ErrorMap;
using reference::Halves;
using reference::Metrics;

struct ComparePicturesOptions {
    std::string test, reference;
    std::string layer;
    std::vector<std::string> halves;
    std::string mapFile;
    std::vector<std::string> mapKinds = {"signed"};
    double mapScale = 0;
    ComparisonOptions comparison;

    void addTo(CLI::App& command);
};

void ComparePicturesOptions::addTo(CLI::App& command) {
    const std::size_t before = command.get_options().size();
    command.add_option("--layer", layer, "compare this layer of both .exr files, for example indirect")
        ->type_name("NAME");
    command
        .add_option("--halves", halves,
                    "two independent halves of the reference: its own noise is not counted as error")
        ->delimiter(',')
        ->expected(2)
        ->type_name("A,B");
    command.add_option("--map", mapFile, "write an error map: .png in colours, .exr as values")
        ->type_name("FILE");
    command
        .add_option("--map-kind", mapKinds,
                    "signed, absolute, relative, flip or hdr-flip; several write FILE-KIND each")
        ->delimiter(',')
        ->capture_default_str()
        ->type_name("KINDS");
    command
        .add_option(
            "--map-scale", mapScale,
            "error at the end of the colour scale (default 0.5 of the mean light for signed and absolute, "
            "else 1)")
        ->check(CLI::PositiveNumber)
        ->type_name("X");
    const std::vector<CLI::Option*> all = command.get_options();
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group("Two pictures");
}

// Where each kind of map goes.
std::vector<std::pair<ErrorMap, std::string>> mapFiles(const ComparePicturesOptions& options) {
    std::vector<std::pair<ErrorMap, std::string>> files;
    if (options.mapFile.empty()) return files;
    for (const std::string& name : options.mapKinds) {
        const std::optional<ErrorMap> kind = reference::errorMapOf(name);
        if (!kind)
            throw Error(ErrorKind::Usage,
                        fmt::format("--map-kind: '{}' is no kind of map; signed, absolute, relative, "
                                    "flip or hdr-flip would be right",
                                    name));
        std::filesystem::path file = options.mapFile;
        const io::ImageFormat format = io::imageFormatOf(file);
        if (format != io::ImageFormat::Png && format != io::ImageFormat::Exr)
            throw Error(ErrorKind::Usage,
                        options.mapFile + ": --map: a name ending in .png or .exr would be right");
        if (options.mapKinds.size() > 1)
            file.replace_filename(file.stem().string() + "-" + name + file.extension().string());
        files.emplace_back(*kind, file.string());
    }
    return files;
}

void writeMap(const std::string& file, const std::vector<float>& values, int width, int height, bool isSigned,
              double scale) {
    if (io::imageFormatOf(file) == io::ImageFormat::Exr) {
        io::FloatImage image;
        image.width = width;
        image.height = height;
        image.channels = 1;
        image.pixels = values;
        return io::writeExr(file, image);
    }
    io::ByteImage image{width, height, 3, std::vector<std::uint8_t>(values.size() * 3)};
    for (std::size_t i = 0; i < values.size(); ++i)
        reference::colorOfError(values[i] / static_cast<float>(scale), isSigned, &image.pixels[3 * i]);
    io::writePng(file, image);
}

// Halves whose mean is another picture were made for another reference.
void warnOfForeignHalves(const Image& reference, const Image& a, const Image& b, const std::string& name) {
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double mean = 0.5 * (double(a.pixels[i][c]) + b.pixels[i][c]);
            if (!std::isfinite(mean) || !std::isfinite(reference.pixels[i][c])) continue;
            difference += std::abs(mean - reference.pixels[i][c]);
            sum += std::abs(mean);
        }
    constexpr double kRounding = 1e-3;  // of 16-bit floats
    if (difference > kRounding * sum)
        std::fprintf(stderr, "conelight: --halves: their mean differs from %s by %.2g %%\n", name.c_str(),
                     100 * difference / sum);
}

void printTable(const ComparePicturesOptions& options, const Metrics& metrics, bool withFlip) {
    const std::string layer = options.layer.empty() ? "" : ", layer " + options.layer;
    fmt::print("test       {}{}\nreference  {}{}\ncompared   {} pixels", options.test, layer,
               options.reference, layer, metrics.pixels);
    if (metrics.badPixels > 0) fmt::print("; {} left out that are not finite", metrics.badPixels);
    fmt::print("\n\n{}", alignedTable(metricRows(metrics, withFlip, !options.halves.empty())));
}

// Short names that differ: the files' names without folders, or the paths.
std::pair<std::string, std::string> shortNames(const std::string& a, const std::string& b) {
    const std::string shortA = std::filesystem::path(a).filename().string();
    const std::string shortB = std::filesystem::path(b).filename().string();
    if (shortA != shortB) return {shortA, shortB};
    return a != b ? std::pair(a, b) : std::pair(a, b + " (reference)");
}

bool isLinearFile(const std::string& path) {
    const io::ImageFormat format = io::imageFormatOf(path);
    return format == io::ImageFormat::Exr || format == io::ImageFormat::Hdr;
}

Report reportOf(const ComparePicturesOptions& options, const Image& test, const Image& reference,
                const Metrics& metrics, const reference::FlipMaps& maps) {
    const reference::MetricOptions metricOptions = options.comparison.metricOptions();
    const auto [testName, referenceName] = shortNames(options.test, options.reference);
    Report report;
    report.title = testName + " against " + referenceName;
    report.summary = fmt::format("{}x{} pixels. Bias {:+.2f} %, relRMSE {:.2f} %.", test.width, test.height,
                                 metrics.bias * 100, metrics.relRmse * 100);
    report.commands = {commandLine()};
    ReportView view;
    view.name = options.layer.empty() ? "picture" : options.layer;
    view.exposure = metricOptions.exposure;
    // Radiance is shown as `render` writes it; other files are pictures already.
    if (options.layer.empty() && isLinearFile(options.test) && isLinearFile(options.reference))
        view.toneMap = getSetting(Settings{}, "image.tone_map");
    view.reference = 1;
    view.pictures = {{testName, test, metrics, maps.flip, maps.hdrFlip},
                     {referenceName, reference, {}, {}, {}}};
    report.views.push_back(std::move(view));
    ReportTable numbers{"All numbers", "", {{"metric"}, {"value"}, {"unit"}, {"meaning"}}, {}};
    for (const MetricRow& row : metricRows(metrics, metricOptions.flip, !options.halves.empty()))
        numbers.rows.push_back({row.name, row.value, row.unit, row.meaning});
    report.tables.push_back(std::move(numbers));
    report.settings = {{"test", options.test}, {"reference", options.reference}};
    for (const std::string& half : options.halves)
        report.settings.emplace_back("half of the reference", half);
    report.settings.emplace_back("exposure of the metrics", fmt::format("{} stops", metricOptions.exposure));
    if (metricOptions.flip)
        report.settings.emplace_back("pixels per degree (FLIP)",
                                     fmt::format("{}", metricOptions.pixelsPerDegree));
    return report;
}

void comparePictures(const ComparePicturesOptions& options) {
    const reference::MetricOptions metricOptions = options.comparison.metricOptions();
    const auto maps = mapFiles(options);
    const std::string& jsonFile = options.comparison.jsonFile;
    const std::string& reportFolder = options.comparison.report;
    std::vector<std::string> inputs = {options.test, options.reference};
    inputs.insert(inputs.end(), options.halves.begin(), options.halves.end());
    std::vector<Output> outputs = {{"--json", jsonFile, OutputKind::Json}};
    for (const auto& [kind, file] : maps) outputs.push_back({"--map", file});
    checkOutputs(outputs, inputs);
    if (!reportFolder.empty()) prepareReport(reportFolder, inputs);

    // Read everything, and see that it fits.
    const Image test = readPicture(options.test, options.layer);
    const Image reference = readPicture(options.reference, options.layer);
    requireSameSize(test, options.test, reference, options.reference);
    std::vector<Image> halves;
    for (const std::string& file : options.halves) {
        halves.push_back(readPicture(file, options.layer));
        requireSameSize(halves.back(), file, reference, options.reference);
    }
    std::optional<Halves> given;
    if (!halves.empty()) {
        given = Halves{&halves[0], &halves[1]};
        warnOfForeignHalves(reference, halves[0], halves[1], options.reference);
    }

    reference::FlipMaps flipMaps;
    const Metrics metrics = reference::compareImages(test, reference, metricOptions, given, &flipMaps);
    for (const auto& [kind, file] : maps) {
        const bool inMeans = kind == ErrorMap::Signed || kind == ErrorMap::Absolute;
        const double scale = options.mapScale > 0 ? options.mapScale : inMeans ? 0.5 : 1.0;  // by eye
        writeMap(file, reference::errorValues(test, reference, kind, metricOptions), test.width, test.height,
                 kind == ErrorMap::Signed, scale);
    }

    const std::vector<std::string> broken = options.comparison.bars.brokenBy(metrics);
    if (jsonFile != "-") printTable(options, metrics, metricOptions.flip);
    ordered_json json;
    json["version"] = 1;
    json["test"] = options.test;
    json["reference"] = options.reference;
    if (!options.layer.empty()) json["layer"] = options.layer;
    if (given) json["halves"] = options.halves;
    json["size"] = {test.width, test.height};
    json["exposure"] = metricOptions.exposure;
    if (metricOptions.flip) json["pixels_per_degree"] = metricOptions.pixelsPerDegree;
    json["metrics"] = metricsJson(metrics, metricOptions.flip, given.has_value());
    json["broken_bars"] = broken;
    if (!jsonFile.empty()) writeComparisonJson(jsonFile, json);
    if (!reportFolder.empty())
        writeReport(reportFolder, reportOf(options, test, reference, metrics, flipMaps));
    requireBars(options.test, broken);
}

struct CompareOptions {
    std::vector<std::string> inputs;
    ComparisonOptions comparison;
    ComparePicturesOptions pictures;
    CompareSceneOptions scene;
    std::vector<const CLI::Option*> ofPictures, ofScene;  // options of one form only
};

void refuse(const std::vector<const CLI::Option*>& options, const char* needed) {
    for (const CLI::Option* option : options)
        if (option->count() > 0)
            throw Error(ErrorKind::Usage,
                        fmt::format("{}: belongs to the comparison of {}; `conelight compare --help` "
                                    "lists both forms",
                                    option->get_name(), needed));
}

void run(CompareOptions& options) {
    const std::vector<std::string>& inputs = options.inputs;
    const auto picture = std::find_if(inputs.begin(), inputs.end(), isPictureFile);
    if (inputs.size() == 2 && picture != inputs.end()) {
        refuse(options.ofScene, "scenes");
        options.pictures.test = options.inputs[0];
        options.pictures.reference = options.inputs[1];
        options.pictures.comparison = options.comparison;
        return comparePictures(options.pictures);
    }
    if (picture != inputs.end())
        throw Error(ErrorKind::Usage,
                    *picture +
                        (inputs.size() == 1 ? ": is one picture; a second one to compare it with"
                                            : ": is a picture among scenes; two pictures, or scenes"
                                              " alone,") +
                        " would be right");
    refuse(options.ofPictures, "two pictures");
    options.scene.scenes = inputs;
    options.scene.comparison = options.comparison;
    compareScene(options.scene);
}

}  // namespace

void addCompare(CLI::App& app) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand(
        "compare", "measure two pictures (A B: is A like B?), or modes of scenes against the reference");
    command
        ->add_option("inputs", options->inputs,
                     "two pictures (.exr .hdr .png .jpg), the second one the truth; or scenes")
        ->required()
        ->type_name("A B | SCENE")
        ->expected(1, 1000);
    options->comparison.addTo(*command);
    const auto added = [&](auto&& add) {
        const std::size_t before = command->get_options().size();
        add();
        const std::vector<CLI::Option*> all = command->get_options();
        return std::vector<const CLI::Option*>(all.begin() + std::ptrdiff_t(before), all.end());
    };
    options->ofPictures = added([&] { options->pictures.addTo(*command); });
    options->ofScene = added([&] { options->scene.addTo(*command); });
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
