// SPDX-License-Identifier: MIT
// Where figures are drawn: picture size, quality, and scenes in any mode. OpenGL starts with the first render.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "figures/figure.h"
#include "picture_source.h"

namespace conelight::figures {

// A picture of a scene.
struct Shot {
    std::string scene;  // "builtin:..."
    std::string mode = "traced";
    std::string camera;  // name; empty: the scene's first
    std::string component = "full";
    std::vector<std::pair<std::string, std::string>> settings = {};  // key, value
    int voxels = 128;                                                // halved by --small
    int bounces = -1;                                                // reference, radiosity; -1: all
    int samples = 256;                                               // reference; fewer by --small
    bool denoised = false;                                           // reference
};

class Studio {
  public:
    Studio(program::Size size, bool small, const program::ViewOptions& view, program::Progress& progress);
    ~Studio();

    // The picture as a PNG file. Throws Error(Runtime) when it is black: a figure shows something.
    Panel draw(const std::string& label, const Shot& shot);
    // The same of a scene that the caller made or changed.
    Panel draw(const std::string& label, const Shot& shot, const Scene& scene);
    // With the cones or rays of a pixel drawn over it; `x`, `y` in parts of the picture.
    Panel inspect(const std::string& label, const Shot& shot, double x, double y);

    // Lasts until the next call with another name.
    const Scene& scene(const std::string& spec);
    program::PictureRequest requestOf(const Shot& shot, const Scene& scene) const;
    program::Picture picture(const program::PictureRequest& request);

    // Gives back OpenGL and the scene, so that a figure may have a context of its own.
    void restart();

    program::Size size() const { return size_; }
    bool small() const { return small_; }
    const program::ViewOptions& view() const { return view_; }
    program::Progress& progress() { return progress_; }
    std::string device() const;

  private:
    program::Size size_;
    bool small_;
    program::ViewOptions view_;
    program::Progress& progress_;
    std::unique_ptr<program::PictureSource> source_;
    std::string loadedName_;
    std::unique_ptr<Scene> loaded_, given_;
};

}  // namespace conelight::figures
