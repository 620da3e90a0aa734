// SPDX-License-Identifier: MIT
#include "modes/phong_mode.h"

#include "gather/phong_shade.h"
#include "gl/draw.h"

namespace conelight::modes {

bool PhongMode::needsShadows(const Scene& scene, const Settings& settings) const {
    const bool wanted = settings.phong.shadows == Toggle::On ||
                        (settings.phong.shadows == Toggle::Auto && scene.format.empty());
    return wanted && settings.light.shadowSize > 0;
}

// [recipe]
void PhongMode::draw(const Frame& frame) {
    if (frame.recorder != nullptr) return;  // nothing is gathered
    // All light is direct: of the parts a picture can be asked for, only these hold any.
    const Component component = frame.settings.component;
    if (component != Component::Full && component != Component::Direct) {
        gl::Framebuffer({&frame.output}, nullptr, "phong output").clearColor(0, 0, 0, 0, 0);
        return;
    }
    gather::drawPhongShade(frame.device, {frame.scene, frame.lights, frame.surfaces},
                           needsShadows(frame.scene.source(), frame.settings), frame.output);
}
// [/recipe]

}  // namespace conelight::modes
