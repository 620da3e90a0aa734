// SPDX-License-Identifier: MIT
// A picture of a scene in any mode, with its cost, behind one call. What `render`, `compare` and `score` draw
// with.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "conelight/renderer.h"
#include "reference/beam_tracer.h"
#include "reference/denoise.h"
#include "reference/path_tracer.h"
#include "reference/radiosity.h"
#include "session/session.h"

namespace conelight::program {

// A mode's name on the command line: those of the renderer, and `reference`, `radiosity` and `beams`, which run on
// the CPU and are no modes of it.
bool isModeName(const std::string& name);
bool isRendererMode(const std::string& name);
std::string modeNames();  // "phong, thesis, cones, hybrid, traced, reference, radiosity or beams"
void requireModeName(const std::string& name);   // throws Error(Usage) that names them
Component componentOf(const std::string& name);  // throws Error(Usage) that names them

struct PictureRequest {
    std::string mode = "traced";
    Settings settings;  // its mode and component are overwritten
    Camera camera;
    Size size;
    std::vector<Component> components = {Component::Full};
    reference::PathTracerSettings reference;                   // also of the reflections on top of radiosity
    reference::Denoiser denoiser = reference::Denoiser::None;  // of what is path-traced; never of a truth
    reference::RadiositySettings radiosity;
    bool radiositySpecular = false;  // reflections on top
    int lampPoints = 4;              // mode beams: of lamps with an area, along each side
    int frames = 1;                  // the first component is drawn this often: modes may settle over frames
    int tracedViews = 0;             // image.antialiasing of mode traced where the settings have 0
    bool profile = false;            // fill Picture::stats with passes and lookups
    std::string sceneOptions;        // words of the command that changed the scene, for the picture's header
    std::string commands;            // console commands that edited it, likewise
    int timedFrames = 0;  // fill Picture::cost from this many further frames of the first component
};

// What a settled frame costs.
struct FrameCost {
    double cpuMs = 0, wallMs = 0;  // medians over the frames; CPU time is the whole process's
    double gpuMs = -1;             // median; < 0: not measured (software drivers)
    std::vector<std::pair<std::string, double>> lookupsPerPixel;
    std::size_t memoryBytes = 0;  // of GL objects; 0: none
};

struct Picture {
    std::vector<Image> images;                           // one per component asked for
    FrameStats stats;                                    // GL: of the last frame of the first component
    FrameCost cost;                                      // in modes reference and beams: of the whole picture
    std::optional<reference::PathTracedPicture> traced;  // mode reference: everything it knows
    std::optional<reference::RadiosityStats> baked;      // mode radiosity; hybrid, when it baked for this one
    std::optional<reference::BeamStats> beams;           // mode beams
    bool stopped = false;                                // by a signal; the images show what there was
};

// Keeps the GL context, the renderer, the ray structure and the bake, each made when first needed, for one
// scene after the other.
class PictureSource {
  public:
    explicit PictureSource(const ViewOptions& view, const std::string& shaderDirectory = {});
    ~PictureSource();
    PictureSource(const PictureSource&) = delete;
    PictureSource& operator=(const PictureSource&) = delete;

    // Keeps a reference: `scene` lives unchanged until the next setScene. What the renderer keeps over frames
    // is kept.
    void setScene(const Scene& scene);
    // As setScene, of a scene that differs from that of the last draw, which still lives, by vertices, instances, materials,
    // lights and surroundings alone: they are changed in place, as a live program changes them.
    void changeScene(const Scene& scene);
    // The session's scene as it is now; keeps a reference to it. Called before each draw, it uploads what
    // changed since and no more. Throws what the renderer refuses.
    void follow(const Session& session);

    // `progress` may be null. Throws Error(Usage) for a mode or component that does not exist, else what the
    // renderer throws.
    Picture draw(const PictureRequest& request, Progress* progress);

    // How a pixel of the last draw was gathered. Throws Error(Usage) for the modes on the CPU, which do not
    // keep it.
    PixelInspection inspect(const PictureRequest& drawn, int x, int y);

    // Mode radiosity: the lit scene, baked at the first call.
    const Scene& bakedScene(const reference::RadiositySettings& settings, Progress* progress);

    std::string device() const;  // the GL device; empty when there was no need of one

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
