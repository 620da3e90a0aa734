// SPDX-License-Identifier: MIT
#include "gather/light_outputs.h"

#include "gl/gl.h"

namespace conelight::gather {
namespace {

struct OutputKey {
    bool irradiance, lobe;
    gl::ProgramDesc desc() const {
        return {{"view/whole_picture.vert.glsl", "gather/light_outputs.frag.glsl"},
                {{"IRRADIANCE", irradiance ? "1" : "0"}, {"LOBE", lobe ? "1" : "0"}}};
    }
    static std::vector<OutputKey> all() {
        return {{false, false}, {false, true}, {true, false}, {true, true}};
    }
};

gl::Texture makeOutput(int width, int height, const char* label) {
    gl::Texture texture({GL_TEXTURE_2D, GL_RGBA16F, width, height}, label);
    texture.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    texture.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    texture.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    texture.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

void LightOutputs::draw(const gl::Device& device, const RayInputs& inputs, const Indirect& indirect,
                        float specularLimit) {
    const gl::PassScope pass(device.profiler, "light outputs");
    const int width = inputs.surfaces.width(), height = inputs.surfaces.height();
    if (!diffuse_ || diffuse_.width() != width || diffuse_.height() != height) {
        target_ = {};
        diffuse_ = makeOutput(width, height, "diffuse light");
        specular_ = makeOutput(width, height, "specular light");
        target_ = gl::Framebuffer({&diffuse_, &specular_}, nullptr, "light outputs");
    }
    if (!constants_) {
        constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "light outputs");
        noVertices_ = gl::VertexArray("no vertices");
    }
    gpu::PixelRayConstants constants{};
    constants.specularLimit = specularLimit;
    constants_.update(constants);
    gl::Inputs given;
    given.add(inputs).uniform("PixelRayBlock", constants_);
    const gl::Texture* const irradiance = indirect.irradiance();
    const gl::Texture* const lobe = indirect.lobe();
    if (irradiance != nullptr) given.texture("irradiancePicture", *irradiance);
    if (lobe != nullptr) given.texture("lobePicture", *lobe);
    gl::RasterState state;
    state.framebuffer = &target_;
    state.depthTest = false;
    state.depthWrite = false;
    state.cull = gl::Cull::None;
    gl::apply(state);
    device.get(OutputKey{irradiance != nullptr, lobe != nullptr}.desc()).use(given);
    gl::drawTriangle(noVertices_);
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer);
}

std::vector<gl::ProgramDesc> LightOutputs::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const OutputKey& key : OutputKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
