// SPDX-License-Identifier: MIT
#include "modes/phong_mode.h"

#include "gather/phong_shade.h"
#include "gl/draw.h"

namespace conelight::modes {

bool PhongMode::needsShadows(const Settings& settings) const {
    return settings.phong.shadows != Toggle::Off && settings.light.shadowSize > 0;
}

bool PhongMode::needsShadowsIn(const Scene& scene, const Settings& settings) const {
    const bool wanted = settings.phong.shadows == Toggle::On || scene.format.empty();
    return needsShadows(settings) && wanted;
}

void PhongMode::render(const FrameContext& frame) {
    // All light is direct: of the parts a picture can be asked for, only these hold any.
    const Component component = frame.settings.component;
    if (component != Component::Full && component != Component::Direct) {
        gl::Framebuffer({&frame.output}, nullptr, "phong output").clearColor(0, 0, 0, 0, 0);
        return;
    }
    frame.gbuffer.bind();
    gather::drawPhongShade(frame.programs, frame.profiler, frame.scene, frame.settings.light,
                           needsShadowsIn(frame.source, frame.settings), frame.output);
}

}  // namespace conelight::modes
