// SPDX-License-Identifier: MIT
// `bake FILE` in the window: radiosity solved in a thread of its own from the scene as it was when asked, the
// file written when that is done.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "conelight/scene.h"
#include "reference/radiosity.h"
#include "viewer/bake_progress.h"

namespace conelight::program {

class FileBake {
  public:
    FileBake();
    ~FileBake();  // stops and waits; nothing is written
    FileBake(const FileBake&) = delete;
    FileBake& operator=(const FileBake&) = delete;

    // `wake` is called from the thread when there is progress. Not while busy().
    void start(const std::string& file, bool overwrite, const Scene& scene,
               const reference::RadiositySettings& settings, void (*wake)());
    void stop();  // asks the thread to end: finish() will say that it was stopped
    bool busy() const;
    const std::string& file() const;
    BakeStatus status() const;

    // Once, when the work has ended: writes the file and returns lines that say so, or throws what went
    // wrong. Nothing while it runs, and when there was none.
    std::optional<std::vector<std::string>> finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
