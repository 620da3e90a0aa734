// SPDX-License-Identifier: MIT
#include "voxels/surface_voxels.h"

#include <cstddef>
#include <utility>

#include "base/assert.h"
#include "voxels/nested_grid.h"
#include "voxels/surface_work.h"

namespace conelight::voxels {

SurfaceVoxels::SurfaceVoxels() : impl_(std::make_unique<Impl>()) {}
SurfaceVoxels::~SurfaceVoxels() = default;
SurfaceVoxels::SurfaceVoxels(SurfaceVoxels&&) noexcept = default;
SurfaceVoxels& SurfaceVoxels::operator=(SurfaceVoxels&&) noexcept = default;

VoxelGrid SurfaceVoxels::gridOf(const scene::GpuScene& scene, const VoxelSettings& settings) {
    return grownGrid(fitGrid(scene.firstGridBounds(), settings.size, settings.padding, settings.shift),
                     scene.gridBounds());
}

VoxelGrid SurfaceVoxels::gridAround(const scene::GpuScene& scene, const VoxelSettings& settings,
                                    const glm::vec3& eye) {
    return nestedGrid(gridOf(scene, settings), scene.gridBounds(), settings.levels,
                      settings.anchor.around(eye));
}

base::Steps SurfaceVoxels::buildInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                        VoxelGrid grid) {
    Impl& m = *impl_;
    m.know();
    m.unfinished = true;
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
        co_await m.mark(device, scene);
        co_await m.compact(device);
        co_await m.clip(device, scene, false);
        co_await m.resolve(device, false);
        m.counters.read(0, m.counts.data(), sizeof m.counts);
        if (!m.grow()) break;
        CONELIGHT_ASSERT(attempt + 1 < kMaxAttempts,
                         "SurfaceVoxels::build: lists still too small after growing");
    }
    m.updateGridBlock();
    m.keys.grid = m.grid;
    m.keys.revision = base::Revision::next();
    m.remember(scene);
    m.unfinished = false;
    m.tail = m.counts[SURFACE_FRAGMENTS];
    m.freeSlots = 0;
    m.scrolled = false;
    m.lastUpdate = {true, false, scene.triangleCount(), m.tail, m.counts[SURFACE_FACES]};
    if (m.oldKeys.revision) co_return;
    m.releaseLists();
    m.trim();
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
        .uniform("VoxelLevelBlock", m.levelBlock)
        .texture("voxelFaces", m.now.faceTexels)
        .texture("voxelFaceMaterials", m.now.materialTexels)
        .storage("FaceTable", m.now.faces)
        .storage("FaceMaterialTable", m.now.faceMaterials)
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
std::uint32_t SurfaceVoxels::voxelCount() const { return known(SURFACE_VOXELS); }
std::uint32_t SurfaceVoxels::faceCount() const { return known(SURFACE_FACES); }
std::uint32_t SurfaceVoxels::occupiedBrickCount() const { return known(SURFACE_BRICKS); }
std::uint32_t SurfaceVoxels::known(int counter) const {
    impl_->know();
    return impl_->counts[static_cast<std::size_t>(counter)];
}
std::uint32_t SurfaceVoxels::mostVoxels() const {
    return isLate() ? impl_->late.most.voxels : impl_->counts[SURFACE_VOXELS];
}
std::uint32_t SurfaceVoxels::mostFaces() const {
    return isLate() ? impl_->late.most.faces : impl_->counts[SURFACE_FACES];
}
std::uint32_t SurfaceVoxels::mostOccupiedBricks() const {
    return isLate() ? impl_->late.most.bricks : impl_->counts[SURFACE_BRICKS];
}
std::uint32_t SurfaceVoxels::mostFragmentSlots() const {
    return isLate() ? impl_->late.most.slots : impl_->tail;
}
bool SurfaceVoxels::isLate() const { return impl_->late.words.pending(); }
void SurfaceVoxels::putFragmentSlots(gl::Buffer& to, std::size_t offset) const {
    if (isLate())
        to.copyRange(impl_->counters, std::size_t{4} * SURFACE_SLOTS, offset, 4);
    else
        to.update(offset, &impl_->tail, 4);
}
std::uint32_t SurfaceVoxels::fragmentCount() const {
    impl_->know();
    return impl_->tail - impl_->freeSlots;
}
std::uint32_t SurfaceVoxels::fragmentSlots() const {
    impl_->know();
    return impl_->tail;
}
const gl::Texture& SurfaceVoxels::brickWords() const { return impl_->keys.brickWords; }
const gl::Buffer& SurfaceVoxels::records() const { return impl_->keys.records; }
const gl::Buffer& SurfaceVoxels::faces() const { return impl_->now.faces; }
const gl::Buffer& SurfaceVoxels::faceMaterials() const { return impl_->now.faceMaterials; }
const gl::Buffer& SurfaceVoxels::occupiedBricks() const { return impl_->brickList; }
const gl::Buffer& SurfaceVoxels::changedBricks() const { return impl_->changedBricks; }
const SurfaceUpdate& SurfaceVoxels::lastUpdate() const {
    impl_->know();
    return impl_->lastUpdate;
}
bool SurfaceVoxels::hasScrolled() const { return impl_->scrolled; }
const gl::Buffer& SurfaceVoxels::fragments() const { return impl_->fragments; }

std::vector<gl::ProgramDesc> SurfaceVoxels::programDescs() { return surfaceProgramDescs(); }

}  // namespace conelight::voxels
