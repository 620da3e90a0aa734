// SPDX-License-Identifier: MIT
#include "view/gbuffer.h"

#include "gl/gl.h"
#include "shared/gbuffer.h"

namespace conelight::view {
namespace {

// Fetches and discards cost every fragment of a program on software drivers, so materials are drawn by what
// they need: textures none, base colour only, or all six; with or without discard.
constexpr int kTextureUses = 3;

int textureUse(const gpu::Material& material) {
    if ((material.flags & MATERIAL_DETAIL_TEXTURES) != 0) return 2;
    return (material.flags & MATERIAL_BASE_TEXTURE) != 0 ? 1 : 0;
}
bool isMasked(const gpu::Material& material) {
    return (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0;
}

gl::ProgramDesc programDesc(int textures, bool masked) {
    return {{"view/gbuffer.vert.glsl", "view/gbuffer.frag.glsl"},
            {{"TEXTURES", std::to_string(textures)}, {"MASKED", masked ? "1" : "0"}}};
}

}  // namespace

GBuffer::GBuffer(int width, int height)
    : width_(width),
      height_(height),
      geometry_({GL_TEXTURE_2D, GL_RGBA32UI, width, height}, "gbuffer geometry"),
      material_({GL_TEXTURE_2D, GL_RGBA32UI, width, height}, "gbuffer material"),
      depth_({GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, width, height}, "gbuffer depth"),
      framebuffer_({&geometry_, &material_}, &depth_, "gbuffer") {
    // Integer textures have no filter but nearest; without this they are incomplete.
    for (gl::Texture* texture : {&geometry_, &material_, &depth_}) {
        texture->parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        texture->parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
}

void GBuffer::draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                   bool cullBackFaces) {
    const gl::PassScope pass(profiler, "gbuffer");
    gl::RasterState state;
    state.framebuffer = &framebuffer_;
    state.farthest = GBUFFER_FARTHEST;
    gl::apply(state);

    // View depth 0 marks the background; the material words of such pixels are never read.
    framebuffer_.clearColorUint(0, 0);
    framebuffer_.clearDepth(1.0f);

    // Opaque materials first: their depths spare the dearer fragments behind them.
    const gl::Cull cull = cullBackFaces ? gl::Cull::Back : gl::Cull::None;
    const std::vector<gpu::Material>& materials = scene.materials();
    for (const bool masked : {false, true}) {
        for (int textures = 0; textures < kTextureUses; ++textures) {
            const auto accepted = [&](const gpu::Instance& instance) {
                const gpu::Material& material = materials[instance.material];
                return textureUse(material) == textures && isMasked(material) == masked;
            };
            bool any = false;
            for (const gpu::Instance& instance : scene.instances())
                any = any || ((instance.flags & INSTANCE_VISIBLE) != 0 && accepted(instance));
            if (!any) continue;
            programs.get(programDesc(textures, masked)).use();
            scene.draw(accepted, cull, textures != 0);
        }
    }
}

void GBuffer::bind(unsigned unit) const {
    geometry_.bind(unit);
    material_.bind(unit + 1);
    gl::unbindSampler(unit);
    gl::unbindSampler(unit + 1);
}

std::vector<gl::ProgramDesc> GBuffer::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (int textures = 0; textures < kTextureUses; ++textures)
        for (const bool masked : {false, true}) descs.push_back(programDesc(textures, masked));
    return descs;
}

}  // namespace conelight::view
