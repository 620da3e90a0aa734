// SPDX-License-Identifier: MIT
#include "image/headlight.h"

#include "gl/gl.h"
#include "gl/picture_pass.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

gl::ProgramDesc headlightDesc() { return {{"image/headlight.comp.glsl"}, {}}; }

}  // namespace

base::Steps Headlight::draw(const gl::Device& device, const Inputs& inputs, const gl::Texture& picture) {
    if (!(inputs.irradiance > 0)) co_return;
    if (!block_) block_ = gl::Buffer(sizeof(gpu::HeadlightConstants), "headlight");
    gpu::HeadlightConstants constants{};
    constants.irradiance = inputs.irradiance;
    block_.update(constants);
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
    gl::Inputs given;
    given.add(inputs.scene)
        .add(inputs.surfaces)
        .uniform("HeadlightBlock", block_)
        .image("picture", picture, gl::ImageUse::ReadWrite);
    const gl::ProgramDesc desc = headlightDesc();
    const glm::ivec2 size(picture.width(), picture.height());
    co_await gl::dispatchPicture(device, {"headlight", desc, given, size});
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
}

std::vector<gl::ProgramDesc> Headlight::programDescs() { return {headlightDesc()}; }

}  // namespace conelight::image
