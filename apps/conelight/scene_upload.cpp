// SPDX-License-Identifier: MIT
#include "scene_upload.h"

#include <algorithm>
#include <utility>

namespace conelight::program {

bool SceneUpload::current(const Session& session) const {
    return seen_ && seen_->sceneTables() == session.revisions().sceneTables();
}

// Whether all that is new stands behind what the renderer has. Meshes in the place of others have as many vertices;
// textures are the same.
bool SceneUpload::onlyAdds(const Renderer& renderer, const Session& session) const {
    const Scene& now = session.scene();
    const Scene& held = renderer.scene();
    const bool fewer = now.instances.size() < instances_.size() || now.meshes.size() < meshes_.size() ||
                       now.materials.size() < materials_.size();
    const bool same = held.instances.size() == instances_.size() && held.meshes.size() == meshes_.size() &&
                      held.materials.size() == materials_.size();
    const std::vector<std::uint64_t>& textures = session.textureRevisions();
    if (fewer || !same || textures.size() < textures_.size() ||
        !std::equal(textures_.begin(), textures_.end(), textures.begin()))
        return false;
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if (now.instances[i].mesh != held.instances[i].mesh) return false;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const Mesh &a = now.meshes[i], &b = held.meshes[i];
        if (a.positions.size() != b.positions.size() || a.indices.size() != b.indices.size() ||
            a.normals.empty() != b.normals.empty())
            return false;
    }
    return true;
}

// Voxels that are asked for get a grid that fits.
bool SceneUpload::needsWhole(const Renderer& renderer, const Session& session) const {
    if (current(session)) return false;
    const Revisions& now = session.revisions();
    return !seen_ || seen_->scene != now.scene || seen_->voxels != now.voxels || !onlyAdds(renderer, session);
}

SceneUpload::SceneRevisions SceneUpload::revisionsOf(const Session& session) {
    return {session.revisions(), session.instanceRevisions(), session.materialRevisions(),
            session.meshRevisions(), session.textureRevisions()};
}

void SceneUpload::take(Renderer& renderer, const Scene& scene, SceneRevisions revisions) {
    seen_.reset();  // a scene that is refused is none
    renderer.setScene(scene);
    instances_ = std::move(revisions.instances);
    materials_ = std::move(revisions.materials);
    meshes_ = std::move(revisions.meshes);
    textures_ = std::move(revisions.textures);
    seen_ = revisions.all;
}

void SceneUpload::follow(Renderer& renderer, const Session& session) {
    if (current(session)) return;
    if (needsWhole(renderer, session)) return take(renderer, session.scene(), revisionsOf(session));
    const Revisions& now = session.revisions();
    // Each part counts as seen when all of it was taken: what comes after a refusal is taken by the next
    // call.
    for (std::size_t i = textures_.size(); i < session.scene().textures.size(); ++i) {
        renderer.addTexture(session.scene().textures[i]);
        textures_.push_back(session.textureRevisions()[i]);
    }
    if (seen_->materials != now.materials || materials_.size() != session.scene().materials.size())
        takeMaterials(renderer, session);
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
    for (std::size_t i = instances_.size(); i < session.scene().instances.size(); ++i) {
        renderer.addInstance(session.scene().instances[i]);
        instances_.push_back(session.instanceRevisions()[i]);
    }
}

void SceneUpload::takeMeshes(Renderer& renderer, const Session& session) {
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const std::uint64_t revision = session.meshRevisions()[i];
        if (std::exchange(meshes_[i], revision) != revision) renderer.setMesh(i, session.scene().meshes[i]);
    }
    for (std::size_t i = meshes_.size(); i < session.scene().meshes.size(); ++i) {
        renderer.addMesh(session.scene().meshes[i]);
        meshes_.push_back(session.meshRevisions()[i]);
    }
}

void SceneUpload::takeMaterials(Renderer& renderer, const Session& session) {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        const std::uint64_t revision = session.materialRevisions()[i];
        const Material& material = session.scene().materials[i];
        if (std::exchange(materials_[i], revision) != revision && material != renderer.scene().materials[i])
            renderer.setMaterial(i, material);
    }
    for (std::size_t i = materials_.size(); i < session.scene().materials.size(); ++i) {
        renderer.addMaterial(session.scene().materials[i]);
        materials_.push_back(session.materialRevisions()[i]);
    }
}

}  // namespace conelight::program
