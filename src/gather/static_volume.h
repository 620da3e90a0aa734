// SPDX-License-Identifier: MIT
// The part of the scene that does not move, as a value: instances that stand where their light was baked -> a scene
// of them alone, its lights with their shadows, voxels, and a radiance volume whose faces send out baked light. Made
// once; what moves does not touch it.
//
// Limit: the part has tables, textures and shadow maps of its own on the GPU.
#pragma once

#include <optional>
#include <vector>

#include "gather/cone_volume.h"
#include "light/baked_faces.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::gather {

class StaticVolume {
  public:
    struct Inputs {
        const scene::GpuScene& scene;   // the whole of it
        const voxels::VoxelGrid& grid;  // of the voxels of the whole
        const light::LightsWanted& wanted;
    };
    // Returns at once when nothing changed that it is made from; nothing is made where nothing is baked. GL state
    // changed: as Lights::update.
    base::Steps updateInSteps(const gl::Device& device, const Inputs& inputs, const VoxelSettings& voxels,
                              const ConesSettings& settings);
    explicit operator bool() const { return scene_.has_value(); }  // whether anything is baked

    const voxels::Voxels& voxels() const { return voxels_; }
    const ConeVolume& volume() const { return volume_; }
    const light::BakedFaces& faces() const { return faces_; }

  private:
    bool takeScene(const scene::GpuScene& scene);
    void correct(const gl::Device& device, const ConesSettings& settings);

    std::optional<scene::GpuScene> scene_;
    light::Lights lights_;
    voxels::Voxels voxels_;
    light::BakedFaces faces_;
    ConeVolume volume_;

    // What it was made from.
    std::vector<base::Revision> instancesFrom_;  // none for those that are not baked
    base::Revision sceneFrom_, lightsFrom_, skyFrom_, bakedFrom_, voxelsFrom_;
    base::Revision correctedFrom_;  // volume
    std::optional<ConesSettings> correctedWith_;
};

}  // namespace conelight::gather
