// SPDX-License-Identifier: MIT
// Lit voxels, as a value: voxels + lights -> what light every voxel face holds, direct and indirect, ready
// for rays and pixels. relight() brings it up to date by as much work as a call may do.
#pragma once

#include <cstdint>
#include <optional>

#include "base/revision.h"
#include "base/steps.h"
#include "conelight/settings.h"
#include "gl/device.h"
#include "light/edit_places.h"
#include "light/emission_fit.h"
#include "light/irradiance_cache.h"
#include "light/lamp_faces.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::light {

// How indirect light is gathered. Other settings make other light: it starts anew.
struct RelightSettings {
    int updates = 32;            // of all faces until light is left as it is
    int rays = 2;                // of each technique, per face and update
    std::optional<int> bounces;  // of the picture; none: all. Limited: an update is a bounce
    bool exactHits = true;       // CacheSettings::exactDirect
    bool operator==(const RelightSettings&) const = default;
};

RelightSettings relightSettings(const TracedSettings& settings);

// Of `updates`, what so many faces need: the more there are, the more of them the rays of a picture meet, and the more noise
// may be left on each (docs/theory/4d_cache.md, "Updates of many faces").
int updatesOfFaces(int updates, std::uint32_t faces);

// How much a call of relight() does.
struct Budget {
    bool oneUpdate = false;   // else all updates that are missing
    std::uint32_t faces = 0;  // of one update; 0: all
    bool nothing = false;     // unless there is no light at all for these voxels and lights
};

class LitVoxels {
  public:
    struct Inputs {
        const scene::GpuScene& scene;
        const Lights& lights;
        const voxels::Voxels& voxels;  // with octant words
    };

    // Light of voxels and lights as they are. Light of other voxels is reprojected to those that lie where it
    // was; with a limited number of bounces, or other settings of a picture that is finished at once, it
    // starts in the dark. GL state changed: programs and their slots.
    void relight(const gl::Device& device, const Inputs& inputs, const RelightSettings& settings,
                 const Budget& budget) {
        relightInSteps(device, inputs, settings, budget).finish();
    }
    base::Steps relightInSteps(const gl::Device& device, const Inputs& inputs,
                               const RelightSettings& settings, const Budget& budget);

    // Draws other light samples of the same light, for pixels that average several draws; endDraws() frees what that takes.
    base::Steps redrawInSteps(const gl::Device& device, const Inputs& inputs, std::uint32_t draw);
    void endDraws() { cache_.endSharing(); }

    // Takes light over to voxels that a picture has left behind, before they become others: it goes from voxels to the
    // next ones only.
    base::Steps followVoxels(const gl::Device& device, const voxels::Voxels& voxels);

    // Raised by each call that changed any light.
    base::Revision revision() const { return revision_; }
    // Raised by each call that found other voxels or lights: what was gathered from the light before is old.
    base::Revision sources() const { return sources_; }
    // Of the light that changed() is a change of.
    base::Revision sourcesBefore() const { return sourcesBefore_; }
    // Since the light changed, at most RelightSettings::updates: then it is left as it is.
    int updates() const;
    // That an update of all visits; 0 at first.
    std::uint32_t facesPerUpdate() const { return cache_.faces(); }
    std::uint64_t faceVisits() const { return visitsBefore_ + cache_.visits(); }  // by updates, ever
    // Of the change that sources() was raised for last.
    const SceneEdits& changed() const { return changed_; }
    // Whether means are long enough to be averaged over many frames.
    bool steady() const;
    const LitFaces& faces() const { return faces_; }
    const IrradianceCache& cache() const { return cache_; }

    void declare(gl::Inputs& inputs) const;  // litFaces, cachedDirect, lightSamples, faceLight

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    int wantedUpdates() const;
    int missingUpdates() const;
    base::Steps putDirectLight(const gl::Device& device, const Inputs& inputs);
    base::Steps update(const gl::Device& device, const Inputs& inputs, const Budget& budget);
    base::Steps drawLamps(const gl::Device& device, const Inputs& inputs, std::uint32_t faces, int rounds);

    LitFaces faces_;
    gl::Buffer directLight_;  // a uint per face (cachedDirect of shared/irradiance.h)
    gl::Texture directTexels_;
    EmissionFit fit_;
    LampFaces lamps_;
    IrradianceCache cache_;
    std::uint64_t visitsBefore_ = 0;  // by caches that were given up
    EditPlaces places_;
    SceneEdits changed_;      // by the last change; some: it was taken as one of near faces alone
    bool directDue_ = false;  // direct light is that of other voxels or lights

    // What it was made from.
    base::Revision voxelsFrom_, lightsFrom_;
    VoxelSettings voxelSettings_;
    voxels::VoxelGrid grid_;
    RelightSettings settings_;
    base::Revision revision_, sources_, sourcesBefore_;
};

}  // namespace conelight::light
