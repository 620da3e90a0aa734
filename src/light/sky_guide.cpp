// SPDX-License-Identifier: MIT
#include "light/sky_guide.h"

#include <cstddef>

#include "gl/gl.h"
#include "shared/irradiance.h"
#include "shared/sky_guide.h"

namespace conelight::light {
namespace {

constexpr std::size_t kRowWord = std::size_t{4} * LIGHT_CLUSTERS;

gl::ProgramDesc rowsPass() { return {{"light/sky_rows.comp.glsl"}, {}}; }

}  // namespace

void SkyGuide::reserve() {
    if (guide_) return;
    learned_ = gl::Buffer(kRowWord * SKY_LEARNED_WORDS, "learned sky");
    guide_ = gl::Buffer(kRowWord * SKY_GUIDE_WORDS, "guide to the sky");
    guideTexels_ = gl::Texture(guide_, GL_R32UI, "guide to the sky");
    restart();
}

void SkyGuide::restart() {
    if (!guide_) return;
    learned_.clear();
    guide_.clear();
}

void SkyGuide::learn(const gl::Device& device, const gl::Buffer& constants) {
    const gl::PassScope scope(device.profiler, "irradiance: guide to the sky");
    gl::Inputs given;
    given.uniform("CacheBlock", constants)
        .storage("SkyLearnedTable", learned_)
        .storage("SkyGuideTable", guide_);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(rowsPass()).dispatch(given, LIGHT_CLUSTERS / SKY_ROW_PARTS * SKY_ROW_LANES);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
}

void SkyGuide::declare(gl::Inputs& inputs) const {
    if (guide_) inputs.texture("skyGuide", guideTexels_);
}

void SkyGuide::declareLearned(gl::Inputs& inputs) const {
    if (guide_) inputs.storage("SkyLearnedTable", learned_);
}

std::vector<gl::ProgramDesc> SkyGuide::programDescs() { return {rowsPass()}; }

}  // namespace conelight::light
