// SPDX-License-Identifier: MIT
// The scene on the GPU: Scene (CPU tables) -> buffers of shared/scene.h, textures per material, and all
// textures once more at low resolution in one array that compute shaders can index (voxelizers).
// Materials are the scene's own plus a default one at the end.
//
// Changes in place (setInstance, setMaterial, setLights) upload just the entries they concern and raise
// revisions. Who derives something from instances keeps the revisions it has seen and compares: no lists of
// changes have to be handed on, and none can be missed.
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
    // (layered rendering). `part`: asked for each part of a mesh, a few hundred triangles, by its box in
    // object space; parts that it turns down are not drawn (empty: all are). GL state changed: vertex array,
    // cull, front face, texture units 0-5.
    using InstanceFilter = std::function<bool(const gpu::Instance&)>;
    using PartFilter = std::function<bool(const gpu::Instance&, const Aabb& objectBox)>;
    void draw(const InstanceFilter& filter, gl::Cull cull, bool bindTextures, int copies = 1,
              const PartFilter& part = {}) const;

    // One entry each; geometry, index ranges and textures stay. setInstance keeps the mesh it has.
    // `material`: as the Scene counts them. Nothing is checked (scene/scene_checks.h).
    void setInstance(std::size_t index, const Instance& instance);
    void setMaterial(std::size_t index, const Material& material);
    void setLights(const std::vector<Light>& lights);  // all of them; lights of emitters are gone
    // After a picture: what has moved since the one before counts as standing there (prevWorldFromObject).
    void endFrame();

    // Differs between scenes of one process, so that equal revisions of two scenes are not taken for one.
    std::uint64_t identity() const { return identity_; }
    // Raised by each change that voxels or shadows may show: of an instance (transform, flags, material, what
    // its material says), of any instance, of lights.
    std::uint64_t instanceRevision(std::size_t instance) const { return instanceRevisions_[instance]; }
    std::uint64_t geometryRevision() const { return geometryRevision_; }
    std::uint64_t lightRevision() const { return lightRevision_; }

    const Aabb& bounds() const;                               // of visible instances as they are now
    const Aabb& firstBounds() const { return firstBounds_; }  // as they were handed over: grids fit to these
    const Aabb& instanceBounds(
        std::size_t instance) const  // world box of the object box: may be larger than needed
    {
        return instanceBounds_[instance];
    }
    std::uint32_t triangleCount() const { return triangleCount_; }  // over all instances, visible or not
    const std::vector<gpu::Instance>& instances() const { return instances_; }
    const std::vector<gpu::Material>& materials() const { return materials_; }
    const std::vector<gpu::Light>& lights() const { return lights_; }
    bool hasVertexColors() const { return hasVertexColors_; }  // of any mesh
    // Light stage: adds lights of emitters, writes shadow maps into the table. Sorted by type.
    void updateLights(const std::vector<gpu::Light>& lights);
    // Light stage: sets or takes away INSTANCE_LIT_EXACTLY.
    void setLitExactly(std::size_t instance, bool lit);

    const gl::Buffer& instanceBuffer() const { return instanceBuffer_; }

  private:
    void uploadGeometry(const Scene& source);
    void uploadMaterials(const Scene& source);
    void uploadTextures(const Scene& source);
    void place(std::size_t instance, const glm::mat4& worldFromObject);
    void setFlags(std::size_t instance, const Instance& source);
    void uploadInstance(std::size_t instance);
    void sortDraws();
    void drawParts(std::uint32_t instance, const PartFilter& part, int copies) const;
    void bindMaterialTextures(std::uint32_t material) const;

    std::vector<gpu::Instance> instances_;
    std::vector<Aabb> instanceObjectBounds_, instanceBounds_;
    std::vector<Aabb> partBounds_;            // object boxes of the parts of all meshes
    std::vector<std::size_t> instanceParts_;  // the first of an instance's mesh
    std::vector<std::uint64_t> instanceRevisions_;
    std::vector<std::uint32_t> moved_;  // since the last endFrame()
    std::uint64_t identity_ = 0, geometryRevision_ = 0, lightRevision_ = 0;
    std::vector<gpu::Material> materials_;
    std::vector<gpu::Light> lights_;
    struct MaterialTextures {
        int slots[6];  // base, metallic-roughness, normal, emissive, specular, specular colour; -1: white
    };
    static MaterialTextures texturesOf(const Material& material);
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
    mutable Aabb bounds_;
    mutable bool boundsCurrent_ = false;
    Aabb firstBounds_;
    std::uint32_t triangleCount_ = 0;
    bool hasVertexColors_ = false;
};

}  // namespace conelight::scene
