// SPDX-License-Identifier: MIT
// What cones from pixels to lights read, instead of shadow maps (lib/cone_shadow.glsl). ConeGather gives it.
#pragma once

#include "gather/radiance_volume.h"
#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/shader_source.h"

namespace conelight::gather {

struct ConeShadows {
    const RadianceVolume& volume;
    const gl::Buffer& block;  // ConeBlock
    gl::Defines defines;      // of lib/cone_trace.glsl

    void declare(gl::Inputs& inputs) const { inputs.add(volume).uniform("ConeBlock", block); }
};

}  // namespace conelight::gather
