// SPDX-License-Identifier: MIT
// What the camera sees, one surface per pixel: GpuScene + camera -> GBuffer (raster, the only raster pass of
// the frame besides shadow maps). Alpha-masked fragments are discarded; blended ones are drawn opaque when
// their opacity is at least one half. Shaders read it by lib/gbuffer.glsl (fetchSurface), which also
// documents the bits: two textures of packed words, because a software driver stores and fetches words
// without conversion (8 words in two stores: G-buffer pass and readers cost less than with five typed
// targets).
//
// Reads: scene tables, material textures. Writes: the textures below. Readers need a texture-fetch barrier
// only if they are compute (framebuffer writes are coherent with later texture fetches).
#pragma once

#include "gl/draw.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "shared/bindings.h"

namespace conelight::view {

class GBuffer {
  public:
    GBuffer(int width, int height);

    // The frame block (BINDING_FRAME) and the scene's tables must be bound. `cullBackFaces`: single-sided
    // materials are seen from their front only (mode phong and guests; other modes show back faces of
    // closed objects as well: false).
    void draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
              bool cullBackFaces);

    // Binds both textures, at `unit` and the next; lib/gbuffer.glsl expects UNIT_GBUFFER.
    void bind(unsigned unit = UNIT_GBUFFER) const;

    int width() const { return width_; }
    int height() const { return height_; }
    // D32F, of frame.clipFromWorld; surfaces up to GBUFFER_FARTHEST, background 1. For raster passes on top
    // of the surfaces.
    const gl::Texture& depth() const { return depth_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    int width_, height_;
    gl::Texture geometry_, material_, depth_;
    gl::Framebuffer framebuffer_;
};

}  // namespace conelight::view
