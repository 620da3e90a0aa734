// SPDX-License-Identifier: MIT
#include "gather/baked_pixels.h"

#include <cstddef>
#include <numbers>

#include "gl/gl.h"
#include "shared/baked_light.h"

namespace conelight::gather {
namespace {

gl::ProgramDesc desc() { return {{"gather/baked_pixels.vert.glsl", "gather/baked_pixels.frag.glsl"}, {}}; }

}  // namespace

void BakedPixels::upload(const BakedLight& baked) {
    std::vector<gpu::BakedVertex> vertices(baked.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices[i] = {baked.positions[i],
                       static_cast<std::uint32_t>(baked.surfaces[baked.surfaceOf[i]].instance),
                       baked.irradiance[i] * std::numbers::inv_pi_v<float>, 0};
    vertices_ = gl::Buffer(vertices, "baked vertices");
    indices_ = gl::Buffer(baked.indices, "baked indices");
    indexCount_ = static_cast<std::uint32_t>(baked.indices.size());
    mesh_ = gl::VertexArray(vertices_, sizeof(gpu::BakedVertex),
                            {{0, 3, GL_FLOAT, false, offsetof(gpu::BakedVertex, position)},
                             {1, 1, GL_UNSIGNED_INT, true, offsetof(gpu::BakedVertex, instance)},
                             {2, 3, GL_FLOAT, false, offsetof(gpu::BakedVertex, irradiance)}},
                            indices_, "baked light");
}

void BakedPixels::draw(const gl::Device& device, const scene::GpuScene& scene,
                       const view::Surfaces& surfaces) {
    const gl::PassScope pass(device.profiler, "baked light");
    if (from_ != scene.bakedRevision()) upload(*scene.source().baked);
    from_ = scene.bakedRevision();
    if (!irradiance_ || irradiance_.width() != surfaces.width() ||
        irradiance_.height() != surfaces.height()) {
        irradiance_ = {};
        irradiance_ =
            gl::Texture({GL_TEXTURE_2D, GL_RGBA16F, surfaces.width(), surfaces.height()}, "baked pixels");
        target_ = gl::Framebuffer({&irradiance_}, nullptr, "baked pixels");
    }
    gl::RasterState state;
    state.framebuffer = &target_;
    state.depthTest = false;
    state.depthWrite = false;
    gl::apply(state);
    target_.clearColor(0, 0, 0, 0, 0);
    gl::Inputs given;
    given.add(scene).add(surfaces);
    device.get(desc()).use(given);
    mesh_.bind();
    gl::setFrontFace(true);
    gl::drawIndexed({0, indexCount_, 0, 0});
}

std::vector<gl::ProgramDesc> BakedPixels::programDescs() { return {desc()}; }

}  // namespace conelight::gather
