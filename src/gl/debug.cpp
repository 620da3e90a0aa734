// SPDX-License-Identifier: MIT
#include "gl/debug.h"

#include <atomic>
#include <mutex>

#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

std::atomic<int> errorCount{0};
std::mutex lastErrorMutex;
std::string lastError;

void GLAPIENTRY onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* message,
                          const void*) {
    const std::string text(message, length >= 0 ? static_cast<std::size_t>(length) : std::char_traits<char>::length(message));
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

}  // namespace

void installDebugCallback() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, nullptr);
}

int debugErrorCount() { return errorCount; }
std::string lastDebugError() {
    const std::lock_guard lock(lastErrorMutex);
    return lastError;
}
void resetDebugErrors() { errorCount = 0; }

void requireContext() {
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 45)
        base::fail(ErrorKind::NoGl, "OpenGL: the current context has version %d.%d%s; 4.5 core would be right",
                   epoxy_gl_version() / 10, epoxy_gl_version() % 10, epoxy_is_desktop_gl() ? "" : " ES");
}

}  // namespace conelight::gl
