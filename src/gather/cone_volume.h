// SPDX-License-Identifier: MIT
// The radiance volume, as a value: voxels + lights -> prefiltered radiance of all bounces that are wanted,
// and the cones that read it. Each bounce gathers by cones at faces what the volume of the bounces before
// holds.
#pragma once

#include <optional>

#include "base/revision.h"
#include "base/steps.h"
#include "conelight/settings.h"
#include "gather/cone_gather.h"
#include "gather/radiance_volume.h"
#include "light/baked_faces.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "light/lit_voxels.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::gather {

class ConeVolume {
  public:
    struct Inputs {
        const scene::GpuScene& scene;
        const light::Lights& lights;
        const voxels::Voxels& voxels;
        // Whose indirect light the volume holds; null: cones bounce it.
        const light::LitVoxels* cache = nullptr;
        // What faces of the voxels have as indirect light before the first bounce, in the same grid; null: none.
        const light::BakedFaces* baked = nullptr;
    };
    // Returns at once when nothing changed that it is made from. GL state changed: programs and their slots.
    base::Steps updateInSteps(const gl::Device& device, const Inputs& inputs, ConesSettings settings);
    base::Revision revision() const { return revision_; }

    const RadianceVolume& volume() const { return volume_; }
    const light::LitFaces& faces() const { return faces_; }  // what the volume was made of, without a cache
    const ConeGather& cones() const { return cones_; }       // as the settings say
    bool shadowsByCones() const { return settings_ && settings_->shadows == ConesShadows::Cones; }

  private:
    base::Steps light(const gl::Device& device, const Inputs& inputs, const ConesSettings& settings);

    light::LitFaces faces_;
    gl::Buffer corrections_;  // of baked light, per face
    RadianceVolume volume_;
    ConeGather cones_;
    // What it was made from.
    base::Revision voxelsFrom_, lightsFrom_, bakedFrom_;
    std::optional<ConesSettings> settings_;
    base::Revision revision_;
};

}  // namespace conelight::gather
