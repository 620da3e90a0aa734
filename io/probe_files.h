// SPDX-License-Identifier: MIT
// Probe volumes as files: a JSON that describes them, and pictures with their values, one tile a probe.
// Layout: docs/guide/bake.md. This is a table of bytes; what the values mean is whoever bakes' business.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace conelight::io {

struct ProbeRecord {
    glm::vec3 position{0};
    bool active = false;
    std::array<glm::vec3, 9> harmonics{};
};

struct ProbeFiles {
    std::string scene;  // as it was named
    glm::vec3 origin{0}, spacing{1};
    glm::ivec3 counts{1};
    std::vector<ProbeRecord> probes;
    // Maps of one probe have side x side texels, row by row, probes in the order of `probes`.
    int irradianceSide = 0, distanceSide = 0;
    std::vector<glm::vec3> irradiance;
    std::vector<glm::vec2> distance;
    int samples = 0;
    std::uint32_t seed = 0;
};

// FOLDER/probes.json, probes_irradiance.exr and probes_distance.exr; the JSON last. Throws Error(Usage) when
// one of them is there and `overwrite` is not given, Error(Runtime) that names the path.
void writeProbes(const std::filesystem::path& folder, const ProbeFiles& volume, bool overwrite);
// Before long work: throws what writeProbes would.
void checkProbeFolder(const std::filesystem::path& folder, bool overwrite);

// All maps as one picture: column x + counts.x * z, row y, each map with a border of one texel that continues
// it over its edges, so that a sampler may filter. `channels` values a texel.
FloatImage probeAtlas(const glm::ivec3& counts, int side, int channels, const std::vector<float>& texels);

}  // namespace conelight::io
