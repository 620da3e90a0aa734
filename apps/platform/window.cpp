// SPDX-License-Identifier: MIT
#include "platform/window.h"

#include <epoxy/gl.h>
// After epoxy: GLFW must not bring in its own GL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "conelight/error.h"

namespace conelight::platform {
namespace {

std::string lastGlfwError;
void keepError(int, const char* message) { lastGlfwError = message != nullptr ? message : ""; }

[[noreturn]] void noWindow(const std::string& what) {
    throw Error(
        ErrorKind::NoGl,
        "no window: " + what + (lastGlfwError.empty() ? "" : " (" + lastGlfwError + ")") +
            "; a display (DISPLAY or WAYLAND_DISPLAY) and a driver with OpenGL 4.5 would be right, or "
            "`conelight render`, which needs no display");
}

// Of the GUI: pictures are drawn in a context of their own (platform/render_thread.h), whose errors the library tells.
void sayErrors() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*) {
            if (type == GL_DEBUG_TYPE_ERROR) std::fprintf(stderr, "conelight: OpenGL: %s\n", message);
        },
        nullptr);
}

}  // namespace

Window& Window::self(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

Window::Window(const WindowOptions& options) {
    glfwSetErrorCallback(keepError);
#ifdef GLFW_PLATFORM
    // From GLFW 3.4 on, which tries Wayland too: its library prints a line of its own where nobody named a place for
    // sockets.
    if (std::getenv("XDG_RUNTIME_DIR") == nullptr && std::getenv("WAYLAND_SOCKET") == nullptr &&
        std::getenv("WAYLAND_DISPLAY") == nullptr)
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (glfwInit() == GLFW_FALSE) noWindow("there is no display to open one on");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    // The GUI and the finished picture need neither.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        glfwTerminate();
        noWindow("the display gives no OpenGL 4.5 core context");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    if (options.debug) sayErrors();
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        if (self(window).onDrop) self(window).onDrop({paths, paths + count});
    });
    // The GUI's own callbacks call these on.
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        ++self(window).inputs_;
        self(window).cursorThen_ = {x, y};
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double) { ++self(window).inputs_; });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) {
        if (self(window).onRefresh) self(window).onRefresh();
    });
}

void Window::listen() {
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        Window& own = self(window);
        ++own.inputs_;
        ++own.buttonInputs_;
        own.buttonChanges_.push_back({button, action == GLFW_PRESS, own.cursorThen_, ++own.events_});
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int modifiers) {
        Window& own = self(window);
        ++own.inputs_;
        own.keyEvents_.push_back({key, scancode, action, modifiers, 0, ++own.events_});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int character) {
        Window& own = self(window);
        own.keyEvents_.push_back({GLFW_KEY_UNKNOWN, 0, 0, 0, character, ++own.events_});
    });
}

bool Window::KeyEvent::control() const { return (modifiers & GLFW_MOD_CONTROL) != 0; }
bool Window::KeyEvent::shift() const { return (modifiers & GLFW_MOD_SHIFT) != 0; }

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool Window::shouldClose() const { return glfwWindowShouldClose(window_) != GLFW_FALSE; }
void Window::setShouldClose(bool close) { glfwSetWindowShouldClose(window_, close ? GLFW_TRUE : GLFW_FALSE); }
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::pollEvents(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void Window::wake() { glfwPostEmptyEvent(); }
void Window::swapBuffers() { glfwSwapBuffers(window_); }

glm::ivec2 Window::size() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(window_, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::framebufferSize() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

float Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x > 0 ? x : 1.0f;
}

void Window::show() {
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != GLFW_FALSE) glfwRestoreWindow(window_);
}

bool Window::minimized() const {
    const glm::ivec2 size = framebufferSize();
    return size.x == 0 || size.y == 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != GLFW_FALSE;
}

void Window::setFullscreen(bool on) {
    if (on == fullscreen_) return;
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (on && monitor == nullptr) return;
    fullscreen_ = on;
    if (on) {
        glfwGetWindowPos(window_, &windowedPosition_.x, &windowedPosition_.y);
        windowedSize_ = size();
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    } else {
        glfwSetWindowMonitor(window_, nullptr, windowedPosition_.x, windowedPosition_.y, windowedSize_.x,
                             windowedSize_.y, GLFW_DONT_CARE);
    }
}

void Window::captureCursor(bool on) {
    if (on == captured_) return;
    captured_ = on;
    glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (on && glfwRawMouseMotionSupported() != GLFW_FALSE)
        glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, GLFW_TRUE);
}

bool Window::isKeyDown(int glfwKey) const { return glfwGetKey(window_, glfwKey) == GLFW_PRESS; }

glm::dvec2 Window::cursor() const {
    glm::dvec2 at(0);
    glfwGetCursorPos(window_, &at.x, &at.y);
    return at;
}

void Window::clear(const glm::vec3& color) {
    const glm::ivec2 size = framebufferSize();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(color.r, color.g, color.b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

std::vector<std::uint8_t> Window::pixels() const {
    const glm::ivec2 size = framebufferSize();
    const std::size_t pitch = 3 * static_cast<std::size_t>(size.x);
    std::vector<std::uint8_t> rows(pitch * static_cast<std::size_t>(size.y));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    for (std::size_t low = 0, high = rows.size(); low + pitch < high; low += pitch) {
        high -= pitch;  // GL's first row is the lowest
        std::swap_ranges(rows.begin() + static_cast<std::ptrdiff_t>(low),
                         rows.begin() + static_cast<std::ptrdiff_t>(low + pitch),
                         rows.begin() + static_cast<std::ptrdiff_t>(high));
    }
    return rows;
}

std::string Window::description() const {
    const auto text = [](GLenum name) {
        const GLubyte* value = glGetString(name);
        return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "?");
    };
    return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

}  // namespace conelight::platform
