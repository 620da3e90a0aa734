// SPDX-License-Identifier: MIT
#include "frame/phong_mode.h"

#include "gather/phong_shade.h"
#include "gl/draw.h"

namespace conelight::frame {

bool PhongMode::needsShadows(const Settings& settings) const {
    return settings.phong.shadows != Toggle::Off && settings.light.shadowSize > 0;
}

void PhongMode::render(const FrameContext& frame) {
    // All light is direct: of the parts a picture can be asked for, only these hold any.
    const Component component = frame.settings.component;
    if (component != Component::Full && component != Component::Direct) {
        gl::Framebuffer({&frame.output}, nullptr, "phong output").clearColor(0, 0, 0, 0, 0);
        return;
    }
    const Toggle shadows = frame.settings.phong.shadows;
    frame.gbuffer.bind();
    gather::drawPhongShade(frame.programs, frame.profiler, frame.scene, frame.settings.light,
                           shadows == Toggle::On || (shadows == Toggle::Auto && !frame.source.thesisFormat),
                           frame.output);
}

}  // namespace conelight::frame
