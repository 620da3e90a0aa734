// SPDX-License-Identifier: MIT
#include "image/display.h"

#include <cmath>

#include "gl/gl.h"
#include "gl/pass.h"
#include "shared/bindings.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

gl::ProgramDesc programDesc() { return {{"image/display.comp.glsl"}, {}}; }

std::uint32_t curveOf(ToneMap curve) {
    switch (curve) {
        case ToneMap::None:
            return 0;
        case ToneMap::Reinhard:
            return 1;
        case ToneMap::Aces:
            return 2;
    }
    return 0;
}

}  // namespace

void Display::draw(gl::ProgramLibrary& programs, const gl::Texture& linear, const ImageSettings& settings) {
    if (!texture_ || texture_.width() != linear.width() || texture_.height() != linear.height()) {
        texture_ = {};
        texture_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA8, linear.width(), linear.height()}, "display image");
    }
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::DisplayConstants), "display constants");
    gpu::DisplayConstants constants{};
    constants.scale = std::exp2(settings.exposure);
    constants.curve = curveOf(settings.toneMap);
    constants.srgb = settings.srgb ? 1 : 0;
    constants_.update(constants);
    constants_.bindUniform(BINDING_PASS);
    linear.bind(UNIT_PASS);
    texture_.bindImage(0, 0, GL_WRITE_ONLY);
    programs.get(programDesc()).dispatch(linear.width(), linear.height());
    gl::barrier(gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> Display::programDescs() { return {programDesc()}; }

}  // namespace conelight::image
