// SPDX-License-Identifier: MIT
// The picture of mode `traced`, put together in one pass: surfaces, lights, cache or gathered pictures ->
// RGBA32F picture. Also its view of occlusion.
//
// Readers of the picture need a texture-fetch barrier. GL state changed: raster state, program and its slots,
// vertex array.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gather/indirect.h"
#include "gather/picture_parts.h"
#include "gather/step_recorder.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"

namespace conelight::gather {

class TracedShade {
  public:
    struct Wanted {
        const TracedSettings& settings;
        PictureParts parts;
        const gl::Buffer* lookupCounters = nullptr;  // not null: adds lookups of the cache, and of shadow
                                                     // maps as occlusion's
        const gl::Texture* visibility = nullptr;     // of lights (PixelVisibility); null: by shadow maps
    };
    // Irradiance that `indirect` lacks is taken from the cache, and stands in for the lobe's radiance. Where
    // no surface is seen there is the sky, with direct light. Writes all of `output`.
    base::Steps drawInSteps(const gl::Device& device, const RayInputs& inputs, const Indirect& indirect,
                            const Wanted& wanted, const gl::Texture& output);
    // Records the faces of the cache that the recorder's pixel shows.
    void recordCache(const gl::Device& device, const RayInputs& inputs, StepRecorder& recorder);
    base::Steps drawOcclusion(const gl::Device& device, const RayInputs& inputs, const gl::Texture& occlusion,
                              const gl::Texture& output);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct ShadeKey;
    struct Target {
        const view::Surfaces& surfaces;
        const PixelRectangle& lobes;
        glm::vec3 behind;
        const gl::Texture& output;
    };
    base::Steps drawFragments(const gl::Device& device, const gl::Inputs& given, const Target& target,
                              ShadeKey key);
    void drawRectangle(const gl::Device& device, const gl::Inputs& given, const Target& target,
                       const ShadeKey& key, const PixelRectangle& pixels);

    gl::Buffer constants_;
    gl::VertexArray noVertices_;
};

}  // namespace conelight::gather
