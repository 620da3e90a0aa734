// SPDX-License-Identifier: MIT
#include "light/edit_places.h"

#include <algorithm>
#include <cmath>

namespace conelight::light {
namespace {

bool emits(const scene::GpuScene& scene, std::size_t index) {
    const gpu::Material& material = scene.materials()[scene.instances()[index].material];
    return material.emission != glm::vec3(0) || (material.flags & MATERIAL_UNLIT) != 0;
}

EditSphere sphereRound(const Aabb& box, float part = 1) {
    return {box.center(), 0.5f * glm::length(box.extent()), part};
}

// The farthest that a corner of the box goes, of its diagonal, [0,1].
float partOfItsSize(const Aabb& box, const glm::mat4& was, const glm::mat4& is) {
    const glm::mat4 move = is * glm::inverse(was);
    float farthest = 0;
    for (const glm::vec3& corner : box.corners())
        farthest = std::max(farthest, glm::distance(corner, glm::vec3(move * glm::vec4(corner, 1))));
    const float part = farthest / glm::length(box.extent());
    return part < 1 ? part : 1;  // a box without size, a matrix without inverse: all of it
}

// The farthest that a vertex of a mesh that bends has come, of the diagonal.
float bentPart(const scene::GpuScene& scene, std::size_t index) {
    const glm::mat3 axes(scene.instances()[index].worldFromObject);
    const float scale = std::max({glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])});
    const float part = scale * scene.bentBy(index) / glm::length(scene.instanceBounds(index).extent());
    return part < 1 ? part : 1;
}

// Of the size of an instance, [0,1]: by how much it moved and bent; 1 where that is not known.
float movedPart(const scene::GpuScene& scene, const scene::InstanceChange& change) {
    if (change.came || (change.reshaped && !change.keepsVertices)) return 1;
    const float bend = change.reshaped ? bentPart(scene, change.index) : 0;
    const float move = change.moved
                           ? partOfItsSize(scene.instanceBounds(change.index), change.worldFromObject,
                                           scene.instances()[change.index].worldFromObject)
                           : 0;
    return std::min(bend + move, 1.0f);
}

}  // namespace

// Than that of the last look, for all faces.
bool EditPlaces::isOther(const scene::GpuScene& scene) const {
    return scene_ != scene.identity() || lights_ != scene.lightRevision() || sky_ != scene.skyRevision();
}

EditSpheres EditPlaces::look(const scene::GpuScene& scene) {
    bool local = !isOther(scene);
    std::vector<EditSphere> places;
    if (local && instances_.at() == scene.geometryRevision()) return places;
    scene_ = scene.identity();
    lights_ = scene.lightRevision();
    sky_ = scene.skyRevision();
    const std::vector<scene::InstanceChange>& changes = instances_.look(scene);
    auto change = changes.begin();
    Aabb all;  // of all places
    entries_.resize(scene.instances().size());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const bool placed = change != changes.end() && change->index == i;
        // One that neither moved nor bent looks other than it did, all of it.
        const float part = placed ? movedPart(scene, *change++) : 1;
        Entry& entry = entries_[i];
        if (entry.revision == scene.instanceRevision(i)) continue;
        const Entry now{scene.instanceRevision(i), scene.instanceBounds(i), emits(scene, i)};
        if (entry.emits || now.emits) local = false;
        Aabb box = entry.bounds;
        box.grow(now.bounds);
        entry = now;
        if (box.empty()) continue;
        all.grow(box);
        if (places.size() > kMost) continue;
        places.push_back(sphereRound(box, part));
    }
    if (!local) return std::nullopt;
    if (places.size() > kMost) places = {sphereRound(all)};
    return places;
}

}  // namespace conelight::light
