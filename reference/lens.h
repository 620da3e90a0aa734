// SPDX-License-Identifier: MIT
// The rays of a camera: Camera + size of the picture -> a ray for each point of it, through a pinhole or a thin lens, or
// parallel to the others.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "conelight/scene.h"
#include "reference/ray_scene.h"

namespace conelight::reference {

// src/view/camera.cpp, axesOf, as rays.
struct Lens {
    glm::dvec3 eye, forward, right, up;
    double zNear, zFar;
    double radius = 0, focus = 1;  // of the lens, and the distance of the plane in focus; radius 0: a pinhole
    bool parallel;                 // right and up are half the picture's size, m, else tangents

    Lens(const Camera& camera, int width, int height)
        : eye(camera.eye),
          zNear(static_cast<double>(camera.zNear)),
          zFar(static_cast<double>(camera.zFar)),
          parallel(camera.isOrthographic()) {
        const CameraAxes axes = cameraAxes(camera);
        forward = axes.forward;
        const double tanY = parallel ? 0.5 * static_cast<double>(camera.orthographicHeight)
                                     : std::tan(0.5 * static_cast<double>(camera.fovY));
        if (camera.hasLens()) {
            radius = 0.5 * static_cast<double>(camera.lensDiameter);
            focus = static_cast<double>(camera.focus());
        }
        up = axes.up * tanY;
        right = axes.right * (tanY * width / height);
    }

    // Through a point of the picture, [-1,1]^2 with y up, and one of the lens, unit disc: all rays of a point of the
    // picture meet on the plane in focus.
    Ray ray(const glm::dvec2& clip, const glm::dvec2& point = glm::dvec2(0)) const {
        if (parallel)
            return {glm::vec3(eye + clip.x * right + clip.y * up), glm::vec3(forward),
                    static_cast<float>(zNear), static_cast<float>(zFar)};
        const glm::dvec3 beside = radius * (point.x * glm::normalize(right) + point.y * glm::normalize(up));
        const glm::dvec3 way = forward + clip.x * right + clip.y * up - beside / focus;
        const double length = glm::length(way);
        Ray ray;
        ray.origin = glm::vec3(eye + beside);
        ray.direction = glm::vec3(way / length);
        ray.tMin = static_cast<float>(zNear * length);
        ray.tMax = static_cast<float>(zFar * length);
        return ray;
    }

    // Where the picture has a point of the world: [-1,1]^2 with y up, and its depth.
    glm::dvec3 placeOf(const glm::dvec3& point) const {
        const glm::dvec3 way = point - eye;
        const double depth = glm::dot(way, forward), scale = parallel ? 1 : depth;
        return {glm::dot(way, right) / (scale * glm::dot(right, right)),
                glm::dot(way, up) / (scale * glm::dot(up, up)), depth};
    }

    // What a step in the picture, [-1,1]^2, adds to the unit direction of ray(clip), to first order; of parallel rays to
    // their origin, m.
    glm::vec3 turn(const glm::dvec2& clip, const glm::dvec2& step) const {
        if (parallel) return glm::vec3(step.x * right + step.y * up);
        const glm::dvec3 way = forward + clip.x * right + clip.y * up;
        const double length = glm::length(way);
        const glm::dvec3 direction = way / length, change = (step.x * right + step.y * up) / length;
        return glm::vec3(change - direction * glm::dot(direction, change));
    }
};

}  // namespace conelight::reference
