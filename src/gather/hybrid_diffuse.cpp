// SPDX-License-Identifier: MIT
#include "gather/hybrid_diffuse.h"

#include "gl/gl.h"
#include "gl/pace.h"
#include "gl/picture_pass.h"

namespace conelight::gather {
namespace {

gl::ProgramDesc desc(bool moves) {
    return {{"gather/hybrid_diffuse.comp.glsl"}, {{"MOVES", moves ? "1" : "0"}}};
}

void resize(gl::Texture& picture, const view::Surfaces& surfaces, const char* label) {
    if (picture && picture.width() == surfaces.width() && picture.height() == surfaces.height()) return;
    picture = {};
    picture = gl::Texture({GL_TEXTURE_2D, GL_RGBA16F, surfaces.width(), surfaces.height()}, label);
}

}  // namespace

base::Steps HybridDiffuse::drawInSteps(const gl::Device& device, const Inputs& inputs,
                                       const gl::Buffer* counters) {
    const view::Surfaces& surfaces = inputs.pixels.surfaces;
    baked_.draw(device, inputs.pixels.scene, surfaces);
    co_await gl::rest(device);
    resize(result_, surfaces, "hybrid diffuse");
    gl::Inputs given;
    given.add(inputs.pixels)
        .texture("bakedIrradiance", baked_.irradiance())
        .image("result", result_, gl::ImageUse::Write);
    if (inputs.all != nullptr) {
        resize(all_, surfaces, "gathered of all");
        resize(static_, surfaces, "gathered of statics");
        const ConeGather& cones = inputs.all->cones();
        const ConeInputs ofAll{inputs.pixels, inputs.all->volume()};
        co_await cones.gatherInSteps(device, ofAll, ConeGather::Part::Diffuse, all_, counters);
        const ConeInputs ofStatics{inputs.pixels, inputs.statics.volume().volume()};
        co_await cones.gatherInSteps(device, ofStatics, ConeGather::Part::Diffuse, static_, counters);
        given.texture("allIrradiance", all_).texture("staticIrradiance", static_);
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer);
    const gl::ProgramDesc program = desc(inputs.all != nullptr);
    const glm::ivec2 size(surfaces.width(), surfaces.height());
    co_await gl::dispatchPicture(device, {"baked difference", program, given, size});
}

std::vector<gl::ProgramDesc> HybridDiffuse::programDescs() {
    std::vector<gl::ProgramDesc> descs = {desc(false), desc(true)};
    for (const gl::ProgramDesc& one : BakedPixels::programDescs()) descs.push_back(one);
    return descs;
}

}  // namespace conelight::gather
