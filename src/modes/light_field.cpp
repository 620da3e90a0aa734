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
#include "gl/buffer.h"
#include "gl/debug.h"
#include "gl/gl.h"
#include "gl/host_slots.h"
#include "light/lights.h"
#include "light/lit_voxels.h"
#include "light/relight_budget.h"
#include "modes/execution.h"
#include "modes/memory_stats.h"
#include "modes/modes.h"
#include "modes/owner_guard.h"
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
    std::uint32_t owner = 0;
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
    LightFieldStats stats;
    std::uint64_t visitedBefore = 0;  // faces, by the last update()

    explicit Impl(const RendererOptions& options) : Impl(options, modes::profileOf(options.execution)) {}
    Impl(const RendererOptions& options, gl::ExecutionProfile profile)
        : programs(modes::shadersOf(options, profile), modes::programsOf(options)),
          device{programs, profiler, profile} {}
    modes::OwnerScene changed() { return {owner, scene}; }
    void forget();
    void voxelize();
    // With programs for nested grids where the voxels are in such.
    gl::Device nested() const {
        gl::Device nested = device;
        nested.nestedGrids = voxels.grid().levels > 1;
        return nested;
    }
    int update(const LightBudget& budget);
    GatheredLight gather(View& view, const HostSurfaces& host, int reduction);
};

Settings realtimeSettings(Quality quality) {
    // Rays of pixels average many faces, lookups of hosts do not. A frame takes no longer for it.
    constexpr int kUpdatesOfLookups = 32;
    Settings settings;
    applyQuality(settings.traced, quality);
    settings.traced.cacheUpdates = std::max(settings.traced.cacheUpdates, kUpdatesOfLookups);
    settings.traced.budgeted = true;
    return settings;
}

LightField::LightField(const RendererOptions& options) {
    gl::requireContext();
    if (options.reportGlErrors) gl::installDebugCallback();
    const std::uint32_t owner = gl::newOwner();
    const gl::OwnerScope own(owner);
    impl_ = std::make_unique<Impl>(options);
    impl_->owner = owner;
    impl_->stats.device = gl::rendererName();
}

LightField::~LightField() {
    // Without the context, what it held is gone with it or cannot be freed.
    std::optional<gl::ForgetNames> forget;
    if (!gl::hasCurrentContext()) forget.emplace();
    impl_.reset();
}

void LightField::setScene(const Scene& scene) {
    scene.validate();  // a scene that is refused leaves the old one in place
    const modes::OwnerGuard call(impl_->owner);
    impl_->forget();
    impl_->scene.set(scene);
}

// Light of another scene says nothing of this one; views stay, without a past.
void LightField::Impl::forget() {
    lights = {};
    voxels = {};
    lit = {};
    visitedBefore = 0;
    for (auto& [number, view] : views) view = {};
}

void LightField::setInstance(std::size_t index, const Instance& instance) {
    impl_->changed()->setInstance(index, instance);
}
void LightField::setMesh(std::size_t index, const Mesh& mesh) { impl_->changed()->setMesh(index, mesh); }
void LightField::setMesh(std::size_t index, const HostMesh& mesh) {
    impl_->changed()->setMesh(impl_->device, index, mesh);
}
void LightField::setTexture(std::size_t index, const Texture& texture) {
    impl_->changed()->setTexture(index, texture);
}
void LightField::setTexture(std::size_t index, const HostTexture& texture) {
    impl_->changed()->setTexture(impl_->device, index, texture);
}
void LightField::setMaterial(std::size_t index, const Material& material) {
    impl_->changed()->setMaterial(index, material);
}
void LightField::setLight(std::size_t index, const Light& light) { impl_->changed()->setLight(index, light); }
void LightField::setLights(const std::vector<Light>& lights) { impl_->changed()->setLights(lights); }
void LightField::setSky(const glm::vec3& radiance) { impl_->changed()->setSky(radiance); }
void LightField::setEnvironment(const Environment& environment) {
    impl_->changed()->setEnvironment(environment);
}
std::size_t LightField::addMesh(const Mesh& mesh) { return impl_->changed()->addMesh(mesh); }
std::size_t LightField::addMesh(const HostMesh& mesh) {
    return impl_->changed()->addMesh(impl_->device, mesh);
}
std::size_t LightField::addTexture(const Texture& texture) { return impl_->changed()->addTexture(texture); }
std::size_t LightField::addTexture(const HostTexture& texture) {
    return impl_->changed()->addTexture(impl_->device, texture);
}
std::size_t LightField::addMaterial(const Material& material) {
    return impl_->changed()->addMaterial(material);
}
std::size_t LightField::addInstance(const Instance& instance) {
    return impl_->changed()->addInstance(instance);
}
void LightField::removeInstance(std::size_t index) { impl_->changed()->removeInstance(index); }
void LightField::removeMesh(std::size_t index) { impl_->changed()->removeMesh(index); }
void LightField::setRegion(const Aabb& region) { impl_->changed()->setRegion(region); }
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
    const modes::OwnerGuard call(impl_->owner);
    return impl_->update(budget);
}

// Levels lie round the anchor: a field has no eye.
void LightField::Impl::voxelize() {
    const VoxelSettings& wanted = settings.voxels;
    voxels::VoxelGrid grid;
    if (wanted.levels != 1 && wanted.anchor.isPoint())
        grid = voxels::SurfaceVoxels::gridAround(*scene, wanted, {});
    if (grid.levels == 1) return voxels.update(device, *scene, wanted, voxels::Rays::Yes);
    gl::Device nested = device;
    nested.nestedGrids = true;
    const auto scroll = settings.traced.budgeted ? voxels::Scroll::Yes : voxels::Scroll::No;
    voxels.updateInSteps(grid, nested, *scene, wanted, voxels::Rays::Yes, scroll).finish();
}

int LightField::Impl::update(const LightBudget& budget) {
    const std::uint64_t waitedBefore = gl::waitCount();
    const double start = light::RelightBudget::begin(budget.milliseconds);
    profiler.beginFrame();
    const gl::PassScope pass(profiler, "update");
    visitedBefore = lit.faceVisits();
    programs.trim();
    lights.update(device, *scene, {.settings = settings.light, .emissiveQuads = false, .lampTree = true});
    voxelize();
    const gl::Device onLevels = nested();
    const light::RelightSettings wanted = light::relightSettings(settings.traced);
    const light::LitVoxels::Inputs inputs{*scene, lights, voxels};
    if (settings.traced.budgeted)
        relightBudget.relight(onLevels, lit, inputs, wanted,
                              {.updates = budget.updates,
                               .faces = static_cast<std::uint32_t>(budget.faces),
                               .milliseconds = budget.milliseconds,
                               .start = start});
    else
        lit.relight(onLevels, inputs, wanted, {.faces = static_cast<std::uint32_t>(budget.faces)});
    stats.waits = gl::waitCount() - waitedBefore;
    return lit.updates();
}

int LightField::addView() {
    const modes::OwnerGuard call(impl_->owner);
    impl_->views.try_emplace(impl_->nextView);
    return impl_->nextView++;
}

void LightField::removeView(int view) {
    const modes::OwnerGuard call(impl_->owner);
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
    const modes::OwnerGuard call(impl_->owner);
    return impl_->gather(found->second, surfaces, options.reduction);
}

GatheredLight LightField::Impl::gather(View& view, const HostSurfaces& host, int reduction) {
    const std::uint64_t waitedBefore = gl::waitCount();
    const gl::PassScope pass(profiler, "gather");
    programs.trim();
    const gl::Device onLevels = nested();
    view.surfaces.take(device, *scene, host, reduction);
    const gather::RayInputs traced{*scene, lights, voxels, lit, view.surfaces};
    const light::LitVoxels::Inputs sources{*scene, lights, voxels};
    const auto redraw = [&](std::uint32_t draw) { return lit.redrawInSteps(onLevels, sources, draw); };
    const gather::PictureParts parts{.diffuse = true, .specular = true};
    view.indirect.gather(onLevels, traced, {settings.traced, parts, nullptr, redraw});
    if (!settings.traced.budgeted) lit.endDraws();
    if (reduction > 1) {
        view.all.take(device, *scene, host, 1);
        const gather::RayInputs all{*scene, lights, voxels, lit, view.all};
        view.indirect.carry(onLevels, all, settings.traced).finish();
        view.outputs.draw(onLevels, all, view.indirect, settings.traced.specularLimit);
    } else {
        view.outputs.draw(onLevels, traced, view.indirect, settings.traced.specularLimit);
    }
    stats.waits += gl::waitCount() - waitedBefore;
    return {view.outputs.diffuse().name(), view.outputs.specular().name(), host.width, host.height};
}

void LightField::setProfiling(bool on) { impl_->profiler.setEnabled(on); }

const LightFieldStats& LightField::stats() const {
    LightFieldStats& stats = impl_->stats;
    const std::vector<gl::PassTime> times = impl_->profiler.times();
    stats.passes.clear();
    for (const gl::PassTime& time : times)
        stats.passes.push_back({time.name, time.cpuMs, time.wallMs, time.gpuMs});
    stats.memory = modes::memoryStats(impl_->owner);
    // Numbers that are on their way are waited for here, which is not a frame's doing.
    const bool any = static_cast<bool>(impl_->lit.revision());
    stats.voxels = any ? impl_->voxels.surface().voxelCount() : 0;
    stats.faces = any ? impl_->voxels.surface().faceCount() : 0;
    stats.facesUpdated = impl_->lit.faceVisits() - impl_->visitedBefore;
    return stats;
}

// As tools/make_lookups has them.
namespace {
constexpr gl::ResourceName kLookupBlocks[] = {"VoxelGridBlock", "LightingBlock", "VoxelLevelBlock"};
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
    for (gl::ProgramDesc& desc : gather::LightOutputs::programDescs()) {
        descs.push_back(gl::Device::forNestedGrids(desc));
        descs.push_back(std::move(desc));
    }
    return descs;
}

}  // namespace modes
}  // namespace conelight
