// SPDX-License-Identifier: MIT
// A mode: one way of making a picture from a scene, as a recipe of stages. What it is given, and what it says
// of itself.
#pragma once

#include "base/steps.h"
#include "conelight/scene.h"
#include "conelight/settings.h"
#include "gather/glass.h"
#include "gather/step_recorder.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"

namespace conelight::modes {

// The values that every picture starts from, made by the renderer, and where the picture goes.
struct Frame {
    const gl::Device& device;
    const scene::GpuScene& scene;
    light::Lights& lights;  // the mode has caustics cast, from its voxels
    const view::Surfaces& surfaces;
    // The same picture in fewer pixels, which gather irradiance for those of `surfaces` (TracedSettings::reduction); null:
    // each for itself.
    const view::Surfaces* reduced = nullptr;
    const Settings& settings;
    // RGBA32F, of the surfaces' size; the mode writes every pixel, row 0 at the bottom.
    const gl::Texture& output;
    const gl::Buffer* lookupCounters =
        nullptr;               // not null: count lookups of cones or rays (shared/lookups.h)
    bool voxelsAmong = false;  // with component voxels: on top of the picture in `output`
    // One of the views of an anti-aliased picture: the same picture as the one before, but for where in its
    // pixels `surfaces` were seen. What was gathered for the pixels' centres may stand in.
    bool besideCenters = false;
    int part = 0;   // which of these views
    int parts = 1;  // how many are averaged
    // Not null: the picture stays as it is, and what it shows of the recorder's pixel, or would show in
    // component full, is gathered once more for the record.
    gather::StepRecorder* recorder = nullptr;

    // The same, with another device.
    Frame on(const gl::Device& other) const {
        return {other,          scene,       lights,        surfaces, reduced, settings, output,
                lookupCounters, voxelsAmong, besideCenters, part,     parts,   recorder};
    }
};

class ModeRenderer {
  public:
    virtual ~ModeRenderer() = default;
    // Owns the values between frame and picture, and brings up to date what the picture needs of them.
    void draw(const Frame& frame) { drawInSteps(frame).finish(); }
    // The same in steps. Rests only where what was done so far harms no other picture if it goes no further.
    virtual base::Steps drawInSteps(const Frame& frame) = 0;
    // Draws what is transmissive in front of the picture that draw() has made. Where a mode has no way of its
    // own: as panes that bend nothing.
    virtual base::Steps drawGlass(const Frame& frame) {
        const gather::DirectInputs inputs{frame.scene, frame.lights, frame.surfaces};
        co_await glass_.drawStraight(frame.device, inputs, gather::partsOf(frame.settings.component),
                                     frame.output);
    }
    // Whether draw() gathers for the pixels' centres what views beside them take over (Frame::besideCenters).
    virtual bool gathersForCenters() const { return false; }
    // Whether the same picture again would be of the same light.
    virtual bool settled() const { return true; }
    // Whether pictures of a scene need shadow maps.
    virtual bool needsShadows(const Scene& scene, const Settings& settings) const = 0;
    // Whether it lights pixels by shadow maps about the eye, where surfaces have them.
    virtual bool readsCascades() const { return false; }
    // Whether the mode has caustics cast.
    virtual bool castsCaustics() const { return false; }
    // Whether lights shine through blended surfaces by their opacity.
    virtual bool seesVeils() const { return false; }
    // Whether it draws lamps by chance where there are many.
    virtual bool drawsLamps() const { return false; }
    // Whether flat emitters become lights where light.emissive_quads is on.
    virtual bool lightsFromEmitters(const Settings&) const { return true; }
    // The same of small bulbs and thin boxes, where light.small_lamps is on.
    virtual bool lightsFromSmallLamps() const { return false; }

  protected:
    gather::Glass glass_;
};

}  // namespace conelight::modes
