// SPDX-License-Identifier: MIT
// Pictures: comparison, error maps, files.
#include <fmt/core.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "io/image_file.h"
#include "reference/metrics.h"
#include "settings_argument.h"

namespace conelight::python {
namespace {

namespace fs = std::filesystem;

void requireSameSize(const Image& a, const char* name, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: is {}x{} pixels, but the reference is {}x{}; the same size "
                                "would be right",
                                name, a.width, a.height, b.width, b.height));
}

reference::MetricOptions optionsOf(Keywords& given) {
    reference::MetricOptions options;
    options.exposure = given.take("exposure", options.exposure);
    options.pixelsPerDegree = given.take("pixels_per_degree", options.pixelsPerDegree);
    if (!(options.exposure >= -32 && options.exposure <= 32))
        throw Error(ErrorKind::Usage, "exposure: is out of range; -32 to 32 stops would be right");
    if (!(options.pixelsPerDegree >= 1 && options.pixelsPerDegree <= 500))
        throw Error(ErrorKind::Usage, "pixels_per_degree: is out of range; 1 to 500 would be right");
    return options;
}

// Keys and meanings as `conelight compare --json` has them.
py::dict compare(const py::object& testGiven, const py::object& referenceGiven, const py::kwargs& options) {
    Keywords given("compare", options);
    reference::MetricOptions metricOptions = optionsOf(given);
    metricOptions.flip = given.take("flip", true);
    metricOptions.blockSize = given.take("blocks", metricOptions.blockSize);
    if (metricOptions.blockSize < 1 || metricOptions.blockSize > 1024)
        throw Error(ErrorKind::Usage, "blocks: is out of range; 1 to 1024 pixels a side would be right");
    const py::object halvesGiven = given.take("halves");
    given.finish();
    const Image test = imageOf("test", testGiven), truth = imageOf("reference", referenceGiven);
    requireSameSize(test, "test", truth);
    std::vector<Image> halves;
    if (!halvesGiven.is_none())
        for (const py::handle half : halvesGiven) {
            halves.push_back(imageOf("halves", half));
            requireSameSize(halves.back(), "halves", truth);
        }
    if (!halves.empty() && halves.size() != 2)
        throw Error(ErrorKind::Usage, fmt::format("halves: {} pictures; two would be right", halves.size()));
    std::optional<reference::Halves> pair;
    if (!halves.empty()) pair = reference::Halves{&halves[0], &halves[1]};
    const reference::Metrics m =
        unlocked([&] { return reference::compareImages(test, truth, metricOptions, pair); });
    py::dict scores;
    scores["pixels"] = m.pixels;
    scores["bad_pixels"] = m.badPixels;
    scores["block_size"] = m.blockSize;
    const std::pair<const char*, double> numbers[] = {
        {"mean", m.mean},       {"reference_mean", m.referenceMean},
        {"bias", m.bias},       {"mae", m.mae},
        {"mse", m.mse},         {"rmse", m.rmse},
        {"relrmse", m.relRmse}, {"block_relrmse", m.blockRelRmse},
        {"relmse", m.relMse},   {"psnr_db", m.psnr},
        {"ssim", m.ssim}};
    for (const auto& [key, value] : numbers) scores[key] = value;
    if (metricOptions.flip) {
        scores["flip"] = m.flip;
        scores["hdr_flip"] = m.hdrFlip;
    }
    if (pair) {
        scores["relrmse_low"] = m.relRmseLow;
        scores["relrmse_high"] = m.relRmseHigh;
        scores["reference_noise"] = m.referenceNoise;
    }
    return scores;
}

py::array errorMap(const py::object& testGiven, const py::object& referenceGiven, const std::string& kind,
                   const py::kwargs& options) {
    Keywords given("error_map", options);
    const reference::MetricOptions metricOptions = optionsOf(given);
    given.finish();
    const std::optional<reference::ErrorMap> map = reference::errorMapOf(kind);
    if (!map)
        throw Error(ErrorKind::Usage,
                    fmt::format("kind: '{}' is no kind of map; signed, absolute, relative, flip or "
                                "hdr-flip would be right",
                                kind));
    const Image test = imageOf("test", testGiven), truth = imageOf("reference", referenceGiven);
    requireSameSize(test, "test", truth);
    const std::vector<float> values =
        unlocked([&] { return reference::errorValues(test, truth, *map, metricOptions); });
    py::array_t<float> array(std::vector<py::ssize_t>{test.height, test.width});
    std::copy(values.begin(), values.end(), array.mutable_data());
    return array;
}

struct NamedArray {
    std::string name;
    Floats values;
    int channels = 1;
};

NamedArray named(const std::string& name, const py::handle& value) {
    const Image checked = imageOf(name, value);  // the shape is one of a picture
    Floats values = floatsOf(name, value);
    return {name, values, values.ndim() == 3 ? static_cast<int>(values.shape(2)) : 1};
}

std::vector<float> numbersOf(const NamedArray& array) {
    return {array.values.data(), array.values.data() + array.values.size()};
}

// The picture first: full, or what comes first in a dict.
std::vector<NamedArray> arraysOf(const py::object& given) {
    if (!py::isinstance<py::dict>(given)) return {named("picture", given)};
    std::vector<NamedArray> arrays;
    for (const auto& [key, value] : given.cast<py::dict>()) {
        NamedArray one = named(py::str(key), value);
        arrays.insert(one.name == "full" ? arrays.begin() : arrays.end(), std::move(one));
    }
    if (arrays.empty())
        throw Error(ErrorKind::Usage, "pictures: is empty; an array or a dict of arrays would be right");
    for (const NamedArray& one : arrays)
        if (one.values.shape(0) != arrays[0].values.shape(0) ||
            one.values.shape(1) != arrays[0].values.shape(1))
            throw Error(ErrorKind::Usage, one.name + ": is of another size than " + arrays[0].name +
                                              "; the same size would be right");
    return arrays;
}

void save(const fs::path& path, const py::object& pictures, const py::object& settings) {
    const ImageSettings shown = settingsOf(settings).image;
    const io::ImageFormat format = io::imageFormatOf(path);
    const std::vector<NamedArray> arrays = arraysOf(pictures);
    const NamedArray& first = arrays.front();
    const int width = static_cast<int>(first.values.shape(1)),
              height = static_cast<int>(first.values.shape(0));
    if (format == io::ImageFormat::Png || format == io::ImageFormat::Jpg) {
        const Image image = imageOf(first.name, first.values);
        unlocked([&] {
            const io::ByteImage bytes{width, height, 3, toneMapped(image, shown)};
            format == io::ImageFormat::Png ? io::writePng(path, bytes) : io::writeJpg(path, bytes);
        });
        return;
    }
    io::FloatImage floats;
    floats.width = width;
    floats.height = height;
    floats.channels = first.channels;
    floats.pixels = numbersOf(first);
    for (std::size_t i = 1; i < arrays.size(); ++i)
        floats.layers.push_back({arrays[i].name, arrays[i].channels, numbersOf(arrays[i])});
    unlocked(
        [&] { format == io::ImageFormat::Exr ? io::writeExr(path, floats) : io::writeHdr(path, floats); });
}

py::array arrayOf(int width, int height, int channels, const std::vector<float>& pixels) {
    std::vector<py::ssize_t> shape = {height, width};
    if (channels > 1) shape.push_back(channels);
    py::array_t<float> array(shape);
    std::copy(pixels.begin(), pixels.end(), array.mutable_data());
    return array;
}

// The picture under "full", layers under their names.
py::dict read(const fs::path& path) {
    const io::FloatImage file = unlocked([&] { return io::readImage(path); });
    py::dict pictures;
    pictures["full"] = arrayOf(file.width, file.height, file.channels, file.pixels);
    for (const io::ImageLayer& layer : file.layers)
        pictures[layer.name.c_str()] = arrayOf(file.width, file.height, layer.channels, layer.pixels);
    return pictures;
}

}  // namespace

void bindPictures(py::module_& module) {
    module.def(
        "compare", &compare, py::arg("test"), py::arg("reference"),
        "How wrong a picture is: a dict of the scores that `conelight compare --json` writes.\n\n"
        "Arrays (height, width[, 3 or 4]) of linear radiance. By name: halves, two pictures whose mean is\n"
        "the reference: its noise is then not counted; exposure, stops (0); pixels_per_degree, of FLIP\n"
        "(67.02); flip, which takes most of the time (True); blocks, pixels a side of block_relrmse (4).");
    module.def("error_map", &errorMap, py::arg("test"), py::arg("reference"), py::arg("kind") = "signed",
               "Error per pixel, (height, width): 'signed', 'absolute', 'relative', 'flip' or 'hdr-flip'.\n\n"
               "By name: exposure, pixels_per_degree, as in compare.");
    module.def(
        "save", &save, py::arg("path"), py::arg("pictures"), py::arg("settings") = py::none(),
        "Writes a picture: .exr and .hdr as linear floats, .png and .jpg by the settings' tone map.\n\n"
        "pictures: an array, or a dict: the picture 'full', or else the first; the others become layers\n"
        "of an .exr.");
    module.def(
        "read", &read, py::arg("path"),
        "A picture file as a dict of float32 arrays: 'full', and the layers of an .exr. 8-bit files are\n"
        "made linear.");
}

}  // namespace conelight::python
