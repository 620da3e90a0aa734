// SPDX-License-Identifier: MIT
// Indirect light per voxel face, kept in world space over frames: rays from each face gather what other faces
// show, their own cached light included, so that every update adds a bounce. Estimator and schedule:
// docs/theory/4d_cache.md, "The cache". Part of light::LitVoxels, which says when what is called.
//
// The same calls give the same bits: rays read the light of the update before, and all sums have an order.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "light/edits.h"
#include "light/face_order.h"
#include "light/light_balance.h"
#include "light/light_samples.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "light/sky_guide.h"
#include "scene/gpu_scene.h"
#include "shared/irradiance.h"
#include "voxels/voxels.h"

namespace conelight::light {

struct CacheSettings {
    int cosineRays = 2;  // cosine-sampled rays per face and update; 1..64
    int lightRays = 2;   // light-sampled rays per face and update; 0..64
    // Faces that one update visits at most, in turn; 0: all. Rays per frame are this times the rays per face.
    std::uint32_t facesPerUpdate = 0;
    int longestWindow = 256;  // updates that are averaged in the end
    bool averages = true;     // false: every update replaces what was there, for a limited number of bounces
    int reflections = 1;      // of one ray on metals; then all but lights is reflected as if diffuse; 0..8
    bool exactDirect = true;  // light of point, spot and directional lights is looked up where rays hit
    std::uint32_t seed = 1;
    bool operator==(const CacheSettings&) const = default;
};

class IrradianceCache {
  public:
    // What updates read; they write the irradiance of `faces`.
    struct Inputs {
        const scene::GpuScene& scene;
        const Lights& lights;
        const voxels::Voxels& voxels;     // with octant words
        const gl::Texture& directTexels;  // R32UI: light of faces that is not looked up at hits
        const LitFaces& faces;            // lit directly (injectLight)
    };

    // Takes up voxels. Each face gets the light of the face that lay there and looked the same way in the
    // voxels before (voxels.previous()) if these are the ones that the cache holds; else it starts dark.
    // Counts as a change of light.
    void adopt(const gl::Device& device, const voxels::Voxels& voxels) {
        adoptInSteps(device, voxels, {}).finish();
    }
    // Averages far from what changed, at most CHANGED_PLACES of a kind, stay longer (docs/theory/4d_cache.md, "Things that
    // move"). Left before it is done, it is to be done again, for the same voxels or others, before update().
    base::Steps adoptInSteps(const gl::Device& device, const voxels::Voxels& voxels, SceneEdits changed);
    // Direct light, emission or the sky is another: short averages again, until bounces have settled.
    void restartAverages(const SceneEdits& changed = {});

    // Visits faces `passes` times over (facesPerUpdate each). GL state changed: program and its slots.
    void update(const gl::Device& device, const Inputs& inputs, const CacheSettings& settings,
                int passes = 1) {
        updateInSteps(device, inputs, settings, passes).finish();
    }
    // Left before it is done, it has visited some faces once more than the others.
    base::Steps updateInSteps(const gl::Device& device, const Inputs& inputs, const CacheSettings& settings,
                              int passes);

    // Draws other light samples of the same light: pixels whose rays all share one draw show its error.
    base::Steps redrawInSteps(const gl::Device& device, const Inputs& inputs, std::uint32_t draw);

    // Frees what updates of a cache that is to be seen at once, and draws, need beside its light; they take it again.
    void endSharing();

    // Whether bounces have settled since the last change, so that all further updates only average noise
    // away.
    bool settled() const;
    int updates() const;  // whole rounds over all faces since the last change
    // Both wait where a GPU has not counted them yet.
    std::uint32_t faces() const { return order_.visited(); }  // of a round
    std::uint64_t visits() const {                            // of faces, ever
        know();
        return visits_;
    }

    void declare(gl::Inputs& inputs) const;  // lightSamples, faceLight, skyGuide
    const LightSamples& samples() const { return samples_; }
    const SkyGuide& guide() const { return guide_; }
    const gl::Buffer& state() const { return states_; }          // gpu::FaceCache per face, for tests
    const gl::Buffer& atPixels() const { return faceLight_; }    // two uints per face, faceLight, for tests
    const gl::Buffer& order() const { return order_.buffer(); }  // a face per place, for tests

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void reserve(std::uint32_t faces);
    void reproject(const gl::Device& device, const voxels::Voxels& voxels, const voxels::VoxelKeys& old);
    base::Steps sort(const gl::Device& device, const voxels::SurfaceVoxels& surface, bool searches);
    std::uint32_t perUpdate(const CacheSettings& settings) const;
    std::uint64_t searchedRays() const;  // after so many all faces inside closed objects are known
    gpu::CacheConstants packed(const CacheSettings& settings, std::uint32_t first = 0,
                               std::uint32_t count = 0) const;
    // The part of the faces that gather in which an update looks for those inside closed objects.
    struct VisitPart {
        std::uint32_t part, parts;
        std::uint32_t begin(std::uint64_t faces) const {
            return static_cast<std::uint32_t>(part * faces / parts);
        }
        std::uint32_t end(std::uint64_t faces) const {
            return static_cast<std::uint32_t>((part + std::uint64_t{1}) * faces / parts);
        }
    };
    // An update of all faces while their number was on its way from the GPU.
    struct LateUpdate {
        VisitPart searched;
        int rays;
    };
    VisitPart nextSearched() const;
    gl::Inputs givenToUpdates(const Inputs& inputs) const;
    static HitKey hitsOf(const Inputs& inputs, const CacheSettings& settings);
    bool goesUncounted(const CacheSettings& settings) const;
    void visitUncounted(const gl::Device& device, const Inputs& inputs, const CacheSettings& settings);
    void know() const;
    struct Visit;
    base::Steps visitRange(const Visit& visit, std::uint32_t first, std::uint32_t end);
    base::Steps visitFaces(const Visit& visit, std::uint32_t first, std::uint32_t end, bool findsBacks);
    base::Steps visitAll(const gl::Device& device, const Inputs& inputs, const CacheSettings& settings,
                         std::uint32_t count);
    base::Steps commit(const gl::Device& device, const Inputs& inputs, const CacheSettings& settings,
                       bool atPixels);
    void scale(const gl::Device& device, const voxels::SurfaceVoxels& surface) const;
    base::Steps putLight(const gl::Device& device, const Inputs& inputs, const CacheSettings& settings,
                         bool atPixels);

    gl::Buffer states_, oldStates_, faceLight_, sharedLight_, constants_, reprojectionBlock_, oldLevelBlock_,
        ranges_, rangeBlock_;
    gl::Texture faceLightTexels_, sharedLightTexels_, stateTexels_, oldStateTexels_;
    LightSamples samples_;
    SkyGuide guide_;
    CacheSettings committedWith_;
    FaceOrder order_;
    LightBalance balance_;
    base::Revision voxelsFrom_;  // whose faces these are
    std::uint32_t faceCount_ = 0;
    bool carried_ = false;   // the voxels took over light from those before
    bool adopting_ = false;  // the last adoption was left: light of the voxels before is in oldStates_,
    bool hadFaces_ = false;  // if there is any

    bool prepared_ = false;  // pool and lit faces say what the states and the direct light say
    bool restarts_ = false;
    bool dark_ = true;  // no face has light
    SceneEdits restartsNear_;
    std::uint32_t updatesMade_ = 0;              // ever
    bool unfinished_ = false;                    // the last one was left
    std::uint32_t updatesOfVoxels_ = 0;          // calls of update() for these voxels
    std::uint32_t firstFace_ = 0;                // where the next update begins
    mutable std::vector<LateUpdate> uncounted_;  // since faces were sorted
    mutable std::uint64_t facesVisited_ = 0;     // since light changed
    mutable std::uint64_t visits_ = 0;
    mutable std::uint64_t raysTested_ =
        0;  // cosine rays that looked for faces inside objects, since voxels changed
};

}  // namespace conelight::light
