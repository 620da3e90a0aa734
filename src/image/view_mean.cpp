// SPDX-License-Identifier: MIT
#include "image/view_mean.h"

#include "gl/gl.h"
#include "gl/picture_pass.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

gl::ProgramDesc meanDesc() { return {{"image/view_mean.comp.glsl"}, {}}; }

}  // namespace

const gl::Texture& ViewMean::view(int width, int height) {
    if (!view_ || view_.width() != width || view_.height() != height) {
        view_ = {};  // frees the old one first
        view_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "view of a still");
    }
    return view_;
}

base::Steps ViewMean::add(const gl::Device& device, int number, const gl::Texture& mean) {
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::ViewMeanConstants), "mean of views constants");
    gpu::ViewMeanConstants constants{};
    constants.views = static_cast<std::uint32_t>(number + 1);
    constants_.update(constants);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
    gl::Inputs given;
    given.uniform("ViewMeanBlock", constants_)
        .texture("view", view_)
        .image("mean", mean, gl::ImageUse::ReadWrite);
    const gl::ProgramDesc desc = meanDesc();
    const glm::ivec2 size(mean.width(), mean.height());
    co_await gl::dispatchPicture(device, {"mean of views", desc, given, size});
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
}

std::vector<gl::ProgramDesc> ViewMean::programDescs() { return {meanDesc()}; }

}  // namespace conelight::image
