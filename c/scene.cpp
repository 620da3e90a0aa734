// SPDX-License-Identifier: MIT
// Scenes for C: from files and from arrays.
#include "conelight/scene.h"

#include <cmath>
#include <utility>

#include "io/environment_file.h"
#include "io/scene_file.h"
#include "io/scene_write.h"
#include "structs.h"

using namespace conelight;
using c::guarded;
using c::need;

namespace {

// Appends; writes the index where it is wanted.
template <class T>
void append(std::vector<T>& list, T&& element, int32_t* index) {
    list.push_back(std::move(element));
    if (index != nullptr) *index = static_cast<int32_t>(list.size()) - 1;
}

}  // namespace

conelight_result conelight_scene_create(conelight_scene** scene) {
    return guarded([&] { need(scene, "scene") = new conelight_scene; });
}

conelight_result conelight_scene_load(const char* path, uint32_t flags, conelight_scene** scene) {
    return guarded([&] {
        need(scene, "scene");
        if ((flags & ~(CONELIGHT_LOAD_AS_IS | CONELIGHT_LOAD_OUTSIDE)) != 0)
            c::failUsage("flags: " + std::to_string(flags) + " has unknown ones");
        io::LoadOptions options;
        options.allowOutside = (flags & CONELIGHT_LOAD_OUTSIDE) != 0;
        conelight_scene loaded{io::loadScene(&need(path, "path"), options)};
        if ((flags & CONELIGHT_LOAD_AS_IS) == 0) completeScene(loaded.scene);
        *scene = new conelight_scene(std::move(loaded));
    });
}

conelight_result conelight_scene_save(const conelight_scene* scene, const char* path, int overwrite) {
    return guarded([&] {
        const Scene& saved = need(scene, "scene").scene;
        saved.validate();
        io::writeScene(&need(path, "path"), saved, overwrite != 0);
    });
}

void conelight_scene_destroy(conelight_scene* scene) { delete scene; }

conelight_result conelight_scene_add_mesh(conelight_scene* scene, const conelight_mesh* mesh,
                                          int32_t* index) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        append(to.meshes, c::meshOf(c::readStruct(mesh, "mesh")), index);
    });
}

conelight_result conelight_scene_add_texture(conelight_scene* scene, const conelight_texture* texture,
                                             int32_t* index) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        append(to.textures, c::textureOf(c::readStruct(texture, "texture")), index);
    });
}

conelight_result conelight_scene_add_material(conelight_scene* scene, const conelight_material* material,
                                              int32_t* index) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        Material made;
        c::assign(made, material, "material");
        append(to.materials, std::move(made), index);
    });
}

conelight_result conelight_scene_add_instance(conelight_scene* scene, const conelight_instance* instance,
                                              int32_t* index) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        append(to.instances, c::instanceOf(c::readStruct(instance, "instance")), index);
    });
}

conelight_result conelight_scene_add_light(conelight_scene* scene, const conelight_light* light,
                                           int32_t* index) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        Light made;
        c::assign(made, c::readStruct(light, "light"));
        append(to.lights, std::move(made), index);
    });
}

conelight_result conelight_scene_set_sky(conelight_scene* scene, const float radiance[3]) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        to.sky = c::vec3Of(&need(radiance, "radiance"));
    });
}

conelight_result conelight_scene_set_environment(conelight_scene* scene, const char* path, float rotation,
                                                 float strength) {
    return guarded([&] {
        Scene& to = need(scene, "scene").scene;
        if (!std::isfinite(rotation) || !std::isfinite(strength) || strength < 0)
            c::failUsage("environment: a finite rotation and a strength of 0 or more would be right");
        if (path == nullptr)
            to.environment = {};
        else
            io::useEnvironment(to, io::loadEnvironment(path), rotation, strength);
    });
}

conelight_result conelight_scene_get_counts(const conelight_scene* scene, conelight_counts* counts) {
    return guarded([&] {
        const Scene& of = need(scene, "scene").scene;
        c::writeStruct(counts,
                       conelight_counts{0, of.meshes.size(), of.materials.size(), of.textures.size(),
                                        of.instances.size(), of.lights.size(), of.cameras.size(),
                                        of.notes.size(), of.triangleCount()},
                       "counts");
    });
}

conelight_result conelight_scene_get_camera(const conelight_scene* scene, size_t index,
                                            conelight_camera* camera) {
    return guarded([&] {
        const Scene& of = need(scene, "scene").scene;
        c::writeStruct(camera, c::valuesOf(c::elementOf(of.cameras, index, "camera")), "camera");
    });
}

conelight_result conelight_scene_get_light(const conelight_scene* scene, size_t index,
                                           conelight_light* light) {
    return guarded([&] {
        const Scene& of = need(scene, "scene").scene;
        c::writeStruct(light, c::valuesOf(c::elementOf(of.lights, index, "light")), "light");
    });
}

conelight_result conelight_scene_get_instance(const conelight_scene* scene, size_t index,
                                              conelight_instance* instance) {
    return guarded([&] {
        const Scene& of = need(scene, "scene").scene;
        c::writeStruct(instance, c::valuesOf(c::elementOf(of.instances, index, "instance")), "instance");
    });
}

const char* conelight_scene_note(const conelight_scene* scene, size_t index) {
    return scene != nullptr && index < scene->scene.notes.size() ? scene->scene.notes[index].c_str()
                                                                 : nullptr;
}

static Aabb boundsOf(const conelight_scene* scene) {
    const Scene& of = need(scene, "scene").scene;
    of.validate();
    const Aabb bounds = of.bounds();
    if (bounds.empty())
        throw Error(ErrorKind::BadInput, "scene: nothing is visible; an instance would be right");
    return bounds;
}

conelight_result conelight_scene_get_bounds(const conelight_scene* scene, float low[3], float high[3]) {
    return guarded([&] {
        const Aabb bounds = boundsOf(scene);
        need(low, "low");
        need(high, "high");
        c::put(low, bounds.min);
        c::put(high, bounds.max);
    });
}

conelight_result conelight_scene_frame(const conelight_scene* scene, conelight_camera* camera) {
    return guarded([&] { c::writeStruct(camera, c::valuesOf(frameCamera(boundsOf(scene))), "camera"); });
}
