// SPDX-License-Identifier: MIT
#include "platform/headless_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <climits>

#include "conelight/error.h"

namespace conelight::platform {
namespace {

std::vector<EGLDeviceEXT> devices() {
    std::vector<EGLDeviceEXT> found;
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base") &&
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration"))
        return found;
    EGLint count = 0;
    if (eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count <= 0) return found;
    found.resize(static_cast<std::size_t>(count));
    eglQueryDevicesEXT(count, found.data(), &count);
    found.resize(static_cast<std::size_t>(count));
    return found;
}

std::string extensionsOf(EGLDeviceEXT device) {
    const char* text = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return text != nullptr ? text : "";
}

bool isSoftware(EGLDeviceEXT device) {
    return extensionsOf(device).find("EGL_MESA_device_software") != std::string::npos;
}

}  // namespace

std::vector<std::string> listDevices() {
    std::vector<std::string> lines;
    int index = 0;
    for (EGLDeviceEXT device : devices())
        lines.push_back(std::to_string(index++) + ": " + (isSoftware(device) ? "software" : "hardware") +
                        " (" + extensionsOf(device) + ")");
    return lines;
}

bool HeadlessContext::tryDisplay(void* display, const std::string& how, bool debug) {
    const auto failed = [&](const char* what) {
        tried_ += (tried_.empty() ? "" : ", ") + how + ": " + what;
        return false;
    };
    if (display == EGL_NO_DISPLAY) return failed("no display");
    EGLint major = 0, minor = 0;
    if (eglInitialize(display, &major, &minor) == EGL_FALSE) return failed("does not initialise");
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        eglTerminate(display);
        return failed("no desktop OpenGL");
    }
    // NVIDIA wants a config for contexts; Mesa's surfaceless platform may have none.
    const EGLint configAttributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE,
                                       EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint configCount = 0;
    if (eglChooseConfig(display, configAttributes, &config, 1, &configCount) == EGL_FALSE || configCount == 0)
        config = EGL_NO_CONFIG_KHR;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) {
        eglTerminate(display);
        return failed("no OpenGL 4.5 core context");
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        eglDestroyContext(display, context);
        eglTerminate(display);
        return failed("context cannot be current without a surface");
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
    if (options.device >= static_cast<int>(all.size()))
        throw Error(ErrorKind::Usage, "--device: there is no EGL device " + std::to_string(options.device) +
                                          "; 0 to " + std::to_string(static_cast<int>(all.size()) - 1) +
                                          " would be right");
    // Hardware devices first, then software ones, then surfaceless.
    for (const bool software : {false, true}) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (options.device >= 0 ? static_cast<int>(i) != options.device : isSoftware(all[i]) != software)
                continue;
            const std::string how = "EGL device " + std::to_string(i);
            if (tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, all[i], nullptr), how,
                           options.debug))
                return;
        }
        if (options.device >= 0) break;
    }
    if (options.device < 0 && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
        tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                   "EGL surfaceless", options.debug))
        return;
    throw Error(ErrorKind::NoGl, "OpenGL: no 4.5 core context without a display (" +
                                     (tried_.empty() ? std::string("EGL lists no device") : tried_) +
                                     "); installing Mesa (libgl1-mesa-dri, libegl1) would be right");
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

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
