// SPDX-License-Identifier: MIT
// What public calls of a Renderer or LightField stand under.
#pragma once

#include <cstdint>

#include "gl/host_state.h"
#include "gl/object.h"
#include "scene/held_scene.h"

namespace conelight::modes {

// The host finds its state as it was; what is made is the object's own (modes/memory_stats.h).
struct OwnerGuard {
    explicit OwnerGuard(std::uint32_t owner) : owned(owner) {}
    gl::OwnerScope owned;
    gl::HostStateGuard guard;
};

// A scene during one change of it, which stands under a guard of its own.
class OwnerScene {
  public:
    OwnerScene(std::uint32_t owner, scene::HeldScene& scene) : owned_(owner), scene_(scene) {}
    scene::HeldScene* operator->() const { return &scene_; }

  private:
    gl::OwnerScope owned_;
    scene::HeldScene& scene_;
};

}  // namespace conelight::modes
