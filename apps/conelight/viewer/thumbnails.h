// SPDX-License-Identifier: MIT
// Thumbnails of scenes in menus and dialogs: those that the desktop has, others drawn by `conelight thumbnail`, one at
// a time, in a process of its own that yields to everything else.
#pragma once

#include <sys/types.h>

#include <map>
#include <memory>
#include <string>

#include "platform/picture_texture.h"

namespace conelight::program {

class Thumbnails {
  public:
    // `draws` off: shows what there is, and writes nothing.
    explicit Thumbnails(bool draws) : draws_(draws) {}
    ~Thumbnails();
    Thumbnails(const Thumbnails&) = delete;
    Thumbnails& operator=(const Thumbnails&) = delete;

    // Into the current ImGui window, as wide as `width`: the picture, or a line that says why there is none.
    void show(const std::string& scene, float width);

  private:
    struct One {
        platform::PictureTexture texture;
        std::string failure;  // a line; empty while it is drawn
    };
    bool load(const std::string& scene, One& one);
    void draw(const std::string& scene);
    void follow();

    bool draws_;
    std::map<std::string, std::unique_ptr<One>> known_;
    std::string drawn_;  // the scene that is being drawn
    pid_t process_ = -1;
};

}  // namespace conelight::program
