// SPDX-License-Identifier: MIT
// Link-time stand-in for a few minutes: whoever lands shadow_maps.cpp deletes this file.
#include "light/shadow_maps.h"
namespace conelight::light {
struct ShadowMaps::Impl {};
ShadowMaps::ShadowMaps() = default;
ShadowMaps::~ShadowMaps() = default;
void ShadowMaps::update(gl::ProgramLibrary&, gl::Profiler&, scene::GpuScene&, const LightSettings&) {}
void ShadowMaps::bind() const {}
std::vector<gl::ProgramDesc> ShadowMaps::programDescs() { return {}; }
}  // namespace conelight::light
