// SPDX-License-Identifier: MIT
// Pictures gathered by rays at pixels: surfaces + lit voxels -> irradiance, radiance in the specular lobe, or
// occlusion, as means over passes and frames (docs/theory/4e_pixels.md, "Over frames"), and the edge-stopping
// filter over them. A picture is a texture of lib/pixel_history.glsl. Part of gather::Indirect.
//
// Readers need gl::barrier(TextureFetch). GL state changed: program and its slots, the indirect dispatch
// buffer binding.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "base/steps.h"
#include "conelight/settings.h"
#include "gather/pixel_ray_key.h"
#include "gather/step_recorder.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lit_voxels.h"
#include "scene/gpu_scene.h"
#include "shared/pixel_rays.h"
#include "view/surfaces.h"
#include "voxels/voxels.h"

namespace conelight::gather {

// What rays at pixels read.
struct RayInputs {
    const scene::GpuScene& scene;
    const light::Lights& lights;
    const voxels::Voxels& voxels;
    const light::LitVoxels& lit;
    const view::Surfaces& surfaces;

    void declare(gl::Inputs& inputs) const;
};

// How a pass takes up what was there: with another view or other places, by reprojection.
enum class Reuse { None = REUSE_NONE, SameView = REUSE_SAME_VIEW, Reproject = REUSE_REPROJECTED };

// Which light a picture so far is of: that before what changed last (LitVoxels::changed), or that of now.
enum class LightSoFar { Unknown, Before, Now };

// What a pass is to do.
struct RayPass {
    const TracedSettings& settings;
    int rays;                                    // of each technique, per pixel
    int longest;                                 // passes that are averaged at most
    std::uint32_t number = 0;                    // of the pass
    Reuse reuse = Reuse::None;                   // of what was there
    const gl::Buffer* motion = nullptr;          // mat4 per instance, where it was in the frame before; null:
                                                 // nothing moved
    const gl::Buffer* lookupCounters = nullptr;  // not null: what rays look up is added (shared/lookups.h)
    // Passes that are averaged at most at what changed last (LitVoxels::changed), and those of what smooth surfaces show
    // of it; 0: `longest`.
    int shortest = 0, shortestOfLobes = 0, shortestOfLight = 0;
    LightSoFar light = LightSoFar::Unknown;  // of what was there
};

// Pixels lowest <= p < end.
struct PixelRectangle {
    glm::ivec2 lowest{0};
    glm::ivec2 end{0};
};

// A picture of lib/pixel_history.glsl, without anything in it.
gl::Texture makePixelPicture(int width, int height, const char* label);
// What lib/temporal.glsl has to know of the view that the picture so far was gathered with.
void setPictureSoFar(gpu::PixelRayConstants& constants, const gpu::FrameConstants& view,
                     const voxels::VoxelGrid& grid);

// About the boxes of all instances that count, in whole groups of 8 pixels; all of a host's picture. Corners nearer than
// `nearest`, m, are behind the eye.
PixelRectangle rectangleOf(const view::Surfaces& surfaces, const scene::GpuScene& scene, float nearest,
                           const std::function<bool(const gpu::Instance&)>& counts);

// Whether a surface of the instance, or its coat, may be smooth enough for rays into its lobe (hasLobe in
// lib/lobe_list.glsl).
bool mayHaveCoatLobe(const scene::GpuScene& scene, const gpu::Instance& instance);
bool mayHaveLobe(const scene::GpuScene& scene, const gpu::Instance& instance, float roughest);

class PixelRays {
  public:
    explicit PixelRays(RayPicture kind) : kind_(kind) {}
    RayPicture kind() const { return kind_; }

    // Whether there is a picture of this size.
    bool has(int width, int height) const;
    // One more pass. Left before it is done, it leaves the picture as it was.
    base::Steps gatherInSteps(const gl::Device& device, const RayInputs& inputs, const RayPass& pass);
    // Filters the picture by so many levels; what the next pass goes on from stays as it is.
    base::Steps filterInSteps(const gl::Device& device, const RayInputs& inputs, int levels);
    const gl::Texture& filtered() const { return *shown_; }  // valid until the next pass

    // Where a picture of lobes has anything.
    const PixelRectangle& lobes() const { return current_.written; }

    // Records the recorder's pixel in one of `pass.longest` passes; pictures stay as they are.
    void record(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                StepRecorder& recorder);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Picture {
        gl::Texture texture;
        PixelRectangle written;  // of lobes: zeros outside
    };
    static void clearWritten(Picture& picture);
    bool resize(int width, int height);
    PixelRayKey key(const RayInputs& inputs, const RayPass& pass) const;
    gpu::PixelRayConstants packed(const RayInputs& inputs, const RayPass& pass) const;
    gl::Inputs passInputs(const RayInputs& inputs, const RayPass& pass) const;
    const gl::Buffer& lobeList();
    void listLobes(const gl::Device& device, gl::Inputs& inputs, const PixelRectangle& lobes);

    RayPicture kind_;
    Picture current_, other_, filtered_;
    const gl::Texture* shown_ = nullptr;  // of these
    gl::Buffer constants_;
    gl::Buffer lobeList_;             // of lobes: LobeList
    gpu::FrameConstants seenFrom_{};  // the view of current_
};

}  // namespace conelight::gather
