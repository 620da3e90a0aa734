// SPDX-License-Identifier: MIT
#include "light/edit_places.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <string_view>
#include <utility>

#include "light/edit_groups.h"
#include "math/brightness.h"

namespace conelight::light {
namespace {

// Where more of a scene's light is another, most is.
constexpr float kMostOfLight = 0.5f;

EditSphere sphereOf(const Aabb& box, float part = 1) {
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

// In place of those from `begin` on, up to `end`: round all of them, with what they are together seen from afar.
EditSphere spheresTogether(const std::vector<EditSphere>& places, std::size_t begin, std::size_t end) {
    const auto [center, radius] = sphereRound(places, begin, end);
    EditSphere round{center, radius, 0};
    for (std::size_t i = begin; i < end; ++i) {
        const float share = places[i].radius / radius;  // not a number where all are points
        round.part += share < 1 ? places[i].part * share * share : places[i].part;
    }
    round.part = std::min(round.part, 1.0f);
    return round;
}

LightEdit lightsTogether(const std::vector<LightEdit>& lights, std::size_t begin, std::size_t end) {
    const auto [center, radius] = sphereRound(lights, begin, end);
    LightEdit all{.center = center, .radius = radius, .reach = 0, .part = 0, .goes = true};
    for (std::size_t i = begin; i < end; ++i) {
        all.flux += lights[i].flux;
        all.whole += lights[i].whole;
        all.goes = all.goes && lights[i].goes;
        all.reach = std::max(all.reach, lights[i].reach);
        all.part = std::max(all.part, lights[i].part);
    }
    return all;
}

// What emits, as a light: its box, by its brightest point.
LightEdit glowOf(const Aabb& box, const glm::vec3& emission) {
    if (box.empty() || emission == glm::vec3(0)) return {};
    const glm::vec3 e = box.extent();
    const float area = 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
    const float flux = glm::pi<float>() * area * math::brightness(emission);
    return {.center = box.center(), .flux = flux, .whole = flux};
}

// The same by channels, W.
glm::vec3 glowing(const Aabb& box, const glm::vec3& emission) {
    return glowOf(box, glm::vec3(1)).flux * emission;
}

// Of what emits, what it has changed, where it moved by a part of its size.
template <typename Entry>
void addGlow(std::vector<LightEdit>& lights, const Entry& was, const Entry& is, float part) {
    const auto add = [&](const LightEdit& glow) {
        if (glow.flux > 0) lights.push_back(glow);
    };
    const bool sameEmission = was.emission == is.emission;
    const bool samePlace = was.bounds.min == is.bounds.min && was.bounds.max == is.bounds.max;
    LightEdit glow = glowOf(is.bounds, is.emission);
    if (sameEmission && part < 1) {
        glow.reach = 2 * part * glm::length(is.bounds.extent());
        glow.part = 1;
        glow.goes = true;
        if (part == 0) return;
    } else if (!sameEmission && samePlace) {
        glow.flux = glowOf(is.bounds, glm::abs(is.emission - was.emission)).flux;
        glow.part = partOf(was.emission, is.emission);
    } else if (!samePlace) {
        add(glowOf(was.bounds, was.emission));
    }
    add(glow);
}

// Of all that a material is but its emission.
std::size_t looksOf(gpu::Material material) {
    material.emission = glm::vec3(0);
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(&material), sizeof(material)});
}

// As few as blocks have room for; false: one light is so far beside another that nothing is known of both.
bool takeTogether(LightChange& change) {
    const auto isBeam = [](const LightEdit& light) { return light.axis != glm::vec3(0); };
    const bool tooMany = change.lights.size() > EditPlaces::kMost;
    if (tooMany && std::any_of(change.lights.begin(), change.lights.end(), isBeam)) return false;
    change.lights = fewer(std::move(change.lights), EditPlaces::kMost, lightsTogether);
    return true;
}

}  // namespace

// Instances that are others.
bool EditPlaces::lookAtInstances(const scene::GpuScene& scene) {
    bool known = true;
    glows_.clear();
    const std::vector<scene::InstanceChange>& changes = instances_.look(scene);
    auto change = changes.begin();
    entries_.resize(scene.instances().size());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const bool placed = change != changes.end() && change->index == i;
        // One that neither moved nor bent looks other than it did, all of it.
        const float part = placed ? movedPart(scene, *change++) : 1;
        Entry& entry = entries_[i];
        if (entry.revision == scene.instanceRevision(i)) {
            if (entry.emission != glm::vec3(0)) glows_.push_back({entry, entry});
            continue;
        }
        const gpu::Material& material = scene.materials()[scene.instances()[i].material];
        const bool emits = entry.emission != glm::vec3(0) || material.emission != glm::vec3(0);
        const Entry now{scene.instanceRevision(i), scene.instanceBounds(i), material.emission,
                        emits ? looksOf(material) : 0, (material.flags & MATERIAL_UNLIT) != 0};
        if (entry.unlit || now.unlit) known = false;
        // It reflects what it did: its light alone is another.
        const bool onlyGlows = !placed && entry.looks == now.looks && entry.emission != now.emission;
        if (onlyGlows) {
            glows_.push_back({entry, now});
            entry = now;
            continue;
        }
        Aabb box = entry.bounds;
        box.grow(now.bounds);
        if (!box.empty()) edits_.places.push_back(sphereOf(box, part));
        if (emits) glows_.push_back({entry, now, part});
        entry = now;
    }
    return known;
}

// Whether most of a scene's light is another. Of lamps and what emits that is said only where nothing else shines.
bool EditPlaces::mostIsOther(const scene::GpuScene& scene, const LightChange& change) const {
    if (change.everywherePart > kMostOfLight) return true;
    const Scene& source = scene.source();
    if (source.sky != glm::vec3(0) || source.environment.used()) return false;
    float all = lights_.flux();
    for (const Entry& entry : entries_) all += glowOf(entry.bounds, entry.emission).flux;
    return changedFlux(change.lights, glm::length(scene.bounds().extent())) > kMostOfLight * all;
}

void EditPlaces::lookAtLights(const scene::GpuScene& scene) {
    const Scene& source = scene.source();
    if (lit_ != scene.lightRevision())
        lights_.look(source.lights);
    else
        lights_.keep();
    if (skyLit_ != scene.skyRevision())
        sky_.look(source.sky, source.environment);
    else
        sky_.keep();
    lit_ = scene.lightRevision();
    skyLit_ = scene.skyRevision();
}

// Lamps, suns, the sky and what emits, from `scale` times what they were to what they are.
LightChange EditPlaces::lightChange(const glm::vec3& scale) const {
    LightChange all = lights_.change(scale);
    const LightChange sky = sky_.change(scale);
    all.everywhere += sky.everywhere;
    all.everywherePart += sky.everywherePart;
    all.dimmed += sky.dimmed;
    all.dimmedPart += sky.dimmedPart;
    all.isAnything |= sky.isAnything;
    for (const Glow& glow : glows_) {
        Entry was = glow.was;
        was.emission = scaledTo(was.emission, scale, glow.is.emission);
        const std::size_t first = all.lights.size();
        addGlow(all.lights, was, glow.is, glow.part);
        const bool stays = glow.part == 0 && glow.was.emission == glow.is.emission;
        if (scale != glm::vec3(1) && !stays) all.haveSaid(first);
    }
    return all;
}

// None: nothing that shone is brighter or darker.
std::optional<ScaledChange> EditPlaces::scaledChange(const scene::GpuScene& scene) const {
    const float radius = 0.5f * glm::length(scene.bounds().extent());
    std::vector<LightSource> sources;
    lights_.addSources(sources, radius);
    sky_.addSource(sources, radius);
    for (const Glow& glow : glows_)
        sources.push_back(
            {glowing(glow.was.bounds, glow.was.emission), glowing(glow.is.bounds, glow.is.emission)});
    const glm::vec3 scale = commonScale(sources);
    if (scale == glm::vec3(1)) return std::nullopt;
    ScaledChange change{lightChange(scale), scale};
    if (change.isAnything || !takeTogether(change)) return std::nullopt;
    return change;
}

// What is another about light; false: there is nothing to go by.
bool EditPlaces::judgeLight(const scene::GpuScene& scene) {
    static_cast<LightChange&>(edits_) = lightChange(glm::vec3(1));
    if (edits_.isAnything) return false;
    if (!edits_.ofLight()) return true;
    edits_.scaled = scaledChange(scene);
    edits_.most = mostIsOther(scene, edits_) && !(edits_.scaled && !mostIsOther(scene, *edits_.scaled));
    return takeTogether(edits_);
}

SceneEdits EditPlaces::look(const scene::GpuScene& scene) {
    bool known = scene_ == scene.identity();
    edits_ = {};
    const bool sameLights = lit_ == scene.lightRevision() && skyLit_ == scene.skyRevision();
    if (known && sameLights && instances_.at() == scene.geometryRevision()) return edits_;
    scene_ = scene.identity();
    lookAtLights(scene);
    if (!lookAtInstances(scene)) known = false;
    if (!known || !judgeLight(scene)) return std::nullopt;
    edits_.places = fewer(std::move(edits_.places), kMost, spheresTogether);
    return edits_;
}

}  // namespace conelight::light
