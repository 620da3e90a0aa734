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

// Spheres from `begin` on, up to `end`, as one: round all of them, with what they are together seen from afar.
struct Group {
    std::size_t begin, end;
    EditSphere sphere;
};

Group groupOf(const std::vector<EditSphere>& places, std::size_t begin, std::size_t end) {
    Aabb box;
    for (std::size_t i = begin; i < end; ++i) {
        box.grow(places[i].center - places[i].radius);
        box.grow(places[i].center + places[i].radius);
    }
    EditSphere round{box.center(), 0, 0};
    for (std::size_t i = begin; i < end; ++i)
        round.radius =
            std::max(round.radius, glm::distance(round.center, places[i].center) + places[i].radius);
    for (std::size_t i = begin; i < end; ++i) {
        const float share = places[i].radius / round.radius;  // not a number where all are points
        round.part += share < 1 ? places[i].part * share * share : places[i].part;
    }
    round.part = std::min(round.part, 1.0f);
    return {begin, end, end - begin == 1 ? places[begin] : round};
}

// Where to divide a group, whose places it puts in order: in the middle of where they are.
std::size_t dividedAt(std::vector<EditSphere>& places, const Group& group) {
    Aabb box;
    for (std::size_t i = group.begin; i < group.end; ++i) box.grow(places[i].center);
    const glm::vec3 extent = box.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const float middle = box.center()[axis];
    const auto first = places.begin() + static_cast<std::ptrdiff_t>(group.begin);
    const auto last = places.begin() + static_cast<std::ptrdiff_t>(group.end);
    const auto cut = std::stable_partition(
        first, last, [&](const EditSphere& place) { return place.center[axis] < middle; });
    const bool divides = cut != first && cut != last;  // not where all are in one point
    return divides ? static_cast<std::size_t>(cut - places.begin()) : (group.begin + group.end) / 2;
}

// At most `most` in place of all: the largest group is divided until there are as many.
std::vector<EditSphere> fewer(std::vector<EditSphere> places, std::size_t most) {
    std::vector<Group> groups = {groupOf(places, 0, places.size())};
    const auto size = [](const Group& group) {
        return group.end - group.begin > 1 ? group.sphere.radius : -1.0f;
    };
    while (groups.size() < most) {
        const auto largest = std::max_element(
            groups.begin(), groups.end(), [&](const Group& a, const Group& b) { return size(a) < size(b); });
        const std::size_t end = largest->end, cut = dividedAt(places, *largest);
        *largest = groupOf(places, largest->begin, cut);
        groups.push_back(groupOf(places, cut, end));
    }
    places.clear();
    for (const Group& group : groups) places.push_back(group.sphere);
    return places;
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
        places.push_back(sphereRound(box, part));
    }
    if (!local) return std::nullopt;
    return places.size() > kMost ? fewer(std::move(places), kMost) : places;
}

}  // namespace conelight::light
