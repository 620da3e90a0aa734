// SPDX-License-Identifier: MIT
#include "image/debug_view.h"

#include "base/assert.h"
#include "gl/gl.h"
#include "shared/bindings.h"

namespace conelight::image {
namespace {

const char* viewDefine(Component component) {
    switch (component) {
        case Component::Albedo:
            return "VIEW_ALBEDO";
        case Component::Normal:
            return "VIEW_NORMAL";
        case Component::Depth:
            return "VIEW_DEPTH";
        case Component::Emission:
            return "VIEW_EMISSION";
        default:
            return nullptr;
    }
}

gl::ProgramDesc programDesc(Component component) {
    return {{"image/debug_view.comp.glsl"}, {{viewDefine(component), "1"}}};
}

}  // namespace

bool isDebugView(Component component) { return viewDefine(component) != nullptr; }

void drawDebugView(gl::ProgramLibrary& programs, gl::Profiler& profiler, const view::GBuffer& gbuffer,
                   Component component, const gl::Texture& output) {
    CONELIGHT_ASSERT(isDebugView(component), "drawDebugView: the component is no picture of the G-buffer");
    const gl::PassScope pass(profiler, "debug view");
    gbuffer.bind(UNIT_GBUFFER);
    output.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(programDesc(component)).dispatch(gbuffer.width(), gbuffer.height());
}

std::vector<gl::ProgramDesc> debugViewProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const Component component :
         {Component::Albedo, Component::Normal, Component::Depth, Component::Emission})
        descs.push_back(programDesc(component));
    return descs;
}

}  // namespace conelight::image
