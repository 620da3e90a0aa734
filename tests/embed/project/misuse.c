/* SPDX-License-Identifier: MIT */
/* A host in C that does everything wrong: each call must answer with its error code and a message, and none may end the
 * process or write. Input: nothing. Output: exit status 0 and one line, else what was answered and status 1. */
#include <conelight.h>
#include <stdio.h>
#include <string.h>

static int faults = 0, calls = 0;

static void expect_at(int line, conelight_result wanted, conelight_result got) {
    ++calls;
    if (got == wanted && (wanted == CONELIGHT_OK || conelight_message()[0] != '\0')) return;
    ++faults;
    printf("misuse.c:%d: %d instead of %d: %s\n", line, (int)got, (int)wanted, conelight_message());
}
#define EXPECT(wanted, call) expect_at(__LINE__, wanted, call)

static void null_pointers(void) {
    conelight_camera camera = CONELIGHT_CAMERA_INIT;
    float numbers[3] = {0, 0, 0};
    uint8_t byte = 0;
    EXPECT(CONELIGHT_USAGE, conelight_scene_create(NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_load(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_save(NULL, NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_mesh(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_texture(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_material(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_instance(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_light(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_set_sky(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_set_environment(NULL, NULL, 0, 1));
    EXPECT(CONELIGHT_USAGE, conelight_scene_get_counts(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_get_camera(NULL, 0, &camera));
    EXPECT(CONELIGHT_USAGE, conelight_scene_get_light(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_get_instance(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_scene_get_bounds(NULL, numbers, numbers));
    EXPECT(CONELIGHT_USAGE, conelight_scene_frame(NULL, &camera));
    EXPECT(CONELIGHT_USAGE, conelight_settings_create(NULL));
    EXPECT(CONELIGHT_USAGE, conelight_settings_set(NULL, "mode", "phong"));
    EXPECT(CONELIGHT_USAGE, conelight_settings_get(NULL, "mode", NULL));
    EXPECT(CONELIGHT_USAGE, conelight_settings_follow(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_create(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_scene(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_transform(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_material(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_light(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_sky(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_render(NULL, NULL, 1, 1, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_read(NULL, numbers, 3));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_read_display(NULL, NULL, &byte, 1));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_copy_to_framebuffer(NULL, 0, 0, 0));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_copy_to_texture(NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_profiling(NULL, 1));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_get_stats(NULL, NULL));
    EXPECT(CONELIGHT_OK, conelight_set_log(NULL, NULL));
    conelight_scene_destroy(NULL);
    conelight_settings_destroy(NULL);
    conelight_renderer_destroy(NULL);
    if (conelight_scene_note(NULL, 0) != NULL) ++faults;
}

static void null_changes(void) {
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_instance(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_mesh(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_lights(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_environment(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_mesh(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_texture(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_texture(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_host_mesh(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_host_mesh(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_host_texture(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_host_texture(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_material(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_instance(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_remove_instance(NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_remove_mesh(NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_region(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_instance(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_mesh(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_lights(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_environment(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_mesh(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_texture(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_texture(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_host_mesh(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_host_mesh(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_host_texture(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_host_texture(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_profiling(NULL, 1));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_get_stats(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_get_pass(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_material(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_instance(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_remove_instance(NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_remove_mesh(NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_region(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_create(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_scene(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_settings(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_transform(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_material(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_light(NULL, 0, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_set_sky(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_update(NULL, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_add_view(NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_remove_view(NULL, 0));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_gather(NULL, 0, NULL, 1, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_light_field_bind_lookups(NULL, 0, 0));
    EXPECT(CONELIGHT_USAGE, conelight_settings_create_realtime(NULL));
    EXPECT(CONELIGHT_USAGE, conelight_lookups_glsl(0, 0, NULL));
    conelight_light_field_destroy(NULL);
}

static void wrong_scenes(conelight_scene* scene) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint32_t beyond[3] = {0, 1, 7};
    conelight_mesh mesh = CONELIGHT_MESH_INIT;
    conelight_light light = CONELIGHT_LIGHT_INIT;
    conelight_texture texture = CONELIGHT_TEXTURE_INIT;
    conelight_scene* none = NULL;
    conelight_camera camera = CONELIGHT_CAMERA_INIT;
    int32_t index = 77;
    EXPECT(CONELIGHT_BAD_INPUT, conelight_scene_load("/nowhere/at/all.glb", 0, &none));
    EXPECT(CONELIGHT_USAGE, conelight_scene_load("builtin:nothing", 0, &none));
    EXPECT(CONELIGHT_USAGE, conelight_scene_load("builtin:cornell", 64, &none));
    if (none != NULL) ++faults;
    EXPECT(CONELIGHT_BAD_INPUT, conelight_scene_frame(scene, &camera));
    mesh.size = 4;
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_mesh(scene, &mesh, &index));
    mesh.size = sizeof mesh;
    mesh.vertex_count = mesh.index_count = 3;
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_mesh(scene, &mesh, &index));
    light.type = 9;
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_light(scene, &light, &index));
    EXPECT(CONELIGHT_USAGE, conelight_scene_add_texture(scene, &texture, &index));
    if (index != 77) ++faults;
    mesh.positions = positions;
    mesh.indices = beyond;
    EXPECT(CONELIGHT_OK, conelight_scene_add_mesh(scene, &mesh, &index));
    if (index != 0) ++faults;
}

static void wrong_pictures(conelight_renderer* renderer, const conelight_scene* bad) {
    conelight_scene* scene = NULL;
    conelight_camera camera = CONELIGHT_CAMERA_INIT;
    conelight_stats stats = CONELIGHT_STATS_INIT;
    conelight_host_mesh mesh = CONELIGHT_HOST_MESH_INIT;
    conelight_material material = CONELIGHT_MATERIAL_INIT;
    static float rgba[4 * 8 * 8];
    EXPECT(CONELIGHT_USAGE, conelight_renderer_render(renderer, &camera, 8, 8, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_sky(renderer, rgba));
    EXPECT(CONELIGHT_BAD_INPUT, conelight_renderer_set_scene(renderer, bad));
    EXPECT(CONELIGHT_OK, conelight_scene_load("builtin:cornell", 0, &scene));
    EXPECT(CONELIGHT_OK, conelight_renderer_set_scene(renderer, scene));
    conelight_scene_destroy(scene);
    EXPECT(CONELIGHT_USAGE, conelight_renderer_read(renderer, rgba, 4 * 8 * 8));
    EXPECT(CONELIGHT_OK, conelight_renderer_render(renderer, NULL, 0, 8, NULL, NULL));  // a minimised window
    EXPECT(CONELIGHT_USAGE, conelight_renderer_read(renderer, rgba, 4 * 8 * 8));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_render(renderer, NULL, -1, 8, NULL, NULL));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_render(renderer, NULL, 8, 8, NULL, "nothing"));
    camera.fov_y = 0;
    EXPECT(CONELIGHT_USAGE, conelight_renderer_render(renderer, &camera, 8, 8, NULL, NULL));
    camera.fov_y = 1;
    camera.orthographic_height = 2;
    EXPECT(CONELIGHT_OK, conelight_renderer_render(renderer, &camera, 8, 8, NULL, "depth"));
    camera.orthographic_height = -2;
    EXPECT(CONELIGHT_USAGE, conelight_renderer_render(renderer, &camera, 8, 8, NULL, NULL));
    EXPECT(CONELIGHT_OK, conelight_renderer_render(renderer, NULL, 8, 8, NULL, "albedo"));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_read(renderer, rgba, 4));
    EXPECT(CONELIGHT_OK, conelight_renderer_read(renderer, rgba, 4 * 8 * 8));
    if (!(rgba[4 * 36] > 0)) ++faults; /* a wall of the box */
    EXPECT(CONELIGHT_USAGE, conelight_renderer_copy_to_texture(renderer, 1));
    material.coat = 2;
    EXPECT(CONELIGHT_BAD_INPUT, conelight_renderer_set_material(renderer, 0, &material));
    EXPECT(CONELIGHT_USAGE, conelight_renderer_add_host_mesh(renderer, &mesh, NULL)); /* of its own context */
    EXPECT(CONELIGHT_USAGE, conelight_renderer_set_transform(renderer, 1000, rgba));
    EXPECT(CONELIGHT_OK, conelight_renderer_get_stats(renderer, &stats));
    if (stats.memory_bytes == 0) ++faults;
}

int main(void) {
    conelight_settings* settings = NULL;
    conelight_scene* scene = NULL;
    conelight_renderer* renderer = NULL;
    conelight_renderer_options options = CONELIGHT_RENDERER_OPTIONS_INIT;
    const char* text = NULL;
    null_pointers();
    null_changes();
    EXPECT(CONELIGHT_OK, conelight_settings_create(&settings));
    EXPECT(CONELIGHT_USAGE, conelight_settings_set(settings, "voxels.sise", "64"));
    EXPECT(CONELIGHT_USAGE, conelight_settings_set(settings, "voxels.size", "huge"));
    EXPECT(CONELIGHT_USAGE, conelight_settings_get(settings, "voxels.sise", &text));
    EXPECT(CONELIGHT_OK, conelight_settings_set(settings, "voxels.size", "64"));
    EXPECT(CONELIGHT_OK, conelight_settings_get(settings, "voxels.size", &text));
    if (text == NULL || strcmp(text, "64") != 0) ++faults;
    conelight_settings_destroy(settings);
    if (conelight_setting_key(0) == NULL || conelight_setting_key(100000) != NULL) ++faults;
    EXPECT(CONELIGHT_OK, conelight_scene_create(&scene));
    wrong_scenes(scene);
    EXPECT(CONELIGHT_NO_GL, conelight_renderer_create(NULL, &renderer)); /* no context is current */
    options.headless = 1;
    options.device = 1000;
    EXPECT(CONELIGHT_USAGE, conelight_renderer_create(&options, &renderer));
    options.device = CONELIGHT_NONE;
    EXPECT(CONELIGHT_OK, conelight_renderer_create(&options, &renderer));
    if (renderer != NULL) wrong_pictures(renderer, scene);
    conelight_renderer_destroy(renderer);
    conelight_scene_destroy(scene);
    printf("misuse: %d calls, %d faults\n", calls, faults);
    return faults == 0 ? 0 : 1;
}
