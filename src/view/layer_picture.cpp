// SPDX-License-Identifier: MIT
#include "view/layer_picture.h"

#include "gl/gl.h"
#include "gl/pace.h"
#include "scene/culling.h"
#include "shared/gbuffer.h"

namespace conelight::view {
namespace {

gl::ProgramDesc layersDesc() {
    return {{"view/gbuffer.vert.glsl", "view/layers.frag.glsl"}, {{"TEXTURES", "2"}}};
}

}  // namespace

bool isLayered(const scene::GpuScene& scene, const gpu::Instance& instance) {
    return (instance.flags & INSTANCE_VISIBLE) != 0 && !scene::isGlass(instance) &&
           (scene.materials()[instance.material].flags & MATERIAL_LAYERED) != 0;
}

// A depth buffer of its own: of layers one behind the other the nearest counts.
LayerPicture::LayerPicture(int width, int height)
    : layers_({GL_TEXTURE_2D, GL_RGBA32UI, width, height}, "layers"),
      depth_({GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, width, height}, "depth of layers"),
      framebuffer_({&layers_}, &depth_, "layers") {
    layers_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    layers_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

base::Steps LayerPicture::drawInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                      const gl::Buffer& frameBlock, const GBuffer& gbuffer,
                                      GBuffer::Wanted wanted) {
    const gl::PassScope pass(device.profiler, "layers");
    gl::Inputs inputs;
    inputs.uniform("FrameBlock", frameBlock).add(scene).add(gbuffer);
    scene::GpuScene::declareMaterialTextures(inputs);
    gl::RasterState state;
    state.framebuffer = &framebuffer_;
    state.farthest = GBUFFER_FARTHEST;
    gl::apply(state);
    framebuffer_.clearColorUint(0, 0);
    framebuffer_.clearDepth(1.0f);
    const gl::Program& program = device.get(layersDesc());
    gl::apply(state);
    program.use(inputs);
    scene.draw({.filter = [&](const gpu::Instance& instance) { return isLayered(scene, instance); },
                .cull = wanted.cullBackFaces ? gl::Cull::Back : gl::Cull::None,
                .textured = &program,
                .part = scene::partsWithin(wanted.clipFromWorld),
                .together = device.profile == gl::ExecutionProfile::Gpu});
    co_return;
}

std::vector<gl::ProgramDesc> LayerPicture::programDescs() { return {layersDesc()}; }

}  // namespace conelight::view
