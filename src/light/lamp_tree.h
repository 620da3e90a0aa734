// SPDX-License-Identifier: MIT
// A binary tree over many lamps, by which shaders draw few of them: points and spots of the light table -> nodes and slots
// (shared/lamps.h, lib/lamp_tree.glsl; docs/theory/3_light.md, "Many lamps"). Of the same lamps always the same tree.
//
// A tree over 10^4 lamps takes milliseconds, so that lamps which move have theirs made anew.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/texture.h"
#include "shared/lamps.h"
#include "shared/scene.h"

namespace conelight::light {

struct LampTree {
    std::vector<gpu::LampNode> nodes;  // the root first
    std::vector<std::uint32_t> slots;  // numbers of lamps

    // Lamps without light are left out. Each of the others is told how many slots it has (gpu::Light::sampleGrid).
    static LampTree over(std::span<gpu::Light> lamps);
};

// The tree as shaders read it.
class LampTable {
  public:
    void update(const LampTree& tree);
    bool empty() const { return !nodes_; }
    void declare(gl::Inputs& inputs) const;  // lampNodes, lampSlots

  private:
    gl::Buffer nodes_, slots_;
    gl::Texture nodeTexels_, slotTexels_;
};

}  // namespace conelight::light
