// SPDX-License-Identifier: MIT
// What the camera sees, one surface per pixel: GpuScene + camera -> GBuffer (raster, the only raster pass of
// the frame besides shadow maps). Alpha-masked fragments are discarded; blended ones are drawn opaque when
// their opacity is at least one half. Shaders read it by lib/gbuffer.glsl (fetchSurface), which also
// documents the bits: two textures of packed words, because a software driver stores and fetches words
// without conversion (8 words in two stores: G-buffer pass and readers cost less than with five typed
// targets).
//
// Readers need a texture-fetch barrier only if they are compute (framebuffer writes are coherent with later
// texture fetches). Part of view::Surfaces.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"

namespace conelight::view {

class GBuffer {
  public:
    GBuffer(int width, int height);

    struct Wanted {
        bool cullBackFaces;  // single-sided materials are seen from their front only
        bool withGlass;  // transmissive instances are drawn like others; else left out, for what lies behind
        glm::mat4 clipFromWorld;  // of the frame; parts of meshes outside of it are not drawn
        float shrink = 0;         // part of its extent by which each triangle is smaller, about its middle
    };
    // `frameBlock` holds gpu::FrameConstants. GL state changed: raster state, vertex array, program and its
    // slots, texture units of materials.
    base::Steps drawInSteps(const gl::Device& device, const scene::GpuScene& scene,
                            const gl::Buffer& frameBlock, Wanted wanted);

    void declare(gl::Inputs& inputs) const;  // gbufferGeometry, gbufferMaterial

    int width() const { return width_; }
    int height() const { return height_; }
    // D32F, of frame.clipFromWorld; surfaces up to GBUFFER_FARTHEST, background 1. For raster passes on top
    // of the surfaces.
    const gl::Texture& depth() const { return depth_; }

    // For passes that fill it otherwise: geometry, material, depth.
    const gl::Framebuffer& framebuffer() const { return framebuffer_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    int width_, height_;
    gl::Texture geometry_, material_, depth_;
    gl::Framebuffer framebuffer_;
    gl::Buffer shrink_;  // gpu::ShrinkConstants, when triangles are shrunk
};

}  // namespace conelight::view
