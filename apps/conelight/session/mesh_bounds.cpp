// SPDX-License-Identifier: MIT
#include "session/mesh_bounds.h"

namespace conelight::program {

const Aabb& MeshBounds::of(const Session& session, std::size_t mesh) {
    if (scene_ != session.revisions().scene) meshes_.clear();
    scene_ = session.revisions().scene;
    meshes_.resize(session.scene().meshes.size());
    std::optional<Known>& known = meshes_[mesh];
    const std::uint64_t revision = session.meshRevisions()[mesh];
    if (!known || known->revision != revision) known = {revision, session.scene().meshes[mesh].bounds()};
    return known->box;
}

Aabb MeshBounds::ofInstance(const Session& session, std::size_t instance) {
    const Instance& one = session.scene().instances[instance];
    return of(session, static_cast<std::size_t>(one.mesh)).transformed(one.worldFromObject);
}

Aabb MeshBounds::ofScene(const Session& session) {
    const Revisions& now = session.revisions();
    const std::uint64_t tables = now.scene + now.transforms + now.instances + now.meshes;
    if (tables_ == tables) return all_;
    tables_ = tables;
    all_ = {};
    for (std::size_t i = 0; i < session.scene().instances.size(); ++i)
        if (session.scene().instances[i].visible) all_.grow(ofInstance(session, i));
    return all_;
}

}  // namespace conelight::program
