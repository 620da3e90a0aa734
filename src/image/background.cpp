// SPDX-License-Identifier: MIT
#include "image/background.h"

#include "gl/gl.h"

namespace conelight::image {
namespace {

gl::ProgramDesc backgroundDesc() { return {{"image/background.comp.glsl"}, {}}; }

}  // namespace

void drawBackground(const gl::Device& device, const scene::GpuScene& scene, const light::Lights& lights,
                    const view::Surfaces& surfaces, const gl::Texture& picture) {
    if (!lights.hasEnvironment()) return;
    const gl::PassScope pass(device.profiler, "background");
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
    gl::Inputs given;
    given.add(scene).add(lights).add(surfaces).image("picture", picture, gl::ImageUse::Write);
    device.get(backgroundDesc()).dispatch(given, picture.width(), picture.height());
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
}

std::vector<gl::ProgramDesc> backgroundProgramDescs() { return {backgroundDesc()}; }

}  // namespace conelight::image
