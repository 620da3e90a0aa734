// SPDX-License-Identifier: MIT
#include "gl/buffer.h"

#include <algorithm>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {
constexpr std::size_t kMinBytes = 16;  // zero-size storage is an error in GL
}

Buffer::Buffer(std::size_t bytes, const std::string& label) : Buffer(nullptr, bytes, label) { clear(); }

Buffer::Buffer(const void* data, std::size_t bytes, const std::string& label)
    : bytes_(std::max(bytes, kMinBytes)) {
    Name name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes_), bytes == bytes_ ? data : nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    adopt(name, label, bytes_);
    if (data != nullptr && bytes != 0 && bytes != bytes_) update(0, data, bytes);
}

void Buffer::update(std::size_t offset, const void* data, std::size_t bytes) {
    CONELIGHT_ASSERT(offset + bytes <= bytes_, "Buffer::update reaches past the end of the buffer");
    if (bytes == 0) return;
    glNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::clear() { fill(0); }

void Buffer::fill(std::uint32_t word) {
    const std::size_t words = bytes_ & ~std::size_t{3};
    glClearNamedBufferSubData(name(), GL_R32UI, 0, static_cast<GLsizeiptr>(words), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &word);
}

void Buffer::read(std::size_t offset, void* data, std::size_t bytes) const {
    CONELIGHT_ASSERT(offset + bytes <= bytes_, "Buffer::read reaches past the end of the buffer");
    if (bytes == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::bindUniform(unsigned binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, name()); }
void Buffer::bindStorage(unsigned binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name()); }
void Buffer::bindStorage(unsigned binding, std::size_t offset, std::size_t bytes) const {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, name(), static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(bytes));
}

}  // namespace conelight::gl
