// SPDX-License-Identifier: MIT
#include "image/voxel_view.h"

#include <algorithm>
#include <cmath>

#include "gl/gl.h"

namespace conelight::image {
namespace {

// SOURCE of the shader.
constexpr int kSurfaceVoxels = 0, kVoxelVolume = 1, kRadianceVolume = 2, kRadianceOctree = 3,
              kVoxelOctree = 4;
constexpr int kCoarsest = 8;  // view.voxel_level
// Bricks to each side that are known to be empty, a power of two: a leap of 68 voxels, half of a large room.
constexpr int kReach = 8;

// SHAPE of the shader.
int shapeNumber(VoxelShape shape) {
    switch (shape) {
        case VoxelShape::Edges:
            return 1;
        case VoxelShape::Faces:
            return 2;
        case VoxelShape::Volume:
            return 3;
        case VoxelShape::Surfaces:
            return 4;
        default:
            return 0;
    }
}

struct ViewKey {
    int source;
    VoxelShape shape;
    bool among, directional;

    gl::ProgramDesc desc() const {
        return {{"image/voxel_view.comp.glsl"},
                {{"SOURCE", std::to_string(source)},
                 {"SHAPE", std::to_string(shapeNumber(shape))},
                 {"AMONG", among ? "1" : "0"},
                 {"DIRECTIONAL", directional ? "1" : "0"}}};
    }
    static std::vector<ViewKey> all() {
        std::vector<ViewKey> keys;
        for (const VoxelShape shape : {VoxelShape::Cubes, VoxelShape::Edges, VoxelShape::Faces,
                                       VoxelShape::Volume, VoxelShape::Surfaces}) {
            for (const bool among : {false, true}) {
                if (among && shape == VoxelShape::Surfaces) continue;
                keys.push_back({kSurfaceVoxels, shape, among, false});
                if (shape == VoxelShape::Faces) continue;
                keys.push_back({kVoxelVolume, shape, among, false});
                keys.push_back({kVoxelOctree, shape, among, false});
                for (const int source : {kRadianceVolume, kRadianceOctree})
                    for (const bool directional : {false, true})
                        keys.push_back({source, shape, among, directional});
            }
        }
        return keys;
    }
};

struct LevelKey {
    bool first;  // from faces, else from the level before
    gl::ProgramDesc desc() const {
        return {{"image/voxel_view_level.comp.glsl"}, {{"FIRST", first ? "1" : "0"}}};
    }
    static std::vector<LevelKey> all() { return {{true}, {false}}; }
};

struct OccupiedKey {
    int source;
    bool halves;  // zero means empty; counts for a VoxelVolume
    gl::ProgramDesc desc() const {
        return {{"image/voxel_view_occupied.comp.glsl"},
                {{"SOURCE", std::to_string(source)}, {"HALVES", halves ? "1" : "0"}}};
    }
    static std::vector<OccupiedKey> all() {
        return {{kSurfaceVoxels, true}, {kVoxelVolume, true}, {kVoxelVolume, false}, {kVoxelOctree, true}};
    }
};

struct ReachKey {
    int reach;
    gl::ProgramDesc desc() const {
        return {{"image/voxel_view_reach.comp.glsl"}, {{"REACH", std::to_string(reach)}}};
    }
    static std::vector<ReachKey> all() {
        std::vector<ReachKey> keys;
        for (int reach = 1; reach <= kReach; reach *= 2) keys.push_back({reach});
        return keys;
    }
};

// Shapes for which rays go from cell to cell.
bool castsRays(VoxelShape shape) { return shape != VoxelShape::Faces && shape != VoxelShape::Surfaces; }

bool needsCoarse(const ViewSettings& view) {
    return view.voxelAperture > 0 || view.voxelData == VoxelData::Bricks ||
           view.voxelLevel.resolve(0) >= 0.5f;
}

int roundUp(int value, int step) { return (value + step - 1) / step * step; }

}  // namespace

const gl::Buffer& VoxelView::constants(const gpu::VoxelViewConstants& values) {
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::VoxelViewConstants), "voxel view constants");
    constants_.update(values);
    return constants_;
}

void VoxelView::run(const gl::Device& device, const Target& target, const Shown& shown, gl::Inputs& inputs) {
    const ViewSettings& view = target.settings.view;
    const gpu::FrameConstants& frame = target.surfaces.view();
    gpu::VoxelViewConstants c{};
    c.origin = shown.origin;
    c.voxelSize = shown.voxelSize;
    c.sizeX = static_cast<std::uint32_t>(shown.size.x);
    c.sizeY = static_cast<std::uint32_t>(shown.size.y);
    c.sizeZ = static_cast<std::uint32_t>(shown.size.z);
    c.data = static_cast<std::uint32_t>(view.voxelData);
    c.level = std::round(view.voxelLevel.resolve(static_cast<float>(shown.levelOfMode)));
    c.spread = 2 * std::tan(0.5f * view.voxelAperture);
    c.maxLevel = static_cast<float>(shown.maxLevel);
    c.density = view.voxelDensity;
    c.inside = view.voxelsInside ? 1 : 0;
    c.pixelSize = 2 * glm::length(frame.viewUp) / static_cast<float>(frame.height);
    inputs.add(target.scene)
        .add(target.lights)
        .add(target.surfaces)
        .uniform("ViewBlock", constants(c))
        .image("picture", target.output, target.among ? gl::ImageUse::ReadWrite : gl::ImageUse::Write);
    if (castsRays(shown.shape)) inputs.image("occupied", occupied_, gl::ImageUse::Read);
    // On surfaces there is nothing to be in front of.
    const bool among = target.among && shown.shape != VoxelShape::Surfaces;
    device.get(ViewKey{shown.source, shown.shape, among, shown.directional}.desc())
        .dispatch(inputs, target.output.width(), target.output.height());
}

// `inputs`: the voxels that are shown, of revision `of`.
void VoxelView::buildOccupied(const gl::Device& device, const Shown& shown, bool halves, gl::Inputs inputs,
                              base::Revision of) {
    const glm::ivec3 bricks = (shown.size + 3) / 4;
    if (!occupied_ || occupied_.width() != bricks.x || occupied_.height() != bricks.y ||
        occupied_.depth() != bricks.z) {
        occupied_ = {};
        occupied_ = gl::Texture({GL_TEXTURE_3D, GL_RGBA32UI, bricks.x, bricks.y, bricks.z, 1},
                                "voxel view occupancy");
        occupied_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        occupied_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        occupiedOf_ = {};
    }
    if (occupiedOf_ == of) return;
    const gl::PassScope pass(device.profiler, "voxel view occupancy");
    inputs.image("occupied", occupied_, gl::ImageUse::ReadWrite);
    const bool isVolume = shown.source == kVoxelVolume || shown.source == kVoxelOctree;
    const int source = isVolume ? shown.source : kSurfaceVoxels;
    device.get(OccupiedKey{source, halves}.desc()).dispatch(inputs, bricks.x, bricks.y, bricks.z);
    for (const ReachKey& key : ReachKey::all()) {
        gl::barrier(gl::Access::ImageAccess);
        device.get(key.desc()).dispatch(inputs, bricks.x, bricks.y, bricks.z);
    }
    gl::barrier(gl::Access::ImageAccess);
    occupiedOf_ = of;
}

// Level 1 of the surface voxels' means and all above it; `size` is that of level 1.
void VoxelView::buildLevels(const gl::Device& device, VoxelData data, const Lit& lit, const glm::ivec3& size,
                            int maxLevel) {
    const gl::PassScope pass(device.profiler, "voxel view levels");
    if (!levels_ || levels_.width() != size.x || levels_.height() != size.y || levels_.depth() != size.z) {
        levels_ = {};
        levels_ = gl::Texture({GL_TEXTURE_3D, GL_RGBA16F, size.x, size.y, size.z, maxLevel}, "voxel view");
        levels_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
        levels_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    gpu::VoxelViewConstants c{};
    c.data = static_cast<std::uint32_t>(data);
    levels_.clear(0, GL_RGBA, GL_FLOAT, nullptr);
    for (int level = 0; level < maxLevel; ++level) {
        gl::Inputs inputs;
        inputs.add(lit.voxels).add(lit.faces).uniform("ViewBlock", constants(c));
        if (level > 0) inputs.image("finer", levels_, gl::ImageUse::Read, level - 1);
        inputs.image("coarser", levels_, gl::ImageUse::Write, level);
        const gl::Program& program = device.get(LevelKey{level == 0}.desc());
        if (level == 0)
            program.dispatchLinear(inputs, std::size_t{8} * lit.voxels.surface().mostOccupiedBricks());
        else
            program.dispatch(inputs, levels_.width(level), levels_.height(level), levels_.depth(level));
        gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
    }
}

void VoxelView::draw(const gl::Device& device, const Target& target, const Lit& lit) {
    const voxels::Voxels& voxels = lit.voxels;
    const ViewSettings& view = target.settings.view;
    const voxels::VoxelGrid& grid = voxels.grid();
    const bool coarse = needsCoarse(view);
    VoxelShape shape = view.voxelShape;
    if (shape == VoxelShape::Auto) shape = coarse ? VoxelShape::Cubes : VoxelShape::Faces;
    if (shape == VoxelShape::Faces && !voxels.hasOctants()) shape = VoxelShape::Cubes;
    // Whole texels in every level.
    int maxLevel = 1;
    while (maxLevel < kCoarsest && (2 << maxLevel) <= std::max({grid.size.x, grid.size.y, grid.size.z}))
        ++maxLevel;
    if (coarse && shape != VoxelShape::Faces) {
        const int texel = 1 << maxLevel;
        const glm::ivec3 size{roundUp(grid.size.x, texel) / 2, roundUp(grid.size.y, texel) / 2,
                              roundUp(grid.size.z, texel) / 2};
        if (!levels_ || levelsOf_ != lit.light || levelsData_ != view.voxelData)
            buildLevels(device, view.voxelData, lit, size, maxLevel);
        levelsOf_ = lit.light;
        levelsData_ = view.voxelData;
    } else {
        levels_ = {};
        maxLevel = 0;
    }
    const Shown shown{kSurfaceVoxels, shape,     false,    grid.origin,
                      grid.voxelSize, grid.size, maxLevel, view.voxelData == VoxelData::Bricks ? 2 : 0};
    gl::Inputs inputs;
    inputs.add(voxels).add(lit.faces);
    if (castsRays(shape)) buildOccupied(device, shown, true, inputs, voxels.revision());
    // Shaders of level 0 name the coarser ones, too, and read nothing of them.
    if (!levels_ && !nothing_) nothing_ = gl::Texture({GL_TEXTURE_3D, GL_RGBA16F, 1, 1, 1}, "no levels");
    inputs.texture("volume", levels_ ? levels_ : nothing_);
    const gl::PassScope pass(device.profiler, "voxel view");
    run(device, target, shown, inputs);
}

void VoxelView::draw(const gl::Device& device, const Target& target, const gather::RadianceVolume& volume,
                     const voxels::Voxels& voxels) {
    const gather::RadianceLayout& layout = volume.layout();
    VoxelShape shape = target.settings.view.voxelShape;
    if (shape == VoxelShape::Auto || shape == VoxelShape::Faces) shape = VoxelShape::Cubes;
    const Shown shown{volume.isOctree() ? kRadianceOctree : kRadianceVolume,
                      shape,
                      layout.blocks == 6,
                      layout.grid.origin,
                      layout.grid.voxelSize,
                      layout.size,
                      layout.maxLevel,
                      target.settings.cones.voxelLevel};
    gl::Inputs inputs;
    inputs.add(voxels);
    if (volume.isOctree())
        inputs.add(volume.octree());
    else
        inputs.texture("volume", volume.texture());
    if (castsRays(shape)) buildOccupied(device, shown, true, inputs, voxels.revision());
    const gl::PassScope pass(device.profiler, "voxel view");
    run(device, target, shown, inputs);
}

void VoxelView::draw(const gl::Device& device, const Target& target, const VoxelVolume& volume) {
    VoxelShape shape = target.settings.view.voxelShape;
    if (shape == VoxelShape::Auto) shape = volume.onSurfaces ? VoxelShape::Surfaces : VoxelShape::Cubes;
    if (shape == VoxelShape::Faces) shape = VoxelShape::Cubes;
    const Shown shown{volume.octree != nullptr ? kVoxelOctree : kVoxelVolume,
                      shape,
                      false,
                      volume.origin,
                      volume.voxelSize,
                      glm::ivec3(volume.size),
                      volume.maxLevel,
                      volume.level};
    gl::Inputs inputs;
    inputs.texture("volume", volume.texture, &volume.sampler);
    if (volume.octree != nullptr) inputs.add(*volume.octree);
    if (castsRays(shape)) {
        gpu::VoxelViewConstants c{};
        c.filledMin = glm::ivec4(volume.filledMin, 0);
        c.filledSize = glm::ivec4(volume.filledSize, 0);
        gl::Inputs given = inputs;
        given.uniform("ViewBlock", constants(c));
        buildOccupied(device, shown, volume.zeroMeansEmpty || volume.octree != nullptr, given,
                      volume.revision);
    }
    const gl::PassScope pass(device.profiler, "voxel view");
    run(device, target, shown, inputs);
}

std::vector<gl::ProgramDesc> VoxelView::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const ViewKey& key : ViewKey::all()) descs.push_back(key.desc());
    for (const LevelKey& key : LevelKey::all()) descs.push_back(key.desc());
    for (const OccupiedKey& key : OccupiedKey::all()) descs.push_back(key.desc());
    for (const ReachKey& key : ReachKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::image
