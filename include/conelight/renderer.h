// SPDX-License-Identifier: MIT
// The renderer: Scene + Camera + Settings -> a picture in a GL texture.
//
// Load time: make a 4.5 core context current, construct a Renderer, setScene. Render time: render() as often
// as you like; it leaves the context's state as it found it (docs/guide/embed.md lists what is saved).
// One thread at a time, the one on which the context is current.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/host_mesh.h"
#include "conelight/host_texture.h"
#include "conelight/inspect.h"
#include "conelight/program_cache.h"
#include "conelight/scene.h"
#include "conelight/settings.h"

namespace conelight {

// Linear RGBA float pixels, first row on top. rgb is radiance (or what the component shows), a is 1 where a
// surface was seen and 0 in the background; of anti-aliased stills, the part of the pixel that shows one.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> pixels;
};

struct PassStats {
    std::string name;
    double cpuMs = 0;
    double wallMs = 0;
    double gpuMs = -1;  // < 0: not measured
};

// What a compute program was given to do in a pass.
struct DispatchStats {
    std::string pass;
    std::string program;  // its file and what is defined in it, as --shaders of `conelight bench` has them
    std::uint64_t dispatches = 0, invocations = 0;
};

struct MemoryStats {
    std::string label;
    std::size_t bytes = 0;
};

struct FrameStats {
    std::vector<PassStats> passes;  // empty unless profiling is on
    double cpuMs = 0, wallMs = 0;   // of the whole render call
    // Lookups: texture fetches of cones, by kind, mean per picture pixel; empty unless counting is on.
    std::vector<std::pair<std::string, double>> lookupsPerPixel;
    // How often the driver was asked to draw meshes. On a GPU one call draws all that needs no change between.
    std::uint64_t drawCalls = 0;
    // How often the call has waited for the GPU to tell what it had counted: each stops a GPU's work (docs/guide/embed.md).
    std::uint64_t waits = 0;
    std::vector<DispatchStats> dispatches;  // empty unless they are counted
    std::vector<MemoryStats> memory;        // GL objects of this renderer that have storage, largest first
    std::string device;
};

// What drawing is at: a pass by its name in FrameStats, "building programs" with the number of the one that is built,
// "textures" that are handed to the driver.
struct PictureWork {
    std::string name;                 // empty: nothing was begun
    std::size_t done = 0, total = 0;  // total 0: not known
};

// How passes that write each pixel once are run. Auto: as suits the driver. Processor: as fragments, which software
// drivers store tile by tile. Gpu: as compute; server GPUs shade fragments at a small part of their rate.
enum class Execution { Auto, Processor, Gpu };

// Which row of a picture comes first in textures that a renderer hands out or fills: the lowest, as OpenGL counts texture
// coordinates, or the top one, as Vulkan, Direct3D and files of pictures have it. Pictures in memory (Image, bytes) have
// the top row first in either case.
enum class RowOrder { BottomFirst, TopFirst };

struct RendererOptions {
    std::string shaderDirectory;  // empty: the embedded shaders; else files there win (for development)
    // Takes the context's KHR_debug callback: errors of the driver go to the log.
    bool reportGlErrors = false;
    Execution execution = Execution::Auto;
    std::shared_ptr<ProgramCache> programs =
        {};  // keeps linked programs; null: each start builds all of them
    // Of imageTexture, displayTexture and copyToTexture. Those of a LightField are ordered as the host's own.
    RowOrder rows = RowOrder::BottomFirst;
};

class CONELIGHT_API Renderer {
  public:
    // Throws Error(NoGl) without a current 4.5 context.
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Copies and uploads the scene. Throws Error(BadInput) when Scene::validate does.
    void setScene(const Scene& scene);

    // Changes of the scene in place: each uploads just what it names, and the next render() makes anew what
    // depends on it. Indices are those of the scene's vectors. The voxel grid stays where setScene put it and
    // grows by whole bricks when something moves out of it (docs/guide/embed.md, "Things that move").
    // Throw Error(Usage) before setScene or for an index out of range, Error(BadInput) for what
    // Scene::validate refuses; nothing is changed then. GL state stays as it was.
    // setInstance: transform, material, flags; the mesh must be the one it has.
    void setInstance(std::size_t index, const Instance& instance);
    // setMesh: new positions, normals and so on, as many vertices and indices as the mesh has, normals where it
    // has them: for things that bend and deform. Its instances are made anew.
    void setMesh(std::size_t index, const Mesh& mesh);
    // A mesh that the host has on the GPU (conelight/host_mesh.h), as many vertices and indices as it had when it was
    // added. It is opaque, whatever its material transmits, and scene() has an empty mesh in its place.
    void setMesh(std::size_t index, const HostMesh& mesh);
    // setTexture: new texels, of any size, for the materials that have it. One texel gives the memory of many back.
    void setTexture(std::size_t index, const Texture& texture);
    // One that the host has on the GPU (conelight/host_texture.h); scene() has one white texel in its place. Either kind
    // may follow the other.
    void setTexture(std::size_t index, const HostTexture& texture);
    void setMaterial(std::size_t index, const Material& material);
    void setLight(std::size_t index, const Light& light);
    void setLights(const std::vector<Light>& lights);  // all of them: adds and removes
    void setSky(const glm::vec3& radiance);            // W/(sr m^2)
    void setEnvironment(const Environment& environment);
    void setBakedLight(std::shared_ptr<const BakedLight> baked);  // null: none
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
    // The renderer's copy, with all changes; valid until the next setScene.
    const Scene& scene() const;

    // Timings per pass cost a glFinish each on software drivers. Counting lookups makes cone passes slower. Counting
    // dispatches reads those of lists back; pictures in parts leave it out.
    void setProfiling(bool passes, bool lookups, bool dispatches = false);

    // Draws one picture, width x height in [1, 16384]; a 0, of a window that is minimised, leaves the last one.
    // Voxels and light are made anew only where the scene or a setting they depend on changed since the last
    // call; all of them when `dynamic` (setDynamic) is on. Throws Error(Usage) for settings out of range and a
    // camera that sees nothing, Error(Runtime) for failures of the driver.
    void render(const Camera& camera, int width, int height, const Settings& settings);
    void setDynamic(bool everyFrame);
    // While held, a picture of mode traced with traced.budgeted and image.temporal gathers no light where scene, camera
    // and settings are those of the call before: it adds one more view to the mean, within pixels and on the lens.
    void setLightHeld(bool held);
    // A light at the eye, for looking round where a scene has little: irradiance, W/m^2, on surfaces that face the eye,
    // which scatter it evenly. It is no light of the scene: it casts no shadow, bounces nowhere, and nothing but the
    // picture is made anew when it or the camera changes. 0, at first: none. Throws Error(Usage) below 0 and for what is
    // not finite.
    void setHeadlight(float irradiance);
    // The same picture in parts, for a window that answers between them: begin() takes what render() takes and throws
    // what it throws of it; each goOn() draws for about so many milliseconds, one piece of work at least, and returns
    // whether the picture is finished. It has the bits that render() gives. Results are those of the last picture that
    // was finished, whose texture is another then. Only a software driver draws in parts; on a GPU the first goOn()
    // draws all. drop() ends a picture that nobody wants; so do render(), begin(), inspectPixel(), reloadShaders() and
    // every change of the scene. What it has found of light that has not changed stays. goOn() throws as render(),
    // Error(Usage) when there is none to go on with.
    void begin(const Camera& camera, int width, int height, const Settings& settings);
    bool goOn(double milliseconds);
    void drop();
    bool drawing() const;  // a picture was begun and is not finished
    // The last piece of work that setScene(), render() or goOn() began. It may be asked from any thread, also while
    // one of these runs on another.
    PictureWork work() const;
    // With RendererOptions::shaderDirectory: builds the programs again that use files changed there. One that
    // fails stays as it was. Returns a message per failure, several lines each; GL state stays as it was.
    std::vector<std::string> reloadShaders();

    // Results of the last render().
    Image readImage() const;  // waits for the GPU
    // How the light of pixel (x, y), counted from the upper left corner, was gathered in the last picture:
    // its cones or rays once more, recorded (conelight/inspect.h). The picture stays as it is. Mode phong
    // gathers nothing. What the shown component does not need is gathered for this. Throws Error(Usage)
    // before the first render() and for a pixel outside the picture.
    PixelInspection inspectPixel(int x, int y);
    // The picture, linear: GL_TEXTURE_2D, RGBA32F, rows as RendererOptions::rows has them, owned by the renderer. With the
    // top row first each call copies it. 0 before the first render().
    std::uint32_t imageTexture() const;
    // The picture as a screen shows it (what toneMapped gives): GL_TEXTURE_2D, RGBA8, rows in the same order.
    // Drawn anew at each call; owned by the renderer. 0 before the first render().
    std::uint32_t displayTexture(const ImageSettings& settings);
    // Copies the last picture, linear, into what the host draws to: a framebuffer (0: the default one), lower left
    // corner at (x, y), all its colour buffers; or a GL_TEXTURE_2D of the picture's size, rows as RendererOptions has them.
    // Throw Error(Usage) before the first render() and for a target that does not do.
    void copyToFramebuffer(std::uint32_t framebuffer, int x, int y) const;
    void copyToTexture(std::uint32_t texture) const;
    const FrameStats& stats() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Exposure, stops, that shows the picture's mean log luminance as middle grey; a tenth of its pixels, the
// darkest, and a twentieth, the brightest, do not count. 0 where all is black.
CONELIGHT_API float autoExposure(const Image& image);

// The colour of ExposureCheck::FalseColor for a luminance so many stops above middle grey (0.18, after exposure), RGB.
// One colour a stop from -6 to 6, middle grey as grey; black below, white above.
CONELIGHT_API glm::u8vec3 falseColor(float stops);

// 8-bit picture bytes (RGB, first row on top) of a linear image: exposure, white balance, tone map, sRGB encoding, or
// the check of exposure that is asked for.
CONELIGHT_API std::vector<std::uint8_t> toneMapped(const Image& image, const ImageSettings& settings);
// The same with 16 bits a channel.
CONELIGHT_API std::vector<std::uint16_t> toneMapped16(const Image& image, const ImageSettings& settings);

// The picture without the surroundings behind it: a is the part of a pixel that surfaces cover, rgb their light
// times it (associated alpha). `image`: of this scene and camera.
CONELIGHT_API Image foreground(const Image& image, const Scene& scene, const Camera& camera);

}  // namespace conelight
