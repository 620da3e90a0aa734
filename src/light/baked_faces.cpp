// SPDX-License-Identifier: MIT
#include "light/baked_faces.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "gl/gl.h"
#include "light/baked_lookup.h"
#include "math/octahedral.h"
#include "shared/baked_light.h"
#include "voxels/voxel_record.h"

namespace conelight::light {
namespace {

constexpr float kLargest = 65000.0f;  // below the largest half

gl::ProgramDesc lightDesc() { return {{"light/baked_faces.comp.glsl"}, {}}; }
gl::ProgramDesc correctDesc() { return {{"light/baked_corrections.comp.glsl"}, {}}; }

// The middle of a face's bounds, moved onto its plane, in grid coordinates.
glm::vec3 middleOf(const gpu::FaceRecord& face, const glm::vec3& normal) {
    glm::vec3 low, high;
    voxels::unpackBounds(face.bounds, low, high);
    const glm::vec3 middle = 0.5f * (low + high) - 0.5f;
    const float away = voxels::unpackOffset(face.offsetWeight) - glm::dot(normal, middle);
    return glm::vec3(voxels::unpackVoxel(face.voxel)) + 0.5f + middle + away * normal;
}

glm::uvec2 packed(const glm::vec3& irradiance) {
    const glm::vec3 part = glm::min(irradiance * std::numbers::inv_pi_v<float>, glm::vec3(kLargest));
    return {glm::packHalf2x16({part.r, part.g}), glm::packHalf2x16({part.b, 0}) | BAKED_FACE};
}

}  // namespace

void BakedFaces::update(const BakedLight& baked, const voxels::SurfaceVoxels& statics) {
    statics_ = &statics;
    const BakedLookup lookup(baked, statics.grid());
    std::vector<glm::uvec2> found;
    found.reserve(statics.faceCount());
    for (const gpu::FaceRecord& face : statics.faces().read<gpu::FaceRecord>(statics.faceCount())) {
        const glm::vec3 normal = math::octDecode(math::unpackSnorm2x16(face.normal));
        const std::optional<glm::vec3> irradiance = lookup.irradiance(middleOf(face, normal), normal);
        found.push_back(irradiance ? packed(*irradiance) : glm::uvec2(0));
    }
    irradiance_ = gl::Buffer(found, "baked faces");
    corrections_ = gl::Buffer(found.size() * sizeof(glm::uvec2), "baked corrections");
    revision_ = base::Revision::next();
}

void BakedFaces::correct(const gl::Device& device, const LitFaces& gathered) {
    const gl::PassScope pass(device.profiler, "baked corrections");
    gl::Inputs given;
    given.add(*statics_)
        .add(gathered)
        .storage("BakedFaceTable", irradiance_)
        .storage("BakedCorrectionTable", corrections_);
    device.get(correctDesc()).dispatchLinear(given, statics_->faceCount());
    gl::barrier(gl::Access::ShaderStorage);
    correctionRevision_ = base::Revision::next();
}

void BakedFaces::light(const gl::Device& device, const voxels::SurfaceVoxels& surface, const LitFaces& faces,
                       gl::Buffer& corrections) const {
    const gl::PassScope pass(device.profiler, "baked faces");
    const std::size_t bytes = sizeof(glm::uvec2) * surface.mostFaces();
    if (!corrections || corrections.bytes() < bytes)
        corrections = gl::Buffer(bytes + bytes / 4, "face corrections");
    gl::Inputs given;
    given.add(surface).add(faces);
    statics_->keys().declareOld(given);
    given.storage("BakedFaceTable", irradiance_)
        .storage("BakedCorrectionTable", corrections_)
        .storage("FaceCorrectionTable", corrections);
    device.get(lightDesc()).dispatchLinear(given, surface.mostFaces());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> BakedFaces::programDescs() { return {lightDesc(), correctDesc()}; }

}  // namespace conelight::light
