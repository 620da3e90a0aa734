// SPDX-License-Identifier: MIT
// Materials -> materials of shared/scene.h, and the textures of a scene on the GPU: one each for drawing, and
// all at low resolution in one array that compute shaders can index.
#pragma once

#include <array>
#include <vector>

#include "conelight/scene.h"
#include "gl/inputs.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/host_texture.h"
#include "shared/scene.h"

namespace conelight::scene {

// `textures`: of the scene; what the textures of coat and sheen hold in the mean counts for one colour of the surface.
gpu::Material packedMaterial(const Material& material, const std::vector<Texture>& textures);
// Whether a surface of it may be a dielectric with a lobe that is told from diffuse light.
bool isGlossyDielectric(const gpu::Material& material);

// Textures of a material: base, metallic-roughness, normal, emissive, specular, specular colour, coat, its roughness and
// normal, the sheen's colour and roughness; -1: white.
constexpr std::size_t kMaterialTextureCount = 11;
struct MaterialTextures {
    std::array<int, kMaterialTextureCount> slots;
    bool has(std::size_t texture) const {
        for (const int slot : slots)
            if (slot == static_cast<int>(texture)) return true;
        return false;
    }
};
MaterialTextures texturesOf(const Material& material);
// Texture units of a program for them; -1: it does not read that one.
using MaterialUnits = std::array<int, kMaterialTextureCount>;

class SceneTextures {
  public:
    SceneTextures() = default;
    // `normals`: of each, whether it is a normal map, which is drawn with unit normals (scene/normal_map.h).
    SceneTextures(const std::vector<Texture>& sources, const std::vector<bool>& normals);
    void add(const Texture& source);  // behind the others
    void set(std::size_t index, const Texture& source, bool normals);
    // The same texels for another use. Those of the host are left as they are.
    void setUse(std::size_t index, const Texture& source, bool normals);
    bool hasUnitNormals(std::size_t index) const { return drawn_[index].normals; }
    // Of the host's: they are drawn with where they lie.
    void add(const gl::Device& device, const HostTexture& source);
    void set(const gl::Device& device, std::size_t index, const HostTexture& source);

    void declare(gl::Inputs& inputs) const;  // surfaceArray
    // For draw calls that bind a material's textures: names, a program's units for them, the binding.
    static void declarePerDraw(gl::Inputs& inputs);
    static MaterialUnits unitsOf(const gl::Program& program);
    void bind(const MaterialTextures& textures, const MaterialUnits& units) const;

  private:
    int addLayer();
    void putForDrawing(std::size_t index, const Texture& source, bool normals);
    void uploadSurface(const Texture& source, int layer);

    // Of one, for drawing: a texture of ours, or the name of the host's.
    struct DrawTexture {
        gl::Texture own;
        gl::Name foreign = 0;
        gl::Sampler sampler;
        bool normals = false;  // of unit length
    };
    std::vector<DrawTexture> drawn_;
    gl::Texture white_;
    gl::Texture surfaceArray_;
    gl::Sampler surfaceSampler_;
    HostTextureImport hostTextures_;
};

}  // namespace conelight::scene
