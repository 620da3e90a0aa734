// SPDX-License-Identifier: MIT
#include "light/emission_fit.h"

#include <algorithm>
#include <array>

#include "gl/gl.h"
#include "gl/pace.h"

namespace conelight::light {
namespace {

constexpr std::uint32_t kRowGroups = 64;  // as in the shader
constexpr std::size_t kSlotsAt = 16;      // bytes before fragmentSlots of SentLight
constexpr int kWalkStep = 3;              // per fragment of a list that the step before makes

struct FitKey {
    int step;
    gl::ProgramDesc desc() const {
        return {{"light/emission_fit.comp.glsl"}, {{"STEP", std::to_string(step)}}};
    }
    static std::vector<FitKey> all() { return {{0}, {1}, {2}, {3}, {4}}; }
};

}  // namespace

base::Steps EmissionFit::updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                       const voxels::Voxels& voxels) {
    if (voxelsFrom_ == voxels.revision()) co_return;
    voxelsFrom_ = {};
    gl::PassSteps pass(device, "emission that fits");
    const voxels::SurfaceVoxels& surface = voxels.surface();
    const std::uint32_t faces = surface.mostFaces(), slots = surface.mostFragmentSlots();
    gl::reserveTexels(parts_, texels_, GL_R32UI, std::size_t{4} * faces, "emission that fits");
    // Of the passes below: the header of SentLight, then two numbers per face; fragments that shine.
    const std::array<std::uint32_t, 6> header{kRowGroups, 0, 1, 0, 0, 0};
    gl::Buffer sent(sizeof header + std::size_t{8} * faces, "light that lamps send");
    sent.clear();
    sent.update(header);
    surface.putFragmentSlots(sent, kSlotsAt);
    const gl::Buffer shining(std::size_t{4} * std::max(slots, 1u), "fragments that shine");
    gl::Inputs inputs;
    inputs.add(scene)
        .add(voxels)
        .storage("EmissionFit", parts_)
        .storage("SentLight", sent)
        .storage("ShiningFragments", shining);
    surface.declareTriangles(inputs);
    const std::size_t bricks = surface.grid().brickCount();
    const std::array<std::size_t, 5> invocations{bricks, faces, slots, 0, bricks};
    for (const FitKey& key : FitKey::all()) {
        const gl::Program& program = device.get(key.desc());
        if (key.step == kWalkStep)
            program.dispatchIndirect(inputs, sent);
        else
            program.dispatchLinear(inputs, invocations[static_cast<std::size_t>(key.step)]);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Indirect);
        co_await pass.rest();
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
