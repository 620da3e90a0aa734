// SPDX-License-Identifier: MIT
#include "surfaces.h"

#include <algorithm>
#include <cmath>

#include "camera_axes.h"
#include "conelight/error.h"
#include "reference/radiosity_parallel.h"
#include "reference/surface.h"

namespace conelight::python {
namespace {

glm::vec2 uvAt(const Mesh& mesh, const reference::RayHit& hit) {
    if (mesh.uvs.empty()) return glm::vec2(0);
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(hit.triangle)];
    const glm::vec2 b = hit.barycentric;
    return mesh.uvs[corner[0]] * (1 - b.x - b.y) + mesh.uvs[corner[1]] * b.x + mesh.uvs[corner[2]] * b.y;
}

void fill(SurfaceTables& tables, std::size_t pixel, const Scene& scene, const reference::Ray& ray,
          const reference::RayHit& hit) {
    const Instance& instance = scene.instances[hit.instance];
    const reference::Surface surface = reference::surfaceAt(scene, ray, hit);
    tables.instance[pixel] = static_cast<std::int32_t>(hit.instance);
    tables.material[pixel] = instance.material;
    tables.triangle[pixel] = static_cast<std::int32_t>(hit.triangle);
    tables.position[pixel] = ray.origin + hit.t * ray.direction;
    tables.geometricNormal[pixel] = surface.geometricNormal;
    tables.normal[pixel] = surface.shadingNormal;
    tables.uv[pixel] = uvAt(scene.meshes[static_cast<std::size_t>(instance.mesh)], hit);
    tables.baseColor[pixel] = surface.baseColor;
    tables.metallic[pixel] = surface.metallic;
    tables.roughness[pixel] = surface.roughness;
}

// Where a camera's picture has a point of the world, in pixels from its corner.
class Projection {
  public:
    Projection(const Camera& camera, const glm::ivec2& size)
        : eye_(camera.eye),
          axes_(cameraAxes(camera)),
          parallel_(camera.isOrthographic()),
          perPixel_(pixelSize(camera, size.y)),
          middle_(0.5 * glm::dvec2(size)) {}
    glm::dvec2 operator()(const glm::dvec3& point) const {
        const glm::dvec3 way = point - eye_;
        const double depth = (parallel_ ? 1 : glm::dot(way, axes_.forward)) * perPixel_;
        return middle_ + glm::dvec2(glm::dot(way, axes_.right), -glm::dot(way, axes_.up)) / depth;
    }

  private:
    glm::dvec3 eye_;
    CameraAxes axes_;
    bool parallel_;
    double perPixel_;
    glm::dvec2 middle_;
};

// The point of an instance's triangle, world, m.
glm::dvec3 pointOf(const Scene& scene, const reference::RayHit& hit) {
    const Instance& instance = scene.instances[hit.instance];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(hit.triangle)];
    const glm::dvec2 b = hit.barycentric;
    const glm::dvec3 point = glm::dvec3(mesh.positions[corner[0]]) * (1 - b.x - b.y) +
                             glm::dvec3(mesh.positions[corner[1]]) * b.x +
                             glm::dvec3(mesh.positions[corner[2]]) * b.y;
    return glm::dvec3(glm::dmat4(instance.worldFromObject) * glm::dvec4(point, 1));
}

}  // namespace

void checkSeenBefore(const Scene& scene, const SeenBefore& before) {
    bool same = scene.instances.size() == before.scene.instances.size() &&
                scene.meshes.size() == before.scene.meshes.size();
    for (std::size_t i = 0; same && i < scene.meshes.size(); ++i)
        same = scene.meshes[i].indices == before.scene.meshes[i].indices &&
               scene.meshes[i].positions.size() == before.scene.meshes[i].positions.size();
    for (std::size_t i = 0; same && i < scene.instances.size(); ++i)
        same = scene.instances[i].mesh == before.scene.instances[i].mesh;
    if (!same)
        throw Error(
            ErrorKind::Usage,
            "previous_scene: has other instances or meshes; the same scene at another time would be right");
}

SurfaceTables::SurfaceTables(std::size_t pixels)
    : instance(pixels, -1),
      material(pixels, -1),
      triangle(pixels, -1),
      depth(pixels),
      position(pixels),
      geometricNormal(pixels),
      normal(pixels),
      uv(pixels),
      baseColor(pixels),
      metallic(pixels),
      roughness(pixels) {}

SurfaceTables surfacesOf(const Scene& scene, const reference::RayScene& rays, const Camera& camera,
                         const glm::ivec2& size, int threads, const SeenBefore* before) {
    const auto width = static_cast<std::size_t>(size.x), height = static_cast<std::size_t>(size.y);
    SurfaceTables tables(width * height);
    if (before != nullptr) tables.motion.resize(width * height);
    const Projection now(camera, size), then(before != nullptr ? before->camera : camera, size);
    const CameraAxes axes = cameraAxes(camera);
    const double perPixel = pixelSize(camera, size.y);
    const bool parallel = camera.isOrthographic();
    const auto see = [&](std::size_t pixel) {
        const double x = (double(pixel % width) + 0.5 - 0.5 * size.x) * perPixel;
        const double y = (0.5 * size.y - double(pixel / width) - 0.5) * perPixel;
        const glm::dvec3 aside = x * axes.right + y * axes.up, still(0);
        const glm::dvec3 along = axes.forward + (parallel ? still : aside);
        const double length = glm::length(along);  // of a step of 1 m in depth
        const glm::dvec3 origin = glm::dvec3(camera.eye) + (parallel ? aside : still);
        const reference::Ray ray{glm::vec3(origin), glm::vec3(along / length), float(camera.zNear * length),
                                 float(camera.zFar * length)};
        reference::RayHit hit;
        if (!rays.intersect(reference::RayKind::Camera, ray, hit)) return;
        tables.depth[pixel] = static_cast<float>(hit.t / length);
        fill(tables, pixel, scene, ray, hit);
        if (before != nullptr)
            tables.motion[pixel] = glm::vec2(then(pointOf(before->scene, hit)) - now(pointOf(scene, hit)));
    };
    const auto some = [&](std::size_t begin, std::size_t end) {
        for (std::size_t pixel = begin; pixel < end; ++pixel) see(pixel);
    };
    reference::parallelFor(width * height, threads, some, {});
    return tables;
}

}  // namespace conelight::python
