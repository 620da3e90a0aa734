// SPDX-License-Identifier: MIT
#include "image/wireframe.h"

#include <cmath>

#include "gl/gl.h"
#include "shared/gbuffer.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

// Chosen by eye: thin lines that are seen on white walls and on black ones. Over the picture they are dark
// blue-green and strong, alone light grey on a dark ground.
constexpr float kHalfWidth = 0.4f;  // pixels
constexpr glm::vec3 kOverColor{0.02f, 0.35f, 0.3f};
constexpr float kOverOpacity = 0.85f;
constexpr glm::vec3 kAloneColor{0.5f};
constexpr float kAloneOpacity = 0.8f;
// Lines lie on the surfaces whose depth they are tested against: nearer by two units and the slope.
constexpr float kBiasSlope = -1.0f, kBiasUnits = -2.0f;

gl::ProgramDesc wireframeDesc() {
    return {{"image/wireframe.vert.glsl", "image/wireframe.geom.glsl", "image/wireframe.frag.glsl"}, {}};
}

}  // namespace

void WireframeView::draw(const gl::Device& device, const scene::GpuScene& scene,
                         const view::Surfaces& surfaces, const Wanted& wanted, const gl::Texture& output) {
    const gl::PassScope pass(device.profiler, "wireframe");
    const bool over = wanted.kind == Wireframe::Over;
    gpu::WireframeConstants c{};
    c.color = over ? kOverColor : kAloneColor;
    exposure_.measure(device, output, wanted.exposure);
    c.opacity = over ? kOverOpacity : kAloneOpacity;
    c.halfWidth = kHalfWidth;
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::WireframeConstants), "wireframe constants");
    constants_.update(c);

    const gl::Framebuffer target({&output}, &surfaces.depth(), "wireframe");
    gl::RasterState state;
    state.framebuffer = &target;
    state.depthTest = over;
    state.depthWrite = false;
    state.blend = true;
    state.farthest = GBUFFER_FARTHEST;
    state.depthBiasSlope = kBiasSlope;
    state.depthBiasUnits = kBiasUnits;
    gl::apply(state);
    const glm::vec3& sky = scene.source().sky;
    if (!over) target.clearColor(0, sky.r, sky.g, sky.b, 0);
    gl::Inputs inputs;
    inputs.add(scene).add(surfaces).add(exposure_).uniform("WireframeBlock", constants_);
    device.get(wireframeDesc()).use(inputs);
    scene.draw({.cull = over && wanted.culls ? gl::Cull::Back : gl::Cull::None,
                .together = device.profile == gl::ExecutionProfile::Gpu});
}

std::vector<gl::ProgramDesc> WireframeView::programDescs() { return {wireframeDesc()}; }

}  // namespace conelight::image
