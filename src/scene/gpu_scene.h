// SPDX-License-Identifier: MIT
// The scene as a value: the tables of Scene and their copies on the GPU, which are the buffers of
// shared/scene.h, textures per material, and all textures at low resolution in one array that compute shaders
// can index (voxelizers). Materials are the scene's own plus a default one at the end.
//
// Changes in place (setInstance, setMesh, setMaterial, setLights, setSky, setEnvironment, setBakedLight) upload just the entries they concern and
// raise revisions. Who derives something from the scene keeps the revisions it was derived from and compares.
// Lights have no table here: the light stage makes one (light/lights.h).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/revision.h"
#include "conelight/scene.h"
#include "gl/buffer.h"
#include "gl/draw.h"
#include "gl/program.h"
#include "scene/gpu_materials.h"
#include "scene/host_mesh.h"
#include "shared/scene.h"

namespace conelight::scene {

// Whether an instance is drawn as glass (scene/glass_tree.h).
inline bool isGlass(const gpu::Instance& instance) {
    return (instance.flags & INSTANCE_GLASS) != 0 && (instance.flags & INSTANCE_VISIBLE) != 0;
}

// Whether it hides a part of the light of lamps, by its triangles, where glass_tree.h has them.
inline bool isVeil(const gpu::Instance& instance) { return (instance.flags & INSTANCE_VEIL) != 0; }

class GpuScene {
  public:
    // Copies and uploads everything. Throws Error(BadInput) by Scene::validate.
    explicit GpuScene(const Scene& source);

    // What shaders may read: VertexTable, IndexTable, InstanceTable, MaterialTable, surfaceArray; verticesBefore where
    // any are kept.
    void declare(gl::Inputs& inputs) const;
    // The textures that draw() binds for programs that read them: baseTexture, metalRoughTexture and the
    // others of view/gbuffer.frag.glsl.
    static void declareMaterialTextures(gl::Inputs& inputs);
    const Scene& source() const { return source_; }  // with all changes

    // What of the scene a draw() takes, and how.
    using InstanceFilter = std::function<bool(const gpu::Instance&)>;
    using PartFilter = std::function<bool(const gpu::Instance&, const Aabb& objectBox)>;
    struct Draw {
        InstanceFilter filter;           // empty: every visible instance
        gl::Cull cull = gl::Cull::None;  // of single-sided materials; double-sided ones are never culled
        const gl::Program* textured = nullptr;  // not null: its material textures are bound
        int copies = 1;                         // instances per draw call, gl_InstanceID = 0..copies-1
        // Asked for each part of a mesh, a few hundred triangles, by its box in object space; parts that it
        // turns down are not drawn (empty: all are).
        PartFilter part;
        // Of the instances in the order in which they are drawn: the first one, and how many.
        std::size_t first = 0, count = ~std::size_t{0};
        // One call for all that follow each other without a change of textures, culling or facing, as GPUs want it.
        bool together = false;
    };
    // Draws with the current program, framebuffer and state. Attributes: 0 position, 1 normalOct, 2 uv,
    // 3 tangentOct, 4 color (shared/scene.h), 5 the index into the instance table. Flipped instances reverse
    // the front face. GL state changed: vertex array, cull, front face, texture units of `textured`.
    void draw(const Draw& draw) const;
    std::uint64_t drawCalls() const { return drawCalls_; }  // so far

    // One entry each; geometry, index ranges and textures stay. setInstance keeps the mesh it has.
    // `material`: as the Scene counts them. Nothing is checked (scene/scene_checks.h).
    void setInstance(std::size_t index, const Instance& instance);
    // As many vertices and indices as there are, normals for all or for none as there are.
    void setMesh(std::size_t index, const Mesh& mesh);
    // Of a mesh that is the host's, as many vertices and indices as there are.
    void setMesh(const gl::Device& device, std::size_t index, const HostMesh& mesh);
    void setTexture(std::size_t index, const Texture& texture);
    // Of a texture that is the host's (scene/host_texture.h): source() has one white texel in its place.
    void setTexture(const gl::Device& device, std::size_t index, const HostTexture& texture);
    void setMaterial(std::size_t index, const Material& material);
    void setLights(const std::vector<Light>& lights);  // all of them
    void setSky(const glm::vec3& radiance);
    void setEnvironment(const Environment& environment);
    void setBakedLight(std::shared_ptr<const BakedLight> baked);
    // Further entries; each returns its index. What is there keeps its own. addInstance takes the place of one that
    // was removed where it can, addMesh that of one that is no smaller. Nothing is checked.
    std::size_t addMesh(const Mesh& mesh);
    // Read by a pass on the GPU (scene/host_mesh.h): source() has an empty mesh in its place.
    std::size_t addMesh(const gl::Device& device, const HostMesh& mesh);
    std::size_t addTexture(const Texture& texture);
    std::size_t addTexture(const gl::Device& device, const HostTexture& texture);
    std::size_t addMaterial(const Material& material);
    std::size_t addInstance(const Instance& instance);
    // It stays in source(), invisible, until another takes its place.
    void removeInstance(std::size_t index);
    // Of no instance that is there. It stays in source(), empty, until another takes its place.
    void removeMesh(std::size_t index);
    bool isRemovedInstance(std::size_t index) const { return removed_[index] != 0; }
    bool isRemovedMesh(std::size_t index) const { return meshRanges_[index].removed; }
    bool isHostMesh(std::size_t index) const { return meshRanges_[index].ofHost; }
    // As GL has them: those of meshes without normals are three per triangle.
    std::uint32_t vertexCount(std::size_t mesh) const { return meshRanges_[mesh].vertexCount; }
    std::uint32_t indexCount(std::size_t mesh) const { return meshRanges_[mesh].indexCount; }
    // Where voxels are wanted; empty: where the scene is.
    void setRegion(const Aabb& region);
    // As if every instance had changed: all that is derived from geometry is made anew.
    void touch();

    // Of the scene as it was handed over: equal as long as only changes in place have come since, and what was added
    // has not moved the numbers of triangles.
    base::Revision identity() const { return identity_; }
    // Raised by each change that voxels or shadows may show: of an instance (transform, flags, material, what
    // its material says), of any instance, of the list of lights, of sky or environment.
    base::Revision instanceRevision(std::size_t instance) const { return instanceRevisions_[instance]; }
    // Raised by those of them that its shadow may show, not by what its material reflects or emits.
    base::Revision casterRevision(std::size_t instance) const { return casterRevisions_[instance]; }
    // Raised when the vertices of the instance's mesh change.
    base::Revision shapeRevision(std::size_t instance) const { return shapeRevisions_[instance]; }
    // Of the vertices that the mesh had before those, and where they lie in verticesBefore; none: they are not known.
    base::Revision shapeBefore(std::size_t instance) const { return shapesBefore_[instance]; }
    std::uint32_t firstVertexBefore(std::size_t instance) const {
        return meshRanges_[static_cast<std::size_t>(source_.instances[instance].mesh)].firstBefore.value_or(
            0);
    }
    // The farthest that one of these vertices has come since, m in the mesh's own space; infinite: not known.
    float bentBy(std::size_t instance) const {
        return meshRanges_[static_cast<std::size_t>(source_.instances[instance].mesh)].bentBy;
    }
    // Raised when another instance takes the place of this one.
    base::Revision entryRevision(std::size_t instance) const { return entryRevisions_[instance]; }
    base::Revision geometryRevision() const { return geometryRevision_; }
    base::Revision lightRevision() const { return lightRevision_; }
    base::Revision skyRevision() const { return skyRevision_; }
    base::Revision bakedRevision() const { return bakedRevision_; }  // of the baked light
    // Whether the instance is seen and stands, in its shape, where the baked light has it.
    bool isBaked(std::size_t instance) const { return (instances_[instance].flags & INSTANCE_BAKED) != 0; }

    const Aabb& bounds() const;       // of visible instances as they are now
    const Aabb& firstBounds() const;  // as they were handed over; of an empty scene: as they came first
    // What a grid of voxels is fitted to, and what it grows to hold: the region, or the instances that count for
    // voxels, as they were handed over and as they are.
    Aabb firstGridBounds() const;
    Aabb gridBounds() const;
    const Aabb& instanceBounds(
        std::size_t instance) const  // world box of the object box: may be larger than needed
    {
        return instanceBounds_[instance];
    }
    std::uint32_t triangleCount() const { return triangleCount_; }  // over all instances, visible or not
    const std::vector<gpu::Instance>& instances() const { return instances_; }
    const std::vector<gpu::Material>& materials() const { return materials_; }
    bool hasVertexColors() const { return hasVertexColors_; }  // of any mesh

    const gl::Buffer& instanceBuffer() const { return instanceBuffer_; }

  private:
    // Where a mesh lies; instances name their ranges.
    struct MeshRange {
        std::uint32_t firstVertex, firstIndex, indexCount;
        Aabb bounds;
        bool wideColors;
        std::size_t firstPart;
        std::uint32_t vertexRoom, indexRoom;
        bool removed = false;
        bool ofHost = false;
        std::uint32_t vertexCount = 0;
        std::optional<std::uint32_t> firstBefore;  // of the vertices before, once the mesh has changed
        float bentBy = 0;                          // the farthest that one has come since
    };
    void uploadMeshes();
    void uploadInstances();
    void makeVertexArray();
    std::size_t placeForMesh(std::uint32_t vertices, std::uint32_t indices);
    void convert(const gl::Device& device, std::size_t index, const HostMesh& mesh);
    void touchUsersOf(std::size_t texture);
    void updateNormalMaps();
    std::size_t placeForVerticesBefore(std::size_t index);
    void reshape(std::size_t index);
    void putInstance(std::size_t index, const Instance& instance);
    std::optional<std::size_t> freeEntry(std::uint32_t triangles) const;
    void renumberTriangles();
    Aabb boundsForGrid() const;
    void uploadMaterials();
    void place(std::size_t instance, const glm::mat4& worldFromObject);
    bool mayBeVeil(const Instance& source) const;
    void setFlags(std::size_t instance, const Instance& source);
    void uploadInstance(std::size_t instance);
    void placeBakedLight();
    void sortDraws();
    bool isDrawnBefore(std::uint32_t a, std::uint32_t b) const;
    // Draws that follow each other in one state.
    struct DrawGroup {
        std::uint32_t material;  // whose textures are bound, if any are
        bool doubleSided, flipped;
        std::size_t first, end;
        bool joins(const DrawGroup& next) const {
            return material == next.material && doubleSided == next.doubleSided && flipped == next.flipped;
        }
    };
    void collectParts(std::uint32_t instance, const Draw& draw) const;
    void collectGroups(const Draw& draw) const;

    Scene source_;
    std::vector<MeshRange> meshRanges_;
    std::vector<gpu::Instance> instances_;
    std::vector<Aabb> instanceObjectBounds_, instanceBounds_;
    std::vector<Aabb> partBounds_;            // object boxes of the parts of all meshes
    std::vector<std::size_t> instanceParts_;  // the first of an instance's mesh
    std::vector<base::Revision> instanceRevisions_, casterRevisions_, shapeRevisions_, shapesBefore_,
        entryRevisions_;
    std::vector<char> removed_;  // per instance
    std::uint32_t vertexCount_ = 0, indexCount_ = 0, beforeCount_ = 0;
    std::vector<std::optional<glm::mat4>> bakedPlaces_;  // where baked light has an instance
    base::Revision identity_ = base::Revision::next(), geometryRevision_, lightRevision_, skyRevision_,
                   bakedRevision_;
    std::vector<gpu::Material> materials_;
    std::vector<MaterialTextures> materialTextures_;
    SceneTextures textures_;
    gl::Buffer verticesBefore_;  // of meshes that have changed, as they were
    gl::Buffer vertexBuffer_, indexBuffer_, instanceBuffer_, instanceIndexBuffer_, materialBuffer_;
    gl::VertexArray vertexArray_;
    HostMeshImport hostMeshes_;
    std::vector<std::uint32_t> drawOrder_;        // instances sorted by material
    mutable std::vector<gl::IndexedDraw> draws_;  // of one draw()
    mutable std::vector<DrawGroup> drawGroups_;
    mutable gl::DrawList drawList_;
    mutable std::uint64_t drawCalls_ = 0;
    mutable Aabb bounds_;
    mutable bool boundsCurrent_ = false;
    Aabb region_;
    mutable Aabb firstBounds_, firstGridBounds_;
    std::uint32_t triangleCount_ = 0;
    bool hasVertexColors_ = false;
};

}  // namespace conelight::scene
