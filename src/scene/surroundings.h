// SPDX-License-Identifier: MIT
// What the surroundings send from each direction (Scene::sky, Scene::environment), on the CPU, and how
// directions are drawn in proportion to it. The picture is interpolated between the centres of its texels.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "conelight/scene.h"

namespace conelight::scene {

// The picture at another size, as means over solid angle: all light is kept. Width and height at least 1.
EnvironmentImage resampled(const EnvironmentImage& image, int width, int height);

// Solid angle of each texel of a row, sr.
double texelSolidAngle(const EnvironmentImage& image, int row);

class Surroundings {
  public:
    explicit Surroundings(const Scene& scene);

    // W/(sr m^2), all of it and of the picture alone; `direction`: unit.
    glm::vec3 radiance(const glm::vec3& direction) const { return sky_ + pictureRadiance(direction); }
    glm::vec3 pictureRadiance(const glm::vec3& direction) const;
    bool isBlack() const;
    // Whether there is a picture: its directions are worth drawing.
    bool hasPicture() const { return !rowSums_.empty(); }

    // A direction, with its density per steradian, which is that of density(). Only of a picture.
    struct Draw {
        glm::vec3 direction{0};
        float density = 0;
    };
    Draw draw(const glm::vec2& u) const;  // u in [0,1)^2
    float density(const glm::vec3& direction) const;

  private:
    glm::vec2 turnedUv(const glm::vec3& direction) const;

    glm::vec3 sky_;
    Environment environment_;
    // Running sums of the light of rows, and of texels within each row.
    std::vector<double> rowSums_;
    std::vector<float> texelSums_;
};

}  // namespace conelight::scene
