// SPDX-License-Identifier: MIT
#include "gl/storage.h"

#include <atomic>

#include "base/log.h"
#include "conelight/memory.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

std::atomic<std::size_t> limitBytes{0};

double mebibytes(std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

const char* whyLost(GLenum status) {
    switch (status) {
        case GL_GUILTY_CONTEXT_RESET:
            return "by what it was asked to do";
        case GL_INNOCENT_CONTEXT_RESET:
            return "by another program";
        default:
            return "for an unknown reason";
    }
}

// Beyond the least size that is worth the question.
constexpr std::size_t kLarge = std::size_t{1} << 30;

[[noreturn]] void failForMemory(const std::string& label, std::size_t bytes) {
    base::fail(ErrorKind::Runtime,
               "OpenGL: no memory for '%s' (%.1f MiB); a smaller grid, picture or texture would be right",
               label.c_str(), mebibytes(bytes));
}

// Drivers of NVIDIA promise any size, and hang where it is used.
void requireDeviceHas(const std::string& label, std::size_t bytes) {
    if (bytes < kLarge || !epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) return;
    GLint kibibytes = 0;
    glGetIntegerv(GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX, &kibibytes);
    if (kibibytes > 0 && bytes / 1024 > static_cast<std::size_t>(kibibytes)) failForMemory(label, bytes);
}

}  // namespace

void requireRoom(const std::string& label, std::size_t bytes) {
    requireDeviceHas(label, bytes);
    const std::size_t limit = limitBytes;
    if (limit == 0) return;
    const std::size_t taken = liveBytes();
    if (bytes <= limit && taken <= limit - bytes) return;
    throw MemoryError(
        ErrorKind::Runtime,
        base::format(
            "OpenGL memory: '%s' of %.1f MiB does not fit into the limit of %.0f MiB, of which %.1f are "
            "taken; a higher limit, or a smaller grid, picture or texture would be right",
            label.c_str(), mebibytes(bytes), mebibytes(limit), mebibytes(taken)));
}

void requireLiveContext() {
    const GLenum status = glGetGraphicsResetStatus();
    if (status == GL_NO_ERROR) return;
    base::fail(ErrorKind::Runtime,
               "OpenGL: the context is lost, reset %s; a new context with a new renderer would be right",
               whyLost(status));
}

void requireStorage(ObjectType type, Name name, const std::string& label, std::size_t bytes) {
    // Asking the object costs no synchronisation, unlike asking for the error of every allocation.
    bool given = false;
    if (type == ObjectType::Buffer) {
        GLint64 size = 0;
        glGetNamedBufferParameteri64v(name, GL_BUFFER_SIZE, &size);
        given = size >= 0 && static_cast<std::size_t>(size) >= bytes;
    } else {
        GLint immutable = GL_FALSE;
        glGetTextureParameteriv(name, GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
        given = immutable == GL_TRUE;
    }
    if (given) return;
    requireLiveContext();
    // The flag is per kind of error; a lost context reports one for ever, hence the bound.
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) continue;
    failForMemory(label, bytes);
}

}  // namespace conelight::gl

namespace conelight {

void setMemoryLimit(std::size_t bytes) { gl::limitBytes = bytes; }
std::size_t memoryLimit() { return gl::limitBytes; }

}  // namespace conelight
