// SPDX-License-Identifier: MIT
// Rays from the camera against the session's triangles (Embree): what is under a pixel or in front of the
// eye. Matrices are applied, invisible instances and back faces of single-sided materials are not there.
// The ray structure is built at the first pick after a change of the scene.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "session/session.h"

namespace conelight::program {

struct Pick {
    glm::vec3 position{0};       // world, m
    glm::vec3 normal{0};         // unit, of the triangle, on the eye's side
    glm::vec3 shadingNormal{0};  // unit, interpolated and mapped
    float distance = 0;          // m
    std::size_t instance = 0;
    int material = -1;
    std::uint32_t triangle = 0;
    glm::vec2 barycentric{0};  // weights of vertices 1 and 2
    std::string object;        // the instance's name
};

class Picker {
  public:
    Picker();
    ~Picker();
    Picker(const Picker&) = delete;
    Picker& operator=(const Picker&) = delete;

    std::optional<Pick> along(const Session& session, const glm::vec3& origin, const glm::vec3& direction,
                              float tMin = 0);
    // The centre of pixel (x, y), counted from the upper left corner; what is nearer than the near plane is
    // passed.
    std::optional<Pick> atPixel(const Session& session, int width, int height, int x, int y);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
