// SPDX-License-Identifier: MIT
#include "thesis/render/cones.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/log.h"
#include "gather/picture_parts.h"
#include "gl/gl.h"

namespace conelight::thesis {
namespace {

// One column of the original's tables (its VoxSettings for 64, 128 and 256 voxels), between them interpolated
// in the logarithm of the size, beyond them the nearest.
float tableValue(int size, float at64, float at128, float at256) {
    const float x = std::clamp(std::log2(static_cast<float>(size) / 64.0f), 0.0f, 2.0f);
    const float low = x < 1.0f ? at64 : at128;
    const float high = x < 1.0f ? at128 : at256;
    return low * std::pow(high / low, x < 1.0f ? x : x - 1.0f);
}

float spreadOf(float aperture) { return 2.0f * std::tan(0.5f * aperture); }

void checkCone(const char* name, const glm::vec4& cone, bool fromShininess) {
    const bool spreads = fromShininess ? cone.x >= 0 : cone.x > 0;
    if (spreads && cone.y > 0 && cone.z > 0 && std::isfinite(cone.x)) return;
    base::fail(ErrorKind::Usage,
               "thesis.%s: aperture, dist_factor and offset must be above 0, or the march would not end",
               name);
}

using Flag = bool ThesisDefects::*;
struct Define {
    const char* name;
    Flag flag;
    bool ofDiffuse = false;  // diffuse cones know it, too
};

// Defects that the cone kernel knows.
constexpr Define kDefines[] = {
    {"COARSE_LOD", &ThesisDefects::coarseLod, true},
    {"NO_STEP_CORRECTION", &ThesisDefects::noStepCorrection, true},
    {"FORGET_NEAR_COLOR", &ThesisDefects::forgetNearColor, true},
    {"DOUBLE_ALPHA", &ThesisDefects::doubleAlpha, true},
    {"LAST_STEP", &ThesisDefects::lastStep},
    {"PREMULTIPLIED_FIRST_HIT", &ThesisDefects::premultipliedFirstHit, true},
    {"HARD_FIRST_HIT", &ThesisDefects::hardFirstHit, true},
    {"FIXED_OFFSETS", &ThesisDefects::fixedOffsets, true},
    {"SHORT_REACH", &ThesisDefects::shortReach, true},
    {"NAN_AXES", &ThesisDefects::nanAxes, true},
    {"SHORT_SIDE_AXIS", &ThesisDefects::shortSideAxis, true},
    {"GRAZING_SIDE_CONES", &ThesisDefects::grazingSideCones, true},
    {"NO_COSINE_WEIGHTS", &ThesisDefects::noCosineWeights, true},
    {"NO_ALBEDO", &ThesisDefects::noAlbedo},
    {"OCCLUSION_FUDGE", &ThesisDefects::occlusionFudge},
    {"OCCLUDED_INDIRECT", &ThesisDefects::occludedIndirect},
    {"SPECULAR_PER_LIGHT", &ThesisDefects::specularPerLight},
    {"OCCLUDED_SPECULAR", &ThesisDefects::occludedSpecular},
    {"SHININESS_SATURATION", &ThesisDefects::shininessSaturation},
    {"UNBOUNDED_SPECULAR", &ThesisDefects::unboundedSpecular},
    {"FINE_STEPS", &ThesisDefects::fineSteps, true},
};

// Numbers of the kernel's VIEW.
int viewOf(Component component) {
    switch (component) {
        case Component::Direct:
            return 1;
        case Component::Indirect:
            return 2;
        case Component::Diffuse:
            return 3;
        case Component::Specular:
            return 4;
        case Component::Occlusion:
            return 5;
        default:
            return 0;
    }
}

int coneKind(bool on, ConeVariant variant) { return !on ? 0 : variant == ConeVariant::Regular ? 1 : 2; }

// What the kernel is made for, beside the settings.
struct ConesKey {
    Component component = Component::Full;
    bool countLookups = false;
    bool rectangles = false;   // some lights are rectangles
    bool environment = false;  // surroundings have a picture
    bool shaped = false;       // of light::LightKey
};

ConesKey keyOf(Component component, bool countLookups, const light::Lights& lights) {
    return {component, countLookups, lights.ends().w > lights.ends().z, lights.hasEnvironment(),
            lights.key().shaped};
}

gl::ProgramDesc conesDesc(const ThesisSettings& settings, const ConesKey& key) {
    const ThesisDefects defects = effectiveDefects(settings);
    const int view = viewOf(key.component);
    const bool full = view == 0;
    const bool anySet = settings.frontCone || settings.sideCones || settings.intermediateCones;
    const bool diffuse = settings.voxDiffuse && anySet && (full || view == 2 || view == 3);
    const bool specular = settings.voxSpecular && (full || view == 2 || view == 4);
    // Occlusion weakens direct light; by defects also what the other cones bring.
    const bool direct = (full || view == 1) && settings.voxShadows && settings.phong;
    const bool occlusion = view == 5 || direct || (diffuse && defects.occludedIndirect) ||
                           (specular && defects.occludedSpecular && settings.voxShadows);
    gl::Defines defines{{"VIEW", std::to_string(view)},
                        {"DIFFUSE", std::to_string(coneKind(diffuse, settings.diffuse.variant))},
                        {"SPECULAR", std::to_string(coneKind(specular, settings.specular.variant))},
                        {"OCCLUSION", std::to_string(coneKind(occlusion, settings.occlusion.variant))},
                        {"FRONT_CONES", settings.frontCone ? "1" : "0"},
                        {"INTERMEDIATE_CONES", settings.intermediateCones ? "4" : "0"},
                        {"SIDE_CONES", settings.sideCones ? "4" : "0"},
                        {"COUNT_LOOKUPS", key.countLookups ? "1" : "0"},
                        {"LIGHTS_SHAPED", key.shaped ? "1" : "0"}};
    if (key.rectangles && !defects.pointlikeRectangles) defines.emplace_back("RECTANGLES", "1");
    if (!ThesisVolume::hasAreas(defects)) defines.emplace_back("ISOTROPIC_OPACITY", "1");
    if (settings.storage == VolumeStorage::Octree) defines.emplace_back("OCTREE", "1");
    if (key.environment) defines.emplace_back("ENVIRONMENT", "1");
    for (const Define& define : kDefines)
        if (defects.*define.flag) defines.emplace_back(define.name, "1");
    return {{"thesis/shaders/cones.comp.glsl"}, defines};
}

}  // namespace

ThesisDefects effectiveDefects(const ThesisSettings& settings) {
    if (!settings.published) return settings.defects;
    ThesisDefects d;
    for (bool* flag : thesisDefectFlags(d)) *flag = true;
    return d;
}

gl::ProgramDesc bounceDesc(const ThesisSettings& settings, bool environment) {
    const ThesisDefects defects = effectiveDefects(settings);
    gl::Defines defines{{"DIFFUSE", std::to_string(coneKind(true, settings.diffuse.variant))},
                        {"FRONT_CONES", settings.frontCone ? "1" : "0"},
                        {"INTERMEDIATE_CONES", settings.intermediateCones ? "4" : "0"},
                        {"SIDE_CONES", settings.sideCones ? "4" : "0"}};
    if (defects.clippedRadiance) defines.emplace_back("CLIPPED_RADIANCE", "1");
    if (settings.storage == VolumeStorage::Octree) defines.emplace_back("OCTREE", "1");
    if (environment) defines.emplace_back("ENVIRONMENT", "1");
    for (const Define& define : kDefines)
        if (define.ofDiffuse && defects.*define.flag) defines.emplace_back(define.name, "1");
    return {{"thesis/shaders/bounce.comp.glsl"}, defines};
}

gpu::ThesisConstants thesisConstants(const ThesisSettings& s, const gpu::ThesisGrid& grid, int size) {
    const ThesisDefects d = effectiveDefects(s);
    gpu::ThesisConstants c{};
    // Without a defect's table: first sample half a voxel from the origin, which is itself clear of the
    // surface.
    const float clear = 0.5f * grid.voxelSize;
    const auto start = [&](const AutoFloat& set, float fixed) {
        return set.resolve(d.fixedOffsets ? fixed : clear);
    };
    // Steps of the mended march: what is sampled, at most, so that no surface falls between two samples.
    // Occlusion and specular cones take smaller ones for smooth edges (chosen by eye on the thesis's rooms).
    const auto factor = [&](const AutoFloat& set, float table, float mended) {
        return set.resolve(d.fineSteps ? table : mended);
    };
    // Diffuse cones that share the hemisphere: cos(aperture / 2) = 1 - 1/m (theory 4.6). The original's 0.55
    // leaves gaps.
    const int cones = (s.frontCone ? 1 : 0) + (s.intermediateCones ? 4 : 0) + (s.sideCones ? 4 : 0);
    const float shared = 2.0f * std::acos(1.0f - 1.0f / static_cast<float>(std::max(cones, 2)));
    // The thesis's lamp. Where voxels are as opaque from every side, half of it: more needs the original's damping
    // to keep walls beside the cone out of it (chosen by eye).
    const float lamp = d.occlusionFudge || ThesisVolume::hasAreas(d) ? 0.4f : 0.2f;
    const bool fromShininess = s.specular.aperture.isAuto && !d.fixedSpecularAperture;
    const float specularTable = tableValue(size, 0.04f, 0.02f, 0.01f);
    c.diffuseCone = {spreadOf(s.diffuse.aperture.resolve(d.noCosineWeights ? 0.55f : shared)),
                     factor(s.diffuse.distFactor, tableValue(size, 0.1f, 0.01f, 0.1f), 1.0f),
                     start(s.diffuse.offset, 0.19f), 1.0f};
    c.specularCone = {fromShininess ? 0.0f : spreadOf(s.specular.aperture.resolve(specularTable)),
                      factor(s.specular.distFactor, tableValue(size, 0.8f, 0.3f, 0.15f), 0.8f),
                      start(s.specular.offset, tableValue(size, 0.15f, 0.15f, 0.05f)), 1.0f};
    c.occlusionCone = {spreadOf(s.occlusion.aperture.resolve(lamp)),
                       factor(s.occlusion.distFactor, tableValue(size, 0.35f, 0.35f, 0.1f),
                              ThesisVolume::hasAreas(d) ? 0.5f : 0.8f),
                       start(s.occlusion.offset, 0.08f), 0.0f};
    checkCone("diffuse", c.diffuseCone, false);
    checkCone("specular", c.specularCone, fromShininess);
    checkCone("occlusion", c.occlusionCone, false);
    c.originOffset = s.diffuseOriginOffset.resolve(0.05f);
    c.shininessFalloff = s.shininessFalloff.resolve(tableValue(size, 3.0f, 3.0f, 2.0f));
    c.shadowStrength = s.shadowStr;
    // The published program knows no such lights; with its other numbers they are its lamp.
    c.parallelSpread = d.occlusionFudge ? c.occlusionCone.x : spreadOf(s.occlusion.aperture.resolve(1e-3f));
    c.minSpecular = s.minSpecular;
    c.maxSamples = static_cast<std::uint32_t>(s.maxSamples);

    // Ambient light stands for indirect light, so it is left out where cones bring that.
    const bool gathers = s.voxDiffuse && (s.frontCone || s.sideCones || s.intermediateCones);
    const bool ambient = s.phongAmbient && (d.ambientTwice || !gathers);
    c.switches = (s.phong ? THESIS_PHONG : 0u) | (ambient ? THESIS_PHONG_AMBIENT : 0u) |
                 (s.phongDiffuse ? THESIS_PHONG_DIFFUSE : 0u) |
                 (s.phongSpecular ? THESIS_PHONG_SPECULAR : 0u) | (s.voxShadows ? THESIS_SHADOWS : 0u);
    return c;
}

gl::Inputs ThesisConePass::given(const Inputs& inputs, const gl::Texture& output) {
    const Settings& settings = inputs.settings;
    gpu::ThesisConstants constants =
        thesisConstants(settings.groups.of<ThesisSettings>(), inputs.volume.grid(), settings.voxels.size);
    const std::size_t lights = inputs.pixels.lights.table().size();
    constants.lightCount = static_cast<std::uint32_t>(
        effectiveDefects(settings.groups.of<ThesisSettings>()).tenLights ? std::min<std::size_t>(lights, 10)
                                                                         : lights);
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::ThesisConstants), "thesis constants");
    constants_.update(constants);
    gl::Inputs given;
    given.add(inputs.pixels)
        .add(inputs.volume)
        .uniform("ThesisBlock", constants_)
        .image("picture", output, gl::ImageUse::Write);
    return given;
}

void ThesisConePass::record(const gl::Device& device, const Inputs& inputs, const gl::Texture& output,
                            gather::StepRecorder& recorder) {
    const Settings& settings = inputs.settings;
    const bool gathered = gather::partsOf(settings.component).diffuse ||
                          gather::partsOf(settings.component).specular ||
                          settings.component == Component::Occlusion;
    const Component component = gathered ? settings.component : Component::Full;
    recorder.record(device,
                    gather::StepRecorder::variant(conesDesc(settings.groups.of<ThesisSettings>(),
                                                            keyOf(component, false, inputs.pixels.lights))),
                    given(inputs, output));
}

void ThesisConePass::draw(const gl::Device& device, const Inputs& inputs, const gl::Texture& output,
                          const gl::Buffer* lookupCounters) {
    const gl::PassScope pass(device.profiler, "thesis cones");
    gl::Inputs given = this->given(inputs, output);
    if (lookupCounters != nullptr) given.storage("LookupTable", *lookupCounters);
    device
        .get(conesDesc(inputs.settings.groups.of<ThesisSettings>(),
                       keyOf(inputs.settings.component, lookupCounters != nullptr, inputs.pixels.lights)))
        .dispatch(given, output.width(), output.height());
}

std::vector<gl::ProgramDesc> ThesisConePass::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    const auto add = [&](const ThesisSettings& settings, Component component, bool count = false) {
        descs.push_back(conesDesc(settings, {component, count, false}));
        descs.push_back(conesDesc(settings, {component, count, true}));
        descs.push_back(conesDesc(settings, {component, count, false, true}));
        for (const bool rectangles : {false, true})
            descs.push_back(conesDesc(settings, {component, count, rectangles, false, true}));
    };
    const auto addBounce = [&](const ThesisSettings& settings) {
        for (const bool environment : {false, true}) descs.push_back(bounceDesc(settings, environment));
    };
    ThesisSettings mended, published, regular;
    published.published = true;
    regular.diffuse.variant = regular.specular.variant = regular.occlusion.variant = ConeVariant::Regular;
    for (const Component component : {Component::Full, Component::Direct, Component::Indirect,
                                      Component::Diffuse, Component::Specular, Component::Occlusion})
        add(mended, component);
    descs.push_back(gather::StepRecorder::variant(conesDesc(mended, {Component::Full})));
    descs.push_back(gather::StepRecorder::variant(conesDesc(mended, {Component::Occlusion})));
    descs.push_back(gather::StepRecorder::variant(conesDesc(published, {Component::Full})));
    add(mended, Component::Full, true);
    add(regular, Component::Full);
    add(published, Component::Full);
    add(published, Component::Full, true);
    regular.published = true;
    add(regular, Component::Full);
    ThesisSettings noCones;
    noCones.frontCone = noCones.intermediateCones = false;
    add(noCones, Component::Full);
    for (ThesisSettings octree : {mended, published}) {
        octree.storage = VolumeStorage::Octree;
        add(octree, Component::Full);
        add(octree, Component::Full, true);
        add(octree, Component::Occlusion);
        addBounce(octree);
    }
    addBounce(mended);
    addBounce(regular);
    // Each defect alone, with all cones.
    ThesisDefects names;
    const std::size_t count = thesisDefectFlags(names).size();
    for (std::size_t i = 0; i < count; ++i) {
        ThesisSettings one;
        one.sideCones = true;
        *thesisDefectFlags(one.defects)[i] = true;
        add(one, Component::Full);
        addBounce(one);
    }
    return descs;
}

}  // namespace conelight::thesis
