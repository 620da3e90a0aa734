// SPDX-License-Identifier: MIT
#include "gl/gl.h"
#include "voxels/surface_work.h"

namespace conelight::voxels {

// Triangles -> pairs (triangle, voxel), and a bit per voxel.
void SurfaceVoxels::Impl::mark(const gl::Device& device, const scene::GpuScene& scene) {
    const gl::PassScope scope(device.profiler, "voxelize: mark");
    clearWorkSpace();
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Setup, false}.desc())
        .dispatchLinear(given, static_cast<std::size_t>(grid.levels) * scene.triangleCount());
    gl::barrier(gl::Access::ShaderStorage);
    device.get(SurfaceScanKey{SurfaceCounted::Tiles}.desc()).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::TextureFetch);
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Tiles, false}.desc())
        .dispatchIndirect(given, counters, 4 * SURFACE_ARGS_TILES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Bits -> brickWord and the list of occupied bricks.
void SurfaceVoxels::Impl::compact(const gl::Device& device) {
    const gl::PassScope scope(device.profiler, "voxelize: compact");
    gl::Inputs given = this->given();
    const auto bricks = static_cast<std::uint32_t>(grid.brickCount());
    const std::uint32_t chunkCount = gpu::chunksOf(bricks);
    device.get(SurfaceCountKey{true}.desc()).dispatchLinear(given, chunkCount);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(SurfaceScanKey{SurfaceCounted::Bricks}.desc()).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    device.get(descOf(SurfacePass::Bricks)).dispatchLinear(given, chunkCount);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Pairs -> clipped fragments in the chains of their voxels.
void SurfaceVoxels::Impl::clip(const gl::Device& device, const scene::GpuScene& scene, bool update) {
    const gl::PassScope scope(device.profiler, "voxelize: clip");
    gl::Inputs given = this->given();
    given.add(scene);
    device.get(SurfaceClipKey{surfaces.detail, surfaces.key(), update}.desc())
        .dispatchIndirect(given, counters, 4 * SURFACE_ARGS_FRAGMENTS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

// Directions -> faces, chains -> what they show.
void SurfaceVoxels::Impl::resolve(const gl::Device& device, bool update) {
    const gl::PassScope scope(device.profiler, "voxelize: resolve");
    gl::Inputs given = this->given();
    device.get(SurfaceCountKey{false}.desc()).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_VOXELS);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(SurfaceScanKey{SurfaceCounted::Faces}.desc()).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    device.get(SurfaceMarkKey{SurfaceMarkKey::Pass::Faces, update}.desc())
        .dispatchIndirect(given, counters, 4 * SURFACE_ARGS_VOXELS);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    if (update) {
        device.get(SurfaceScanKey{SurfaceCounted::Work}.desc()).dispatch(given, 1);
        device.get(descOf(SurfacePass::Copy)).dispatchIndirect(given, counters, 4 * SURFACE_ARGS_FACES);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    }
    device.get(SurfaceResolveKey{surfaces.key(), update}.desc())
        .dispatchIndirect(given, counters, 4 * (update ? SURFACE_ARGS_WORK : SURFACE_ARGS_FACES));
    gl::barrier(gl::Access::ShaderStorage);
    device.get(SurfaceScanKey{SurfaceCounted::Layers}.desc()).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
    for (const bool onlyWide : {false, true})
        device.get(SurfaceLayersKey{surfaces.key(), onlyWide}.desc())
            .dispatchIndirect(given, counters, 4 * (onlyWide ? SURFACE_ARGS_WIDE : SURFACE_ARGS_LAYERS));
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Indirect);
}

}  // namespace conelight::voxels
