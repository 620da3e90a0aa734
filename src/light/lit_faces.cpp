// SPDX-License-Identifier: MIT
#include "light/lit_faces.h"

#include "gl/gl.h"
#include "shared/irradiance.h"

namespace conelight::light {

void LitFaces::reserve(std::uint32_t faces) {
    gl::reserveTexels(faces_, texels_, GL_RGBA32UI, sizeof(gpu::LitFace) * faces, "lit faces");
}

void LitFaces::declare(gl::Inputs& inputs) const {
    inputs.texture("litFaces", texels_).storage("LitFaceTable", faces_);
}

}  // namespace conelight::light
