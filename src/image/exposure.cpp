// SPDX-License-Identifier: MIT
#include "image/exposure.h"

#include <cmath>

#include "gl/gl.h"
#include "shared/image.h"

namespace conelight::image {
namespace {

struct ExposureKey {
    bool counts;  // pixels into bins; else bins into an exposure
    gl::ProgramDesc desc() const {
        return {{counts ? "image/exposure_count.comp.glsl" : "image/exposure_sums.comp.glsl"}, {}};
    }
};

}  // namespace

void Exposure::measure(const gl::Device& device, const gl::Texture& linear, const AutoFloat& wanted) {
    if (!block_) block_ = gl::Buffer(sizeof(gpu::Exposure), "exposure");
    if (!wanted.isAuto) {
        gpu::Exposure fixed{};
        fixed.scale = std::exp2(wanted.value);
        block_.update(fixed);
        return;
    }
    const gl::PassScope pass(device.profiler, "exposure");
    if (!counts_) counts_ = gl::Buffer(std::size_t{4} * EXPOSURE_BINS, "exposure bins");
    counts_.clear();
    gl::Inputs inputs;
    inputs.texture("linearImage", linear).storage("BinCounts", counts_).storage("ExposureTable", block_);
    device.get(ExposureKey{true}.desc()).dispatch(inputs, linear.width(), linear.height());
    gl::barrier(gl::Access::ShaderStorage);
    device.get(ExposureKey{false}.desc()).dispatch(inputs, EXPOSURE_BINS);
    gl::barrier(gl::Access::Uniform | gl::Access::Update);
}

void Exposure::declare(gl::Inputs& inputs) const { inputs.uniform("ExposureBlock", block_); }

std::vector<gl::ProgramDesc> Exposure::programDescs() {
    return {ExposureKey{true}.desc(), ExposureKey{false}.desc()};
}

}  // namespace conelight::image
