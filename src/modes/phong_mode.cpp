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
base::Steps PhongMode::drawInSteps(const Frame& frame) {
    if (frame.recorder != nullptr) co_return;  // nothing is gathered
    // All light is direct: of the parts a picture can be asked for, only these hold any.
    const Component component = frame.settings.component;
    if (component != Component::Full && component != Component::Direct) {
        gl::Framebuffer({&frame.output}, nullptr, "phong output").clearColor(0, 0, 0, 0, 0);
        co_return;
    }
    const gather::DirectInputs inputs{frame.scene, frame.lights, frame.surfaces};
    const bool shadows = needsShadows(frame.scene.source(), frame.settings);
    co_await gather::drawPhongShade(frame.device, inputs, shadows, frame.output);
}
// [/recipe]

}  // namespace conelight::modes
