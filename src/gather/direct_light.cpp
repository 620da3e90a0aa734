// SPDX-License-Identifier: MIT
#include "gather/direct_light.h"

#include <algorithm>

#include "gather/pixel_lights.h"
#include "gl/gl.h"

namespace conelight::gather {
namespace {

gl::ProgramDesc desc(const light::LightKey& lights) {
    return {{"gather/direct_light.comp.glsl"}, lights.defines()};
}

// Few programs: lights are told by which kinds there are.
gl::ProgramDesc desc(light::LightKey lights, const gl::Defines& cones) {
    lights.fixed = false;
    lights.filter = 0;
    lights.cascades = false;
    for (int* kind : {&lights.point, &lights.spot, &lights.directional, &lights.rect})
        *kind = std::min(*kind, 1);
    gl::ProgramDesc desc{{"gather/direct_light.comp.glsl"}, lights.defines()};
    desc.defines.insert(desc.defines.end(), cones.begin(), cones.end());
    desc.defines.emplace_back("CONE_SHADOWS", "1");
    return desc;
}

}  // namespace

void DirectLight::draw(const gl::Device& device, const DirectInputs& inputs, const ConeShadows* cones) {
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
    const light::LightKey lights = lightsOfPixels(inputs.lights, inputs.surfaces);
    const bool byCones = cones != nullptr && lights.shadows;
    if (byCones) given.add(*cones);
    device.get(byCones ? desc(lights, cones->defines) : desc(lights)).dispatch(given, width, height);
}

std::vector<gl::ProgramDesc> DirectLight::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const light::LightKey& key : light::LightKey::ofPixels()) descs.push_back(desc(key));
    return descs;
}

std::vector<gl::ProgramDesc> DirectLight::coneDescs(const std::vector<gl::Defines>& defines) {
    std::vector<gl::ProgramDesc> descs;
    for (const light::LightKey& key : light::LightKey::all())
        if (!key.fixed && key.shadows && key.filter == 0)
            for (const gl::Defines& cones : defines) descs.push_back(desc(key, cones));
    return descs;
}

}  // namespace conelight::gather
