// SPDX-License-Identifier: MIT
#include "io/generated_trial_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace conelight::io::generated {
namespace {

constexpr float kWall = 0.2f;

bool within(const Aabb& box, glm::vec3 p, float grow = 0) {
    return glm::all(glm::greaterThan(p, box.min - grow)) && glm::all(glm::lessThan(p, box.max + grow));
}

}  // namespace

void addRoom(Scene& scene, const Aabb& room, const RoomMaterials& m, const std::vector<Aabb>& openings) {
    shapes::CellSolid shell;
    for (int a = 0; a < 3; ++a) {
        std::vector<float> planes = {room.min[a] - kWall, room.min[a], room.max[a], room.max[a] + kWall};
        for (const Aabb& hole : openings)
            for (const float edge : {hole.min[a], hole.max[a]})
                if (edge > room.min[a] && edge < room.max[a]) planes.push_back(edge);
        std::sort(planes.begin(), planes.end());
        planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
        shell.planes[std::size_t(a)] = planes;
    }
    shell.solid = [=](glm::vec3 p) {
        if (within(room, p)) return false;
        for (const Aabb& hole : openings)
            if (within(hole, p)) return false;
        return true;
    };
    shell.part = [=](glm::vec3 p, glm::vec3 n) {
        if (!within(room, p, 0.01f)) return 6;
        if (n.y > 0.5f) return 0;
        if (n.y < -0.5f) return 1;
        if (std::abs(n.x) > 0.5f) return n.x > 0 ? 2 : 3;
        return n.z > 0 ? 4 : 5;
    };
    const char* names[] = {"floor",     "ceiling",    "left wall", "right wall",
                           "back wall", "front wall", "outside"};
    const int materials[] = {m.floor, m.ceiling, m.left, m.right, m.back, m.front, m.left};
    std::vector<Mesh> meshes = shapes::buildCells(shell, 7);
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (!meshes[i].indices.empty()) addPart(scene, std::move(meshes[i]), names[i], materials[i]);
}

int white(Scene& scene) { return add(scene, matte("white", {0.72f, 0.71f, 0.69f})); }

Mesh sphere(float radius, int around) {
    Mesh mesh;
    shapes::appendPatch(mesh, shapes::uvSphere(glm::vec3(0), glm::vec3(radius), around, around / 2));
    return mesh;
}

Mesh turned(const std::vector<shapes::Curve>& profile, int around) {
    Mesh mesh;
    for (const shapes::Patch& patch : shapes::lathe(profile, around, 0.3f)) shapes::appendPatch(mesh, patch);
    return mesh;
}

Mesh torus(float major, float minor) {
    const float pi = glm::pi<float>();
    return turned({shapes::arc({major, 0}, {minor, minor}, -0.5f * pi, 0.5f * pi, 16),
                   shapes::arc({major, 0}, {minor, minor}, 0.5f * pi, 1.5f * pi, 16)},
                  64);
}

Light spotLight(std::string name, glm::vec3 from, glm::vec3 to, float outerDeg, glm::vec3 intensity) {
    Light light = pointLight(std::move(name), from, intensity);
    light.type = LightType::Spot;
    light.direction = glm::normalize(to - from);
    light.outerAngle = glm::radians(outerDeg);
    light.innerAngle = 0.7f * light.outerAngle;
    return light;
}

}  // namespace conelight::io::generated
