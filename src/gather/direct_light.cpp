// SPDX-License-Identifier: MIT
#include "gather/direct_light.h"

#include "gl/gl.h"
#include "light/shadow_maps.h"

namespace conelight::gather {

namespace {
constexpr const char* kShader = "gather/direct_light.comp.glsl";
}

void DirectLight::draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                       const LightSettings& settings, int width, int height) {
    const gl::PassScope pass(profiler, "direct light");
    if (!diffuse_ || diffuse_.width() != width || diffuse_.height() != height) {
        diffuse_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "direct diffuse");
        specular_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "direct specular");
    }
    diffuse_.bindImage(0, 0, GL_WRITE_ONLY);
    specular_.bindImage(1, 0, GL_WRITE_ONLY);
    programs.compute(kShader, light::lightDefines(scene, settings)).dispatch(width, height);
}

std::vector<gl::ProgramDesc> DirectLight::programDescs() { return light::lightVariants({{kShader}, {}}); }

}  // namespace conelight::gather
