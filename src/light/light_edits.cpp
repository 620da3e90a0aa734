// SPDX-License-Identifier: MIT
#include "light/light_edits.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "math/brightness.h"

namespace conelight::light {
namespace {

// A sun that turns by an angle moves what it lights through a window by about its part of this one, rad: how large a
// window is from what it lights.
constexpr float kWindow = 0.25f;
constexpr float kPi = glm::pi<float>();

// In place of the intensity, of a light with a falloff of its own.
float farAway(const Light& light) { return light.customFalloff ? 1 / light.falloff.z : 1.0f; }

bool hasPlace(const Light& light) { return light.type != LightType::Directional; }

glm::vec3 directionOf(const Light& light) {
    const float length = glm::length(light.direction);
    return length > 0 ? light.direction / length : glm::vec3(0, -1, 0);
}

// Half of what shines to one side.
glm::vec3 halfAxis(const Light& light) { return glm::cross(light.halfU, light.halfV); }

// The farthest that what a light shines on has come at the distance 1 m, rad.
float turnedBy(const Light& was, const Light& is) {
    if (was.type == LightType::Point || was.type == LightType::Sphere) return 0;
    float chord = glm::distance(directionOf(was), directionOf(is));
    if (was.type == LightType::Spot) return chord;
    const glm::vec3 before = halfAxis(was), now = halfAxis(is);
    const float area = std::max(glm::length(before), glm::length(now));
    if (area > 0)
        chord = std::max(chord, std::min(glm::distance(before, now), glm::distance(before, -now)) / area);
    return chord;
}

// Whether it is the same light in another place.
bool onlyMoved(const Light& was, const Light& is) {
    Light moved = was;
    moved.position = is.position;
    moved.direction = is.direction;
    moved.halfU = is.halfU;
    moved.halfV = is.halfV;
    moved.name = is.name;
    return moved == is;
}

class Changes {
  public:
    explicit Changes(LightChange& change) : change_(change) {}

    void add(const Light& was, const Light& is) {
        if (was == is) return;
        if (!was.enabled && !is.enabled) return;
        if (was.enabled && is.enabled && was.type == is.type) {
            if (!hasPlace(is)) return addSun(was, is);
            if (onlyMoved(was, is)) return addMove(was, is);
            Light other = was;
            other.intensity = is.intensity;
            if (onlyMoved(other, is) && was.position == is.position) {
                other.intensity = glm::abs(is.intensity - was.intensity);
                return addWhole(other, partOf(was.intensity, is.intensity),
                                glm::max(was.intensity, is.intensity));
            }
        }
        if (was.enabled) addWhole(was);
        if (is.enabled) addWhole(is);
    }
    void addWhole(const Light& light) { addWhole(light, std::numeric_limits<float>::max(), light.intensity); }

  private:
    // By `light`, of a part of a light that has the intensity `whole`.
    void addWhole(const Light& light, float part, const glm::vec3& whole) {
        if (!light.enabled || math::brightness(light.intensity) == 0) return;
        auto edit = placeOf(light);
        if (!edit) {
            change_.isAnything = true;
            return;
        }
        edit->part = part;
        edit->whole = edit->flux * math::brightness(whole) / math::brightness(light.intensity);
        change_.lights.push_back(*edit);
    }
    // A step aside changes what lies to its side by twice its part of the distance. A turn changes the part of the beam
    // that it sweeps, however far away.
    void addMove(const Light& was, const Light& is) {
        auto edit = placeOf(is);
        if (!edit) {
            change_.isAnything = true;
            return;
        }
        const float step = glm::distance(was.position, is.position), turn = turnedBy(was, is);
        if (edit->flux == 0) return;
        edit->center = 0.5f * (was.position + is.position);
        edit->radius += 0.5f * step;
        edit->whole = edit->flux;
        if (turn > 0) {
            LightEdit swept = *edit;
            swept.part = std::min(turn / beamOf(is), 1.0f);
            swept.flux *= swept.part;
            swept.goes = true;
            change_.lights.push_back(swept);
            edit->whole = 0;
        }
        if (step > 0) {
            edit->reach = 2 * step;
            edit->part = 1;
            edit->goes = true;
            change_.lights.push_back(*edit);
        }
    }
    static float beamOf(const Light& light) {
        return light.type == LightType::Spot ? std::max(light.outerAngle, 1e-3f) : glm::half_pi<float>();
    }
    void addSun(const Light& was, const Light& is) {
        if (was.castsShadow != is.castsShadow) change_.isAnything = true;
        const float turn = glm::distance(directionOf(was), directionOf(is));
        const glm::vec3 dimmed = glm::abs(is.intensity - was.intensity);
        change_.everywhere +=
            math::brightness(dimmed) + turn * math::brightness(glm::max(is.intensity, was.intensity));
        change_.everywherePart += partOf(was.intensity, is.intensity) + turn / kWindow;
        change_.dimmed += math::brightness(dimmed);
        change_.dimmedPart += partOf(was.intensity, is.intensity);
    }

    LightChange& change_;
};

}  // namespace

float partOf(const glm::vec3& was, const glm::vec3& is) {
    float part = 0;
    for (int channel = 0; channel < 3; ++channel)
        if (is[channel] != was[channel])
            part = std::max(part, std::abs(is[channel] - was[channel]) / was[channel]);
    return part;
}

std::optional<LightEdit> placeOf(const Light& light) {
    if (!hasPlace(light)) return std::nullopt;
    LightEdit edit{.center = light.position};
    const float intensity = math::brightness(light.intensity) * farAway(light);
    switch (light.type) {
        case LightType::Spot:
            edit.flux = 2 * kPi * intensity * (1 - std::cos(0.5f * (light.innerAngle + light.outerAngle)));
            edit.axis = directionOf(light);
            break;
        case LightType::Sphere:
            edit.radius = glm::length(light.halfU);
            edit.flux = kPi * intensity * 4 * kPi * edit.radius * edit.radius;
            break;
        case LightType::Rect:
        case LightType::Disk:
            edit.radius = glm::length(light.halfU) + glm::length(light.halfV);
            edit.flux =
                kPi * intensity * (light.type == LightType::Disk ? kPi : 4.0f) * glm::length(halfAxis(light));
            break;
        default:
            edit.flux = 4 * kPi * intensity;
    }
    if (!std::isfinite(edit.flux)) return std::nullopt;
    return edit;
}

void LightEdits::look(const std::vector<Light>& lights) {
    before_ = std::move(lights_);
    lights_ = lights;
    same_ = false;
}

// Lights keep their order: those that are the same at both ends, or all of them where there are as many, are compared one
// by one; others go and come. pair(was, is): null where there is none.
template <typename Pair>
void LightEdits::forPairs(const Pair& pair) const {
    const std::vector<Light>& was = before();
    const std::size_t most = std::min(was.size(), lights_.size());
    std::size_t first = was.size() == lights_.size() ? most : 0, last = 0;
    while (first < most && was[first] == lights_[first]) ++first;
    while (last < most - first && was[was.size() - 1 - last] == lights_[lights_.size() - 1 - last]) ++last;
    for (std::size_t i = 0; i < first; ++i) pair(&was[i], &lights_[i]);
    for (std::size_t i = first; i < was.size() - last; ++i) pair(&was[i], nullptr);
    for (std::size_t i = first; i < lights_.size() - last; ++i) pair(nullptr, &lights_[i]);
    for (std::size_t i = last; i > 0; --i) pair(&was[was.size() - i], &lights_[lights_.size() - i]);
}

LightChange LightEdits::change(const glm::vec3& scale) const {
    LightChange change;
    if (same_ && scale == glm::vec3(1)) return change;
    Changes changes(change);
    forPairs([&](const Light* was, const Light* is) {
        if (was && is && scale == glm::vec3(1)) return changes.add(*was, *is);
        const std::size_t first = change.lights.size();
        Light scaled = was ? *was : *is;
        if (was)
            scaled.intensity = is ? scaledTo(was->intensity, scale, is->intensity) : scale * was->intensity;
        if (was && is)
            changes.add(scaled, *is);
        else
            changes.addWhole(scaled);
        const bool stays = was && is && *was == *is;
        if (scale != glm::vec3(1) && !stays) change.haveSaid(first);
    });
    return change;
}

void LightEdits::addSources(std::vector<LightSource>& sources, float radius) const {
    const auto fluxOf = [&](const Light* light) {
        const float bright = light && light->enabled ? math::brightness(light->intensity) : 0;
        if (bright == 0) return glm::vec3(0);
        const auto edit = placeOf(*light);
        return light->intensity * (edit ? edit->flux / bright : kPi * radius * radius);
    };
    forPairs([&](const Light* was, const Light* is) { sources.push_back({fluxOf(was), fluxOf(is)}); });
}

float LightEdits::flux() const {
    float all = 0;
    for (const Light& light : lights_) {
        const auto edit = placeOf(light);
        if (light.enabled) all += edit ? edit->flux : std::numeric_limits<float>::infinity();
    }
    return all;
}

}  // namespace conelight::light
