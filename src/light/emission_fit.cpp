// SPDX-License-Identifier: MIT
#include "light/emission_fit.h"

#include <array>

#include "gl/gl.h"
#include "gl/pass.h"

namespace conelight::light {
namespace {

struct FitKey {
    int step;
    gl::ProgramDesc desc() const {
        return {{"light/emission_fit.comp.glsl"}, {{"STEP", std::to_string(step)}}};
    }
    static std::vector<FitKey> all() { return {{0}, {1}, {2}, {3}}; }
};

}  // namespace

void EmissionFit::update(const gl::Device& device, const scene::GpuScene& scene,
                         const voxels::Voxels& voxels) {
    if (voxelsFrom_ == voxels.revision()) return;
    const gl::PassScope pass(device.profiler, "emission that fits");
    const voxels::SurfaceVoxels& surface = voxels.surface();
    const std::uint32_t faces = surface.faceCount(), slots = surface.fragmentSlots();
    gl::reserveTexels(parts_, texels_, GL_R32UI, std::size_t{4} * faces, "emission that fits");
    // Sums of the passes below: the count of slots, then two numbers per face.
    gl::Buffer sent(std::size_t{8} * (faces + 1), "light that lamps send");
    sent.clear();
    sent.update(std::array<std::uint32_t, 2>{slots, 0});
    gl::Inputs inputs;
    inputs.add(scene).add(voxels).storage("EmissionFit", parts_).storage("SentLight", sent);
    surface.declareTriangles(inputs);
    const glm::ivec3 size = surface.grid().bricks();
    const auto bricks = static_cast<std::size_t>(size.x * size.y * size.z);
    const std::array<std::size_t, 4> invocations{bricks, faces, slots, bricks};
    for (const FitKey& key : FitKey::all()) {
        device.get(key.desc()).dispatchLinear(inputs, invocations[static_cast<std::size_t>(key.step)]);
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
