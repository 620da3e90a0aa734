// SPDX-License-Identifier: MIT
#include "modes/traced_mode.h"

#include <algorithm>

#include "gl/pace.h"

namespace conelight::modes {
namespace {

// A ray from glass goes on so often where it meets metal, as those from other gloss do.
constexpr int kGlassReflections = 3;
// Passes of glass for one of other gloss, in stills: surfaces behind the first choose by chance.
constexpr int kGlassPasses = 4;

// Nothing is gathered without a bounce; the parts are black then.
gather::PictureParts partsOf(const Settings& settings) {
    const gather::PictureParts parts = gather::partsOf(settings.component);
    const bool gathers = settings.traced.bounces != 0;
    return {parts.direct, parts.diffuse && gathers, parts.specular && gathers};
}

}  // namespace

// Programs for nested grids where there are any.
gl::Device TracedMode::deviceFor(const Frame& given) {
    gl::Device device = given.device;
    const VoxelSettings& settings = given.settings.voxels;
    if (settings.levels != 1 && !given.besideCenters)
        grid_ = voxels::SurfaceVoxels::gridAround(given.scene, settings, given.surfaces.view().eye);
    device.nestedGrids = settings.levels != 1 && grid_.levels > 1;
    return device;
}

// [recipe]
base::Steps TracedMode::drawInSteps(const Frame& given) {
    const gl::Device device = deviceFor(given);
    const Frame frame = given.on(device);
    const Component component = frame.settings.component;
    const TracedSettings& settings = frame.settings.traced;
    const gather::PictureParts parts = partsOf(frame.settings);
    const gather::RayInputs inputs{frame.scene, frame.lights, voxels_, lit_, frame.surfaces};

    // Voxels, and the light on them.
    const bool usesLight = component == Component::Occlusion || component == Component::Voxels ||
                           parts.diffuse || parts.specular || frame.recorder != nullptr;
    const bool exactShadows = parts.direct && component != Component::Voxels && settings.exactShadows &&
                              gather::PixelVisibility::serves(frame.scene, frame.lights);
    const bool lamps = parts.direct && component != Component::Voxels && frame.lights.drawsLamps();
    if ((usesLight || exactShadows || lamps || frame.lights.castsCaustics()) && !frame.besideCenters) {
        co_await voxelize(frame);
        co_await frame.lights.castCausticsInSteps(frame.device, frame.scene, voxels_);
        co_await gl::rest(frame.device);
    }
    if (usesLight && !frame.besideCenters) co_await relight(frame);

    // What arrives at pixels, and the picture.
    const light::LitVoxels::Inputs sources{frame.scene, frame.lights, voxels_};
    const auto redraw = [&](std::uint32_t draw) { return lit_.redrawInSteps(frame.device, sources, draw); };
    if (frame.recorder != nullptr) {
        record(frame, inputs, redraw);
    } else if (component == Component::Occlusion) {
        co_await indirect_.gatherOcclusion(frame.device, inputs, settings);
        co_await shade_.drawOcclusion(frame.device, inputs, indirect_.occlusion(), frame.output);
    } else if (component == Component::Voxels) {
        voxelView_.draw(
            frame.device,
            {frame.settings, frame.scene, frame.lights, frame.surfaces, frame.output, frame.voxelsAmong},
            {voxels_, lit_.faces(), lit_.revision()});
    } else {
        const gather::Indirect::Wanted wanted{settings, parts, frame.lookupCounters, redraw, frame.reduced};
        if (frame.besideCenters)
            co_await indirect_.carry(frame.device, inputs, settings);
        else
            co_await indirect_.gatherInSteps(frame.device, inputs, wanted);
        const gather::VisibilityInputs seen{frame.scene, frame.lights, voxels_, frame.surfaces};
        if (exactShadows) co_await visibility_.lookInSteps(frame.device, seen, frame.lookupCounters);
        const gather::TracedShade::Wanted shaded{settings, parts, frame.lookupCounters,
                                                 exactShadows ? &visibility_.seen() : nullptr};
        co_await shade_.drawInSteps(frame.device, inputs, indirect_, shaded, frame.output);
        const gather::LayerShade::Wanted layers{parts,
                                                {indirect_.irradiance(), indirect_.coat()},
                                                settings.specularLimit,
                                                shaded.visibility,
                                                &inputs};
        const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};
        co_await layers_.drawInSteps(frame.device, pixels, layers, frame.output);
    }
    if (!settings.budgeted) lit_.endDraws();
}
// [/recipe]

// Light follows voxels that a picture left behind which was dropped.
base::Steps TracedMode::voxelize(const Frame& frame) {
    const VoxelSettings& settings = frame.settings.voxels;
    const bool nested = frame.device.nestedGrids;
    const auto scroll = frame.settings.traced.budgeted ? voxels::Scroll::Yes : voxels::Scroll::No;
    const bool same =
        nested ? voxels_.areIn(grid_, frame.scene, scroll) : voxels_.areOf(frame.scene, settings);
    if (!same && (voxels_.grid().levels > 1) == nested) co_await lit_.followVoxels(frame.device, voxels_);
    if (nested)
        co_await voxels_.updateInSteps(grid_, frame.device, frame.scene, settings, voxels::Rays::Yes, scroll);
    else
        co_await voxels_.updateInSteps(frame.device, frame.scene, settings, voxels::Rays::Yes);
}

// A recorded picture shows what is there.
base::Steps TracedMode::relight(const Frame& frame) {
    const TracedSettings& settings = frame.settings.traced;
    const light::LitVoxels::Inputs inputs{frame.scene, frame.lights, voxels_};
    const light::RelightSettings wanted = light::relightSettings(settings);
    const auto faces = static_cast<std::uint32_t>(settings.faceBudget);
    const light::Budget once{
        .oneUpdate = settings.budgeted, .faces = faces, .nothing = frame.recorder != nullptr};
    if (settings.budgeted && settings.timeBudget > 0 && frame.recorder == nullptr)
        budget_.relight(frame.device, lit_, inputs, wanted,
                        {.updates = wanted.updates,
                         .faces = faces,
                         .milliseconds = static_cast<double>(settings.timeBudget),
                         .start = light::RelightBudget::begin(static_cast<double>(settings.timeBudget))});
    else
        co_await lit_.relightInSteps(frame.device, inputs, wanted, once);
}

// By rays, where the picture holds what they may bring.
base::Steps TracedMode::drawGlass(const Frame& frame) {
    const TracedSettings& settings = frame.settings.traced;
    const gather::PictureParts parts = partsOf(frame.settings);
    if (!parts.diffuse && !parts.specular) {
        co_await ModeRenderer::drawGlass(frame);
        co_return;
    }
    gather::Glass::Wanted wanted{.parts = parts, .passes = settings.specularRays * settings.passes};
    // The views of a still are averaged.
    if (frame.besideCenters) wanted.passes = kGlassPasses * wanted.passes / std::max(frame.parts, 1);
    if (settings.budgeted) wanted.passes = settings.specularRays;
    wanted.passes = std::max(wanted.passes, 1);
    wanted.firstPass = frame.part * wanted.passes;
    if (!settings.bounces) wanted.reflections = kGlassReflections;
    gl::Device device = frame.device;
    device.nestedGrids = voxels_.grid().levels > 1;
    const gather::RayInputs inputs{frame.scene, frame.lights, voxels_, lit_, frame.surfaces};
    co_await glass_.drawByRays(device, inputs, wanted, frame.output);
}

// What the picture shows of one pixel, or would show in component full.
void TracedMode::record(const Frame& frame, const gather::RayInputs& inputs,
                        const gather::Indirect::Redraw& redraw) {
    const TracedSettings& settings = frame.settings.traced;
    if (frame.settings.component == Component::Occlusion)
        return indirect_.recordOcclusion(frame.device, inputs, settings, *frame.recorder);
    if (settings.bounces == 0) return;
    if (settings.pixelRays == 0) shade_.recordCache(frame.device, inputs, *frame.recorder);
    const gather::PictureParts all{.direct = true, .diffuse = true, .specular = true};
    indirect_.record(frame.device, inputs, {settings, all, nullptr, redraw}, *frame.recorder);
}

std::vector<gl::ProgramDesc> TracedMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = light::LitVoxels::programDescs();
    for (const auto& more : {gather::PixelRays::programDescs(), gather::CarriedPicture::programDescs(),
                             gather::PixelVisibility::programDescs(), gather::TracedShade::programDescs(),
                             gather::LayerShade::programDescs(), gather::Glass::programDescs(),
                             image::VoxelView::programDescs()})
        descs.insert(descs.end(), more.begin(), more.end());
    // All of it for nested grids, too.
    std::vector<gl::ProgramDesc> nested = voxels::SurfaceVoxels::programDescs();
    for (const auto& more : {voxels::OctantWords::programDescs(), descs})
        nested.insert(nested.end(), more.begin(), more.end());
    for (gl::ProgramDesc& desc : nested) descs.push_back(gl::Device::forNestedGrids(std::move(desc)));
    return descs;
}

}  // namespace conelight::modes
