// SPDX-License-Identifier: MIT
// --memory MB, of every command that draws: OpenGL objects take no more than that (conelight/memory.h); nor does
// what is read of a scene, or made by what runs on the CPU.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace conelight::program {

void addMemory(CLI::App& command);
// Texels of all pictures of a scene, at most `most`, so that they leave room for the rest.
std::uint64_t texelsWithin(std::uint64_t most);

// While one lives, the memory of this process grows by no more than --memory: what asks for more gets none, which
// is std::bad_alloc. Not while OpenGL draws: drivers and their compilers end the process then. Without --memory,
// and where the system cannot do it, nothing.
class HostMemoryLimit {
  public:
    HostMemoryLimit();
    ~HostMemoryLimit();
    HostMemoryLimit(const HostMemoryLimit&) = delete;
    HostMemoryLimit& operator=(const HostMemoryLimit&) = delete;

  private:
    bool limits_ = false;
    std::uint64_t before_ = 0;  // the system's limit
};

}  // namespace conelight::program
