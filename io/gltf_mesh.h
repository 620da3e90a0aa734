// SPDX-License-Identifier: MIT
// Meshes of a glTF file: one Mesh per different primitive, morph targets and skins applied. Private to this
// room.
#pragma once

#include <map>
#include <vector>

#include "conelight/scene.h"
#include "io/animation.h"
#include "io/gltf_file.h"
#include "io/gltf_material.h"

namespace conelight::io {

// A primitive ready to be placed.
struct GltfPart {
    int mesh = -1;
    int material = -1;
};

// The joints of a mesh, with their places at rest.
struct GltfSkin {
    std::vector<std::size_t> joints;  // nodes
    std::vector<glm::mat4> jointFromBind, worldFromBind;
};

GltfSkin readSkin(GltfFile& file, const GltfValue& skin, const std::vector<glm::mat4>& worldFromNode);

// Moves each vertex by the blend of its joints; one without weights stays.
void skinVertices(const DeformedMesh& deformed, const std::vector<glm::mat4>& worldFromBind, Mesh& mesh);

class GltfMeshes {
  public:
    GltfMeshes(GltfFile& file, Scene& scene, GltfMaterials& materials)
        : file_(file), scene_(scene), materials_(materials) {}

    // Parts of mesh `index` with the given morph weights (empty: the mesh's own). With a skin the vertices are
    // moved to the world; such parts are not shared. With `moving`, neither are those, and what they move by is
    // appended to it.
    std::vector<GltfPart> parts(std::size_t index, const std::vector<float>& weights, const GltfSkin* skin,
                                std::vector<DeformedMesh>* moving);
    // Appends what was left out to scene.notes.
    void addNotes();

  private:
    Mesh read(const GltfValue& primitive, const std::vector<float>& weights, const GltfSkin* skin,
              int material);
    Mesh readMoving(const GltfValue& primitive, const GltfSkin* skin, int material, DeformedMesh& moving);
    Mesh readAttributes(const GltfValue& primitive, int material);
    std::vector<glm::vec3> readDeltas(const GltfValue& accessor, std::size_t count);
    std::vector<std::uint32_t> readIndices(const GltfValue& primitive, std::size_t vertexCount);
    void morph(const GltfValue& primitive, const std::vector<float>& weights, Mesh& mesh);
    // Joints of each vertex: DeformedMesh::influences, jointNumbers, jointWeights.
    void readInfluences(const GltfValue& attributes, std::size_t jointCount, std::size_t vertices,
                        DeformedMesh& to);

    GltfFile& file_;
    Scene& scene_;
    GltfMaterials& materials_;
    std::map<std::string, int> known_;  // by primitive, weights and material needs
    std::size_t pointPrimitives_ = 0;
    std::size_t badNormals_ = 0;
};

}  // namespace conelight::io
