// SPDX-License-Identifier: MIT
// Meshes of a glTF file: one Mesh per different primitive, morph targets and skins applied. Private to this
// room.
#pragma once

#include <map>
#include <vector>

#include "conelight/scene.h"
#include "io/gltf_file.h"
#include "io/gltf_material.h"

namespace conelight::io {

// A primitive ready to be placed.
struct GltfPart {
    int mesh = -1;
    int material = -1;
};

class GltfMeshes {
  public:
    GltfMeshes(GltfFile& file, Scene& scene, GltfMaterials& materials)
        : file_(file), scene_(scene), materials_(materials) {}

    // Parts of mesh `index` with the given morph weights (empty: the mesh's own). With joint matrices
    // (worldFromBind per joint) the vertices are moved to the world; such parts are not shared.
    std::vector<GltfPart> parts(std::size_t index, const std::vector<float>& weights,
                                const std::vector<glm::mat4>* worldFromBind);
    // Appends what was left out to scene.notes.
    void addNotes();

  private:
    Mesh read(const GltfValue& primitive, const std::vector<float>& weights,
              const std::vector<glm::mat4>* worldFromBind, int material);
    std::vector<std::uint32_t> readIndices(const GltfValue& primitive, std::size_t vertexCount);
    void morph(const GltfValue& primitive, const std::vector<float>& weights, Mesh& mesh);
    void skin(const GltfValue& attributes, const std::vector<glm::mat4>& worldFromBind, Mesh& mesh);

    GltfFile& file_;
    Scene& scene_;
    GltfMaterials& materials_;
    std::map<std::string, int> known_;  // by primitive, weights and material needs
    std::size_t pointPrimitives_ = 0;
    std::size_t badNormals_ = 0;
};

}  // namespace conelight::io
