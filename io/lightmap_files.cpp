// SPDX-License-Identifier: MIT
#include "io/lightmap_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "conelight/version.h"
#include "io/files.h"
#include "io/image_file.h"

namespace conelight::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char *kScene = "scene.glb", *kJson = "lightmaps.json";

std::string pictureName(std::size_t map) { return fmt::format("lightmap_{}.exr", map); }
std::string pngName(std::size_t map) { return fmt::format("lightmap_{}.png", map); }
std::string hdrName(std::size_t map) { return fmt::format("lightmap_{}.hdr", map); }
std::string directionName(std::size_t map) { return fmt::format("lightmap_{}_direction.exr", map); }

FloatImage floatsOf(const glm::ivec2& size, const std::vector<glm::vec3>& texels) {
    FloatImage image;
    image.width = size.x;
    image.height = size.y;
    image.channels = 3;
    image.pixels.reserve(3 * texels.size());
    for (const glm::vec3& texel : texels)
        for (int c = 0; c < 3; ++c) image.pixels.push_back(texel[c]);
    return image;
}

float peakOf(const LightmapPicture& map) {
    float peak = 0;
    for (const glm::vec3& texel : map.irradiance) peak = std::max({peak, texel.r, texel.g, texel.b});
    return peak > 0 ? peak : 1.0f;
}

WordImage wordsOf(const LightmapPicture& map, float range) {
    WordImage image;
    image.width = map.size.x;
    image.height = map.size.y;
    image.pixels.reserve(3 * map.irradiance.size());
    for (const glm::vec3& texel : map.irradiance)
        for (int c = 0; c < 3; ++c)
            image.pixels.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * texel[c] / range)));
    return image;
}

Json described(const Scene& scene, const LightmapFiles& files) {
    Json root;
    root["format"] = "conelight-lightmaps";
    root["version"] = 1;
    root["generator"] = std::string("conelight ") + CONELIGHT_VERSION_STRING;
    root["scene"] = files.scene;
    root["file"] = kScene;
    root["texel"] = files.texel;
    root["samples"] = files.samples;
    root["seed"] = files.seed;
    root["light"] = files.direct ? "all" : "indirect";
    for (std::size_t i = 0; i < files.maps.size(); ++i) {
        const LightmapPicture& map = files.maps[i];
        Json one = {{"irradiance", pictureName(i)},
                    {"hdr", hdrName(i)},
                    {"png", {{"file", pngName(i)}, {"range", peakOf(map)}}},
                    {"size", {map.size.x, map.size.y}}};
        if (!map.direction.empty()) one["direction"] = directionName(i);
        root["maps"].push_back(one);
    }
    Json instances = Json::array();
    for (std::size_t i = 0; i < files.places.instances.size(); ++i) {
        const GltfLightmaps::Place& place = files.places.instances[i];
        if (place.map < 0) continue;
        instances.push_back({{"name", scene.instances[i].name},
                             {"map", place.map},
                             {"offset", {place.offset.x, place.offset.y}},
                             {"scale", {place.scale.x, place.scale.y}}});
    }
    root["instances"] = std::move(instances);
    return root;
}

}  // namespace

void checkLightmapFolder(const std::filesystem::path& folder, std::size_t maps, bool directional,
                         bool overwrite) {
    std::vector<std::string> names = {kScene, kJson};
    for (std::size_t i = 0; i < maps; ++i) {
        names.push_back(pictureName(i));
        names.push_back(hdrName(i));
        names.push_back(pngName(i));
        if (directional) names.push_back(directionName(i));
    }
    checkFolder(folder, names, overwrite);
}

std::vector<std::string> writeLightmaps(const std::filesystem::path& folder, const Scene& scene,
                                        const LightmapFiles& files, bool overwrite) {
    const bool directional = !files.maps.empty() && !files.maps[0].direction.empty();
    checkLightmapFolder(folder, files.maps.size(), directional, overwrite);
    for (std::size_t i = 0; i < files.maps.size(); ++i) {
        const LightmapPicture& map = files.maps[i];
        const FloatImage irradiance = floatsOf(map.size, map.irradiance);
        writeExr(folder / pictureName(i), irradiance);
        writeHdr(folder / hdrName(i), irradiance);
        writePng16(folder / pngName(i), wordsOf(map, peakOf(map)));
        if (directional) writeExr(folder / directionName(i), floatsOf(map.size, map.direction));
    }
    const std::vector<std::string> notes = writeGltf(folder / kScene, scene, overwrite, &files.places);
    // Names come from files in any encoding; JSON wants UTF-8.
    const std::string text =
        described(scene, files).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    writeFile(folder / kJson, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    return notes;
}

}  // namespace conelight::io
