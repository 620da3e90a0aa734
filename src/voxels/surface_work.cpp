// SPDX-License-Identifier: MIT
#include "voxels/surface_work.h"

#include <algorithm>
#include <cmath>

#include "gl/gl.h"
#include "scene/gpu_materials.h"
#include "voxels/nested_grid.h"

namespace conelight::voxels {
namespace {

constexpr double kSlack = 1.25;           // room for growth when memory is allocated anew
constexpr std::uint32_t kSpareShare = 8;  // of what a first build found, one in so many is left as room
constexpr std::size_t kFragmentBytes = 32;
constexpr float kLargestEmission = 65504.0f;  // what a half holds

// Room for what is there and a little more, if that is less than there is.
std::uint32_t trimmed(std::uint32_t have, std::uint32_t used) { return std::min(have, withSpare(used)); }

// Makes room for so many bytes; all that is there is kept.
void growBuffer(gl::Buffer& buffer, std::size_t bytes, const char* label) {
    if (buffer && buffer.bytes() >= bytes) return;
    gl::Buffer larger(bytes, label);
    if (buffer) larger.copyFrom(buffer, buffer.bytes());
    buffer = std::move(larger);
}

// The same, and the texture over it.
void growList(gl::Buffer& buffer, gl::Texture& texels, std::size_t bytes, const char* label) {
    const unsigned format = texels.desc().format;
    texels = {};
    growBuffer(buffer, bytes, label);
    texels = gl::Texture(buffer, format, label);
}

void trimBuffer(gl::Buffer& buffer, std::size_t bytes, const char* label) {
    if (bytes >= buffer.bytes()) return;
    gl::Buffer smaller(bytes, label);
    smaller.copyFrom(buffer, bytes);
    buffer = std::move(smaller);
}

// A list and the texture over it, which is made anew.
void trimList(gl::Buffer& buffer, gl::Texture& texels, std::size_t bytes, const char* label) {
    if (bytes >= buffer.bytes()) return;
    const unsigned format = texels.desc().format;
    texels = {};
    trimBuffer(buffer, bytes, label);
    texels = gl::Texture(buffer, format, label);
}

}  // namespace

std::uint32_t withSpare(std::uint32_t needed) { return needed + needed / kSpareShare + 64; }

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
        surfaces.lobes = surfaces.lobes || m.metallic > 0 || scene::isGlossyDielectric(m);
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

void Results::reserve(std::uint32_t wantedVoxels, std::uint32_t wantedFaces) {
    if (wantedVoxels > voxels) {
        chains = gl::Buffer(std::size_t{8} * wantedVoxels, "voxelizer chains");
        chainTexels = gl::Texture(chains, GL_RG32UI, "voxelizer chains");
        voxels = wantedVoxels;
    }
    if (wantedFaces > faceCount) {
        faces = gl::Buffer(sizeof(gpu::FaceRecord) * wantedFaces, "voxel faces");
        faceTexels = gl::Texture(faces, GL_RGBA32UI, "voxel faces");
        faceMaterials = gl::Buffer(sizeof(gpu::FaceMaterial) * wantedFaces, "voxel face materials");
        materialTexels = gl::Texture(faceMaterials, GL_RGBA32UI, "voxel face materials");
        faceCount = wantedFaces;
    }
}

void Results::trim(std::uint32_t wantedVoxels, std::uint32_t wantedFaces) {
    trimList(chains, chainTexels, std::size_t{8} * wantedVoxels, "voxelizer chains");
    trimList(faces, faceTexels, sizeof(gpu::FaceRecord) * wantedFaces, "voxel faces");
    trimList(faceMaterials, materialTexels, sizeof(gpu::FaceMaterial) * wantedFaces, "voxel face materials");
    voxels = wantedVoxels;
    faceCount = wantedFaces;
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
            gl::Texture({GL_TEXTURE_3D, GL_RGBA32UI, bricks.x, bricks.y, bricks.z, 1, true}, "voxel bricks");
        // Integer textures are incomplete, and read as zero, with the filters that textures are born with.
        keys.brickWords.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        keys.brickWords.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    keys.brickWords.clear(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
}

// Memory for a first guess; grow() corrects it from what was counted.
void SurfaceVoxels::Impl::reserve(const scene::GpuScene& scene) {
    const auto bricks = static_cast<std::uint32_t>(grid.brickCount());
    const glm::ivec3 s = grid.size;
    // A box-shaped room has this many wall voxels, and what stands in it about as many again.
    const auto walls = static_cast<std::uint32_t>(grid.levels * 2 * (s.x * s.y + s.y * s.z + s.z * s.x));
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
        levelBlock = gl::Buffer(sizeof(gpu::VoxelLevels), "voxel levels");
        scrollBlock = gl::Buffer(sizeof(gpu::VoxelScroll), "voxelizer scroll");
        counters = gl::Buffer(sizeof counts, "voxelizer counters");
    }
    const std::size_t chunkBytes =
        std::size_t{8} * std::max(gpu::mostChunks(wanted.gridBricks), gpu::mostChunks(wanted.voxels));
    if (chunkBytes > chunks.bytes()) chunks = gl::Buffer(chunkBytes, "voxelizer chunks");
    if (wanted.gridBricks > capacity.gridBricks) {
        masks = gl::Buffer(std::size_t{8} * wanted.gridBricks, "voxelizer masks");
        changedBricks = gl::Buffer(std::size_t{4} * ((wanted.gridBricks + 31) / 32), "changed bricks");
    }
    if (!triangles || wanted.triangles > capacity.triangles) {
        triangles = gl::Buffer(std::size_t{48} * wanted.triangles, "voxelizer triangles");
        triangleTexels = gl::Texture(triangles, GL_RGBA32F, "voxelizer triangles");
    }
    if (!tiles || wanted.tiles > capacity.tiles)
        tiles = gl::Buffer(std::size_t{8} * wanted.tiles, "voxelizer tiles");
    if (wanted.fragments > capacity.fragments) {
        pairs = gl::Buffer(std::size_t{8} * wanted.fragments, "voxelizer pairs");
        pairTexels = gl::Texture(pairs, GL_RG32UI, "voxelizer pairs");
        fragments = gl::Buffer(kFragmentBytes * wanted.fragments, "voxelizer fragments");
        fragmentTexels = gl::Texture(fragments, GL_RGBA32UI, "voxelizer fragments");
    }
    now.reserve(wanted.voxels, wanted.faces);
    reserveRecords(keys, wanted.voxels);
    if (!owners || wanted.faces > capacity.faces) reserveFaceLists(wanted.faces);
    if (wanted.bricks > capacity.bricks)
        brickList = gl::Buffer(std::size_t{4} * wanted.bricks, "occupied bricks");
    capacity = wanted;
}

// Lists that nothing reads after a build. They are kept from the second build or update on: voxels then
// change again and again.
void SurfaceVoxels::Impl::releaseLists() {
    tiles = {};
    ownerTexels = {};
    owners = {};
    layered = {};
}

// After a first build, whose lists were sized by a guess: gives back what they have too much. A scene that
// never changes needs no more; one that does gets more as it grows.
void SurfaceVoxels::Impl::trim() {
    capacity.fragments = trimmed(capacity.fragments, counts[SURFACE_FRAGMENTS]);
    capacity.voxels = trimmed(capacity.voxels, counts[SURFACE_VOXELS]);
    capacity.faces = trimmed(capacity.faces, counts[SURFACE_FACES]);
    trimList(pairs, pairTexels, std::size_t{8} * capacity.fragments, "voxelizer pairs");
    trimList(fragments, fragmentTexels, kFragmentBytes * capacity.fragments, "voxelizer fragments");
    trimList(keys.records, keys.recordTexels, std::size_t{4} * capacity.voxels, "voxel records");
    now.trim(capacity.voxels, capacity.faces);
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

// For instances that were added; what is there stays.
void SurfaceVoxels::Impl::growTriangles(std::uint32_t count) {
    if (count <= capacity.triangles) return;
    const std::uint32_t room = count + count / 2;
    growList(triangles, triangleTexels, std::size_t{48} * room, "voxelizer triangles");
    capacity.triangles = room;
}

// For an update: what is there stays, where it is still read.
void SurfaceVoxels::Impl::growLists(const Capacity& wanted) {
    if (wanted.fragments > capacity.fragments) {
        growList(pairs, pairTexels, std::size_t{8} * wanted.fragments, "voxelizer pairs");
        growList(fragments, fragmentTexels, kFragmentBytes * wanted.fragments, "voxelizer fragments");
    }
    if (wanted.tiles > capacity.tiles) tiles = gl::Buffer(std::size_t{8} * wanted.tiles, "voxelizer tiles");
    if (wanted.faces > capacity.faces) reserveFaceLists(wanted.faces);
    if (wanted.bricks > capacity.bricks)
        brickList = gl::Buffer(std::size_t{4} * wanted.bricks, "occupied bricks");
    const std::size_t chunkBytes = std::size_t{8} * gpu::mostChunks(wanted.voxels);
    if (chunkBytes > chunks.bytes()) chunks = gl::Buffer(chunkBytes, "voxelizer chunks");
    capacity = wanted;
}

// Slots that updates before have freed stay listed.
void SurfaceVoxels::Impl::growFreeList() {
    growBuffer(freeList, std::size_t{4} * capacity.fragments, "voxelizer free slots");
}

void SurfaceVoxels::Impl::reserveFaceLists(std::uint32_t faces) {
    owners = gl::Buffer(std::size_t{4} * faces, "voxelizer face owners");
    ownerTexels = gl::Texture(owners, GL_R32UI, "voxelizer face owners");
    layered = gl::Buffer(std::size_t{4} * faces, "voxelizer layered faces");
}

void SurfaceVoxels::Impl::upload(const scene::GpuScene& scene, const Edits* edits) {
    gpu::SurfaceConstants c{};
    c.triangleCount = edits != nullptr ? edits->triangles : scene.triangleCount();
    c.instanceCount =
        static_cast<std::uint32_t>(edits != nullptr ? edits->runs.size() : scene.instances().size());
    c.editedBricks = edits != nullptr ? static_cast<std::uint32_t>(edits->editedBricks.size()) : 0;
    c.tileCapacity = capacity.tiles;
    c.fragmentCapacity = capacity.fragments;
    c.voxelCapacity = capacity.voxels;
    c.faceCapacity = capacity.faces;
    c.brickCapacity = capacity.bricks;
    c.bricksPerChunk = gpu::perChunk(static_cast<std::uint32_t>(grid.brickCount()));
    c.voxelsPerChunk = gpu::perChunk(capacity.voxels);
    c.emissionScale = std::max(surfaces.largestEmission, kLeastEmission);
    constants.update(c);
    if (edits != nullptr) {
        gpu::VoxelScroll scroll = scrollOf(edits->from, grid);
        scroll.shifts[0].w = surfaces.emit() ? 0 : 1;
        scrollBlock.update(scroll);
    }
    updateGridBlock();
}

void SurfaceVoxels::Impl::updateGridBlock() {
    gpu::VoxelGrid block = grid.packed();
    block.voxelCount = counts[SURFACE_VOXELS];
    block.faceCount = counts[SURFACE_FACES];
    block.occupiedBricks = counts[SURFACE_BRICKS];
    gridBlock.update(block);
    levelBlock.update(grid.packedLevels());
}

void SurfaceVoxels::Impl::clearWorkSpace() {
    clearBricks(keys, grid.storedBricks());
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
    inputs.uniform("SurfaceBlock", constants)
        .uniform("VoxelGridBlock", gridBlock)
        .uniform("VoxelLevelBlock", levelBlock)
        .uniform("VoxelScrollBlock", scrollBlock);
    storage("CounterTable", counters);
    storage("MaskTable", masks);
    storage("ShiftedMaskTable", shiftedMasks);
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
    storage("FaceMaterialTable", now.faceMaterials);
    storage("FreeTable", freeList);
    storage("ChangedTable", changedBricks);
    storage("EditedTable", editedBricks);
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
    texture("oldMaterials", before.materialTexels);
    if (keys.brickWords) inputs.image("brickWords", keys.brickWords, gl::ImageUse::Write);
    return inputs;
}

}  // namespace conelight::voxels
