// SPDX-License-Identifier: MIT
// Materials and textures of a glTF file. Private to this room.
#pragma once

#include <map>
#include <vector>

#include "conelight/scene.h"
#include "io/gltf_file.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "io/texture_budget.h"

namespace conelight::io {

class GltfMaterials {
  public:
    // Converts all materials of the file into scene.materials (same order). Pictures that cannot be read
    // become notes; together they have LoadOptions::maxTexels at most. `options` stay where they are meanwhile.
    GltfMaterials(GltfFile& file, Scene& scene, const LoadOptions& options);

    // Index into scene.materials of a primitive's material; the glTF default when it names none.
    int indexOf(const GltfValue& primitive);
    // Which TEXCOORD set the material's textures use.
    std::size_t uvSetOf(int material) const { return uvSets_[std::size_t(material)]; }

  private:
    Material convert(const GltfValue& from);
    void convertSpecularGlossiness(const GltfValue& from, Material& to);
    void convertGlass(const GltfValue& from, Material& to);
    void convertLayers(const GltfValue& from, Material& to);
    TextureRef texture(const GltfValue& info, bool srgb);
    int textureIndex(const GltfValue& texture, bool srgb);
    const ByteImage* image(std::size_t index);

    GltfFile& file_;
    Scene& scene_;
    const LoadOptions& options_;
    TextureBudget budget_;
    std::map<std::size_t, std::optional<ByteImage>> images_;  // decoded; nothing: cannot be read
    std::map<std::vector<std::size_t>, int> textures_;
    std::vector<std::size_t> uvSets_;
    std::size_t uvSet_ = 0;  // of the material being converted
    bool uvSetKnown_ = false;
    bool uvSetMixed_ = false;
    int defaultMaterial_ = -1;
};

}  // namespace conelight::io
