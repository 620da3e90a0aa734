// SPDX-License-Identifier: MIT
#include "support/truth_rig.h"

#include <cmath>

#include "support/view_rig.h"

namespace conelight::test {

Material mattMaterial(const glm::vec3& albedo, const glm::vec3& emission) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1);
    material.emission = emission;
    material.specular = 0;
    return material;
}

Scene closedBox(const Material& material) {
    Scene scene;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0), u(0), v(0);
            n[axis] = -side;
            u[(axis + 1) % 3] = 2;
            v[(axis + 2) % 3] = 2;
            const glm::vec3 corner = -n - 0.5f * (u + v);
            addInstance(scene, side < 0 ? quadMesh(corner, u, v) : quadMesh(corner, v, u), material);
        }
    Camera camera;
    camera.eye = {0.3f, 0.2f, 0.8f};
    camera.target = {-0.2f, -0.1f, -1};
    camera.fovY = 1.5f;
    scene.cameras.push_back(camera);
    return scene;
}

Mesh sphereMesh(int columns, int rows) {
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const float theta = 3.14159265f * static_cast<float>(y) / static_cast<float>(rows);
            const float phi = 6.28318531f * static_cast<float>(x % columns) / static_cast<float>(columns);
            mesh.positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                        std::sin(theta) * std::cos(phi));
        }
    mesh.normals = mesh.positions;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (columns + 1) + x);
            const auto b = a + static_cast<std::uint32_t>(columns) + 1;
            for (const std::uint32_t i : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(i);
        }
    return mesh;
}

Camera cameraAbove(const glm::vec3& point, float height, float width) {
    Camera camera;
    camera.eye = point + glm::vec3(0, height, 0);
    camera.target = point;
    camera.up = {0, 0, -1};
    camera.fovY = 2 * std::atan(0.5f * width / height);
    return camera;
}

glm::dvec3 meanColorOf(const Image& image) {
    glm::dvec3 sum(0);
    for (const glm::vec4& p : image.pixels) sum += glm::dvec3(p.r, p.g, p.b);
    return sum / static_cast<double>(image.pixels.size());
}

double meanOf(const Image& image) {
    const glm::dvec3 c = meanColorOf(image);
    return (c.r + c.g + c.b) / 3;
}

double relRmse(const Image& a, const Image& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
        squares += glm::dot(d, d) / 3;
    }
    return std::sqrt(squares / static_cast<double>(a.pixels.size())) / meanOf(b);
}

}  // namespace conelight::test
