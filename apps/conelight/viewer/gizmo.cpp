// SPDX-License-Identifier: MIT
#include "viewer/gizmo.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "session/inspection_lines.h"
#include "session/projection.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr float kLength = 0.13f;  // of a handle, parts of the picture's height; by eye
constexpr float kReach = 7;       // px from the mouse to a handle that it takes
constexpr int kRing = 48;         // edges of a ring
constexpr ImU32 kColors[4] = {IM_COL32(235, 80, 70, 255), IM_COL32(110, 200, 80, 255),
                              IM_COL32(80, 140, 250, 255), IM_COL32(225, 225, 225, 255)};
constexpr ImU32 kHot = IM_COL32(255, 220, 90, 255);

// Lights alone: no ring, no box.
bool onlyMoves(const Session& session) {
    const std::vector<Selection>& all = session.selected();
    return std::all_of(all.begin(), all.end(),
                       [](const Selection& one) { return one.kind == SelectionKind::Light; });
}

// The middle of what is selected, and the directions of its own axes; nothing: it has no place.
struct Placed {
    glm::vec3 pivot{0};
    glm::mat3 own{1};
};
std::optional<Placed> placed(const Session& session, MeshBounds& meshes) {
    const Scene& scene = session.scene();
    Aabb all;
    for (const Selection& what : session.selected()) {
        if (what.kind == SelectionKind::Instance) all.grow(meshes.ofInstance(session, what.index));
        if (what.kind == SelectionKind::Light && scene.lights[what.index].type != LightType::Directional)
            all.grow(scene.lights[what.index].position);
    }
    if (all.empty()) return std::nullopt;
    Placed result{all.center(), glm::mat3(1)};
    if (session.selected().size() > 1 || session.selection().kind != SelectionKind::Instance) return result;
    const Instance& instance = scene.instances[session.selection().index];
    const Aabb& own = meshes.of(session, static_cast<std::size_t>(instance.mesh));
    result.pivot = glm::vec3(instance.worldFromObject * glm::vec4(own.center(), 1));
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 column(instance.worldFromObject[i]);
        if (glm::length(column) > 1e-9f) result.own[i] = glm::normalize(column);
    }
    return result;
}

float distanceTo(const glm::vec2& p, const std::vector<glm::vec2>& line) {
    float best = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::vec2 d = line[i + 1] - line[i];
        const float t = std::clamp(glm::dot(p - line[i], d) / std::max(glm::dot(d, d), 1e-6f), 0.0f, 1.0f);
        best = std::min(best, glm::length(p - line[i] - t * d));
    }
    return line.size() == 1 ? glm::length(p - line[0]) : best;
}

// Two directions across `axis`, right-handed with it.
void across(const glm::vec3& axis, glm::vec3& u, glm::vec3& v) {
    u = glm::normalize(glm::cross(axis, std::fabs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    v = glm::cross(axis, u);
}

glm::mat4 about(const glm::vec3& pivot, const glm::mat4& change) {
    return glm::translate(glm::mat4(1), pivot) * change * glm::translate(glm::mat4(1), -pivot);
}

}  // namespace

std::optional<glm::vec2> Gizmo::View::onScreen(const glm::vec3& point) const {
    const std::optional<glm::vec2> part = pictureOf(camera, size.x / size.y, point);
    if (!part) return std::nullopt;
    return at + *part * size;
}

ViewRay Gizmo::View::ray(const glm::vec2& mouse) const {
    const glm::vec2 part = (mouse - at) / size;
    return viewRay(camera, size.x / size.y, {2 * part.x - 1, 1 - 2 * part.y});
}

std::vector<Gizmo::Handle> Gizmo::handles(const View& view, const glm::vec3& pivot, const glm::mat3& own,
                                          bool moves) const {
    const GizmoTool shown = moves ? GizmoTool::Move : tool;
    const float length = kLength * view.camera.heightAt(glm::length(pivot - view.camera.eye));
    std::vector<Handle> all;
    const std::optional<glm::vec2> middle = view.onScreen(pivot);
    if (!middle || !(length > 0)) return all;
    for (int axis = 0; axis < 3; ++axis) {
        Handle handle{axis, glm::vec3(0), {}};
        handle.direction[axis] = 1;
        if (shown == GizmoTool::Scale) handle.direction = own[axis];
        if (shown == GizmoTool::Turn) {
            glm::vec3 u, v;
            across(handle.direction, u, v);
            for (int i = 0; i <= kRing; ++i) {
                const float angle = 6.2831853f * static_cast<float>(i) / kRing;
                if (const auto p =
                        view.onScreen(pivot + length * (std::cos(angle) * u + std::sin(angle) * v)))
                    handle.line.push_back(*p);
            }
        } else if (const auto tip = view.onScreen(pivot + length * handle.direction)) {
            // One that points at the eye cannot be dragged.
            if (glm::length(*tip - *middle) > 2 * kReach) handle.line = {*middle, *tip};
        }
        if (!handle.line.empty()) all.push_back(handle);
    }
    if (shown == GizmoTool::Scale) all.push_back({3, glm::vec3(0), {*middle}});
    return all;
}

// Where on the handle's axis, or at which angle about it, the mouse points.
std::optional<float> Gizmo::along(const View& view, const Handle& handle, const glm::vec3& pivot,
                                  const glm::vec2& mouse) const {
    const auto [origin, ray, perDepth] = view.ray(mouse);
    const glm::vec3 n = handle.direction, to = pivot - origin;
    if (tool == GizmoTool::Turn && handle.line.size() > 2) {
        const float across = glm::dot(ray, n);
        if (std::fabs(across) < 0.05f) return std::nullopt;  // the ring is seen from its edge
        const glm::vec3 p = ray * (glm::dot(to, n) / across) - to;
        glm::vec3 u, v;
        program::across(n, u, v);
        return std::atan2(glm::dot(p, v), glm::dot(p, u));
    }
    // The point of the axis that is nearest to the ray.
    const float b = glm::dot(ray, n), denominator = 1 - b * b;
    if (denominator < 1e-4f) return std::nullopt;
    return (b * glm::dot(ray, to) - glm::dot(n, to)) / denominator;
}

// Of the world, since the drag began.
std::optional<glm::mat4> Gizmo::changeBy(const View& view, const glm::vec2& mouse) const {
    const Drag& d = *drag_;
    const bool all = d.handle.axis == 3;
    float now = 0, begun = 0;
    if (!all) {
        const std::optional<float> there = along(view, d.handle, d.pivot, mouse);
        if (!there || !d.along) return std::nullopt;
        now = *there;
        begun = *d.along;
    }
    if (d.instances.empty() || tool == GizmoTool::Move)
        return glm::translate(glm::mat4(1), (now - begun) * d.handle.direction);
    if (tool == GizmoTool::Turn)
        return about(d.pivot, glm::rotate(glm::mat4(1), now - begun, d.handle.direction));
    // A hundredth to a hundred times in one drag; the middle: twice in 100 pixels to the right.
    const float factor =
        std::clamp(all ? std::exp2(0.01f * (mouse.x - d.mouse.x)) : now / begun, 0.01f, 100.0f);
    glm::mat3 scale(all ? factor : 1.0f);
    if (!all) scale += (factor - 1) * glm::outerProduct(d.handle.direction, d.handle.direction);
    return about(d.pivot, glm::mat4(scale));
}

void Gizmo::drag(Session& session, const View& view, const glm::vec2& mouse) {
    if (mouse == drag_->last) return;
    drag_->last = mouse;
    const std::optional<glm::mat4> change = changeBy(view, mouse);
    if (!change) return;
    SceneEdits edits;
    edits.instances = drag_->instances;
    for (auto& [index, instance] : edits.instances)
        instance.worldFromObject = *change * instance.worldFromObject;
    for (const Selection& what : drag_->what) {
        if (what.kind != SelectionKind::Light) continue;
        if (!edits.lights) edits.lights = drag_->lights;
        Light& light = (*edits.lights)[what.index];
        light.position = glm::vec3(*change * glm::vec4(light.position, 1));
        if (tool != GizmoTool::Turn) continue;
        for (glm::vec3* direction : {&light.direction, &light.halfU, &light.halfV})
            *direction = glm::mat3(*change) * *direction;
    }
    static constexpr const char* kVerbs[] = {"move ", "turn ", "scale "};
    const bool one = drag_->what.size() == 1;
    const std::string name = !one                      ? fmt::format("{} things", drag_->what.size())
                             : edits.instances.empty() ? "light"
                                                       : edits.instances.front().second.name;
    session.edit(edits, kVerbs[edits.instances.empty() ? 0 : static_cast<int>(tool)] + name, "gizmo");
}

void Gizmo::begin(const Session& session, const View& view, const Handle& handle, const glm::vec3& pivot,
                  const glm::vec2& mouse) {
    Drag begun{session.selected(), handle, pivot, mouse, mouse, along(view, handle, pivot, mouse), {}, {}};
    for (const std::size_t i : session.selectedOf(SelectionKind::Instance))
        begun.instances.emplace_back(i, session.scene().instances[i]);
    begun.lights = session.scene().lights;
    drag_ = std::move(begun);
}

void Gizmo::show(Session& session, MeshBounds& bounds, const glm::vec2& at, const glm::vec2& size,
                 bool hovered) {
    const std::optional<Placed> where = placed(session, bounds);
    if (!where || size.x < 1 || size.y < 1 || (drag_ && drag_->what != session.selected())) {
        drag_.reset();
        return;
    }
    const View view{session.camera(), at, size};
    const glm::vec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    // In the frame that sees the button let go, too: the cursor may have come from afar since the frame before.
    if (drag_) drag(session, view, mouse);
    if (drag_ && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        session.seal();
        drag_.reset();
    }
    // Where it is now: a drag has moved it.
    const Placed now = placed(session, bounds).value_or(*where);
    const bool moves = onlyMoves(session);
    const std::vector<Handle> all = handles(view, now.pivot, now.own, moves);
    const Handle* hot = nullptr;
    float nearest = kReach;
    for (const Handle& handle : all) {
        // The middle first: it lies on all the others.
        const float distance = distanceTo(mouse, handle.line) - (handle.axis == 3 ? kReach : 0);
        if (!drag_ && hovered && distance < nearest) {
            nearest = distance;
            hot = &handle;
        }
        if (drag_ && drag_->handle.axis == handle.axis) hot = &handle;
    }
    if (!drag_ && hot != nullptr && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        begin(session, view, *hot, now.pivot, mouse);

    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect({at.x, at.y}, {at.x + size.x, at.y + size.y}, true);
    for (const Handle& handle : all) draw(handle, tool == GizmoTool::Move || moves, &handle == hot);
    list->PopClipRect();
}

void Gizmo::draw(const Handle& handle, bool arrow, bool hot) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 color = hot ? kHot : kColors[handle.axis];
    for (std::size_t i = 0; i + 1 < handle.line.size(); ++i)
        list->AddLine({handle.line[i].x, handle.line[i].y}, {handle.line[i + 1].x, handle.line[i + 1].y},
                      color, 2.5f);
    const glm::vec2 end = handle.line.size() > kRing ? handle.line[5 * kRing / 8] : handle.line.back();
    if (handle.line.size() == 2 && arrow) {
        const glm::vec2 d = glm::normalize(handle.line[1] - handle.line[0]), side(-d.y, d.x);
        const glm::vec2 tip = end + 8.0f * d, left = end + 5.0f * side, right = end - 5.0f * side;
        list->AddTriangleFilled({tip.x, tip.y}, {left.x, left.y}, {right.x, right.y}, color);
    } else if (handle.line.size() <= 2) {
        list->AddRectFilled({end.x - 5, end.y - 5}, {end.x + 5, end.y + 5}, color);
    }
    static constexpr const char* kNames[4] = {"gizmo:x", "gizmo:y", "gizmo:z", "gizmo:all"};
    notePlace(kNames[handle.axis], end - 3.0f, end + 3.0f);
}

}  // namespace conelight::program
