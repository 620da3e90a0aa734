// SPDX-License-Identifier: MIT
// The balance of the irradiance cache (docs/theory/4d_cache.md, "The balance of light"): by what each face has gathered, the
// light of all of them is made what it will be when all bounces have settled. One factor for each colour channel, so that
// white rooms are bright after a few updates.
#pragma once

#include <cstddef>
#include <vector>

#include "gl/device.h"
#include "light/lit_faces.h"
#include "shared/irradiance.h"
#include "voxels/surface_voxels.h"

namespace conelight::light {

class LightBalance {
  public:
    struct Faces {
        const voxels::SurfaceVoxels& surface;
        const LitFaces& lit;
        const gl::Buffer& states;  // gpu::FaceCache per face: what is corrected
        const gl::Texture& stateTexels;
    };
    // An update of all faces.
    struct Update {
        int number;  // since light changed, from 1: later ones weigh less
        float part;  // of the faces that were visited at a time, (0,1]
    };

    // Room for so many faces; before updates, which write what they gather.
    void reserve(std::size_t faces);
    void release();  // until then
    enum class Restart {
        Dark,        // no face had light: it is corrected at once
        Everything,  // all light is another: it is corrected when means of what was there are gone, in steps
        Edits,  // near some places: means of many updates know more than a few new ones, nothing is corrected
    };
    // What was gathered is of other light.
    void restart(Restart kind) {
        measured_ = false;
        restart_ = kind;
    }
    // Before an update: adds up the light of all faces, if that is not known.
    void begin(const gl::Device& device, const Faces& faces);
    // After an update that has begun so: corrects the light of all faces. Without begin() it does nothing.
    void correct(const gl::Device& device, const Faces& faces, const Update& update);

    void declare(gl::Inputs& inputs) const;  // GatheredTable, which updates write
    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void addUp(const gl::Device& device, const Faces& faces, const gpu::CacheBalancing& how);

    gl::Buffer gathered_, groupSums_, balance_, block_;
    gl::Texture gatheredTexels_;
    bool hadFaces_ = false;
    Restart restart_ = Restart::Dark;
    bool measured_ = false;  // balance_ holds the light of all faces as it is
};

}  // namespace conelight::light
