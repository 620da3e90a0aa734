// SPDX-License-Identifier: MIT
#include "light/lit_faces.h"

#include <algorithm>

#include "gl/gl.h"
#include "shared/irradiance.h"

namespace conelight::light {

void LitFaces::reserve(std::uint32_t faces) {
    const std::size_t bytes = sizeof(gpu::LitFace) * std::max(faces, 1u);
    if (faces_ && faces_.bytes() >= bytes) return;
    // No room for growth before there was any.
    const bool grows = static_cast<bool>(faces_);
    texels_ = {};
    faces_ = {};
    faces_ = gl::Buffer(grows ? bytes + bytes / 4 : bytes, "lit faces");
    texels_ = gl::Texture(faces_, GL_RGBA32UI, "lit faces");
}

void LitFaces::declare(gl::Inputs& inputs) const {
    inputs.texture("litFaces", texels_).storage("LitFaceTable", faces_);
}

}  // namespace conelight::light
