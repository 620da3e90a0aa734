// SPDX-License-Identifier: MIT
#include "image/display.h"

#include <utility>

#include "conelight/renderer.h"
#include "gl/gl.h"
#include "image/white_balance.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

struct DisplayKey {
    bool bloom;
    gl::ProgramDesc desc() const { return {{"image/display.comp.glsl"}, {{"BLOOM", bloom ? "1" : "0"}}}; }
};

std::uint32_t curveOf(ToneMap curve) {
    switch (curve) {
        case ToneMap::None:
            return 0;
        case ToneMap::Reinhard:
            return 1;
        case ToneMap::Aces:
            return 2;
        case ToneMap::Agx:
            return 3;
        case ToneMap::Neutral:
            return 4;
    }
    return 0;
}

// What is known of the picture before it is there.
gpu::DisplayConstants constantsOf(const ImageSettings& settings) {
    gpu::DisplayConstants constants{};
    constants.curve = curveOf(settings.toneMap);
    constants.srgb = settings.srgb ? 1 : 0;
    constants.check = settings.check == ExposureCheck::Clipping     ? 1
                      : settings.check == ExposureCheck::FalseColor ? 2
                                                                    : 0;
    const glm::mat3 balance = whiteBalance(settings.whiteBalance, settings.tint);
    for (int i = 0; i < 3; ++i) constants.balance[i] = glm::vec4(balance[i], 0);
    for (int i = 0; i < FALSE_COLORS; ++i) {
        const float stops = static_cast<float>(i) + 0.5f - FALSE_COLOR_OFFSET;
        constants.falseColors[i] = glm::vec4(glm::vec3(falseColor(stops)) / 255.0f, 1);
    }
    return constants;
}

}  // namespace

void Display::draw(const gl::Device& device, const gl::Texture& linear, const ImageSettings& settings,
                   RowOrder rows) {
    if (!texture_ || texture_.width() != linear.width() || texture_.height() != linear.height()) {
        texture_ = {};
        texture_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA8, linear.width(), linear.height()}, "display image");
    }
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::DisplayConstants), "display constants");
    gpu::DisplayConstants constants = constantsOf(settings);
    constants.topFirst = rows == RowOrder::TopFirst ? 1 : 0;
    exposure_.measure(device, linear, settings.exposure);
    const bool blooms = settings.bloom > 0 && linear.width() > 1 && linear.height() > 1;
    if (!blooms) bloom_.reset();
    gl::Inputs inputs;
    if (blooms) {
        if (!bloom_) bloom_.emplace();
        bloom_->spread(device, linear);
        constants.kept = 1 - settings.bloom + settings.bloom * bloom_->weightOfPicture();
        constants.spread = settings.bloom;
        inputs.add(*bloom_);
    }
    constants_.update(constants);
    inputs.add(exposure_)
        .uniform("DisplayBlock", constants_)
        .texture("linearImage", linear)
        .image("displayImage", texture_, gl::ImageUse::Write);
    device.get(DisplayKey{blooms}.desc()).dispatch(inputs, linear.width(), linear.height());
    gl::barrier(gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> Display::programDescs() {
    std::vector<gl::ProgramDesc> descs = Exposure::programDescs();
    for (gl::ProgramDesc& desc : Bloom::programDescs()) descs.push_back(std::move(desc));
    for (const bool bloom : {false, true}) descs.push_back(DisplayKey{bloom}.desc());
    return descs;
}

}  // namespace conelight::image
