// SPDX-License-Identifier: MIT
// Coat and sheen of what the camera sees (shaders/lib/layers.glsl): instances that have layers are drawn once more, and
// count where the G-buffer shows them. So the G-buffer is the same for all scenes. Readers that are compute shaders
// need a texture-fetch barrier. Part of view::Surfaces.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "view/gbuffer.h"

namespace conelight::view {

// Whether the instance is drawn with layers.
bool isLayered(const scene::GpuScene& scene, const gpu::Instance& instance);

class LayerPicture {
  public:
    LayerPicture(int width, int height);

    // `wanted`, as the G-buffer was drawn. GL state changed: as GBuffer::drawInSteps.
    base::Steps drawInSteps(const gl::Device& device, const scene::GpuScene& scene,
                            const gl::Buffer& frameBlock, const GBuffer& gbuffer, GBuffer::Wanted wanted);

    void declare(gl::Inputs& inputs) const { inputs.texture("surfaceLayers", layers_); }
    int width() const { return layers_.width(); }
    int height() const { return layers_.height(); }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture layers_, depth_;
    gl::Framebuffer framebuffer_;
};

}  // namespace conelight::view
