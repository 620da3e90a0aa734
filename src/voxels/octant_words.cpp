// SPDX-License-Identifier: MIT
#include "voxels/octant_words.h"

#include "base/assert.h"
#include "gl/gl.h"
#include "shared/bindings.h"

namespace conelight::voxels {
namespace {

gl::ProgramDesc masksDesc() { return {{"voxels/octant_masks.comp.glsl"}, {}}; }
gl::ProgramDesc reachDesc(int reach) {
    return {{"voxels/octant_reach.comp.glsl"}, {{"REACH", std::to_string(reach)}}};
}

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
    const std::uint32_t empty[2] = {1, OCTANT_EMPTY};
    texture_.clear(0, GL_RG_INTEGER, GL_UNSIGNED_INT, empty);
    surface.bind();
    surface.occupiedBricks().bindStorage(BINDING_STORAGE_PASS);
    texture_.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(masksDesc()).dispatchLinear(surface.occupiedBrickCount());
    for (int reach = 2; reach <= OCTANT_REACH; reach *= 2) {
        gl::barrier(gl::Access::ImageAccess);
        texture_.bindImage(0, 0, GL_READ_WRITE);
        programs.get(reachDesc(reach)).dispatch(8 * bricks.x, bricks.y, bricks.z);
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
}

void OctantWords::bind() const {
    CONELIGHT_ASSERT(texture_, "OctantWords::bind before build");
    texture_.bindImage(IMAGE_VOXEL_OCTANTS, 0, GL_READ_ONLY);
}

std::vector<gl::ProgramDesc> OctantWords::programDescs() {
    std::vector<gl::ProgramDesc> descs{masksDesc()};
    for (int reach = 2; reach <= OCTANT_REACH; reach *= 2) descs.push_back(reachDesc(reach));
    return descs;
}

}  // namespace conelight::voxels
