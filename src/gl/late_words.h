// SPDX-License-Identifier: MIT
// Words that shaders have counted, on their way to the CPU: taken in one frame, read in the next, when the GPU has long
// been there. Who reads them in the frame that took them waits for the GPU, which counts (waitCount).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "gl/buffer.h"

namespace conelight::gl {

// A frame of any renderer or light field of this process begins.
void beginFrame();

class LateWords : public Object<ObjectType::Buffer> {
  public:
    LateWords() = default;
    LateWords(LateWords&& other) noexcept;
    LateWords& operator=(LateWords&& other) noexcept;
    ~LateWords();

    // The words as they will be when the GPU gets here; those that were on their way are given up.
    void take(const Buffer& from, std::size_t offset, std::size_t count);
    bool pending() const { return fence_ != nullptr; }
    bool ofThisFrame() const;
    // What take() took. Nothing is pending then.
    void read(std::span<std::uint32_t> words);
    void drop() noexcept;  // nothing is pending then

  private:
    const std::uint32_t* mapped_ = nullptr;
    std::size_t room_ = 0;   // words
    void* fence_ = nullptr;  // GLsync
    std::uint64_t frame_ = 0;
};

}  // namespace conelight::gl
