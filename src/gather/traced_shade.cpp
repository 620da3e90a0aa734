// SPDX-License-Identifier: MIT
#include "gather/traced_shade.h"

#include <algorithm>
#include <iterator>

#include "gather/pixel_lights.h"
#include "gl/gl.h"
#include "gl/pace.h"
#include "gl/picture_pass.h"

namespace conelight::gather {
namespace {

constexpr const char* kShade = "shade";
constexpr int kRows = 64;  // llvmpipe's tiles

bool anyEmission(const scene::GpuScene& scene) {
    return std::any_of(scene.materials().begin(), scene.materials().end(),
                       [](const gpu::Material& m) { return m.emission != glm::vec3(0); });
}

}  // namespace

struct TracedShade::ShadeKey {
    PictureParts parts;
    bool irradiance = false;  // from a picture, else from the cache
    bool lobe = false;        // from a picture, else the irradiance
    bool emission = true;     // surfaces may glow
    bool counts = false;      // lookups
    light::LightKey lights;   // of direct light
    bool visibility = false;  // of lights without extent, from a picture
    bool caustics = false;    // with diffuse light
    bool lamps = false;       // of direct light, from a picture
    bool records = false;     // one pixel, as a compute shader, for the inspector
    bool compute = false;     // the picture as a compute shader

    gl::ProgramDesc desc() const;
    static std::vector<ShadeKey> all();
};

gl::ProgramDesc TracedShade::ShadeKey::desc() const {
    const bool gathers = parts.diffuse || parts.specular;
    gl::ProgramDesc desc{{"gather/traced_shade.vert.glsl", "gather/traced_shade.frag.glsl"},
                         {{"SHOW_DIRECT", parts.direct ? "1" : "0"},
                          {"SHOW_DIFFUSE", parts.diffuse ? "1" : "0"},
                          {"SHOW_SPECULAR", parts.specular ? "1" : "0"},
                          {"IRRADIANCE", irradiance && gathers ? "1" : "0"},
                          {"LOBE", lobe && parts.specular ? "1" : "0"}}};
    if (!emission) desc.defines.emplace_back("SURFACE_EMISSION", "0");
    if (visibility) desc.defines.emplace_back("VISIBILITY_PICTURE", "1");
    if (lamps && parts.direct) desc.defines.emplace_back("LAMP_PICTURE", "1");
    if (caustics && parts.diffuse) desc.defines.emplace_back("CAUSTICS", "1");
    if (counts) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    if (parts.direct)
        for (auto& define : lights.defines()) desc.defines.push_back(std::move(define));
    if (records || compute) desc.files = {"gather/traced_shade.comp.glsl"};
    if (!records) return desc;
    return StepRecorder::variant(std::move(desc));
}

std::vector<TracedShade::ShadeKey> TracedShade::ShadeKey::all() {
    std::vector<ShadeKey> keys;
    // Lamps of a picture come with other lights that are told by their kinds.
    const auto addLamps = [&](ShadeKey key) {
        const light::LightKey& lights = key.lights;
        const bool others = lights.directional + lights.rect > 0;
        if (!key.parts.direct || lights.point + lights.spot > 0 || lights.fixed == others) return;
        key.lamps = true;
        keys.push_back(key);
    };
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
                addLamps(key);
                // Without direct light, lights are not told.
                if (!parts.diffuse || (parts.direct && !lights.glass)) continue;
                keys.push_back(key);
                keys.back().caustics = true;
                addLamps(keys.back());
            }
        }
    };
    for (const PictureParts& parts :
         {PictureParts{}, {false, true, false}, {false, false, true}, {false, true, true}})
        add(parts, {});
    for (const light::LightKey& lights : light::LightKey::ofPixels())
        for (const bool indirect : {false, true}) add({true, indirect, indirect}, lights);
    const std::size_t pictures = keys.size();
    for (std::size_t i = 0; i < pictures; ++i) {
        keys.push_back(keys[i]);
        keys.back().compute = true;
    }
    keys.push_back({.parts = {false, true, false}, .records = true});
    return keys;
}

namespace {
gl::ProgramDesc rayOcclusionDesc() { return {{"gather/traced_occlusion.comp.glsl"}, {}}; }
}  // namespace

// The depth test leaves out the background (shared/gbuffer.h), which the clear has drawn.
void TracedShade::drawRectangle(const gl::Device& device, const gl::Inputs& given, const Target& target,
                                const ShadeKey& key, const PixelRectangle& pixels) {
    const gl::Framebuffer framebuffer({&target.output}, &target.surfaces.depth(), "traced picture");
    const glm::ivec2 extent = pixels.end - pixels.lowest;
    gl::RasterState state;
    state.framebuffer = &framebuffer;
    state.depthWrite = false;
    state.reversedDepth = true;
    state.cull = gl::Cull::None;
    const int viewport[4] = {pixels.lowest.x, pixels.lowest.y, extent.x, extent.y};
    std::copy(std::begin(viewport), std::end(viewport), state.viewport);
    gl::apply(state);
    device.get(key.desc()).use(given);
    gl::drawTriangle(noVertices_);
}

// As fragments. The picture of lobes is read where it has anything; again, if that is a small part of the picture.
base::Steps TracedShade::drawFragments(const gl::Device& device, const gl::Inputs& given,
                                       const Target& target, ShadeKey key) {
    const glm::ivec2 size(target.output.width(), target.output.height());
    if (!noVertices_) noVertices_ = gl::VertexArray("no vertices");
    {
        const gl::PassScope pass(device.profiler, kShade);
        const gl::Framebuffer framebuffer({&target.output}, nullptr, "traced picture");
        gl::RasterState state;
        state.framebuffer = &framebuffer;
        gl::apply(state);
        framebuffer.clearColor(0, target.behind.r, target.behind.g, target.behind.b, 0);
    }
    const bool lobe = key.lobe;
    const glm::ivec2 extent = target.lobes.end - target.lobes.lowest;
    const bool small = 4 * extent.x * extent.y < size.x * size.y;
    const bool apart = lobe && small && !key.counts;
    key.lobe = lobe && !apart;
    for (gl::Pieces rows(device, size.y, kRows); rows.next();) {
        {
            const gl::PassScope pass(device.profiler, kShade);
            drawRectangle(device, given, target, key,
                          {{0, rows.first()}, {size.x, rows.first() + rows.count()}});
        }
        co_await gl::rest(device);
    }
    if (!apart || extent.x <= 0 || extent.y <= 0) co_return;
    const gl::PassScope pass(device.profiler, kShade);
    key.lobe = true;
    drawRectangle(device, given, target, key, target.lobes);
}

base::Steps TracedShade::drawInSteps(const gl::Device& device, const RayInputs& inputs,
                                     const Indirect& indirect, const Wanted& wanted,
                                     const gl::Texture& output) {
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
    const gl::Texture* const lamps = parts.direct ? indirect.lamps() : nullptr;
    if (lamps != nullptr) given.texture("lampPicture", *lamps);
    if (wanted.lookupCounters != nullptr) given.storage("LookupTable", *wanted.lookupCounters);
    if (wanted.visibility != nullptr) given.texture("visibilityPicture", *wanted.visibility);
    ShadeKey key{parts,
                 irradiance != nullptr,
                 lobe != nullptr,
                 anyEmission(inputs.scene),
                 wanted.lookupCounters != nullptr,
                 parts.direct ? lightsOfPixels(inputs.lights, inputs.surfaces) : light::LightKey{},
                 wanted.visibility != nullptr,
                 inputs.lights.hasCaustics(),
                 lamps != nullptr};
    if (device.profile == gl::ExecutionProfile::Gpu) {
        const gl::PassScope pass(device.profiler, kShade);
        key.compute = true;
        given.image("result", output, gl::ImageUse::Write);
        device.get(key.desc()).dispatch(given, output.width(), output.height());
        gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess | gl::Access::Framebuffer);
        co_return;
    }
    const glm::vec3 behind = parts.direct ? inputs.scene.source().sky : glm::vec3(0);
    const Target target{inputs.surfaces, indirect.lobes(), behind, output};
    co_await drawFragments(device, given, target, key);
}

void TracedShade::recordCache(const gl::Device& device, const RayInputs& inputs, StepRecorder& recorder) {
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "shade constants");
    gl::Inputs given;
    given.add(inputs).uniform("PixelRayBlock", constants_);
    const ShadeKey key{.parts = {false, true, false}, .records = true};
    recorder.record(device, key.desc(), given);
}

base::Steps TracedShade::drawOcclusion(const gl::Device& device, const RayInputs& inputs,
                                       const gl::Texture& occlusion, const gl::Texture& output) {
    gl::Inputs given;
    given.add(inputs).texture("occlusion", occlusion).image("result", output, gl::ImageUse::Write);
    const gl::ProgramDesc desc = rayOcclusionDesc();
    const glm::ivec2 size(output.width(), output.height());
    co_await gl::dispatchPicture(device, {kShade, desc, given, size});
}

std::vector<gl::ProgramDesc> TracedShade::programDescs() {
    std::vector<gl::ProgramDesc> descs = {rayOcclusionDesc()};
    for (const ShadeKey& key : ShadeKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
