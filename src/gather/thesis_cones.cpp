// SPDX-License-Identifier: MIT
#include "gather/thesis_cones.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include "conelight/thesis/settings.h"

#include "base/log.h"
#include "gather/picture_parts.h"
#include "gl/gl.h"
#include "shared/bindings.h"

namespace conelight::gather {
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

using Flag = bool thesis::ThesisDefects::*;
struct Define {
    const char* name;
    Flag flag;
};

// Defects that the cone kernel knows.
constexpr Define kDefines[] = {
    {"COARSE_LOD", &thesis::ThesisDefects::coarseLod},
    {"NO_STEP_CORRECTION", &thesis::ThesisDefects::noStepCorrection},
    {"FORGET_NEAR_COLOR", &thesis::ThesisDefects::forgetNearColor},
    {"DOUBLE_ALPHA", &thesis::ThesisDefects::doubleAlpha},
    {"LAST_STEP", &thesis::ThesisDefects::lastStep},
    {"PREMULTIPLIED_FIRST_HIT", &thesis::ThesisDefects::premultipliedFirstHit},
    {"HARD_FIRST_HIT", &thesis::ThesisDefects::hardFirstHit},
    {"FIXED_OFFSETS", &thesis::ThesisDefects::fixedOffsets},
    {"SHORT_REACH", &thesis::ThesisDefects::shortReach},
    {"NAN_AXES", &thesis::ThesisDefects::nanAxes},
    {"SHORT_SIDE_AXIS", &thesis::ThesisDefects::shortSideAxis},
    {"GRAZING_SIDE_CONES", &thesis::ThesisDefects::grazingSideCones},
    {"NO_COSINE_WEIGHTS", &thesis::ThesisDefects::noCosineWeights},
    {"NO_ALBEDO", &thesis::ThesisDefects::noAlbedo},
    {"OCCLUSION_FUDGE", &thesis::ThesisDefects::occlusionFudge},
    {"OCCLUDED_INDIRECT", &thesis::ThesisDefects::occludedIndirect},
    {"SPECULAR_PER_LIGHT", &thesis::ThesisDefects::specularPerLight},
    {"OCCLUDED_SPECULAR", &thesis::ThesisDefects::occludedSpecular},
    {"SHININESS_SATURATION", &thesis::ThesisDefects::shininessSaturation},
    {"UNBOUNDED_SPECULAR", &thesis::ThesisDefects::unboundedSpecular},
    {"FINE_STEPS", &thesis::ThesisDefects::fineSteps},
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

int coneKind(bool on, thesis::ConeVariant variant) {
    return !on ? 0 : variant == thesis::ConeVariant::Regular ? 1 : 2;
}

gl::ProgramDesc conesDesc(const thesis::ThesisSettings& settings, Component component, bool countLookups) {
    const thesis::ThesisDefects defects = effectiveDefects(settings);
    const int view = viewOf(component);
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
                        {"COUNT_LOOKUPS", countLookups ? "1" : "0"}};
    for (const Define& define : kDefines)
        if (defects.*define.flag) defines.emplace_back(define.name, "1");
    return {{"gather/thesis_cones.comp.glsl"}, defines};
}

}  // namespace

thesis::ThesisDefects effectiveDefects(const thesis::ThesisSettings& settings) {
    if (!settings.published) return settings.defects;
    thesis::ThesisDefects d;
    for (bool* flag : thesis::thesisDefectFlags(d)) *flag = true;
    return d;
}

gpu::ThesisConstants thesisConstants(const thesis::ThesisSettings& s, const gpu::ThesisGrid& grid, int size) {
    const thesis::ThesisDefects d = effectiveDefects(s);
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
    // Shadows of a lamp a tenth of its distance in radius; twice that needs the original's damping to keep
    // walls beside the cone out of it (chosen by eye).
    const float lamp = d.occlusionFudge ? 0.4f : 0.2f;
    const bool fromShininess = s.specular.aperture.isAuto && !d.fixedSpecularAperture;
    const float specularTable = tableValue(size, 0.04f, 0.02f, 0.01f);
    c.diffuseCone = {spreadOf(s.diffuse.aperture.resolve(d.noCosineWeights ? 0.55f : shared)),
                     factor(s.diffuse.distFactor, tableValue(size, 0.1f, 0.01f, 0.1f), 1.0f),
                     start(s.diffuse.offset, 0.19f), 1.0f};
    c.specularCone = {fromShininess ? 0.0f : spreadOf(s.specular.aperture.resolve(specularTable)),
                      factor(s.specular.distFactor, tableValue(size, 0.8f, 0.3f, 0.15f), 0.8f),
                      start(s.specular.offset, tableValue(size, 0.15f, 0.15f, 0.05f)), 1.0f};
    c.occlusionCone = {spreadOf(s.occlusion.aperture.resolve(lamp)),
                       factor(s.occlusion.distFactor, tableValue(size, 0.35f, 0.35f, 0.1f), 0.8f),
                       start(s.occlusion.offset, 0.08f), 0.0f};
    checkCone("diffuse", c.diffuseCone, false);
    checkCone("specular", c.specularCone, fromShininess);
    checkCone("occlusion", c.occlusionCone, false);
    c.originOffset = s.diffuseOriginOffset.resolve(0.05f);
    c.shininessFalloff = s.shininessFalloff.resolve(tableValue(size, 3.0f, 3.0f, 2.0f));
    c.shadowStrength = s.shadowStr;
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

void ThesisConePass::bind(const scene::GpuScene& scene, const view::GBuffer& gbuffer,
                          const voxels::ThesisVolume& volume, const Settings& settings) {
    gpu::ThesisConstants constants =
        thesisConstants(settings.groups.of<thesis::ThesisSettings>(), volume.grid(), settings.voxels.size);
    const std::size_t lights = scene.lights().size();
    constants.lightCount =
        static_cast<std::uint32_t>(effectiveDefects(settings.groups.of<thesis::ThesisSettings>()).tenLights
                                       ? std::min<std::size_t>(lights, 10)
                                       : lights);
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::ThesisConstants), "thesis constants");
    constants_.update(constants);
    constants_.bindUniform(BINDING_PASS);
    gbuffer.bind();
    volume.bind(UNIT_PASS);
    volume.bindGrid();
}

void ThesisConePass::record(gl::ProgramLibrary& programs, const scene::GpuScene& scene,
                            const view::GBuffer& gbuffer, const voxels::ThesisVolume& volume,
                            const Settings& settings, StepRecorder& recorder) {
    bind(scene, gbuffer, volume, settings);
    const bool gathered = partsOf(settings.component).diffuse || partsOf(settings.component).specular ||
                          settings.component == Component::Occlusion;
    recorder.record(programs, conesDesc(settings.groups.of<thesis::ThesisSettings>(),
                                        gathered ? settings.component : Component::Full, false));
    gl::unbindSampler(UNIT_PASS);
}

void ThesisConePass::render(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                            const scene::GpuScene& scene, const view::GBuffer& gbuffer,
                            const voxels::ThesisVolume& volume, const Settings& settings,
                            const gl::Texture& output, const gl::Buffer* lookupCounters) {
    const gl::PassScope pass(profiler, "thesis cones");
    bind(scene, gbuffer, volume, settings);
    output.bindImage(0, 0, GL_WRITE_ONLY);
    if (lookupCounters != nullptr) lookupCounters->bindStorage(BINDING_STORAGE_PASS);
    programs
        .get(conesDesc(settings.groups.of<thesis::ThesisSettings>(), settings.component,
                       lookupCounters != nullptr))
        .dispatch(output.width(), output.height());
    gl::unbindSampler(UNIT_PASS);
}

std::vector<gl::ProgramDesc> ThesisConePass::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    const auto add = [&](const thesis::ThesisSettings& settings, Component component, bool count = false) {
        descs.push_back(conesDesc(settings, component, count));
    };
    thesis::ThesisSettings mended, published, regular;
    published.published = true;
    regular.diffuse.variant = regular.specular.variant = regular.occlusion.variant =
        thesis::ConeVariant::Regular;
    for (const Component component : {Component::Full, Component::Direct, Component::Indirect,
                                      Component::Diffuse, Component::Specular, Component::Occlusion})
        add(mended, component);
    descs.push_back(StepRecorder::variant(conesDesc(mended, Component::Full, false)));
    descs.push_back(StepRecorder::variant(conesDesc(mended, Component::Occlusion, false)));
    descs.push_back(StepRecorder::variant(conesDesc(published, Component::Full, false)));
    add(mended, Component::Full, true);
    add(regular, Component::Full);
    add(published, Component::Full);
    add(published, Component::Full, true);
    regular.published = true;
    add(regular, Component::Full);
    // Each defect alone, with all cones.
    thesis::ThesisDefects names;
    const std::size_t count = thesis::thesisDefectFlags(names).size();
    for (std::size_t i = 0; i < count; ++i) {
        thesis::ThesisSettings one;
        one.sideCones = true;
        *thesis::thesisDefectFlags(one.defects)[i] = true;
        add(one, Component::Full);
    }
    return descs;
}

}  // namespace conelight::gather
