// SPDX-License-Identifier: MIT
#include "voxels/surface_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"
#include "shared/bindings.h"

namespace conelight::voxels {
namespace {

// Storage and texture slots of the passes; the same numbers as in shaders/voxels/surface_common.glsl.
enum Slot : unsigned {
    kCounters = 8,
    kTriangles = 9,
    kTiles = 10,
    kPairs = 11,
    kMasks = 12,
    kChains = 13,
    kFragments = 14,
    kChunks = 15,
    kBrickList = 10,
    kOwners = 10,
    kFaceSources = 9,
};
enum Unit : unsigned { kUnitTriangles = 8, kUnitPairs = 9, kUnitFragments = 10, kUnitOwners = 11 };

constexpr std::uint32_t kMaxChunks = 4096;  // one invocation walks over all chunks
constexpr std::uint32_t kLeastChunk = 16;   // fewer elements per invocation are not worth starting it
constexpr double kSlack = 1.25;             // room for growth when memory is allocated anew
constexpr std::size_t kFragmentBytes = 32;
constexpr float kLeastEmission = 1e-6f;       // W/(sr m^2); less is none
constexpr float kLargestEmission = 65504.0f;  // what a half holds

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
    bool emit() const { return largestEmission > kLeastEmission; }
};

Surfaces surfacesOf(const scene::GpuScene& scene) {
    Surfaces surfaces;
    surfaces.detail = scene.hasVertexColors() ? 1 : 0;
    for (const gpu::Instance& instance : scene.instances()) {
        if ((instance.flags & INSTANCE_VOXELIZED) == 0) continue;
        const gpu::Material& m = scene.materials()[instance.material];
        const bool textured = m.layers.x >= 0 || m.layers.w >= 0 || (m.flags & MATERIAL_ALPHA_BLEND) != 0;
        surfaces.detail =
            std::max(surfaces.detail, (m.flags & MATERIAL_ALPHA_MASK) != 0 ? 2 : (textured ? 1 : 0));
        if ((m.flags & MATERIAL_UNLIT) != 0) continue;
        surfaces.largestEmission =
            std::max({surfaces.largestEmission, m.emission.x, m.emission.y, m.emission.z});
    }
    surfaces.largestEmission = std::min(surfaces.largestEmission, kLargestEmission);
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
gl::ProgramDesc resolvePass(bool emission) {
    return pass("surface_resolve", {{"SURFACE_EMISSION", emission ? "1" : "0"}});
}
gl::ProgramDesc clipPass(int detail, bool emission) {
    return pass("surface_clip",
                {{"SURFACE_DETAIL", std::to_string(detail)}, {"SURFACE_EMISSION", emission ? "1" : "0"}});
}

}  // namespace

struct SurfaceVoxels::Impl {
    VoxelGrid grid;
    Capacity capacity;
    std::array<std::uint32_t, SURFACE_COUNTER_WORDS> counts{};
    Surfaces surfaces;

    // Results
    gl::Texture brickWords;
    gl::Buffer records, faces, faceSources, brickList, gridBlock;
    gl::Texture recordTexels, faceTexels, sourceTexels;
    // Work space
    gl::Buffer counters, constants, triangles, tiles, pairs, masks, chains, fragments, chunks, owners;
    gl::Texture triangleTexels, pairTexels, fragmentTexels, ownerTexels;

    void reserve(const scene::GpuScene& scene);
    void allocateFor(const Capacity& wanted);
    bool grow();
    void upload(const scene::GpuScene& scene);
    void clearWorkSpace();
    void mark(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene);
    void compact(gl::ProgramLibrary& programs, gl::Profiler& profiler);
    void clip(gl::ProgramLibrary& programs, gl::Profiler& profiler);
    void resolve(gl::ProgramLibrary& programs, gl::Profiler& profiler);
    void updateGridBlock();
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
    if (wanted.gridBricks > capacity.gridBricks)
        masks = gl::Buffer(std::size_t{8} * wanted.gridBricks, "voxelizer masks");
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
    if (wanted.voxels > capacity.voxels) {
        chains = gl::Buffer(std::size_t{8} * wanted.voxels, "voxelizer chains");
        records = gl::Buffer(std::size_t{4} * wanted.voxels, "voxel records");
        recordTexels = gl::Texture(records, GL_R32UI, "voxel records");
    }
    if (wanted.faces > capacity.faces) {
        faces = gl::Buffer(sizeof(gpu::FaceRecord) * wanted.faces, "voxel faces");
        faceTexels = gl::Texture(faces, GL_RGBA32UI, "voxel faces");
        faceSources = gl::Buffer(std::size_t{8} * wanted.faces, "voxel face sources");
        sourceTexels = gl::Texture(faceSources, GL_RG32UI, "voxel face sources");
        owners = gl::Buffer(std::size_t{4} * wanted.faces, "voxelizer face owners");
        ownerTexels = gl::Texture(owners, GL_R32UI, "voxelizer face owners");
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

void SurfaceVoxels::Impl::upload(const scene::GpuScene& scene) {
    gpu::SurfaceConstants c{};
    c.triangleCount = scene.triangleCount();
    c.instanceCount = static_cast<std::uint32_t>(scene.instances().size());
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
    const glm::ivec3 bricks = grid.bricks();
    const gl::TextureDesc& have = brickWords.desc();
    if (!brickWords || have.width != bricks.x || have.height != bricks.y || have.depth != bricks.z) {
        brickWords =
            gl::Texture({GL_TEXTURE_3D, GL_RGBA32UI, bricks.x, bricks.y, bricks.z, 1}, "voxel bricks");
        // Integer textures are incomplete, and read as zero, with the filters that textures are born with.
        brickWords.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        brickWords.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    brickWords.clear(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
    counters.clear();
    masks.clear();
    chains.clear();
    counters.bindStorage(kCounters);
    masks.bindStorage(kMasks);
    chunks.bindStorage(kChunks);
    constants.bindUniform(BINDING_PASS);
    gridBlock.bindUniform(BINDING_VOXEL_GRID);
}

// Triangles -> pairs (triangle, voxel), and a bit per voxel.
void SurfaceVoxels::Impl::mark(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                               const scene::GpuScene& scene) {
    const gl::PassScope scope(profiler, "voxelize: mark");
    clearWorkSpace();
    scene.bind();
    triangles.bindStorage(kTriangles);
    tiles.bindStorage(kTiles);
    pairs.bindStorage(kPairs);
    programs.get(pass("surface_setup")).dispatchLinear(scene.triangleCount());
    gl::barrier(gl::Access::ShaderStorage);
    programs.get(scanPass(0)).dispatch(1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::TextureFetch);
    triangleTexels.bind(kUnitTriangles);
    programs.get(pass("surface_tiles")).dispatchIndirect(counters, 4 * SURFACE_ARGS_TILES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Bits -> brickWord and the list of occupied bricks.
void SurfaceVoxels::Impl::compact(gl::ProgramLibrary& programs, gl::Profiler& profiler) {
    const gl::PassScope scope(profiler, "voxelize: compact");
    const auto bricks = static_cast<std::uint32_t>(grid.brickCount());
    const std::uint32_t chunkCount = (bricks + perChunk(bricks) - 1) / perChunk(bricks);
    programs.get(countPass(true)).dispatchLinear(chunkCount);
    gl::barrier(gl::Access::ShaderStorage);
    programs.get(scanPass(1)).dispatch(1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    brickList.bindStorage(kBrickList);
    brickWords.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(pass("surface_bricks")).dispatchLinear(chunkCount);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Pairs -> clipped fragments in the chains of their voxels.
void SurfaceVoxels::Impl::clip(gl::ProgramLibrary& programs, gl::Profiler& profiler) {
    const gl::PassScope scope(profiler, "voxelize: clip");
    chains.bindStorage(kChains);
    fragments.bindStorage(kFragments);
    brickWords.bind(UNIT_VOXEL_BRICKS);
    triangleTexels.bind(kUnitTriangles);
    pairTexels.bind(kUnitPairs);
    programs.get(clipPass(surfaces.detail, surfaces.emit()))
        .dispatchIndirect(counters, 4 * SURFACE_ARGS_FRAGMENTS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Directions -> faces, chains -> what they show.
void SurfaceVoxels::Impl::resolve(gl::ProgramLibrary& programs, gl::Profiler& profiler) {
    const gl::PassScope scope(profiler, "voxelize: resolve");
    programs.get(countPass(false)).dispatchIndirect(counters, 4 * SURFACE_ARGS_VOXELS);
    gl::barrier(gl::Access::ShaderStorage);
    programs.get(scanPass(2)).dispatch(1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    owners.bindStorage(kOwners);
    records.bindStorage(BINDING_VOXEL_RECORDS);
    programs.get(pass("surface_faces")).dispatchIndirect(counters, 4 * SURFACE_ARGS_VOXELS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    faces.bindStorage(BINDING_VOXEL_FACES);
    faceSources.bindStorage(kFaceSources);
    pairTexels.bind(kUnitPairs);
    fragmentTexels.bind(kUnitFragments);
    ownerTexels.bind(kUnitOwners);
    programs.get(resolvePass(surfaces.emit())).dispatchIndirect(counters, 4 * SURFACE_ARGS_FACES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Indirect);
}

VoxelGrid SurfaceVoxels::gridOf(const scene::GpuScene& scene, const VoxelSettings& settings) {
    return grownGrid(fitGrid(scene.firstBounds(), settings.size, settings.padding, settings.shift),
                     scene.bounds());
}

void SurfaceVoxels::build(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                          const VoxelSettings& settings) {
    build(programs, profiler, scene, gridOf(scene, settings));
}

void SurfaceVoxels::build(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                          const VoxelGrid& grid) {
    Impl& m = *impl_;
    m.grid = grid;
    m.surfaces = surfacesOf(scene);
    m.reserve(scene);
    // A list that overflows hides the true size of those after it: tiles, fragments, voxels, faces.
    constexpr int kMaxAttempts = 5;
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
        m.upload(scene);
        m.mark(programs, profiler, scene);
        m.compact(programs, profiler);
        m.clip(programs, profiler);
        m.resolve(programs, profiler);
        m.counters.read(0, m.counts.data(), sizeof m.counts);
        if (!m.grow()) break;
        CONELIGHT_ASSERT(attempt + 1 < kMaxAttempts,
                         "SurfaceVoxels::build: lists still too small after growing");
    }
    m.updateGridBlock();
}

void SurfaceVoxels::bind() const {
    const Impl& m = *impl_;
    CONELIGHT_ASSERT(m.gridBlock, "SurfaceVoxels::bind before build");
    m.gridBlock.bindUniform(BINDING_VOXEL_GRID);
    m.faces.bindStorage(BINDING_VOXEL_FACES);
    m.records.bindStorage(BINDING_VOXEL_RECORDS);
    m.brickWords.bind(UNIT_VOXEL_BRICKS);
    m.recordTexels.bind(UNIT_VOXEL_RECORDS);
    m.faceTexels.bind(UNIT_VOXEL_FACES);
    m.sourceTexels.bind(UNIT_VOXEL_FACE_SOURCES);
}

const VoxelGrid& SurfaceVoxels::grid() const { return impl_->grid; }
std::uint32_t SurfaceVoxels::voxelCount() const { return impl_->counts[SURFACE_VOXELS]; }
std::uint32_t SurfaceVoxels::faceCount() const { return impl_->counts[SURFACE_FACES]; }
std::uint32_t SurfaceVoxels::occupiedBrickCount() const { return impl_->counts[SURFACE_BRICKS]; }
std::uint32_t SurfaceVoxels::fragmentCount() const { return impl_->counts[SURFACE_FRAGMENTS]; }
const gl::Texture& SurfaceVoxels::brickWords() const { return impl_->brickWords; }
const gl::Buffer& SurfaceVoxels::records() const { return impl_->records; }
const gl::Buffer& SurfaceVoxels::faces() const { return impl_->faces; }
const gl::Buffer& SurfaceVoxels::faceSources() const { return impl_->faceSources; }
const gl::Buffer& SurfaceVoxels::occupiedBricks() const { return impl_->brickList; }
const gl::Buffer& SurfaceVoxels::fragments() const { return impl_->fragments; }

std::vector<gl::ProgramDesc> SurfaceVoxels::programDescs() {
    std::vector<gl::ProgramDesc> descs{pass("surface_setup"), pass("surface_tiles"), pass("surface_bricks"),
                                       pass("surface_faces"), resolvePass(false),    resolvePass(true),
                                       countPass(true),       countPass(false)};
    for (int i = 0; i < 3; ++i) descs.push_back(scanPass(i));
    for (int i = 0; i < 6; ++i) descs.push_back(clipPass(i / 2, i % 2 == 1));
    return descs;
}

}  // namespace conelight::voxels
