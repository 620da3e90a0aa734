// SPDX-License-Identifier: MIT
#include "gather/phong_shade.h"

#include "gather/pixel_lights.h"
#include "gl/gl.h"

namespace conelight::gather {
namespace {

struct PhongKey {
    light::LightKey lights;
    bool shadows = false;

    // The stage's own switch takes the place of LIGHTS_SHADOWS.
    gl::ProgramDesc desc() const {
        gl::Defines defines = lights.defines();
        std::erase_if(defines, [](const auto& define) { return define.first == "LIGHTS_SHADOWS"; });
        defines.emplace_back("PHONG_SHADOWS", shadows ? "1" : "0");
        return {{"gather/phong_shade.comp.glsl"}, std::move(defines)};
    }
    static std::vector<PhongKey> all() {
        std::vector<PhongKey> keys;
        for (const light::LightKey& lights : light::LightKey::ofPixels())
            for (const bool shadows : {false, true})
                if (shadows ? lights.shadows : !lights.cascades) keys.push_back({lights, shadows});
        return keys;
    }
};

}  // namespace

void drawPhongShade(const gl::Device& device, const DirectInputs& inputs, bool shadows,
                    const gl::Texture& output) {
    const gl::PassScope pass(device.profiler, "phong");
    light::LightKey lights = lightsOfPixels(inputs.lights, inputs.surfaces);
    lights.cascades = lights.cascades && shadows;
    gl::Inputs given;
    given.add(inputs).image("outputImage", output, gl::ImageUse::Write);
    device.get(PhongKey{lights, shadows && lights.shadows}.desc())
        .dispatch(given, output.width(), output.height());
}

std::vector<gl::ProgramDesc> phongShadeProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const PhongKey& key : PhongKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather
