// SPDX-License-Identifier: MIT
#include "gl/sampler_slots.h"

#include <string>

#include "gl/gl.h"
#include "gl/program.h"

namespace conelight::gl {
namespace {

// All texels are of unit 0: the slots that count are those of the driver, one per texture that a program names.
std::string everySlot(const std::string&) {
    return R"(#version 450 core
layout(local_size_x = 1) in;
uniform sampler2D texels[32];  // as many as a compute program may have in llvmpipe
layout(std430) writeonly buffer SumBlock { float total; };
void main() {
    float sum = 0.0;
    for (int i = 0; i < 32; ++i) sum += texelFetch(texels[i], ivec2(0), 0).x;
    total = sum;
}
)";
}

}  // namespace

SamplerSlots::SamplerSlots(ProgramCache* cache)
    : program_(std::make_unique<Program>(everySlot, ProgramDesc{{"sampler_slots.comp.glsl"}, {}}, cache)),
      texel_({GL_TEXTURE_2D, GL_R8}, "sampler slots"),
      sum_(sizeof(float), "sampler slots") {
    texel_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    texel_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}
SamplerSlots::~SamplerSlots() = default;

void SamplerSlots::run() const {
    glUseProgram(program_->name());
    glBindTextureUnit(0, texel_.name());
    glBindSampler(0, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, sum_.name());
    glDispatchCompute(1, 1, 1);
}

}  // namespace conelight::gl
