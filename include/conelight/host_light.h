/* SPDX-License-Identifier: MIT */
/* A part of conelight.h, which says what holds for all calls: indirect light for a renderer of the host, as
 * conelight/light_field.h has it in C++ and docs/guide/light_field.md tells.
 *
 * Load time: with an OpenGL 4.5 core context current, create a field, set its scene, add a view. Each frame: changes of the
 * scene, _update, the host's own depths and normals, _gather, the host's own shading. A field is called where its context is
 * current. */
#ifndef CONELIGHT_HOST_LIGHT_H
#define CONELIGHT_HOST_LIGHT_H

#include "conelight.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct conelight_light_field conelight_light_field;

/* How the texels of a normal texture say a unit vector. */
typedef enum conelight_normal_encoding {
    CONELIGHT_NORMAL_WORLD = 0,       /* xyz, world space, as floats or signed */
    CONELIGHT_NORMAL_WORLD_UNORM = 1, /* 0.5 xyz + 0.5 */
    CONELIGHT_NORMAL_VIEW = 2,        /* as WORLD, of view space */
    CONELIGHT_NORMAL_VIEW_UNORM = 3,
    CONELIGHT_NORMAL_OCTAHEDRAL = 4 /* xy in [-1,1], world space */
} conelight_normal_encoding;

/* A picture that the host has drawn: GL names of textures of target GL_TEXTURE_2D, width x height texels, the row at clip
 * y = -1 first. They are read at level 0, and never written. 0 by 0 pixels, of a window that is minimised, give no light. */
typedef struct conelight_surfaces {
    size_t size;
    int32_t width, height;
    /* From world to clip space, as the pixels were drawn: perspective, off-centre, reversed or infinite, or parallel rays. */
    float view_from_world[16];
    float clip_from_view[16];
    int32_t clip_depth_zero_to_one; /* 1: glClipControl(.., GL_ZERO_TO_ONE) */
    uint32_t depth;                 /* x: as in the depth buffer, [0,1] */
    float background;               /* depth where nothing was drawn; 0 with reversed depths */
    uint32_t normal;                /* for shading */
    uint32_t geometric_normal;      /* of triangles; 0: from the depths of neighbouring pixels */
    int32_t normal_encoding;        /* conelight_normal_encoding, of both */
    uint32_t roughness;             /* perceptual, [0,1]; 0: all is rough, no reflections are traced */
    int32_t roughness_channel;      /* of it, 0 to 3 */
    uint32_t reflectance;           /* rgb: at normal incidence (F0), linear; 0: 0.04 */
    uint32_t instances;             /* GL_R16UI or GL_R32UI: index of the scene's instance; 0: none */
    /* Where a pixel's surface was in the view's last picture, less where it is: xy times motion_scale, in parts of the
     * picture's size; z: by how much its own movement changed its view depth since, m. 0: none. */
    uint32_t motion;
    float motion_scale[2];
} conelight_surfaces;
#define CONELIGHT_SURFACES_INIT                                                                            \
    {                                                                                                      \
        sizeof(conelight_surfaces), 0, 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},                \
            {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 0, 0, 1, 0, 0, CONELIGHT_NORMAL_WORLD, 0, 0, \
            0, 0, 0, {                                                                                     \
            1, 1                                                                                           \
        }                                                                                                  \
    }

/* How much a call of _update does where traced.budgeted is on: it ends when any of these is used up. */
typedef struct conelight_budget {
    size_t size;
    int32_t updates;     /* of the light of faces, at most; >= 0 */
    int32_t faces;       /* in each of them, at most; 0: all */
    double milliseconds; /* 0: no limit, and the same calls give the same bits */
} conelight_budget;
#define CONELIGHT_BUDGET_INIT \
    { sizeof(conelight_budget), 1, 0, 0 }

/* GL names of textures of target GL_TEXTURE_2D, GL_RGBA16F, a: 1 where a surface was seen. They are the field's, and valid
 * until the view's next _gather. */
typedef struct conelight_gathered {
    size_t size;
    uint32_t diffuse;  /* indirect irradiance / pi, W/(sr m^2): times albedo is radiance */
    uint32_t specular; /* mean radiance in the lobe, W/(sr m^2): times its albedo is radiance; 0: none */
    int32_t width, height;
} conelight_gathered;
#define CONELIGHT_GATHERED_INIT \
    { sizeof(conelight_gathered), 0, 0, 0, 0 }

/* Numbers of an attribute in a buffer of the host's; the normalized ones are in [-1,1] or [0,1]. */
typedef enum conelight_encoding {
    CONELIGHT_FLOAT32 = 0,
    CONELIGHT_FLOAT16 = 1,
    CONELIGHT_SNORM16 = 2,
    CONELIGHT_SNORM8 = 3,
    CONELIGHT_UNORM8 = 4
} conelight_encoding;
typedef struct conelight_attribute {
    uint32_t buffer;  /* GL name; 0: the mesh has none */
    uint32_t offset;  /* bytes to the first vertex, a multiple of 4 */
    uint32_t stride;  /* bytes from vertex to vertex, a multiple of 4 */
    int32_t encoding; /* conelight_encoding */
} conelight_attribute;

/* A mesh that the host has in buffers of its own. They are read during the call, after what the host's commands have
 * written, and never written; 32 bytes a vertex and 4 an index are kept on the GPU. It is opaque. */
typedef struct conelight_host_mesh {
    size_t size;
    const char* name;
    uint32_t vertex_count, index_count;
    conelight_attribute positions; /* x y z, m */
    conelight_attribute normals;   /* x y z, of any length; none: flat */
    conelight_attribute uvs;       /* u v */
    conelight_attribute tangents;  /* x y z w */
    conelight_attribute colors;    /* r g b a, linear, [0,1] */
    uint32_t indices;              /* GL name; 0: vertices follow each other, three a triangle */
    uint32_t index_offset;         /* bytes, a multiple of those of an index */
    int32_t short_indices;         /* 1: GL_UNSIGNED_SHORT; 0: GL_UNSIGNED_INT */
    float low[3], high[3]; /* holds all positions, object space; those outside are moved to its edge */
} conelight_host_mesh;
#define CONELIGHT_HOST_MESH_INIT                                                                         \
    {                                                                                                    \
        sizeof(conelight_host_mesh), NULL, 0, 0, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, \
            {0, 0, 0, 0}, 0, 0, 0, {0, 0, 0}, {                                                          \
            0, 0, 0                                                                                      \
        }                                                                                                \
    }
/* A GL_TEXTURE_2D of the host's, of floats or normalized numbers, as samplers read it: colours lie in an sRGB format, or
 * are linear. Light sees a copy of 256 x 256, made during the call; pictures and shadow maps read the texture itself, which
 * stays alive until another takes its place or the scene is gone. After its texels have changed, set it again. */
typedef struct conelight_host_texture {
    size_t size;
    const char* name;
    uint32_t texture; /* GL name */
    int32_t clamp;    /* 0: repeats; 1: clamps to the edge */
    int32_t nearest;  /* 0: linear filter; 1: nearest texel */
} conelight_host_texture;
#define CONELIGHT_HOST_TEXTURE_INIT \
    { sizeof(conelight_host_texture), NULL, 0, 0, 0 }
/* As _add_mesh, _set_mesh, _add_texture and _set_texture; not of headless renderers, whose context has nothing of the
 * host's. */
CONELIGHT_API conelight_result conelight_renderer_add_host_mesh(conelight_renderer* renderer,
                                                                const conelight_host_mesh* mesh,
                                                                int32_t* index);
CONELIGHT_API conelight_result conelight_renderer_set_host_mesh(conelight_renderer* renderer, size_t index,
                                                                const conelight_host_mesh* mesh);
CONELIGHT_API conelight_result conelight_renderer_add_host_texture(conelight_renderer* renderer,
                                                                   const conelight_host_texture* texture,
                                                                   int32_t* index);
CONELIGHT_API conelight_result conelight_renderer_set_host_texture(conelight_renderer* renderer, size_t index,
                                                                   const conelight_host_texture* texture);

/* What a field holds, and what its last _update did. */
typedef struct conelight_light_field_stats {
    size_t size;
    size_t voxels, faces;           /* of the grid; light is kept per face */
    uint64_t faces_updated;         /* by the last _update; one that was renewed twice counts twice */
    size_t memory_bytes;            /* of its GL objects */
    size_t pass_count;              /* of the last _update and the _gathers since; 0 unless profiling is on */
    double cpu_ms, wall_ms, gpu_ms; /* of the last _update; gpu_ms < 0: not measured */
} conelight_light_field_stats;
#define CONELIGHT_LIGHT_FIELD_STATS_INIT \
    { sizeof(conelight_light_field_stats), 0, 0, 0, 0, 0, 0, 0, -1 }

typedef struct conelight_pass {
    size_t size;
    const char* name; /* "update/irradiance: update"; valid until the field's next _get_stats */
    double cpu_ms, wall_ms, gpu_ms;
} conelight_pass;
#define CONELIGHT_PASS_INIT \
    { sizeof(conelight_pass), NULL, 0, 0, -1 }

/* In the context that is current. shader_directory NULL: the built-in shaders; else files there win. */
CONELIGHT_API conelight_result conelight_light_field_create(const char* shader_directory,
                                                            conelight_light_field** field);
/* Frees what it has on the GPU; where its context is not current any more, that is the context's. */
CONELIGHT_API void conelight_light_field_destroy(conelight_light_field* field);
/* Copies and uploads the scene, which may end then. */
CONELIGHT_API conelight_result conelight_light_field_set_scene(conelight_light_field* field,
                                                               const conelight_scene* scene);
/* From the next _update on; conelight_settings_create_realtime has those of the begin. */
CONELIGHT_API conelight_result conelight_light_field_set_settings(conelight_light_field* field,
                                                                  const conelight_settings* settings);
/* Changes in place, as those of renderers. */
CONELIGHT_API conelight_result conelight_light_field_set_transform(conelight_light_field* field,
                                                                   size_t instance,
                                                                   const float world_from_object[16]);
CONELIGHT_API conelight_result conelight_light_field_set_instance(conelight_light_field* field, size_t index,
                                                                  const conelight_instance* instance);
CONELIGHT_API conelight_result conelight_light_field_set_mesh(conelight_light_field* field, size_t index,
                                                              const conelight_mesh* mesh);
CONELIGHT_API conelight_result conelight_light_field_set_host_mesh(conelight_light_field* field, size_t index,
                                                                   const conelight_host_mesh* mesh);
CONELIGHT_API conelight_result conelight_light_field_set_texture(conelight_light_field* field, size_t index,
                                                                 const conelight_texture* texture);
CONELIGHT_API conelight_result conelight_light_field_set_host_texture(conelight_light_field* field,
                                                                      size_t index,
                                                                      const conelight_host_texture* texture);
CONELIGHT_API conelight_result conelight_light_field_set_material(conelight_light_field* field, size_t index,
                                                                  const conelight_material* material);
CONELIGHT_API conelight_result conelight_light_field_set_light(conelight_light_field* field, size_t index,
                                                               const conelight_light* light);
CONELIGHT_API conelight_result conelight_light_field_set_lights(conelight_light_field* field,
                                                                const conelight_scene* scene);
CONELIGHT_API conelight_result conelight_light_field_set_sky(conelight_light_field* field,
                                                             const float radiance[3]);
CONELIGHT_API conelight_result conelight_light_field_set_environment(conelight_light_field* field,
                                                                     const conelight_scene* scene);
CONELIGHT_API conelight_result conelight_light_field_add_mesh(conelight_light_field* field,
                                                              const conelight_mesh* mesh, int32_t* index);
CONELIGHT_API conelight_result conelight_light_field_add_host_mesh(conelight_light_field* field,
                                                                   const conelight_host_mesh* mesh,
                                                                   int32_t* index);
CONELIGHT_API conelight_result conelight_light_field_add_texture(conelight_light_field* field,
                                                                 const conelight_texture* texture,
                                                                 int32_t* index);
CONELIGHT_API conelight_result conelight_light_field_add_host_texture(conelight_light_field* field,
                                                                      const conelight_host_texture* texture,
                                                                      int32_t* index);
CONELIGHT_API conelight_result conelight_light_field_add_material(conelight_light_field* field,
                                                                  const conelight_material* material,
                                                                  int32_t* index);
CONELIGHT_API conelight_result conelight_light_field_add_instance(conelight_light_field* field,
                                                                  const conelight_instance* instance,
                                                                  int32_t* index);
CONELIGHT_API conelight_result conelight_light_field_remove_instance(conelight_light_field* field,
                                                                     size_t index);
CONELIGHT_API conelight_result conelight_light_field_remove_mesh(conelight_light_field* field, size_t index);
CONELIGHT_API conelight_result conelight_light_field_set_region(conelight_light_field* field,
                                                                const float low[3], const float high[3]);

/* Voxels and light of the scene as it is. budget NULL: that of CONELIGHT_BUDGET_INIT. Writes how many updates faces have had
 * since the light changed, where `updates` is not NULL. */
CONELIGHT_API conelight_result conelight_light_field_update(conelight_light_field* field,
                                                            const conelight_budget* budget, int32_t* updates);
/* A view has a history of its own: means over frames, of one camera. */
CONELIGHT_API conelight_result conelight_light_field_add_view(conelight_light_field* field, int32_t* view);
CONELIGHT_API conelight_result conelight_light_field_remove_view(conelight_light_field* field, int32_t view);
/* Light at the host's pixels, once per view and frame, after the first _update. reduction, 1 to 4: rays are traced for one of
 * reduction x reduction pixels. */
CONELIGHT_API conelight_result conelight_light_field_gather(conelight_light_field* field, int32_t view,
                                                            const conelight_surfaces* surfaces,
                                                            int32_t reduction, conelight_gathered* gathered);

/* For shaders of the host: the text of conelight/light_field.glsl, which goes behind the line of #version. It reads 3 uniform
 * blocks and 7 textures from these binding points on. The text is valid until the thread's next call of this. */
CONELIGHT_API conelight_result conelight_lookups_glsl(int32_t first_block, int32_t first_texture,
                                                      const char** text);
/* Binds what that text reads, light as the last _update left it; after the next _update bind again. */
CONELIGHT_API conelight_result conelight_light_field_bind_lookups(const conelight_light_field* field,
                                                                  int32_t first_block, int32_t first_texture);

/* 1: times for the two calls below; a wait for the GPU per pass on software drivers. */
CONELIGHT_API conelight_result conelight_light_field_set_profiling(conelight_light_field* field, int on);
CONELIGHT_API conelight_result conelight_light_field_get_stats(const conelight_light_field* field,
                                                               conelight_light_field_stats* stats);
/* Of pass_count, as the last _get_stats found them. */
CONELIGHT_API conelight_result conelight_light_field_get_pass(const conelight_light_field* field,
                                                              size_t index, conelight_pass* pass);

#ifdef __cplusplus
}
#endif

#endif
