// SPDX-License-Identifier: MIT
#include "view/surfaces.h"

#include <algorithm>

namespace conelight::view {

Surfaces::Surfaces() : block_(sizeof(gpu::FrameConstants), "frame constants") {}

void Surfaces::resize(int width, int height) {
    if (gbuffer_ && gbuffer_->width() == width && gbuffer_->height() == height) return;
    gbuffer_.reset();  // frees the old one first
    gbuffer_.emplace(width, height);
}

// A picture of them, of the right size, where there are any.
void Surfaces::prepareLayers(const scene::GpuScene& scene) {
    const bool any = std::any_of(scene.instances().begin(), scene.instances().end(),
                                 [&](const gpu::Instance& one) { return isLayered(scene, one); });
    const int width = gbuffer_->width(), height = gbuffer_->height();
    if (layers_ && any && layers_->width() == width && layers_->height() == height) return;
    layers_.reset();
    if (any) layers_.emplace(width, height);
}

void Surfaces::take(const gl::Device& device, const scene::GpuScene& scene, const HostSurfaces& host,
                    int reduction) {
    view_ = frameConstants(host, reduction);
    resize(static_cast<int>(view_.width), static_cast<int>(view_.height));
    block_.update(view_);
    if (!import_) import_.emplace();
    hostsLobes_ = host.roughness != 0;
    motion_ = host.motion;
    motionScale_ = host.motionScale;
    reduction_ = reduction;
    import_->draw(device, {host, reduction, scene.instances().size()}, block_, *gbuffer_);
    follow(device, scene, host.instances != 0 && host.motion == 0 ? Motion::Drawn : Motion::None);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ShaderStorage);
}

base::Steps Surfaces::seeInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                 const Picture& picture) {
    resize(picture.width, picture.height);
    view_ = frameConstants(picture.camera, picture.width, picture.height, picture.part);
    block_.update(view_);
    cascades_ = picture.cascades;
    const GBuffer::Wanted wanted{picture.cullBackFaces, picture.withGlass, view_.clipFromWorld,
                                 picture.shrink};
    co_await gbuffer_->drawInSteps(device, scene, block_, wanted);
    prepareLayers(scene);
    if (layers_) co_await layers_->drawInSteps(device, scene, block_, *gbuffer_, wanted);
    follow(device, scene, picture.motion);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ShaderStorage);
}

// Where things were in a picture that was not followed is not known.
void Surfaces::follow(const gl::Device& device, const scene::GpuScene& scene, Motion motion) {
    if (motion == Motion::None) return moved_.reset();
    if (!moved_) moved_.emplace();
    if (moved_->follow(scene) && motion == Motion::Drawn) moved_->draw(device, scene, block_, *gbuffer_);
}

void Surfaces::declare(gl::Inputs& inputs) const {
    inputs.uniform("FrameBlock", block_).add(*gbuffer_);
    if (layers_) inputs.add(*layers_);
    if (haveCascades()) inputs.add(*cascades_);
    if (movedFrom()) inputs.texture("hostMotion", moved());
    if (motion_ != 0) inputs.foreignTexture("hostMotion", motion_, import_->sampler());
}

}  // namespace conelight::view
