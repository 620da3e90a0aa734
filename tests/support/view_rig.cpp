// SPDX-License-Identifier: MIT
#include "support/view_rig.h"

#include <cmath>

#include "shared/bindings.h"

namespace conelight::test {

ViewRig::ViewRig(const Scene& source, const Camera& seenFrom, int width, int height)
    : camera(seenFrom),
      sky(source.sky),
      gpuScene(source),
      frameBlock(sizeof(gpu::FrameConstants), "frame"),
      gbuffer(width, height) {}

void ViewRig::draw(gl::ProgramLibrary& programs, bool cullBackFaces) {
    frameBlock.update(view::frameConstants(camera, gbuffer.width(), gbuffer.height(), gpuScene, sky, 0, 1));
    frameBlock.bindUniform(BINDING_FRAME);
    gpuScene.bind();
    gbuffer.draw(programs, profiler, gpuScene, cullBackFaces);
    gbuffer.bind();
}

glm::dvec3 pixelOnPlane(const Camera& camera, int width, int height, int x, int y, const glm::dvec3& normal,
                        double offset) {
    const glm::dvec3 eye(camera.eye);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tanY = std::tan(0.5 * static_cast<double>(camera.fovY));
    const double clipX = (x + 0.5) / width * 2 - 1, clipY = (y + 0.5) / height * 2 - 1;
    const glm::dvec3 ray = forward + clipX * tanY * width / height * right + clipY * tanY * up;
    return eye + ray * ((offset - glm::dot(normal, eye)) / glm::dot(normal, ray));
}

Mesh quadMesh(const glm::vec3& origin, const glm::vec3& edgeU, const glm::vec3& edgeV) {
    Mesh mesh;
    mesh.positions = {origin, origin + edgeU, origin + edgeU + edgeV, origin + edgeV};
    mesh.normals.assign(4, glm::normalize(glm::cross(edgeU, edgeV)));
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
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

}  // namespace conelight::test
