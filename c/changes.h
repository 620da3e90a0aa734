// SPDX-License-Identifier: MIT
// Changes of a scene in place, the same calls for a Renderer and a LightField. `Use` makes an object of the caller usable
// during a call: its context current, `->` the C++ object.
#pragma once

#include "conelight/scene.h"
#include "io/environment_file.h"
#include "structs.h"

namespace conelight::c {

// The index that an add call answered, where it is wanted.
inline void writeIndex(std::size_t made, std::int32_t* index) {
    if (index != nullptr) *index = static_cast<std::int32_t>(made);
}

template <class Use, class Handle>
conelight_result setScene(Handle* handle, const conelight_scene* scene) {
    return guarded([&] {
        const Use use(handle);
        use->setScene(need(scene, "scene").scene);
    });
}

template <class Use, class Handle>
conelight_result setTransform(Handle* handle, std::size_t index, const float* worldFromObject) {
    return guarded([&] {
        const Use use(handle);
        Instance changed = elementOf(use->scene().instances, index, "instance");
        changed.worldFromObject = matrixOf(&need(worldFromObject, "world_from_object"));
        use->setInstance(index, changed);
    });
}

template <class Use, class Handle>
conelight_result setInstance(Handle* handle, std::size_t index, const conelight_instance* instance) {
    return guarded([&] {
        const Use use(handle);
        use->setInstance(index, instanceOf(readStruct(instance, "instance")));
    });
}

template <class Use, class Handle>
conelight_result setMesh(Handle* handle, std::size_t index, const conelight_mesh* mesh) {
    return guarded([&] {
        const Use use(handle);
        use->setMesh(index, meshOf(readStruct(mesh, "mesh")));
    });
}

template <class Use, class Handle>
conelight_result setHostMesh(Handle* handle, std::size_t index, const conelight_host_mesh* mesh) {
    return guarded([&] {
        const Use use(handle);
        use->setMesh(index, hostMeshOf(readStruct(mesh, "mesh")));
    });
}

template <class Use, class Handle>
conelight_result setTexture(Handle* handle, std::size_t index, const conelight_texture* texture) {
    return guarded([&] {
        const Use use(handle);
        use->setTexture(index, textureOf(readStruct(texture, "texture")));
    });
}

template <class Use, class Handle>
conelight_result setHostTexture(Handle* handle, std::size_t index, const conelight_host_texture* texture) {
    return guarded([&] {
        const Use use(handle);
        use->setTexture(index, hostTextureOf(readStruct(texture, "texture")));
    });
}

// What the struct does not have stays.
template <class Use, class Handle>
conelight_result setMaterial(Handle* handle, std::size_t index, const conelight_material* material) {
    return guarded([&] {
        const Use use(handle);
        Material changed = elementOf(use->scene().materials, index, "material");
        assign(changed, material, "material");
        use->setMaterial(index, changed);
    });
}

template <class Use, class Handle>
conelight_result setLight(Handle* handle, std::size_t index, const conelight_light* light) {
    return guarded([&] {
        const Use use(handle);
        Light changed = elementOf(use->scene().lights, index, "light");
        assign(changed, readStruct(light, "light"));
        use->setLight(index, changed);
    });
}

template <class Use, class Handle>
conelight_result setLights(Handle* handle, const conelight_scene* scene) {
    return guarded([&] {
        const Use use(handle);
        use->setLights(need(scene, "scene").scene.lights);
    });
}

template <class Use, class Handle>
conelight_result setSky(Handle* handle, const float* radiance) {
    return guarded([&] {
        const Use use(handle);
        use->setSky(vec3Of(&need(radiance, "radiance")));
    });
}

template <class Use, class Handle>
conelight_result setEnvironment(Handle* handle, const conelight_scene* scene) {
    return guarded([&] {
        const Use use(handle);
        use->setEnvironment(need(scene, "scene").scene.environment);
    });
}

template <class Use, class Handle>
conelight_result addMesh(Handle* handle, const conelight_mesh* mesh, std::int32_t* index) {
    return guarded([&] {
        const Use use(handle);
        writeIndex(use->addMesh(meshOf(readStruct(mesh, "mesh"))), index);
    });
}

template <class Use, class Handle>
conelight_result addHostMesh(Handle* handle, const conelight_host_mesh* mesh, std::int32_t* index) {
    return guarded([&] {
        const Use use(handle);
        writeIndex(use->addMesh(hostMeshOf(readStruct(mesh, "mesh"))), index);
    });
}

template <class Use, class Handle>
conelight_result addTexture(Handle* handle, const conelight_texture* texture, std::int32_t* index) {
    return guarded([&] {
        const Use use(handle);
        writeIndex(use->addTexture(textureOf(readStruct(texture, "texture"))), index);
    });
}

template <class Use, class Handle>
conelight_result addHostTexture(Handle* handle, const conelight_host_texture* texture, std::int32_t* index) {
    return guarded([&] {
        const Use use(handle);
        writeIndex(use->addTexture(hostTextureOf(readStruct(texture, "texture"))), index);
    });
}

template <class Use, class Handle>
conelight_result addMaterial(Handle* handle, const conelight_material* material, std::int32_t* index) {
    return guarded([&] {
        const Use use(handle);
        Material made;
        assign(made, material, "material");
        writeIndex(use->addMaterial(made), index);
    });
}

template <class Use, class Handle>
conelight_result addInstance(Handle* handle, const conelight_instance* instance, std::int32_t* index) {
    return guarded([&] {
        const Use use(handle);
        writeIndex(use->addInstance(instanceOf(readStruct(instance, "instance"))), index);
    });
}

template <class Use, class Handle>
conelight_result removeInstance(Handle* handle, std::size_t index) {
    return guarded([&] { Use(handle)->removeInstance(index); });
}

template <class Use, class Handle>
conelight_result removeMesh(Handle* handle, std::size_t index) {
    return guarded([&] { Use(handle)->removeMesh(index); });
}

template <class Use, class Handle>
conelight_result setRegion(Handle* handle, const float* low, const float* high) {
    return guarded([&] {
        const Use use(handle);
        Aabb region;
        if (low != nullptr || high != nullptr) {
            region.min = vec3Of(&need(low, "low"));
            region.max = vec3Of(&need(high, "high"));
        }
        use->setRegion(region);
    });
}

}  // namespace conelight::c
