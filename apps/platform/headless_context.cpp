// SPDX-License-Identifier: MIT
#include "platform/headless_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <climits>
#include <map>
#include <mutex>

#include "conelight/error.h"

namespace conelight::platform {
namespace {

bool hasClientExtension(const char* name) {
    // libepoxy ends the process when it cannot load libEGL, so ask for the library first.
    return epoxy_has_egl() && epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

std::vector<EGLDeviceEXT> devices() {
    std::vector<EGLDeviceEXT> found;
    if (!hasClientExtension("EGL_EXT_device_base") && !hasClientExtension("EGL_EXT_device_enumeration"))
        return found;
    EGLint count = 0;
    if (eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count <= 0) return found;
    found.resize(static_cast<std::size_t>(count));
    if (eglQueryDevicesEXT(count, found.data(), &count) == EGL_FALSE) count = 0;
    found.resize(static_cast<std::size_t>(count));
    return found;
}

bool deviceHas(EGLDeviceEXT device, const std::string& extension) {
    const char* text = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return (" " + std::string(text != nullptr ? text : "") + " ").find(" " + extension + " ") !=
           std::string::npos;
}

bool isSoftware(EGLDeviceEXT device) { return deviceHas(device, "EGL_MESA_device_software"); }

// What tells a device from its neighbours: its file in /dev/dri, when it has one.
std::string nameOf(EGLDeviceEXT device) {
    if (isSoftware(device)) return "software";
    const char* file = deviceHas(device, "EGL_EXT_device_drm")
                           ? eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT)
                           : nullptr;
    return std::string("hardware") + (file != nullptr ? std::string(", ") + file : "");
}

// EGL hands out one display per device to the whole process, and terminating it ends every context there:
// the last user does it.
struct Displays {
    std::mutex mutex;
    std::map<EGLDisplay, int> users;
};
Displays& displays() {
    static Displays* const all = new Displays;  // outlives contexts of static storage
    return *all;
}

bool openDisplay(EGLDisplay display) {
    Displays& all = displays();
    const std::lock_guard lock(all.mutex);
    EGLint major = 0, minor = 0;
    if (eglInitialize(display, &major, &minor) == EGL_FALSE) return false;
    ++all.users[display];
    return true;
}

void closeDisplay(EGLDisplay display) {
    Displays& all = displays();
    const std::lock_guard lock(all.mutex);
    if (--all.users[display] > 0) return;
    all.users.erase(display);
    eglTerminate(display);
}

Current currentOfThread() {
    return {eglGetCurrentDisplay(), eglGetCurrentContext(), eglGetCurrentSurface(EGL_DRAW),
            eglGetCurrentSurface(EGL_READ)};
}

EGLContext createContext(EGLDisplay display, bool debug) {
    // NVIDIA wants a config for contexts; Mesa's surfaceless platform may have none.
    const EGLint configAttributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE,
                                       EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint configCount = 0;
    if (eglChooseConfig(display, configAttributes, &config, 1, &configCount) == EGL_FALSE || configCount == 0)
        config = EGL_NO_CONFIG_KHR;
    std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                   4,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   5,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_CONTEXT_OPENGL_DEBUG,
                                   debug ? EGL_TRUE : EGL_FALSE,
                                   EGL_NONE};
    // A context that is told when it is lost; debug contexts with robust access too. Without, where the driver does
    // not know of that.
    std::vector<EGLint> told = attributes;
    told.pop_back();
    told.insert(told.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET,
                             EGL_CONTEXT_OPENGL_ROBUST_ACCESS, debug ? EGL_TRUE : EGL_FALSE, EGL_NONE});
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, told.data());
    return context != EGL_NO_CONTEXT ? context
                                     : eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

std::vector<std::string> listDevices() {
    std::vector<std::string> lines;
    for (EGLDeviceEXT device : devices())
        lines.push_back(std::to_string(lines.size()) + ": " + nameOf(device));
    return lines;
}

bool HeadlessContext::tryDisplay(void* display, const std::string& how, bool debug) {
    const auto failed = [&](const char* what) {
        tried_ += (tried_.empty() ? "" : ", ") + how + ": " + what;
        return false;
    };
    if (display == EGL_NO_DISPLAY) return failed("no display");
    if (!openDisplay(display)) return failed("does not initialise");
    const auto closed = [&](const char* what) {
        closeDisplay(display);
        return failed(what);
    };
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return closed("no desktop OpenGL");
    const EGLContext context = createContext(display, debug);
    if (context == EGL_NO_CONTEXT) return closed("no OpenGL 4.5 core context");
    previous_ = currentOfThread();  // comes back when this context ends
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        eglDestroyContext(display, context);
        return closed("context cannot be current without a surface");
    }
    display_ = display;
    context_ = context;
    const auto text = [](GLenum name) {
        const GLubyte* string = glGetString(name);
        return std::string(string != nullptr ? reinterpret_cast<const char*>(string) : "?");
    };
    description_ = how + ", " + text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
    return true;
}

HeadlessContext::HeadlessContext(const HeadlessOptions& options) {
    const std::vector<EGLDeviceEXT> all = devices();
    const int count = static_cast<int>(all.size());
    if (options.device != kAnyDevice && (options.device < 0 || options.device >= count) && count > 0)
        throw Error(ErrorKind::Usage, "--device: there is no EGL device " + std::to_string(options.device) +
                                          "; " + (count == 1 ? "0" : "0 to " + std::to_string(count - 1)) +
                                          " would be right");
    // Hardware devices first, then software ones, then surfaceless.
    for (const bool software : {false, true}) {
        for (int i = 0; i < count; ++i) {
            EGLDeviceEXT device = all[static_cast<std::size_t>(i)];
            if (options.device != kAnyDevice ? i != options.device : isSoftware(device) != software) continue;
            if (tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                           "EGL device " + std::to_string(i), options.debug))
                return;
        }
        if (options.device != kAnyDevice) break;
    }
    if (options.device == kAnyDevice && hasClientExtension("EGL_MESA_platform_surfaceless") &&
        tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                   "EGL surfaceless", options.debug))
        return;
    throw Error(ErrorKind::NoGl, "OpenGL: no 4.5 core context without a display (" +
                                     (!epoxy_has_egl() ? "libEGL is not installed"
                                      : tried_.empty() ? "EGL lists no device"
                                                       : tried_) +
                                     "); installing Mesa (libgl1-mesa-dri, libegl1) would be right");
}

HeadlessContext::~HeadlessContext() {
    release();
    eglDestroyContext(display_, context_);
    closeDisplay(display_);
}

void HeadlessContext::release() { release(previous_); }

void HeadlessContext::release(const Current& previous) {
    // Another context may have become current since; then it stays.
    if (eglGetCurrentContext() != context_) return;
    if (previous.context == EGL_NO_CONTEXT ||
        eglMakeCurrent(previous.display, previous.draw, previous.read, previous.context) == EGL_FALSE)
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

CurrentContext::CurrentContext(HeadlessContext& context) : context_(context) {
    // EGL keeps both, the API and what is current of it, per thread.
    eglBindAPI(EGL_OPENGL_API);
    previous_ = currentOfThread();
    if (eglMakeCurrent(context.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) == EGL_FALSE)
        throw Error(ErrorKind::Runtime,
                    "OpenGL: the context cannot be made current; it is in use on another thread");
}

CurrentContext::~CurrentContext() { context_.release(previous_); }

std::vector<DeviceLimit> deviceLimits() {
    const auto limit = [](const char* name, GLenum key, long long used) {
        GLint64 value = 0;
        glGetInteger64v(key, &value);
        return DeviceLimit{name, value, used};
    };
    return {limit("3D texture edge", GL_MAX_3D_TEXTURE_SIZE, 2048),
            limit("2D texture edge", GL_MAX_TEXTURE_SIZE, 16384),
            limit("storage blocks per compute shader", GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 16),
            limit("texture units", GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 32),
            limit("image units", GL_MAX_IMAGE_UNITS, 8),
            limit("bytes of a storage block", GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 1 << 27),
            limit("texels of a buffer texture", GL_MAX_TEXTURE_BUFFER_SIZE, 1 << 26)};
}

std::vector<std::pair<std::string, bool>> optionalExtensions() {
    std::vector<std::pair<std::string, bool>> found;
    for (const char* name : {"GL_ARB_shader_viewport_layer_array", "GL_EXT_texture_filter_anisotropic"})
        found.emplace_back(name, epoxy_has_gl_extension(name));
    return found;
}

void tuneAllocator() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    mallopt(M_TOP_PAD, 256 << 20);
#endif
}

}  // namespace conelight::platform
