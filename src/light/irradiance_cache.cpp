// SPDX-License-Identifier: MIT
#include "light/irradiance_cache.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "gl/gl.h"
#include "light/shadow_maps.h"
#include "scene/gpu_lights.h"
#include "shared/bindings.h"
#include "shared/irradiance.h"

namespace conelight::light {
namespace {

constexpr std::uint32_t kMaxChunks = 4096;  // one invocation walks over all chunks
constexpr std::uint32_t kLeastChunk = 16;   // fewer faces per invocation are not worth starting it
constexpr double kSlack = 1.25;             // room for growth when memory is allocated anew
// While voxels change with every call, an update looks for faces inside closed objects at one in so many
// faces only, others at the next: looking costs as much as two more rays. Those of which a ray has met
// something from behind are looked at each second time.
constexpr std::uint32_t kDeadInterval = 16;
// More lights than these are taken from faces, not looked up at every hit: the shadow maps of 4 cost as much
// as the ray itself.
constexpr std::uint32_t kMostExactLights = 4;

// Updates behind a mean of the cache, when it is shown: for what one ray may bring by reflections.
constexpr int kUsualWindow = 32;

gl::ProgramDesc updateDesc(gl::Defines hitLights, bool findsBacks) {
    // One texel per light: what a face keeps is a mean of many rays.
    for (auto& [key, value] : hitLights)
        if (key == "SHADOW_FILTER") value = "-1";
    hitLights.emplace_back("FIND_BACKS", findsBacks ? "1" : "0");
    return {{"light/cache_update.comp.glsl"}, std::move(hitLights)};
}
// Grids with more blocks of 16^3 voxels (256^3 has half of that) keep faces as they are stored: bins would
// take too much memory.
constexpr std::size_t kMostBlocks = 8192;

gl::ProgramDesc orderDesc(int step) {
    return {{"light/cache_order.comp.glsl"}, {{"STEP", std::to_string(step)}}};
}
gl::ProgramDesc pass(const char* name) { return {{std::string("light/cache_") + name + ".comp.glsl"}, {}}; }
enum class Commit { ForRays, ForPixels, SharedForPixels };

gl::ProgramDesc commitDesc(Commit kind) {
    return {{"light/cache_commit.comp.glsl"},
            {{"AT_PIXELS", kind != Commit::ForRays ? "1" : "0"},
             {"SHARED", kind == Commit::SharedForPixels ? "1" : "0"}}};
}

gl::Defines exactDefines(const gl::Defines& lights, bool exact) {
    gl::Defines defines{{"EXACT_DIRECT", exact ? "1" : "0"}};
    if (!exact) return defines;
    for (const auto& [key, value] : lights) {
        // One comparison of four texels per light: rays average edges anyway.
        if (key == "SHADOW_FILTER")
            defines.emplace_back(key, "0");
        else
            defines.emplace_back(key, key == "LIGHTS_RECT" ? "0" : value);
    }
    return defines;
}

// Whether rays may meet metal.
bool hasMetals(const scene::GpuScene& scene) {
    return std::any_of(scene.instances().begin(), scene.instances().end(),
                       [&](const gpu::Instance& instance) {
                           const gpu::Material& m = scene.materials()[instance.material];
                           return (instance.flags & INSTANCE_VOXELIZED) != 0 &&
                                  (m.flags & MATERIAL_UNLIT) == 0 && m.metallic > 0;
                       });
}

}  // namespace

gl::Defines hitLightDefines(const scene::GpuScene& scene, const LightSettings& settings, bool exactDirect) {
    const std::uint32_t punctual = scene::lightEnds(scene.lights()).z;
    gl::Defines defines = exactDefines(lightDefines(scene, settings),
                                       exactDirect && punctual > 0 && punctual <= kMostExactLights);
    defines.emplace_back("LOBES", hasMetals(scene) ? "1" : "0");
    return defines;
}

// At least 8, by eye: with less, lamps seen in two metals vanish from quality draft.
float reflectedLimit(int rays) { return static_cast<float>(std::max(rays, 8)); }

std::vector<gl::ProgramDesc> hitLightVariants(const gl::ProgramDesc& base) {
    std::vector<gl::ProgramDesc> descs;
    const auto add = [&](const gl::Defines& defines) {
        gl::ProgramDesc desc = base;
        desc.defines.insert(desc.defines.end(), defines.begin(), defines.end());
        descs.push_back(std::move(desc));
    };
    const auto withLobes = [](gl::Defines defines, bool lobes) {
        defines.emplace_back("LOBES", lobes ? "1" : "0");
        return defines;
    };
    for (const bool lobes : {false, true}) add(withLobes(exactDefines({}, false), lobes));
    for (const char* kind : {"LIGHTS_POINT", "LIGHTS_SPOT", "LIGHTS_DIRECTIONAL"}) {
        gl::Defines lights;
        for (const char* other : {"LIGHTS_POINT", "LIGHTS_SPOT", "LIGHTS_DIRECTIONAL", "LIGHTS_RECT"})
            lights.emplace_back(other, std::string(kind) == other ? "1" : "0");
        lights.insert(lights.end(), {{"LIGHTS_FIXED", "1"}, {"LIGHTS_SHADOWS", "1"}, {"SHADOW_FILTER", "0"}});
        for (const bool lobes : {false, true}) add(withLobes(exactDefines(lights, true), lobes));
    }
    return descs;
}

struct IrradianceCache::Impl {
    gl::Buffer states, oldStates, faceLight, chunks, pool, constants, carryBlock, orderBlock;
    gl::Texture steadyTexels, faceLightTexels, poolTexels, orderTexels, stateTexels, oldStateTexels;
    // Voxels before they were built anew.
    gl::Buffer oldRecords;
    gl::Texture oldRecordTexels, oldBricks;
    voxels::VoxelGrid oldGrid;
    std::uint32_t oldFaces = 0;
    gl::Buffer bins, binStarts;  // of sortFaces
    gl::Texture binTexels, binStartTexels;

    bool prepared = false;  // pool and records say what the states and the direct light say
    bool restart = false;
    std::uint32_t number = 0;        // of updates, ever
    std::uint32_t firstFace = 0;     // where the next update begins
    std::uint64_t facesVisited = 0;  // since light changed
    std::uint64_t raysTested = 0;    // cosine rays that looked for faces inside objects, since voxels changed
    bool carried = false;            // the last voxels took over light from those before
    bool voxelsAreNew = false;       // no call of update() is behind them
    std::uint32_t faceCount = 0;
    std::uint32_t gatherCount = 0;    // of these, those that updates visit in order
    std::uint32_t doubtfulCount = 0;  // and those behind them, of which each is searched
    std::uint32_t sorts = 0;          // ever

    void reserve(std::uint32_t faces);
    void sortFaces(gl::ProgramLibrary& programs, const voxels::SurfaceVoxels& surface, bool searches);
    std::uint32_t visited() const { return gatherCount + doubtfulCount; }
    // Whole ones over all faces since light changed.
    int rounds() const {
        return visited() == 0 ? IRRADIANCE_SETTLE : static_cast<int>(facesVisited / visited());
    }
    std::uint32_t perUpdate(const CacheSettings& settings) const;
    gpu::CacheConstants packed(const CacheSettings& settings, std::uint32_t first = 0,
                               std::uint32_t count = 0) const;
    void commit(gl::ProgramLibrary& programs, gl::Profiler& profiler, const CacheSettings& settings,
                bool atPixels);
};

IrradianceCache::IrradianceCache() : impl_(std::make_unique<Impl>()) {}
IrradianceCache::~IrradianceCache() = default;
IrradianceCache::IrradianceCache(IrradianceCache&&) noexcept = default;
IrradianceCache& IrradianceCache::operator=(IrradianceCache&&) noexcept = default;

void IrradianceCache::reset() { impl_ = std::make_unique<Impl>(); }

// Makes room for so many faces. What is there may be lost.
void IrradianceCache::Impl::reserve(std::uint32_t faces) {
    if (!pool) {
        pool = gl::Buffer(4 * (1 + BRIGHT_FACE_COUNT), "bright faces");
        poolTexels = gl::Texture(pool, GL_R32UI, "bright faces");
        chunks = gl::Buffer(4 * (kMaxChunks + 2), "irradiance cache chunks");
        constants = gl::Buffer(sizeof(gpu::CacheConstants), "irradiance cache constants");
        orderBlock = gl::Buffer(sizeof(gpu::CacheOrder), "irradiance cache order");
        carryBlock = gl::Buffer(sizeof(gpu::CacheCarry), "irradiance cache carry-over");
    }
    // No room for growth before there was any.
    const auto room = static_cast<std::size_t>(std::ceil((states ? kSlack : 1.0) * faces)) + 64;
    if (states.bytes() < sizeof(gpu::FaceCache) * std::size_t{faces} || !states) {
        stateTexels = {};
        states = {};
        states = gl::Buffer(sizeof(gpu::FaceCache) * room, "irradiance cache");
        stateTexels = gl::Texture(states, GL_RGBA32UI, "irradiance cache");
    }
    if (faceLight.bytes() < std::size_t{8} * faces || !faceLight) {
        faceLightTexels = {};
        faceLight = {};
        faceLight = gl::Buffer(std::size_t{8} * room, "light of faces at pixels");
        faceLightTexels = gl::Texture(faceLight, GL_RG32UI, "light of faces at pixels");
    }
}

// The order in which updates visit faces (shaders/light/cache_order.comp.glsl), into the voxels' scratch
// buffer; the states of those that they do not visit.
// searches: faces that may be inside closed objects are visited, to find out.
void IrradianceCache::Impl::sortFaces(gl::ProgramLibrary& programs, const voxels::SurfaceVoxels& surface,
                                      bool searches) {
    gatherCount = faceCount;
    doubtfulCount = 0;
    firstFace = 0;
    if (faceCount == 0) return;
    const glm::ivec3 blocks = (surface.grid().bricks() + 3) / 4;
    const auto blockCount = static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y) *
                            static_cast<std::size_t>(blocks.z);
    surface.bind();
    surface.faceScratch().bindStorage(CACHE_ORDER);
    if (blockCount > kMostBlocks) {
        programs.get(orderDesc(5)).dispatchLinear(faceCount);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
        return;
    }
    const std::size_t binCount = blockCount * CACHE_BINS_PER_BLOCK;
    if (bins.bytes() != 8 * binCount) {
        binTexels = {};
        binStartTexels = {};
        bins = {};
        binStarts = {};
        bins = gl::Buffer(8 * binCount, "bins of faces");
        binStarts = gl::Buffer(4 * binCount, "starts of bins of faces");
        binTexels = gl::Texture(bins, GL_RG32UI, "bins of faces");
        binStartTexels = gl::Texture(binStarts, GL_R32UI, "starts of bins of faces");
    }
    bins.clear();
    bins.bindStorage(CACHE_BINS);
    binStarts.bindStorage(CACHE_BIN_STARTS);
    binTexels.bind(CACHE_UNIT_BINS);
    binStartTexels.bind(CACHE_UNIT_BIN_STARTS);
    chunks.bindStorage(CACHE_CHUNKS);
    states.bindStorage(CACHE_STATE);
    stateTexels.bind(CACHE_UNIT_STATE);
    gpu::CacheOrder block{};
    block.number = sorts++;
    block.searches = searches ? 1 : 0;
    orderBlock.update(block);
    orderBlock.bindUniform(BINDING_PASS);
    const std::size_t invocations[] = {faceCount, CACHE_ORDER_CHUNKS, 1, CACHE_ORDER_CHUNKS, faceCount};
    for (int step = 0; step < 5; ++step) {
        programs.get(orderDesc(step)).dispatchLinear(invocations[step]);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    }
    const auto counts = chunks.read<std::uint32_t>(2, sizeof(std::uint32_t) * CACHE_ORDER_CHUNKS);
    gatherCount = counts[0];
    doubtfulCount = counts[1];
    // They are as large as what they sort: kept only where voxels change again and again.
    if (!carried) {
        binTexels = {};
        binStartTexels = {};
        bins = {};
        binStarts = {};
    }
}

void IrradianceCache::beforeVoxelize(gl::Profiler& profiler, const voxels::SurfaceVoxels& surface) {
    Impl& m = *impl_;
    if (m.faceCount == 0) return;
    const gl::PassScope pass(profiler, "irradiance: keep");
    const std::size_t recordBytes = std::size_t{4} * surface.voxelCount();
    if (m.oldRecords.bytes() < recordBytes) {
        m.oldRecordTexels = {};
        m.oldRecords = {};
        m.oldRecords = gl::Buffer(recordBytes + recordBytes / 4, "old voxel records");
        m.oldRecordTexels = gl::Texture(m.oldRecords, GL_R32UI, "old voxel records");
    }
    m.oldRecords.copyFrom(surface.records(), recordBytes);
    const gl::TextureDesc& desc = surface.brickWords().desc();
    if (!m.oldBricks || m.oldBricks.width() != desc.width || m.oldBricks.height() != desc.height ||
        m.oldBricks.depth() != desc.depth) {
        m.oldBricks = {};
        m.oldBricks = gl::Texture(desc, "old voxel bricks");
        m.oldBricks.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        m.oldBricks.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    m.oldBricks.copyFrom(surface.brickWords());
    m.oldGrid = surface.grid();
    m.oldFaces = m.faceCount;
}

void IrradianceCache::afterVoxelize(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                                    const voxels::SurfaceVoxels& surface) {
    Impl& m = *impl_;
    const gl::PassScope pass(profiler, "irradiance: carry over");
    const bool carries = m.oldFaces > 0 && m.oldBricks;
    // The states of the old voxels change places with the buffer for the new ones.
    std::swap(m.states, m.oldStates);
    std::swap(m.stateTexels, m.oldStateTexels);
    m.reserve(surface.faceCount());
    m.steadyTexels = {};
    if (surface.secondFaceScratch())
        m.steadyTexels = gl::Texture(surface.secondFaceScratch(), GL_R32UI, "steady light");
    m.orderTexels = {};
    if (surface.faceScratch()) m.orderTexels = gl::Texture(surface.faceScratch(), GL_R32UI, "order of faces");
    m.faceCount = surface.faceCount();
    if (carries && m.faceCount > 0) {
        gpu::CacheCarry block{};
        block.oldOrigin = m.oldGrid.origin;
        block.oldInverseVoxelSize = 1.0f / m.oldGrid.voxelSize;
        block.oldSizeX = static_cast<std::uint32_t>(m.oldGrid.size.x);
        block.oldSizeY = static_cast<std::uint32_t>(m.oldGrid.size.y);
        block.oldSizeZ = static_cast<std::uint32_t>(m.oldGrid.size.z);
        m.carryBlock.update(block);
        m.carryBlock.bindUniform(BINDING_PASS);
        m.states.bindStorage(CACHE_STATE);
        m.oldStateTexels.bind(CACHE_UNIT_OLD_STATE);
        surface.bind();
        m.oldBricks.bind(CACHE_UNIT_OLD_BRICKS);
        m.oldRecordTexels.bind(CACHE_UNIT_OLD_RECORDS);
        programs.get(light::pass("carry")).dispatchLinear(m.faceCount);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    } else {
        m.states.clear();
    }
    m.carried = carries;
    m.sortFaces(programs, surface, true);
    m.oldFaces = 0;
    m.raysTested = 0;
    m.voxelsAreNew = true;
    lightChanged();
}

void IrradianceCache::lightChanged() {
    impl_->restart = true;
    impl_->prepared = false;
    impl_->facesVisited = 0;
}

// Faces that one update visits.
std::uint32_t IrradianceCache::Impl::perUpdate(const CacheSettings& settings) const {
    return settings.facesPerUpdate == 0 ? visited() : std::min(settings.facesPerUpdate, visited());
}

gpu::CacheConstants IrradianceCache::Impl::packed(const CacheSettings& settings, std::uint32_t first,
                                                  std::uint32_t count) const {
    gpu::CacheConstants c{};
    c.firstFace = first;
    c.faceCount = count;
    c.cosineRays = static_cast<std::uint32_t>(settings.cosineRays);
    c.lightRays = static_cast<std::uint32_t>(settings.lightRays);
    c.update = number;
    c.seed = settings.seed;
    c.longestWindow = settings.averages ? static_cast<std::uint32_t>(std::max(settings.longestWindow, 1)) : 1;
    c.facesPerChunk = std::max((faceCount + kMaxChunks - 1) / kMaxChunks, kLeastChunk);
    c.chunkCount = (faceCount + c.facesPerChunk - 1) / c.facesPerChunk;
    c.reflections = static_cast<std::uint32_t>(std::max(settings.reflections, 0));
    c.reflectedLimit = reflectedLimit((settings.cosineRays + settings.lightRays) *
                                      std::min(settings.longestWindow, kUsualWindow));
    c.restart = restart ? 1 : 0;
    return c;
}

// States -> records and pool; and what pixels see (atPixels).
void IrradianceCache::Impl::commit(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                                   const CacheSettings& settings, bool atPixels) {
    const gl::PassScope scope(profiler, "irradiance: bright faces");
    const gpu::CacheConstants block = packed(settings);
    constants.update(block);
    constants.bindUniform(BINDING_PASS);
    states.bindStorage(CACHE_STATE);
    stateTexels.bind(CACHE_UNIT_STATE);
    chunks.bindStorage(CACHE_CHUNKS);
    pool.bindStorage(CACHE_POOL);
    faceLight.bindStorage(CACHE_FACE_LIGHT);
    const bool shared = rounds() <= IRRADIANCE_SHARED_UPDATES;
    programs
        .get(commitDesc(!atPixels ? Commit::ForRays : (shared ? Commit::SharedForPixels : Commit::ForPixels)))
        .dispatchLinear(block.chunkCount);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    programs.get(pass("sums")).dispatch(8);
    gl::barrier(gl::Access::ShaderStorage);
    programs.get(pass("pool")).dispatch(BRIGHT_FACE_COUNT);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
    prepared = true;
    restart = false;
}

void IrradianceCache::update(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                             const scene::GpuScene& scene, const LightSettings& light,
                             const voxels::SurfaceVoxels& surface, const CacheSettings& settings,
                             int passes) {
    Impl& m = *impl_;
    CONELIGHT_ASSERT(surface.faceCount() == m.faceCount,
                     "IrradianceCache::update before afterVoxelize of these voxels");
    if (m.faceCount == 0) return;
    const gl::Defines lights = hitLightDefines(scene, light, settings.exactDirect);
    surface.bind();
    if (!m.prepared) m.commit(programs, profiler, settings, passes <= 0);
    for (int i = 0; i < passes; ++i) {
        const std::uint32_t count = m.perUpdate(settings);
        const bool searches = m.raysTested < std::uint64_t{IRRADIANCE_DEAD_RAYS} * m.visited();
        {
            const gl::PassScope scope(profiler, "irradiance: update");
            m.states.bindStorage(CACHE_STATE);
            m.stateTexels.bind(CACHE_UNIT_STATE);
            m.orderTexels.bind(CACHE_UNIT_ORDER);
            bind();
            const auto visit = [&](std::uint32_t first, std::uint32_t end, bool findsBacks) {
                if (first >= end) return;
                m.constants.update(m.packed(settings, first, end - first));
                m.constants.bindUniform(BINDING_PASS);
                programs.get(updateDesc(lights, findsBacks)).dispatchLinear(end - first);
                if (findsBacks)
                    m.raysTested += (end - first) * static_cast<std::uint64_t>(settings.cosineRays);
            };
            // A part of the faces is searched, and all that are doubtful.
            const auto visitRange = [&](std::uint32_t first, std::uint32_t end) {
                const std::uint32_t middle = std::clamp(m.gatherCount, first, end);
                const std::uint64_t parts = m.voxelsAreNew && m.carried ? kDeadInterval : 1,
                                    part = m.number % parts;
                const auto cut = [&](std::uint64_t at) {
                    return first + static_cast<std::uint32_t>(at * (middle - first) / parts);
                };
                const std::uint32_t from = searches ? cut(part) : middle;
                const std::uint32_t to = searches ? cut(part + 1) : middle;
                visit(first, from, false);
                visit(from, to, true);
                visit(to, middle, false);
                visit(middle, end, searches);
            };
            const std::uint32_t atEnd = std::min(count, m.visited() - m.firstFace);
            visitRange(m.firstFace, m.firstFace + atEnd);
            visitRange(0, count - atEnd);
            gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
        }
        m.firstFace = m.visited() > 0 ? (m.firstFace + count) % m.visited() : 0;
        m.facesVisited += count;
        ++m.number;
        m.commit(programs, profiler, settings, i + 1 == passes);
        // Faces inside closed objects are known now: no more rays from them.
        if (searches && m.raysTested >= std::uint64_t{IRRADIANCE_DEAD_RAYS} * m.visited()) {
            const gl::PassScope scope(profiler, "irradiance: order");
            const int rounds = m.rounds();
            m.sortFaces(programs, surface, false);
            m.facesVisited = static_cast<std::uint64_t>(rounds) * m.visited();
        }
    }
    m.voxelsAreNew = m.voxelsAreNew && passes <= 0;
}

bool IrradianceCache::settled() const { return updates() >= IRRADIANCE_SETTLE; }

int IrradianceCache::updates() const { return impl_->rounds(); }

void IrradianceCache::bind() const {
    CONELIGHT_ASSERT(impl_->pool, "IrradianceCache::bind before afterVoxelize");
    impl_->steadyTexels.bind(UNIT_STEADY_LIGHT);
    impl_->poolTexels.bind(UNIT_BRIGHT_FACES);
    impl_->faceLightTexels.bind(UNIT_FACE_LIGHT);
}

const gl::Buffer& IrradianceCache::state() const { return impl_->states; }

std::vector<gl::ProgramDesc> IrradianceCache::programDescs() {
    std::vector<gl::ProgramDesc> descs{commitDesc(Commit::ForRays),
                                       commitDesc(Commit::ForPixels),
                                       commitDesc(Commit::SharedForPixels),
                                       pass("sums"),
                                       pass("pool"),
                                       pass("carry")};
    for (int step = 0; step < 6; ++step) descs.push_back(orderDesc(step));
    for (const bool backs : {false, true})
        for (gl::ProgramDesc& desc : hitLightVariants({{"light/cache_update.comp.glsl"}, {}}))
            descs.push_back(updateDesc(std::move(desc.defines), backs));
    return descs;
}

}  // namespace conelight::light
