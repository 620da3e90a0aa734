// SPDX-License-Identifier: MIT
// Where the rectangles of instances lie in maps: as many as fit into one, in the order of the scene.
#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "reference/lightmaps.h"
#include "reference/materials.h"

namespace conelight::reference {
namespace {

bool hasMap(const Scene& scene, const Instance& instance) {
    if (!instance.visible || instance.mesh < 0) return false;
    const Material& material = materialOf(scene, instance);
    const bool metal = material.metallic >= 1 && !material.metallicRoughnessTexture.used();
    return !material.unlit && !metal &&
           scene.meshes[static_cast<std::size_t>(instance.mesh)].triangleCount() > 0;
}

// Of the instances of each mesh that have maps, the largest; -1: none.
std::vector<int> largestInstances(const Scene& scene, const std::vector<std::size_t>& mapped) {
    std::vector<int> largest(scene.meshes.size(), -1);
    const auto volume = [&](std::size_t i) {
        return std::abs(glm::determinant(glm::mat3(scene.instances[i].worldFromObject)));
    };
    for (const std::size_t i : mapped) {
        int& known = largest[static_cast<std::size_t>(scene.instances[i].mesh)];
        if (known < 0 || volume(i) > volume(static_cast<std::size_t>(known))) known = static_cast<int>(i);
    }
    return largest;
}

// The places of the first of `sizes`, as many as a map holds.
std::vector<glm::ivec2> fillMap(std::vector<glm::ivec2> sizes, int side) {
    double area = 0;
    std::size_t count = 0;
    while (count < sizes.size()) {
        area += static_cast<double>(sizes[count].x) * sizes[count].y;
        if (count > 0 && area > static_cast<double>(side) * side) break;
        ++count;
    }
    std::vector<glm::ivec2> places, smaller;
    for (sizes.resize(count); !packRectangles(sizes, glm::ivec2(side), places); sizes.resize(count))
        count = std::max<std::size_t>(1, count * 9 / 10);
    for (int edge = side * 9 / 10; edge >= 1 && packRectangles(sizes, glm::ivec2(edge), smaller);
         edge = edge * 9 / 10)
        places = smaller;
    return places;
}

}  // namespace

std::size_t LightmapLayout::texels() const {
    std::size_t sum = 0;
    for (const glm::ivec2& size : sizes)
        sum += static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    return sum;
}

LightmapLayout layOutLightmaps(const Scene& scene, float texel, int side) {
    if (!(texel > 0) || !std::isfinite(texel) || side < 16 || side > 16384)
        base::fail(ErrorKind::Usage,
                   "light maps: texels of %g m, maps of %d texels; right would be above 0, 16 to 16384",
                   static_cast<double>(texel), side);
    scene.validate();
    std::vector<std::size_t> mapped;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (hasMap(scene, scene.instances[i])) mapped.push_back(i);
    if (mapped.empty())
        base::fail(ErrorKind::BadInput,
                   "light maps: the scene has no visible instance that reflects diffusely");
    LightmapLayout layout;
    layout.texel = texel;
    layout.meshes.resize(scene.meshes.size());
    layout.places.resize(scene.instances.size());
    const std::vector<int> largest = largestInstances(scene, mapped);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (largest[m] < 0) continue;
        const Instance& instance = scene.instances[static_cast<std::size_t>(largest[m])];
        layout.meshes[m] = chartMesh(scene.meshes[m], instance.worldFromObject, texel, side,
                                     "light map of " + instance.name);
    }
    std::vector<glm::ivec2> sizes;
    for (const std::size_t i : mapped)
        sizes.push_back(layout.meshes[static_cast<std::size_t>(scene.instances[i].mesh)].size);
    for (std::size_t first = 0; first < mapped.size();) {
        const auto from = sizes.begin() + static_cast<std::ptrdiff_t>(first);
        const std::vector<glm::ivec2> places = fillMap({from, sizes.end()}, side);
        glm::ivec2 used(1);
        for (std::size_t k = 0; k < places.size(); ++k, ++first) {
            used = glm::max(used, places[k] + sizes[first]);
            layout.places[mapped[first]] = {static_cast<int>(layout.sizes.size()), places[k]};
        }
        layout.sizes.push_back(used);
    }
    return layout;
}

}  // namespace conelight::reference
