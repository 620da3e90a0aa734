// SPDX-License-Identifier: MIT
#include "gl/late_words.h"

#include <algorithm>
#include <atomic>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

std::atomic<std::uint64_t> framesBegun{0};

}  // namespace

void beginFrame() { ++framesBegun; }

LateWords::LateWords(LateWords&& other) noexcept
    : Object(std::move(other)),
      mapped_(std::exchange(other.mapped_, nullptr)),
      room_(std::exchange(other.room_, 0)),
      fence_(std::exchange(other.fence_, nullptr)),
      frame_(other.frame_) {}

LateWords& LateWords::operator=(LateWords&& other) noexcept {
    if (this == &other) return *this;
    drop();
    Object::operator=(std::move(other));
    mapped_ = std::exchange(other.mapped_, nullptr);
    room_ = std::exchange(other.room_, 0);
    fence_ = std::exchange(other.fence_, nullptr);
    frame_ = other.frame_;
    return *this;
}

LateWords::~LateWords() { drop(); }

void LateWords::drop() noexcept {
    if (fence_ != nullptr && !namesAreForgotten()) glDeleteSync(static_cast<GLsync>(fence_));
    fence_ = nullptr;
}

void LateWords::take(const Buffer& from, std::size_t offset, std::size_t count) {
    CONELIGHT_ASSERT(count > 0 && offset + 4 * count <= from.bytes(),
                     "LateWords::take reaches past the end of the buffer");
    drop();
    if (count > room_) {
        constexpr GLbitfield kAccess = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        const auto bytes = static_cast<GLsizeiptr>(4 * count);
        Name created = 0;
        glCreateBuffers(1, &created);
        adopt(created, "late words", 4 * count);
        glNamedBufferStorage(created, bytes, nullptr, kAccess | GL_CLIENT_STORAGE_BIT);
        mapped_ = static_cast<const std::uint32_t*>(glMapNamedBufferRange(created, 0, bytes, kAccess));
        room_ = count;
        if (mapped_ == nullptr)
            base::fail(ErrorKind::Runtime, "storage: the driver maps no buffer of %zu bytes", 4 * count);
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(from.name(), name(), static_cast<GLintptr>(offset), 0,
                             static_cast<GLsizeiptr>(4 * count));
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    frame_ = framesBegun;
}

bool LateWords::ofThisFrame() const { return pending() && frame_ == framesBegun; }

void LateWords::read(std::span<std::uint32_t> words) {
    CONELIGHT_ASSERT(pending() && words.size() <= room_, "LateWords::read without take");
    if (ofThisFrame()) countWait();
    constexpr GLuint64 kSecond = 1'000'000'000;
    while (glClientWaitSync(static_cast<GLsync>(fence_), GL_SYNC_FLUSH_COMMANDS_BIT, kSecond) ==
           GL_TIMEOUT_EXPIRED) {
    }
    drop();
    std::copy_n(mapped_, words.size(), words.begin());
}

}  // namespace conelight::gl
