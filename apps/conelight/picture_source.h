// SPDX-License-Identifier: MIT
// A picture of a scene in any mode: the GL modes, `reference` (path tracer) and `radiosity`, behind one call,
// with its cost. What `render`, `compare` and `score` draw with.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "conelight/renderer.h"
#include "reference/path_tracer.h"
#include "reference/radiosity.h"

namespace conelight::program {

// A mode's name on the command line: phong, thesis, cones, ... (Mode), reference, radiosity.
bool isModeName(const std::string& name);
std::string modeNames();  // "phong, thesis, cones, reference or radiosity"

struct PictureRequest {
    std::string mode = "cones";
    Settings settings;  // mode and component are overwritten
    Camera camera;
    Size size;
    std::vector<Component> components = {Component::Full};
    reference::PathTracerSettings reference;
    reference::RadiositySettings radiosity;
    int frames = 1;  // GL modes: drawn this often before it is read (modes that settle over frames)
};

struct Picture {
    std::vector<Image> images;                           // one per component asked for
    std::optional<reference::PathTracedPicture> traced;  // mode reference: everything it knows
    FrameStats stats;                                    // GL modes: of the last frame
    double cpuSeconds = 0, wallSeconds = 0;              // of all of it, without loading the scene
};

// Keeps the GL context (made when first needed), the renderer, the ray structure and the bake of one scene.
class PictureSource {
  public:
    PictureSource(const Scene& scene, const ViewOptions& view, const std::string& shaderDirectory = {});
    ~PictureSource();
    PictureSource(const PictureSource&) = delete;
    PictureSource& operator=(const PictureSource&) = delete;

    // Throws Error(Usage) for a component that the mode does not have. `progress` may be null.
    Picture draw(const PictureRequest& request, Progress* progress);
    Renderer& renderer();  // GL modes; makes the context

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
