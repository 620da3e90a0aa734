// SPDX-License-Identifier: MIT
// The embedding level of the library: the values of mode `traced`, with surfaces that a host has drawn.
#include "conelight/light_field.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "base/log.h"
#include "gather/indirect.h"
#include "gather/light_outputs.h"
#include "gl/debug.h"
#include "gl/gl.h"
#include "gl/host_slots.h"
#include "gl/host_state.h"
#include "light/lights.h"
#include "light/lit_voxels.h"
#include "light/relight_budget.h"
#include "modes/execution.h"
#include "modes/modes.h"
#include "scene/held_scene.h"
#include "view/surfaces.h"
#include "voxels/voxels.h"

namespace conelight::embedded {
extern const char* const kLightField;  // conelight/light_field.glsl
}

namespace conelight {
namespace {

constexpr int kMostReduction = 4;

// What one camera of the host has seen so far.
struct View {
    view::Surfaces surfaces;  // of the pixels that rays are traced for
    view::Surfaces all;       // of all pixels, where those are fewer
    gather::Indirect indirect;
    gather::LightOutputs outputs;
};

}  // namespace

struct LightField::Impl {
    gl::ProgramLibrary programs;
    gl::Profiler profiler;
    gl::Device device;
    Settings settings = realtimeSettings();

    scene::HeldScene scene;
    light::Lights lights;
    voxels::Voxels voxels;
    light::LitVoxels lit;
    light::RelightBudget relightBudget;
    std::map<int, View> views;
    int nextView = 1;

    Impl(gl::ShaderProvider provider, gl::ExecutionProfile profile)
        : programs(gl::providerFor(profile, std::move(provider))), device{programs, profiler, profile} {}
    void forget();
    int update(const LightBudget& budget);
    GatheredLight gather(View& view, const HostSurfaces& host, int reduction);
};

Settings realtimeSettings(Quality quality) {
    Settings settings;
    applyQuality(settings.traced, quality);
    settings.traced.budgeted = true;
    return settings;
}

LightField::LightField(const RendererOptions& options) {
    gl::requireContext();
    if (options.reportGlErrors) gl::installDebugCallback();
    impl_ = std::make_unique<Impl>(options.shaderDirectory.empty()
                                       ? gl::embeddedShaderProvider()
                                       : gl::directoryShaderProvider(options.shaderDirectory),
                                   modes::profileOf(options.execution));
}

LightField::~LightField() {
    // Without the context, what it held is gone with it or cannot be freed.
    std::optional<gl::ForgetNames> forget;
    if (!gl::hasCurrentContext()) forget.emplace();
    impl_.reset();
}

void LightField::setScene(const Scene& scene) {
    scene.validate();  // a scene that is refused leaves the old one in place
    const gl::HostStateGuard guard;
    impl_->forget();
    impl_->scene.set(scene);
}

// Light of another scene says nothing of this one; views stay, without a past.
void LightField::Impl::forget() {
    lights = {};
    voxels = {};
    lit = {};
    for (auto& [number, view] : views) view = {};
}

void LightField::setInstance(std::size_t index, const Instance& instance) {
    impl_->scene.setInstance(index, instance);
}
void LightField::setMesh(std::size_t index, const Mesh& mesh) { impl_->scene.setMesh(index, mesh); }
void LightField::setMaterial(std::size_t index, const Material& material) {
    impl_->scene.setMaterial(index, material);
}
void LightField::setLight(std::size_t index, const Light& light) { impl_->scene.setLight(index, light); }
void LightField::setLights(const std::vector<Light>& lights) { impl_->scene.setLights(lights); }
void LightField::setSky(const glm::vec3& radiance) { impl_->scene.setSky(radiance); }
void LightField::setEnvironment(const Environment& environment) { impl_->scene.setEnvironment(environment); }
std::size_t LightField::addMesh(const Mesh& mesh) { return impl_->scene.addMesh(mesh); }
std::size_t LightField::addTexture(const Texture& texture) { return impl_->scene.addTexture(texture); }
std::size_t LightField::addMaterial(const Material& material) { return impl_->scene.addMaterial(material); }
std::size_t LightField::addInstance(const Instance& instance) { return impl_->scene.addInstance(instance); }
void LightField::removeInstance(std::size_t index) { impl_->scene.removeInstance(index); }
void LightField::removeMesh(std::size_t index) { impl_->scene.removeMesh(index); }
void LightField::setRegion(const Aabb& region) { impl_->scene.setRegion(region); }
const Scene& LightField::scene() const { return impl_->scene.require("scene").source(); }

void LightField::setSettings(const Settings& settings) {
    validateSettings(settings);
    impl_->settings = settings;
}
const Settings& LightField::settings() const { return impl_->settings; }

int LightField::update(const LightBudget& budget) {
    if (budget.updates < 0 || budget.faces < 0 || !(budget.milliseconds >= 0))
        base::fail(ErrorKind::Usage,
                   "update: a budget of %d updates of %d faces within %g ms; 0 or more would be right",
                   budget.updates, budget.faces, budget.milliseconds);
    impl_->scene.require("update");
    const gl::HostStateGuard guard;
    return impl_->update(budget);
}

int LightField::Impl::update(const LightBudget& budget) {
    const double start = light::RelightBudget::begin(budget.milliseconds);
    programs.trim();
    lights.update(device, *scene, {settings.light, /*emitters as lights*/ false, true});
    voxels.update(device, *scene, settings.voxels, voxels::Rays::Yes);
    const light::RelightSettings wanted = light::relightSettings(settings.traced);
    const light::LitVoxels::Inputs inputs{*scene, lights, voxels};
    if (settings.traced.budgeted)
        relightBudget.relight(device, lit, inputs, wanted,
                              {.updates = budget.updates,
                               .faces = static_cast<std::uint32_t>(budget.faces),
                               .milliseconds = budget.milliseconds,
                               .start = start});
    else
        lit.relight(device, inputs, wanted, {.faces = static_cast<std::uint32_t>(budget.faces)});
    return lit.updates();
}

int LightField::addView() {
    const gl::HostStateGuard guard;
    impl_->views.try_emplace(impl_->nextView);
    return impl_->nextView++;
}

void LightField::removeView(int view) {
    const gl::HostStateGuard guard;
    if (impl_->views.erase(view) == 0)
        base::fail(ErrorKind::Usage, "removeView: there is no view %d; one of addView would be right", view);
}

GatheredLight LightField::gather(int view, const HostSurfaces& surfaces, const GatherOptions& options) {
    const auto found = impl_->views.find(view);
    if (found == impl_->views.end())
        base::fail(ErrorKind::Usage, "gather: there is no view %d; one of addView would be right", view);
    if (!impl_->lit.revision())
        base::fail(ErrorKind::Usage, "gather: there is no light yet; update before it would be right");
    if (options.reduction < 1 || options.reduction > kMostReduction)
        base::fail(ErrorKind::Usage, "gather: a reduction of %d; 1 to %d would be right", options.reduction,
                   kMostReduction);
    if (surfaces.width == 0 || surfaces.height == 0) return {};  // of a window that is minimised
    view::requireUsable(surfaces);
    const gl::HostStateGuard guard;
    return impl_->gather(found->second, surfaces, options.reduction);
}

GatheredLight LightField::Impl::gather(View& view, const HostSurfaces& host, int reduction) {
    programs.trim();
    view.surfaces.take(device, *scene, host, reduction);
    const gather::RayInputs traced{*scene, lights, voxels, lit, view.surfaces};
    view.indirect.gather(device, traced, {settings.traced, {.diffuse = true, .specular = true}});
    if (reduction > 1) {
        view.all.take(device, *scene, host, 1);
        const gather::RayInputs all{*scene, lights, voxels, lit, view.all};
        view.indirect.carry(device, all, settings.traced).finish();
        view.outputs.draw(device, all, view.indirect, settings.traced.specularLimit);
    } else {
        view.outputs.draw(device, traced, view.indirect, settings.traced.specularLimit);
    }
    return {view.outputs.diffuse().name(), view.outputs.specular().name(), host.width, host.height};
}

// As tools/make_lookups has them.
namespace {
constexpr gl::ResourceName kLookupBlocks[] = {"VoxelGridBlock", "LightingBlock"};
constexpr gl::ResourceName kLookupTextures[] = {"voxelBricks",       "voxelOctants", "voxelRecords",
                                                "voxelFaces",        "faceLight",    "litFaces",
                                                "environmentPicture"};
static_assert(std::size(kLookupBlocks) == LookupSlots::kBlocks);
static_assert(std::size(kLookupTextures) == LookupSlots::kTextures);
}  // namespace

std::string lookupsGlsl(const LookupSlots& slots) {
    return "#define CONELIGHT_FIRST_BLOCK " + std::to_string(slots.firstBlock) +
           "\n#define CONELIGHT_FIRST_TEXTURE " + std::to_string(slots.firstTexture) + "\n" +
           embedded::kLightField;
}

void LightField::bindLookups(const LookupSlots& slots) const {
    if (!impl_->lit.revision())
        base::fail(ErrorKind::Usage, "bindLookups: there is no light yet; update before it would be right");
    gl::Inputs given;
    given.add(impl_->lights).add(impl_->voxels).add(impl_->lit);
    given.texture("voxelOctants", impl_->voxels.octants().texture());
    gl::bindForHost(given, {kLookupBlocks, slots.firstBlock, kLookupTextures, slots.firstTexture});
}

namespace modes {

std::vector<gl::ProgramDesc> lightFieldProgramDescs() {
    std::vector<gl::ProgramDesc> descs = view::HostSurfaceImport::programDescs();
    for (gl::ProgramDesc& desc : gather::LightOutputs::programDescs()) descs.push_back(std::move(desc));
    return descs;
}

}  // namespace modes
}  // namespace conelight
