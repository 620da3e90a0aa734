// SPDX-License-Identifier: MIT
// A host program outside the project: its own OpenGL context (EGL, no display), a scene made by hand, one
// picture, one of a guest's mode, copies of the picture in the host's textures, and C in the same context. Input: the
// name of a file. Output: the picture there (PFM), exit status 0 and one line when all is right, else the reason and
// status 1.
#include <conelight.h>
#include <conelight/error.h>
#include <conelight/renderer.h>
#include <conelight/thesis/settings.h>
#include <conelight/thesis/thesis.h>
#include <conelight/version.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

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

// Halfway down the picture lies the floor. Near the wall it must be redder than far from it: light that
// bounced, which no direct light can imitate, since lamp and floor are white.
void checkBounce(const conelight::Image& image) {
    const int size = image.width;
    const auto redness = [&](int x) {
        const glm::vec4 pixel = image.pixels[static_cast<std::size_t>(size / 2 * size + x)];
        if (pixel.a < 0.5f || pixel.g <= 0) fail("no lit floor where there should be");
        return pixel.r / pixel.g;
    };
    const float near = redness(size * 5 / 16), far = redness(size * 11 / 16);
    if (!(near > far * 1.01f))
        fail("no light bounces off the wall: " + std::to_string(near) + " " + std::to_string(far));
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

// The host's texture, of the picture's size or not.
struct HostTexture {
    GLuint name = 0;
    int size = 0;
    HostTexture(GLenum format, int edge) : size(edge) {
        glCreateTextures(GL_TEXTURE_2D, 1, &name);
        glTextureStorage2D(name, 1, format, edge, edge);
    }
    ~HostTexture() { glDeleteTextures(1, &name); }
    HostTexture(const HostTexture&) = delete;
    HostTexture& operator=(const HostTexture&) = delete;

    // Row 0 is the lowest.
    std::vector<glm::vec4> pixels() const {
        std::vector<glm::vec4> all(static_cast<std::size_t>(size * size));
        glGetTextureImage(name, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(all.size() * sizeof(glm::vec4)),
                          all.data());
        return all;
    }
};

template <class Call>
bool refused(conelight::ErrorKind kind, Call&& call) {
    try {
        call();
    } catch (const conelight::Error& error) {
        return error.kind() == kind;
    }
    return false;
}

void checkCopies(conelight::Renderer& renderer, const conelight::Image& image) {
    const int size = image.width, margin = 5;
    const HostTexture same(GL_RGBA32F, size), larger(GL_RGBA32F, size + 2 * margin),
        integers(GL_RGBA8UI, size);
    renderer.copyToTexture(same.name);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, larger.name, 0);
    renderer.copyToFramebuffer(framebuffer, margin, margin);
    const std::vector<glm::vec4> copy = same.pixels(), inside = larger.pixels();
    for (int y = 0; y < size; ++y) {
        const auto row = static_cast<std::size_t>(size) * sizeof(glm::vec4);
        const glm::vec4* shown = &image.pixels[static_cast<std::size_t>((size - 1 - y) * size)];
        if (std::memcmp(shown, &copy[static_cast<std::size_t>(y * size)], row) != 0 ||
            std::memcmp(shown, &inside[static_cast<std::size_t>((y + margin) * larger.size + margin)], row) !=
                0)
            fail("a copy of the picture has other pixels");
    }
    using conelight::ErrorKind;
    if (!refused(ErrorKind::Usage, [&] { renderer.copyToTexture(larger.name); }) ||
        !refused(ErrorKind::Usage, [&] { renderer.copyToTexture(integers.name); }) ||
        !refused(ErrorKind::Usage, [&] { renderer.copyToTexture(12345); }) ||
        !refused(ErrorKind::Usage, [&] { renderer.copyToFramebuffer(12345, 0, 0); }))
        fail("a target that cannot hold the picture is taken");
    glDeleteFramebuffers(1, &framebuffer);
}

void check(conelight_result result) {
    if (result != CONELIGHT_OK) fail(conelight_message());
}

// By C: every material blue, then every instance out of sight.
void checkChangesInC(conelight_renderer* renderer, const conelight_scene* scene, int size) {
    std::vector<glm::vec4> read(static_cast<std::size_t>(size * size));
    const auto draw = [&] {
        check(conelight_renderer_render(renderer, nullptr, size, size, nullptr, "albedo"));
        check(conelight_renderer_read(renderer, &read[0].x, 4 * read.size()));
    };
    conelight_counts counts = CONELIGHT_COUNTS_INIT;
    check(conelight_scene_get_counts(scene, &counts));
    conelight_material blue = CONELIGHT_MATERIAL_INIT;
    blue.base_color[0] = blue.base_color[1] = 0;
    blue.size = offsetof(conelight_material, coat);  // of a program that knows no coats
    blue.coat = 2;                                   // of no matter for that size
    for (std::size_t i = 0; i < counts.materials; ++i)
        check(conelight_renderer_set_material(renderer, i, &blue));
    draw();
    for (const glm::vec4& pixel : read)
        if (pixel.r != 0 || pixel.g != 0 || (pixel.a > 0) != (pixel.b > 0))
            fail("C: a material did not change");
    for (std::size_t i = 0; i < counts.instances; ++i) {
        conelight_instance instance = CONELIGHT_INSTANCE_INIT;
        check(conelight_scene_get_instance(scene, i, &instance));
        instance.world_from_object[13] += 1000;  // m, up
        check(conelight_renderer_set_transform(renderer, i, instance.world_from_object));
    }
    draw();
    for (const glm::vec4& pixel : read)
        if (pixel.a != 0) fail("C: an instance did not move");
}

// By C: the top row first in a texture, as in memory, where that is asked for; options of a program that cannot ask.
void checkRowsInC(const conelight_scene* scene, int size) {
    for (const bool topFirst : {true, false}) {
        conelight_renderer_options options = CONELIGHT_RENDERER_OPTIONS_INIT;
        options.top_first = 1;
        if (!topFirst) options.size = offsetof(conelight_renderer_options, top_first);
        conelight_renderer* renderer = nullptr;
        check(conelight_renderer_create(&options, &renderer));
        check(conelight_renderer_set_scene(renderer, scene));
        check(conelight_renderer_render(renderer, nullptr, size, size, nullptr, "normal"));
        std::vector<glm::vec4> read(static_cast<std::size_t>(size * size)), turned;
        check(conelight_renderer_read(renderer, &read[0].x, 4 * read.size()));
        for (int y = size - 1; y >= 0; --y)
            turned.insert(turned.end(), read.begin() + y * size, read.begin() + (y + 1) * size);
        const HostTexture texture(GL_RGBA32F, size);
        check(conelight_renderer_copy_to_texture(renderer, texture.name));
        if (texture.pixels() != (topFirst ? read : turned) || read == turned)
            fail("C: rows of a texture in another order");
        conelight_renderer_destroy(renderer);
    }
}

// By C: a coat and sheen arrive in the scene, as its file tells.
void checkLayersInC(const std::string& file) {
    conelight_scene* scene = nullptr;
    check(conelight_scene_create(&scene));
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint32_t triangle[3] = {0, 1, 2};
    conelight_mesh mesh = CONELIGHT_MESH_INIT;
    mesh.positions = corners;
    mesh.indices = triangle;
    mesh.vertex_count = mesh.index_count = 3;
    conelight_material cloth = CONELIGHT_MATERIAL_INIT;
    cloth.coat = 0.5f;
    cloth.coat_roughness = 0.25f;
    cloth.sheen_color[0] = cloth.sheen_color[1] = cloth.sheen_color[2] = 0.125f;
    cloth.sheen_roughness = 0.75f;
    conelight_instance instance = CONELIGHT_INSTANCE_INIT;
    std::int32_t index = 0;
    check(conelight_scene_add_mesh(scene, &mesh, &instance.mesh));
    check(conelight_scene_add_material(scene, &cloth, &instance.material));
    check(conelight_scene_add_instance(scene, &instance, &index));
    check(conelight_scene_save(scene, file.c_str(), 1));
    conelight_scene_destroy(scene);
    std::ifstream saved(file);
    const std::string text{std::istreambuf_iterator<char>(saved), {}};
    for (const char* value :
         {"\"clearcoatFactor\": 0.5", "\"clearcoatRoughnessFactor\": 0.25", "\"sheenRoughnessFactor\": 0.75"})
        if (text.find(value) == std::string::npos)
            fail("C: a scene's file does not say " + std::string(value));
}

// By C, in this context: the same picture in a texture of the host and in memory.
void checkC() {
    constexpr int kSize = 16;
    conelight_scene* scene = nullptr;
    conelight_renderer* renderer = nullptr;
    check(conelight_scene_load("builtin:cornell", 0, &scene));
    check(conelight_renderer_create(nullptr, &renderer));
    check(conelight_renderer_set_scene(renderer, scene));
    check(conelight_renderer_render(renderer, nullptr, kSize, kSize, nullptr, "albedo"));
    const HostTexture texture(GL_RGBA32F, kSize);
    const HostTexture target(GL_RGBA32F, kSize);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target.name, 0);
    check(conelight_renderer_copy_to_texture(renderer, texture.name));
    check(conelight_renderer_copy_to_framebuffer(renderer, framebuffer, 0, 0));
    glDeleteFramebuffers(1, &framebuffer);
    std::vector<glm::vec4> read(static_cast<std::size_t>(kSize * kSize));
    check(conelight_renderer_read(renderer, &read[0].x, 4 * read.size()));
    if (read[0] != texture.pixels()[static_cast<std::size_t>(kSize * (kSize - 1))] || !(read[136].r > 0) ||
        texture.pixels() != target.pixels())
        fail("C: a copy of the picture has other pixels");
    checkRowsInC(scene, kSize);
    checkChangesInC(renderer, scene, kSize);
    conelight_renderer_destroy(renderer);
    conelight_scene_destroy(scene);
}

// Without a context the renderer says so, and its end is no crash.
void checkLostContext(conelight::Renderer& renderer, const conelight::Camera& camera) {
    eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    const auto render = [&] { renderer.render(camera, 8, 8, conelight::Settings{}); };
    if (!refused(conelight::ErrorKind::NoGl, render)) fail("a renderer draws without a context");
}

void writePfm(const char* path, const conelight::Image& image) {
    std::FILE* file = std::fopen(path, "wb");
    if (file == nullptr) fail("the picture cannot be written");
    std::fprintf(file, "PF\n%d %d\n-1.0\n", image.width, image.height);
    for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x)
            std::fwrite(&image.pixels[static_cast<std::size_t>(y * image.width + x)], sizeof(float), 3, file);
    std::fclose(file);
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) fail("usage: embed OUT.pfm");
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

    checkBounce(image);
    checkCopies(renderer, image);
    writePfm(argv[1], image);
    checkLayersInC(std::string(argv[1]) + ".gltf");
    checkGuest(renderer, camera, kSize);
    checkC();
    checkLostContext(renderer, camera);
    if (glErrors != 0) fail("OpenGL errors");
    std::printf("embed: Conelight %s drew %d x %d pixels\n", CONELIGHT_VERSION_STRING, image.width,
                image.height);
    return 0;
} catch (const conelight::Error& error) {
    fail(error.what());
}
