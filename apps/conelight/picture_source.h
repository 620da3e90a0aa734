// SPDX-License-Identifier: MIT
// A picture of a scene in any mode, with its cost, behind one call. What `render`, `compare` and `score` draw
// with.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "conelight/renderer.h"

namespace conelight::program {

// A mode's name on the command line.
bool isModeName(const std::string& name);
std::string modeNames();                         // "phong, thesis or cones"
void requireModeName(const std::string& name);   // throws Error(Usage) that names them
Component componentOf(const std::string& name);  // throws Error(Usage) that names them

struct PictureRequest {
    std::string mode = "cones";
    Settings settings;  // its mode and component are overwritten
    Camera camera;
    Size size;
    std::vector<Component> components = {Component::Full};
    int frames = 1;        // the first component is drawn this often: modes may settle over frames
    bool profile = false;  // fill Picture::stats with passes and lookups
    int timedFrames = 0;   // fill Picture::cost from this many further frames of the first component
};

// What a settled frame costs.
struct FrameCost {
    double cpuMs = 0, wallMs = 0;  // medians over the frames; CPU time is the whole process's
    double gpuMs = -1;             // median; < 0: not measured (software drivers)
    std::vector<std::pair<std::string, double>> lookupsPerPixel;
    std::size_t memoryBytes = 0;  // of GL objects
};

struct Picture {
    std::vector<Image> images;  // one per component asked for
    FrameStats stats;           // of the last frame of the first component
    FrameCost cost;
};

// Keeps the GL context and the renderer, made when first needed, for one scene after the other.
class PictureSource {
  public:
    explicit PictureSource(const ViewOptions& view, const std::string& shaderDirectory = {});
    ~PictureSource();
    PictureSource(const PictureSource&) = delete;
    PictureSource& operator=(const PictureSource&) = delete;

    // Keeps a reference: `scene` lives unchanged until the next setScene. What the renderer keeps over frames
    // is kept.
    void setScene(const Scene& scene);

    // `progress` may be null. Throws Error(Usage) for a mode or component that does not exist, else what the
    // renderer throws.
    Picture draw(const PictureRequest& request, Progress* progress);

    std::string device() const;  // the GL device; empty when there was no need of one

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
