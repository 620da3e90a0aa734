// SPDX-License-Identifier: MIT
// A mesh in buffers of the host's (conelight/host_mesh.h) -> vertices and indices of shared/scene.h, by a pass on the
// GPU. All passes read one table of vertices, hence the copy.
#pragma once

#include <cstdint>
#include <vector>

#include "conelight/host_mesh.h"
#include "gl/buffer.h"
#include "gl/device.h"

namespace conelight::scene {

// Throws Error(BadInput) for counts, strides and bounds that are of no use, and for buffers that are none or end before
// the mesh does.
void requireUsable(const HostMesh& mesh);

// That the table of the scene holds of it.
std::uint32_t packedVertices(const HostMesh& mesh);

class HostMeshImport {
  public:
    struct Target {
        const gl::Buffer& vertices;
        const gl::Buffer& indices;
        std::uint32_t firstVertex, firstIndex;
    };
    // Visible to all later passes. Indices beyond the last vertex name that.
    void convert(const gl::Device& device, const HostMesh& mesh, const Target& target);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer constants_;
};

}  // namespace conelight::scene
