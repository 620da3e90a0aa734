// SPDX-License-Identifier: MIT
// Meshes in buffers of a host's: the tables of the scene hold what they hold of the same mesh in arrays.
#include "scene/host_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "conelight/error.h"
#include "gl/inputs.h"
#include "math/octahedral.h"
#include "scene/gpu_scene.h"
#include "scene/scene_checks.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

template <class T>
GLuint bufferOf(const std::vector<T>& values) {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
                         GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}

// A vertex as a host may have it: 36 bytes, words that are no attribute first.
struct HostVertex {
    std::uint32_t unused;
    glm::vec3 position;
    std::uint32_t normal[2];  // halves
    std::uint32_t uv;         // halves
    std::int8_t tangent[4];
    std::uint32_t color;
};
static_assert(sizeof(HostVertex) == 36);

struct HostMeshTest : public GlTest {
    std::vector<GLuint> made;

    void TearDown() override {
        glDeleteBuffers(static_cast<GLsizei>(made.size()), made.data());
        GlTest::TearDown();
    }
    template <class T>
    GLuint own(const std::vector<T>& values) {
        made.push_back(bufferOf(values));
        return made.back();
    }
    // A sphere with all attributes, whose numbers all formats hold.
    static Mesh coloredSphere() {
        Mesh mesh = sphereMesh(7, 5);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const auto k = static_cast<float>(i);
            mesh.uvs.emplace_back(0.25f * k, 1 - 0.5f * k);
            mesh.tangents.emplace_back(i % 2 == 0 ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0),
                                       i % 3 == 0 ? -1 : 1);
            mesh.colors.emplace_back(static_cast<float>(i % 256) / 255, 1, 0, 51.0f / 255);
        }
        return mesh;
    }
    HostMesh inOneBuffer(const Mesh& mesh) {
        std::vector<HostVertex> vertices;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 n = mesh.normals[i];
            const glm::vec4 t = mesh.tangents[i], c = mesh.colors[i];
            HostVertex v{};
            v.position = mesh.positions[i];
            v.normal[0] = glm::packHalf2x16({n.x, n.y});
            v.normal[1] = glm::packHalf2x16({n.z, 0});
            v.uv = glm::packHalf2x16(mesh.uvs[i]);
            for (int k = 0; k < 4; ++k) v.tangent[k] = static_cast<std::int8_t>(std::lround(127 * t[k]));
            v.color = glm::packUnorm4x8(c);
            vertices.push_back(v);
        }
        HostMesh host;
        const GLuint buffer = own(vertices);
        host.name = "sphere";
        host.vertexCount = static_cast<std::uint32_t>(vertices.size());
        host.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
        host.positions = {buffer, offsetof(HostVertex, position), sizeof(HostVertex)};
        host.normals = {buffer, offsetof(HostVertex, normal), sizeof(HostVertex), HostEncoding::Float16};
        host.uvs = {buffer, offsetof(HostVertex, uv), sizeof(HostVertex), HostEncoding::Float16};
        host.tangents = {buffer, offsetof(HostVertex, tangent), sizeof(HostVertex), HostEncoding::Snorm8};
        host.colors = {buffer, offsetof(HostVertex, color), sizeof(HostVertex), HostEncoding::Unorm8};
        host.bounds = mesh.bounds();
        std::vector<std::uint16_t> indices(3, 0xffff);
        for (const std::uint32_t index : mesh.indices) indices.push_back(static_cast<std::uint16_t>(index));
        indices.resize((indices.size() + 1) / 2 * 2);
        host.indices = own(indices);
        host.indexOffset = 6;
        host.shortIndices = true;
        return host;
    }
    template <class T>
    static std::vector<T> tableOf(const scene::GpuScene& scene, std::string_view name, std::size_t count) {
        gl::Inputs inputs;
        scene.declare(inputs);
        std::vector<T> values(count);
        for (const gl::Inputs::Item& item : inputs.items())
            if (item.name.text() == name) {
                glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
                glGetNamedBufferSubData(item.object, 0, static_cast<GLsizeiptr>(count * sizeof(T)),
                                        values.data());
            }
        return values;
    }
    // Corner by corner, as triangles are drawn.
    static std::vector<gpu::Vertex> cornersOf(const scene::GpuScene& scene) {
        const std::size_t count = scene.indexCount(0);
        const auto indices = tableOf<std::uint32_t>(scene, "IndexTable", count);
        const auto vertices = tableOf<gpu::Vertex>(scene, "VertexTable", scene.vertexCount(0));
        std::vector<gpu::Vertex> corners;
        for (const std::uint32_t index : indices) corners.push_back(vertices.at(index));
        return corners;
    }
    static std::string failureOf(const std::function<void()>& call) {
        try {
            call();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            return error.what();
        }
        return {};
    }
};

glm::vec3 normalOf(const gpu::Vertex& v) { return math::octDecode(math::unpackSnorm2x16(v.normalOct)); }

// What a host's vertex says of the mesh's.
void expectVertex(const gpu::Vertex& vertex, const Mesh& mesh, std::size_t source) {
    EXPECT_EQ(vertex.position, mesh.positions[source]);
    EXPECT_LT(glm::distance(normalOf(vertex), mesh.normals[source]), 2e-3f);
    EXPECT_EQ(glm::vec2(vertex.u, vertex.v), mesh.uvs[source]);
    const glm::vec3 tangent = math::octDecode(math::unpackSnorm2x16(vertex.tangentOct & ~1u));
    EXPECT_LT(glm::distance(tangent, glm::vec3(mesh.tangents[source])), 1e-3f);
    EXPECT_EQ((vertex.tangentOct & 1u) != 0, mesh.tangents[source].w < 0);
    EXPECT_EQ(vertex.color, glm::packUnorm4x8(mesh.colors[source]));
}

TEST_F(HostMeshTest, AttributesAreReadInTheirFormats) {
    const Mesh mesh = coloredSphere();
    scene::GpuScene scene{Scene{}};
    EXPECT_EQ(scene.addMesh(device(), inOneBuffer(mesh)), 0u);
    const std::vector<gpu::Vertex> corners = cornersOf(scene);
    ASSERT_EQ(corners.size(), mesh.indices.size());
    for (std::size_t i = 0; i < corners.size(); ++i) expectVertex(corners[i], mesh, mesh.indices[i]);
    EXPECT_TRUE(scene.hasVertexColors());
}

// Without normals a triangle has vertices of its own, as in arrays; without indices vertices follow each other.
TEST_F(HostMeshTest, WithoutNormalsTrianglesAreFlat) {
    const Mesh mesh = boxMesh();
    HostMesh host;
    std::vector<glm::vec3> corners;
    for (const std::uint32_t index : mesh.indices) corners.push_back(mesh.positions[index]);
    host.vertexCount = host.indexCount = static_cast<std::uint32_t>(corners.size());
    host.positions = {own(corners), 0, sizeof(glm::vec3)};
    host.bounds = mesh.bounds();
    scene::GpuScene scene{Scene{}};
    scene.addMesh(device(), host);
    const std::vector<gpu::Vertex> found = cornersOf(scene);
    ASSERT_EQ(found.size(), corners.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const glm::vec3* t = &corners[i - i % 3];
        EXPECT_EQ(found[i].position, corners[i]);
        EXPECT_LT(glm::distance(normalOf(found[i]), glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]))),
                  1e-4f);
        EXPECT_EQ(found[i].color, 0xffffffffu);
    }
}

// Whatever the buffers hold, positions are within the bounds and indices name vertices.
TEST_F(HostMeshTest, WhatIsOutOfBoundsIsMovedIn) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    HostMesh host;
    host.vertexCount = 3;
    host.indexCount = 3;
    host.positions = {own(std::vector<glm::vec3>{{nan, 0, 0}, {0, inf, 0}, {0.5f, -7, 9}}), 0, 12};
    host.normals = {own(std::vector<glm::vec3>{{nan, 0, 0}, {0, 0, 0}, {0, 0, 3}}), 0, 12};
    host.indices = own(std::vector<std::uint32_t>{0, 1, 4000000000u});
    host.bounds = {glm::vec3(-1), glm::vec3(2)};
    scene::GpuScene scene{Scene{}};
    scene.addMesh(device(), host);
    const std::vector<gpu::Vertex> found = cornersOf(scene);
    EXPECT_EQ(found.at(0).position, glm::vec3(-1));
    EXPECT_EQ(found.at(1).position, glm::vec3(-1));
    EXPECT_EQ(found.at(2).position, glm::vec3(0.5f, -1, 2));
    EXPECT_LT(glm::distance(normalOf(found[0]), {0, 1, 0}), 1e-4f);
    EXPECT_LT(glm::distance(normalOf(found[2]), {0, 0, 1}), 1e-4f);
}

TEST_F(HostMeshTest, WhatIsOfNoUseIsSaid) {
    const HostMesh good = inOneBuffer(coloredSphere());
    EXPECT_EQ(failureOf([&] { scene::requireUsable(good); }), "");
    const std::pair<const char*, std::function<void(HostMesh&)>> cases[] = {
        {"three indices a triangle", [](HostMesh& m) { ++m.indexCount; }},
        {"some, three indices", [](HostMesh& m) { m.vertexCount = 0; }},
        {"no bounds", [](HostMesh& m) { m.bounds = {}; }},
        {"no buffer of positions", [](HostMesh& m) { m.positions.buffer = 0; }},
        {"positions: offset 6", [](HostMesh& m) { m.positions.offset = 6; }},
        {"uvs: offset 24, stride 0", [](HostMesh& m) { m.uvs.stride = 0; }},
        {"normals: buffer", [](HostMesh& m) { m.normals.buffer += 1000; }},
        {"positions: buffer", [](HostMesh& m) { ++m.vertexCount; }},
        {"indices: buffer", [](HostMesh& m) { m.indexCount += 6; }},
        {"indices from byte 3", [](HostMesh& m) { m.indexOffset = 3; }},
    };
    for (const auto& [text, change] : cases) {
        HostMesh bad = good;
        change(bad);
        const std::string failure = failureOf([&] { scene::requireUsable(bad); });
        EXPECT_NE(failure.find(text), std::string::npos) << text << ": " << failure;
        EXPECT_EQ(failure.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace conelight::test
