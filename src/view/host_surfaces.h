// SPDX-License-Identifier: MIT
// Surfaces that a host has drawn (conelight/light_field.h) -> G-buffer. Part of view::Surfaces.
#pragma once

#include <vector>

#include "conelight/light_field.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"
#include "shared/frame.h"
#include "view/gbuffer.h"

namespace conelight::view {

// Throws Error(Usage) when surfaces are incomplete, have no size, or are seen by parallel rays.
void requireUsable(const HostSurfaces& host);

// Of every reduction-th pixel, from the first, in both directions.
gpu::FrameConstants frameConstants(const HostSurfaces& host, int reduction);

class HostSurfaceImport {
  public:
    HostSurfaceImport();
    // Fills the G-buffer, of the size of frameConstants(host, reduction), whose block `frameBlock` is.
    // `instances`: how many the scene has. GL state changed: raster state, vertex array, program and its slots.
    struct Picture {
        const HostSurfaces& host;
        int reduction;
        std::size_t instances;
    };
    void draw(const gl::Device& device, const Picture& picture, const gl::Buffer& frameBlock,
              GBuffer& gbuffer);

    const gl::Sampler& sampler() const { return nearest_; }  // of a host's textures

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Sampler nearest_;
    gl::Buffer constants_;
    gl::VertexArray noVertices_;
};

}  // namespace conelight::view
