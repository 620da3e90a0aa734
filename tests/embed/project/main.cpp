// SPDX-License-Identifier: MIT
// A host program outside the project: its own OpenGL context (EGL, no display), a scene made by hand, one
// picture, and one of a guest's mode. Input: nothing. Output: exit status 0 and one line when the picture is
// right, else the reason and status 1.
#include <conelight/error.h>
#include <conelight/renderer.h>
#include <conelight/thesis/settings.h>
#include <conelight/thesis/thesis.h>
#include <conelight/version.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

[[noreturn]] void fail(const std::string& why) {
    std::printf("embed: %s\n", why.c_str());
    std::exit(1);
}

// An EGL context of the first device that gives OpenGL 4.5 core.
void makeContext() {
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    eglQueryDevicesEXT(16, devices, &count);
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_CONTEXT_OPENGL_DEBUG,
                             EGL_TRUE,
                             EGL_NONE};
    for (EGLint i = 0; i < count; ++i) {
        EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
        eglBindAPI(EGL_OPENGL_API);
        EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
        if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
            return;
        eglTerminate(display);
    }
    fail("no OpenGL 4.5 context");
}

int glErrors = 0;

void addQuad(conelight::Scene& scene, glm::vec3 corner, glm::vec3 u, glm::vec3 v, glm::vec3 color) {
    conelight::Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    conelight::Material material;
    material.baseColor = glm::vec4(color, 1);
    scene.materials.push_back(material);
    conelight::Instance instance;
    instance.mesh = instance.material = static_cast<int>(scene.meshes.size()) - 1;
    scene.instances.push_back(instance);
}

// A white floor and a red wall at its left, under a lamp.
conelight::Scene floorAndWall() {
    conelight::Scene scene;
    addQuad(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, {0.8f, 0.8f, 0.8f});
    addQuad(scene, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, {0.8f, 0.05f, 0.05f});
    conelight::Light lamp;
    lamp.position = {0.5f, 1.5f, 0};
    lamp.intensity = glm::vec3(10);
    scene.lights.push_back(lamp);
    return scene;
}

// A mode that the library does not bring: it draws the floor, too.
void checkGuest(conelight::Renderer& renderer, const conelight::Camera& camera, int size) {
    conelight::Settings settings;
    settings.mode = conelight::thesis::kMode;
    settings.voxels.size = 32;
    renderer.render(camera, size, size, settings);
    const glm::vec4 floor = renderer.readImage().pixels[static_cast<std::size_t>(size / 2 * size + size / 2)];
    if (!std::isfinite(floor.g) || floor.g <= 0 || floor.a < 0.5f) fail("mode thesis draws no lit floor");
}

}  // namespace

int main() try {
    conelight::thesis::registerThesis();
    makeContext();
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*) {
            if (type != GL_DEBUG_TYPE_ERROR) return;
            ++glErrors;
            std::printf("embed: OpenGL: %s\n", message);
        },
        nullptr);

    // State that a host may have set; render() must leave it so.
    glViewport(1, 2, 33, 44);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);

    constexpr int kSize = 64;
    const conelight::Scene scene = floorAndWall();
    conelight::Camera camera;
    camera.eye = {0, 2.5f, 2.5f};
    camera.target = {0, 0, 0};
    conelight::Settings settings;
    settings.voxels.size = 32;
    conelight::Renderer renderer;
    renderer.setScene(scene);
    renderer.render(camera, kSize, kSize, settings);
    const conelight::Image image = renderer.readImage();

    GLint viewport[4];
    GLboolean depthMask = GL_TRUE;
    glGetIntegerv(GL_VIEWPORT, viewport);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask);
    if (viewport[0] != 1 || viewport[1] != 2 || viewport[2] != 33 || viewport[3] != 44 ||
        !glIsEnabled(GL_BLEND) || depthMask != GL_FALSE)
        fail("render() changed the state of its host");

    if (image.width != kSize || image.height != kSize) fail("wrong size");
    for (const glm::vec4& pixel : image.pixels)
        if (!std::isfinite(pixel.r + pixel.g + pixel.b) || pixel.r < 0) fail("a pixel that is no radiance");

    // Halfway down the picture lies the floor. Near the wall it must be redder than far from it: light that
    // bounced, which no direct light can imitate, since lamp and floor are white.
    const auto redness = [&](int x) {
        const glm::vec4 pixel = image.pixels[static_cast<std::size_t>(kSize / 2 * kSize + x)];
        if (pixel.a < 0.5f || pixel.g <= 0) fail("no lit floor where there should be");
        return pixel.r / pixel.g;
    };
    const float near = redness(kSize * 5 / 16), far = redness(kSize * 11 / 16);
    if (!(near > far * 1.01f))
        fail("no light bounces off the wall: " + std::to_string(near) + " " + std::to_string(far));
    checkGuest(renderer, camera, kSize);
    if (glErrors != 0) fail("OpenGL errors");
    std::printf("embed: Conelight %s drew %d x %d pixels\n", CONELIGHT_VERSION_STRING, image.width,
                image.height);
    return 0;
} catch (const conelight::Error& error) {
    fail(error.what());
}
