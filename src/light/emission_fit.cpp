// SPDX-License-Identifier: MIT
#include "light/emission_fit.h"

#include "gl/gl.h"

namespace conelight::light {
namespace {

struct FitKey {
    int step;
    gl::ProgramDesc desc() const {
        return {{"light/emission_fit.comp.glsl"}, {{"STEP", std::to_string(step)}}};
    }
    static std::vector<FitKey> all() { return {{0}, {1}, {2}}; }
};

}  // namespace

void EmissionFit::update(const gl::Device& device, const voxels::Voxels& voxels) {
    if (voxelsFrom_ == voxels.revision()) return;
    const voxels::SurfaceVoxels& surface = voxels.surface();
    gl::reserveTexels(parts_, texels_, GL_R32UI, std::size_t{4} * surface.faceCount(), "emission that fits");
    gl::Inputs inputs;
    inputs.add(voxels).storage("EmissionFit", parts_);
    const glm::ivec3 size = surface.grid().bricks();
    const auto bricks = static_cast<std::size_t>(size.x * size.y * size.z);
    for (const FitKey& key : FitKey::all()) {
        device.get(key.desc()).dispatchLinear(inputs, key.step == 1 ? surface.faceCount() : bricks);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
    }
    voxelsFrom_ = voxels.revision();
}

void EmissionFit::declare(gl::Inputs& inputs) const {
    if (texels_) inputs.texture("emissionParts", texels_);
}

std::vector<gl::ProgramDesc> EmissionFit::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const FitKey& key : FitKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::light
