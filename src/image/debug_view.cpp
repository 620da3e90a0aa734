// SPDX-License-Identifier: MIT
#include "image/debug_view.h"

#include "base/assert.h"
#include "gl/gl.h"

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

struct DebugViewKey {
    Component component;
    gl::ProgramDesc desc() const { return {{"image/debug_view.comp.glsl"}, {{viewDefine(component), "1"}}}; }
    static std::vector<DebugViewKey> all() {
        return {{Component::Albedo}, {Component::Normal}, {Component::Depth}, {Component::Emission}};
    }
};

}  // namespace

bool isDebugView(Component component) { return viewDefine(component) != nullptr; }

void drawDebugView(const gl::Device& device, const scene::GpuScene& scene, const view::Surfaces& surfaces,
                   Component component, const gl::Texture& output) {
    CONELIGHT_ASSERT(isDebugView(component), "drawDebugView: the component is no picture of the G-buffer");
    const gl::PassScope pass(device.profiler, "debug view");
    gl::Inputs inputs;
    inputs.add(scene).add(surfaces).image("outputImage", output, gl::ImageUse::Write);
    device.get(DebugViewKey{component}.desc()).dispatch(inputs, surfaces.width(), surfaces.height());
}

std::vector<gl::ProgramDesc> debugViewProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const DebugViewKey& key : DebugViewKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::image
