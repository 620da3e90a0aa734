// SPDX-License-Identifier: MIT
#include "reference/baked_picture.h"

#include "reference/lens.h"
#include "reference/materials.h"

namespace conelight::reference {

BakedPicture drawWithIrradiance(const Scene& scene, const Camera& camera, const PathTracedPicture& truth,
                                const std::function<glm::vec3(const Surface&, const RayHit&)>& irradiance) {
    const int width = truth.full.width, height = truth.full.height;
    const Lens lens(camera, width, height);
    const RayScene rays(scene);
    const auto diffuseAt = [&](double x, double y) {
        const Ray ray = lens.ray(glm::dvec2(x / width * 2 - 1, 1 - y / height * 2));
        RayHit hit;
        if (!rays.intersect(RayKind::Camera, ray, hit)) return glm::vec3(0);
        const Surface surface = surfaceAt(scene, ray, hit);
        if (surface.unlit) return glm::vec3(0);
        // Of light along the normal: BRDF times a cosine of 1.
        const glm::vec3 brdf = Reflection(surface, -ray.direction).evaluate(surface.shadingNormal).diffuse;
        return brdf * irradiance(surface, hit);
    };
    BakedPicture picture{.diffuse = {width, height, truth.full.pixels}, .full = truth.full};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            const glm::vec3 diffuse = diffuseAt(x + 0.5, y + 0.5);
            picture.diffuse.pixels[at] = glm::vec4(diffuse, 1);
            picture.full.pixels[at] =
                truth.full.pixels[at] + glm::vec4(diffuse - glm::vec3(truth.diffuse.pixels[at]), 0);
        }
    return picture;
}

}  // namespace conelight::reference
