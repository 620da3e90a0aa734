// SPDX-License-Identifier: MIT
#include "light/lamp_faces.h"

#include <algorithm>

#include "gl/gl.h"
#include "gl/pace.h"

namespace conelight::light {
namespace {

// More leave nothing of note to the means of the cache over them: of 16 rounds a face of builtin:lamps errs by 5 %.
constexpr std::uint32_t kMostRounds = 32;
constexpr int kLampFacesOfPiece = 1024;  // at least

gl::ProgramDesc lampFacesDesc(const LampKey& key) { return {{"light/lamp_faces.comp.glsl"}, key.defines()}; }

}  // namespace

base::Steps LampFaces::beginInSteps(const gl::Device& device, const Inputs& inputs) {
    const std::uint32_t faces = inputs.voxels.surface().mostFaces();
    round_ = next_ = 0;
    if (faces == 0) co_return;
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::LampFaceConstants), "lamp faces constants");
    if (!means_ || means_.bytes() < 16 * std::size_t{faces})
        means_ = gl::Buffer(16 * std::size_t{faces}, "light of lamps on faces");
    co_await draw(device, inputs, 0, faces);
    round_ = 1;
}

base::Steps LampFaces::goOnInSteps(const gl::Device& device, const Inputs& inputs, std::uint32_t count) {
    const voxels::SurfaceVoxels& surface = inputs.voxels.surface();
    // A part of them is one of so many as there are.
    const std::uint32_t faces = count == 0 && next_ == 0 ? surface.mostFaces() : surface.faceCount();
    std::uint32_t left = count == 0 ? faces : std::min(count, faces);
    while (left > 0 && round_ < kMostRounds) {
        const std::uint32_t now = std::min(left, faces - next_);
        co_await draw(device, inputs, next_, now);
        left -= now;
        next_ += now;
        if (next_ < faces) break;
        next_ = 0;
        ++round_;
    }
}

base::Steps LampFaces::draw(const gl::Device& device, const Inputs& inputs, std::uint32_t first,
                            std::uint32_t count) {
    gl::Inputs given;
    given.add(inputs.scene)
        .add(inputs.lights)
        .add(inputs.voxels)
        .add(inputs.faces)
        .uniform("LampFaceBlock", constants_)
        .storage("LampMeanTable", means_);
    inputs.voxels.surface().declareTriangles(given);
    const gl::ProgramDesc desc = lampFacesDesc(inputs.lights.lampKey());
    for (gl::Pieces faces(device, static_cast<int>(count), kLampFacesOfPiece); faces.next();) {
        {
            const gl::PassScope scope(device.profiler, "light of lamps");
            const auto now = static_cast<std::uint32_t>(faces.count());
            constants_.update(gpu::LampFaceConstants{first + static_cast<std::uint32_t>(faces.first()), now,
                                                     round_, round_ == 0 ? 1u : 0u});
            device.get(desc).dispatchLinear(given, now);
        }
        co_await gl::rest(device);
    }
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
}

std::vector<gl::ProgramDesc> LampFaces::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const LampKey& key : LampKey::all()) descs.push_back(lampFacesDesc(key));
    return descs;
}

}  // namespace conelight::light
