// SPDX-License-Identifier: MIT
#include "voxels/octant_words.h"

#include "gl/gl.h"
#include "gl/pace.h"

namespace conelight::voxels {
namespace {

gl::ProgramDesc masksDesc() { return {{"voxels/octant_masks.comp.glsl"}, {}}; }
gl::ProgramDesc reachDesc() { return {{"voxels/octant_reach.comp.glsl"}, {}}; }

}  // namespace

base::Steps OctantWords::buildInSteps(const gl::Device& device, const SurfaceVoxels& surface) {
    gl::PassSteps pass(device, "octant words");
    const glm::ivec3 bricks = surface.grid().storedBricks();
    if (!texture_ || texture_.width() != 8 * bricks.x || texture_.height() != bricks.y ||
        texture_.depth() != bricks.z) {
        texture_ = {};  // frees the old one first
        texture_ = gl::Texture({GL_TEXTURE_3D, GL_RG32UI, 8 * bricks.x, bricks.y, bricks.z, 1, true},
                               "octant words");
        texture_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        texture_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    const std::size_t rowWords = std::size_t{8} * static_cast<std::size_t>((bricks.x + 31) / 32) *
                                 static_cast<std::size_t>(bricks.y * bricks.z);
    if (rows_.bytes() < 4 * rowWords) {
        rowTexels_ = {};
        rows_ = {};
        rows_ = gl::Buffer(4 * rowWords, "octant rows");
        rowTexels_ = gl::Texture(rows_, GL_R32UI, "octant rows");
    }
    rows_.clear();
    const std::uint32_t empty[2] = {OCTANT_REACH, OCTANT_EMPTY};
    texture_.clear(0, GL_RG_INTEGER, GL_UNSIGNED_INT, empty);
    gl::Inputs inputs;
    inputs.add(surface)
        .storage("RowTable", rows_)
        .texture("rows", rowTexels_)
        .image("octants", texture_, gl::ImageUse::Write);
    device.get(masksDesc()).dispatchLinear(inputs, surface.mostOccupiedBricks());
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
    co_await pass.rest();
    device.get(reachDesc()).dispatchLinear(inputs, rowWords);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
}

void OctantWords::declare(gl::Inputs& inputs) const {
    inputs.image("voxelOctants", texture_, gl::ImageUse::Read);
}

std::vector<gl::ProgramDesc> OctantWords::programDescs() { return {masksDesc(), reachDesc()}; }

}  // namespace conelight::voxels
