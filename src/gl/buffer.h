// SPDX-License-Identifier: MIT
// A GL buffer of immutable size. Filled at creation, by update(), or by shaders; read back by read().
// Creation throws Error(Runtime) when the driver has no memory; ranges outside the buffer are assertions.
// clear(), fill(), copyFrom(), copyRange() and read() see and follow what shaders wrote before; update() does only after
// barrier(Access::Update).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gl/object.h"

namespace conelight::gl {

class Buffer : public Object<ObjectType::Buffer> {
  public:
    Buffer() = default;
    // `bytes` of storage, zero-filled. Rounded up to whole words and to at least 16, so that it can be filled
    // by words and an empty table can be bound.
    Buffer(std::size_t bytes, const std::string& label);
    Buffer(const void* data, std::size_t bytes, const std::string& label);
    template <class T>
    Buffer(std::span<const T> data, const std::string& label)
        : Buffer(data.data(), data.size_bytes(), label) {}
    template <class T>
    Buffer(const std::vector<T>& data, const std::string& label)
        : Buffer(data.data(), data.size() * sizeof(T), label) {}

    std::size_t bytes() const { return name() != 0 ? bytes_ : 0; }  // as allocated

    void update(std::size_t offset, const void* data, std::size_t bytes);
    template <class T>
    void update(const T& value) {
        update(0, &value, sizeof(T));
    }
    void clear();                   // all bytes zero
    void fill(std::uint32_t word);  // every 32-bit word

    void copyFrom(const Buffer& source, std::size_t bytes) {  // the first `bytes` of another buffer
        copyRange(source, 0, 0, bytes);
    }
    void copyRange(const Buffer& source, std::size_t from, std::size_t to, std::size_t bytes);

    void read(std::size_t offset, void* data, std::size_t bytes) const;  // waits for the GPU
    template <class T>
    std::vector<T> read(std::size_t count, std::size_t offset = 0) const {
        std::vector<T> data(count);
        read(offset, data.data(), count * sizeof(T));
        return data;
    }

  private:
    std::size_t bytes_ = 0;
};

// How often this process has waited for the driver so far, to read a buffer or texture back, or to have all done: tests
// hold that against what a frame may. Times of passes are not counted.
std::uint64_t waitCount();
void countWait();

// Of a buffer that is the host's; 0 where the name is of none.
std::uint64_t bytesOfForeignBuffer(Name buffer);

}  // namespace conelight::gl
