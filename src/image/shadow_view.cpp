// SPDX-License-Identifier: MIT
#include "image/shadow_view.h"

#include <algorithm>

#include "gl/gl.h"
#include "scene/gpu_lights.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

gl::ProgramDesc shadowViewDesc() { return {{"image/shadow_view.comp.glsl"}, {}}; }

// How many tiles a light has, on how many per edge of a layer (lib/shadow.glsl).
void setTiles(const gpu::Light& light, gpu::ShadowViewConstants& c) {
    c.tiles = c.tilesPerEdge = c.columns = c.rows = 1;
    if (light.type == LIGHT_POINT) {
        c.tiles = 6;
        c.tilesPerEdge = 2;
        c.columns = 3;
        c.rows = 2;
    } else if (light.type == LIGHT_RECT) {
        // Three per sample point, six of a sphere's, a row for each row of points.
        const std::uint32_t each = (light.flags & LIGHT_SPHERE) != 0 ? 6 : 3;
        c.tiles = each * light.sampleGrid * light.sampleGrid;
        c.tilesPerEdge = 4;
        c.columns = each * light.sampleGrid;
        c.rows = light.sampleGrid;
    }
}

}  // namespace

int tableEntry(const Scene& source, const std::vector<gpu::Light>& table, int light) {
    const int own = static_cast<int>(source.lights.size());
    const int last =
        own - 1 + static_cast<int>(std::count_if(table.begin(), table.end(), [](const auto& one) {
            return (one.flags & LIGHT_FROM_EMITTER) != 0;
        }));
    light = std::min(light, last);
    if (light < 0) return -1;
    const auto nth = [&](int skip, auto&& accepted) {
        for (std::size_t i = 0; i < table.size(); ++i)
            if (accepted(table[i]) && skip-- == 0) return static_cast<int>(i);
        return -1;
    };
    if (light >= own)
        return nth(light - own, [](const gpu::Light& one) { return (one.flags & LIGHT_FROM_EMITTER) != 0; });
    // The table keeps the scene's order within a kind.
    const auto kindOf = [&](int i) {
        const std::vector<gpu::Light> one = scene::packedLights({source.lights[static_cast<std::size_t>(i)]});
        return one.empty() ? -1 : static_cast<int>(one.front().type);  // none: switched off
    };
    const int kind = kindOf(light);
    if (kind < 0) return -1;
    int before = 0;
    for (int i = 0; i < light; ++i) before += kindOf(i) == kind ? 1 : 0;
    return nth(before, [kind](const gpu::Light& one) {
        return static_cast<int>(one.type) == kind && (one.flags & LIGHT_FROM_EMITTER) == 0;
    });
}

void ShadowView::draw(const gl::Device& device, const Scene& source, const light::Lights& lights, int light,
                      const gl::Texture& output) {
    const gl::PassScope pass(device.profiler, "shadow map view");
    const int entry = tableEntry(source, lights.table(), light);
    gpu::ShadowViewConstants c{};
    c.tilesPerEdge = c.columns = c.rows = 1;
    if (entry >= 0 && lights.table()[static_cast<std::size_t>(entry)].shadow >= 0) {
        c.light = static_cast<std::uint32_t>(entry);
        setTiles(lights.table()[static_cast<std::size_t>(entry)], c);
    }
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::ShadowViewConstants), "shadow view constants");
    constants_.update(c);
    gl::Inputs inputs;
    inputs.add(lights).uniform("ShadowViewBlock", constants_).image("picture", output, gl::ImageUse::Write);
    device.get(shadowViewDesc()).dispatch(inputs, output.width(), output.height());
}

std::vector<gl::ProgramDesc> ShadowView::programDescs() { return {shadowViewDesc()}; }

}  // namespace conelight::image
