// SPDX-License-Identifier: MIT
// What the camera sees, one surface per pixel: GpuScene + camera -> GBuffer (raster, the only raster pass of
// the frame besides shadow maps). Alpha-masked fragments are discarded; blended ones are drawn opaque when
// their opacity is at least one half. Background pixels have depth 1 and instance 0xffffffff.
//
// Reads: scene tables, material textures. Writes: the textures below. Readers need a texture-fetch barrier
// only if they are compute (framebuffer writes are coherent with later texture fetches).
#pragma once

#include "gl/draw.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"

namespace conelight::view {

class GBuffer {
  public:
    GBuffer(int width, int height);

    // The frame block (BINDING_FRAME) must be bound. `cullBackFaces`: single-sided materials are seen from
    // their front only (the thesis's program; DESIGN's modes show back faces of closed objects as well: false).
    void draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene, bool cullBackFaces);

    // Binds all textures from `unit` on, in this order (shaders: lib/gbuffer.glsl):
    //  +0 albedo     RGBA16    rgb base colour, a opacity
    //  +1 normals    RGBA16    octahedral shading normal (xy), geometric normal (zw), both facing the eye
    //  +2 material   RGBA16    metallic, roughness, unused, front-facing (1) or back-facing (0)
    //  +3 specularF0 and emission: RGBA16F emission radiance (rgb)
    //  +4 instance   R32UI     index into the instance table
    //  +5 depth      D32F
    void bind(unsigned unit) const;

    int width() const { return width_; }
    int height() const { return height_; }
    const gl::Texture& depth() const { return depth_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    int width_, height_;
    gl::Texture albedo_, normals_, material_, emission_, instance_, depth_;
    gl::Framebuffer framebuffer_;
};

}  // namespace conelight::view
