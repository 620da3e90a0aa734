// SPDX-License-Identifier: MIT
#include "gather/phong_shade.h"

#include <algorithm>

#include "gl/gl.h"
#include "light/shadow_maps.h"

namespace conelight::gather {
namespace {

// The stage's own switch takes the place of LIGHTS_SHADOWS.
gl::ProgramDesc programDesc(gl::Defines lightDefines, bool shadows) {
    std::erase_if(lightDefines, [](const auto& define) { return define.first == "LIGHTS_SHADOWS"; });
    lightDefines.emplace_back("PHONG_SHADOWS", shadows ? "1" : "0");
    return {{"gather/phong_shade.comp.glsl"}, std::move(lightDefines)};
}

}  // namespace

void drawPhongShade(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                    const LightSettings& settings, bool shadows, const gl::Texture& output) {
    const gl::PassScope pass(profiler, "phong");
    output.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(programDesc(light::lightDefines(scene, settings), shadows && settings.shadowSize > 0))
        .dispatch(output.width(), output.height());
}

std::vector<gl::ProgramDesc> phongShadeProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const gl::ProgramDesc& base : light::lightVariants({}))
        for (const bool shadows : {false, true}) descs.push_back(programDesc(base.defines, shadows));
    return descs;
}

}  // namespace conelight::gather
