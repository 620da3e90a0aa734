// SPDX-License-Identifier: MIT
#include "support/scenes.h"

#include <cmath>

namespace conelight::test {

Material diffuseMaterial(const glm::vec3& albedo, const glm::vec3& emission) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1);
    material.emission = emission;
    material.specular = 0;
    return material;
}

Mesh quadMesh(const glm::vec3& origin, const glm::vec3& edgeU, const glm::vec3& edgeV) {
    Mesh mesh;
    mesh.positions = {origin, origin + edgeU, origin + edgeU + edgeV, origin + edgeV};
    mesh.normals.assign(4, glm::normalize(glm::cross(edgeU, edgeV)));
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Mesh boxMesh() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return mesh;
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

std::size_t addInstance(Scene& scene, Mesh mesh, const Material& material, const glm::mat4& worldFromObject) {
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size());
    instance.material = static_cast<int>(scene.materials.size());
    instance.worldFromObject = worldFromObject;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    scene.instances.push_back(instance);
    return scene.instances.size() - 1;
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

}  // namespace conelight::test
