// SPDX-License-Identifier: MIT
// A scene as Python holds it, and handles of its parts: a scene and an index, never a pointer into a vector.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "conelight/error.h"
#include "conelight/scene.h"
#include "conelight/settings.h"
#include "io/animation.h"

namespace conelight::python {

// What moves in the file that a scene was loaded from, and where it rests.
struct Movement {
    io::SceneAnimation animation;
    Scene rest;  // instances, lights and cameras alone
};

class SceneHandle {
  public:
    SceneHandle() : SceneHandle(Scene{}) {}
    explicit SceneHandle(Scene scene)
        : scene_(std::make_shared<Scene>(std::move(scene))), geometry_(next()) {}

    const Scene& get() const { return *scene_; }
    // As it is now; stays so whatever is edited later.
    std::shared_ptr<const Scene> shared() const { return scene_; }
    // For everything but meshes and textures.
    Scene& edit() {
        if (scene_.use_count() > 1) scene_ = std::make_shared<Scene>(*scene_);
        return *scene_;
    }
    Scene& editGeometry() {
        geometry_ = next();
        return edit();
    }
    // Null: nothing moves.
    std::shared_ptr<const Movement> movement;

    // Another number after each change of meshes and textures, and for each scene.
    std::uint64_t geometry() const { return geometry_; }

  private:
    static std::uint64_t next() {
        static std::atomic<std::uint64_t> last{0};
        return ++last;
    }
    std::shared_ptr<Scene> scene_;
    std::uint64_t geometry_;
};

// One element of one of the scene's vectors. Elements that were removed since are an Error(Usage).
template <class T, std::vector<T> Scene::*List>
struct Part {
    std::shared_ptr<SceneHandle> scene;
    std::size_t index = 0;

    void check() const {
        if (index >= (scene->get().*List).size())
            throw Error(ErrorKind::Usage,
                        "the scene no longer has this element, number " + std::to_string(index));
    }
    const T& get() const {
        check();
        return (scene->get().*List)[index];
    }
    T& edit() const {
        check();
        return (scene->edit().*List)[index];
    }
};
using MeshPart = Part<Mesh, &Scene::meshes>;
using MaterialPart = Part<Material, &Scene::materials>;
using InstancePart = Part<Instance, &Scene::instances>;
using LightPart = Part<Light, &Scene::lights>;

}  // namespace conelight::python
