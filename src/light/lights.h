// SPDX-License-Identifier: MIT
// Lights, as a value: what shines straight onto surfaces, ready for shaders. Scene -> the light table
// (enabled lights, and flat emitters as rectangles), their shadow maps, the sky and the environment's picture.
//
// Flat emitters (scene/emissive_quads.h) are in the table so that their light is exact and sharp in its
// shadows, where voxels would blur it. What the camera sees of the emitter does not change.
#pragma once

#include <vector>

#include "base/revision.h"
#include "base/steps.h"
#include "conelight/settings.h"
#include "gl/device.h"
#include "light/caustics.h"
#include "light/environment.h"
#include "light/lamp_tree.h"
#include "light/light_key.h"
#include "light/shadow_maps.h"
#include "scene/glass_tree.h"
#include "scene/gpu_lights.h"
#include "scene/gpu_scene.h"

namespace conelight::light {

// What a picture asks of the lights.
struct LightsWanted {
    LightSettings settings;
    bool emissiveQuads = true;  // flat emitters are in the table
    bool smallLamps = false;    // and small balls and boxes (scene/small_lamps.h)
    bool shadowMaps = true;     // they are drawn; else the table says that nothing is in shadow
    bool caustics = false;      // castCaustics will follow
    bool veils = false;         // blended surfaces hide light by their opacity, not all of it or none
    bool lampTree = false;      // where there are many, lamps are drawn by chance (LightSettings::exactLamps)
    bool operator==(const LightsWanted&) const = default;
};

class Lights {
  public:
    Lights();

    // Returns at once when neither the scene nor what is wanted has changed. GL state changed: as
    // ShadowMaps::update.
    void update(const gl::Device& device, const scene::GpuScene& scene, const LightsWanted& wanted) {
        updateInSteps(device, scene, wanted).finish();
    }
    base::Steps updateInSteps(const gl::Device& device, const scene::GpuScene& scene, LightsWanted wanted);
    // Area lights are turned about their normals by 0 to 3 quarters of a turn: as bright and as large, with sample points
    // elsewhere, and their shadow maps drawn anew. For views of a picture at rest, whose mean has the penumbra of all
    // points. Behind an update, which may turn them back. The revision stays, since faces keep their light. GL state
    // changed: as update.
    base::Steps turnInSteps(const gl::Device& device, const scene::GpuScene& scene, int quarters);
    // The light that solids of glass send on, where it was wanted and there is any: of lights and voxels as they
    // are, which have octant words then (castsCaustics). Returns at once when neither has changed.
    void castCaustics(const gl::Device& device, const scene::GpuScene& scene, const voxels::Voxels& voxels) {
        castCausticsInSteps(device, scene, voxels).finish();
    }
    base::Steps castCausticsInSteps(const gl::Device& device, const scene::GpuScene& scene,
                                    const voxels::Voxels& voxels);
    base::Revision revision() const { return revision_; }

    // LightTable, lightTexels (its bytes), LightingBlock, FixedLightBlock and FixedLightRows (the table once more, for
    // shaders that know how many lights there are), the shadow maps, and the environment's picture and the tree of glass where there are any.
    void declare(gl::Inputs& inputs) const;
    // The variant of shaders that these lights need; lamps that are drawn by chance are none of theirs.
    LightKey key() const;
    // Of shaders whose rays look punctual lights up where they hit; off where there are none, or more than
    // pays.
    HitKey hitKey(const scene::GpuScene& scene, bool exactDirect) const;

    const std::vector<gpu::Light>& table() const { return table_; }  // sorted by kind
    const glm::uvec4& ends() const { return ends_; }  // of the points, spots, directional lights, rectangles
    // Whether points and spots are drawn by chance, by a tree over them: they have no shadow maps then, and none but
    // lib/lamp_tree.glsl gives their light.
    bool drawsLamps() const { return !lamps_.empty(); }
    LampKey lampKey() const;
    const LampTable& lamps() const { return lamps_; }
    // Whether an instance's emission arrives from an area light of the table: voxels leave it out.
    bool areInTable(std::size_t instance) const { return emitters_[instance] != 0; }
    bool hasGlass() const { return !glass_.empty(); }  // or veils, which light passes, too
    bool drawsGlass() const { return glass_.holdsGlass(); }
    bool hasVeils() const { return shadows_.leavesVeils(); }
    bool castsCaustics() const;
    bool hasCaustics() const { return caustics_.any(); }
    const Caustics& caustics() const { return caustics_; }
    bool hasEnvironment() const { return environment_.hasPicture(); }
    // A picture's bright parts are aimed at; of a constant sky rays learn where it is seen (light/sky_guide.h).
    bool guidesToSky() const { return hasConstantSky_ && !hasEnvironment(); }
    int redrawnShadowMaps() const { return shadows_.redrawn(); }
    std::size_t shadowBytes() const { return shadows_.bytes(); }  // of the shadow maps

  private:
    void fillTable(const scene::GpuScene& scene, const LightsWanted& wanted);
    void addEmitter(const Light& light, std::size_t instance);
    bool wantsTree(const scene::GpuScene& scene, const LightsWanted& wanted) const;
    bool drawsAreaShadows() const;
    base::Steps drawShadows(const gl::Device& device, const scene::GpuScene& scene, LightSettings settings,
                            bool veils);
    void updateProfiles(scene::Profiles profiles);
    void makeTable();
    void upload(const Scene& scene);

    gl::ExecutionProfile profile_ = gl::ExecutionProfile::Processor;
    std::vector<gpu::Light> table_;
    bool shaped_ = false;  // LightKey
    scene::Profiles profiles_;
    gl::Texture profileMap_;  // one layer each
    glm::uvec4 ends_{0};
    std::vector<char> emitters_;  // per instance
    gl::Buffer tableBuffer_, block_;
    gl::Texture tableTexels_;        // over the table
    std::uint32_t lampsOfTree_ = 0;  // the first ones of the table
    LampTable lamps_;
    ShadowMaps shadows_;
    EnvironmentTable environment_;
    bool hasConstantSky_ = false;
    scene::GlassTree glass_;  // that light passes
    Caustics caustics_;
    base::Revision lightsOfCaustics_, voxelsOfCaustics_;  // that they were made from
    base::Revision ownRevision_;                          // of all but them

    // What it was made from.
    struct Sources {
        base::Revision scene, geometry, lights, sky;
        LightsWanted wanted;
        bool operator==(const Sources&) const = default;
    };
    Sources from_;
    int quarters_ = 0;      // that area lights of the table are turned by, 0 to 3
    bool turning_ = false;  // not all of their maps are
    base::Revision revision_;
};

}  // namespace conelight::light
