/* SPDX-License-Identifier: MIT */
/* Conelight for C and for languages that call C: scenes, settings, renderers, light fields. C11; library conelight_c.
 *
 * Units: metres, radians, y up, right-handed, linear Rec.709; radiance W/(sr m^2), point lights W/sr, directional lights
 * W/m^2. Triangles are counter-clockwise seen from their front. Matrices are column by column, worldFromObject.
 *
 * Results: every call that can fail returns a conelight_result, and conelight_message() says in one line what was wrong.
 * A call that fails changes nothing and writes no output; where the driver fails while it draws, there is no picture
 * until the next. NULL where an object is wanted is CONELIGHT_USAGE.
 *
 * Objects: what a _create or _load returns is the caller's, and ends with _destroy (NULL is allowed there). Nothing is
 * kept of pointers that are handed in. Texts that are returned live as long as what they were asked of, unchanged.
 *
 * Threads: one call at a time per object; objects of their own on threads of their own. A renderer in the caller's
 * context is called where that is current; a headless one makes its context current during each call, and gives back
 * what was current before.
 *
 * OpenGL state: calls leave it as they found it; docs/guide/embed.md lists what is saved. Conditional rendering,
 * transform feedback and queries have ended before a call.
 *
 * Structs begin with their size: start each from its INIT macro. Later versions add fields at the end. */
#ifndef CONELIGHT_H
#define CONELIGHT_H

#include <stddef.h>
#include <stdint.h>

#include "conelight/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The numbers are also the exit status of the program conelight. */
typedef enum conelight_result {
    CONELIGHT_OK = 0,
    CONELIGHT_RUNTIME = 1,   /* failed while running: driver, memory, disk */
    CONELIGHT_USAGE = 2,     /* wrong argument, setting or order of calls */
    CONELIGHT_BAD_INPUT = 3, /* a file or a scene that cannot be used */
    CONELIGHT_NO_GL = 4      /* no context is current, or none with OpenGL 4.5 */
} conelight_result;

/* Of the last call on this thread that failed; "" before. Valid until the next failure. */
CONELIGHT_API const char* conelight_message(void);
/* Of the library: major * 65536 + minor * 256 + patch. */
CONELIGHT_API uint32_t conelight_version(void);
/* Where messages go that are no failures, process-wide; NULL: nowhere. level: 0 debug, 1 info, 2 warning, 3 error. Called
 * from any thread that calls the library, one call at a time. */
typedef void (*conelight_log)(int level, const char* message, void* user);
CONELIGHT_API conelight_result conelight_set_log(conelight_log log, void* user);

/* ---- Scenes ---- */

typedef struct conelight_scene conelight_scene;

#define CONELIGHT_NONE (-1) /* no material, no texture */

/* vertex_count elements per attribute that is not NULL. */
typedef struct conelight_mesh {
    size_t size;
    const char* name; /* NULL: none, here and below */
    size_t vertex_count;
    size_t index_count;      /* multiple of 3 */
    const float* positions;  /* x y z, m */
    const uint32_t* indices; /* below vertex_count */
    const float* normals;    /* x y z, unit length; NULL: flat */
    const float* uvs;        /* u v; (0,0) is the first row's first texel */
    const float* tangents;   /* x y z w, unit length; w = +-1: bitangent = w * cross(normal, tangent) */
    const float* colors;     /* r g b a, linear, multiplied onto the base colour */
} conelight_mesh;
#define CONELIGHT_MESH_INIT \
    { sizeof(conelight_mesh), NULL, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL }

typedef enum conelight_alpha {
    CONELIGHT_OPAQUE = 0,
    CONELIGHT_MASK = 1,
    CONELIGHT_BLEND = 2
} conelight_alpha;

/* Metallic-roughness, as glTF has it. Textures: indices of the scene, or CONELIGHT_NONE. */
typedef struct conelight_material {
    size_t size;
    const char* name;
    float base_color[4];     /* rgb: albedo (dielectric) or reflectance (metal), [0,1]; a: opacity */
    float metallic;          /* [0,1] */
    float roughness;         /* perceptual, [0,1] */
    float ior;               /* >= 1 */
    float specular;          /* [0,1] */
    float specular_color[3]; /* >= 0 */
    float emission[3];       /* W/(sr m^2) */
    float normal_scale;
    float alpha_cutoff;         /* of CONELIGHT_MASK, [0,1] */
    float transmission;         /* [0,1]: share of the light that goes through */
    float thickness;            /* 0: a thin pane; above, m: the surface of a solid */
    float attenuation_color[3]; /* (0,1] */
    float attenuation_distance; /* m; 0: clear */
    int32_t alpha;              /* conelight_alpha */
    int32_t double_sided;       /* 0 or 1 */
    int32_t unlit;              /* 0 or 1 */
    int32_t base_color_texture;
    int32_t metallic_roughness_texture;
    int32_t normal_texture;
    int32_t emissive_texture;
    /* Layers above all of this, not on glass. */
    float coat;            /* [0,1]: share of the surface that has a clear coat */
    float coat_roughness;  /* perceptual, [0,1] */
    float sheen_color[3];  /* [0,1]; black: no sheen of cloth */
    float sheen_roughness; /* perceptual, [0,1] */
} conelight_material;
#define CONELIGHT_MATERIAL_INIT                                                                          \
    {                                                                                                    \
        sizeof(conelight_material), NULL, {0.8f, 0.8f, 0.8f, 1}, 0, 1, 1.5f, 1, {1, 1, 1}, {0, 0, 0}, 1, \
            0.5f, 0, 0, {1, 1, 1}, 0, CONELIGHT_OPAQUE, 0, 0, CONELIGHT_NONE, CONELIGHT_NONE,            \
            CONELIGHT_NONE, CONELIGHT_NONE, 0, 0, {0, 0, 0}, 0                                           \
    }

/* 8-bit RGBA, rows from the top, 4 * width * height bytes. */
typedef struct conelight_texture {
    size_t size;
    const char* name;
    int32_t width, height; /* px, >= 1 */
    int32_t srgb;    /* 1: rgb is sRGB-encoded (base colour, emission); 0: linear (normals, roughness) */
    int32_t nearest; /* 1: no interpolation */
    int32_t clamp;   /* 1: edges go on; 0: it repeats */
    const uint8_t* rgba;
} conelight_texture;
#define CONELIGHT_TEXTURE_INIT \
    { sizeof(conelight_texture), NULL, 0, 0, 1, 0, 0, NULL }

typedef struct conelight_instance {
    size_t size;
    const char* name;
    int32_t mesh;
    int32_t material; /* CONELIGHT_NONE: white, diffuse */
    float world_from_object[16];
    int32_t visible;      /* 0: in no pass at all */
    int32_t voxelized;    /* 0: drawn, but neither occludes nor bounces nor emits */
    int32_t casts_shadow; /* 0: left out of shadows */
    int32_t dynamic;      /* 1: it moves */
} conelight_instance;
#define CONELIGHT_INSTANCE_INIT                                          \
    {                                                                    \
        sizeof(conelight_instance), NULL, 0, CONELIGHT_NONE,             \
            {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 1, 1, 1, 0 \
    }

typedef enum conelight_light_type {
    CONELIGHT_POINT = 0,
    CONELIGHT_SPOT = 1,
    CONELIGHT_DIRECTIONAL = 2,
    CONELIGHT_RECT = 3,
    CONELIGHT_DISK = 4,
    CONELIGHT_SPHERE = 5
} conelight_light_type;

typedef struct conelight_light {
    size_t size;
    const char* name;
    int32_t type;       /* conelight_light_type */
    float intensity[3]; /* W/sr (point, spot), W/m^2 (directional), W/(sr m^2) (rect, disk, sphere) */
    float position[3];
    float direction[3];   /* unit; where light travels to (spot, directional, rect, disk) */
    float half_u[3];      /* rect, disk: centre to edge, m; sphere: its length is the radius */
    float half_v[3];      /* rect, disk */
    float inner_angle;    /* spot: half angle of full intensity, rad */
    float outer_angle;    /* spot: half angle of zero intensity, rad, (inner_angle, pi/2] */
    float range;          /* m; 0: unlimited */
    int32_t enabled;      /* 0 or 1 */
    int32_t casts_shadow; /* 0 or 1 */
} conelight_light;
#define CONELIGHT_LIGHT_INIT                                                                            \
    {                                                                                                   \
        sizeof(conelight_light), NULL, CONELIGHT_POINT, {1, 1, 1}, {0, 0, 0}, {0, -1, 0}, {0.5f, 0, 0}, \
            {0, 0, 0.5f}, 0, 0.78539816f, 0, 1, 1                                                       \
    }

/* From eye to target. */
typedef struct conelight_camera {
    size_t size;
    float eye[3], target[3], up[3]; /* m; up: any length but 0, not along the view */
    float fov_y;                    /* vertical field of view, rad, (0, pi) */
    float z_near, z_far;            /* m, 0 < z_near < z_far */
    float orthographic_height; /* m; above 0: rays are parallel, and the picture is so high. 0: perspective */
} conelight_camera;
#define CONELIGHT_CAMERA_INIT \
    { sizeof(conelight_camera), {0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.78539816f, 0.01f, 1000, 0 }

typedef struct conelight_counts {
    size_t size;
    size_t meshes, materials, textures, instances, lights, cameras, notes, triangles;
} conelight_counts;
#define CONELIGHT_COUNTS_INIT \
    { sizeof(conelight_counts), 0, 0, 0, 0, 0, 0, 0, 0 }

CONELIGHT_API conelight_result conelight_scene_create(conelight_scene** scene);
/* flags of conelight_scene_load, to be added up. */
#define CONELIGHT_LOAD_AS_IS 1u /* no camera or light is added to a file that has none */
#define CONELIGHT_LOAD_OUTSIDE \
    2u /* the file may name others outside its folder: only files that are trusted */
/* glTF, OBJ and what else `conelight --help` names, or "builtin:NAME". UTF-8. */
CONELIGHT_API conelight_result conelight_scene_load(const char* path, uint32_t flags,
                                                    conelight_scene** scene);
/* .glb or .gltf; overwrite 0: a file that is there stays, and that is CONELIGHT_USAGE. */
CONELIGHT_API conelight_result conelight_scene_save(const conelight_scene* scene, const char* path,
                                                    int overwrite);
CONELIGHT_API void conelight_scene_destroy(conelight_scene* scene);

/* Each appends, and writes the new one's index where `index` is not NULL. Arrays are copied. */
CONELIGHT_API conelight_result conelight_scene_add_mesh(conelight_scene* scene, const conelight_mesh* mesh,
                                                        int32_t* index);
CONELIGHT_API conelight_result conelight_scene_add_texture(conelight_scene* scene,
                                                           const conelight_texture* texture, int32_t* index);
CONELIGHT_API conelight_result conelight_scene_add_material(conelight_scene* scene,
                                                            const conelight_material* material,
                                                            int32_t* index);
CONELIGHT_API conelight_result conelight_scene_add_instance(conelight_scene* scene,
                                                            const conelight_instance* instance,
                                                            int32_t* index);
CONELIGHT_API conelight_result conelight_scene_add_light(conelight_scene* scene, const conelight_light* light,
                                                         int32_t* index);
/* Constant radiance of the surroundings, >= 0. */
CONELIGHT_API conelight_result conelight_scene_set_sky(conelight_scene* scene, const float radiance[3]);
/* A latitude-longitude picture (.exr .hdr ...) or "builtin:sky", turned counter-clockwise as seen from above by
 * `rotation`, times `strength` (>= 0). NULL: none. */
CONELIGHT_API conelight_result conelight_scene_set_environment(conelight_scene* scene, const char* path,
                                                               float rotation, float strength);
CONELIGHT_API conelight_result conelight_scene_get_counts(const conelight_scene* scene,
                                                          conelight_counts* counts);
CONELIGHT_API conelight_result conelight_scene_get_camera(const conelight_scene* scene, size_t index,
                                                          conelight_camera* camera);
CONELIGHT_API conelight_result conelight_scene_get_light(const conelight_scene* scene, size_t index,
                                                         conelight_light* light);
CONELIGHT_API conelight_result conelight_scene_get_instance(const conelight_scene* scene, size_t index,
                                                            conelight_instance* instance);
/* What was left out or added when the scene was loaded, one line; NULL beyond the last. */
CONELIGHT_API const char* conelight_scene_note(const conelight_scene* scene, size_t index);
/* World bounds of what is visible, m. An empty scene is CONELIGHT_BAD_INPUT. */
CONELIGHT_API conelight_result conelight_scene_get_bounds(const conelight_scene* scene, float low[3],
                                                          float high[3]);
/* A camera that looks at all of it from the front. */
CONELIGHT_API conelight_result conelight_scene_frame(const conelight_scene* scene, conelight_camera* camera);

/* ---- Settings ---- */

/* By name and text, as `conelight settings` and docs/reference/settings.md list them: "traced.quality", "draft". */
typedef struct conelight_settings conelight_settings;

CONELIGHT_API conelight_result conelight_settings_create(conelight_settings** settings); /* the defaults */
CONELIGHT_API void conelight_settings_destroy(conelight_settings* settings);
CONELIGHT_API conelight_result conelight_settings_set(conelight_settings* settings, const char* key,
                                                      const char* value);
/* Those that a light field has at first: for pictures that move, a budget of work per frame. */
CONELIGHT_API conelight_result conelight_settings_create_realtime(conelight_settings** settings);
/* What the scene's file asks for. */
CONELIGHT_API conelight_result conelight_settings_follow(conelight_settings* settings,
                                                         const conelight_scene* scene);
/* Its text, valid until the next conelight_settings_get of these settings. */
CONELIGHT_API conelight_result conelight_settings_get(conelight_settings* settings, const char* key,
                                                      const char** value);
/* All there are, by number; NULL beyond the last. */
CONELIGHT_API const char* conelight_setting_key(size_t index);
CONELIGHT_API const char* conelight_setting_help(size_t index);

/* ---- Renderers ---- */

typedef struct conelight_renderer conelight_renderer;

typedef struct conelight_renderer_options {
    size_t size;
    int32_t headless;         /* 1: a context of its own, without a display; 0: the one that is current */
    int32_t device;           /* headless: number of an EGL device; CONELIGHT_NONE: a GPU, else software */
    int32_t report_gl_errors; /* 1: errors of the driver go to the log; takes the context's debug callback */
    const char* shader_directory; /* NULL: the built-in shaders; else files there win */
    int32_t
        top_first; /* textures: 1: their top row is row 0, as in Vulkan and Direct3D; 0: the lowest, as in OpenGL */
} conelight_renderer_options;
#define CONELIGHT_RENDERER_OPTIONS_INIT \
    { sizeof(conelight_renderer_options), 0, CONELIGHT_NONE, 0, NULL, 0 }

typedef struct conelight_stats {
    size_t size;
    double cpu_ms, wall_ms; /* of the last picture; 0 unless profiling is on */
    size_t memory_bytes;    /* of its GL objects */
} conelight_stats;
#define CONELIGHT_STATS_INIT \
    { sizeof(conelight_stats), 0, 0, 0 }

/* options NULL: the defaults, in the context that is current. */
CONELIGHT_API conelight_result conelight_renderer_create(const conelight_renderer_options* options,
                                                         conelight_renderer** renderer);
/* Frees what it has on the GPU; where its context is not current any more, that is the context's. */
CONELIGHT_API void conelight_renderer_destroy(conelight_renderer* renderer);
/* Copies and uploads the scene, which may end then. */
CONELIGHT_API conelight_result conelight_renderer_set_scene(conelight_renderer* renderer,
                                                            const conelight_scene* scene);
/* Changes in place: the next picture makes anew what depends on them. Indices are the scene's. An instance keeps its mesh, and
 * a mesh its numbers of vertices and indices. */
CONELIGHT_API conelight_result conelight_renderer_set_transform(conelight_renderer* renderer, size_t instance,
                                                                const float world_from_object[16]);
CONELIGHT_API conelight_result conelight_renderer_set_instance(conelight_renderer* renderer, size_t index,
                                                               const conelight_instance* instance);
CONELIGHT_API conelight_result conelight_renderer_set_mesh(conelight_renderer* renderer, size_t index,
                                                           const conelight_mesh* mesh);
/* New texels, of any size, for the materials that have it; one texel gives the memory of many back. */
CONELIGHT_API conelight_result conelight_renderer_set_texture(conelight_renderer* renderer, size_t index,
                                                              const conelight_texture* texture);
CONELIGHT_API conelight_result conelight_renderer_set_material(conelight_renderer* renderer, size_t index,
                                                               const conelight_material* material);
CONELIGHT_API conelight_result conelight_renderer_set_light(conelight_renderer* renderer, size_t index,
                                                            const conelight_light* light);
/* Those of another scene in place of all there are. */
CONELIGHT_API conelight_result conelight_renderer_set_lights(conelight_renderer* renderer,
                                                             const conelight_scene* scene);
CONELIGHT_API conelight_result conelight_renderer_set_sky(conelight_renderer* renderer,
                                                          const float radiance[3]);
/* That of another scene. */
CONELIGHT_API conelight_result conelight_renderer_set_environment(conelight_renderer* renderer,
                                                                  const conelight_scene* scene);
/* Further entries; what is there keeps its index. An index that was removed may be given again. A texture is for
 * materials that come after it. A mesh is removed when no instance has it. */
CONELIGHT_API conelight_result conelight_renderer_add_mesh(conelight_renderer* renderer,
                                                           const conelight_mesh* mesh, int32_t* index);
CONELIGHT_API conelight_result conelight_renderer_add_texture(conelight_renderer* renderer,
                                                              const conelight_texture* texture,
                                                              int32_t* index);
CONELIGHT_API conelight_result conelight_renderer_add_material(conelight_renderer* renderer,
                                                               const conelight_material* material,
                                                               int32_t* index);
CONELIGHT_API conelight_result conelight_renderer_add_instance(conelight_renderer* renderer,
                                                               const conelight_instance* instance,
                                                               int32_t* index);
CONELIGHT_API conelight_result conelight_renderer_remove_instance(conelight_renderer* renderer, size_t index);
CONELIGHT_API conelight_result conelight_renderer_remove_mesh(conelight_renderer* renderer, size_t index);
/* Where voxels are, m, whatever the scene's size; NULL both: where its instances are. */
CONELIGHT_API conelight_result conelight_renderer_set_region(conelight_renderer* renderer, const float low[3],
                                                             const float high[3]);
/* One picture. camera NULL: the scene's first, or one that shows all. 1 to 16384 px each way. settings NULL: the
 * defaults. component NULL: that of the settings; else "full", "direct", "indirect", "diffuse", "specular",
 * "occlusion", "albedo", "normal", "depth" ... as the setting `component` takes them. */
CONELIGHT_API conelight_result conelight_renderer_render(conelight_renderer* renderer,
                                                         const conelight_camera* camera, int32_t width,
                                                         int32_t height, const conelight_settings* settings,
                                                         const char* component);
/* The last picture: 4 * width * height floats, linear r g b a, first row on top; `count` floats have room at `rgba`, and
 * that must be just as many. Waits for the GPU. */
CONELIGHT_API conelight_result conelight_renderer_read(const conelight_renderer* renderer, float* rgba,
                                                       size_t count);
/* As a screen shows it (image.exposure, image.tone_map): 3 * width * height bytes, first row on top. */
CONELIGHT_API conelight_result conelight_renderer_read_display(const conelight_renderer* renderer,
                                                               const conelight_settings* settings,
                                                               uint8_t* rgb, size_t count);
/* Into the caller's framebuffer (0: the default one), lower left corner at x y, all its colour buffers; or into a
 * GL_TEXTURE_2D of the picture's size, rows as conelight_renderer_options::top_first has them. Linear, in the target's format, which is not of
 * integers. Not of headless renderers. */
CONELIGHT_API conelight_result conelight_renderer_copy_to_framebuffer(const conelight_renderer* renderer,
                                                                      uint32_t framebuffer, int32_t x,
                                                                      int32_t y);
CONELIGHT_API conelight_result conelight_renderer_copy_to_texture(const conelight_renderer* renderer,
                                                                  uint32_t texture);
/* 1: times for conelight_renderer_get_stats; a wait for the GPU per pass on software drivers. */
CONELIGHT_API conelight_result conelight_renderer_set_profiling(conelight_renderer* renderer, int on);
CONELIGHT_API conelight_result conelight_renderer_get_stats(const conelight_renderer* renderer,
                                                            conelight_stats* stats);

#ifdef __cplusplus
}
#endif

/* Light for a renderer of the host. */
#include "conelight/host_light.h"

#endif
