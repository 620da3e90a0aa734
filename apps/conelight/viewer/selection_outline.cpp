// SPDX-License-Identifier: MIT
#include "viewer/selection_outline.h"

#include <imgui.h>

#include <algorithm>
#include <tuple>

#include "session/inspection_lines.h"
#include "session/silhouette.h"
#include "viewer/imgui_names.h"

namespace conelight::program {
namespace {

constexpr std::size_t kMostTriangles = 20000;  // as lines: a few milliseconds a frame
constexpr std::size_t kMostBoxes = 500;
constexpr glm::u8vec3 kOutline(70, 190, 255);

void addBox(const Aabb& box, const glm::mat4& worldFromBox, std::vector<std::array<glm::vec3, 2>>& lines) {
    const auto corners = box.corners();
    const auto corner = [&](unsigned i) { return glm::vec3(worldFromBox * glm::vec4(corners[i], 1)); };
    for (unsigned i = 0; i < 8; ++i)
        for (const unsigned axis : {1u, 2u, 4u})
            if ((i & axis) == 0) lines.push_back({corner(i), corner(i | axis)});
}

}  // namespace

// Vertices at one place are one, whatever their normals.
const std::vector<SelectionOutline::Edge>& SelectionOutline::edgesOf(const Session& session,
                                                                     std::size_t index) {
    const std::uint64_t revision = session.meshRevisions()[index];
    const auto [place, isNewMesh] = edges_.try_emplace(index);
    if (!isNewMesh && place->second.revision == revision) return place->second.edges;
    place->second.revision = revision;
    std::vector<Edge>& edges = place->second.edges;
    edges.clear();
    const Mesh& mesh = session.scene().meshes[index];
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
            const auto [found, isNew] = known.try_emplace(ends, edges.size());
            if (isNew)
                edges.push_back({ends, {static_cast<int>(i / 3), -1}});
            else
                edges[found->second].triangles[1] = static_cast<int>(i / 3);
        }
    return edges;
}

void SelectionOutline::addLines(const Session& session, const Instance& instance, std::vector<Line>& lines) {
    const auto index = static_cast<std::size_t>(instance.mesh);
    const Mesh& mesh = session.scene().meshes[index];
    const auto world = [&](std::uint32_t vertex) {
        return glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[vertex], 1));
    };
    const auto faces = [&](int triangle) {
        const std::size_t i = 3 * static_cast<std::size_t>(triangle);
        const glm::vec3 a = world(mesh.indices[i]), b = world(mesh.indices[i + 1]),
                        c = world(mesh.indices[i + 2]);
        return glm::dot(glm::cross(b - a, c - a), session.camera().eye - a) > 0;
    };
    for (const Edge& edge : edgesOf(session, index))
        if (edge.triangles[1] < 0 || faces(edge.triangles[0]) != faces(edge.triangles[1]))
            lines.push_back({world(edge.ends[0]), world(edge.ends[1])});
}

void SelectionOutline::drawCovered(const Session& session, const std::vector<std::size_t>& objects,
                                   const glm::vec2& at, const glm::vec2& size) {
    const Revisions& now = session.revisions();
    const std::array<std::uint64_t, 2> revisions{now.scene + now.transforms + now.instances + now.meshes,
                                                 now.selection};
    const glm::ivec2 sizePx(size);
    if (revisions != revisions_ || camera_ != session.camera() || sizePx != sizePx_) {
        const Silhouette shape = silhouetteOf(session.scene(), objects, session.camera(), sizePx.x, sizePx.y);
        covered_.update(sizePx.x, sizePx.y, outlineOf(shape, kOutline));
        revisions_ = revisions;
        camera_ = session.camera();
        sizePx_ = sizePx;
    }
    ImGui::GetWindowDrawList()->AddImage(textureId(covered_.name()), {at.x, at.y},
                                         {at.x + size.x, at.y + size.y});
}

void SelectionOutline::draw(const Session& session, MeshBounds& bounds, const glm::vec2& at,
                            const glm::vec2& size, bool moving) {
    const std::vector<std::size_t> objects = session.selectedOf(SelectionKind::Instance);
    if (objects.empty() || size.x < 1 || size.y < 1) return;
    if (scene_ != session.revisions().scene) edges_.clear();
    scene_ = session.revisions().scene;
    const Scene& scene = session.scene();
    const auto meshOf = [&](std::size_t i) { return static_cast<std::size_t>(scene.instances[i].mesh); };
    std::size_t triangles = 0;
    for (const std::size_t i : objects) triangles += scene.meshes[meshOf(i)].triangleCount();
    std::vector<Line> lines;
    if (triangles <= kMostTriangles) {
        for (const std::size_t i : objects) addLines(session, scene.instances[i], lines);
    } else if (!moving) {
        return drawCovered(session, objects, at, size);
    } else {
        for (std::size_t k = 0; k < std::min(objects.size(), kMostBoxes); ++k)
            addBox(bounds.of(session, meshOf(objects[k])), scene.instances[objects[k]].worldFromObject,
                   lines);
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect({at.x, at.y}, {at.x + size.x, at.y + size.y}, true);
    for (const Line& line : lines) {
        const auto from = pictureOf(session.camera(), size.x / size.y, line[0]);
        const auto to = pictureOf(session.camera(), size.x / size.y, line[1]);
        if (!from || !to) continue;  // an end behind the eye
        const glm::vec2 a = at + *from * size, b = at + *to * size;
        list->AddLine({a.x, a.y}, {b.x, b.y}, IM_COL32(kOutline.r, kOutline.g, kOutline.b, 255), 1.5f);
    }
    list->PopClipRect();
}

}  // namespace conelight::program
