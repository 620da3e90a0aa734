// SPDX-License-Identifier: MIT
#include "gather/voxel_view.h"

#include <algorithm>
#include <cmath>
#include "conelight/thesis/settings.h"

#include "gl/gl.h"
#include "shared/bindings.h"
#include "shared/voxel_view.h"

namespace conelight::gather {

// Where the voxels lie that are shown.
struct VoxelViewGrid {
    glm::vec3 origin;
    float voxelSize;
    glm::ivec3 size;
    int maxLevel;
};

namespace {

constexpr int kSurfaceVoxels = 0, kThesisVolume = 1, kRadianceVolume = 2;  // SOURCE of the shader
constexpr int kCoarsest = 8;                                               // view.voxel_level
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

gl::ProgramDesc viewDesc(int source, VoxelShape shape, bool among, bool directional) {
    return {{"gather/voxel_view.comp.glsl"},
            {{"SOURCE", std::to_string(source)},
             {"SHAPE", std::to_string(shapeNumber(shape))},
             {"AMONG", among ? "1" : "0"},
             {"DIRECTIONAL", directional ? "1" : "0"}}};
}

gl::ProgramDesc levelDesc(bool first) {
    return {{"gather/voxel_view_level.comp.glsl"}, {{"FIRST", first ? "1" : "0"}}};
}

// HALVES counts for the volume of mode thesis.
gl::ProgramDesc occupiedDesc(int source, bool halves) {
    return {{"gather/voxel_view_occupied.comp.glsl"},
            {{"SOURCE", std::to_string(source)}, {"HALVES", halves ? "1" : "0"}}};
}

gl::ProgramDesc reachDesc(int reach) {
    return {{"gather/voxel_view_reach.comp.glsl"}, {{"REACH", std::to_string(reach)}}};
}

// Shapes for which rays go from cell to cell.
bool castsRays(VoxelShape shape) { return shape != VoxelShape::Faces && shape != VoxelShape::Surfaces; }

bool needsCoarse(const ViewSettings& view) {
    return view.voxelAperture > 0 || view.voxelData == VoxelData::Bricks ||
           view.voxelLevel.resolve(0) >= 0.5f;
}

int roundUp(int value, int step) { return (value + step - 1) / step * step; }

}  // namespace

void VoxelView::run(const Target& target, int source, VoxelShape shape, bool directional,
                    const VoxelViewGrid& grid, int levelOfMode, const gl::Texture* volume) {
    const ViewSettings& view = target.settings.view;
    gpu::VoxelViewConstants c{};
    c.origin = grid.origin;
    c.voxelSize = grid.voxelSize;
    c.sizeX = static_cast<std::uint32_t>(grid.size.x);
    c.sizeY = static_cast<std::uint32_t>(grid.size.y);
    c.sizeZ = static_cast<std::uint32_t>(grid.size.z);
    c.data = static_cast<std::uint32_t>(view.voxelData);
    c.level = std::round(view.voxelLevel.resolve(static_cast<float>(levelOfMode)));
    c.spread = 2 * std::tan(0.5f * view.voxelAperture);
    c.maxLevel = static_cast<float>(grid.maxLevel);
    c.density = view.voxelDensity;
    c.pixelSize = 2 * glm::length(target.view.viewUp) / static_cast<float>(target.view.height);
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::VoxelViewConstants), "voxel view constants");
    constants_.update(c);
    constants_.bindUniform(BINDING_PASS);
    if (volume != nullptr) volume->bind(UNIT_PASS);
    if (castsRays(shape)) occupied_.bindImage(1, 0, GL_READ_ONLY);
    target.output.bindImage(0, 0, target.among ? GL_READ_WRITE : GL_WRITE_ONLY);
    // On surfaces there is nothing to be in front of.
    const bool among = target.among && shape != VoxelShape::Surfaces;
    target.programs.get(viewDesc(source, shape, among, directional))
        .dispatch(target.output.width(), target.output.height());
    gl::unbindSampler(UNIT_PASS);
}

// Of the voxels that are bound; the volume of mode thesis at UNIT_PASS. `size`: of level 0.
void VoxelView::buildOccupied(const Target& target, int source, bool halves, const glm::ivec3& size) {
    const glm::ivec3 bricks = (size + 3) / 4;
    if (!occupied_ || occupied_.width() != bricks.x || occupied_.height() != bricks.y ||
        occupied_.depth() != bricks.z) {
        occupied_ = {};
        occupied_ = gl::Texture({GL_TEXTURE_3D, GL_RGBA32UI, bricks.x, bricks.y, bricks.z, 1},
                                "voxel view occupancy");
        occupied_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        occupied_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        occupiedValid_ = false;
    }
    if (occupiedValid_) return;
    const gl::PassScope pass(target.profiler, "voxel view occupancy");
    occupied_.bindImage(1, 0, GL_READ_WRITE);
    target.programs.get(occupiedDesc(source, halves)).dispatch(bricks.x, bricks.y, bricks.z);
    for (int reach = 1; reach <= kReach; reach *= 2) {
        gl::barrier(gl::Access::ImageAccess);
        target.programs.get(reachDesc(reach)).dispatch(bricks.x, bricks.y, bricks.z);
    }
    gl::barrier(gl::Access::ImageAccess);
    occupiedValid_ = true;
}

// Level 1 of the surface voxels' means and all above it; `size` is that of level 1.
void VoxelView::buildLevels(const Target& target, const voxels::SurfaceVoxels& surface,
                            const glm::ivec3& size, int maxLevel) {
    if (!levels_ || levels_.width() != size.x || levels_.height() != size.y || levels_.depth() != size.z) {
        levels_ = {};
        levels_ = gl::Texture({GL_TEXTURE_3D, GL_RGBA16F, size.x, size.y, size.z, maxLevel}, "voxel view");
        levels_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
        levels_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        levelsValid_ = false;
    }
    if (levelsValid_ && levelsData_ == target.settings.view.voxelData) return;
    const gl::PassScope pass(target.profiler, "voxel view levels");
    gpu::VoxelViewConstants c{};
    c.data = static_cast<std::uint32_t>(target.settings.view.voxelData);
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::VoxelViewConstants), "voxel view constants");
    constants_.update(c);
    constants_.bindUniform(BINDING_PASS);
    surface.occupiedBricks().bindStorage(BINDING_STORAGE_PASS);
    levels_.clear(0, GL_RGBA, GL_FLOAT, nullptr);
    for (int level = 0; level < maxLevel; ++level) {
        if (level > 0) levels_.bindImage(1, level - 1, GL_READ_ONLY);
        levels_.bindImage(0, level, GL_WRITE_ONLY);
        const gl::Program& program = target.programs.get(levelDesc(level == 0));
        if (level == 0)
            program.dispatchLinear(std::size_t{8} * surface.occupiedBrickCount());
        else
            program.dispatch(levels_.width(level), levels_.height(level), levels_.depth(level));
        gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
    }
    levelsValid_ = true;
    levelsData_ = target.settings.view.voxelData;
}

void VoxelView::draw(const Target& target, const voxels::SurfaceVoxels& surface, bool hasOctants) {
    const ViewSettings& view = target.settings.view;
    const voxels::VoxelGrid& grid = surface.grid();
    const bool coarse = needsCoarse(view);
    VoxelShape shape = view.voxelShape;
    if (shape == VoxelShape::Auto) shape = coarse ? VoxelShape::Cubes : VoxelShape::Faces;
    if (shape == VoxelShape::Faces && !hasOctants) shape = VoxelShape::Cubes;
    surface.bind();
    // Whole texels in every level.
    int maxLevel = 1;
    while (maxLevel < kCoarsest && (2 << maxLevel) <= std::max({grid.size.x, grid.size.y, grid.size.z}))
        ++maxLevel;
    if (coarse && shape != VoxelShape::Faces) {
        const int texel = 1 << maxLevel;
        buildLevels(target, surface,
                    {roundUp(grid.size.x, texel) / 2, roundUp(grid.size.y, texel) / 2,
                     roundUp(grid.size.z, texel) / 2},
                    maxLevel);
    } else {
        levels_ = {};
        maxLevel = 0;
    }
    if (castsRays(shape)) buildOccupied(target, kSurfaceVoxels, true, grid.size);
    const gl::PassScope pass(target.profiler, "voxel view");
    run(target, kSurfaceVoxels, shape, false, {grid.origin, grid.voxelSize, grid.size, maxLevel},
        view.voxelData == VoxelData::Bricks ? 2 : 0, levels_ ? &levels_ : nullptr);
}

void VoxelView::draw(const Target& target, const voxels::RadianceVolume& volume,
                     const voxels::SurfaceVoxels& surface) {
    const voxels::RadianceLayout& layout = volume.layout();
    VoxelShape shape = target.settings.view.voxelShape;
    if (shape == VoxelShape::Auto || shape == VoxelShape::Faces) shape = VoxelShape::Cubes;
    surface.bind();
    if (castsRays(shape)) buildOccupied(target, kSurfaceVoxels, true, layout.size);
    const gl::PassScope pass(target.profiler, "voxel view");
    run(target, kRadianceVolume, shape, layout.blocks == 6,
        {layout.grid.origin, layout.grid.voxelSize, layout.size, layout.maxLevel},
        target.settings.cones.voxelLevel, &volume.texture());
}

void VoxelView::draw(const Target& target, const voxels::ThesisVolume& volume) {
    const gpu::ThesisGrid& grid = volume.grid();
    const thesis::ThesisSettings& thesis = target.settings.groups.of<thesis::ThesisSettings>();
    VoxelShape shape = target.settings.view.voxelShape;
    if (shape == VoxelShape::Auto)
        shape =
            thesis.voxelView == thesis::ThesisVoxelView::Surfaces ? VoxelShape::Surfaces : VoxelShape::Cubes;
    if (shape == VoxelShape::Faces) shape = VoxelShape::Cubes;
    volume.bind(UNIT_PASS);
    volume.bindGrid();
    const bool halves = volume.texture().desc().format == GL_RGBA16F && grid.maxLevel >= 2;
    if (castsRays(shape))
        buildOccupied(target, kThesisVolume, halves, glm::ivec3(static_cast<int>(grid.size)));
    const gl::PassScope pass(target.profiler, "voxel view");
    run(target, kThesisVolume, shape, false,
        {grid.origin, grid.voxelSize, glm::ivec3(static_cast<int>(grid.size)),
         static_cast<int>(grid.maxLevel)},
        thesis.voxelLevel, nullptr);
}

std::vector<gl::ProgramDesc> VoxelView::programDescs() {
    std::vector<gl::ProgramDesc> descs = {
        levelDesc(true), levelDesc(false), occupiedDesc(kSurfaceVoxels, true),
        occupiedDesc(kThesisVolume, true), occupiedDesc(kThesisVolume, false)};
    for (int reach = 1; reach <= kReach; reach *= 2) descs.push_back(reachDesc(reach));
    for (const VoxelShape shape : {VoxelShape::Cubes, VoxelShape::Edges, VoxelShape::Faces,
                                   VoxelShape::Volume, VoxelShape::Surfaces}) {
        for (const bool among : {false, true}) {
            if (among && shape == VoxelShape::Surfaces) continue;
            descs.push_back(viewDesc(kSurfaceVoxels, shape, among, false));
            if (shape == VoxelShape::Faces) continue;
            descs.push_back(viewDesc(kThesisVolume, shape, among, false));
            descs.push_back(viewDesc(kRadianceVolume, shape, among, false));
            descs.push_back(viewDesc(kRadianceVolume, shape, among, true));
        }
    }
    return descs;
}

}  // namespace conelight::gather
