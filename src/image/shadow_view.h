// SPDX-License-Identifier: MIT
// The shadow maps of one light as a picture: distances in m (Component::ShadowMap; the shader says how they
// are laid out).
//
// Reads: light table, shadow maps (ShadowMaps::bind). Writes `output` (RGBA32F) as an image. GL state
// changed: program and its slots.
#pragma once

#include <vector>

#include "conelight/scene.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lights.h"

namespace conelight::image {

class ShadowView {
  public:
    // `light`: in the scene's order, then the emitters that are lights; beyond the last: the last. A light
    // without shadow map is black.
    void draw(const gl::Device& device, const Scene& source, const light::Lights& lights, int light,
              const gl::Texture& output);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer constants_;
};

// Where the light number `light` is in the table; -1: nowhere, as when it is switched off.
int tableEntry(const Scene& source, const std::vector<gpu::Light>& table, int light);

}  // namespace conelight::image
