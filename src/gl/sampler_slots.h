// SPDX-License-Identifier: MIT
// llvmpipe compiles a kernel for what it reads: for the formats of its textures, for whether their edges are powers of
// two, and for the filters of their samplers. Mesa leaves the sampler of a buffer texture as the program that ran last
// left that slot, and llvmpipe compiles for it although a buffer has none: each kernel was built three times on
// average (docs/notes/2026-11-27-kernels-built-once.md). Here every slot gets the same sampler.
#pragma once

#include <memory>

#include "conelight/program_cache.h"
#include "gl/buffer.h"
#include "gl/texture.h"

namespace conelight::gl {

class Program;

class SamplerSlots {
  public:
    explicit SamplerSlots(ProgramCache* cache);  // null: none
    ~SamplerSlots();
    // Runs one invocation that reads a texel through every slot of compute programs. GL state changed: program,
    // texture unit 0, storage binding 0.
    void run() const;

  private:
    std::unique_ptr<Program> program_;
    Texture texel_;
    Buffer sum_;
};

}  // namespace conelight::gl
