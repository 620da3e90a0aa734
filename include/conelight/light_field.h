// SPDX-License-Identifier: MIT
// Indirect light for a renderer of one's own: the host draws its picture, this tells the light that arrives
// at each of its pixels. Scene + lights in, kept up to date by a budget per frame; G-buffer of the host in;
// irradiance and radiance of reflections out, as textures. docs/guide/light_field.md
//
// Load time: make a 4.5 core context current, construct a LightField, setScene, addView. Each frame: changes
// of the scene, update(), the host's G-buffer, gather(), the host's own shading. All calls leave the context's
// state as they found it. One thread at a time, the one on which the context is current.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "conelight/host_mesh.h"
#include "conelight/host_texture.h"
#include "conelight/renderer.h"
#include "conelight/scene.h"
#include "conelight/settings.h"

namespace conelight {

// How the texels of a normal texture say a unit vector.
enum class NormalEncoding : std::uint8_t {
    World,       // xyz, world space, as floats or signed
    WorldUnorm,  // 0.5 xyz + 0.5
    View,        // as World, of view space
    ViewUnorm,
    Octahedral  // xy in [-1,1], world space: Cigolle et al. 2014, "A Survey of Efficient Representations for
                // Independent Unit Vectors"
};

// A picture that the host has drawn: GL names of textures of target GL_TEXTURE_2D, width x height texels, the
// row at clip y = -1 first. They are read at level 0, by samplers of ours, and never written.
struct HostSurfaces {
    int width = 0, height = 0;
    // From world to clip space, as the pixels were drawn: any perspective, jittered, off-centre, mirrored,
    // left-handed, reversed or infinite; or parallel rays, where `background` tells the far end of depths: below
    // one half it is 0.
    glm::mat4 viewFromWorld{1.0f};
    glm::mat4 clipFromView{1.0f};
    bool clipDepthZeroToOne = false;  // glClipControl(.., GL_ZERO_TO_ONE)
    std::uint32_t depth = 0;          // x: as in the depth buffer, [0,1]
    float background = 1.0f;          // depth where nothing was drawn; 0 with reversed depths
    std::uint32_t normal = 0;         // for shading
    // Of triangles; 0: from the depths of neighbouring pixels.
    std::uint32_t geometricNormal = 0;
    NormalEncoding normalEncoding = NormalEncoding::World;  // of both
    // Perceptual roughness, [0,1], in one channel of it. 0: all is rough, no reflections are traced.
    std::uint32_t roughness = 0;
    int roughnessChannel = 0;
    std::uint32_t reflectance = 0;  // rgb: at normal incidence (F0), linear; 0: 0.04
    // GL_R16UI or GL_R32UI: index into the instances of the scene. Tells where the surface of a pixel was, when
    // things move or bend (setInstance, setMesh). 0: none; means of moving things are then kept where they happen to
    // match.
    std::uint32_t instances = 0;
    // Where the surface of a pixel was in the picture of the view before, less where it is: xy of it times
    // motionScale, in parts of the picture's size, as texture coordinates count. z, if there is one, is by how much
    // the surface's own movement has changed its view depth since, then less now, m. It takes the place of
    // `instances` for that. 0: none; best also where nothing moves.
    std::uint32_t motion = 0;
    glm::vec2 motionScale{1.0f};
};

// How much a call of update() does, when traced.budgeted is on: it ends when any of these is used up.
struct LightBudget {
    int updates = 1;  // of the light of faces, at most
    int faces = 0;    // in each of them, at most; 0: all
    // From the begin of the call on; 0: no limit. Some faces are updated all the same. Without it the same calls
    // give the same bits, with it light gets as far as the machine does. The call waits for a software driver; a
    // GPU is not waited for, and is given as many faces as it managed in that time before.
    double milliseconds = 0;
};

struct GatherOptions {
    // Rays are traced for one of reduction x reduction pixels, 1 to 4; the others take what the nearest of these
    // show of the same surface.
    int reduction = 1;
};

// What arrives at the host's pixels: GL names of textures of target GL_TEXTURE_2D, GL_RGBA16F, of the size of
// HostSurfaces, a: 1 where a surface was seen. Owned by the field; valid until the next gather() of the view.
struct GatheredLight {
    std::uint32_t diffuse = 0;  // indirect irradiance / pi, W/(sr m^2): times albedo is radiance
    std::uint32_t specular =
        0;  // mean radiance in the specular lobe, W/(sr m^2): times its albedo is radiance
    int width = 0, height = 0;
};

// What a field holds, and what its last update() did. On a GPU stats() waits for the numbers of voxels and faces, where
// they have changed since the last frame: hosts that draw without a stop ask for it rarely.
struct LightFieldStats {
    std::size_t voxels = 0, faces = 0;  // of the grid; light is kept per face
    // Whose light the last update() renewed; one that was renewed twice counts twice.
    std::uint64_t facesUpdated = 0;
    // How often the last update() and the calls of gather() since have waited for the GPU, as in FrameStats.
    std::uint64_t waits = 0;
    // Of the last update() and of the calls of gather() since; empty unless profiling is on. "update" and "gather" hold
    // those that follow with their name in front, such as "update/voxelize: mark".
    std::vector<PassStats> passes;
    std::vector<MemoryStats> memory;  // GL objects of this field that have storage, largest first
    std::string device;
};

// Where shaders of the host that include conelight/light_field.glsl find what they read: so many binding points of
// uniform blocks and texture units, from the first on.
struct LookupSlots {
    static constexpr int kBlocks = 3, kTextures = 7;
    int firstBlock = 0;
    int firstTexture = 0;
};
// The text of conelight/light_field.glsl for these slots; it goes behind the line of #version. Names begin with
// conelight_: vec3 conelight_irradiance(vec3 position, vec3 normal), vec3 conelight_trace(vec3 origin, vec3 direction),
// float conelight_voxelSize(vec3 position). One text reads one grid and nested ones.
CONELIGHT_API std::string lookupsGlsl(const LookupSlots& slots = {});

// Settings for pictures that move: traced.budgeted is on, and traced.cache_updates is 32 at least, as shaders of the host
// see single faces. LightField reads the groups voxels, light, traced.
CONELIGHT_API Settings realtimeSettings(Quality quality = Quality::Interactive);

class CONELIGHT_API LightField {
  public:
    // Throws Error(NoGl) without a current 4.5 context.
    explicit LightField(const RendererOptions& options = {});
    ~LightField();
    LightField(const LightField&) = delete;
    LightField& operator=(const LightField&) = delete;

    // As those of Renderer (conelight/renderer.h), which say what they throw. Materials and textures matter for
    // the light that surfaces send out; how they look is the host's business.
    void setScene(const Scene& scene);
    void setInstance(std::size_t index, const Instance& instance);
    void setMesh(std::size_t index, const Mesh& mesh);
    void setMesh(std::size_t index, const HostMesh& mesh);
    void setTexture(std::size_t index, const Texture& texture);
    void setTexture(std::size_t index, const HostTexture& texture);
    void setMaterial(std::size_t index, const Material& material);
    void setLight(std::size_t index, const Light& light);
    void setLights(const std::vector<Light>& lights);
    void setSky(const glm::vec3& radiance);
    void setEnvironment(const Environment& environment);
    // Further entries in place, each returns its index; what is there keeps its own. addInstance may give the index of
    // an instance that was removed, addMesh that of a mesh. Light elsewhere stays as settled as it is. What was removed
    // stays in scene(), invisible or empty, and no other call takes it. Throw as those above; removeMesh also
    // Error(Usage) while an instance has the mesh.
    std::size_t addMesh(const Mesh& mesh);
    std::size_t addMesh(const HostMesh& mesh);
    std::size_t addTexture(const Texture& texture);  // for materials that are set or added after it
    std::size_t addTexture(const HostTexture& texture);
    std::size_t addMaterial(const Material& material);
    std::size_t addInstance(const Instance& instance);
    void removeInstance(std::size_t index);
    void removeMesh(std::size_t index);
    // Where voxels are, m, whatever the scene's size: what lies outside is lit by them and seen, but neither occludes
    // nor bounces light. Empty: where the scene's voxelized instances are. Holds for later scenes too, and may be set
    // before the first. Throws Error(BadInput) for a box that is not finite.
    void setRegion(const Aabb& region);
    const Scene& scene() const;

    // From the next update() on; realtimeSettings() at first. Throws Error(Usage) for values out of range. Nested grids
    // (voxels.levels) take an anchor, for a field has no eye; without one there is one grid.
    void setSettings(const Settings& settings);
    const Settings& settings() const;

    // Voxels and light of the scene as it is, by as much work as the budget allows; all of it when
    // traced.budgeted is off. Returns the updates that faces have had since the light changed, at most
    // traced.cache_updates: what they show is steady then.
    int update(const LightBudget& budget = {});

    // A view has a history of its own: means over frames, of one camera. Numbers of removed views are not
    // given again.
    int addView();
    void removeView(int view);

    // Light at the host's pixels. A call is one pass of rays with traced.budgeted on, all passes of a finished
    // picture with it off. Call it once per view and frame. Throws Error(Usage) for an unknown view, before the
    // first update(), and for surfaces that are incomplete. Surfaces of 0 x 0, of a window that is minimised, give
    // no textures.
    GatheredLight gather(int view, const HostSurfaces& surfaces, const GatherOptions& options = {});

    // For draw calls and dispatches of the host's whose shaders include conelight/light_field.glsl: binds what they
    // read, light as the last update() left it. The slots stay bound, the rest of the state as it was; after the
    // next update() or setScene() bind again. Throws Error(Usage) before the first update() and for slots that the
    // driver has not.
    void bindLookups(const LookupSlots& slots = {}) const;

    // Timings per pass cost a glFinish each on software drivers, and a wait for the GPU in stats() elsewhere.
    void setProfiling(bool on);
    const LightFieldStats& stats() const;  // valid until the next call of it

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight
