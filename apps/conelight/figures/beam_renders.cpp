// SPDX-License-Identifier: MIT
// Beams as figures: the drawings of their tree, and a hall of mirrors beside the path tracer.
#include <algorithm>

#include "figures/drawings/drawings.h"
#include "figures/renders.h"
#include "io/image_file.h"

namespace conelight::figures {
namespace {

constexpr const char* kHall = "builtin:mirror-hall";

Panel svgPanel(const std::string& label, const std::string& text) {
    return {label, ".svg", {text.begin(), text.end()}};
}

// A quarter of the picture's width round a place of it, each pixel as a square of four by four.
Image enlarged(const Image& image, glm::dvec2 place) {
    constexpr int kTimes = 4;
    const int width = std::max(image.width / kTimes, 1), height = std::max(image.height / kTimes, 1);
    const int left = std::clamp(int(place.x * image.width) - width / 2, 0, image.width - width);
    const int top = std::clamp(int(place.y * image.height) - height / 2, 0, image.height - height);
    Image part{kTimes * width, kTimes * height, {}};
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            part.pixels.push_back(image.pixels[std::size_t(top + y / kTimes) * std::size_t(image.width) +
                                               std::size_t(left + x / kTimes)]);
    return part;
}

}  // namespace

Panels drawBeams(Studio&) {
    return {svgPanel("a room with two mirrors from above", drawBeamPlan()),
            svgPanel("the tree of its beams", drawBeamTree())};
}

Panels renderMirrorHall(Studio& studio) {
    program::PictureRequest request =
        studio.requestOf({.scene = kHall, .mode = "beams"}, studio.scene(kHall));
    const auto draw = [&](const std::string& mode, reference::PixelFilter filter, reference::Paths paths) {
        request.mode = mode;
        request.reference.filter = filter;
        request.reference.paths = paths;
        return studio.picture(request).images.front();
    };
    const auto panel = [&](const std::string& label, const Image& image) {
        return Panel{label, ".png",
                     io::pngBytes({image.width, image.height, 3, toneMapped(image, request.settings.image)})};
    };
    using reference::Paths;
    using reference::PixelFilter;
    const Image areas = draw("beams", PixelFilter::Box, Paths::All);
    const Image points = draw("beams", PixelFilter::Center, Paths::All);
    const glm::dvec2 edges(0.52, 0.68);
    return {panel("beams", areas),
            panel("path tracer, the same light", draw("reference", PixelFilter::Box, Paths::Mirrors)),
            panel("path tracer, all light", draw("reference", PixelFilter::Box, Paths::All)),
            panel("beams, enlarged", enlarged(areas, edges)),
            panel("one point per pixel, enlarged", enlarged(points, edges))};
}

}  // namespace conelight::figures
