// SPDX-License-Identifier: MIT
// What a mode is given to draw one picture. Built by renderer.cpp for each render() call.
#pragma once

#include "conelight/scene.h"
#include "conelight/settings.h"
#include "gather/step_recorder.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "light/shadow_maps.h"
#include "scene/gpu_scene.h"
#include "shared/frame.h"
#include "view/gbuffer.h"

namespace conelight::modes {

struct FrameContext {
    gl::ProgramLibrary& programs;
    gl::Profiler& profiler;
    const Scene& source;
    scene::GpuScene& scene;
    const Settings& settings;
    const gpu::FrameConstants& view;  // the camera; what the frame block holds
    int width;
    int height;
    view::GBuffer& gbuffer;      // drawn before the mode runs; textures still to be bound
    light::ShadowMaps& shadows;  // up to date and bound when the mode asked for them (needsShadows)
    const gl::Texture&
        output;  // RGBA32F, width x height; the mode writes every pixel (imageStore), row 0 at the bottom
    bool geometryChanged;        // scene, transforms, voxel settings or "every frame": voxels are out of date
    bool everythingAnew;         // "every frame": build all, also what did not change
    bool lightChanged;           // geometryChanged, or lights or light settings changed: inject again
    gl::Buffer* lookupCounters;  // not null: count texture lookups of cones or rays (shared/lookups.h)
    bool voxelsAmong = false;    // with component voxels: on top of the picture in `output`
};

// One way of making the picture. Owns its volumes and passes; lives as long as the scene is shown in its
// mode.
class ModeRenderer {
  public:
    virtual ~ModeRenderer() = default;
    // The frame block, scene tables, G-buffer and (if needed) shadow maps are ready.
    virtual void render(const FrameContext& frame) = 0;
    virtual bool needsShadows(const Settings& settings) const = 0;
    // Gathers for the recorder's pixel once more what the picture of this frame shows there, or would show in
    // component full. State as for render(); the G-buffer is that of the picture.
    virtual void record(const FrameContext&, gather::StepRecorder&) {}
    // What the renderer asks; for modes whose answer depends on the scene.
    virtual bool needsShadowsIn(const Scene&, const Settings& settings) const {
        return needsShadows(settings);
    }
    // Flat emitters become lights when light.emissive_quads is on.
    virtual bool lightsFromEmitters(const Settings&) const { return true; }
    // Single-sided materials are not seen from behind (glTF's rule).
    virtual bool cullsBackFaces() const { return true; }
};

}  // namespace conelight::modes
