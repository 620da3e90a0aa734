// SPDX-License-Identifier: MIT
// Keeps a renderer's scene like a session's: uploads what changed since the last call and nothing else, so
// that a renderer makes anew only what depends on it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "conelight/renderer.h"
#include "session/session.h"

namespace conelight::program {

class SceneUpload {
  public:
    // What a session's scene is at.
    struct SceneRevisions {
        Revisions all;
        std::vector<std::uint64_t> instances, materials, meshes, textures;
    };
    static SceneRevisions revisionsOf(const Session& session);
    // Whether the renderer has to take all of the scene, not only what changed.
    bool needsWhole(const Renderer& renderer, const Session& session) const;
    // All of it, maybe of a copy on another thread. Throws as follow().
    void take(Renderer& renderer, const Scene& scene, SceneRevisions revisions);
    // Afterwards `renderer` holds the session's scene. Throws what the renderer throws; it then holds what it
    // could take, and the change that it refused is not tried again before the next one.
    void follow(Renderer& renderer, const Session& session);
    void forget() { seen_.reset(); }  // the renderer was given another scene, or is another one
    bool current(const Session& session) const;

  private:
    bool onlyAdds(const Renderer& renderer, const Session& session) const;
    void takeInstances(Renderer& renderer, const Session& session);
    void takeMaterials(Renderer& renderer, const Session& session);
    void takeMeshes(Renderer& renderer, const Session& session);

    std::optional<Revisions> seen_;
    std::vector<std::uint64_t> instances_, materials_, meshes_, textures_;
};

}  // namespace conelight::program
