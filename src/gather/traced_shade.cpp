// SPDX-License-Identifier: MIT
#include "gather/traced_shade.h"

#include <algorithm>

#include "gl/draw.h"
#include "gl/gl.h"
#include "light/shadow_maps.h"
#include "shared/bindings.h"
#include "shared/lookups.h"
#include "shared/pixel_rays.h"

namespace conelight::gather {
namespace {

bool anyEmission(const scene::GpuScene& scene) {
    return std::any_of(scene.materials().begin(), scene.materials().end(),
                       [](const gpu::Material& m) { return m.emission != glm::vec3(0); });
}

gl::ProgramDesc shadeDesc(const PictureParts& parts, bool picture, bool lobe, const gl::Defines& lights,
                          bool countLookups = false, bool emission = true) {
    const bool gathers = parts.diffuse || parts.specular;
    gl::ProgramDesc desc{{"gather/traced_shade.vert.glsl", "gather/traced_shade.frag.glsl"},
                         {{"SHOW_DIRECT", parts.direct ? "1" : "0"},
                          {"SHOW_DIFFUSE", parts.diffuse ? "1" : "0"},
                          {"SHOW_SPECULAR", parts.specular ? "1" : "0"},
                          {"IRRADIANCE", picture && gathers ? "1" : "0"},
                          {"LOBE", lobe && parts.specular ? "1" : "0"}}};
    if (!emission) desc.defines.emplace_back("SURFACE_EMISSION", "0");
    if (countLookups) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    if (parts.direct) desc.defines.insert(desc.defines.end(), lights.begin(), lights.end());
    return desc;
}

// For the recorder, which runs a compute shader for one pixel.
gl::ProgramDesc recordDesc() {
    gl::ProgramDesc desc = shadeDesc({false, true, false}, false, false, {});
    desc.files = {"gather/traced_shade.comp.glsl"};
    return desc;
}

gl::ProgramDesc occlusionDesc() { return {{"gather/traced_occlusion.comp.glsl"}, {}}; }

void bindPicture(const gl::Texture* picture, unsigned unit) {
    if (picture == nullptr) return;
    picture->bind(unit);
    gl::unbindSampler(unit);
}

}  // namespace

void TracedShade::draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                       const Settings& settings, const PictureParts& parts, const gl::Texture* irradiance,
                       const gl::Texture* lobe, const PixelRectangle& lobes, const view::GBuffer& gbuffer,
                       const glm::vec3& sky, const gl::Texture& output, const gl::Buffer* lookupCounters) {
    const gl::PassScope pass(profiler, "shade");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "shade constants");
    gpu::PixelRayConstants constants{};
    constants.specularLimit = settings.traced.specularLimit;
    constants_.update(constants);
    constants_.bindUniform(BINDING_PASS);
    bindPicture(irradiance, PIXEL_UNIT_IRRADIANCE);
    bindPicture(lobe, PIXEL_UNIT_LOBE);
    const gl::Defines lights = light::lightDefines(scene, settings.light);
    const bool counts = lookupCounters != nullptr;
    if (counts) lookupCounters->bindStorage(LOOKUP_TABLE);
    // The depth test leaves out the background (shared/gbuffer.h), which the clear has drawn.
    const gl::Framebuffer target({&output}, &gbuffer.depth(), "traced picture");
    gl::RasterState state;
    state.framebuffer = &target;
    state.depthWrite = false;
    state.reversedDepth = true;
    state.cull = gl::Cull::None;
    gl::apply(state);
    const glm::vec3 behind = parts.direct ? sky : glm::vec3(0);
    target.clearColor(0, behind.r, behind.g, behind.b, 0);
    if (!noVertices_) noVertices_ = gl::VertexArray("no vertices");
    const auto drawPicture = [&](bool withLobe) {
        programs.get(shadeDesc(parts, irradiance != nullptr, withLobe, lights, counts, anyEmission(scene)))
            .use();
        gl::drawTriangle(noVertices_);
    };
    // The picture of lobes is read where it has anything; again, if that is a small part of the picture.
    const glm::ivec2 extent = lobes.end - lobes.lowest;
    const bool small = 4 * extent.x * extent.y < output.width() * output.height();
    const bool apart = lobe != nullptr && small && !counts;
    drawPicture(lobe != nullptr && !apart);
    if (apart && extent.x > 0 && extent.y > 0) {
        const int viewport[4] = {lobes.lowest.x, lobes.lowest.y, extent.x, extent.y};
        std::copy(std::begin(viewport), std::end(viewport), state.viewport);
        gl::apply(state);
        drawPicture(true);
    }
}

void TracedShade::recordCache(gl::ProgramLibrary& programs, StepRecorder& recorder) {
    recorder.record(programs, recordDesc());
}

void TracedShade::drawOcclusion(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                                const gl::Texture& occlusion, const gl::Texture& output) {
    const gl::PassScope pass(profiler, "shade");
    bindPicture(&occlusion, PIXEL_UNIT_IRRADIANCE);
    output.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(occlusionDesc()).dispatch(output.width(), output.height());
}

std::vector<gl::ProgramDesc> TracedShade::programDescs() {
    std::vector<gl::ProgramDesc> descs = {occlusionDesc(), StepRecorder::variant(recordDesc())};
    const auto add = [&](const PictureParts& parts, bool picture, bool lobe) {
        descs.push_back(shadeDesc(parts, picture, lobe, {}));
    };
    for (const bool picture : {false, true}) {
        add({false, true, false}, picture, false);
        add({true, true, false}, picture, false);
        for (const bool lobe : {false, true}) {
            add({false, false, true}, picture, lobe);
            add({false, true, true}, picture, lobe);
        }
    }
    add({false, false, false}, false, false);
    add({true, false, false}, false, false);
    // With direct light: each kind of light.
    for (const bool picture : {false, true})
        for (const bool lobe : {false, true})
            for (gl::ProgramDesc& desc :
                 light::lightVariants(shadeDesc({true, true, true}, picture, lobe, {})))
                descs.push_back(std::move(desc));
    descs.push_back(shadeDesc({true, true, true}, false, false, {}, true));
    descs.push_back(shadeDesc({true, true, true}, false, false, {}, false, false));
    return descs;
}

}  // namespace conelight::gather
