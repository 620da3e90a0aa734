// SPDX-License-Identifier: MIT
// The picture of mode `traced`, put together in one pass: G-buffer, lights, cache or gathered pictures ->
// RGBA32F picture. Also its view of occlusion.
//
// Reads: frame block, scene tables, G-buffer, shadow maps, SurfaceVoxels, OctantWords, IrradianceCache, all
// bound. Writes `output`; readers need a texture-fetch barrier. GL state changed: raster state, program,
// vertex array, image 0, BINDING_PASS, units PIXEL_UNIT_*.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gather/picture_parts.h"
#include "gather/pixel_rays.h"
#include "gather/step_recorder.h"
#include "gl/buffer.h"
#include "gl/draw.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "view/gbuffer.h"

namespace conelight::gather {

class TracedShade {
  public:
    // `irradiance` null: from the cache. `lobe` null: the irradiance stands in for it; it has something
    // within `lobes`. Where `gbuffer` holds no surface there is `sky`, with direct light. `lookupCounters`
    // not null: adds lookups of the cache, and of shadow maps as occlusion's.
    void draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
              const Settings& settings, const PictureParts& parts, const gl::Texture* irradiance,
              const gl::Texture* lobe, const PixelRectangle& lobes, const view::GBuffer& gbuffer,
              const glm::vec3& sky, const gl::Texture& output, const gl::Buffer* lookupCounters);
    // Records the faces of the cache that the recorder's pixel shows.
    void recordCache(gl::ProgramLibrary& programs, StepRecorder& recorder);
    void drawOcclusion(gl::ProgramLibrary& programs, gl::Profiler& profiler, const gl::Texture& occlusion,
                       const gl::Texture& output);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer constants_;
    gl::VertexArray noVertices_;
};

}  // namespace conelight::gather
