// SPDX-License-Identifier: MIT
#include "gather/cone_gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gather/cone_set.h"
#include "gl/gl.h"
#include "shared/bindings.h"
#include "shared/cones.h"

namespace conelight::gather {
namespace {

static_assert(kMaxCones == MAX_CONES);

gl::Defines volumeDefines(int blocks, OpacityModel opacity) {
    return {{"DIRECTIONAL", blocks == 6 ? "1" : "0"}, {"AREA", opacity == OpacityModel::Area ? "1" : "0"}};
}

gl::ProgramDesc diffuseDesc(int blocks, OpacityModel opacity, bool occlusion, bool count) {
    gl::Defines defines = volumeDefines(blocks, opacity);
    defines.emplace_back("OCCLUSION", occlusion ? "1" : "0");
    defines.emplace_back("COUNT_LOOKUPS", count ? "1" : "0");
    return {{"gather/cone_diffuse.comp.glsl"}, defines};
}

gl::ProgramDesc specularDesc(int blocks, OpacityModel opacity, bool count) {
    gl::Defines defines = volumeDefines(blocks, opacity);
    defines.emplace_back("COUNT_LOOKUPS", count ? "1" : "0");
    return {{"gather/cone_specular.comp.glsl"}, defines};
}

gl::ProgramDesc bounceDesc(int blocks, OpacityModel opacity) {
    return {{"gather/cone_bounce.comp.glsl"}, volumeDefines(blocks, opacity)};
}

}  // namespace

ConeGather::ConeGather() : block_(sizeof(gpu::ConeConstants), "cone constants") {}

void ConeGather::configure(const ConesSettings& settings, const voxels::RadianceLayout& layout) {
    opacity_ = settings.opacity;
    const float h = layout.grid.voxelSize;
    const glm::vec3 extent = glm::vec3(layout.grid.size) * h;
    const float longest = std::max({extent.x, extent.y, extent.z});

    gpu::ConeConstants constants{};
    constants.step = settings.step;
    constants.offset = settings.offset * h;
    // Twice the volume's diagonal is beyond its far side from wherever a surface is.
    constants.maxDistance = settings.maxDistance.resolve(2 * glm::length(glm::vec3(layout.size) * h));
    constants.specularMinTan = std::tan(0.5f * settings.specularMinAperture);
    constants.occlusionDistance = settings.occlusionDistance.resolve(0.1f * longest);

    const std::vector<Cone> cones = coneSet(settings.diffuseSet, settings.count);
    constants.count = static_cast<std::uint32_t>(cones.size());
    for (std::size_t i = 0; i < cones.size(); ++i) {
        constants.cone[i] = glm::vec4(cones[i].direction, cones[i].weight / std::numbers::pi_v<float>);
        constants.aperture[i] = glm::vec4(cones[i].tanHalfAngle(), 0, 0, 0);
    }
    block_.update(constants);
}

void ConeGather::bind(const voxels::RadianceVolume& volume) const {
    volume.bind();
    block_.bindUniform(BINDING_CONES);
}

void ConeGather::run(gl::ProgramLibrary& programs, const gl::ProgramDesc& desc,
                     const voxels::RadianceVolume& volume, const gl::Texture& result,
                     const gl::Buffer* counters) const {
    bind(volume);
    if (counters != nullptr) counters->bindStorage(BINDING_STORAGE_PASS);
    result.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(desc).dispatch(result.width(), result.height());
}

void ConeGather::gatherDiffuse(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                               const voxels::RadianceVolume& volume, const gl::Texture& result,
                               const gl::Buffer* counters) const {
    const gl::PassScope pass(profiler, "diffuse cones");
    run(programs, diffuseDesc(volume.layout().blocks, opacity_, false, counters != nullptr), volume, result,
        counters);
}

void ConeGather::gatherOcclusion(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                                 const voxels::RadianceVolume& volume, const gl::Texture& result,
                                 const gl::Buffer* counters) const {
    const gl::PassScope pass(profiler, "occlusion cones");
    run(programs, diffuseDesc(volume.layout().blocks, opacity_, true, counters != nullptr), volume, result,
        counters);
}

void ConeGather::gatherSpecular(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                                const voxels::RadianceVolume& volume, const gl::Texture& result,
                                const gl::Buffer* counters) const {
    const gl::PassScope pass(profiler, "specular cones");
    run(programs, specularDesc(volume.layout().blocks, opacity_, counters != nullptr), volume, result,
        counters);
}

void ConeGather::record(gl::ProgramLibrary& programs, const voxels::RadianceVolume& volume,
                        const gl::Texture& result, Recorded what, StepRecorder& recorder) const {
    const int blocks = volume.layout().blocks;
    bind(volume);
    result.bindImage(0, 0, GL_WRITE_ONLY);
    recorder.record(programs, what == Recorded::Specular
                                  ? specularDesc(blocks, opacity_, false)
                                  : diffuseDesc(blocks, opacity_, what == Recorded::Occlusion, false));
}

void ConeGather::gatherBounce(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                              const voxels::RadianceVolume& volume,
                              const voxels::SurfaceVoxels& surface) const {
    const gl::PassScope pass(profiler, "bounce cones");
    bind(volume);
    surface.bind();
    programs.get(bounceDesc(volume.layout().blocks, opacity_)).dispatchLinear(surface.faceCount());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> ConeGather::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const int blocks : {1, 6}) {
        for (const OpacityModel opacity : {OpacityModel::Fog, OpacityModel::Area}) {
            for (const bool count : {false, true}) {
                descs.push_back(diffuseDesc(blocks, opacity, false, count));
                descs.push_back(diffuseDesc(blocks, opacity, true, count));
                descs.push_back(specularDesc(blocks, opacity, count));
            }
            descs.push_back(bounceDesc(blocks, opacity));
            for (const bool occlusion : {false, true})
                descs.push_back(StepRecorder::variant(diffuseDesc(blocks, opacity, occlusion, false)));
            descs.push_back(StepRecorder::variant(specularDesc(blocks, opacity, false)));
        }
    }
    return descs;
}

}  // namespace conelight::gather
