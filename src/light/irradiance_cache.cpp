// SPDX-License-Identifier: MIT
#include "light/irradiance_cache.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/assert.h"
#include "gl/gl.h"
#include "gl/pace.h"
#include "light/firefly_clamp.h"

namespace conelight::light {
namespace {

constexpr double kSlack = 1.25;  // room for growth when memory is allocated anew
// While voxels change with every call, an update looks for faces inside closed objects at one in so many
// faces only, others at the next: looking costs as much as two more rays. Those of which a ray has met
// something from behind are looked at each second time.
constexpr std::uint32_t kInteriorInterval = 16;
constexpr int kFacesOfPiece = 1024;  // at least, of an update in pieces
// Updates behind a mean of the cache, when it is shown: for what one ray may bring by reflections.
constexpr int kUsualWindow = 32;

struct UpdateKey {
    HitKey hits;
    bool findsBacks;
    gl::ProgramDesc desc() const {
        gl::Defines defines = hits.defines();
        defines.emplace_back("FIND_BACK_FACES", findsBacks ? "1" : "0");
        return {{"light/cache_update.comp.glsl"}, std::move(defines)};
    }
    // One texel per light: what a face keeps is a mean of many rays.
    static constexpr int kFilter = -1;
    static std::vector<UpdateKey> all() {
        std::vector<UpdateKey> keys;
        for (const HitKey& hits : HitKey::all(kFilter))
            for (const bool findsBacks : {false, true}) keys.push_back({hits, findsBacks});
        return keys;
    }
};

// Before rays read the light; before pixels do; the same while faces share with their neighbours.
enum class Commit { ForRays, ForPixels, SharedForPixels };

struct CommitKey {
    Commit kind;
    gl::ProgramDesc desc() const {
        return {{"light/cache_commit.comp.glsl"},
                {{"AT_PIXELS", kind != Commit::ForRays ? "1" : "0"},
                 {"SHARED", kind == Commit::SharedForPixels ? "1" : "0"}}};
    }
    static std::vector<CommitKey> all() {
        return {{Commit::ForRays}, {Commit::ForPixels}, {Commit::SharedForPixels}};
    }
};

gl::ProgramDesc pass(const char* name) { return {{std::string("light/cache_") + name + ".comp.glsl"}, {}}; }

}  // namespace

// One update's dispatches have these in common.
struct IrradianceCache::Visit {
    const gl::Device& device;
    const gl::Inputs& inputs;
    const CacheSettings& settings;
    HitKey hits;
    bool searches;
};

// Makes room for so many faces. What is there may be lost.
void IrradianceCache::reserve(std::uint32_t faces) {
    if (!constants_) {
        constants_ = gl::Buffer(sizeof(gpu::CacheConstants), "irradiance cache constants");
        reprojectionBlock_ = gl::Buffer(sizeof(gpu::CacheReprojection), "irradiance cache reprojection");
        oldLevelBlock_ = gl::Buffer(sizeof(gpu::VoxelLevels), "irradiance cache old levels");
    }
    // No room for growth before there was any.
    const auto room = static_cast<std::size_t>(std::ceil((states_ ? kSlack : 1.0) * faces)) + 64;
    if (states_.bytes() < sizeof(gpu::FaceCache) * std::size_t{faces} || !states_) {
        stateTexels_ = {};
        states_ = {};
        states_ = gl::Buffer(sizeof(gpu::FaceCache) * room, "irradiance cache");
        stateTexels_ = gl::Texture(states_, GL_RGBA32UI, "irradiance cache");
    }
    if (faceLight_.bytes() < std::size_t{8} * faces || !faceLight_) {
        faceLightTexels_ = {};
        faceLight_ = {};
        faceLight_ = gl::Buffer(std::size_t{8} * room, "light of faces at pixels");
        faceLightTexels_ = gl::Texture(faceLight_, GL_RG32UI, "light of faces at pixels");
    }
}

base::Steps IrradianceCache::adoptInSteps(const gl::Device& device, const voxels::Voxels& voxels,
                                          SceneEdits changed) {
    const voxels::SurfaceVoxels& surface = voxels.surface();
    const voxels::VoxelKeys* old = voxels.previous();
    restartAverages(changed);
    // The states of the old voxels change places with the buffer for the new ones.
    if (!std::exchange(adopting_, true)) {
        std::swap(states_, oldStates_);
        std::swap(stateTexels_, oldStateTexels_);
        hadFaces_ = faceCount_ > 0;
    }
    carried_ = hadFaces_ && old != nullptr && voxelsFrom_ && old->revision == voxelsFrom_ &&
               (old->grid.levels > 1) == (voxels.grid().levels > 1);
    if (!carried_) {
        dark_ = true;
        balance_.restart(LightBalance::Restart::Dark);
        guide_.restart();
    }
    reserve(surface.mostFaces());
    samples_.reserve(voxels.grid(), surface.mostFaces());
    faceCount_ = surface.mostFaces();
    {
        const gl::PassScope pass(device.profiler, "irradiance: reproject");
        if (carried_ && faceCount_ > 0)
            reproject(device, voxels, *old);
        else
            states_.clear();
    }
    co_await gl::rest(device);
    co_await sort(device, surface, true);
    voxelsFrom_ = voxels.revision();
    raysTested_ = 0;
    updatesOfVoxels_ = 0;
    adopting_ = false;
}

void IrradianceCache::reproject(const gl::Device& device, const voxels::Voxels& voxels,
                                const voxels::VoxelKeys& old) {
    gpu::CacheReprojection block{};
    block.oldOrigin = old.grid.origin;
    block.oldInverseVoxelSize = 1.0f / old.grid.voxelSize;
    block.oldSizeX = static_cast<std::uint32_t>(old.grid.size.x);
    block.oldSizeY = static_cast<std::uint32_t>(old.grid.size.y);
    block.oldSizeZ = static_cast<std::uint32_t>(old.grid.size.z);
    reprojectionBlock_.update(block);
    oldLevelBlock_.update(old.grid.packedLevels());
    gl::Inputs inputs;
    inputs.add(voxels)
        .uniform("ReprojectionBlock", reprojectionBlock_)
        .uniform("OldLevelBlock", oldLevelBlock_)
        .storage("StateTable", states_)
        .texture("oldStates", oldStateTexels_);
    old.declareOld(inputs);
    device.get(light::pass("reproject")).dispatchLinear(inputs, faceCount_);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

base::Steps IrradianceCache::sort(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                                  bool searches) {
    firstFace_ = 0;
    co_await order_.sortInSteps(device, surface, states_, stateTexels_,
                                {.searches = searches, .keepsMemory = carried_, .late = searches});
}

void IrradianceCache::restartAverages(const SceneEdits& changed) {
    know();
    // No update has seen the change before, wherever that was.
    restartsNear_ = restarts_ ? std::nullopt : changed;
    restarts_ = true;
    prepared_ = false;
    const bool near = restartsNear_ && !restartsNear_->most;
    balance_.restart(dark_  ? LightBalance::Restart::Dark
                     : near ? LightBalance::Restart::Edits
                            : LightBalance::Restart::Everything);
    facesVisited_ = 0;
}

// Faces that one update visits.
std::uint32_t IrradianceCache::perUpdate(const CacheSettings& settings) const {
    return settings.facesPerUpdate == 0 ? order_.visited()
                                        : std::min(settings.facesPerUpdate, order_.visited());
}

std::uint64_t IrradianceCache::searchedRays() const {
    return std::uint64_t{IRRADIANCE_INTERIOR_RAYS} * order_.visited();
}

gpu::CacheConstants IrradianceCache::packed(const CacheSettings& settings, std::uint32_t first,
                                            std::uint32_t count) const {
    gpu::CacheConstants c{};
    c.firstFace = first;
    c.faceCount = count;
    c.cosineRays = static_cast<std::uint32_t>(settings.cosineRays);
    c.lightRays = static_cast<std::uint32_t>(settings.lightRays);
    c.update = updatesMade_;
    c.seed = settings.seed;
    c.longestWindow = settings.averages ? static_cast<std::uint32_t>(std::max(settings.longestWindow, 1)) : 1;
    c.reflections = static_cast<std::uint32_t>(std::max(settings.reflections, 0));
    c.fireflyClamp = fireflyClamp((settings.cosineRays + settings.lightRays) *
                                  std::min(settings.longestWindow, kUsualWindow));
    if (restarts_ && restartsNear_) {
        // Where most light is another, updates begin anew everywhere: what they gather soon tells how bright all is.
        c.restartsNear = restartsNear_->most ? 0 : 1;
        putEdits(c, *restartsNear_);
    }
    return c;
}

// States -> lit faces and light samples; and what pixels see (atPixels).
base::Steps IrradianceCache::commit(const gl::Device& device, const Inputs& inputs,
                                    const CacheSettings& settings, bool atPixels) {
    prepared_ = false;
    committedWith_ = settings;
    co_await putLight(device, inputs, settings, atPixels);
    co_await samples_.drawInSteps(device, inputs.voxels.surface(), constants_);
    prepared_ = true;
}

base::Steps IrradianceCache::redrawInSteps(const gl::Device& device, const Inputs& inputs,
                                           std::uint32_t draw) {
    if (faceCount_ == 0 || !prepared_) co_return;
    if (!samples_.canDraw()) co_await putLight(device, inputs, committedWith_, true);
    gpu::CacheConstants constants = packed(committedWith_);
    constants.draw = draw;
    constants_.update(constants);
    co_await samples_.drawInSteps(device, inputs.voxels.surface(), constants_);
}

// After a change of light that is for the most part a factor.
void IrradianceCache::scale(const gl::Device& device, const voxels::SurfaceVoxels& surface) const {
    if (!restarts_ || !restartsNear_ || !restartsNear_->scaled) return;
    gl::Inputs given;
    given.add(surface).uniform("CacheBlock", constants_).storage("StateTable", states_);
    device.get(pass("scale")).dispatchLinear(given, faceCount_);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// States -> what rays and pixels see, and the flux of faces.
base::Steps IrradianceCache::putLight(const gl::Device& device, const Inputs& inputs,
                                      const CacheSettings& settings, bool atPixels) {
    gl::PassSteps scope(device, "irradiance: light samples");
    constants_.update(packed(settings));
    scale(device, inputs.voxels.surface());
    gl::Inputs given;
    given.add(inputs.voxels.surface())
        .add(inputs.faces)
        .uniform("CacheBlock", constants_)
        .storage("StateTable", states_)
        .texture("stateTexels", stateTexels_);
    const Commit kind = !atPixels           ? Commit::ForRays
                        : settings.averages ? Commit::SharedForPixels
                                            : Commit::ForPixels;
    const bool twice = kind == Commit::SharedForPixels;
    if (twice)
        gl::reserveTexels(sharedLight_, sharedLightTexels_, GL_RG32UI, std::size_t{8} * faceCount_,
                          "shared light of faces");
    gl::Inputs commits = given;
    commits.storage("FaceLightTable", twice ? sharedLight_ : faceLight_);
    samples_.reserve(inputs.voxels.grid(), faceCount_);  // what endSharing() has freed
    samples_.declareWritten(commits);
    device.get(CommitKey{kind}.desc()).dispatchLinear(commits, faceCount_);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    if (twice) {
        co_await scope.rest();
        commits = given;
        commits.storage("FaceLightTable", faceLight_).texture("sharedLight", sharedLightTexels_);
        device.get(pass("share")).dispatchLinear(commits, faceCount_);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    }
    co_await scope.rest();
    if (std::exchange(restarts_, false)) device.get(pass("restart")).dispatchLinear(given, faceCount_);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
}

base::Steps IrradianceCache::visitFaces(const Visit& visit, std::uint32_t first, std::uint32_t end,
                                        bool findsBacks) {
    if (first >= end) co_return;
    for (gl::Pieces faces(visit.device, static_cast<int>(end - first), kFacesOfPiece); faces.next();) {
        {
            const gl::PassScope scope(visit.device.profiler, "irradiance: update");
            const auto count = static_cast<std::uint32_t>(faces.count());
            constants_.update(
                packed(visit.settings, first + static_cast<std::uint32_t>(faces.first()), count));
            visit.device.get(UpdateKey{visit.hits, findsBacks}.desc()).dispatchLinear(visit.inputs, count);
        }
        co_await gl::rest(visit.device);
    }
    if (findsBacks) raysTested_ += (end - first) * static_cast<std::uint64_t>(visit.settings.cosineRays);
}

// Where the next update searches.
IrradianceCache::VisitPart IrradianceCache::nextSearched() const {
    const bool changeAgainAndAgain = updatesOfVoxels_ == 0 && carried_;
    const std::uint32_t parts = changeAgainAndAgain ? kInteriorInterval : 1;
    return {updatesMade_ % parts, parts};
}

// Searches a part of the faces, and all that are doubtful.
base::Steps IrradianceCache::visitRange(const Visit& visit, std::uint32_t first, std::uint32_t end) {
    const std::uint32_t middle = std::clamp(order_.gathering(), first, end);
    const VisitPart searched = nextSearched();
    const std::uint32_t from = visit.searches ? first + searched.begin(middle - first) : middle;
    const std::uint32_t to = visit.searches ? first + searched.end(middle - first) : middle;
    co_await visitFaces(visit, first, from, false);
    co_await visitFaces(visit, from, to, true);
    co_await visitFaces(visit, to, middle, false);
    co_await visitFaces(visit, middle, end, visit.searches);
}

gl::Inputs IrradianceCache::givenToUpdates(const Inputs& inputs) const {
    gl::Inputs given;
    given.add(inputs.scene)
        .add(inputs.lights)
        .add(inputs.voxels)
        .add(*this)
        .add(inputs.faces)
        .texture("cachedDirect", inputs.directTexels)
        .uniform("CacheBlock", constants_)
        .storage("StateTable", states_)
        .texture("stateTexels", stateTexels_)
        .texture("order", order_.texels())
        .add(balance_);
    guide_.declareLearned(given);
    return given;
}

HitKey IrradianceCache::hitsOf(const Inputs& inputs, const CacheSettings& settings) {
    HitKey hits = inputs.lights.hitKey(inputs.scene, settings.exactDirect);
    if (hits.lights.shadows) hits.lights.filter = UpdateKey::kFilter;
    return hits;
}

// One update of the next `count` faces.
base::Steps IrradianceCache::visitAll(const gl::Device& device, const Inputs& inputs,
                                      const CacheSettings& settings, std::uint32_t count) {
    const gl::Inputs given = givenToUpdates(inputs);
    const Visit visit{device, given, settings, hitsOf(inputs, settings), raysTested_ < searchedRays()};
    const std::uint32_t atEnd = std::min(count, order_.visited() - firstFace_);
    co_await visitRange(visit, firstFace_, firstFace_ + atEnd);
    co_await visitRange(visit, 0, count - atEnd);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
}

// Whether an update of all faces does the same whatever their number, which is on its way: whether it searches, and
// whether faces are sorted behind it. A number that is known elsewhere is taken in.
bool IrradianceCache::goesUncounted(const CacheSettings& settings) const {
    if (!order_.isFresh() || settings.facesPerUpdate != 0) return false;
    int rays = settings.cosineRays;
    for (const LateUpdate& update : uncounted_) rays += update.rays;
    return rays < IRRADIANCE_INTERIOR_RAYS;
}

// visitAll() of all faces, as many as the GPU has sorted.
void IrradianceCache::visitUncounted(const gl::Device& device, const Inputs& inputs,
                                     const CacheSettings& settings) {
    const gl::PassScope scope(device.profiler, "irradiance: update");
    constexpr std::size_t kRangeBytes = std::size_t{4} * CACHE_RANGE_WORDS, kCountBytes = 8;
    if (!ranges_) {
        ranges_ = gl::Buffer(CACHE_RANGES * kRangeBytes, "irradiance cache ranges");
        rangeBlock_ = gl::Buffer(sizeof(gpu::CacheRanges), "irradiance cache range constants");
    }
    const VisitPart searched = nextSearched();
    rangeBlock_.update(gpu::CacheRanges{searched.part, searched.parts, 0, 0});
    gl::Inputs counted;
    counted.uniform("RangeBlock", rangeBlock_)
        .storage("OrderCounts", order_.counts())
        .storage("RangeTable", ranges_);
    device.get(pass("ranges")).dispatch(counted, 1);
    gl::barrier(gl::Access::Indirect | gl::Access::Update);
    const gl::Inputs given = givenToUpdates(inputs);
    const HitKey hits = hitsOf(inputs, settings);
    constants_.update(packed(settings));
    for (std::size_t range = 0; range < CACHE_RANGES; ++range) {
        // Every other one is searched.
        constants_.copyRange(ranges_, range * kRangeBytes, 0, kCountBytes);
        device.get(UpdateKey{hits, range % 2 == 1}.desc())
            .dispatchIndirect(given, ranges_, range * kRangeBytes + kCountBytes);
    }
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
    uncounted_.push_back({searched, settings.cosineRays});
}

// Counts what updates have visited that went uncounted.
void IrradianceCache::know() const {
    for (const LateUpdate& update : std::exchange(uncounted_, {})) {
        const std::uint32_t gathering = order_.gathering();
        const std::uint64_t searched =
            update.searched.end(gathering) - update.searched.begin(gathering) + order_.doubtful();
        raysTested_ += searched * static_cast<std::uint64_t>(update.rays);
        facesVisited_ += order_.visited();
        visits_ += order_.visited();
    }
}

base::Steps IrradianceCache::updateInSteps(const gl::Device& device, const Inputs& inputs,
                                           const CacheSettings& settings, int passes) {
    CONELIGHT_ASSERT(voxelsFrom_ == inputs.voxels.revision(),
                     "IrradianceCache::update: other voxels than adopted");
    const bool learns = inputs.lights.guidesToSky();
    if (learns) guide_.reserve();
    if (faceCount_ == 0) co_return;
    balance_.reserve(faceCount_);
    if (passes > 0) dark_ = false;
    if (!prepared_) co_await commit(device, inputs, settings, passes <= 0);
    for (int i = 0; i < passes; ++i) {
        const int rounds = updates();
        const LightBalance::Faces faces{inputs.voxels.surface(), inputs.faces, states_, stateTexels_};
        // Where things move, light is changed again before the second update.
        const bool balances = settings.averages && rounds > 0;
        if (balances) balance_.begin(device, faces);
        if (goesUncounted(settings)) {
            visitUncounted(device, inputs, settings);
            ++updatesMade_;
            if (learns) guide_.learn(device, constants_);
            if (balances) balance_.correct(device, faces, {std::min(rounds, settings.longestWindow), 1.0f});
            co_await commit(device, inputs, settings, i + 1 == passes);
            continue;
        }
        know();
        const std::uint32_t count = perUpdate(settings);
        const bool searches = raysTested_ < searchedRays();
        // One that was left has used its random numbers.
        if (std::exchange(unfinished_, true)) ++updatesMade_;
        co_await visitAll(device, inputs, settings, count);
        unfinished_ = false;
        firstFace_ = order_.visited() > 0 ? (firstFace_ + count) % order_.visited() : 0;
        facesVisited_ += count;
        visits_ += count;
        ++updatesMade_;
        if (learns) guide_.learn(device, constants_);
        if (balances && updates() > rounds)
            balance_.correct(device, faces,
                             {std::min(rounds, settings.longestWindow),
                              static_cast<float>(count) / static_cast<float>(order_.visited())});
        co_await commit(device, inputs, settings, i + 1 == passes);
        // Faces inside closed objects are known: no more rays from them.
        if (searches && raysTested_ >= searchedRays()) {
            const gl::PassScope scope(device.profiler, "irradiance: order");
            const int made = updates();
            sort(device, inputs.voxels.surface(), false).finish();  // half sorted, it would be of no use
            facesVisited_ = static_cast<std::uint64_t>(made) * order_.visited();
        }
    }
    if (passes > 0) ++updatesOfVoxels_;
}

void IrradianceCache::endSharing() {
    sharedLightTexels_ = {};
    sharedLight_ = {};
    balance_.release();
    samples_.release();
}

bool IrradianceCache::settled() const { return updates() >= IRRADIANCE_SETTLE; }

// Whole ones over all faces since light changed.
int IrradianceCache::updates() const {
    if (order_.isFresh()) return static_cast<int>(uncounted_.size());  // no others since the change
    know();
    return order_.visited() == 0 ? IRRADIANCE_SETTLE : static_cast<int>(facesVisited_ / order_.visited());
}

void IrradianceCache::declare(gl::Inputs& inputs) const {
    inputs.add(samples_).add(guide_).texture("faceLight", faceLightTexels_);
}

std::vector<gl::ProgramDesc> IrradianceCache::programDescs() {
    std::vector<gl::ProgramDesc> descs{pass("scale"), pass("restart"), pass("reproject"), pass("share"),
                                       pass("ranges")};
    for (const CommitKey& key : CommitKey::all()) descs.push_back(key.desc());
    for (const UpdateKey& key : UpdateKey::all()) descs.push_back(key.desc());
    for (const auto& more : {FaceOrder::programDescs(), LightBalance::programDescs(),
                             LightSamples::programDescs(), SkyGuide::programDescs()})
        descs.insert(descs.end(), more.begin(), more.end());
    return descs;
}

}  // namespace conelight::light
