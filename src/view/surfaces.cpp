// SPDX-License-Identifier: MIT
#include "view/surfaces.h"

namespace conelight::view {

Surfaces::Surfaces() : block_(sizeof(gpu::FrameConstants), "frame constants") {}

void Surfaces::see(const gl::Device& device, const scene::GpuScene& scene, const Picture& picture) {
    if (!gbuffer_ || gbuffer_->width() != picture.width || gbuffer_->height() != picture.height) {
        gbuffer_.reset();  // frees the old one first
        gbuffer_.emplace(picture.width, picture.height);
    }
    view_ = frameConstants(picture.camera, picture.width, picture.height, picture.part);
    block_.update(view_);
    gbuffer_->draw(device, scene, block_, picture.cullBackFaces, picture.withGlass);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ShaderStorage);
}

void Surfaces::declare(gl::Inputs& inputs) const { inputs.uniform("FrameBlock", block_).add(*gbuffer_); }

}  // namespace conelight::view
