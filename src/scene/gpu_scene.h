// SPDX-License-Identifier: MIT
// The scene on the GPU: Scene (CPU tables) -> buffers of shared/scene.h, textures per material, and all
// textures once more at low resolution in one array that compute shaders can index (voxelizers).
// Materials are deduplicated to the scene's own plus a default one at the end.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "conelight/scene.h"
#include "gl/buffer.h"
#include "gl/draw.h"
#include "gl/texture.h"
#include "shared/scene.h"

namespace conelight::scene {

class GpuScene {
  public:
    // Uploads everything. Throws Error(BadInput) by Scene::validate.
    explicit GpuScene(const Scene& source);

    // Binds the tables of shared/bindings.h (vertices, indices, instances, materials, lights) and the
    // surface array.
    void bind() const;

    // Draws every visible instance accepted by `filter` (all when empty) with the current program,
    // framebuffer and state. Attributes: 0 position, 1 normalOct, 2 uv, 3 tangentOct, 4 color
    // (shared/scene.h), 5 the index into the instance table. `cull` holds for single-sided materials;
    // double-sided ones are never culled; flipped instances reverse the front face. `bindTextures`: the
    // material's six textures at UNIT_MATERIAL_*. `copies`: instances per draw, gl_InstanceID = 0..copies-1
    // (layered rendering). GL state changed: vertex array, cull, front face, texture units 0-5.
    using InstanceFilter = std::function<bool(const gpu::Instance&)>;
    void draw(const InstanceFilter& filter, gl::Cull cull, bool bindTextures, int copies = 1) const;

    const Aabb& bounds() const { return bounds_; }
    Aabb instanceBounds(
        std::size_t instance) const;  // world box of the object box: may be larger than needed
    std::uint32_t triangleCount() const { return triangleCount_; }  // over all instances, visible or not
    const std::vector<gpu::Instance>& instances() const { return instances_; }
    const std::vector<gpu::Material>& materials() const { return materials_; }
    const std::vector<gpu::Light>& lights() const { return lights_; }
    bool hasVertexColors() const { return hasVertexColors_; }  // of any mesh
    // Light stage: adds lights of emitters, writes shadow maps into the table. Sorted by type.
    void updateLights(const std::vector<gpu::Light>& lights);
    // Light stage: sets or takes away INSTANCE_LIT_EXACTLY.
    void setLitExactly(std::size_t instance, bool lit);
    // Moves one instance (dynamic objects); bounds and tables follow.
    void setTransform(std::size_t instance, const glm::mat4& worldFromObject);

    const gl::Buffer& instanceBuffer() const { return instanceBuffer_; }

  private:
    void uploadGeometry(const Scene& source);
    void uploadMaterials(const Scene& source);
    void uploadTextures(const Scene& source);
    void uploadLights(const Scene& source);
    void updateBounds();
    void bindMaterialTextures(std::uint32_t material) const;

    std::vector<gpu::Instance> instances_;
    std::vector<Aabb> instanceObjectBounds_;
    std::vector<gpu::Material> materials_;
    std::vector<gpu::Light> lights_;
    struct MaterialTextures {
        int slots[6];  // base, metallic-roughness, normal, emissive, specular, specular colour; -1: white
    };
    std::vector<MaterialTextures> materialTextures_;
    std::vector<gl::Texture> textures_;
    std::vector<gl::Sampler> samplers_;  // per texture
    gl::Texture white_;
    gl::Texture surfaceArray_;
    gl::Sampler surfaceSampler_;
    gl::Buffer vertexBuffer_, indexBuffer_, instanceBuffer_, instanceIndexBuffer_, materialBuffer_,
        lightBuffer_;
    gl::VertexArray vertexArray_;
    std::vector<std::uint32_t> drawOrder_;  // instances sorted by material
    Aabb bounds_;
    std::uint32_t triangleCount_ = 0;
    bool hasVertexColors_ = false;
};

}  // namespace conelight::scene
