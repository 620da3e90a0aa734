// SPDX-License-Identifier: MIT
#include "reference/radiosity_result.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/brdf.h"
#include "reference/layers.h"
#include "reference/surface.h"

namespace conelight::reference {
namespace {

Surface surfaceOfVertex(const Scene& scene, const ElementMesh& mesh, std::uint32_t vertex) {
    const ElementVertex& v = mesh.vertices[vertex];
    RayHit hit = mesh.hitAt(v.element, v.barycentric);
    // The vertex may have come from another triangle than the element at hand.
    hit.triangle = v.triangle;
    hit.barycentric = glm::vec2(v.barycentric);
    Ray ray;
    ray.direction = mesh.surfaces[v.surface].back ? hit.geometricNormal : -hit.geometricNormal;
    return surfaceAt(scene, ray, hit);
}

template <typename T>
T interpolated(const Mesh& mesh, const std::vector<T>& values, const ElementVertex& v, const T& missing) {
    if (values.empty()) return missing;
    const std::size_t i = 3 * std::size_t{v.triangle};
    const glm::vec2 b(v.barycentric);
    return values[mesh.indices[i]] * (1 - b.x - b.y) + values[mesh.indices[i + 1]] * b.x +
           values[mesh.indices[i + 2]] * b.y;
}

// Emission and reflected light cannot share a texture: where a surface does both, the vertices hold the sum.
bool holdsSum(const Material& material) {
    return material.emission.r > 0 || material.emission.g > 0 || material.emission.b > 0;
}

// Shows what the vertices hold, times the base colour where they hold reflected light alone.
Material unlitMaterial(const Material& material) {
    const bool sum = holdsSum(material);
    Material unlit;
    unlit.name = material.name;
    unlit.unlit = true;
    unlit.baseColor = sum ? glm::vec4(1, 1, 1, material.baseColor.a) : material.baseColor;
    if (!sum || material.alphaMode != AlphaMode::Opaque) unlit.baseColorTexture = material.baseColorTexture;
    unlit.alphaMode = material.alphaMode;
    unlit.alphaCutoff = material.alphaCutoff;
    return unlit;
}

// Makes one mesh of each surface, its light in the colours of its vertices.
class LitMeshes {
  public:
    LitMeshes(const Scene& scene, const ElementMesh& mesh, const std::vector<glm::vec3>& irradiance)
        : scene_(scene), mesh_(mesh), irradiance_(irradiance), newIndex_(mesh.vertices.size(), kNoElement) {}

    // `leaves`: the surface's elements that are not divided.
    Mesh of(const RadiositySurface& surface, const std::vector<std::uint32_t>& leaves) {
        const Instance& instance = scene_.instances[surface.instance];
        const Mesh& source = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
        const bool sum = holdsSum(materialOf(scene_, instance));
        Mesh result;
        result.name = source.name + (surface.back ? " (back)" : "");
        for (const std::uint32_t e : leaves) {
            std::array<std::uint32_t, 3> corners = mesh_.elements[e].vertices;
            if (surface.reversed) std::swap(corners[1], corners[2]);
            for (const std::uint32_t corner : corners) {
                if (newIndex_[corner] == kNoElement) {
                    newIndex_[corner] = static_cast<std::uint32_t>(result.positions.size());
                    append(result, source, corner, sum);
                }
                result.indices.push_back(newIndex_[corner]);
            }
        }
        return result;
    }

  private:
    void append(Mesh& result, const Mesh& source, std::uint32_t vertex, bool sum) const {
        const ElementVertex& v = mesh_.vertices[vertex];
        const Surface at = surfaceOfVertex(scene_, mesh_, vertex);
        result.positions.push_back(glm::vec3(v.position));
        result.normals.push_back(at.geometricNormal);
        if (!source.uvs.empty()) result.uvs.push_back(interpolated(source, source.uvs, v, glm::vec2(0)));
        const glm::vec4 tint = interpolated(source, source.colors, v, glm::vec4(1));
        glm::vec3 reflected = irradiance_[vertex] * (diffusePart(at) / glm::pi<float>());
        // A factor on the base colour, which may be a texture's.
        if (at.layered())
            reflected = irradiance_[vertex] / glm::pi<float>() *
                        evenAlbedoOfLayers(at, diffusePart(at) * at.baseColor) /
                        glm::max(at.baseColor, 1e-3f);
        result.colors.push_back(sum ? glm::vec4(reflected * at.baseColor + at.emission, tint.a)
                                    : glm::vec4(reflected * glm::vec3(tint), tint.a));
    }

    const Scene& scene_;
    const ElementMesh& mesh_;
    const std::vector<glm::vec3>& irradiance_;
    std::vector<std::uint32_t> newIndex_;  // each vertex belongs to one surface
};

}  // namespace

float diffusePart(const Surface& s) {
    if (s.dielectricF0 == glm::vec3(0)) return 1 - s.metallic;
    constexpr int kAngles = 16;
    float sum = 0;
    for (int i = 0; i < kAngles; ++i) {
        const float cosine2 = (static_cast<float>(i) + 0.5f) / kAngles;
        sum += math::makeBrdf(glm::vec3(1), s.metallic, s.roughness, s.dielectricF0, std::sqrt(cosine2))
                   .diffuse.x;
    }
    return sum / kAngles;
}

Scene litScene(const Scene& scene, const ElementMesh& mesh, const std::vector<glm::vec3>& irradiance) {
    Scene lit = scene;
    lit.lights.clear();
    // Surfaces become instances of their own; what is unlit or invisible stays.
    std::vector<bool> replaced(scene.instances.size(), false);
    for (const RadiositySurface& surface : mesh.surfaces) replaced[surface.instance] = true;
    lit.instances.clear();
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (!replaced[i]) lit.instances.push_back(scene.instances[i]);

    std::vector<std::vector<std::uint32_t>> leaves(mesh.surfaces.size());
    for (std::uint32_t e = 0; e < mesh.elements.size(); ++e)
        if (mesh.isLeaf(e)) leaves[mesh.surfaceOf(e)].push_back(e);
    LitMeshes meshes(scene, mesh, irradiance);
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        const RadiositySurface& surface = mesh.surfaces[s];
        const Instance& instance = scene.instances[surface.instance];
        Mesh result = meshes.of(surface, leaves[s]);
        Material unlit = unlitMaterial(materialOf(scene, instance));
        Instance placed = instance;
        placed.worldFromObject = glm::mat4(1);
        placed.mesh = static_cast<int>(lit.meshes.size());
        placed.material = static_cast<int>(lit.materials.size());
        placed.dynamic = false;
        lit.meshes.push_back(std::move(result));
        lit.materials.push_back(std::move(unlit));
        lit.instances.push_back(std::move(placed));
    }
    return lit;
}

BakedLight bakedLight(const Scene& scene, const ElementMesh& mesh, const std::vector<glm::vec3>& irradiance) {
    BakedLight baked;
    for (const RadiositySurface& surface : mesh.surfaces)
        baked.surfaces.push_back({static_cast<int>(surface.instance), surface.back,
                                  scene.instances[surface.instance].worldFromObject});
    // What is unlit takes no light, and stands there all the same.
    std::vector<bool> known(scene.instances.size(), false);
    for (const RadiositySurface& surface : mesh.surfaces) known[surface.instance] = true;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].visible && !known[i])
            baked.surfaces.push_back({static_cast<int>(i), false, scene.instances[i].worldFromObject});
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        baked.positions.push_back(glm::vec3(mesh.vertices[i].position));
        baked.surfaceOf.push_back(mesh.vertices[i].surface);
        baked.irradiance.push_back(glm::max(irradiance[i], glm::vec3(0)));
    }
    for (std::uint32_t e = 0; e < mesh.elements.size(); ++e) {
        if (!mesh.isLeaf(e)) continue;
        std::array<std::uint32_t, 3> corners = mesh.elements[e].vertices;
        if (mesh.surfaces[mesh.surfaceOf(e)].reversed) std::swap(corners[1], corners[2]);
        baked.indices.insert(baked.indices.end(), corners.begin(), corners.end());
    }
    return baked;
}

}  // namespace conelight::reference
