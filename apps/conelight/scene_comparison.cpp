// SPDX-License-Identifier: MIT
#include "scene_comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "conelight/error.h"
#include "reference/seen_pixels.h"

namespace conelight::program {
namespace {

std::string nameOf(Component component) {
    Settings settings;
    settings.component = component;
    return getSetting(settings, "component");
}

Image difference(const Image& a, const Image& b) {
    Image result = a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] -= glm::vec4(glm::vec3(b.pixels[i]), 0);
    return result;
}

// The truth as another mode sees it: no halves, since it has no noise of its own.
ReferencePicture drawnReference(PictureSource& source, const PictureRequest& request, Progress& progress) {
    PictureRequest draw = request;
    draw.components = {Component::Full, Component::Direct, Component::Indirect, Component::Diffuse,
                       Component::Specular};
    Picture picture = source.draw(draw, &progress);
    if (picture.stopped) throw InterruptedError();
    ReferencePicture reference;
    Image* const parts[] = {&reference.full, &reference.direct, &reference.indirect, &reference.diffuse,
                            &reference.specular};
    for (std::size_t i = 0; i < std::size(parts); ++i) *parts[i] = std::move(picture.images[i]);
    reference.origin = "mode " + request.mode;
    return reference;
}

ReferencePicture referenceOf(const Scene& scene, const std::string& name,
                             const SceneComparisonRequest& request, PictureSource& source,
                             const PictureRequest& base, Progress& progress) {
    if (!request.referenceFile.empty()) {
        ReferencePicture reference = readReference(request.referenceFile);
        const Image& image = reference.full;
        if (image.width != base.size.width || image.height != base.size.height)
            throw Error(
                ErrorKind::BadInput,
                fmt::format("{}: has {} x {} pixels; --size {}x{} would be right", request.referenceFile,
                            image.width, image.height, image.width, image.height));
        return reference;
    }
    if (request.against == "reference")
        return referenceFor(source, scene, base, request.cache, "reference-" + fileStem(name), &progress);
    PictureRequest draw = base;
    draw.mode = request.against;
    return drawnReference(source, draw, progress);
}

// Halves of a part; those of direct light are what the others leave.
struct PartHalves {
    Image a, b;
    explicit operator bool() const { return !a.pixels.empty(); }
};
PartHalves halvesOf(const ReferencePicture& reference, Component component) {
    if (!reference.hasHalves()) return {};
    if (component == Component::Full) return {reference.halfA, reference.halfB};
    if (reference.indirectA.pixels.empty()) return {};
    if (component == Component::Indirect) return {reference.indirectA, reference.indirectB};
    if (component == Component::Direct)
        return {difference(reference.halfA, reference.indirectA),
                difference(reference.halfB, reference.indirectB)};
    return {};
}

// Of --pixels: which materials count.
reference::MaterialChoice choiceOf(const std::string& pixels) {
    const auto isGlass = [](const Material& m) { return m.transmission > 0; };
    if (pixels == "glass") return isGlass;
    if (pixels == "solid") return [=](const Material& m) { return isGlass(m) && m.thickness > 0; };
    if (pixels == "pane") return [=](const Material& m) { return isGlass(m) && !(m.thickness > 0); };
    const std::string before = "material:";
    if (pixels.compare(0, before.size(), before) == 0)
        return [name = pixels.substr(before.size())](const Material& m) { return m.name == name; };
    throw Error(ErrorKind::Usage, "--pixels: '" + pixels +
                                      "' is not usable; glass, solid, pane or material:NAME would be right");
}

std::vector<std::uint8_t> chosenPixels(const Scene& scene, const std::string& name, const std::string& pixels,
                                       const PictureRequest& base) {
    if (pixels.empty()) return {};
    std::vector<std::uint8_t> chosen = reference::pixelsThatSee(
        scene, base.camera, base.size.width, base.size.height, base.reference.filter, choiceOf(pixels));
    if (std::count(chosen.begin(), chosen.end(), 1) == 0)
        throw Error(ErrorKind::Usage, "--pixels " + pixels + ": no pixel of " + name +
                                          " shows it; a camera that sees it would be right");
    return chosen;
}

ComponentResult measured(Image image, Component component, const ReferencePicture& reference,
                         const reference::MetricOptions& metrics) {
    const Image* truth = reference.part(component);
    if (truth == nullptr)
        throw Error(ErrorKind::BadInput, fmt::format("{}: has no layer '{}'; --components full, or a picture "
                                                     "of `conelight render --mode reference --aov "
                                                     "direct,indirect,half_a,half_b`, would be right",
                                                     reference.origin, nameOf(component)));
    ComponentResult result{component, nameOf(component), std::move(image), {}, false};
    const PartHalves halves = halvesOf(reference, component);
    result.withHalves = static_cast<bool>(halves);
    std::optional<reference::Halves> given;
    if (halves) given = reference::Halves{&halves.a, &halves.b};
    result.metrics = reference::compareImages(result.image, *truth, metrics, given);
    return result;
}

}  // namespace

std::string fileStem(const std::string& text) {
    std::string stem;
    for (const char c : text) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
        if (plain)
            stem += c;
        else if (!stem.empty() && stem.back() != '_')
            stem += '_';
    }
    constexpr std::size_t kLongest = 120;  // file systems end at 255, and more is appended
    return stem.substr(stem.size() > kLongest ? stem.size() - kLongest : 0);
}

SceneComparison compareVariants(const Scene& scene, const std::string& name,
                                const SceneComparisonRequest& request, Progress& progress,
                                PictureSource& source) {
    source.setScene(scene);
    PictureRequest base = request.picture;
    base.settings = Variant{"cones", {}}.settingsFor(scene, request.view);
    base.camera = cameraFor(scene, request.view);
    base.timedFrames = 0;
    SceneComparison comparison;
    comparison.scene = name;
    comparison.against = request.referenceFile.empty() ? request.against : request.referenceFile;
    comparison.camera = base.camera;
    comparison.size = base.size;
    comparison.pixels = request.pixels;
    comparison.measured = chosenPixels(scene, name, request.pixels, base);
    base.reference.pixels = comparison.measured;
    reference::MetricOptions metrics = request.metrics;
    metrics.pixels = comparison.measured;
    comparison.reference = referenceOf(scene, name, request, source, base, progress);
    for (const Variant& variant : request.variants) {
        progress.show(name + ": " + variant.label());
        PictureRequest draw = request.picture;
        draw.mode = variant.mode;
        draw.settings = variant.settingsFor(scene, request.view);
        draw.camera = base.camera;
        draw.components = request.components;
        Picture picture = source.draw(draw, &progress);
        if (picture.stopped) throw InterruptedError();
        VariantResult result{variant, draw.settings, {}, picture.cost, picture.baked, picture.beams};
        progress.show(name + ": " + variant.label() + ": measuring");
        for (std::size_t i = 0; i < request.components.size(); ++i)
            result.components.push_back(
                measured(std::move(picture.images[i]), request.components[i], comparison.reference, metrics));
        comparison.variants.push_back(std::move(result));
    }
    return comparison;
}

}  // namespace conelight::program
