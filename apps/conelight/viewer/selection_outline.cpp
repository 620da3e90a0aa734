// SPDX-License-Identifier: MIT
#include "viewer/selection_outline.h"

#include <imgui.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "session/inspection_lines.h"

namespace conelight::program {
namespace {

constexpr std::size_t kMostTriangles = 20000;  // a few milliseconds a frame
constexpr ImU32 kColor = IM_COL32(70, 190, 255, 255);

using Line = std::array<glm::vec3, 2>;

std::vector<Line> boxLines(const Aabb& box, const glm::mat4& worldFromObject) {
    std::vector<Line> lines;
    const auto corner = [&](int i) {
        const glm::vec3 p(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                          i & 4 ? box.max.z : box.min.z);
        return glm::vec3(worldFromObject * glm::vec4(p, 1));
    };
    for (int i = 0; i < 8; ++i)
        for (const int axis : {1, 2, 4})
            if ((i & axis) == 0) lines.push_back({corner(i), corner(i | axis)});
    return lines;
}

}  // namespace

// Vertices at one place are one, whatever their normals.
void SelectionOutline::findEdges(const Mesh& mesh) {
    edges_.clear();
    std::map<std::tuple<float, float, float>, std::uint32_t> places;
    std::map<std::array<std::uint32_t, 2>, std::size_t> known;
    const auto placeOf = [&](std::uint32_t vertex) {
        const glm::vec3& p = mesh.positions[vertex];
        return places.try_emplace({p.x, p.y, p.z}, vertex).first->second;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (std::size_t side = 0; side < 3; ++side) {
            std::array<std::uint32_t, 2> ends{placeOf(mesh.indices[i + side]),
                                              placeOf(mesh.indices[i + (side + 1) % 3])};
            std::sort(ends.begin(), ends.end());
            const auto [found, isNew] = known.try_emplace(ends, edges_.size());
            if (isNew)
                edges_.push_back({ends, {static_cast<int>(i / 3), -1}});
            else
                edges_[found->second].triangles[1] = static_cast<int>(i / 3);
        }
}

std::vector<Line> SelectionOutline::lines(const Session& session) {
    const Scene& scene = session.scene();
    const Instance& instance = scene.instances[session.selection().index];
    const auto index = static_cast<std::size_t>(instance.mesh);
    const Mesh& mesh = scene.meshes[index];
    if (mesh.indices.size() / 3 > kMostTriangles) return boxLines(mesh.bounds(), instance.worldFromObject);
    if (mesh_ != index || scene_ != session.revisions().scene) {
        findEdges(mesh);
        mesh_ = index;
        scene_ = session.revisions().scene;
    }
    const auto world = [&](std::uint32_t vertex) {
        return glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[vertex], 1));
    };
    const auto faces = [&](int triangle) {
        const std::size_t i = 3 * static_cast<std::size_t>(triangle);
        const glm::vec3 a = world(mesh.indices[i]), b = world(mesh.indices[i + 1]),
                        c = world(mesh.indices[i + 2]);
        return glm::dot(glm::cross(b - a, c - a), session.camera().eye - a) > 0;
    };
    std::vector<Line> lines;
    for (const Edge& edge : edges_)
        if (edge.triangles[1] < 0 || faces(edge.triangles[0]) != faces(edge.triangles[1]))
            lines.push_back({world(edge.ends[0]), world(edge.ends[1])});
    return lines;
}

void SelectionOutline::draw(const Session& session, const glm::vec2& at, const glm::vec2& size) {
    const Selection& what = session.selection();
    if (what.kind != SelectionKind::Instance || what.index >= session.scene().instances.size()) return;
    if (size.x < 1 || size.y < 1) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect({at.x, at.y}, {at.x + size.x, at.y + size.y}, true);
    for (const Line& line : lines(session)) {
        const auto from = pictureOf(session.camera(), size.x / size.y, line[0]);
        const auto to = pictureOf(session.camera(), size.x / size.y, line[1]);
        if (!from || !to) continue;  // an end behind the eye
        const glm::vec2 a = at + *from * size, b = at + *to * size;
        list->AddLine({a.x, a.y}, {b.x, b.y}, kColor, 1.5f);
    }
    list->PopClipRect();
}

}  // namespace conelight::program
