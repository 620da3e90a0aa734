// SPDX-License-Identifier: MIT
#include "gather/light_outputs.h"

#include "gl/gl.h"

namespace conelight::gather {
namespace {

struct OutputKey {
    bool irradiance, lobe, compute;
    gl::ProgramDesc desc() const {
        using Files = std::vector<std::string>;
        return {compute ? Files{"gather/light_outputs.comp.glsl"}
                        : Files{"view/whole_picture.vert.glsl", "gather/light_outputs.frag.glsl"},
                {{"IRRADIANCE", irradiance ? "1" : "0"}, {"LOBE", lobe ? "1" : "0"}}};
    }
    static std::vector<OutputKey> all() {
        std::vector<OutputKey> keys;
        for (int bits = 0; bits < 8; ++bits)
            keys.push_back({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
        return keys;
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
    const bool compute = device.profile == gl::ExecutionProfile::Gpu;
    const gl::Program& program =
        device.get(OutputKey{irradiance != nullptr, lobe != nullptr, compute}.desc());
    if (compute) {
        given.image("diffuseOutput", diffuse_, gl::ImageUse::Write)
            .image("specularOutput", specular_, gl::ImageUse::Write);
        program.dispatch(given, width, height);
        gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess | gl::Access::Framebuffer);
        return;
    }
    gl::RasterState state;
    state.framebuffer = &target_;
    state.depthTest = false;
    state.depthWrite = false;
    state.cull = gl::Cull::None;
    gl::apply(state);
    program.use(given);
    gl::drawTriangle(noVertices_);
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer);
}

std::vector<gl::ProgramDesc> LightOutputs::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const OutputKey& key : OutputKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
