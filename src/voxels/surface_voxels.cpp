// SPDX-License-Identifier: MIT
#include "voxels/surface_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"

namespace conelight::voxels {
namespace {

constexpr std::uint32_t kMaxChunks = 4096;  // one invocation walks over all chunks
constexpr std::uint32_t kLeastChunk = 16;   // fewer elements per invocation are not worth starting it
constexpr double kSlack = 1.25;             // room for growth when memory is allocated anew
constexpr std::size_t kFragmentBytes = 32;
constexpr float kLeastEmission = 1e-6f;       // W/(sr m^2); less is none
constexpr float kLargestEmission = 65504.0f;  // what a half holds
// Boxes of instances are grown by this many voxels before their bricks are searched: transformed corners of a
// box and transformed vertices are rounded differently (2^-24 of their distance from the origin, a few
// times).
constexpr float kBoxMargin = 0.1f;
constexpr float kBoxRounding = 1e-6f;

// How much every list can hold.
struct Capacity {
    std::uint32_t triangles = 0;
    std::uint32_t tiles = 0;
    std::uint32_t fragments = 0;
    std::uint32_t voxels = 0;
    std::uint32_t faces = 0;
    std::uint32_t bricks = 0;      // occupied
    std::uint32_t gridBricks = 0;  // all
};

// What of the material model the voxelized instances of a scene need.
struct Surfaces {
    int detail = 0;             // 0 constant, 1 textures or vertex colours, 2 alpha tests
    float largestEmission = 0;  // W/(sr m^2), any component
    bool lobes = false;         // metals
    bool emit() const { return largestEmission > kLeastEmission; }
    bool operator==(const Surfaces&) const = default;
};

// Whether shown or not: what is hidden may be shown next.

Surfaces surfacesOf(const scene::GpuScene& scene) {
    Surfaces surfaces;
    surfaces.detail = scene.hasVertexColors() ? 1 : 0;
    for (const gpu::Instance& instance : scene.instances()) {
        const gpu::Material& m = scene.materials()[instance.material];
        const bool textured = m.layers.x >= 0 || m.layers.w >= 0 || (m.flags & MATERIAL_ALPHA_BLEND) != 0;
        surfaces.detail =
            std::max(surfaces.detail, (m.flags & MATERIAL_ALPHA_MASK) != 0 ? 2 : (textured ? 1 : 0));
        if ((m.flags & MATERIAL_UNLIT) != 0) continue;
        surfaces.lobes = surfaces.lobes || m.metallic > 0;
        surfaces.largestEmission =
            std::max({surfaces.largestEmission, m.emission.x, m.emission.y, m.emission.z});
    }
    // Only the pass with textures evaluates more than a colour.
    if (surfaces.lobes) surfaces.detail = std::max(surfaces.detail, 1);
    // Rounded up to a power of two: an emission that is turned up a little leaves all other sums as they are.
    if (surfaces.emit())
        surfaces.largestEmission =
            std::exp2(std::ceil(std::log2(std::min(surfaces.largestEmission, kLargestEmission))));
    return surfaces;
}

std::uint32_t perChunk(std::uint32_t count) {
    return std::max((count + kMaxChunks - 1) / kMaxChunks, kLeastChunk);
}

gl::ProgramDesc pass(const char* name, const gl::Defines& defines = {}) {
    return {{std::string("voxels/") + name + ".comp.glsl"}, defines};
}
gl::ProgramDesc countPass(bool ofBricks) {
    return pass("surface_count", {{"OF_BRICKS", ofBricks ? "1" : "0"}});
}
gl::ProgramDesc scanPass(int step) { return pass("surface_scan", {{"STEP", std::to_string(step)}}); }
const char* flag(bool on) { return on ? "1" : "0"; }
gl::ProgramDesc markPass(const char* name, bool update) {
    return pass(name, {{"SURFACE_UPDATE", flag(update)}});
}
gl::ProgramDesc resolvePass(bool emission, bool lobes, bool update) {
    return pass("surface_resolve", {{"SURFACE_EMISSION", flag(emission)},
                                    {"SURFACE_LOBES", flag(lobes)},
                                    {"SURFACE_UPDATE", flag(update)}});
}
gl::ProgramDesc layersPass(bool emission, bool lobes, bool onlyWide) {
    return pass("surface_layers", {{"SURFACE_EMISSION", flag(emission)},
                                   {"SURFACE_LOBES", flag(lobes)},
                                   {"SURFACE_ONLY_WIDE", flag(onlyWide)}});
}
gl::ProgramDesc clipPass(int detail, bool emission, bool lobes, bool update) {
    return pass("surface_clip", {{"SURFACE_DETAIL", std::to_string(detail)},
                                 {"SURFACE_EMISSION", flag(emission)},
                                 {"SURFACE_LOBES", flag(lobes)},
                                 {"SURFACE_UPDATE", flag(update)}});
}

// What an update makes besides the keys. Two of them take turns when there are updates.
struct Results {
    gl::Buffer faces, faceSources, chains;
    gl::Texture faceTexels, sourceTexels, chainTexels;
    std::uint32_t voxels = 0, faceCount = 0;  // there is room for

    void reserve(std::uint32_t wantedVoxels, std::uint32_t wantedFaces);
};

void Results::reserve(std::uint32_t wantedVoxels, std::uint32_t wantedFaces) {
    if (wantedVoxels > voxels) {
        chains = gl::Buffer(std::size_t{8} * wantedVoxels, "voxelizer chains");
        chainTexels = gl::Texture(chains, GL_RG32UI, "voxelizer chains");
        voxels = wantedVoxels;
    }
    if (wantedFaces > faceCount) {
        faces = gl::Buffer(sizeof(gpu::FaceRecord) * wantedFaces, "voxel faces");
        faceTexels = gl::Texture(faces, GL_RGBA32UI, "voxel faces");
        faceSources = gl::Buffer(std::size_t{8} * wantedFaces, "voxel face sources");
        sourceTexels = gl::Texture(faceSources, GL_RG32UI, "voxel face sources");
        faceCount = wantedFaces;
    }
}

void reserveRecords(VoxelKeys& keys, std::uint32_t voxels) {
    const std::size_t bytes = std::size_t{4} * voxels;
    if (keys.records.bytes() >= bytes && keys.records) return;
    keys.recordTexels = {};
    keys.records = gl::Buffer(bytes, "voxel records");
    keys.recordTexels = gl::Texture(keys.records, GL_R32UI, "voxel records");
}

void clearBricks(VoxelKeys& keys, const glm::ivec3& bricks) {
    const gl::TextureDesc& have = keys.brickWords.desc();
    if (!keys.brickWords || have.width != bricks.x || have.height != bricks.y || have.depth != bricks.z) {
        keys.brickWords =
            gl::Texture({GL_TEXTURE_3D, GL_RGBA32UI, bricks.x, bricks.y, bricks.z, 1}, "voxel bricks");
        // Integer textures are incomplete, and read as zero, with the filters that textures are born with.
        keys.brickWords.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        keys.brickWords.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    keys.brickWords.clear(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
}

// Which instances have changed since the last build, and what has to be done about them.
struct Edits {
    std::vector<std::uint32_t> stale;        // bit per instance
    std::vector<glm::uvec2> runs;            // instances to voxelize: index, first triangle of the work
    std::vector<std::uint32_t> dirtyBricks;  // where changed instances were
    std::uint32_t triangles = 0;             // of the work
    bool any = false;
};

// Marks the bricks that a box meets; one that is not finite meets all.
void addBricks(std::vector<bool>& marked, const VoxelGrid& grid, const Aabb& box) {
    if (box.empty()) return;
    const glm::ivec3 bricks = grid.bricks();
    glm::ivec3 low(0), high(bricks - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const float a = grid.gridFromWorld(box.min)[axis];
        const float b = grid.gridFromWorld(box.max)[axis];
        if (!std::isfinite(a) || !std::isfinite(b)) continue;
        const float far =
            std::max({std::abs(box.min[axis]), std::abs(box.max[axis]), std::abs(grid.origin[axis])});
        const float margin = kBoxMargin + kBoxRounding * far / grid.voxelSize;
        const float limit = static_cast<float>(bricks[axis]);
        low[axis] = static_cast<int>(std::clamp(std::floor((a - margin) / 4), 0.0f, limit));
        high[axis] = static_cast<int>(std::clamp(std::floor((b + margin) / 4), -1.0f, limit - 1));
    }
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) marked[brickIndex({x, y, z}, bricks)] = true;
}

}  // namespace

struct SurfaceVoxels::Impl {
    VoxelGrid grid;
    Capacity capacity;
    std::array<std::uint32_t, SURFACE_COUNTER_WORDS> counts{};
    Surfaces surfaces;

    VoxelKeys keys, oldKeys;  // oldKeys: of the voxels before, empty until the second build or update
    Results now, before;      // before: empty until the first update
    gl::Buffer brickList, gridBlock, changedBricks;
    // Work space
    gl::Buffer counters, constants, triangles, tiles, pairs, masks, fragments, chunks, owners, layered;
    gl::Texture triangleTexels, pairTexels, fragmentTexels, ownerTexels;
    gl::Buffer stale, runs, dirtyBricks, freeList, origins, workList;  // of updates

    // The scene as it was voxelized last.
    base::Revision sceneIdentity;
    std::vector<base::Revision> revisions;
    std::vector<Aabb> boxes;  // empty: not voxelized
    // Slots of fragments: those below `tail` are in use or on the list of free ones.
    std::uint32_t tail = 0, freeSlots = 0;
    SurfaceUpdate lastUpdate;

    void reserve(const scene::GpuScene& scene);
    void allocateFor(const Capacity& wanted);
    bool grow();
    void upload(const scene::GpuScene& scene, const Edits* edits = nullptr);
    void clearWorkSpace();
    gl::Inputs given() const;
    void mark(const gl::Device& device, const scene::GpuScene& scene);
    void compact(const gl::Device& device);
    void clip(const gl::Device& device, const scene::GpuScene& scene, bool update);
    void resolve(const gl::Device& device, bool update);
    void updateGridBlock();

    void remember(const scene::GpuScene& scene);
    bool canUpdate(const scene::GpuScene& scene, const VoxelGrid& wanted) const;
    Edits editsOf(const scene::GpuScene& scene) const;
    void uploadEdits(const scene::GpuScene& scene, const Edits& edits);
    void drop(const gl::Device& device, const Edits& edits);
    void markEdits(const gl::Device& device, const scene::GpuScene& scene, const Edits& edits);
    void carry(const gl::Device& device);
    bool finishUpdate(const Edits& edits);
};

SurfaceVoxels::SurfaceVoxels() : impl_(std::make_unique<Impl>()) {}
SurfaceVoxels::~SurfaceVoxels() = default;
SurfaceVoxels::SurfaceVoxels(SurfaceVoxels&&) noexcept = default;
SurfaceVoxels& SurfaceVoxels::operator=(SurfaceVoxels&&) noexcept = default;

// Memory for a first guess; grow() corrects it from what was counted.
void SurfaceVoxels::Impl::reserve(const scene::GpuScene& scene) {
    const auto bricks = static_cast<std::uint32_t>(grid.brickCount());
    const glm::ivec3 s = grid.size;
    // A box-shaped room has this many wall voxels, and what stands in it about as many again.
    const auto walls = static_cast<std::uint32_t>(2 * (s.x * s.y + s.y * s.z + s.z * s.x));
    Capacity wanted = capacity;
    wanted.gridBricks = std::max(wanted.gridBricks, bricks);
    wanted.triangles = std::max(wanted.triangles, scene.triangleCount());
    if (capacity.fragments == 0) {
        wanted.fragments = walls + 4 * scene.triangleCount();
        wanted.voxels = walls;
        wanted.faces = walls + walls / 2;
        wanted.tiles = walls / 16 + 1024;
        wanted.bricks = std::min(bricks, walls / 4 + 64);
    }
    allocateFor(wanted);
}

void SurfaceVoxels::Impl::allocateFor(const Capacity& wanted) {
    if (!constants) {
        constants = gl::Buffer(sizeof(gpu::SurfaceConstants), "voxelizer constants");
        gridBlock = gl::Buffer(sizeof(gpu::VoxelGrid), "voxel grid");
        counters = gl::Buffer(sizeof counts, "voxelizer counters");
        chunks = gl::Buffer(kMaxChunks * std::size_t{8}, "voxelizer chunks");
    }
    if (wanted.gridBricks > capacity.gridBricks) {
        masks = gl::Buffer(std::size_t{8} * wanted.gridBricks, "voxelizer masks");
        changedBricks = gl::Buffer(std::size_t{4} * ((wanted.gridBricks + 31) / 32), "changed bricks");
    }
    if (wanted.triangles > capacity.triangles) {
        triangles = gl::Buffer(std::size_t{48} * wanted.triangles, "voxelizer triangles");
        triangleTexels = gl::Texture(triangles, GL_RGBA32F, "voxelizer triangles");
    }
    if (wanted.tiles > capacity.tiles) tiles = gl::Buffer(std::size_t{8} * wanted.tiles, "voxelizer tiles");
    if (wanted.fragments > capacity.fragments) {
        pairs = gl::Buffer(std::size_t{8} * wanted.fragments, "voxelizer pairs");
        pairTexels = gl::Texture(pairs, GL_RG32UI, "voxelizer pairs");
        fragments = gl::Buffer(kFragmentBytes * wanted.fragments, "voxelizer fragments");
        fragmentTexels = gl::Texture(fragments, GL_RGBA32UI, "voxelizer fragments");
    }
    now.reserve(wanted.voxels, wanted.faces);
    reserveRecords(keys, wanted.voxels);
    if (wanted.faces > capacity.faces) {
        owners = gl::Buffer(std::size_t{4} * wanted.faces, "voxelizer face owners");
        ownerTexels = gl::Texture(owners, GL_R32UI, "voxelizer face owners");
        layered = gl::Buffer(std::size_t{4} * wanted.faces, "voxelizer layered faces");
    }
    if (wanted.bricks > capacity.bricks)
        brickList = gl::Buffer(std::size_t{4} * wanted.bricks, "occupied bricks");
    capacity = wanted;
}

// After a build: false when everything fitted, else the lists that did not are enlarged. The counts of lists
// that depend on one that overflowed are lower bounds, so this may be needed more than once.
bool SurfaceVoxels::Impl::grow() {
    Capacity wanted = capacity;
    const auto raise = [](std::uint32_t& have, std::uint32_t needed) {
        if (needed > have) have = static_cast<std::uint32_t>(std::ceil(kSlack * needed)) + 64;
    };
    raise(wanted.tiles, counts[SURFACE_TILES]);
    raise(wanted.fragments, counts[SURFACE_FRAGMENTS]);
    raise(wanted.voxels, counts[SURFACE_VOXELS]);
    raise(wanted.faces, counts[SURFACE_FACES]);
    raise(wanted.bricks, counts[SURFACE_BRICKS]);
    const bool grown = wanted.tiles > capacity.tiles || wanted.fragments > capacity.fragments ||
                       wanted.voxels > capacity.voxels || wanted.faces > capacity.faces ||
                       wanted.bricks > capacity.bricks;
    if (grown) allocateFor(wanted);
    return grown;
}

void SurfaceVoxels::Impl::upload(const scene::GpuScene& scene, const Edits* edits) {
    gpu::SurfaceConstants c{};
    c.triangleCount = edits != nullptr ? edits->triangles : scene.triangleCount();
    c.instanceCount =
        static_cast<std::uint32_t>(edits != nullptr ? edits->runs.size() : scene.instances().size());
    c.dirtyBricks = edits != nullptr ? static_cast<std::uint32_t>(edits->dirtyBricks.size()) : 0;
    c.tileCapacity = capacity.tiles;
    c.fragmentCapacity = capacity.fragments;
    c.voxelCapacity = capacity.voxels;
    c.faceCapacity = capacity.faces;
    c.brickCapacity = capacity.bricks;
    c.bricksPerChunk = perChunk(static_cast<std::uint32_t>(grid.brickCount()));
    c.voxelsPerChunk = perChunk(capacity.voxels);
    c.emissionScale = std::max(surfaces.largestEmission, kLeastEmission);
    constants.update(c);
    updateGridBlock();
}

void SurfaceVoxels::Impl::updateGridBlock() {
    gpu::VoxelGrid block = grid.packed();
    block.voxelCount = counts[SURFACE_VOXELS];
    block.faceCount = counts[SURFACE_FACES];
    block.occupiedBricks = counts[SURFACE_BRICKS];
    gridBlock.update(block);
}

void SurfaceVoxels::Impl::clearWorkSpace() {
    clearBricks(keys, grid.bricks());
    counters.clear();
    masks.clear();
    now.chains.clear();
    changedBricks.fill(~0u);
}

// All that passes of the voxelizer read, as it is.
gl::Inputs SurfaceVoxels::Impl::given() const {
    gl::Inputs inputs;
    const auto storage = [&](gl::ResourceName name, const gl::Buffer& buffer) {
        if (buffer) inputs.storage(name, buffer);
    };
    const auto texture = [&](gl::ResourceName name, const gl::Texture& source) {
        if (source) inputs.texture(name, source);
    };
    inputs.uniform("SurfaceBlock", constants).uniform("VoxelGridBlock", gridBlock);
    storage("CounterTable", counters);
    storage("MaskTable", masks);
    storage("ChunkTable", chunks);
    storage("TriangleTable", triangles);
    storage("TileTable", tiles);
    storage("PairTable", pairs);
    storage("FragmentTable", fragments);
    storage("ChainTable", now.chains);
    storage("OldChainTable", before.chains);
    storage("BrickTable", brickList);
    storage("OwnerTable", owners);
    storage("LayerTable", layered);
    storage("RecordTable", keys.records);
    storage("FaceTable", now.faces);
    storage("SourceTable", now.faceSources);
    storage("FreeTable", freeList);
    storage("ChangedTable", changedBricks);
    storage("DirtyTable", dirtyBricks);
    storage("StaleTable", stale);
    storage("RunTable", runs);
    storage("OriginTable", origins);
    storage("WorkTable", workList);
    texture("triangles", triangleTexels);
    texture("pairs", pairTexels);
    texture("fragments", fragmentTexels);
    texture("owners", ownerTexels);
    texture("brickWords", keys.brickWords);
    texture("oldBricks", oldKeys.brickWords);
    texture("oldRecords", oldKeys.recordTexels);
    texture("oldFaces", before.faceTexels);
    texture("oldSources", before.sourceTexels);
    if (keys.brickWords) inputs.image("brickWords", keys.brickWords, gl::ImageUse::Write);
    return inputs;
}

// Triangles -> pairs (triangle, voxel), and a bit per voxel.
void SurfaceVoxels::Impl::mark(const gl::Device& device, const scene::GpuScene& scene) {
    const gl::PassScope scope(device.profiler, "voxelize: mark");
    clearWorkSpace();
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(markPass("surface_setup", false)).dispatchLinear(given, scene.triangleCount());
    gl::barrier(gl::Access::ShaderStorage);
    device.get(scanPass(0)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::TextureFetch);
    device.get(markPass("surface_tiles", false)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_TILES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Bits -> brickWord and the list of occupied bricks.
void SurfaceVoxels::Impl::compact(const gl::Device& device) {
    const gl::PassScope scope(device.profiler, "voxelize: compact");
    gl::Inputs given = this->given();
    const auto bricks = static_cast<std::uint32_t>(grid.brickCount());
    const std::uint32_t chunkCount = (bricks + perChunk(bricks) - 1) / perChunk(bricks);
    device.get(countPass(true)).dispatchLinear(given, chunkCount);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(scanPass(1)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    device.get(pass("surface_bricks")).dispatchLinear(given, chunkCount);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Pairs -> clipped fragments in the chains of their voxels.
void SurfaceVoxels::Impl::clip(const gl::Device& device, const scene::GpuScene& scene, bool update) {
    const gl::PassScope scope(device.profiler, "voxelize: clip");
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(clipPass(surfaces.detail, surfaces.emit(), surfaces.lobes, update))
        .dispatchIndirect(given, counters, 4 * SURFACE_ARGS_FRAGMENTS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Directions -> faces, chains -> what they show.
void SurfaceVoxels::Impl::resolve(const gl::Device& device, bool update) {
    const gl::PassScope scope(device.profiler, "voxelize: resolve");
    gl::Inputs given = this->given();
    device.get(countPass(false)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_VOXELS);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(scanPass(2)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    device.get(markPass("surface_faces", update)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_VOXELS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    if (update) {
        device.get(scanPass(3)).dispatch(given, 1);
        device.get(pass("surface_copy")).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_FACES);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    }
    device.get(resolvePass(surfaces.emit(), surfaces.lobes, update))
        .dispatchIndirect(given, counters, 4 * (update ? SURFACE_ARGS_WORK : SURFACE_ARGS_FACES));
    gl::barrier(gl::Access::ShaderStorage);
    device.get(scanPass(4)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    for (const bool onlyWide : {false, true})
        device.get(layersPass(surfaces.emit(), surfaces.lobes, onlyWide))
            .dispatchIndirect(given, counters, 4 * (onlyWide ? SURFACE_ARGS_WIDE : SURFACE_ARGS_LAYERS));
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Indirect);
}

VoxelGrid SurfaceVoxels::gridOf(const scene::GpuScene& scene, const VoxelSettings& settings) {
    return grownGrid(fitGrid(scene.firstBounds(), settings.size, settings.padding, settings.shift),
                     scene.bounds());
}

void SurfaceVoxels::build(const gl::Device& device, const scene::GpuScene& scene,
                          const VoxelSettings& settings) {
    build(device, scene, gridOf(scene, settings));
}

void SurfaceVoxels::build(const gl::Device& device, const scene::GpuScene& scene, const VoxelGrid& grid) {
    Impl& m = *impl_;
    // The keys of the voxels there are stay for readers that carry something over.
    if (m.keys.revision) std::swap(m.keys, m.oldKeys);
    m.keys.revision = {};
    m.grid = grid;
    m.surfaces = surfacesOf(scene);
    m.reserve(scene);
    reserveRecords(m.keys, m.capacity.voxels);
    // A list that overflows hides the true size of those after it: tiles, fragments, voxels, faces.
    constexpr int kMaxAttempts = 5;
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
        m.upload(scene);
        m.mark(device, scene);
        m.compact(device);
        m.clip(device, scene, false);
        m.resolve(device, false);
        m.counters.read(0, m.counts.data(), sizeof m.counts);
        if (!m.grow()) break;
        CONELIGHT_ASSERT(attempt + 1 < kMaxAttempts,
                         "SurfaceVoxels::build: lists still too small after growing");
    }
    m.updateGridBlock();
    m.keys.grid = m.grid;
    m.keys.faceCount = m.counts[SURFACE_FACES];
    m.keys.revision = base::Revision::next();
    m.remember(scene);
    m.tail = m.counts[SURFACE_FRAGMENTS];
    m.freeSlots = 0;
    m.lastUpdate = {true, scene.triangleCount(), m.tail, m.counts[SURFACE_FACES]};
}

// --- Updates

void SurfaceVoxels::Impl::remember(const scene::GpuScene& scene) {
    const std::size_t count = scene.instances().size();
    sceneIdentity = scene.identity();
    revisions.resize(count);
    boxes.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        revisions[i] = scene.instanceRevision(i);
        boxes[i] = (scene.instances()[i].flags & INSTANCE_VOXELIZED) != 0 ? scene.instanceBounds(i) : Aabb{};
    }
}

bool SurfaceVoxels::Impl::canUpdate(const scene::GpuScene& scene, const VoxelGrid& wanted) const {
    return sceneIdentity == scene.identity() && grid == wanted && surfaces == surfacesOf(scene);
}

Edits SurfaceVoxels::Impl::editsOf(const scene::GpuScene& scene) const {
    Edits edits;
    const std::size_t count = revisions.size();
    edits.stale.resize(count / 32 + 1);
    std::vector<bool> marked(grid.brickCount());
    for (std::size_t i = 0; i < count; ++i) {
        if (revisions[i] == scene.instanceRevision(i)) continue;
        const gpu::Instance& instance = scene.instances()[i];
        const auto index = static_cast<std::uint32_t>(i);
        edits.any = true;
        edits.stale[index / 32] |= 1u << (index % 32);
        addBricks(marked, grid, boxes[i]);
        if ((instance.flags & INSTANCE_VOXELIZED) == 0 || instance.indexCount < 3) continue;
        edits.runs.emplace_back(index, edits.triangles);
        edits.triangles += instance.indexCount / 3;
    }
    for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i]) edits.dirtyBricks.push_back(static_cast<std::uint32_t>(i));
    return edits;
}

void SurfaceVoxels::Impl::uploadEdits(const scene::GpuScene& scene, const Edits& edits) {
    before.reserve(capacity.voxels, capacity.faces);
    const auto room = [](gl::Buffer& buffer, std::size_t bytes, const char* label) {
        if (!buffer || buffer.bytes() < bytes) buffer = gl::Buffer(bytes + bytes / 4, label);
    };
    const auto fill = [&](gl::Buffer& buffer, const auto& values, const char* label) {
        const std::size_t bytes = values.size() * sizeof values[0];
        room(buffer, bytes, label);
        buffer.update(0, values.data(), bytes);
    };
    fill(stale, edits.stale, "voxelizer stale instances");
    fill(runs, edits.runs, "voxelizer changed instances");
    fill(dirtyBricks, edits.dirtyBricks, "voxelizer dirty bricks");
    if (!freeList || freeList.bytes() < std::size_t{4} * capacity.fragments)
        freeList = gl::Buffer(std::size_t{4} * capacity.fragments, "voxelizer free slots");
    room(origins, std::size_t{4} * capacity.voxels, "voxelizer origins");
    room(workList, std::size_t{4} * capacity.faces, "voxelizer work list");

    upload(scene, &edits);
    std::array<std::uint32_t, SURFACE_COUNTER_WORDS> start{};
    start[SURFACE_FREE] = freeSlots;
    start[SURFACE_TAIL] = tail;
    counters.update(start);
    changedBricks.clear();
}

// Old place: fragments leave their chains, slots become free.
void SurfaceVoxels::Impl::drop(const gl::Device& device, const Edits& edits) {
    const gl::PassScope scope(device.profiler, "voxelize: drop");
    gl::Inputs given = this->given();
    device.get(pass("surface_drop")).dispatchLinear(given, 64 * edits.dirtyBricks.size());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// New place: as mark(), for the triangles of changed instances.
void SurfaceVoxels::Impl::markEdits(const gl::Device& device, const scene::GpuScene& scene,
                                    const Edits& edits) {
    const gl::PassScope scope(device.profiler, "voxelize: mark");
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(markPass("surface_setup", true)).dispatchLinear(given, edits.triangles);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(scanPass(0)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::TextureFetch);
    device.get(markPass("surface_tiles", true)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_TILES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Chains under the new numbers of their voxels. `before` is what was there, `now` what will be.
void SurfaceVoxels::Impl::carry(const gl::Device& device) {
    const gl::PassScope scope(device.profiler, "voxelize: carry");
    gl::Inputs given = this->given();
    device.get(pass("surface_carry")).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_BRICKS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Reads the counts back. False when a list was too small: what there is now is of no use.
bool SurfaceVoxels::Impl::finishUpdate(const Edits& edits) {
    counters.read(0, counts.data(), sizeof counts);
    const std::uint32_t made = counts[SURFACE_FRAGMENTS];
    const std::uint32_t reused = std::min(made, counts[SURFACE_FREE]);
    tail += made - reused;
    freeSlots = counts[SURFACE_FREE] - reused;
    lastUpdate = {false, edits.triangles, made, counts[SURFACE_WORK]};
    return tail <= capacity.fragments && counts[SURFACE_TILES] <= capacity.tiles &&
           counts[SURFACE_VOXELS] <= capacity.voxels && counts[SURFACE_FACES] <= capacity.faces &&
           counts[SURFACE_BRICKS] <= capacity.bricks;
}

void SurfaceVoxels::update(const gl::Device& device, const scene::GpuScene& scene,
                           const VoxelSettings& settings) {
    Impl& m = *impl_;
    const VoxelGrid grid = gridOf(scene, settings);
    if (!m.canUpdate(scene, grid)) return build(device, scene, grid);
    const Edits edits = m.editsOf(scene);
    // Beyond half of all triangles, to clip all is as cheap as to search for those to keep.
    if (2 * edits.triangles > scene.triangleCount()) return build(device, scene, grid);
    if (!edits.any) {
        m.changedBricks.clear();
        m.lastUpdate = {};
        return;
    }
    m.uploadEdits(scene, edits);
    m.drop(device, edits);
    m.markEdits(device, scene, edits);
    std::swap(m.now, m.before);
    std::swap(m.keys, m.oldKeys);
    m.keys.revision = {};
    reserveRecords(m.keys, m.capacity.voxels);
    clearBricks(m.keys, m.grid.bricks());
    m.compact(device);
    m.carry(device);
    m.clip(device, scene, true);
    m.resolve(device, true);
    if (!m.finishUpdate(edits)) {
        // A list is too small: grow() in build() sees what a whole scene needs.
        m.sceneIdentity = {};
        return build(device, scene, grid);
    }
    m.updateGridBlock();
    m.keys.grid = m.grid;
    m.keys.faceCount = m.counts[SURFACE_FACES];
    m.keys.revision = base::Revision::next();
    m.remember(scene);
}

void VoxelKeys::declare(gl::Inputs& inputs) const {
    inputs.texture("voxelBricks", brickWords)
        .image("voxelBrickImage", brickWords, gl::ImageUse::Read)
        .texture("voxelRecords", recordTexels)
        .storage("RecordTable", records);
}
void VoxelKeys::declareOld(gl::Inputs& inputs) const {
    inputs.texture("oldBricks", brickWords).texture("oldRecords", recordTexels);
}

void SurfaceVoxels::declare(gl::Inputs& inputs) const {
    const Impl& m = *impl_;
    CONELIGHT_ASSERT(m.keys.revision, "SurfaceVoxels::declare before build");
    m.keys.declare(inputs);
    inputs.uniform("VoxelGridBlock", m.gridBlock)
        .texture("voxelFaces", m.now.faceTexels)
        .texture("voxelFaceSources", m.now.sourceTexels)
        .storage("FaceTable", m.now.faces)
        .storage("SourceTable", m.now.faceSources)
        .storage("BrickTable", m.brickList);
}

void SurfaceVoxels::declareTriangles(gl::Inputs& inputs) const {
    const Impl& m = *impl_;
    inputs.texture("voxelChains", m.now.chainTexels)
        .texture("voxelFragments", m.fragmentTexels)
        .texture("voxelPairs", m.pairTexels)
        .texture("voxelTriangles", m.triangleTexels);
}

base::Revision SurfaceVoxels::revision() const { return impl_->keys.revision; }
const VoxelKeys& SurfaceVoxels::keys() const { return impl_->keys; }
const VoxelKeys* SurfaceVoxels::previous() const {
    return impl_->oldKeys.revision ? &impl_->oldKeys : nullptr;
}

const VoxelGrid& SurfaceVoxels::grid() const { return impl_->grid; }
std::uint32_t SurfaceVoxels::voxelCount() const { return impl_->counts[SURFACE_VOXELS]; }
std::uint32_t SurfaceVoxels::faceCount() const { return impl_->counts[SURFACE_FACES]; }
std::uint32_t SurfaceVoxels::occupiedBrickCount() const { return impl_->counts[SURFACE_BRICKS]; }
std::uint32_t SurfaceVoxels::fragmentCount() const { return impl_->tail - impl_->freeSlots; }
const gl::Texture& SurfaceVoxels::brickWords() const { return impl_->keys.brickWords; }
const gl::Buffer& SurfaceVoxels::records() const { return impl_->keys.records; }
const gl::Buffer& SurfaceVoxels::faces() const { return impl_->now.faces; }
const gl::Buffer& SurfaceVoxels::faceSources() const { return impl_->now.faceSources; }
const gl::Buffer& SurfaceVoxels::occupiedBricks() const { return impl_->brickList; }
const gl::Buffer& SurfaceVoxels::changedBricks() const { return impl_->changedBricks; }
const SurfaceUpdate& SurfaceVoxels::lastUpdate() const { return impl_->lastUpdate; }
const gl::Buffer& SurfaceVoxels::fragments() const { return impl_->fragments; }

std::vector<gl::ProgramDesc> SurfaceVoxels::programDescs() {
    std::vector<gl::ProgramDesc> descs{pass("surface_bricks"), pass("surface_carry"), pass("surface_copy"),
                                       pass("surface_drop"),   countPass(true),       countPass(false)};
    for (int i = 0; i < 5; ++i) descs.push_back(scanPass(i));
    for (const bool emission : {false, true})
        for (const bool lobes : {false, true})
            for (const bool onlyWide : {false, true}) descs.push_back(layersPass(emission, lobes, onlyWide));
    for (const bool update : {false, true}) {
        for (const char* name : {"surface_setup", "surface_tiles", "surface_faces"})
            descs.push_back(markPass(name, update));
        for (const bool emission : {false, true}) {
            for (const bool lobes : {false, true}) {
                descs.push_back(resolvePass(emission, lobes, update));
                for (int detail = lobes ? 1 : 0; detail < 3; ++detail)
                    descs.push_back(clipPass(detail, emission, lobes, update));
            }
        }
    }
    return descs;
}

}  // namespace conelight::voxels
