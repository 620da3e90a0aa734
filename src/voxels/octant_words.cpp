// SPDX-License-Identifier: MIT
#include "voxels/octant_words.h"

#include "base/assert.h"
#include "gl/gl.h"
#include "shared/bindings.h"

namespace conelight::voxels {
namespace {

gl::ProgramDesc masksDesc() { return {{"voxels/octant_masks.comp.glsl"}, {}}; }
gl::ProgramDesc reachDesc() { return {{"voxels/octant_reach.comp.glsl"}, {}}; }

// shaders/voxels/octant_rows.glsl
constexpr unsigned kRows = 9, kUnitRows = 8;

}  // namespace

void OctantWords::build(gl::ProgramLibrary& programs, gl::Profiler& profiler, const SurfaceVoxels& surface) {
    const gl::PassScope pass(profiler, "octant words");
    const glm::ivec3 bricks = surface.grid().bricks();
    if (!texture_ || texture_.width() != 8 * bricks.x || texture_.height() != bricks.y ||
        texture_.depth() != bricks.z) {
        texture_ = {};  // frees the old one first
        texture_ =
            gl::Texture({GL_TEXTURE_3D, GL_RG32UI, 8 * bricks.x, bricks.y, bricks.z, 1}, "octant words");
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
    surface.bind();
    surface.occupiedBricks().bindStorage(BINDING_STORAGE_PASS);
    rows_.bindStorage(kRows);
    texture_.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(masksDesc()).dispatchLinear(surface.occupiedBrickCount());
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
    rowTexels_.bind(kUnitRows);
    programs.get(reachDesc()).dispatchLinear(rowWords);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
}

void OctantWords::bind() const {
    CONELIGHT_ASSERT(texture_, "OctantWords::bind before build");
    texture_.bindImage(IMAGE_VOXEL_OCTANTS, 0, GL_READ_ONLY);
}

std::vector<gl::ProgramDesc> OctantWords::programDescs() { return {masksDesc(), reachDesc()}; }

}  // namespace conelight::voxels
