// SPDX-License-Identifier: MIT
#include "io/upright.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <utility>

#include "io/files.h"

namespace conelight::io {
namespace {

constexpr float kLowest = 0.03f;  // of the height: what a model stands on

// Calls `use` with the corners of each triangle, in the world.
template <class Use>
void forTriangles(const Scene& scene, const Use& use) {
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const auto corner = [&](std::size_t k) {
            return glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[mesh.indices[k]], 1));
        };
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            use(std::array<glm::vec3, 3>{corner(i), corner(i + 1), corner(i + 2)});
    }
}

// Area of a box seen along the axis, as a part of the bounds'.
float outlinePart(const Aabb& box, const Aabb& bounds, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const glm::vec3 part = box.extent(), size = bounds.extent();
    return size[u] * size[v] > 0 ? part[u] * part[v] / (size[u] * size[v]) : 0.0f;
}

// Of the outline seen along the axis, the part between the ends of what the model stands on.
float stance(const Scene& scene, const Aabb& bounds, int axis) {
    const float top = bounds.min[axis] + kLowest * bounds.extent()[axis];
    Aabb base;
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
            const glm::vec3 p(instance.worldFromObject * glm::vec4(position, 1));
            if (p[axis] <= top) base.grow(p);
        }
    return outlinePart(base, bounds, axis);
}

void turn(Scene& scene, const glm::mat4& yUpFromScene) {
    const auto point = [&](glm::vec3& p) { p = glm::vec3(yUpFromScene * glm::vec4(p, 1)); };
    const auto way = [&](glm::vec3& v) { v = glm::mat3(yUpFromScene) * v; };
    for (Instance& instance : scene.instances)
        instance.worldFromObject = yUpFromScene * instance.worldFromObject;
    for (Light& light : scene.lights) {
        point(light.position);
        for (glm::vec3* v : {&light.direction, &light.halfU, &light.halfV}) way(*v);
    }
    for (Camera& camera : scene.cameras) {
        point(camera.eye);
        point(camera.target);
        way(camera.up);
    }
}

std::string headOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(4096, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    return head;
}

// Exporters that write coordinates as their programs have them, whose z is up, or take that for their default.
bool writesZUp(const std::string& comment, const std::string& extension) {
    for (const char* program : {"freecad", "openscad", "agisoft"})
        if (comment.find(program) != std::string::npos) return true;
    return extension == ".ply" && comment.find("blender") != std::string::npos;
}

UpAxis namedAxis(const std::string& comment) {
    constexpr std::pair<char, UpAxis> kAxes[] = {{'x', UpAxis::X}, {'y', UpAxis::Y}, {'z', UpAxis::Z}};
    for (const auto& [letter, axis] : kAxes)
        for (const char* form :
             {"{}-up", "{} up", "{}_up", "up axis: {}", "up axis = {}", "up: {}", "up={}"}) {
            const std::string words = fmt::format(fmt::runtime(form), letter);
            const std::size_t at = comment.find(words);
            if (at == std::string::npos) continue;
            const auto isLetter = [&](std::size_t i) {
                return i < comment.size() && std::isalnum(static_cast<unsigned char>(comment[i])) != 0;
            };
            if ((at == 0 || !isLetter(at - 1)) && !isLetter(at + words.size())) return axis;
        }
    return UpAxis::Auto;
}

UpAxis upAxisOf(const Scene& scene, const std::filesystem::path& path, std::string& because) {
    const std::string extension = lowerExtension(path);
    if (extension == ".stl") {
        because = "says nothing of its up axis: z was taken";
        return standsAlongZ(scene) ? UpAxis::Z : UpAxis::Y;
    }
    if (extension != ".obj" && extension != ".ply") return UpAxis::Y;
    const UpAxis named = upAxisOfComments(headOf(path), extension);
    if (named != UpAxis::Auto) {
        because = fmt::format("is {}-up by its comments; turned", named == UpAxis::X ? 'x' : 'z');
        return named;
    }
    because = "stands on a ground across z: turned from z-up";
    return hasGroundAcrossZ(scene) ? UpAxis::Z : UpAxis::Y;
}

}  // namespace

bool standsAlongZ(const Scene& scene) {
    const Aabb bounds = scene.bounds();
    return !bounds.empty() && stance(scene, bounds, 1) <= 2 * stance(scene, bounds, 2);
}

bool hasGroundAcrossZ(const Scene& scene) {
    constexpr float kFlat = 0.99f;    // cosine of a ground's slope
    constexpr float kRises = 0.1f;    // of the height: what is above rises from the ground
    constexpr float kBeyond = 0.8f;   // of the outline: so much that rises leaves a ground to be seen
    constexpr float kCovered = 0.5f;  // of the outline, by a ground
    const Aabb bounds = scene.bounds();
    if (bounds.empty() || !(bounds.extent().z > 0)) return false;
    const float height = bounds.extent().z;
    double areas[2] = {0, 0};  // facing down, facing up: a sheet of both counts once
    Aabb above;
    forTriangles(scene, [&](const std::array<glm::vec3, 3>& corners) {
        const glm::vec3 twice = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        float top = corners[0].z;
        for (const glm::vec3& p : corners) top = std::max(top, p.z);
        if (top <= bounds.min.z + kLowest * height && std::abs(twice.z) > kFlat * glm::length(twice))
            areas[twice.z > 0] += 0.5 * static_cast<double>(std::abs(twice.z));
        for (const glm::vec3& p : corners)
            if (p.z > bounds.min.z + kRises * height) above.grow(p);
    });
    const double outline = static_cast<double>(bounds.extent().x) * static_cast<double>(bounds.extent().y);
    const auto ground = static_cast<float>(outline > 0 ? std::max(areas[0], areas[1]) / outline : 0);
    return ground >= kCovered && !above.empty() && outlinePart(above, bounds, 2) <= kBeyond &&
           stance(scene, bounds, 1) < 0.5f * ground;
}

UpAxis upAxisOfComments(std::string_view head, const std::string& extension) {
    while (!head.empty()) {
        const std::size_t end = std::min(head.find('\n'), head.size());
        std::string line(head.substr(0, end));
        head.remove_prefix(std::min(end + 1, head.size()));
        std::transform(line.begin(), line.end(), line.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (line.rfind(extension == ".ply" ? "comment" : "#", 0) != 0) continue;
        if (const UpAxis named = namedAxis(line); named != UpAxis::Auto) return named;
        if (writesZUp(line, extension)) return UpAxis::Z;
    }
    return UpAxis::Auto;
}

void takeUpAxis(Scene& scene, const std::filesystem::path& path, UpAxis up) {
    const glm::mat4 yUpFromZUp{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};  // (x, y, z) -> (x, z, -y)
    const glm::mat4 yUpFromXUp{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // (x, y, z) -> (-y, x, z)
    std::string because;
    if (up == UpAxis::Auto) up = upAxisOf(scene, path, because);
    if (up != UpAxis::X && up != UpAxis::Z) return;
    turn(scene, up == UpAxis::X ? yUpFromXUp : yUpFromZUp);
    if (!because.empty()) scene.notes.push_back(because);
}

}  // namespace conelight::io
