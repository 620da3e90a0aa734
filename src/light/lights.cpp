// SPDX-License-Identifier: MIT
#include "light/lights.h"

#include <algorithm>
#include <span>
#include <utility>

#include "gl/gl.h"
#include "gl/pace.h"
#include "math/brdf.h"
#include "scene/emissive_quads.h"
#include "scene/gpu_lights.h"
#include "scene/gpu_materials.h"
#include "scene/small_lamps.h"
#include "shared/lighting.h"

namespace conelight::light {
namespace {

// More lights than these are taken from faces, not looked up at every hit: the shadow maps of 4 cost as much
// as the ray itself. Those of five in builtin:atrium gain more than they cost there (docs/notes/2026-11-25-gloss.md).
constexpr std::uint32_t kMostExactLights = 8;

constexpr std::uint32_t kShaped = LIGHT_DISK | LIGHT_SPHERE | ~0u << LIGHT_PROFILE_SHIFT;

// What lobes rays may meet. Metals bring those of dielectrics with them.
enum class Lobes { None, Dielectrics, Metals };
Lobes lobesOf(const scene::GpuScene& scene) {
    Lobes found = Lobes::None;
    for (const gpu::Instance& instance : scene.instances()) {
        const gpu::Material& m = scene.materials()[instance.material];
        if ((instance.flags & INSTANCE_VOXELIZED) == 0 || (m.flags & MATERIAL_UNLIT) != 0) continue;
        if (math::metallicSurface(m.baseColor, m.metallic, m.specularF0).metallic > 0) return Lobes::Metals;
        if (scene::isGlossyDielectric(m)) found = Lobes::Dielectrics;
    }
    return found;
}

}  // namespace

Lights::Lights() : block_(sizeof(gpu::LightingConstants), "lighting") {}

base::Steps Lights::updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                  LightsWanted wanted) {
    const Sources sources{scene.identity(), scene.geometryRevision(), scene.lightRevision(),
                          scene.skyRevision(), wanted};
    if (revision_ && from_ == sources) co_return;
    revision_ = {};
    quarters_ = 0;
    turning_ = false;
    fillTable(scene, wanted);
    const bool veils =
        wanted.veils && wanted.shadowMaps && wanted.settings.shadowSize > 0 && scene::hasVeils(scene);
    LampTree tree;
    if (wantsTree(scene, wanted)) tree = LampTree::over(std::span(table_).first(ends_.y));
    lampsOfTree_ = tree.nodes.empty() ? 0 : ends_.y;
    if (wanted.shadowMaps) co_await drawShadows(device, scene, wanted.settings, veils);
    environment_.update(scene.source().environment);
    updateProfiles(scene::profilesOf(scene.source().lights));
    co_await gl::rest(device);
    glass_.update(scene, veils);
    upload(scene.source());
    lamps_.update(tree);
    from_ = sources;
    profile_ = device.profile;
    if (hasGlass() || hasCaustics()) caustics_.clear();
    revision_ = ownRevision_ = base::Revision::next();
}

bool Lights::drawsAreaShadows() const {
    return from_.wanted.shadowMaps && from_.wanted.settings.shadowSize > 0 &&
           from_.wanted.settings.areaSamples > 1 && ends_.w > ends_.z;
}

base::Steps Lights::turnInSteps(const gl::Device& device, const scene::GpuScene& scene, int quarters) {
    if ((quarters == quarters_ && !turning_) || !drawsAreaShadows()) co_return;
    turning_ = true;
    for (; quarters_ != quarters; quarters_ = (quarters_ + 1) % 4)
        for (auto light = table_.begin() + static_cast<std::ptrdiff_t>(ends_.z); light != table_.end();
             ++light)
            light->halfU = std::exchange(light->halfV, -light->halfU);
    co_await drawShadows(device, scene, from_.wanted.settings, hasVeils());
    upload(scene.source());
    turning_ = false;
}

// Rays find what is in the voxels: where something else casts shadows, lamps need maps.
bool Lights::wantsTree(const scene::GpuScene& scene, const LightsWanted& wanted) const {
    constexpr std::uint32_t kBoth = INSTANCE_CASTS_SHADOW | INSTANCE_VOXELIZED;
    return wanted.lampTree && ends_.y > static_cast<std::uint32_t>(wanted.settings.exactLamps) &&
           std::none_of(scene.instances().begin(), scene.instances().end(),
                        [](const gpu::Instance& i) { return (i.flags & kBoth) == INSTANCE_CASTS_SHADOW; });
}

// Of all lights but those of a tree.
base::Steps Lights::drawShadows(const gl::Device& device, const scene::GpuScene& scene,
                                LightSettings settings, bool veils) {
    if (lampsOfTree_ == 0) {
        co_await shadows_.updateInSteps(device, scene, settings, veils, table_);
        co_return;
    }
    const auto first = table_.begin() + static_cast<std::ptrdiff_t>(lampsOfTree_);
    std::vector<gpu::Light> others(first, table_.end());
    co_await shadows_.updateInSteps(device, scene, settings, veils, others);
    std::copy(others.begin(), others.end(), first);
    // Without shadows no ray is asked for.
    if (settings.shadowSize == 0)
        for (auto lamp = table_.begin(); lamp != first; ++lamp) lamp->flags &= ~LIGHT_CASTS_SHADOW;
}

bool Lights::castsCaustics() const {
    return from_.wanted.caustics && from_.wanted.settings.caustics > 0 && key().glass &&
           !glass_.solids().empty();
}

base::Steps Lights::castCausticsInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                        const voxels::Voxels& voxels) {
    if (!castsCaustics()) co_return;
    if (lightsOfCaustics_ == ownRevision_ && voxelsOfCaustics_ == voxels.revision()) co_return;
    lightsOfCaustics_ = {};
    const Caustics::Inputs inputs{scene, *this, voxels};
    co_await caustics_.castInSteps(device, inputs, glass_.solids(), from_.wanted.settings.caustics);
    lightsOfCaustics_ = ownRevision_;
    voxelsOfCaustics_ = voxels.revision();
    revision_ = base::Revision::next();
}

// Area lights are the last kind, so the table stays sorted.
void Lights::addEmitter(const Light& light, std::size_t instance) {
    table_.push_back(scene::packedLights({light}).front());
    table_.back().flags |= LIGHT_FROM_EMITTER;
    table_.back().customFalloff = static_cast<std::uint32_t>(instance);
    emitters_[instance] = 1;
}

void Lights::fillTable(const scene::GpuScene& gpuScene, const LightsWanted& wanted) {
    const Scene& scene = gpuScene.source();
    table_ = scene::packedLights(scene.lights);
    emitters_.assign(scene.instances.size(), 0);
    if (wanted.emissiveQuads)
        for (const scene::EmissiveQuad& quad : scene::emissiveQuads(scene))
            addEmitter(quad.light, quad.instance);
    if (wanted.smallLamps)
        for (const scene::SmallLamp& lamp : scene::smallLamps(scene, gpuScene.firstBounds())) {
            addEmitter(lamp.light, lamp.instance);
            if (lamp.light.type == LightType::Rect) table_.back().flags |= LIGHT_SIDE;
        }
    ends_ = scene::lightEnds(table_);
    shaped_ = std::any_of(table_.begin(), table_.end(),
                          [](const gpu::Light& one) { return (one.flags & kShaped) != 0; });
}

void Lights::updateProfiles(scene::Profiles profiles) {
    if (profileMap_ && profiles == profiles_) return;
    profiles_ = std::move(profiles);
    profileMap_ = {};
    const int layers = static_cast<int>(profiles_.size());
    if (layers == 0) {  // shaders that may meet any light want one
        profileMap_ = gl::Texture({GL_TEXTURE_2D_ARRAY, GL_R32F}, "light profiles");
        return;
    }
    profileMap_ =
        gl::Texture({GL_TEXTURE_2D_ARRAY, GL_R32F, LightProfile::kColumns, LightProfile::kRows, layers},
                    "light profiles");
    for (int layer = 0; layer < layers; ++layer)
        profileMap_.uploadLayer(0, layer, GL_RED, GL_FLOAT,
                                profiles_[static_cast<std::size_t>(layer)]->factors.data());
}

void Lights::makeTable() {
    tableTexels_ = {};
    tableBuffer_ = gl::Buffer(table_, "lights");
    tableTexels_ = gl::Texture(tableBuffer_, GL_RGBA32UI, "lights");
}

void Lights::upload(const Scene& scene) {
    if (!tableBuffer_ || table_.size() * sizeof(gpu::Light) > tableBuffer_.bytes())
        makeTable();
    else
        tableBuffer_.update(0, table_.data(), table_.size() * sizeof(gpu::Light));
    gpu::LightingConstants constants{};
    constants.sky = scene.sky;
    hasConstantSky_ = scene.sky != glm::vec3(0);
    constants.lightEnds = ends_;
    environment_.describe(scene.environment, constants);
    block_.update(constants);
}

void Lights::declare(gl::Inputs& inputs) const {
    inputs.storage("LightTable", tableBuffer_)
        .texture("lightTexels", tableTexels_)
        .uniform("LightingBlock", block_)
        .uniform("FixedLightBlock", tableBuffer_)
        .uniform("FixedLightRows", tableBuffer_)
        .texture("lightProfiles", profileMap_)
        .add(lamps_)
        .add(shadows_)
        .add(environment_)
        .add(glass_);
    if (hasGlass()) inputs.add(caustics_);
}

LightKey Lights::key() const {
    const glm::uvec4 asked = ends_ - glm::min(ends_, glm::uvec4(lampsOfTree_));
    LightKey key = LightKey::of(asked, shaped_, from_.wanted.settings.shadowSize > 0,
                                from_.wanted.settings.shadowFilter, profile_);
    // Exact numbers tell where a light is in the table, which begins with the tree's.
    if (lampsOfTree_ > 0 && asked.w > 0) {
        key.fixed = false;
        for (int* kind : {&key.directional, &key.rect}) *kind = std::min(*kind, 1);
    }
    key.glass = hasGlass() && key.shadows;
    return key;
}

LampKey Lights::lampKey() const {
    const bool glass = hasGlass() && from_.wanted.settings.shadowSize > 0;
    return {shaped_, glass, glass && hasVeils()};
}

HitKey Lights::hitKey(const scene::GpuScene& scene, bool exactDirect) const {
    HitKey key;
    const Lobes lobes = lobesOf(scene);
    key.lobes = lobes == Lobes::Metals;
    key.environment = hasEnvironment();
    key.guided = guidesToSky();
    key.glass = hasGlass();
    key.lights.shaped = shaped_;
    key.exact = exactDirect && ends_.z > 0 && ends_.z <= kMostExactLights && lampsOfTree_ == 0;
    if (!key.exact) return key;
    key.gloss = lobes == Lobes::Dielectrics;
    // One comparison of four texels per light: rays average edges anyway.
    key.lights = this->key();
    key.lights.rect = 0;
    key.lights.glass = false;  // the key's own
    key.lights.filter = 0;
    return key;
}

}  // namespace conelight::light
