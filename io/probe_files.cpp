// SPDX-License-Identifier: MIT
#include "io/probe_files.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "conelight/error.h"
#include "conelight/version.h"
#include "io/files.h"

namespace conelight::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNames[] = {"probes_irradiance.exr", "probes_distance.exr", "probes.json"};

template <class Vector>
Json listOf(const Vector& v) {
    Json list = Json::array();
    for (int i = 0; i < Vector::length(); ++i) list.push_back(v[i]);
    return list;
}

template <class Vector>
std::vector<float> flat(const std::vector<Vector>& values) {
    std::vector<float> result;
    result.reserve(values.size() * Vector::length());
    for (const Vector& v : values)
        for (int i = 0; i < Vector::length(); ++i) result.push_back(v[i]);
    return result;
}

Json described(const ProbeFiles& volume) {
    Json root;
    root["format"] = "conelight-probes";
    root["version"] = 1;
    root["generator"] = std::string("conelight ") + CONELIGHT_VERSION_STRING;
    root["scene"] = volume.scene;
    root["samples"] = volume.samples;
    root["seed"] = volume.seed;
    root["grid"] = {{"origin", listOf(volume.origin)},
                    {"spacing", listOf(volume.spacing)},
                    {"counts", listOf(volume.counts)}};
    root["irradiance"] = {{"file", kNames[0]}, {"side", volume.irradianceSide}, {"border", 1}};
    root["distance"] = {{"file", kNames[1]}, {"side", volume.distanceSide}, {"border", 1}};
    Json list = Json::array();
    for (const ProbeRecord& probe : volume.probes) {
        Json harmonics = Json::array();
        for (const glm::vec3& c : probe.harmonics) harmonics.push_back(listOf(c));
        list.push_back({{"position", listOf(probe.position)}, {"active", probe.active}, {"sh", harmonics}});
    }
    root["probes"] = std::move(list);
    return root;
}

}  // namespace

FloatImage probeAtlas(const glm::ivec3& counts, int side, int channels, const std::vector<float>& texels) {
    const int tile = side + 2;
    FloatImage image;
    image.width = tile * counts.x * counts.z;
    image.height = tile * counts.y;
    image.channels = 3;
    image.pixels.assign(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                        0);
    for (int py = 0; py < image.height; ++py)
        for (int px = 0; px < image.width; ++px) {
            const int column = px / tile, y = py / tile;
            const int probe = column % counts.x + counts.x * (y + counts.y * (column / counts.x));
            int u = px % tile - 1, v = py % tile - 1;
            if (u < 0 || u >= side) {
                u = u < 0 ? 0 : side - 1;
                v = side - 1 - v;
            }
            if (v < 0 || v >= side) {
                v = v < 0 ? 0 : side - 1;
                u = side - 1 - u;
            }
            const std::size_t from =
                (static_cast<std::size_t>(probe) * static_cast<std::size_t>(side * side) +
                 static_cast<std::size_t>(u + side * v)) *
                static_cast<std::size_t>(channels);
            const std::size_t to = 3 * (static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(px));
            for (int c = 0; c < channels; ++c)
                image.pixels[to + static_cast<std::size_t>(c)] = texels[from + static_cast<std::size_t>(c)];
        }
    return image;
}

void checkProbeFolder(const std::filesystem::path& folder, bool overwrite) {
    checkFolder(folder, {std::begin(kNames), std::end(kNames)}, overwrite);
}

void writeProbes(const std::filesystem::path& folder, const ProbeFiles& volume, bool overwrite) {
    checkProbeFolder(folder, overwrite);
    writeExr(folder / kNames[0],
             probeAtlas(volume.counts, volume.irradianceSide, 3, flat(volume.irradiance)));
    writeExr(folder / kNames[1], probeAtlas(volume.counts, volume.distanceSide, 2, flat(volume.distance)));
    const std::string text = described(volume).dump(1) + "\n";
    writeFile(folder / kNames[2], {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace conelight::io
