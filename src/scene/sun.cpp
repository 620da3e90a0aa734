// SPDX-License-Identifier: MIT
// The sun of an environment's picture as a light of its own: shadows as sharp as shadow maps are, and no
// noise.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "conelight/scene.h"
#include "scene/surroundings.h"

namespace conelight {
namespace {

// The sun with its glow in the lens lies within the inner angle; the sky beside it up to the outer one.
constexpr double kInner = 4 * std::numbers::pi / 180, kOuter = 8 * std::numbers::pi / 180;
// A sun gives at least this share of the light of all directions.
constexpr double kLeastShare = 0.05;

double brightness(const glm::vec3& radiance) {
    return static_cast<double>(radiance.r + radiance.g + radiance.b) / 3;
}

struct Spot {
    glm::dvec3 toSun{0};       // unit, of the picture before its rotation
    glm::dvec3 irradiance{0};  // above the sky beside it
    glm::dvec3 beside{0};      // radiance
    double light = 0;          // of all directions
};

template <class Visit>
void forTexels(const EnvironmentImage& image, const Visit& visit) {
    std::size_t i = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, ++i)
            visit(i,
                  glm::dvec3(environmentDirection(
                      {(static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                       (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height)})),
                  scene::texelSolidAngle(image, y));
}

Spot brightestSpot(const EnvironmentImage& image) {
    Spot spot;
    double brightest = -1;
    forTexels(image, [&](std::size_t i, const glm::dvec3& direction, double solidAngle) {
        const double value = brightness(image.radiance[i]);
        spot.light += value * solidAngle;
        if (value > brightest) {
            brightest = value;
            spot.toSun = direction;
        }
    });
    const glm::dvec3 middle = spot.toSun;
    double ring = 0;
    forTexels(image, [&](std::size_t i, const glm::dvec3& direction, double solidAngle) {
        const double cosine = glm::dot(direction, middle);
        if (cosine > std::cos(kInner) || cosine < std::cos(kOuter)) return;
        spot.beside += glm::dvec3(image.radiance[i]) * solidAngle;
        ring += solidAngle;
    });
    if (ring > 0) spot.beside /= ring;
    glm::dvec3 direction(0);
    forTexels(image, [&](std::size_t i, const glm::dvec3& at, double solidAngle) {
        if (glm::dot(at, middle) < std::cos(kInner)) return;
        const glm::dvec3 more =
            glm::max(glm::dvec3(image.radiance[i]) - spot.beside, glm::dvec3(0)) * solidAngle;
        spot.irradiance += more;
        direction += at * (more.r + more.g + more.b);
    });
    if (glm::length(direction) > 0) spot.toSun = glm::normalize(direction);
    return spot;
}

}  // namespace

bool splitSun(Scene& scene) {
    Environment& environment = scene.environment;
    if (!environment.used()) return false;
    const EnvironmentImage& image = *environment.image;
    const Spot spot = brightestSpot(image);
    if (!(brightness(glm::vec3(spot.irradiance)) > kLeastShare * spot.light)) return false;

    auto rest = std::make_shared<EnvironmentImage>(image);
    forTexels(image, [&](std::size_t i, const glm::dvec3& at, double) {
        if (glm::dot(at, spot.toSun) > std::cos(kInner))
            rest->radiance[i] = glm::min(rest->radiance[i], glm::vec3(spot.beside));
    });
    environment.image = std::move(rest);
    environment.file = "sunless " + environment.file;

    Light sun;
    sun.name = "sun";
    sun.type = LightType::Directional;
    sun.intensity = environment.strength * glm::vec3(spot.irradiance);
    // A rotation of the surroundings turns -z towards -x.
    const double c = std::cos(static_cast<double>(environment.rotation)),
                 s = std::sin(static_cast<double>(environment.rotation));
    sun.direction = glm::vec3(
        -glm::dvec3(c * spot.toSun.x + s * spot.toSun.z, spot.toSun.y, -s * spot.toSun.x + c * spot.toSun.z));
    scene.lights.push_back(std::move(sun));
    return true;
}

}  // namespace conelight
