// SPDX-License-Identifier: MIT
#include "view/gbuffer.h"

#include "gl/gl.h"
#include "gl/pace.h"
#include "scene/culling.h"
#include "shared/gbuffer.h"

namespace conelight::view {
namespace {

// Fetches and discards cost every fragment of a program on software drivers, so materials are drawn by what
// they need: textures none, base colour only, or all six; with or without discard.
constexpr int kTextureUses = 3;
constexpr int kDrawsOfPiece = 64;  // instances, at least, of a picture in parts

int textureUse(const gpu::Material& material) {
    if ((material.flags & MATERIAL_DETAIL_TEXTURES) != 0) return 2;
    return (material.flags & MATERIAL_BASE_TEXTURE) != 0 ? 1 : 0;
}
bool isMasked(const gpu::Material& material) {
    return (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0;
}

struct GBufferKey {
    int textures;  // kTextureUses
    bool masked;
    bool shrunk;  // triangles go through view/shrink.geom.glsl

    gl::ProgramDesc desc() const {
        gl::ProgramDesc desc{{"view/gbuffer.vert.glsl", "view/gbuffer.frag.glsl"},
                             {{"TEXTURES", std::to_string(textures)}, {"MASKED", masked ? "1" : "0"}}};
        if (shrunk) desc.files.insert(desc.files.begin() + 1, "view/shrink.geom.glsl");
        return desc;
    }
    static std::vector<GBufferKey> all() {
        std::vector<GBufferKey> keys;
        for (int textures = 0; textures < kTextureUses; ++textures)
            for (const bool masked : {false, true})
                for (const bool shrunk : {false, true}) keys.push_back({textures, masked, shrunk});
        return keys;
    }
};

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

base::Steps GBuffer::drawInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                 const gl::Buffer& frameBlock, Wanted wanted) {
    gl::PassSteps pass(device, "gbuffer");
    gl::Inputs inputs;
    inputs.uniform("FrameBlock", frameBlock).add(scene);
    scene::GpuScene::declareMaterialTextures(inputs);
    const bool shrunk = wanted.shrink > 0;
    if (shrunk) {
        if (!shrink_) shrink_ = gl::Buffer(sizeof(gpu::ShrinkConstants), "shrink constants");
        shrink_.update(gpu::ShrinkConstants{.kept = 1.0f - wanted.shrink});
        inputs.uniform("ShrinkBlock", shrink_);
    }
    gl::RasterState state;
    state.framebuffer = &framebuffer_;
    state.farthest = GBUFFER_FARTHEST;
    gl::apply(state);

    // View depth 0 marks the background; the material words of such pixels are never read.
    framebuffer_.clearColorUint(0, 0);
    framebuffer_.clearDepth(1.0f);

    // Opaque materials first: their depths spare the dearer fragments behind them.
    const gl::Cull cull = wanted.cullBackFaces ? gl::Cull::Back : gl::Cull::None;
    const std::vector<gpu::Material>& materials = scene.materials();
    const auto drawn = [&](const gpu::Instance& instance) {
        return wanted.withGlass || !scene::isGlass(instance);
    };
    const scene::GpuScene::PartFilter isSeen = scene::partsWithin(wanted.clipFromWorld);
    for (const bool masked : {false, true}) {
        for (int textures = 0; textures < kTextureUses; ++textures) {
            const auto accepted = [&](const gpu::Instance& instance) {
                const gpu::Material& material = materials[instance.material];
                return textureUse(material) == textures && isMasked(material) == masked && drawn(instance);
            };
            bool any = false;
            for (const gpu::Instance& instance : scene.instances())
                any = any || ((instance.flags & INSTANCE_VISIBLE) != 0 && accepted(instance));
            if (!any) continue;
            const gl::ProgramDesc desc = GBufferKey{textures, masked, shrunk}.desc();
            for (gl::Pieces draws(device, static_cast<int>(scene.instances().size()), kDrawsOfPiece);
                 draws.next();) {
                const gl::Program& program = device.get(desc);
                gl::apply(state);
                program.use(inputs);
                scene.draw({.filter = accepted,
                            .cull = cull,
                            .textured = textures != 0 ? &program : nullptr,
                            .part = isSeen,
                            .first = static_cast<std::size_t>(draws.first()),
                            .count = static_cast<std::size_t>(draws.count()),
                            .together = device.profile == gl::ExecutionProfile::Gpu});
                co_await pass.rest();
            }
        }
    }
}

void GBuffer::declare(gl::Inputs& inputs) const {
    inputs.texture("gbufferGeometry", geometry_).texture("gbufferMaterial", material_);
}

std::vector<gl::ProgramDesc> GBuffer::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const GBufferKey& key : GBufferKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::view
