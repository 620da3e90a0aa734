// SPDX-License-Identifier: MIT
// What a picture does without when OpenGL objects may not take more than so much memory. It is not foretold what a
// picture needs: it is drawn, and where an object would be beyond the limit, which is found before the
// driver is asked, drawn again with less.
#pragma once

#include <cstddef>
#include <string>

#include "conelight/settings.h"

namespace conelight::modes {

class MemoryFit {
  public:
    // `settings` as far as they had to be lowered for pictures of this size.
    Settings fitted(const Settings& settings, int width, int height);
    // One step less, of which the next fitted() knows; false where nothing is left that could be less.
    bool lower(const Settings& settings);
    void forget() { steps_ = 0; }  // another scene
    // "voxels.size 72 instead of 128, ..."; empty: nothing is lowered.
    std::string text(const Settings& settings) const;

  private:
    // What tells how much memory a picture takes.
    struct Work {
        Mode mode = Mode::Traced;
        VoxelSettings voxels;
        LightSettings light;
        int width = 0, height = 0;
        std::size_t limit = 0;
        bool operator==(const Work&) const = default;
    };
    static Settings lowered(const Settings& settings, int steps);

    Work work_;
    int steps_ = 0;
};

}  // namespace conelight::modes
