// SPDX-License-Identifier: MIT
#include "light/light_samples.h"

#include <string>
#include <utility>

#include "gl/gl.h"
#include "gl/pace.h"
#include "shared/irradiance.h"

namespace conelight::light {
namespace {

constexpr std::size_t kWord = 4, kPlace = 32;

gl::ProgramDesc drawPass(const char* name) {
    return {{std::string("light/light_") + name + ".comp.glsl"}, {}};
}

}  // namespace

void LightSamples::reserve(const voxels::VoxelGrid& grid, std::uint32_t faces) {
    const auto make = [](gl::Buffer& buffer, gl::Texture& texels, GLenum format, std::size_t bytes,
                         const char* label) {
        if (buffer) return;
        buffer = gl::Buffer(bytes, label);
        texels = gl::Texture(buffer, format, label);
        buffer.clear();
    };
    make(samples_, sampleTexels_, GL_R32UI, kWord * LIGHT_SAMPLE_WORDS, "light samples");
    make(clusterList_, clusterListTexels_, GL_R32UI, kWord * (1 + LIGHT_CLUSTERS), "list of clusters");
    make(clusterPlaces_, clusterPlaceTexels_, GL_RGBA32F, kPlace * LIGHT_CLUSTERS, "places of clusters");
    make(rowList_, rowListTexels_, GL_R32UI, kWord * (1 + LIGHT_ROWS), "list of rows");
    make(marks_, markTexels_, GL_R32UI, kWord * LIGHT_MARK_WORDS, "marks of rows");
    const glm::ivec3 bricks = grid.storedBricks();
    const int blocks = grid.levels > 1 ? LIGHT_BLOCKS_OF_LEVEL : LIGHT_BLOCKS_OF_GRID;
    runCount_ = static_cast<std::size_t>(blocks) * static_cast<std::size_t>(bricks.y) *
                static_cast<std::size_t>(bricks.z);
    gl::reserveTexels(runs_, runTexels_, GL_R32F, 6 * kWord * runCount_, "flux of runs of bricks");
    gl::reserveTexels(fluxes_, fluxTexels_, GL_R32F, kWord * std::size_t{faces}, "flux of faces");
}

void LightSamples::release() {
    for (gl::Texture* texels : {&fluxTexels_, &runTexels_, &clusterListTexels_, &clusterPlaceTexels_,
                                &rowListTexels_, &markTexels_})
        *texels = {};
    for (gl::Buffer* buffer : {&fluxes_, &runs_, &clusterList_, &clusterPlaces_, &rowList_, &marks_})
        *buffer = {};
}

void LightSamples::declareWritten(gl::Inputs& inputs) {
    marks_.clear();
    inputs.storage("FluxTable", fluxes_).storage("CellMarkTable", marks_);
}

base::Steps LightSamples::drawInSteps(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                                      const gl::Buffer& constants) {
    gl::PassSteps scope(device, "irradiance: light samples");
    gl::Inputs given;
    given.add(surface)
        .uniform("CacheBlock", constants)
        .texture("faceFluxes", fluxTexels_)
        .texture("cellMarks", markTexels_)
        .storage("RunTable", runs_)
        .texture("runFluxes", runTexels_)
        .storage("ClusterList", clusterList_)
        .texture("clusterList", clusterListTexels_)
        .storage("ClusterPlaces", clusterPlaces_)
        .texture("clusterPlaces", clusterPlaceTexels_)
        .storage("RowList", rowList_)
        .texture("rowList", rowListTexels_)
        .storage("LightTable", samples_)
        .texture("lightSamples", sampleTexels_);
    const std::pair<const char*, std::size_t> passes[] = {{"bricks", runCount_},
                                                          {"clusters", 1},
                                                          {"rows", LIGHT_ROWS},
                                                          {"pool_layout", 1},
                                                          {"pools", std::size_t{LIGHT_POOL_ENTRIES}}};
    for (const auto& [name, invocations] : passes) {
        device.get(drawPass(name)).dispatchLinear(given, invocations);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
        co_await scope.rest();
    }
}

void LightSamples::declare(gl::Inputs& inputs) const { inputs.texture("lightSamples", sampleTexels_); }

std::vector<gl::ProgramDesc> LightSamples::programDescs() {
    return {drawPass("bricks"), drawPass("clusters"), drawPass("rows"), drawPass("pool_layout"),
            drawPass("pools")};
}

}  // namespace conelight::light
