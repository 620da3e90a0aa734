// SPDX-License-Identifier: MIT
#include "gl/buffer.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

#include "base/assert.h"
#include "gl/gl.h"
#include "gl/storage.h"

namespace conelight::gl {
namespace {

constexpr std::size_t kMinBytes = 16;  // zero-size storage is an error in GL; one row of a GPU struct

// What the driver is asked for. llvmpipe builds the kernels that read it as a texture once more if its size is a power of
// two, and if bits 8 to 15 of its size are zero: in Mesa's record they are the levels of other textures.
std::size_t storageOf(std::size_t bytes) {
    constexpr std::size_t kLevels = 0xff00, kStep = 0x108;
    return std::has_single_bit(bytes) || (bytes & kLevels) == 0 ? bytes + kStep : bytes;
}

std::atomic<std::uint64_t> waits{0};

bool inRange(std::size_t offset, std::size_t bytes, std::size_t size) {
    return bytes <= size && offset <= size - bytes;
}

}  // namespace

Buffer::Buffer(std::size_t bytes, const std::string& label) : Buffer(nullptr, bytes, label) {}

Buffer::Buffer(const void* data, std::size_t bytes, const std::string& label)
    : bytes_(std::max((bytes + 3) & ~std::size_t{3}, kMinBytes)) {
    requireRoom(label, bytes_);
    Name created = 0;
    glCreateBuffers(1, &created);
    const std::size_t storage = storageOf(bytes_);
    adopt(created, label, bytes_);
    // Filled up with zeros here: a driver of NVIDIA (580.159) has lost what was written right after a fill.
    std::vector<std::byte> padded;
    if (data != nullptr && bytes < storage) {
        padded.resize(storage);
        std::copy_n(static_cast<const std::byte*>(data), bytes, padded.begin());
        data = padded.data();
    }
    glNamedBufferStorage(created, static_cast<GLsizeiptr>(storage), data, 0);
    requireStorage(ObjectType::Buffer, created, label, bytes_);
    if (data == nullptr) clear();
}

void Buffer::update(std::size_t offset, const void* data, std::size_t bytes) {
    CONELIGHT_ASSERT(inRange(offset, bytes, this->bytes()),
                     "Buffer::update reaches past the end of the buffer");
    if (bytes == 0) return;
    // By a copy: a driver of NVIDIA (580.159) does not keep glNamedBufferSubData in order with fills, copies and kernels.
    Name staged = 0;
    glCreateBuffers(1, &staged);
    glNamedBufferStorage(staged, static_cast<GLsizeiptr>(bytes), data, 0);
    glCopyNamedBufferSubData(staged, name(), 0, static_cast<GLintptr>(offset),
                             static_cast<GLsizeiptr>(bytes));
    glDeleteBuffers(1, &staged);
}

void Buffer::clear() { fill(0); }

void Buffer::fill(std::uint32_t word) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferData(name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void Buffer::copyRange(const Buffer& source, std::size_t from, std::size_t to, std::size_t bytes) {
    CONELIGHT_ASSERT(
        inRange(to, bytes, this->bytes()) && inRange(from, bytes, source.bytes()) && source.name() != name(),
        "Buffer::copyRange reaches past the end of a buffer");
    if (bytes == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(source.name(), name(), static_cast<GLintptr>(from), static_cast<GLintptr>(to),
                             static_cast<GLsizeiptr>(bytes));
}

void Buffer::read(std::size_t offset, void* data, std::size_t bytes) const {
    CONELIGHT_ASSERT(inRange(offset, bytes, this->bytes()),
                     "Buffer::read reaches past the end of the buffer");
    if (bytes == 0) return;
    countWait();
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

std::uint64_t waitCount() { return waits; }
void countWait() { ++waits; }

std::uint64_t bytesOfForeignBuffer(Name buffer) {
    if (glIsBuffer(buffer) == GL_FALSE) return 0;
    GLint64 size = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
    return size > 0 ? static_cast<std::uint64_t>(size) : 0;
}

}  // namespace conelight::gl
