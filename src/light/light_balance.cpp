// SPDX-License-Identifier: MIT
#include "light/light_balance.h"

#include <string>

#include "gl/gl.h"
#include "shared/irradiance.h"

namespace conelight::light {
namespace {

// Part of the correction that an update makes of light that is seen: none is to be noticed.
constexpr float kStep = 0.25f;

gl::ProgramDesc balanceStep(int step) {
    return {{"light/cache_balance.comp.glsl"}, {{"STEP", std::to_string(step)}}};
}

std::size_t balanceGroups(std::size_t faces) {
    constexpr std::size_t kEach = std::size_t{BALANCE_LANES} * BALANCE_FACES_OF_LANE;
    return (faces + kEach - 1) / kEach;
}

}  // namespace

void LightBalance::reserve(std::size_t faces) {
    if (!balance_) {
        balance_ = gl::Buffer(sizeof(gpu::CacheBalance), "irradiance cache balance");
        block_ = gl::Buffer(sizeof(gpu::CacheBalancing), "irradiance cache balance constants");
        balance_.clear();
    }
    if (gathered_ && gathered_.bytes() >= 8 * faces) return;
    release();
    // No room for growth before there was any.
    const std::size_t room = (hadFaces_ ? faces + faces / 4 : faces) + 64;
    hadFaces_ = true;
    gathered_ = gl::Buffer(8 * room, "gathered light of faces");
    gatheredTexels_ = gl::Texture(gathered_, GL_RG32UI, "gathered light of faces");
    gathered_.clear();
    groupSums_ = gl::Buffer(3 * sizeof(glm::vec4) * balanceGroups(room), "sums of gathered light");
}

void LightBalance::release() {
    gatheredTexels_ = {};
    gathered_ = {};
    groupSums_ = {};
    measured_ = false;
}

void LightBalance::begin(const gl::Device& device, const Faces& faces) {
    if (!measured_ && restart_ != Restart::Edits) addUp(device, faces, {});
}

void LightBalance::correct(const gl::Device& device, const Faces& faces, const Update& update) {
    if (!measured_) return;
    gpu::CacheBalancing how{};
    // As (4.13), but from the beginning: what is averaged is right before bounces have settled.
    how.weight = 1.5f / (static_cast<float>(update.number - 1) + 1.5f);
    // The rays of the first part have read the light of before, those of others some of its end, too.
    how.cachedBefore = 0.5f + 0.5f * update.part;
    how.rounds = static_cast<float>(update.number + 1);
    how.step = restart_ == Restart::Dark ? 1.0f : update.number > IRRADIANCE_SETTLE ? kStep : 0.0f;
    addUp(device, faces, how);
}

// With a weight, the sums correct the light.
void LightBalance::addUp(const gl::Device& device, const Faces& faces, const gpu::CacheBalancing& how) {
    const gl::PassScope scope(device.profiler, "irradiance: balance");
    const std::size_t count = faces.surface.mostFaces();
    gpu::CacheBalancing block = how;
    block.groups = static_cast<std::uint32_t>(balanceGroups(count));
    block_.update(block);
    gl::Inputs given;
    given.add(faces.surface)
        .add(faces.lit)
        .uniform("BalanceBlock", block_)
        .storage("BalanceTable", balance_)
        .storage("GroupTable", groupSums_)
        .storage("StateTable", faces.states)
        .texture("stateTexels", faces.stateTexels)
        .texture("gatheredTexels", gatheredTexels_);
    device.get(balanceStep(0)).dispatchLinear(given, block.groups * std::size_t{BALANCE_LANES});
    gl::barrier(gl::Access::ShaderStorage);
    device.get(balanceStep(1)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage);
    if (how.step > 0) device.get(balanceStep(2)).dispatchLinear(given, count);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
    measured_ = true;
}

void LightBalance::declare(gl::Inputs& inputs) const { inputs.storage("GatheredTable", gathered_); }

std::vector<gl::ProgramDesc> LightBalance::programDescs() {
    return {balanceStep(0), balanceStep(1), balanceStep(2)};
}

}  // namespace conelight::light
