// SPDX-License-Identifier: MIT
// Counters that grow when a part of the session changes. Whoever follows the session (renderer, panels, the
// reference in the background) keeps a copy and compares: no callbacks, no order among followers.
#pragma once

#include <cstdint>

namespace conelight::program {

struct Revisions {
    std::uint64_t scene = 0;         // another scene: meshes, textures, everything below
    std::uint64_t transforms = 0;    // an instance's matrix
    std::uint64_t instances = 0;     // an instance's visibility, flags, name or material index
    std::uint64_t instanceList = 0;  // instances came or went; instances grows, too
    std::uint64_t meshes = 0;        // vertices of a mesh moved
    std::uint64_t materials = 0;
    std::uint64_t lights = 0;
    std::uint64_t sky = 0;
    std::uint64_t cameras = 0;  // the scene's list, not the one that is looked through
    std::uint64_t settings = 0;
    std::uint64_t camera = 0;
    std::uint64_t flags = 0;
    std::uint64_t selection = 0;
    std::uint64_t voxels = 0;  // somebody asked for them to be built anew

    bool operator==(const Revisions&) const = default;
    // What the picture's scene tables depend on: when it differs, a renderer's are out of date (SceneUpload).
    std::uint64_t sceneTables() const {
        return scene + transforms + instances + meshes + materials + lights + sky + voxels;
    }
    // What rays against triangles depend on. Materials too: their alpha and two-sidedness.
    std::uint64_t rayTables() const { return scene + transforms + instances + meshes + materials; }
};

}  // namespace conelight::program
