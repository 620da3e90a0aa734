// SPDX-License-Identifier: MIT
#include "gather/traced_shade.h"

#include <algorithm>

#include "gl/gl.h"

namespace conelight::gather {
namespace {

bool anyEmission(const scene::GpuScene& scene) {
    return std::any_of(scene.materials().begin(), scene.materials().end(),
                       [](const gpu::Material& m) { return m.emission != glm::vec3(0); });
}

struct ShadeKey {
    PictureParts parts;
    bool irradiance = false;  // from a picture, else from the cache
    bool lobe = false;        // from a picture, else the irradiance
    bool emission = true;     // surfaces may glow
    bool counts = false;      // lookups
    light::LightKey lights;   // of direct light
    bool visibility = false;  // of lights without extent, from a picture
    bool caustics = false;    // with diffuse light
    bool records = false;     // one pixel, as a compute shader, for the inspector

    gl::ProgramDesc desc() const;
    static std::vector<ShadeKey> all();
};

gl::ProgramDesc ShadeKey::desc() const {
    const bool gathers = parts.diffuse || parts.specular;
    gl::ProgramDesc desc{{"gather/traced_shade.vert.glsl", "gather/traced_shade.frag.glsl"},
                         {{"SHOW_DIRECT", parts.direct ? "1" : "0"},
                          {"SHOW_DIFFUSE", parts.diffuse ? "1" : "0"},
                          {"SHOW_SPECULAR", parts.specular ? "1" : "0"},
                          {"IRRADIANCE", irradiance && gathers ? "1" : "0"},
                          {"LOBE", lobe && parts.specular ? "1" : "0"}}};
    if (!emission) desc.defines.emplace_back("SURFACE_EMISSION", "0");
    if (visibility) desc.defines.emplace_back("VISIBILITY_PICTURE", "1");
    if (caustics && parts.diffuse) desc.defines.emplace_back("CAUSTICS", "1");
    if (counts) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    if (parts.direct)
        for (auto& define : lights.defines()) desc.defines.push_back(std::move(define));
    if (!records) return desc;
    desc.files = {"gather/traced_shade.comp.glsl"};
    return StepRecorder::variant(std::move(desc));
}

std::vector<ShadeKey> ShadeKey::all() {
    std::vector<ShadeKey> keys;
    // The sums that components are made of (partsOf), each as its parts are known.
    const auto add = [&](const PictureParts& parts, const light::LightKey& lights) {
        const bool gathers = parts.diffuse || parts.specular;
        for (int bits = 0; bits < 16; ++bits) {
            const bool irradiance = (bits & 1) != 0, lobe = (bits & 2) != 0;
            if ((irradiance && !gathers) || (lobe && !parts.specular)) continue;
            ShadeKey key{parts, irradiance, lobe, (bits & 4) == 0, (bits & 8) != 0, lights};
            for (const bool visibility : {false, true}) {
                if (visibility && !(parts.direct && lights.hasSharpShadows())) continue;
                key.visibility = visibility;
                keys.push_back(key);
                // Without direct light, lights are not told.
                if (!parts.diffuse || (parts.direct && !lights.glass)) continue;
                keys.push_back(key);
                keys.back().caustics = true;
            }
        }
    };
    for (const PictureParts& parts :
         {PictureParts{}, {false, true, false}, {false, false, true}, {false, true, true}})
        add(parts, {});
    for (const light::LightKey& lights : light::LightKey::all())
        for (const bool indirect : {false, true}) add({true, indirect, indirect}, lights);
    keys.push_back({.parts = {false, true, false}, .records = true});
    return keys;
}

gl::ProgramDesc rayOcclusionDesc() { return {{"gather/traced_occlusion.comp.glsl"}, {}}; }

}  // namespace

void TracedShade::draw(const gl::Device& device, const RayInputs& inputs, const Indirect& indirect,
                       const Wanted& wanted, const gl::Texture& output) {
    const gl::PassScope pass(device.profiler, "shade");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "shade constants");
    gpu::PixelRayConstants constants{};
    constants.specularLimit = wanted.settings.specularLimit;
    constants_.update(constants);
    const gl::Texture* const irradiance = indirect.irradiance();
    const gl::Texture* const lobe = indirect.lobe();
    const PictureParts& parts = wanted.parts;
    gl::Inputs given;
    given.add(inputs).uniform("PixelRayBlock", constants_);
    if (irradiance != nullptr) given.texture("irradiancePicture", *irradiance);
    if (lobe != nullptr) given.texture("lobePicture", *lobe);
    if (wanted.lookupCounters != nullptr) given.storage("LookupTable", *wanted.lookupCounters);
    if (wanted.visibility != nullptr) given.texture("visibilityPicture", *wanted.visibility);

    // The depth test leaves out the background (shared/gbuffer.h), which the clear has drawn.
    const gl::Framebuffer target({&output}, &inputs.surfaces.depth(), "traced picture");
    gl::RasterState state;
    state.framebuffer = &target;
    state.depthWrite = false;
    state.reversedDepth = true;
    state.cull = gl::Cull::None;
    gl::apply(state);
    const glm::vec3 behind = parts.direct ? inputs.scene.source().sky : glm::vec3(0);
    target.clearColor(0, behind.r, behind.g, behind.b, 0);
    if (!noVertices_) noVertices_ = gl::VertexArray("no vertices");
    ShadeKey key{parts,
                 irradiance != nullptr,
                 false,
                 anyEmission(inputs.scene),
                 wanted.lookupCounters != nullptr,
                 parts.direct ? inputs.lights.key() : light::LightKey{},
                 wanted.visibility != nullptr,
                 inputs.lights.hasCaustics()};
    const auto drawPicture = [&](bool withLobe) {
        key.lobe = withLobe;
        device.get(key.desc()).use(given);
        gl::drawTriangle(noVertices_);
    };
    // The picture of lobes is read where it has anything; again, if that is a small part of the picture.
    const PixelRectangle& lobes = indirect.lobes();
    const glm::ivec2 extent = lobes.end - lobes.lowest;
    const bool small = 4 * extent.x * extent.y < output.width() * output.height();
    const bool apart = lobe != nullptr && small && !key.counts;
    drawPicture(lobe != nullptr && !apart);
    if (apart && extent.x > 0 && extent.y > 0) {
        const int viewport[4] = {lobes.lowest.x, lobes.lowest.y, extent.x, extent.y};
        std::copy(std::begin(viewport), std::end(viewport), state.viewport);
        gl::apply(state);
        drawPicture(true);
    }
}

void TracedShade::recordCache(const gl::Device& device, const RayInputs& inputs, StepRecorder& recorder) {
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "shade constants");
    gl::Inputs given;
    given.add(inputs).uniform("PixelRayBlock", constants_);
    const ShadeKey key{.parts = {false, true, false}, .records = true};
    recorder.record(device, key.desc(), given);
}

void TracedShade::drawOcclusion(const gl::Device& device, const RayInputs& inputs,
                                const gl::Texture& occlusion, const gl::Texture& output) {
    const gl::PassScope pass(device.profiler, "shade");
    gl::Inputs given;
    given.add(inputs).texture("occlusion", occlusion).image("result", output, gl::ImageUse::Write);
    device.get(rayOcclusionDesc()).dispatch(given, output.width(), output.height());
}

std::vector<gl::ProgramDesc> TracedShade::programDescs() {
    std::vector<gl::ProgramDesc> descs = {rayOcclusionDesc()};
    for (const ShadeKey& key : ShadeKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
