// SPDX-License-Identifier: MIT
#include "image/background.h"

#include "gl/gl.h"
#include "gl/picture_pass.h"

namespace conelight::image {
namespace {

gl::ProgramDesc backgroundDesc() { return {{"image/background.comp.glsl"}, {}}; }

}  // namespace

base::Steps drawBackground(const gl::Device& device, const scene::GpuScene& scene,
                           const light::Lights& lights, const view::Surfaces& surfaces,
                           const gl::Texture& picture) {
    if (!lights.hasEnvironment()) co_return;
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
    gl::Inputs given;
    given.add(scene).add(lights).add(surfaces).image("picture", picture, gl::ImageUse::Write);
    const gl::ProgramDesc desc = backgroundDesc();
    const glm::ivec2 size(picture.width(), picture.height());
    co_await gl::dispatchPicture(device, {"background", desc, given, size});
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
}

std::vector<gl::ProgramDesc> backgroundProgramDescs() { return {backgroundDesc()}; }

}  // namespace conelight::image
