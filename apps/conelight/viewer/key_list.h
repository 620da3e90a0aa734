// SPDX-License-Identifier: MIT
// What mouse and keys do, as a list over the picture (F1 or ?). docs/guide/viewer.md has the same keys.
#pragma once

#include <glm/glm.hpp>

namespace conelight::program {

class KeyList {
  public:
    bool open = false;
    // Into the middle of the picture.
    void show(const glm::vec2& at, const glm::vec2& size);
};

}  // namespace conelight::program
