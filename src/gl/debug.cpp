// SPDX-License-Identifier: MIT
#include "gl/debug.h"

#ifdef __linux__
#include <dlfcn.h>
#endif

#include <atomic>
#include <mutex>

#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

std::atomic<int> errorCount{0};
std::mutex lastErrorMutex;
std::string lastError;

void handle(GLenum source, GLenum type, GLenum severity, const std::string& text) {
    // Program throws these with the lines mapped to files; a shader that fails while it is edited is no
    // fault.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    if (type == GL_DEBUG_TYPE_ERROR) {
        ++errorCount;
        {
            const std::lock_guard lock(lastErrorMutex);
            lastError = text;
        }
        base::log(LogLevel::Error, "OpenGL: " + text);
    } else if (severity == GL_DEBUG_SEVERITY_HIGH) {
        base::log(LogLevel::Warning, "OpenGL: " + text);
    }
}

void GLAPIENTRY onMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length,
                          const GLchar* message, const void*) noexcept {
    // Nothing may be thrown through the driver: a log callback that throws loses its message, not the
    // process.
    try {
        handle(source, type, severity,
               length >= 0 ? std::string(message, static_cast<std::size_t>(length)) : std::string(message));
    } catch (...) {
    }
}

}  // namespace

void installDebugCallback() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, nullptr);
}

// Without a current context libepoxy ends the process at the first call, so ask the window-system libraries
// that are already loaded: a context comes from one of them.
bool hasCurrentContext() {
#ifdef __linux__
    constexpr const char* kAskers[][2] = {{"libEGL.so.1", "eglGetCurrentContext"},
                                          {"libGLX.so.0", "glXGetCurrentContext"},
                                          {"libGL.so.1", "glXGetCurrentContext"}};
    for (const auto& [library, function] : kAskers) {
        void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
        if (handle == nullptr) continue;
        const auto current = reinterpret_cast<void* (*)()>(dlsym(handle, function));
        const bool has = current != nullptr && current() != nullptr;
        dlclose(handle);
        if (has) return true;
    }
    return false;
#else
    return true;  // unknown: libepoxy decides
#endif
}

int debugErrorCount() { return errorCount; }
std::string lastDebugError() {
    const std::lock_guard lock(lastErrorMutex);
    return lastError;
}
void resetDebugErrors() {
    const std::lock_guard lock(lastErrorMutex);
    errorCount = 0;
    lastError.clear();
}

void requireContext() {
    if (!hasCurrentContext())
        base::fail(ErrorKind::NoGl,
                   "OpenGL: no context is current on this thread; a 4.5 core context would be right");
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 45)
        base::fail(ErrorKind::NoGl,
                   "OpenGL: the current context has version %d.%d%s; 4.5 core would be right",
                   epoxy_gl_version() / 10, epoxy_gl_version() % 10, epoxy_is_desktop_gl() ? "" : " ES");
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    if ((profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0)
        base::log(LogLevel::Info,
                  "OpenGL: the current context is of the compatibility profile; only core is tested");
}

}  // namespace conelight::gl
