// SPDX-License-Identifier: MIT
// Textures and lists of the thesis's volume.
#include <algorithm>

#include "gl/gl.h"
#include "thesis/render/volume.h"

namespace conelight::thesis {
namespace {

constexpr std::size_t kBrickVoxels = THESIS_BRICK_VOXELS;
constexpr std::size_t kListHeader = 16;  // words of the brick list before the bricks

}  // namespace

void ThesisVolume::allocate(const ThesisVolumeOptions& options) {
    const int edge = static_cast<int>(grid_.size);
    if (!viewport_ || viewport_.width() != edge)
        viewport_ = gl::Framebuffer(edge, edge, "thesis voxelization");
    if (!sampler_ || filter_ != options.filter) {
        filter_ = options.filter;
        const bool nearest = filter_ == VolumeFilter::Nearest;
        const std::uint32_t within = nearest ? GL_NEAREST : GL_LINEAR;
        const std::uint32_t between = nearest ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
        sampler_ = gl::Sampler({between, within, GL_CLAMP_TO_EDGE}, "thesis volume");
        // Beyond the grid there is nothing in the way of a light.
        areaSampler_ = gl::Sampler({between, within, GL_CLAMP_TO_BORDER}, "thesis areas");
    }
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::ThesisGrid), "thesis grid");
    // From one storage to the other.
    if (isOctree_ != (options.storage == VolumeStorage::Octree)) {
        for (gl::Texture* texture :
             {&texture_, &areas_[0], &areas_[1], &bounced_[0], &bounced_[1], &albedo_, &normal_})
            texture->reset();
        octree_ = {};
        isOctree_ = !isOctree_;
    }
    if (!isOctree_) allocateDense(options);
    allocateLists();
}

// Textures of all voxels.
void ThesisVolume::allocateDense(const ThesisVolumeOptions& options) {
    const int edge = static_cast<int>(grid_.size);
    const int levels = static_cast<int>(grid_.maxLevel) + 1;
    const std::uint32_t format = options.defects.clippedRadiance ? GL_RGBA8 : GL_RGBA16F;
    const gl::TextureDesc& now = texture_.desc();
    if (!texture_ || now.width != edge || now.levels != levels || now.format != format) {
        texture_.reset();
        texture_ = gl::Texture({GL_TEXTURE_3D, format, edge, edge, edge, levels}, "thesis volume");
        filledSize_ = glm::ivec3(0);
    }
    const bool hasAreas = ThesisVolume::hasAreas(options.defects);
    for (gl::Texture& areas : areas_) {
        if (!hasAreas) areas.reset();
        if (!hasAreas || (areas && areas.desc().width == edge && areas.desc().levels == levels)) continue;
        areas.reset();
        areas = gl::Texture({GL_TEXTURE_3D, GL_RGBA8, edge, edge, edge, levels}, "thesis areas");
        filledSize_ = glm::ivec3(0);
    }
    allocateBounces(options);
}

// Marks and list of the box's bricks.
void ThesisVolume::allocateLists() {
    const glm::ivec3 size = glm::ivec3(grid_.boxSize) / THESIS_BRICK;
    const std::size_t bricks = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                               static_cast<std::size_t>(size.z);
    if (brickSlots_.bytes() >= 4 * bricks) return;
    brickSlots_ = gl::Buffer(4 * bricks, "thesis brick slots");
    brickList_ = gl::Buffer(4 * (kListHeader + bricks), "thesis brick list");
}

// Sums of the listed bricks' voxels. New buffers are zero; the passes leave sums at zero again.
void ThesisVolume::allocateSums(const ThesisVolumeOptions& options) {
    const std::size_t voxels = brickCount_ * kBrickVoxels;
    // An eighth to spare where their number grows, none at first.
    const auto fit = [](gl::Buffer& buffer, std::size_t bytes, const char* label) {
        if (buffer.bytes() >= std::max<std::size_t>(bytes, 16)) return;
        const std::size_t spare = buffer.bytes() > 16 ? bytes / 8 : 0;
        buffer.reset();
        buffer = gl::Buffer(bytes + spare, label);
    };
    fit(sums_, 16 * voxels, "thesis voxel sums");
    if (hasAreas(options.defects))
        fit(areaSums_, 12 * voxels, "thesis area sums");
    else
        areaSums_.reset();
}

}  // namespace conelight::thesis
