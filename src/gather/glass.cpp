// SPDX-License-Identifier: MIT
#include "gather/glass.h"

#include "gl/gl.h"
#include "light/firefly_clamp.h"
#include "shared/glass.h"

namespace conelight::gather {
namespace {

struct GlassKey {
    bool rays;
    light::HitKey hits;      // of rays
    light::LightKey lights;  // without rays

    gl::ProgramDesc desc() const {
        if (rays) return {{"gather/glass_rays.comp.glsl"}, hits.defines()};
        return {{"gather/glass_panes.comp.glsl"}, lights.defines()};
    }
};

// Few programs: any light may be there.
gl::ProgramDesc conesDesc(const gl::Defines& cones, bool shadows, bool environment) {
    light::LightKey lights{
        .point = 1, .spot = 1, .directional = 1, .rect = 1, .fixed = false, .shaped = true};
    lights.shadows = shadows;
    lights.glass = true;
    gl::ProgramDesc desc{{"gather/glass_cones.comp.glsl"}, lights.defines()};
    desc.defines.insert(desc.defines.end(), cones.begin(), cones.end());
    if (environment) desc.defines.emplace_back("ENVIRONMENT", "1");
    return desc;
}

gpu::GlassConstants packed(const PictureParts& parts) {
    gpu::GlassConstants c{};
    c.passes = 1;
    c.direct = parts.direct ? 1u : 0u;
    c.specular = parts.specular ? 1u : 0u;
    return c;
}

}  // namespace

void Glass::drawByRays(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted,
                       const gl::Texture& picture) {
    const gl::PassScope pass(device.profiler, "glass");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::GlassConstants), "glass constants");
    if (!sums_ || sums_.width() != picture.width() || sums_.height() != picture.height()) {
        sums_ = {};
        sums_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, picture.width(), picture.height()}, "glass sums");
    }
    gpu::GlassConstants constants = packed(wanted.parts);
    constants.passes = static_cast<std::uint32_t>(wanted.passes);
    constants.firstPass = static_cast<std::uint32_t>(wanted.firstPass);
    constants.inverseVoxelSize = 1.0f / inputs.voxels.grid().voxelSize;
    constants.fireflyClamp = light::fireflyClamp(wanted.passes);
    constants.reflections = static_cast<std::uint32_t>(wanted.reflections);
    gl::Inputs given;
    given.add(inputs)
        .uniform("GlassBlock", constants_)
        .image("sums", sums_, gl::ImageUse::ReadWrite)
        .image("picture", picture, gl::ImageUse::ReadWrite);
    GlassKey key{.rays = true, .hits = inputs.lights.hitKey(inputs.scene, true), .lights = {}};
    // Lamps are seen by the rays of narrow lobes, which need the paths of metals for it.
    key.hits.lobes = key.hits.glass = true;
    const gl::Program& program = device.get(key.desc());
    for (int i = 0; i < wanted.passes; ++i) {
        constants.pass = static_cast<std::uint32_t>(i);
        constants_.update(constants);
        gl::barrier(gl::Access::ImageAccess | gl::Access::Update);
        program.dispatch(given, picture.width(), picture.height());
    }
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
}

void Glass::drawByCones(const gl::Device& device, const DirectInputs& inputs, const ConeShadows& cones,
                        const PictureParts& parts, const gl::Texture& picture) {
    const gl::PassScope pass(device.profiler, "glass");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::GlassConstants), "glass constants");
    constants_.update(packed(parts));
    gl::Inputs given;
    given.add(inputs)
        .add(cones)
        .uniform("GlassBlock", constants_)
        .image("picture", picture, gl::ImageUse::ReadWrite);
    gl::barrier(gl::Access::ImageAccess);
    const gl::ProgramDesc desc =
        conesDesc(cones.defines, inputs.lights.key().shadows, inputs.lights.hasEnvironment());
    device.get(desc).dispatch(given, picture.width(), picture.height());
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
}

void Glass::drawStraight(const gl::Device& device, const DirectInputs& inputs, const PictureParts& parts,
                         const gl::Texture& picture) {
    const gl::PassScope pass(device.profiler, "glass");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::GlassConstants), "glass constants");
    constants_.update(packed(parts));
    gl::Inputs given;
    given.add(inputs).uniform("GlassBlock", constants_).image("picture", picture, gl::ImageUse::ReadWrite);
    GlassKey key{.rays = false, .hits = {}, .lights = inputs.lights.key()};
    key.lights.glass = true;
    gl::barrier(gl::Access::ImageAccess);
    device.get(key.desc()).dispatch(given, picture.width(), picture.height());
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> Glass::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const light::HitKey& hits : light::HitKey::all(0)) {
        if (!hits.lobes || !hits.glass) continue;
        descs.push_back(GlassKey{.rays = true, .hits = hits, .lights = {}}.desc());
    }
    for (light::LightKey lights : light::LightKey::all()) {
        if (lights.shadows != lights.glass) continue;
        lights.glass = true;
        descs.push_back(GlassKey{.rays = false, .hits = {}, .lights = lights}.desc());
    }
    return descs;
}

std::vector<gl::ProgramDesc> Glass::coneDescs(const std::vector<gl::Defines>& defines) {
    std::vector<gl::ProgramDesc> descs;
    for (const gl::Defines& cones : defines)
        for (const bool shadows : {false, true})
            for (const bool environment : {false, true})
                descs.push_back(conesDesc(cones, shadows, environment));
    return descs;
}

}  // namespace conelight::gather
