// SPDX-License-Identifier: MIT
#include "reference/beam_light.h"

#include <algorithm>

#include "reference/materials.h"

namespace conelight::reference {

BeamLight::BeamLight(const BeamScene& scene, const BeamTree& tree, const Lens& lens)
    : scene_(scene), lens_(lens), surroundings_(scene.scene()) {
    for (const Beam& beam : tree.beams) {
        std::vector<std::uint32_t> mirrors;
        if (beam.parent >= 0) {
            mirrors = mirrors_[static_cast<std::size_t>(beam.parent)];
            mirrors.push_back(beam.mirror);
        }
        mirrors_.push_back(std::move(mirrors));
    }
}

// The surface where the line meets the polygon's plane; the line goes on from there.
Surface BeamLight::meet(const BeamPolygon& polygon, Line& line, const glm::vec3& turn) const {
    const double along = glm::dot(polygon.plane.normal, line.direction);
    const double t = -polygon.plane.at(line.origin) / along;
    line.origin += t * line.direction;
    Ray ray;
    ray.direction = glm::vec3(line.direction);
    const glm::vec3 turned = lens_.parallel ? turn / static_cast<float>(t) : turn;
    return surfaceAt(scene_.scene(), ray, scene_.hitOf(polygon, line.origin, t), turned);
}

BeamLight::Line BeamLight::throughMirrors(const glm::dvec2& place, int beam, glm::vec3& turn) const {
    Line line;
    const glm::dvec3 aside = place.x * lens_.right + place.y * lens_.up;
    line.origin = lens_.eye + (lens_.parallel ? aside : glm::dvec3(0));
    line.direction = glm::normalize(lens_.forward + (lens_.parallel ? glm::dvec3(0) : aside));
    for (const std::uint32_t mirror : mirrors_[static_cast<std::size_t>(beam)]) {
        const BeamPolygon& polygon = scene_.polygons()[mirror];
        const Surface surface = meet(polygon, line, turn);
        turn = glm::vec3(0);
        line.throughput *= Reflection(surface, -glm::vec3(line.direction)).mirrorShare();
        line.direction -= 2 * glm::dot(line.direction, polygon.plane.normal) * polygon.plane.normal;
    }
    return line;
}

glm::vec3 BeamLight::reflectedLight(const Surface& surface, const glm::vec3& toEye,
                                    const BeamLamp& lamp) const {
    LightSample light;
    if (!lamp.sample(surface.position, light)) return glm::vec3(0);
    const Reflection reflection(surface, toEye);
    return reflection.black() ? glm::vec3(0) : reflection.evaluate(light.toLight).sum() * light.radiance;
}

glm::vec3 BeamLight::radiance(const glm::dvec2& place, const Query& query, const glm::vec3& turn) const {
    glm::vec3 atFirst = turn;
    Line line = throughMirrors(place, query.beam, atFirst);
    if (query.polygon == kNoPolygon)
        return line.throughput * surroundings_.radiance(glm::vec3(line.direction));
    const BeamPolygon& polygon = scene_.polygons()[query.polygon];
    if (polygon.triangleCount == 0) return line.throughput * polygon.radiance;
    const Surface surface = meet(polygon, line, atFirst);
    const bool mirrored = !mirrors_[static_cast<std::size_t>(query.beam)].empty();
    // Unlit surfaces are seen, and light nothing; backs of single-sided ones absorb.
    if (query.lamp == kOwn)
        return mirrored && surface.unlit ? glm::vec3(0) : line.throughput * surface.emission;
    if (surface.unlit || (mirrored && !surface.frontFace && !polygon.twoSided)) return glm::vec3(0);
    return line.throughput * reflectedLight(surface, -glm::vec3(line.direction),
                                            scene_.lamps()[static_cast<std::size_t>(query.lamp)]);
}

}  // namespace conelight::reference
