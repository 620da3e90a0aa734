// SPDX-License-Identifier: MIT
#include "gather/direct_light.h"

#include "gl/gl.h"

namespace conelight::gather {
namespace {

gl::ProgramDesc desc(const light::LightKey& lights) {
    return {{"gather/direct_light.comp.glsl"}, lights.defines()};
}

}  // namespace

void DirectLight::draw(const gl::Device& device, const DirectInputs& inputs) {
    const gl::PassScope pass(device.profiler, "direct light");
    const int width = inputs.surfaces.width(), height = inputs.surfaces.height();
    if (!diffuse_ || diffuse_.width() != width || diffuse_.height() != height) {
        diffuse_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "direct diffuse");
        specular_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "direct specular");
    }
    gl::Inputs given;
    given.add(inputs)
        .image("diffuseImage", diffuse_, gl::ImageUse::Write)
        .image("specularImage", specular_, gl::ImageUse::Write);
    device.get(desc(inputs.lights.key())).dispatch(given, width, height);
}

std::vector<gl::ProgramDesc> DirectLight::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const light::LightKey& key : light::LightKey::all()) descs.push_back(desc(key));
    return descs;
}

}  // namespace conelight::gather
