// SPDX-License-Identifier: MIT
#include "reference/seen_pixels.h"

#include "reference/lens.h"

namespace conelight::reference {
namespace {

constexpr int kBoxEdge = 4;  // rays per edge of a pixel

}  // namespace

std::vector<std::uint8_t> pixelsThatSee(const Scene& scene, const Camera& camera, int width, int height,
                                        PixelFilter filter, const MaterialChoice& chosen) {
    const RayScene rays(scene);
    const Lens lens(camera, width, height);
    const Material unset;
    const glm::dvec2 size(width, height);
    const auto sees = [&](const glm::dvec2& at) {
        const glm::dvec2 clip = at / size;
        RayHit hit;
        if (!rays.intersect(RayKind::Camera, lens.ray({2 * clip.x - 1, 1 - 2 * clip.y}), hit)) return false;
        const int material = scene.instances[hit.instance].material;
        return chosen(material < 0 ? unset : scene.materials[static_cast<std::size_t>(material)]);
    };
    const int edge = filter == PixelFilter::Box ? kBoxEdge : 1;
    std::vector<std::uint8_t> seen;
    seen.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            bool any = false;
            for (int i = 0; !any && i < edge * edge; ++i)
                any = sees(glm::dvec2(x, y) + (glm::dvec2(i % edge, i / edge) + 0.5) / double(edge));
            seen.push_back(any ? 1 : 0);
        }
    return seen;
}

}  // namespace conelight::reference
