// SPDX-License-Identifier: MIT
// Pictures gathered by rays at pixels: G-buffer + lit voxels -> irradiance, radiance in the specular lobe, or
// occlusion, as means over passes and frames (docs/theory/4_gather.md, "Over frames"), and the edge-stopping
// filter over them. A picture is a texture of lib/pixel_history.glsl.
//
// Every pass needs the frame block, the scene's tables, G-buffer, shadow maps, SurfaceVoxels, OctantWords and
// IrradianceCache bound. Readers need gl::barrier(TextureFetch). GL state changed: program, image 0,
// BINDING_PASS, PIXEL_MOTION, PIXEL_LOBE_LIST, the indirect dispatch buffer binding, texture unit
// PIXEL_UNIT_HISTORY.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "conelight/settings.h"
#include "gather/step_recorder.h"
#include "gl/buffer.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "shared/frame.h"
#include "shared/pixel_rays.h"

namespace conelight::gather {

enum class RayPicture { Diffuse, Specular, Occlusion };

// How a pass takes up what was there (TEMPORAL of lib/temporal.glsl).
enum class Reuse { None, SameView, Reproject };

// What passes of one frame have in common.
struct PixelRayFrame {
    gl::ProgramLibrary& programs;
    gl::Profiler& profiler;
    const scene::GpuScene& scene;
    const LightSettings& light;
    const gpu::FrameConstants& view;
    float voxelSize;           // m
    float gridLength;          // voxels, longest side
    const gl::Buffer* motion;  // mat4 per instance, where it was in the frame before; null: nothing moved
    const gl::Buffer* lookupCounters;  // not null: what rays look up is added (shared/lookups.h)
};

// Pixels lowest <= p < end.
struct PixelRectangle {
    glm::ivec2 lowest{0};
    glm::ivec2 end{0};
};

// Whether a surface of the instance may be smooth enough for rays into its lobe (hasLobe in
// lib/lobe_list.glsl).
bool mayHaveLobe(const scene::GpuScene& scene, const gpu::Instance& instance, float roughest);

class PixelRays {
  public:
    explicit PixelRays(RayPicture kind) : kind_(kind) {}

    // Whether there is a picture of this size.
    bool has(int width, int height) const;
    // One more pass, number `pass`, of `rays` rays (of each kind), averaged with `longest` passes at most.
    void gather(const PixelRayFrame& frame, const TracedSettings& settings, Reuse reuse, int rays,
                std::uint32_t pass, int longest);
    // The picture, filtered by so many levels; what the next gather() goes on from stays as it is.
    const gl::Texture& filtered(const PixelRayFrame& frame, int levels);

    // Where the picture of kind Specular has anything.
    const PixelRectangle& lobes() const { return current_.written; }

    // Records the recorder's pixel of passes 0 to `passes` - 1, each of `rays` rays (of each kind); pictures
    // stay as they are.
    void record(const PixelRayFrame& frame, const TracedSettings& settings, int rays, int passes,
                StepRecorder& recorder);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Picture {
        gl::Texture texture;
        PixelRectangle written;  // of kind Specular: zeros outside
    };
    static void clearWritten(Picture& picture);
    static PixelRectangle lobeRectangle(const PixelRayFrame& frame, float roughest);
    bool resize(int width, int height);
    gpu::PixelRayConstants packed(const PixelRayFrame& frame, const TracedSettings& settings, int rays,
                                  std::uint32_t pass, int longest) const;

    RayPicture kind_;
    Picture current_, other_, filtered_;
    gl::Buffer constants_;
    gl::Buffer lobeList_;             // of kind Specular: PIXEL_LOBE_LIST
    gpu::FrameConstants seenFrom_{};  // the view of current_
};

}  // namespace conelight::gather
