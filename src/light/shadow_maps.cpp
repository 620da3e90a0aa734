// SPDX-License-Identifier: MIT
#include "light/shadow_maps.h"

#include <algorithm>

#include "base/log.h"
#include "gl/gl.h"
#include "gl/pace.h"
#include "light/shadow_layout.h"
#include "scene/culling.h"
#include "shared/shadow_map.h"

namespace conelight::light {
namespace {

bool isMasked(const gpu::Material& material) {
    return (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0;
}

struct ShadowKey {
    bool masked, surfaces;

    gl::ProgramDesc desc() const {
        gl::ProgramDesc desc{{"light/shadow.vert.glsl"},
                             {{"MASKED", masked ? "1" : "0"}, {"SURFACES", surfaces ? "1" : "0"}}};
        if (surfaces) desc.files.emplace_back("light/shadow.geom.glsl");
        if (masked || surfaces) desc.files.emplace_back("light/shadow.frag.glsl");
        return desc;
    }
    static std::vector<ShadowKey> all() {
        return {{false, false}, {false, true}, {true, false}, {true, true}};
    }
};

}  // namespace

struct ShadowMaps::Impl {
    gl::Texture maps, surfaces;
    gl::Sampler plainSampler;  // depths as numbers, without comparison
    std::vector<gl::Framebuffer> layers;
    gl::Buffer viewBlock;

    // What was drawn last, and the scene it was drawn of.
    std::vector<ShadowView> drawnViews;
    base::Revision sceneIdentity;
    std::vector<base::Revision> revisions;
    std::vector<Aabb> casterBoxes;  // empty: casts no shadow
    std::vector<char> stale;        // views whose map is not of that scene yet
    int redrawn = 0;
    bool leavesVeils = false;

    void allocate(int size, int layerCount, int surfaceLayers) {
        // No surfaces: one texel, for the sampler.
        const int surfaceSize = surfaceLayers > 0 ? size : 1;
        if (maps && maps.width() == size && maps.depth() == layerCount && surfaces.width() == surfaceSize &&
            surfaces.depth() == std::max(surfaceLayers, 1))
            return;
        drawnViews.clear();
        layers.clear();
        maps = {};  // the old ones first: both together may not fit
        surfaces = {};
        maps =
            gl::Texture({GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, size, size, layerCount}, "shadow maps");
        surfaces = gl::Texture(
            {GL_TEXTURE_2D_ARRAY, GL_RG32UI, surfaceSize, surfaceSize, std::max(surfaceLayers, 1)},
            "shadow surfaces");
        surfaces.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        surfaces.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        surfaces.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        surfaces.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        maps.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        maps.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        maps.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        maps.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        maps.parameter(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        maps.parameter(GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);  // reversed depth: visible when not farther
        for (int layer = 0; layer < layerCount; ++layer)
            layers.push_back(gl::Framebuffer::depthLayer(maps, layer, "shadow layer " + std::to_string(layer),
                                                         layer < surfaceLayers ? &surfaces : nullptr));
        clear();
    }

    void clear() {
        const float nothing = 0.0f;
        maps.clear(0, GL_DEPTH_COMPONENT, GL_FLOAT, &nothing);
        surfaces.clear(0, GL_RG_INTEGER, GL_UNSIGNED_INT, nullptr);
    }

    // Of one map.
    void clear(const ShadowView& view) {
        const glm::ivec3 corner(view.x, view.y, view.layer), extent(view.width, view.height, 1);
        maps.clearRegion(0, corner, extent, GL_DEPTH_COMPONENT, GL_FLOAT);
        if (view.surfaces) surfaces.clearRegion(0, corner, extent, GL_RG_INTEGER, GL_UNSIGNED_INT);
    }

    bool casts(const gpu::Instance& instance) const {
        const std::uint32_t asked = INSTANCE_CASTS_SHADOW | (leavesVeils ? INSTANCE_VEIL : 0u);
        return (instance.flags & asked) == INSTANCE_CASTS_SHADOW;
    }
    Aabb casterBox(const scene::GpuScene& scene, std::size_t instance) const {
        return casts(scene.instances()[instance]) ? scene.instanceBounds(instance) : Aabb{};
    }
    void draw(const gl::Device& device, const scene::GpuScene& scene, const ShadowView& view);
    bool look(const scene::GpuScene& scene, const std::vector<ShadowView>& views);
    bool keepsPlaces(const scene::GpuScene& scene, const std::vector<ShadowView>& views) const;
    std::vector<Aabb> changedBoxes(const scene::GpuScene& scene) const;
    void remember(const scene::GpuScene& scene, const std::vector<ShadowView>& views);
};

namespace {

// What it is seen by whether something casts shadows into a map: clamped ones have no near side.
glm::mat4 castersOf(const ShadowView& view) {
    glm::mat4 seen = view.clipFromWorld;
    if (view.clamped)
        for (int column = 0; column < 4; ++column) seen[column].z = 0;
    return seen;
}

}  // namespace

// Whether the maps hold the same views of the same scene, moved at most.
bool ShadowMaps::Impl::keepsPlaces(const scene::GpuScene& scene, const std::vector<ShadowView>& views) const {
    return sceneIdentity == scene.identity() &&
           std::equal(views.begin(), views.end(), drawnViews.begin(), drawnViews.end(),
                      [](const ShadowView& a, const ShadowView& b) { return a.samePlace(b); });
}

// Where casters have changed since the maps were drawn: old boxes and new ones.
std::vector<Aabb> ShadowMaps::Impl::changedBoxes(const scene::GpuScene& scene) const {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < scene.instances().size(); ++i) {
        const bool added = i >= revisions.size();
        if (!added && revisions[i] == scene.casterRevision(i)) continue;
        for (const Aabb& box : {added ? Aabb{} : casterBoxes[i], casterBox(scene, i)})
            if (!box.empty()) boxes.push_back(box);
    }
    return boxes;
}

void ShadowMaps::Impl::remember(const scene::GpuScene& scene, const std::vector<ShadowView>& views) {
    drawnViews = views;
    sceneIdentity = scene.identity();
    revisions.resize(scene.instances().size());
    casterBoxes.resize(revisions.size());
    for (std::size_t i = 0; i < revisions.size(); ++i) {
        revisions[i] = scene.casterRevision(i);
        casterBoxes[i] = casterBox(scene, i);
    }
}

void ShadowMaps::Impl::draw(const gl::Device& device, const scene::GpuScene& scene, const ShadowView& view) {
    gl::RasterState state;
    state.framebuffer = &layers[static_cast<std::size_t>(view.layer)];
    state.cull = gl::Cull::None;
    state.reversedDepth = true;
    state.depthClamp = view.clamped;
    state.viewport[0] = view.x;
    state.viewport[1] = view.y;
    state.viewport[2] = view.width;
    state.viewport[3] = view.height;
    gl::apply(state);
    const glm::vec2 half = 0.5f * glm::vec2(view.width, view.height);
    viewBlock.update(gpu::ShadowMapConstants{
        view.clipFromWorld, view.slopeUnit, glm::vec2(view.x, view.y) + half, half, {}});
    gl::Inputs inputs;
    inputs.uniform("ShadowMapBlock", viewBlock).add(scene);
    scene::GpuScene::declareMaterialTextures(inputs);

    const glm::mat4 casters = castersOf(view);
    const std::vector<gpu::Instance>& instances = scene.instances();
    std::vector<char> drawn(instances.size());
    bool anyOf[2] = {false, false};
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!casts(instances[i]) || static_cast<int>(i) == view.without) continue;
        if (scene::isOutside(casters, scene.instanceBounds(i))) continue;
        const bool masked = isMasked(scene.materials()[instances[i].material]);
        drawn[i] = masked ? 2 : 1;
        anyOf[masked ? 1 : 0] = true;
    }
    for (const bool masked : {false, true}) {
        if (!anyOf[masked ? 1 : 0]) continue;
        const gl::Program& program = device.get(ShadowKey{masked, view.surfaces}.desc());
        program.use(inputs);
        const auto accepted = [&](const gpu::Instance& instance) {
            return drawn[static_cast<std::size_t>(&instance - instances.data())] == (masked ? 2 : 1);
        };
        // Of a mesh in the middle of the scene each side of a cube sees a part only.
        scene.draw({.filter = accepted,
                    .textured = masked ? &program : nullptr,
                    .part = scene::partsWithin(casters),
                    .together = device.profile == gl::ExecutionProfile::Gpu});
    }
}

ShadowMaps::ShadowMaps() : impl_(std::make_unique<Impl>()) {
    impl_->allocate(8, 1, 0);
    impl_->viewBlock = gl::Buffer(sizeof(gpu::ShadowMapConstants), "shadow view");
    impl_->plainSampler = gl::Sampler({GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE}, "shadow depths");
}
ShadowMaps::~ShadowMaps() = default;

ShadowMaps::ShadowMaps(ShadowMaps&&) noexcept = default;
ShadowMaps& ShadowMaps::operator=(ShadowMaps&&) noexcept = default;

// Which maps are to be drawn: all, which are clear then, or those that look different now or see a caster that changed.
bool ShadowMaps::Impl::look(const scene::GpuScene& scene, const std::vector<ShadowView>& views) {
    const bool whole = !keepsPlaces(scene, views);
    const std::vector<Aabb> changed = whole ? std::vector<Aabb>{} : changedBoxes(scene);
    if (whole) {
        clear();
        stale.assign(views.size(), 1);
    } else {
        for (std::size_t i = 0; i < views.size(); ++i) {
            const bool touched = views[i].clipFromWorld != drawnViews[i].clipFromWorld ||
                                 views[i].without != drawnViews[i].without ||
                                 std::any_of(changed.begin(), changed.end(), [&](const Aabb& box) {
                                     return !scene::isOutside(castersOf(views[i]), box);
                                 });
            if (touched) stale[i] = 1;
        }
    }
    remember(scene, views);
    return whole;
}

base::Steps ShadowMaps::updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                      const LightSettings& settings, bool leavesVeils,
                                      std::vector<gpu::Light>& lights) {
    ShadowLayout layout = layOutShadows(scene.bounds(), scene.firstBounds(), settings, lights);
    layout.leavesVeils = leavesVeils;
    const int asked = settings.shadowSize / 8 * 8;
    if (layout.layers > 0 && layout.size < asked && layout.size != impl_->maps.width())
        base::log(LogLevel::Info, "shadow maps of " + std::to_string(layout.size) + " texels, not " +
                                      std::to_string(asked) + ": many lights share their memory");
    co_await drawInSteps(device, scene, std::move(layout), "shadow maps");
}

base::Steps ShadowMaps::drawInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                    ShadowLayout layout, const char* name) {
    gl::PassSteps pass(device, name);
    impl_->redrawn = 0;
    if (impl_->leavesVeils != layout.leavesVeils) impl_->drawnViews.clear();
    impl_->leavesVeils = layout.leavesVeils;
    if (layout.layers == 0) {
        impl_->allocate(8, 1, 0);
        co_return;
    }
    impl_->allocate(layout.size, layout.layers, layout.surfaceLayers);
    const bool whole = impl_->look(scene, layout.views);
    for (std::size_t i = 0; i < layout.views.size(); ++i) {
        if (impl_->stale[i] == 0) continue;
        if (!whole) impl_->clear(layout.views[i]);
        impl_->draw(device, scene, layout.views[i]);
        impl_->stale[i] = 0;
        ++impl_->redrawn;
        co_await pass.rest();
    }

    // Leave neither reversed depth nor a scissor behind.
    gl::RasterState plain;
    plain.framebuffer = &impl_->layers.front();
    gl::apply(plain);
}

int ShadowMaps::redrawn() const { return impl_->redrawn; }
bool ShadowMaps::leavesVeils() const { return impl_->leavesVeils; }

void ShadowMaps::declare(gl::Inputs& inputs) const {
    inputs.texture("shadowMaps", impl_->maps)
        .texture("shadowDepths", impl_->maps, &impl_->plainSampler)
        .texture("shadowSurfaces", impl_->surfaces);
}

void ShadowMaps::declareAs(gl::Inputs& inputs, gl::ResourceName depths, gl::ResourceName surfaces) const {
    inputs.texture(depths, impl_->maps, &impl_->plainSampler).texture(surfaces, impl_->surfaces);
}

std::size_t ShadowMaps::bytes() const {
    ShadowLayout layout;
    layout.layers = impl_->maps.depth();
    layout.surfaceLayers = impl_->surfaces.width() > 1 ? impl_->surfaces.depth() : 0;
    return layout.bytes(impl_->maps.width());
}

std::vector<gl::ProgramDesc> ShadowMaps::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const ShadowKey& key : ShadowKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::light
