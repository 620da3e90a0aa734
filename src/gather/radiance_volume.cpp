// SPDX-License-Identifier: MIT
#include "gather/radiance_volume.h"

#include <algorithm>

#include "base/assert.h"
#include "gl/gl.h"
#include "gl/pace.h"

namespace conelight::gather {
namespace {

// Levels of which only the texels of occupied bricks are computed; the rest is cleared. Level 2 is one texel
// per brick of 4^3.
constexpr int kSparseLevels = 2;

// Variants of radiance_scatter and radiance_level.
struct ScatterKey {
    int blocks;  // 1 or 6
    bool octree;
    gl::ProgramDesc desc() const {
        return {{"gather/radiance_scatter.comp.glsl"},
                {{"DIRECTIONAL", blocks == 6 ? "1" : "0"}, {"OCTREE", octree ? "1" : "0"}}};
    }
    static std::vector<ScatterKey> all() { return {{1, false}, {6, false}, {1, true}, {6, true}}; }
};

// Which texels of a level are computed: all, those of occupied bricks, those of the octree's bricks.
enum class LevelPlaces { All, Sparse, Octree };

struct LevelKey {
    int blocks;
    OpacityModel opacity;
    LevelPlaces places;
    gl::ProgramDesc desc() const;
    static std::vector<LevelKey> all();
};

gl::ProgramDesc clearDesc() { return {{"gather/radiance_clear.comp.glsl"}, {}}; }

gl::ProgramDesc LevelKey::desc() const {
    return {{"gather/radiance_level.comp.glsl"},
            {{"DIRECTIONAL", blocks == 6 ? "1" : "0"},
             {"AREA", opacity == OpacityModel::Area ? "1" : "0"},
             {"SPARSE", places == LevelPlaces::Sparse ? "1" : "0"},
             {"OCTREE", places == LevelPlaces::Octree ? "1" : "0"}}};
}

std::vector<LevelKey> LevelKey::all() {
    std::vector<LevelKey> keys;
    for (const int blocks : {1, 6})
        for (const OpacityModel opacity : {OpacityModel::Fog, OpacityModel::Area})
            for (const LevelPlaces places : {LevelPlaces::All, LevelPlaces::Sparse, LevelPlaces::Octree})
                keys.push_back({blocks, opacity, places});
    return keys;
}

}  // namespace

RadianceVolume::RadianceVolume(const RadianceLayout& layout)
    : layout_(layout), block_(sizeof(gpu::RadianceVolume), "radiance volume block") {
    block_.update(layout.packed());
    if (isOctree()) return;
    texture_ = gl::Texture({GL_TEXTURE_3D, GL_RGBA16F, layout.blocks * layout.size.x, layout.size.y,
                            layout.size.z, layout.maxLevel + 1},
                           "radiance volume");
    texture_.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    texture_.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const unsigned axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        texture_.parameter(axis, GL_CLAMP_TO_EDGE);
}

base::Steps RadianceVolume::buildInSteps(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                                         const light::LitFaces& faces, OpacityModel opacity) {
    CONELIGHT_ASSERT(surface.grid() == layout_.grid, "the volume is laid out for another grid");
    if (isOctree()) octree_.build(device, layout_, surface);
    co_await gl::rest(device);
    {
        const gl::PassScope pass(device.profiler, "radiance volume");
        scatter(device, surface, faces);
    }
    co_await gl::rest(device);
    gl::PassSteps pass(device, "radiance levels");
    for (int level = 1; level <= layout_.maxLevel; ++level) {
        gl::barrier(gl::Access::ImageAccess);
        if (isOctree())
            buildOctreeLevel(device, opacity, level);
        else
            buildLevel(device, surface, opacity, level);
        co_await pass.rest();
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
}

void RadianceVolume::clearLevel(const gl::Device& device, int level) {
    if (device.profile == gl::ExecutionProfile::Processor)
        return texture_.clear(level, GL_RGBA, GL_FLOAT, nullptr);
    gl::Inputs inputs;
    inputs.image("level", texture_, gl::ImageUse::Write, level);
    const auto edge = [level](int texels) { return std::max(texels >> level, 1); };
    device.get(clearDesc())
        .dispatch(inputs, edge(texture_.width()), edge(texture_.height()), edge(texture_.depth()));
}

void RadianceVolume::scatter(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                             const light::LitFaces& faces) {
    gl::Inputs inputs;
    inputs.add(surface).add(faces).uniform("RadianceVolumeBlock", block_);
    if (isOctree()) {
        octree_.declareFill(inputs, 0);
        inputs.image("level0", octree_.bricks(), gl::ImageUse::Write);
    } else {
        for (int level = 0; level <= std::min(kSparseLevels, layout_.maxLevel); ++level)
            clearLevel(device, level);
        if (device.profile == gl::ExecutionProfile::Gpu) gl::barrier(gl::Access::ImageAccess);
        inputs.image("level0", texture_, gl::ImageUse::Write);
    }
    device.get(ScatterKey{layout_.blocks, isOctree()}.desc()).dispatchLinear(inputs, surface.mostVoxels());
}

void RadianceVolume::buildLevel(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                                OpacityModel opacity, int level) {
    gl::Inputs inputs;
    inputs.add(surface)
        .uniform("RadianceVolumeBlock", block_)
        .image("fine", texture_, gl::ImageUse::Read, level - 1)
        .image("coarse", texture_, gl::ImageUse::Write, level);
    const bool sparse = level <= kSparseLevels;
    const LevelKey key{layout_.blocks, opacity, sparse ? LevelPlaces::Sparse : LevelPlaces::All};
    if (sparse) {
        const std::size_t texelsPerBrick = level == 1 ? 8 : 1;
        device.get(key.desc())
            .dispatchLinear(inputs, surface.mostOccupiedBricks() * texelsPerBrick *
                                        static_cast<std::size_t>(layout_.blocks));
    } else {
        device.get(key.desc())
            .dispatch(inputs, texture_.width(level), texture_.height(level), texture_.depth(level));
    }
}

void RadianceVolume::buildOctreeLevel(const gl::Device& device, OpacityModel opacity, int level) {
    const LevelKey key{layout_.blocks, opacity, LevelPlaces::Octree};
    gl::Inputs inputs;
    octree_.declareFill(inputs, level);
    inputs.uniform("RadianceVolumeBlock", block_)
        .image("fine", octree_.bricks(), gl::ImageUse::Read)
        .image("coarse", octree_.bricks(), gl::ImageUse::Write);
    device.get(key.desc())
        .dispatchLinear(inputs, std::size_t{OCTREE_BRICK_TEXELS} * octree_.brickCount(level));
}

void RadianceVolume::declare(gl::Inputs& inputs) const {
    inputs.uniform("RadianceVolumeBlock", block_);
    if (isOctree())
        inputs.add(octree_);
    else
        inputs.texture("radianceVolume", texture_);
}

std::vector<gl::ProgramDesc> RadianceVolume::programDescs() {
    std::vector<gl::ProgramDesc> descs = {clearDesc()};
    for (const ScatterKey& key : ScatterKey::all()) descs.push_back(key.desc());
    for (const LevelKey& key : LevelKey::all()) descs.push_back(key.desc());
    for (const gl::ProgramDesc& desc : RadianceOctree::programDescs()) descs.push_back(desc);
    return descs;
}

}  // namespace conelight::gather
