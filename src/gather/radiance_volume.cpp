// SPDX-License-Identifier: MIT
#include "gather/radiance_volume.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "gl/gl.h"

namespace conelight::gather {
namespace {

// Levels of which only the texels of occupied bricks are computed; the rest is cleared. Level 2 is one texel
// per brick of 4^3.
constexpr int kSparseLevels = 2;

// Variants of radiance_scatter and radiance_level.
struct ScatterKey {
    int blocks;  // 1 or 6
    gl::ProgramDesc desc() const {
        return {{"gather/radiance_scatter.comp.glsl"}, {{"DIRECTIONAL", blocks == 6 ? "1" : "0"}}};
    }
    static std::vector<ScatterKey> all() { return {{1}, {6}}; }
};

struct LevelKey {
    int blocks;
    OpacityModel opacity;
    bool sparse;
    gl::ProgramDesc desc() const;
    static std::vector<LevelKey> all();
};

gl::ProgramDesc LevelKey::desc() const {
    return {{"gather/radiance_level.comp.glsl"},
            {{"DIRECTIONAL", blocks == 6 ? "1" : "0"},
             {"AREA", opacity == OpacityModel::Area ? "1" : "0"},
             {"SPARSE", sparse ? "1" : "0"}}};
}

std::vector<LevelKey> LevelKey::all() {
    std::vector<LevelKey> keys;
    for (const int blocks : {1, 6})
        for (const OpacityModel opacity : {OpacityModel::Fog, OpacityModel::Area})
            for (const bool sparse : {false, true}) keys.push_back({blocks, opacity, sparse});
    return keys;
}

int roundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

gpu::RadianceVolume RadianceLayout::packed() const {
    gpu::RadianceVolume v{};
    const float h = grid.voxelSize;
    v.origin = grid.origin;
    v.voxelSize = h;
    v.inverseVoxelSize = 1.0f / h;
    v.extent = glm::vec3(size) * h;
    v.inverseExtent = 1.0f / v.extent;
    v.maxLevel = static_cast<float>(maxLevel);
    v.sizeX = static_cast<std::uint32_t>(size.x);
    v.sizeY = static_cast<std::uint32_t>(size.y);
    v.sizeZ = static_cast<std::uint32_t>(size.z);
    v.halfTexelX = 0.5f / static_cast<float>(size.x);
    return v;
}

RadianceLayout radianceLayout(const voxels::VoxelGrid& grid, VolumeDirections directional,
                              float maxFootprint) {
    RadianceLayout layout;
    layout.grid = grid;
    layout.blocks = directional == VolumeDirections::Six ? 6 : 1;
    const int longest = std::max({grid.size.x, grid.size.y, grid.size.z});
    // The coarsest level is the one whose texels are nearest to the largest footprint.
    const float footprint = std::clamp(maxFootprint, 0.0f, 1.0f) * static_cast<float>(longest);
    layout.maxLevel = footprint > 1.0f ? static_cast<int>(std::lround(std::log2(footprint))) : 0;
    const int texel = 1 << layout.maxLevel;
    layout.size = {roundUp(grid.size.x, texel), roundUp(grid.size.y, texel), roundUp(grid.size.z, texel)};
    return layout;
}

RadianceVolume::RadianceVolume(const RadianceLayout& layout)
    : layout_(layout),
      texture_({GL_TEXTURE_3D, GL_RGBA16F, layout.blocks * layout.size.x, layout.size.y, layout.size.z,
                layout.maxLevel + 1},
               "radiance volume"),
      block_(sizeof(gpu::RadianceVolume), "radiance volume block") {
    block_.update(layout.packed());
    texture_.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    texture_.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const unsigned axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        texture_.parameter(axis, GL_CLAMP_TO_EDGE);
}

void RadianceVolume::build(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                           const light::LitFaces& faces, OpacityModel opacity) {
    CONELIGHT_ASSERT(surface.grid() == layout_.grid, "the volume is laid out for another grid");
    {
        const gl::PassScope pass(device.profiler, "radiance volume");
        for (int level = 0; level <= std::min(kSparseLevels, layout_.maxLevel); ++level)
            texture_.clear(level, GL_RGBA, GL_FLOAT, nullptr);
        gl::Inputs inputs;
        inputs.add(surface)
            .add(faces)
            .uniform("RadianceVolumeBlock", block_)
            .image("level0", texture_, gl::ImageUse::Write);
        device.get(ScatterKey{layout_.blocks}.desc()).dispatchLinear(inputs, surface.voxelCount());
    }
    const gl::PassScope pass(device.profiler, "radiance levels");
    buildLevels(device, surface, opacity);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
}

void RadianceVolume::buildLevels(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                                 OpacityModel opacity) {
    for (int level = 1; level <= layout_.maxLevel; ++level) {
        gl::barrier(gl::Access::ImageAccess);
        gl::Inputs inputs;
        inputs.add(surface)
            .uniform("RadianceVolumeBlock", block_)
            .image("fine", texture_, gl::ImageUse::Read, level - 1)
            .image("coarse", texture_, gl::ImageUse::Write, level);
        const bool sparse = level <= kSparseLevels;
        const gl::Program& program = device.get(LevelKey{layout_.blocks, opacity, sparse}.desc());
        if (sparse) {
            const std::size_t texelsPerBrick = level == 1 ? 8 : 1;
            program.dispatchLinear(inputs, surface.occupiedBrickCount() * texelsPerBrick *
                                               static_cast<std::size_t>(layout_.blocks));
        } else {
            program.dispatch(inputs, texture_.width(level), texture_.height(level), texture_.depth(level));
        }
    }
}

void RadianceVolume::sampleBetweenLevels(bool between) {
    texture_.parameter(GL_TEXTURE_MIN_FILTER, between ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_NEAREST);
}

void RadianceVolume::declare(gl::Inputs& inputs) const {
    inputs.uniform("RadianceVolumeBlock", block_).texture("radianceVolume", texture_);
}

std::vector<gl::ProgramDesc> RadianceVolume::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const ScatterKey& key : ScatterKey::all()) descs.push_back(key.desc());
    for (const LevelKey& key : LevelKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
