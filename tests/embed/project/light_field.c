/* SPDX-License-Identifier: MIT */
/* A renderer in C that is lit by a light field: a floor beside a red wall, seen from above by parallel rays, so that its
 * depths and normals are known. Checks the light that it is told. Output: exit status 0 and one line, else the reason and
 * status 1. */
#include <conelight.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 16, BLOCK = 3, TEXTURE = 5 };

static void fail(const char* why) {
    printf("light_field: %s\n", why);
    exit(1);
}

static void check(conelight_result result) {
    if (result != CONELIGHT_OK) fail(conelight_message());
}

static void make_context(void) {
    static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    EGLDeviceEXT devices[16];
    EGLint count = 0, i;
    eglQueryDevicesEXT(16, devices, &count);
    for (i = 0; i < count; ++i) {
        EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
        EGLContext context;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL)) continue;
        eglBindAPI(EGL_OPENGL_API);
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
        if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
            return;
        eglTerminate(display);
    }
    fail("no OpenGL 4.5 context");
}

static conelight_instance add_quad(conelight_scene* scene, const float positions[12], const float color[3]) {
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    conelight_mesh mesh = CONELIGHT_MESH_INIT;
    conelight_material material = CONELIGHT_MATERIAL_INIT;
    conelight_instance instance = CONELIGHT_INSTANCE_INIT;
    mesh.vertex_count = 4;
    mesh.positions = positions;
    mesh.index_count = 6;
    mesh.indices = indices;
    memcpy(material.base_color, color, 3 * sizeof *color);
    check(conelight_scene_add_mesh(scene, &mesh, &instance.mesh));
    check(conelight_scene_add_material(scene, &material, &instance.material));
    check(conelight_scene_add_instance(scene, &instance, NULL));
    return instance;
}

/* Instance 0: the floor, y = 0, x and z in [-1,1]. 1: a wall at its left, which `wall` receives. */
static conelight_scene* make_scene(conelight_instance* wall) {
    static const float floor_corners[12] = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
    static const float wall_corners[12] = {-1, 0, 1, -1, 0, -1, -1, 2, -1, -1, 2, 1};
    static const float white[3] = {0.8f, 0.8f, 0.8f}, red[3] = {0.8f, 0.05f, 0.05f};
    conelight_scene* scene = NULL;
    conelight_light lamp = CONELIGHT_LIGHT_INIT;
    check(conelight_scene_create(&scene));
    add_quad(scene, floor_corners, white);
    *wall = add_quad(scene, wall_corners, red);
    lamp.position[0] = 0.5f;
    lamp.position[1] = 1.5f;
    lamp.intensity[0] = lamp.intensity[1] = lamp.intensity[2] = 10;
    check(conelight_scene_add_light(scene, &lamp, NULL));
    return scene;
}

static GLuint texture_of(GLenum format, float r, float g, float b) {
    const float value[4] = {r, g, b, 1};
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, format, SIZE, SIZE);
    glClearTexImage(name, 0, GL_RGBA, GL_FLOAT, value);
    return name;
}

/* The floor from a height of 3 m, between planes at 1 and 5 m: right is x, up is -z, halfway deep. */
static conelight_surfaces floor_from_above(void) {
    static const float view[16] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -3, 1};
    static const float clip[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5f, 0, 0, 0, -1.5f, 1};
    conelight_surfaces surfaces = CONELIGHT_SURFACES_INIT;
    surfaces.width = surfaces.height = SIZE;
    memcpy(surfaces.view_from_world, view, sizeof view);
    memcpy(surfaces.clip_from_view, clip, sizeof clip);
    surfaces.depth = texture_of(GL_R32F, 0.5f, 0, 0);
    surfaces.normal = texture_of(GL_RGBA8, 0.5f, 1, 0.5f);
    surfaces.normal_encoding = CONELIGHT_NORMAL_WORLD_UNORM;
    surfaces.roughness = texture_of(GL_RG8, 1, 0.1f, 0);
    surfaces.roughness_channel = 1;
    surfaces.reflectance = texture_of(GL_RGBA8, 0.9f, 0.9f, 0.9f);
    return surfaces;
}

static void read_back(GLuint texture, float rgba[4 * SIZE * SIZE]) {
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, 4 * SIZE * SIZE * sizeof(float), rgba);
}

/* Light at the floor after a few updates and frames; mean of its red. */
static double gather(conelight_light_field* field, int32_t view, const conelight_surfaces* surfaces,
                     conelight_gathered* gathered, float rgba[4 * SIZE * SIZE]) {
    conelight_budget budget = CONELIGHT_BUDGET_INIT;
    int32_t updates = 0;
    double red = 0;
    int i;
    budget.updates = 4;
    for (i = 0; i < 16; ++i) {
        check(conelight_light_field_update(field, &budget, &updates));
        check(conelight_light_field_gather(field, view, surfaces, 1, gathered));
    }
    if (updates < 1 || gathered->width != SIZE || gathered->height != SIZE)
        fail("no light, or of another size");
    read_back(gathered->diffuse, rgba);
    for (i = 0; i < SIZE * SIZE; ++i) {
        if (!isfinite(rgba[4 * i]) || rgba[4 * i + 3] != 1) fail("a pixel of the floor has no light");
        red += rgba[4 * i] / (SIZE * SIZE);
    }
    return red;
}

/* What the host's shaders read at the middle of the floor, W/(sr m^2). */
static float looked_up(const conelight_light_field* field) {
    static const char* const main_of =
        "layout(local_size_x = 1) in;\n"
        "layout(std430, binding = 0) buffer Result { vec4 found; };\n"
        "void main() { found = vec4(conelight_irradiance(vec3(0), vec3(0, 1, 0)), 1); }\n";
    const char* texts[3] = {"#version 450 core\n", NULL, main_of};
    const float nothing[4] = {0, 0, 0, 0};
    float found[4] = {0, 0, 0, 0};
    GLuint program, buffer = 0;
    GLint linked = 0;
    check(conelight_lookups_glsl(BLOCK, TEXTURE, &texts[1]));
    program = glCreateProgram();
    {
        const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
        glShaderSource(shader, 3, texts, NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glLinkProgram(program);
        glDeleteShader(shader);
    }
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fail("the text for shaders does not compile");
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, sizeof nothing, nothing, 0);
    check(conelight_light_field_bind_lookups(field, BLOCK, TEXTURE));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof found, found);
    glUseProgram(0);
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);
    if (found[3] != 1) fail("the shader did not run");
    return found[0];
}

/* Near the wall light is redder than far from it; reflections show the wall; shaders of the host read the same light. */
static double check_light(conelight_light_field* field, int32_t view, const conelight_surfaces* surfaces) {
    static float rgba[4 * SIZE * SIZE], specular[4 * SIZE * SIZE];
    conelight_gathered gathered = CONELIGHT_GATHERED_INIT;
    const double red = gather(field, view, surfaces, &gathered, rgba);
    const float* row = rgba + 4 * SIZE * (SIZE / 2);
    const float read = looked_up(field), shown = row[4 * (SIZE / 2)];
    if (!(row[4] > 2 * row[4 * (SIZE - 2)]) || !(row[4] > 4 * row[5])) fail("no red light near the wall");
    if (!(read > 0.5f * shown && read < 2 * shown)) fail("shaders read other light than pixels");
    if (gathered.specular == 0) fail("no reflections");
    read_back(gathered.specular, specular);
    if (!(specular[4 * SIZE * (SIZE / 2) + 4] >= 0) || memcmp(specular, rgba, sizeof rgba) == 0)
        fail("reflections are none");
    return red;
}

/* Without the wall the floor receives nothing; with a new one it does, and half as much from half the light. */
static void check_changes(conelight_light_field* field, int32_t view, const conelight_surfaces* surfaces,
                          const conelight_instance* wall, double with_wall) {
    static float rgba[4 * SIZE * SIZE];
    conelight_gathered gathered = CONELIGHT_GATHERED_INIT;
    conelight_light lamp = CONELIGHT_LIGHT_INIT;
    conelight_scene* others = NULL;
    int32_t index = CONELIGHT_NONE;
    double red;
    check(conelight_light_field_remove_instance(field, 1));
    red = gather(field, view, surfaces, &gathered, rgba);
    if (red > 0.04 * with_wall) fail("a wall that was removed gives light");
    check(conelight_light_field_add_instance(field, wall, &index));
    if (index != 1) fail("an instance has another index than it should");
    red = gather(field, view, surfaces, &gathered, rgba);
    if (fabs(red - with_wall) > 0.06 * with_wall) fail("a wall that was added gives other light");
    check(conelight_scene_create(&others));
    lamp.position[0] = 0.5f;
    lamp.position[1] = 1.5f;
    lamp.intensity[0] = lamp.intensity[1] = lamp.intensity[2] = 5;
    check(conelight_scene_add_light(others, &lamp, NULL));
    check(conelight_light_field_set_lights(field, others));
    conelight_scene_destroy(others);
    red = gather(field, view, surfaces, &gathered, rgba);
    if (fabs(red - 0.5 * with_wall) > 0.04 * with_wall) fail("half the light gives no half of it");
}

/* The wall again, in buffers of the host's, with short indices and words between its corners. */
static void check_host_mesh(conelight_light_field* field, int32_t view, const conelight_surfaces* surfaces,
                            conelight_instance wall, double with_wall) {
    static const float corners[16] = {-1, 0, 1, 9, -1, 0, -1, 9, -1, 2, -1, 9, -1, 2, 1, 9};
    static const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    static float rgba[4 * SIZE * SIZE];
    conelight_gathered gathered = CONELIGHT_GATHERED_INIT;
    conelight_host_mesh mesh = CONELIGHT_HOST_MESH_INIT;
    int32_t index = CONELIGHT_NONE;
    GLuint buffers[2];
    double red;
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], sizeof corners, corners, 0);
    glNamedBufferStorage(buffers[1], sizeof indices, indices, 0);
    mesh.vertex_count = 4;
    mesh.index_count = 6;
    mesh.positions.buffer = buffers[0];
    mesh.positions.stride = 16;
    mesh.indices = buffers[1];
    mesh.short_indices = 1;
    mesh.low[0] = mesh.low[2] = -1;
    mesh.high[0] = -1;
    mesh.high[1] = 2;
    mesh.high[2] = 1;
    check(conelight_light_field_add_host_mesh(field, &mesh, &wall.mesh));
    check(conelight_light_field_remove_instance(field, 1));
    check(conelight_light_field_add_instance(field, &wall, &index));
    red = gather(field, view, surfaces, &gathered, rgba);
    if (fabs(red - with_wall) > 0.06 * with_wall) fail("a wall in the host's buffers gives other light");
    check(conelight_light_field_set_host_mesh(field, (size_t)wall.mesh, &mesh));
    mesh.positions.stride = 10;
    if (conelight_light_field_set_host_mesh(field, (size_t)wall.mesh, &mesh) != CONELIGHT_BAD_INPUT)
        fail("a stride that is none is taken");
    glDeleteBuffers(2, buffers);
}

/* The wall with a texture of the host's: grey ones give half the light, white ones all of it. */
static void check_host_texture(conelight_light_field* field, int32_t view, const conelight_surfaces* surfaces,
                               conelight_instance wall, double with_wall) {
    static const float red[3] = {0.8f, 0.05f, 0.05f};
    static float rgba[4 * SIZE * SIZE];
    conelight_gathered gathered = CONELIGHT_GATHERED_INIT;
    conelight_material material = CONELIGHT_MATERIAL_INIT;
    conelight_host_texture texture = CONELIGHT_HOST_TEXTURE_INIT;
    const GLuint grey = texture_of(GL_RGBA32F, 0.5f, 0.5f, 0.5f), white = texture_of(GL_RGBA8, 1, 1, 1);
    int32_t index = CONELIGHT_NONE;
    double shown;
    texture.texture = grey;
    texture.clamp = 1;
    check(conelight_light_field_add_host_texture(field, &texture, &material.base_color_texture));
    memcpy(material.base_color, red, sizeof red);
    check(conelight_light_field_add_material(field, &material, &wall.material));
    check(conelight_light_field_remove_instance(field, 1));
    check(conelight_light_field_add_instance(field, &wall, &index));
    shown = gather(field, view, surfaces, &gathered, rgba);
    if (fabs(shown - 0.5 * with_wall) > 0.06 * with_wall) fail("a grey texture gives no half of the light");
    texture.texture = white;
    check(conelight_light_field_set_host_texture(field, (size_t)material.base_color_texture, &texture));
    shown = gather(field, view, surfaces, &gathered, rgba);
    if (fabs(shown - with_wall) > 0.06 * with_wall) fail("a white texture changes the light");
    texture.texture = 0;
    if (conelight_light_field_set_host_texture(field, (size_t)material.base_color_texture, &texture) !=
        CONELIGHT_BAD_INPUT)
        fail("no texture is taken for one");
    glDeleteTextures(1, &grey);
    glDeleteTextures(1, &white);
}

static void check_stats(conelight_light_field* field) {
    conelight_light_field_stats stats = CONELIGHT_LIGHT_FIELD_STATS_INIT;
    conelight_pass pass = CONELIGHT_PASS_INIT;
    conelight_texture texture = CONELIGHT_TEXTURE_INIT;
    static const uint8_t texel[4] = {9, 9, 9, 255};
    check(conelight_light_field_set_profiling(field, 1));
    check(conelight_light_field_update(field, NULL, NULL));
    check(conelight_light_field_get_stats(field, &stats));
    if (stats.voxels < 100 || stats.faces < stats.voxels || stats.memory_bytes < 100000)
        fail("a field does not say what it holds");
    if (stats.pass_count == 0 || !(stats.wall_ms > 0)) fail("a field does not say what an update took");
    check(conelight_light_field_get_pass(field, 0, &pass));
    if (strcmp(pass.name, "update") != 0 || pass.wall_ms != stats.wall_ms) fail("the first pass is not the whole");
    if (conelight_light_field_get_pass(field, stats.pass_count, &pass) != CONELIGHT_USAGE)
        fail("a pass beyond the last is told");
    check(conelight_light_field_set_profiling(field, 0));
    texture.width = texture.height = 1;
    texture.rgba = texel;
    if (conelight_light_field_set_texture(field, 0, &texture) != CONELIGHT_USAGE)
        fail("a texture that is not there is set");
    check(conelight_light_field_add_texture(field, &texture, NULL));
    check(conelight_light_field_set_texture(field, 0, &texture));
}

static void check_refusals(conelight_light_field* field, int32_t view, conelight_surfaces surfaces) {
    conelight_gathered gathered = CONELIGHT_GATHERED_INIT;
    conelight_budget budget = CONELIGHT_BUDGET_INIT;
    budget.updates = -1;
    surfaces.normal_encoding = 7;
    if (conelight_light_field_gather(field, view, &surfaces, 1, &gathered) != CONELIGHT_USAGE ||
        conelight_light_field_gather(field, view + 5, &surfaces, 1, &gathered) != CONELIGHT_USAGE ||
        conelight_light_field_update(field, &budget, NULL) != CONELIGHT_USAGE ||
        conelight_light_field_remove_view(field, view + 5) != CONELIGHT_USAGE ||
        conelight_light_field_bind_lookups(field, 100000, 0) != CONELIGHT_USAGE)
        fail("wrong usage is taken");
    surfaces.normal_encoding = CONELIGHT_NORMAL_WORLD_UNORM;
    surfaces.width = 0;
    check(conelight_light_field_gather(field, view, &surfaces, 1, &gathered));
    if (gathered.diffuse != 0) fail("a picture of no pixels has light");
}

int main(void) {
    conelight_light_field* field = NULL;
    conelight_settings* settings = NULL;
    conelight_scene* scene;
    conelight_instance wall;
    conelight_surfaces surfaces;
    int32_t view = CONELIGHT_NONE;
    double red;
    if (conelight_light_field_create(NULL, &field) != CONELIGHT_NO_GL) fail("a field without a context");
    make_context();
    check(conelight_light_field_create(NULL, &field));
    check(conelight_settings_create_realtime(&settings));
    check(conelight_settings_set(settings, "voxels.size", "32"));
    check(conelight_light_field_set_settings(field, settings));
    conelight_settings_destroy(settings);
    scene = make_scene(&wall);
    check(conelight_light_field_set_scene(field, scene));
    conelight_scene_destroy(scene);
    check(conelight_light_field_add_view(field, &view));
    surfaces = floor_from_above();
    red = check_light(field, view, &surfaces);
    check_changes(field, view, &surfaces, &wall, red);
    check_host_mesh(field, view, &surfaces, wall, 0.5 * red);
    check_stats(field);
    check_refusals(field, view, surfaces);
    check_host_texture(field, view, &surfaces, wall, 0.5 * red);
    check(conelight_light_field_remove_view(field, view));
    if (glGetError() != GL_NO_ERROR) fail("OpenGL errors");
    conelight_light_field_destroy(field);
    printf("light_field: %d x %d pixels, mean red %.3f\n", SIZE, SIZE, red);
    return 0;
}
