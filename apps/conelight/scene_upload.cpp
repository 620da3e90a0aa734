// SPDX-License-Identifier: MIT
#include "scene_upload.h"

#include <utility>

namespace conelight::program {

bool SceneUpload::current(const Session& session) const {
    return seen_ && seen_->sceneTables() == session.revisions().sceneTables();
}

void SceneUpload::follow(Renderer& renderer, const Session& session) {
    if (current(session)) return;
    const Revisions& now = session.revisions();
    // Instances that came or went have meshes of their own, more or fewer materials move the default one behind them; voxels that are asked for get a grid that
    // fits.
    const bool anew = !seen_ || seen_->scene != now.scene || seen_->voxels != now.voxels ||
                      seen_->instanceList != now.instanceList ||
                      materials_.size() != session.materialRevisions().size();
    if (anew) {
        seen_.reset();  // a scene that is refused is none
        renderer.setScene(session.scene());
        instances_ = session.instanceRevisions();
        materials_ = session.materialRevisions();
        meshes_ = session.meshRevisions();
        seen_ = now;
        return;
    }
    // Each part counts as seen when all of it was taken: what comes after a refusal is taken by the next
    // call.
    if (seen_->materials != now.materials) takeMaterials(renderer, session);
    seen_->materials = now.materials;
    if (seen_->meshes != now.meshes) takeMeshes(renderer, session);
    seen_->meshes = now.meshes;
    if (seen_->transforms != now.transforms || seen_->instances != now.instances)
        takeInstances(renderer, session);
    seen_->transforms = now.transforms;
    seen_->instances = now.instances;
    if (std::exchange(seen_->lights, now.lights) != now.lights) renderer.setLights(session.scene().lights);
    if (seen_->sky != now.sky) {
        renderer.setSky(session.scene().sky);
        renderer.setEnvironment(session.scene().environment);
        seen_->sky = now.sky;
    }
}

void SceneUpload::takeInstances(Renderer& renderer, const Session& session) {
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const std::uint64_t revision = session.instanceRevisions()[i];
        if (std::exchange(instances_[i], revision) != revision)
            renderer.setInstance(i, session.scene().instances[i]);
    }
}

void SceneUpload::takeMeshes(Renderer& renderer, const Session& session) {
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const std::uint64_t revision = session.meshRevisions()[i];
        if (std::exchange(meshes_[i], revision) != revision) renderer.setMesh(i, session.scene().meshes[i]);
    }
}

void SceneUpload::takeMaterials(Renderer& renderer, const Session& session) {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        const std::uint64_t revision = session.materialRevisions()[i];
        if (std::exchange(materials_[i], revision) != revision)
            renderer.setMaterial(i, session.scene().materials[i]);
    }
}

}  // namespace conelight::program
