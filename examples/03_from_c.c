/* SPDX-License-Identifier: MIT */
/* From C: a white floor and a red wall under a lamp, drawn without a display to a float picture (PFM).
 *     03_from_c OUT.pfm */
#include <conelight.h>
#include <stdio.h>
#include <stdlib.h>

static void check(conelight_result result) {
    if (result == CONELIGHT_OK) return;
    fprintf(stderr, "example: %s\n", conelight_message());
    exit(result);
}

// [sample]
static void add_quad(conelight_scene* scene, const float positions[12], float red, float green, float blue) {
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    conelight_mesh mesh = CONELIGHT_MESH_INIT;
    conelight_material material = CONELIGHT_MATERIAL_INIT;
    conelight_instance instance = CONELIGHT_INSTANCE_INIT;
    mesh.vertex_count = 4;
    mesh.positions = positions; /* metres */
    mesh.index_count = 6;
    mesh.indices = indices;
    material.base_color[0] = red;
    material.base_color[1] = green;
    material.base_color[2] = blue;
    check(conelight_scene_add_mesh(scene, &mesh, &instance.mesh));
    check(conelight_scene_add_material(scene, &material, &instance.material));
    check(conelight_scene_add_instance(scene, &instance, NULL));
}

static conelight_scene* corner(void) {
    static const float floor_corners[12] = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
    static const float wall_corners[12] = {-1, 0, 1, -1, 0, -1, -1, 2, -1, -1, 2, 1};
    conelight_scene* scene = NULL;
    conelight_light lamp = CONELIGHT_LIGHT_INIT;
    check(conelight_scene_create(&scene));
    add_quad(scene, floor_corners, 0.8f, 0.8f, 0.8f);
    add_quad(scene, wall_corners, 0.8f, 0.05f, 0.05f);
    lamp.position[0] = 0.5f;
    lamp.position[1] = 1.5f;
    lamp.intensity[0] = lamp.intensity[1] = lamp.intensity[2] = 10; /* W/sr */
    check(conelight_scene_add_light(scene, &lamp, NULL));
    return scene;
}

/* 4 * width * height floats: linear radiance and coverage, first row on top; the caller frees them. */
static float* draw_corner(int width, int height) {
    const size_t count = 4 * (size_t)width * (size_t)height;
    float* rgba = malloc(count * sizeof *rgba);
    conelight_scene* scene = corner();
    conelight_settings* settings = NULL;
    conelight_renderer* renderer = NULL;
    conelight_renderer_options options = CONELIGHT_RENDERER_OPTIONS_INIT;
    conelight_camera camera = CONELIGHT_CAMERA_INIT;
    if (rgba == NULL) exit(CONELIGHT_RUNTIME);
    options.headless = 1; /* 0: the OpenGL context that is current */
    camera.eye[1] = camera.eye[2] = 2.5f;
    check(conelight_settings_create(&settings));
    check(conelight_settings_set(settings, "voxels.size", "32"));
    check(conelight_renderer_create(&options, &renderer));
    check(conelight_renderer_set_scene(renderer, scene));
    check(conelight_renderer_render(renderer, &camera, width, height, settings, NULL));
    check(conelight_renderer_read(renderer, rgba, count));
    conelight_renderer_destroy(renderer);
    conelight_settings_destroy(settings);
    conelight_scene_destroy(scene);
    return rgba;
}
// [/sample]

int main(int argc, char** argv) {
    enum { WIDTH = 64, HEIGHT = 64 };
    float* rgba = NULL;
    FILE* file = argc == 2 ? fopen(argv[1], "wb") : NULL;
    int x, y;
    if (file == NULL) {
        fprintf(stderr, "usage: 03_from_c OUT.pfm\n");
        return CONELIGHT_USAGE;
    }
    rgba = draw_corner(WIDTH, HEIGHT);
    fprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT); /* little-endian, last row first */
    for (y = HEIGHT - 1; y >= 0; --y)
        for (x = 0; x < WIDTH; ++x) fwrite(rgba + 4 * (y * WIDTH + x), sizeof(float), 3, file);
    free(rgba);
    return fclose(file) == 0 ? 0 : CONELIGHT_RUNTIME;
}
