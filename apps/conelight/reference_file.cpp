// SPDX-License-Identifier: MIT
#include "reference_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "conelight/error.h"
#include "conelight/version.h"
#include "io/image_file.h"
#include "picture_file.h"
#include "reference/surface.h"
#include "scene_hash.h"

namespace conelight::program {
namespace {

// Goes up whenever the path tracer's pictures change, so that kept ones are not taken for today's.
constexpr int kTracerGeneration = 1;
// The same for pictures that show textures by the point; others stay what they were.
//   1: the texture's value at the pixel's centre; 2: its mean over the pixel.
constexpr int kTextureGeneration = 2;

// The same for scenes with roughness below the least that is no mirror.
//   1: the lobe of that least; 2: ideal mirrors.
constexpr int kMirrorGeneration = 2;
// The same for scenes with emissive meshes, whose layers depend on what is a small lamp.
//   1: balls; 2: boxes, too.
constexpr int kSmallLampGeneration = 2;

bool hasMirrors(const Scene& scene) {
    constexpr float kLeastRoughness = 0.045f;  // math::kMinRoughness
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        return m.roughness < kLeastRoughness || m.metallicRoughnessTexture.used();
    });
}

// Whether something may be a small lamp (light.small_lamps), which tells the layers apart.
bool hasEmissiveMeshes(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        if (instance.mesh < 0 || instance.material < 0) return false;
        const bool emits =
            scene.materials[static_cast<std::size_t>(instance.material)].emission != glm::vec3(0);
        return emits && scene.meshes[static_cast<std::size_t>(instance.mesh)].triangleCount() > 2;
    });
}

std::vector<std::pair<std::string, Image ReferencePicture::*>> layerFields() {
    return {{"direct", &ReferencePicture::direct},
            {"indirect", &ReferencePicture::indirect},
            {"diffuse", &ReferencePicture::diffuse},
            {"specular", &ReferencePicture::specular},
            {"half_a", &ReferencePicture::halfA},
            {"half_b", &ReferencePicture::halfB},
            {"indirect_half_a", &ReferencePicture::indirectA},
            {"indirect_half_b", &ReferencePicture::indirectB}};
}

Image imageOf(int width, int height, int channels, const std::vector<float>& values) {
    Image image{width, height, {}};
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::size_t step = static_cast<std::size_t>(channels);
    image.pixels.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* v = &values[i * step];
        image.pixels[i] = channels >= 3 ? glm::vec4(v[0], v[1], v[2], 1) : glm::vec4(v[0], v[0], v[0], 1);
    }
    return image;
}

std::string keyOf(const Scene& scene, const PictureRequest& request) {
    Hash hash;
    hash.add(std::string(CONELIGHT_VERSION_STRING));
    hash.add(kTracerGeneration);
    if (request.reference.filter == reference::PixelFilter::Center && reference::isTextured(scene))
        hash.add(kTextureGeneration);
    if (hasMirrors(scene)) hash.add(kMirrorGeneration);
    addScene(hash, scene);
    addCamera(hash, request.camera);
    hash.add(request.size.width);
    hash.add(request.size.height);
    const reference::PathTracerSettings& s = request.reference;
    hash.add(s.samplesPerPixel);
    hash.add(s.noise);
    hash.add(s.bounces);
    hash.add(s.seed);
    hash.add(static_cast<int>(s.filter));
    hash.add(static_cast<int>(s.estimator));
    hash.add(request.settings.light.emissiveQuads);
    if (hasEmissiveMeshes(scene)) {
        hash.add(request.settings.light.smallLamps);
        hash.add(kSmallLampGeneration);
    }
    if (s.paths != reference::Paths::All) hash.add(static_cast<int>(s.paths));
    if (!s.pixels.empty()) hash.add(s.pixels.data(), s.pixels.size());
    return hash.hex();
}

ReferencePicture fromTraced(reference::PathTracedPicture&& traced) {
    ReferencePicture picture;
    picture.full = std::move(traced.full);
    picture.direct = std::move(traced.direct);
    picture.indirect = std::move(traced.indirect);
    picture.diffuse = std::move(traced.diffuse);
    picture.specular = std::move(traced.specular);
    picture.halfA = std::move(traced.halfA);
    picture.halfB = std::move(traced.halfB);
    picture.indirectA = std::move(traced.indirectA);
    picture.indirectB = std::move(traced.indirectB);
    picture.samplesPerPixel = traced.samplesPerPixel;
    picture.noise = traced.noise;
    picture.cpuSeconds = traced.cpuSeconds;
    picture.rays = traced.rays;
    picture.origin = "rendered";
    return picture;
}

}  // namespace

const Image* ReferencePicture::part(Component component) const {
    const Image* image = nullptr;
    if (component == Component::Full) image = &full;
    if (component == Component::Direct) image = &direct;
    if (component == Component::Indirect) image = &indirect;
    if (component == Component::Diffuse) image = &diffuse;
    if (component == Component::Specular) image = &specular;
    return image != nullptr && !image->pixels.empty() ? image : nullptr;
}

void writeReference(const std::string& path, const ReferencePicture& picture, const std::string& key) {
    const WritingScope writing;
    io::FloatImage file{picture.full.width, picture.full.height, 3, rgbOf(picture.full), {}, {}};
    for (const auto& [name, field] : layerFields())
        if (!(picture.*field).pixels.empty()) file.layers.push_back({name, 3, rgbOf(picture.*field)});
    file.attributes = {{"conelight.key", key},
                       {"conelight.samplesPerPixel", std::to_string(picture.samplesPerPixel)},
                       {"conelight.noise", fmt::format("{}", picture.noise)},
                       {"conelight.cpuSeconds", fmt::format("{}", picture.cpuSeconds)},
                       {"conelight.rays", std::to_string(picture.rays)}};
    io::writeExr(path, file);
}

ReferencePicture readReference(const std::string& path) {
    const io::FloatImage file = io::readImage(path);
    ReferencePicture picture;
    picture.full = imageOf(file.width, file.height, file.channels, file.pixels);
    for (const io::ImageLayer& layer : file.layers)
        for (const auto& [name, field] : layerFields())
            if (layer.name == name)
                picture.*field = imageOf(file.width, file.height, layer.channels, layer.pixels);
    for (const auto& [name, text] : file.attributes) {
        if (name == "conelight.samplesPerPixel") picture.samplesPerPixel = std::atoi(text.c_str());
        if (name == "conelight.noise") picture.noise = std::atof(text.c_str());
        if (name == "conelight.cpuSeconds") picture.cpuSeconds = std::atof(text.c_str());
        if (name == "conelight.rays") picture.rays = std::strtoull(text.c_str(), nullptr, 10);
    }
    if (picture.halfB.pixels.empty()) picture.halfA = {};
    if (picture.indirectB.pixels.empty()) picture.indirectA = {};
    picture.origin = picture.file = path;
    return picture;
}

ReferencePicture referenceFor(PictureSource& source, const Scene& scene, const PictureRequest& request,
                              const std::string& cache, const std::string& name, Progress* progress) {
    namespace fs = std::filesystem;
    const std::string key = keyOf(scene, request);
    const fs::path path = fs::path(cache) / (name + "-" + key + ".exr");
    std::error_code ignored;
    if (!cache.empty() && fs::exists(path, ignored)) {
        ReferencePicture kept = readReference(path.string());
        kept.origin = "kept: " + path.string();
        return kept;
    }
    PictureRequest trace = request;
    trace.mode = "reference";
    trace.components = {Component::Full};
    Picture drawn = source.draw(trace, progress);
    if (drawn.stopped) {
        if (progress != nullptr) progress->finish();
        std::fprintf(stderr, "conelight: interrupted; no reference was kept\n");
        throw InterruptedError();
    }
    ReferencePicture picture = fromTraced(std::move(*drawn.traced));
    if (!cache.empty()) {
        std::error_code failure;
        fs::create_directories(cache, failure);
        if (failure)
            throw Error(ErrorKind::Runtime, cache + ": cannot make this folder: " + failure.message());
        writeReference(path.string(), picture, key);
        picture.file = path.string();
    }
    return picture;
}

}  // namespace conelight::program
