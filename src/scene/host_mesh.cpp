// SPDX-License-Identifier: MIT
#include "scene/host_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/log.h"
#include "gl/pass.h"
#include "math/octahedral.h"
#include "shared/host_mesh.h"

namespace conelight::scene {
namespace {

struct HostMeshKey {
    bool flat;
    gl::ProgramDesc desc() const { return {{"scene/host_mesh.comp.glsl"}, {{"FLAT", flat ? "1" : "0"}}}; }
    static std::vector<HostMeshKey> all() { return {{false}, {true}}; }
};

std::uint32_t bytesOf(HostEncoding encoding) {
    if (encoding == HostEncoding::Float32) return 4;
    return encoding == HostEncoding::Float16 || encoding == HostEncoding::Snorm16 ? 2 : 1;
}

[[noreturn]] void refuse(const HostMesh& mesh, const std::string& why) {
    base::fail(ErrorKind::BadInput, "mesh '%s' of the host: %s", mesh.name.c_str(), why.c_str());
}

void requireBuffer(const HostMesh& mesh, const char* what, std::uint32_t buffer, std::uint64_t bytes) {
    const std::uint64_t has = gl::bytesOfForeignBuffer(buffer);
    if (has >= bytes && has > 0) return;
    refuse(mesh,
           base::format("%s: buffer %u has %llu bytes; one of %llu at least would be right", what, buffer,
                        static_cast<unsigned long long>(has), static_cast<unsigned long long>(bytes)));
}

void requireAttribute(const HostMesh& mesh, const char* what, const HostAttribute& a,
                      std::uint32_t components) {
    if (a.buffer == 0) return;
    if (a.encoding > HostEncoding::Unorm8)
        refuse(mesh,
               base::format("%s: encoding %d; 0 to 4 would be right", what, static_cast<int>(a.encoding)));
    const std::uint32_t bytes = components * bytesOf(a.encoding);
    if (a.offset % 4 != 0 || a.stride % 4 != 0 || a.stride < bytes)
        refuse(mesh, base::format("%s: offset %u, stride %u; multiples of 4, and %u bytes a vertex at least, "
                                  "would be right",
                                  what, a.offset, a.stride, bytes));
    // Words are read whole.
    const std::uint64_t last = std::max(mesh.vertexCount, 1u) - 1;
    requireBuffer(mesh, what, a.buffer, a.offset + a.stride * last + (bytes + 3) / 4 * 4);
}

glm::uvec4 packedAttribute(const HostAttribute& attribute) {
    return {attribute.offset / 4, attribute.stride / 4, static_cast<std::uint32_t>(attribute.encoding),
            attribute.buffer != 0 ? 1u : 0u};
}

std::uint32_t bytesOfIndex(const HostMesh& mesh) { return mesh.shortIndices ? 2 : 4; }

gpu::HostMeshConstants packedConstants(const HostMesh& mesh) {
    gpu::HostMeshConstants c{};
    c.low = mesh.bounds.min;
    c.high = mesh.bounds.max;
    c.vertexCount = mesh.vertexCount;
    c.indexCount = mesh.indexCount;
    c.indexOffset = mesh.indexOffset / bytesOfIndex(mesh);
    c.indexKind = mesh.indices == 0   ? HOST_INDICES_NONE
                  : mesh.shortIndices ? HOST_INDICES_SHORT
                                      : HOST_INDICES_LONG;
    c.positions = packedAttribute(mesh.positions);
    c.normals = packedAttribute(mesh.normals);
    c.uvs = packedAttribute(mesh.uvs);
    c.tangents = packedAttribute(mesh.tangents);
    c.colors = packedAttribute(mesh.colors);
    c.noTangent = math::packSnorm2x16(math::octEncode({1, 0, 0})) & ~(VERTEX_SOLID_BITS | 1u);
    return c;
}

}  // namespace

void requireUsable(const HostMesh& mesh) {
    if (mesh.indexCount % 3 != 0 || mesh.vertexCount == 0)
        refuse(mesh,
               base::format("%u vertices and %u indices; some, three indices a triangle, would be right",
                            mesh.vertexCount, mesh.indexCount));
    for (int axis = 0; axis < 3; ++axis) {
        const float low = mesh.bounds.min[axis], high = mesh.bounds.max[axis];
        if (!(std::isfinite(low) && std::isfinite(high) && low <= high))
            refuse(mesh, "no bounds; a finite box that holds all positions would be right");
    }
    if (mesh.positions.buffer == 0) refuse(mesh, "no buffer of positions; the name of one would be right");
    requireAttribute(mesh, "positions", mesh.positions, 3);
    requireAttribute(mesh, "normals", mesh.normals, 3);
    requireAttribute(mesh, "uvs", mesh.uvs, 2);
    requireAttribute(mesh, "tangents", mesh.tangents, 4);
    requireAttribute(mesh, "colors", mesh.colors, 4);
    const std::uint32_t bytes = bytesOfIndex(mesh);
    if (mesh.indexOffset % bytes != 0)
        refuse(mesh, base::format("indices from byte %u on; a multiple of %u would be right",
                                  mesh.indexOffset, bytes));
    const std::uint64_t end = mesh.indexOffset + std::uint64_t{bytes} * mesh.indexCount;
    if (mesh.indices != 0) requireBuffer(mesh, "indices", mesh.indices, (end + 3) / 4 * 4);
}

std::uint32_t packedVertices(const HostMesh& mesh) {
    return mesh.normals.buffer != 0 ? mesh.vertexCount : mesh.indexCount;
}

void HostMeshImport::convert(const gl::Device& device, const HostMesh& mesh, const Target& target) {
    if (mesh.indexCount == 0) return;
    const gl::PassScope pass(device.profiler, "host mesh");
    gpu::HostMeshConstants constants = packedConstants(mesh);
    constants.firstVertex = target.firstVertex;
    constants.firstIndex = target.firstIndex;
    if (!constants_) constants_ = gl::Buffer(sizeof constants, "host mesh");
    constants_.update(constants);
    // What the mesh does not have is bound, and not read.
    const auto orPositions = [&](gl::Name buffer) { return buffer != 0 ? buffer : mesh.positions.buffer; };
    gl::Inputs inputs;
    inputs.uniform("HostMeshBlock", constants_)
        .storage("VertexTable", target.vertices)
        .storage("IndexTable", target.indices)
        .foreignStorage("HostPositions", mesh.positions.buffer)
        .foreignStorage("HostNormals", orPositions(mesh.normals.buffer))
        .foreignStorage("HostUvs", orPositions(mesh.uvs.buffer))
        .foreignStorage("HostTangents", orPositions(mesh.tangents.buffer))
        .foreignStorage("HostColors", orPositions(mesh.colors.buffer))
        .foreignStorage("HostIndices", orPositions(mesh.indices));
    const bool flat = mesh.normals.buffer == 0;
    gl::barrier(gl::Access::ShaderStorage);  // what the host's shaders wrote
    device.get(HostMeshKey{flat}.desc())
        .dispatchLinear(inputs, flat ? mesh.indexCount / 3 : std::max(mesh.vertexCount, mesh.indexCount));
    gl::barrier(gl::Access::ShaderStorage | gl::Access::VertexFetch | gl::Access::Update);
}

std::vector<gl::ProgramDesc> HostMeshImport::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const HostMeshKey& key : HostMeshKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::scene
