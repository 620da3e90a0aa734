// SPDX-License-Identifier: MIT
// GpuScene: meshes, materials and instances that come and go. Tables grow by half, so that GL objects are made anew
// seldom; entries that were removed are used again. Triangles are numbered by instance: whoever keeps numbers
// (voxels) may keep them, unless identity() changes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scene/gpu_scene.h"
#include "scene/gpu_vertices.h"
#include "scene/packed_mesh.h"

namespace conelight::scene {
namespace {

// Makes room for so many bytes; what is there stays. True when the buffer is another one.
bool reserve(gl::Buffer& buffer, std::size_t bytes, const char* label) {
    if (bytes <= buffer.bytes()) return false;
    gl::Buffer larger(bytes + bytes / 2, label);
    larger.copyFrom(buffer, buffer.bytes());
    buffer = std::move(larger);
    return true;
}

// Puts `bytes` of data at `offset`. True when the buffer is another one.
bool put(gl::Buffer& buffer, std::size_t offset, const void* data, std::size_t bytes, const char* label) {
    const bool grows = reserve(buffer, offset + bytes, label);
    buffer.update(offset, data, bytes);
    return grows;
}

// Entries that were removed are given to instances with other numbers of triangles once they are more than this
// part of all: all numbers change then.
constexpr std::size_t kMostRemoved = 2;
constexpr std::size_t kFewRemoved = 64;

}  // namespace

// ---- Meshes ---------------------------------------------------------------------------------------------

// The least of the free places that are large enough, or one behind all others.
std::size_t GpuScene::placeForMesh(std::uint32_t vertices, std::uint32_t indices) {
    std::size_t index = meshRanges_.size();
    for (std::size_t i = 0; i < meshRanges_.size(); ++i) {
        const MeshRange& range = meshRanges_[i];
        if (!range.removed || range.vertexRoom < vertices || range.indexRoom < indices) continue;
        if (index == meshRanges_.size() || range.indexRoom < meshRanges_[index].indexRoom) index = i;
    }
    if (index == meshRanges_.size()) {
        meshRanges_.push_back(
            {vertexCount_, indexCount_, indices, {}, false, partBounds_.size(), vertices, indices});
        partBounds_.resize(partBounds_.size() + (indices + kPartIndices - 1) / kPartIndices);
        source_.meshes.emplace_back();
        vertexCount_ += vertices;
        indexCount_ += indices;
        const bool others = reserve(vertexBuffer_, vertexCount_ * sizeof(gpu::Vertex), "scene vertices");
        if (reserve(indexBuffer_, indexCount_ * sizeof(std::uint32_t), "scene indices") || others)
            makeVertexArray();
    }
    MeshRange& range = meshRanges_[index];
    range.vertexCount = vertices;
    range.indexCount = indices;
    range.removed = range.ofHost = false;
    return index;
}

std::size_t GpuScene::addMesh(const Mesh& mesh) {
    const PackedMesh own = packed(mesh);
    const std::size_t index = placeForMesh(static_cast<std::uint32_t>(own.vertices.size()),
                                           static_cast<std::uint32_t>(own.indices.size()));
    MeshRange& range = meshRanges_[index];
    vertexBuffer_.update(range.firstVertex * sizeof(gpu::Vertex), own.vertices.data(),
                         own.vertices.size() * sizeof(gpu::Vertex));
    indexBuffer_.update(range.firstIndex * sizeof(std::uint32_t), own.indices.data(),
                        own.indices.size() * sizeof(std::uint32_t));
    std::copy(own.parts.begin(), own.parts.end(),
              partBounds_.begin() + static_cast<std::ptrdiff_t>(range.firstPart));
    range.bounds = mesh.bounds();
    range.wideColors = hasWideColors(mesh);
    hasVertexColors_ = hasVertexColors_ || !mesh.colors.empty();
    source_.meshes[index] = mesh;
    return index;
}

std::size_t GpuScene::addMesh(const gl::Device& device, const HostMesh& mesh) {
    const std::size_t index = placeForMesh(packedVertices(mesh), mesh.indexCount);
    meshRanges_[index].ofHost = true;
    convert(device, index, mesh);
    return index;
}

// Where its surface was before it changes, for means over frames that follow it: in the order that its vertices take, of
// which positions alone count. Returns the offset.
std::size_t GpuScene::placeForVerticesBefore(std::size_t index) {
    MeshRange& range = meshRanges_[index];
    if (!range.firstBefore) {
        range.firstBefore = beforeCount_;
        beforeCount_ += range.vertexRoom;
        reserve(verticesBefore_, beforeCount_ * sizeof(gpu::Vertex), "scene vertices before");
    }
    return *range.firstBefore * sizeof(gpu::Vertex);
}

void GpuScene::setMesh(const gl::Device& device, std::size_t index, const HostMesh& mesh) {
    MeshRange& range = meshRanges_[index];
    range.bentBy = std::numeric_limits<float>::infinity();  // nobody looks
    const std::size_t place = placeForVerticesBefore(index);
    verticesBefore_.copyRange(vertexBuffer_, range.firstVertex * sizeof(gpu::Vertex), place,
                              range.vertexCount * sizeof(gpu::Vertex));
    convert(device, index, mesh);
    reshape(index);
}

void GpuScene::convert(const gl::Device& device, std::size_t index, const HostMesh& mesh) {
    MeshRange& range = meshRanges_[index];
    hostMeshes_.convert(device, mesh, {vertexBuffer_, indexBuffer_, range.firstVertex, range.firstIndex});
    range.bounds = mesh.bounds;
    range.wideColors = false;
    hasVertexColors_ = hasVertexColors_ || mesh.colors.buffer != 0;
    std::fill_n(partBounds_.begin() + static_cast<std::ptrdiff_t>(range.firstPart),
                (mesh.indexCount + kPartIndices - 1) / kPartIndices, mesh.bounds);
    source_.meshes[index] = {};
    source_.meshes[index].name = mesh.name;
}

void GpuScene::removeMesh(std::size_t index) {
    meshRanges_[index].removed = true;
    source_.meshes[index] = {};
}

// ---- Textures and materials -----------------------------------------------------------------------------

// No material has it yet: nothing that is derived changes.
std::size_t GpuScene::addTexture(const Texture& texture) {
    textures_.add(texture);
    source_.textures.push_back(texture);
    return source_.textures.size() - 1;
}

std::size_t GpuScene::addTexture(const gl::Device& device, const HostTexture& texture) {
    textures_.add(device, texture);
    source_.textures.push_back(whiteTexel(texture.name));
    return source_.textures.size() - 1;
}

// Before the default one, which is the last.
std::size_t GpuScene::addMaterial(const Material& material) {
    const std::size_t index = source_.materials.size();
    source_.materials.push_back(material);
    materials_.insert(materials_.begin() + static_cast<std::ptrdiff_t>(index),
                      packedMaterial(material, source_.textures));
    materialTextures_.insert(materialTextures_.begin() + static_cast<std::ptrdiff_t>(index),
                             texturesOf(material));
    put(materialBuffer_, index * sizeof(gpu::Material), &materials_[index], 2 * sizeof(gpu::Material),
        "scene materials");
    updateNormalMaps();
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (instances_[i].material != index) continue;
        ++instances_[i].material;
        uploadInstance(i);
    }
    return index;
}

// ---- Instances ------------------------------------------------------------------------------------------

// One with as many triangles keeps the numbers of all others.
std::optional<std::size_t> GpuScene::freeEntry(std::uint32_t triangles) const {
    std::size_t removed = 0, first = removed_.size();
    for (std::size_t i = 0; i < removed_.size(); ++i) {
        if (removed_[i] == 0) continue;
        if (instances_[i].indexCount / 3 == triangles) return i;
        if (removed++ == 0) first = i;
    }
    if (removed > kFewRemoved && removed * kMostRemoved > removed_.size()) return first;
    return std::nullopt;
}

std::size_t GpuScene::addInstance(const Instance& instance) {
    const MeshRange& range = meshRanges_[static_cast<std::size_t>(instance.mesh)];
    const std::uint32_t triangles = range.indexCount / 3;
    const std::optional<std::size_t> free = freeEntry(triangles);
    const std::size_t index = free.value_or(instances_.size());
    if (!free) {
        instances_.emplace_back();
        instances_.back().firstTriangle = triangleCount_;
        triangleCount_ += triangles;
        source_.instances.emplace_back();
        for (auto* boxes : {&instanceObjectBounds_, &instanceBounds_}) boxes->emplace_back();
        for (auto* revisions :
             {&instanceRevisions_, &casterRevisions_, &shapeRevisions_, &shapesBefore_, &entryRevisions_})
            revisions->emplace_back();
        instanceParts_.push_back(0);
        removed_.push_back(0);
        bakedPlaces_.emplace_back();
        const auto number = static_cast<std::uint32_t>(index);
        if (put(instanceIndexBuffer_, index * sizeof number, &number, sizeof number,
                "scene instance indices"))
            makeVertexArray();
    }
    const bool renumbers = free && instances_[index].indexCount / 3 != triangles;
    putInstance(index, instance);
    if (renumbers) renumberTriangles();
    return index;
}

void GpuScene::putInstance(std::size_t index, const Instance& instance) {
    const MeshRange& range = meshRanges_[static_cast<std::size_t>(instance.mesh)];
    gpu::Instance& g = instances_[index];
    g.firstIndex = range.firstIndex;
    g.indexCount = range.indexCount;
    g.firstVertex = range.firstVertex;
    g.material = instance.material >= 0 ? static_cast<std::uint32_t>(instance.material)
                                        : static_cast<std::uint32_t>(materials_.size() - 1);
    g.flags = range.wideColors ? INSTANCE_WIDE_COLORS : 0u;
    source_.instances[index] = instance;
    removed_[index] = 0;
    shapesBefore_[index] = {};
    bakedPlaces_[index].reset();
    instanceParts_[index] = range.firstPart;
    instanceObjectBounds_[index] = range.bounds;
    setFlags(index, instance);
    place(index, instance.worldFromObject);
    put(instanceBuffer_, index * sizeof g, &g, sizeof g, "scene instances");
    const auto number = static_cast<std::uint32_t>(index);
    std::erase(drawOrder_, number);
    drawOrder_.insert(std::lower_bound(drawOrder_.begin(), drawOrder_.end(), number,
                                       [&](std::uint32_t a, std::uint32_t b) { return isDrawnBefore(a, b); }),
                      number);
    geometryRevision_ = instanceRevisions_[index] = casterRevisions_[index] = shapeRevisions_[index] =
        entryRevisions_[index] = base::Revision::next();
}

void GpuScene::removeInstance(std::size_t index) {
    Instance gone = source_.instances[index];
    gone.name.clear();
    gone.visible = false;
    setInstance(index, gone);
    removed_[index] = 1;
}

// Anew, in the order of instances. What was derived from the old numbers is of another scene.
void GpuScene::renumberTriangles() {
    triangleCount_ = 0;
    for (gpu::Instance& g : instances_) {
        g.firstTriangle = triangleCount_;
        triangleCount_ += g.indexCount / 3;
    }
    instanceBuffer_.update(0, instances_.data(), instances_.size() * sizeof(gpu::Instance));
    identity_ = base::Revision::next();
}

// ---- Where voxels are -----------------------------------------------------------------------------------

void GpuScene::setRegion(const Aabb& region) {
    region_ = region;
    geometryRevision_ = base::Revision::next();
}

// Of visible instances that are meant for voxels; of all where there is none. Glass counts: what it shows is lit.
Aabb GpuScene::boundsForGrid() const {
    Aabb box;
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if ((instances_[i].flags & INSTANCE_VISIBLE) != 0 && source_.instances[i].voxelized)
            box.grow(instanceBounds_[i]);
    return box.empty() ? bounds() : box;
}

const Aabb& GpuScene::firstBounds() const {
    if (firstBounds_.empty()) firstBounds_ = bounds();
    return firstBounds_;
}

Aabb GpuScene::firstGridBounds() const {
    if (!region_.empty()) return region_;
    if (firstGridBounds_.empty()) firstGridBounds_ = boundsForGrid();
    return firstGridBounds_;
}

Aabb GpuScene::gridBounds() const { return region_.empty() ? boundsForGrid() : region_; }

}  // namespace conelight::scene
