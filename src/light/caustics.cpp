// SPDX-License-Identifier: MIT
#include "light/caustics.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gl/gl.h"
#include "gl/pace.h"
#include "light/lights.h"
#include "scene/gpu_lights.h"
#include "voxels/voxel_grid.h"

namespace conelight::light {
namespace {

// Texels per edge of a map: 0.7 degrees each, half as much light as a path of the default number brings.
constexpr std::uint32_t kEdge = 256;
constexpr const char* kPass = "caustics";
// Points of a rectangle per edge that paths start from. What lies between is filled in by their differences.
constexpr std::uint32_t kLampGrid = 4;
// All light of a solid comes to so many counts: no path brings more than a word, the rounding of the weakest is
// below a thousandth, and a hundred such sums fit into two words.
constexpr float kCounts = 0x1p34f;

gl::ProgramDesc pathsDesc() {
    return {{"light/caustic_paths.comp.glsl"}, {{"GLASS", "1"}, {"LIGHTS_SHADOWS", "0"}}};
}
gl::ProgramDesc sumsDesc() { return {{"light/caustic_sums.comp.glsl"}, {}}; }
gl::ProgramDesc mapDesc() { return {{"light/caustic_map.comp.glsl"}, {}}; }

// W that a light sends towards a ball, in its strongest channel; of those with a falloff of their own, about.
float fluxTowards(const gpu::Light& light, const glm::vec3& middle, float radius) {
    const float intensity = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    if (light.type == LIGHT_DIRECTIONAL) return intensity * glm::pi<float>() * radius * radius;
    const float distance = glm::length(middle - light.position);
    const float sine = std::min(radius / std::max(distance, 1e-6f), 1.0f);
    const float solidAngle = 2 * glm::pi<float>() * sine * sine / (1 + std::sqrt(1 - sine * sine));
    if (light.type == LIGHT_RECT) return intensity * solidAngle * scene::areaOf(light);
    if (light.customFalloff == 0) return intensity * solidAngle;
    const float d2 = distance * distance;
    return intensity * solidAngle * d2 / glm::dot(light.falloff, glm::vec3(1, distance, d2));
}

// Of so many texels per edge. Maps with levels and filters alike are one kernel to llvmpipe
// (gl/sampler_slots.h), so what stands for none has two.
gl::Texture mapOf(int edge, int layers) {
    gl::Texture map({GL_TEXTURE_2D_ARRAY, GL_RGBA32F, edge, edge, layers, 0}, "caustic map");
    map.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    map.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    map.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    map.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return map;
}

float farFrom(const glm::vec3& middle, const voxels::VoxelGrid& grid) {
    const glm::vec3 extent = glm::vec3(grid.size) * grid.voxelSize;
    return glm::length(middle - (grid.origin + 0.5f * extent)) + glm::length(extent);
}

}  // namespace

void Caustics::clear() {
    constants_ = {};
    constants_.edge = kEdge;
    if (!block_) block_ = gl::Buffer(sizeof(gpu::CausticConstants), "caustic constants");
    block_.update(constants_);
    if (!map_) map_ = mapOf(2, 1);
}

void Caustics::layOut(std::size_t solids, int paths) {
    if (!passBlock_) passBlock_ = gl::Buffer(sizeof(gpu::CausticPass), "caustic pass");
    constexpr std::size_t kTexels = CAUSTIC_LEVEL_START(kEdge, CAUSTIC_LEVELS);
    if (!sums_) sums_ = gl::Buffer(kTexels * CAUSTIC_WORDS * sizeof(std::uint32_t), "caustic sums");
    const std::size_t bytes =
        std::size_t{CAUSTIC_WAYS} * static_cast<std::size_t>(paths) * sizeof(gpu::CausticEnd);
    if (ends_.bytes() < bytes) {
        ends_ = {};
        ends_ = gl::Buffer(bytes, "caustic ends");
    }
    const int layers = static_cast<int>(solids);
    if (map_.width() == kEdge && map_.depth() == layers) return;
    map_ = {};
    map_ = mapOf(kEdge, layers);
}

base::Steps Caustics::castInSteps(const gl::Device& device, const Inputs& inputs,
                                  const std::vector<scene::GlassSolid>& solids, int paths) {
    const std::size_t count = std::min(solids.size(), std::size_t{CAUSTIC_SOLIDS});
    layOut(count, paths);
    constants_ = {};
    constants_.count = static_cast<std::uint32_t>(count);
    constants_.edge = kEdge;
    constants_.voxelSize = inputs.voxels.grid().voxelSize;
    for (std::size_t i = 0; i < count; ++i) {
        constants_.middle[i] = glm::vec4(solids[i].middle, solids[i].radius);
        if (!solids[i].isPane) constants_.turnsAll |= 1u << i;
    }
    block_.update(constants_);
    for (std::uint32_t i = 0; i < count; ++i) co_await castSolid(device, inputs, i, paths);
    const gl::PassScope pass(device.profiler, kPass);
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
    map_.generateMipmaps();
    gl::barrier(gl::Access::TextureFetch);
}

// The paths of one light after the other, and their sum.
base::Steps Caustics::castSolid(const gl::Device& device, const Inputs& inputs, std::uint32_t solid,
                                int paths) {
    gl::PassSteps pass(device, kPass);
    const std::vector<gpu::Light>& table = inputs.lights.table();
    gpu::CausticPass cast{};
    cast.middle = glm::vec3(constants_.middle[solid]);
    cast.radius = constants_.middle[solid].w;
    cast.solid = solid;
    cast.edge = kEdge;
    cast.far = farFrom(cast.middle, inputs.voxels.grid().coarsest());
    float flux = 0;
    for (const gpu::Light& light : table) flux += fluxTowards(light, cast.middle, cast.radius);
    cast.scale = kCounts / std::max(flux, 1e-20f);
    gl::Inputs given;
    given.add(inputs.scene).add(inputs.lights).add(inputs.voxels);
    given.uniform("CausticPassBlock", passBlock_)
        .storage("CausticEnds", ends_)
        .storage("CausticSums", sums_)
        .image("causticLayers", map_, gl::ImageUse::Write);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Update);
    sums_.clear();
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        // Too many for paths of their own.
        if (inputs.lights.drawsLamps() && table[i].type <= LIGHT_SPOT) continue;
        cast.light = i;
        cast.lampGrid = table[i].type == LIGHT_RECT ? kLampGrid : 1;
        cast.grid = static_cast<std::uint32_t>(std::sqrt(static_cast<float>(paths))) / cast.lampGrid;
        const std::size_t starts = std::size_t{cast.grid} * cast.grid * cast.lampGrid * cast.lampGrid;
        passBlock_.update(cast);
        device.get(pathsDesc()).dispatchLinear(given, CAUSTIC_WAYS * starts);
        gl::barrier(gl::Access::ShaderStorage);
        co_await pass.rest();
        device.get(sumsDesc()).dispatchLinear(given, CAUSTIC_WAYS * starts);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::Update);
        co_await pass.rest();
    }
    for (cast.level = CAUSTIC_LEVELS; cast.level-- > 0;) {
        passBlock_.update(cast);
        device.get(mapDesc()).dispatch(given, kEdge >> cast.level, kEdge >> cast.level);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::Update);
    }
}

void Caustics::declare(gl::Inputs& inputs) const {
    inputs.uniform("CausticBlock", block_).texture("causticMap", map_);
}

std::vector<gl::ProgramDesc> Caustics::programDescs() { return {pathsDesc(), sumsDesc(), mapDesc()}; }

}  // namespace conelight::light
