// SPDX-License-Identifier: MIT
#include "viewer/light_shapes.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "session/inspection_lines.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr float kReachPx = 11;     // from the middle of an icon, a little more than it is large
constexpr float kEdge = 0.035f;    // of the picture's height: how far from its edge icons of far lights stand
constexpr float kSpotPart = 0.2f;  // of the scene's diagonal: the length of a cone without a range
constexpr int kRingEdges = 32;

constexpr ImU32 kLamp = IM_COL32(255, 214, 110, 255), kOff = IM_COL32(150, 150, 150, 255),
                kSelected = IM_COL32(70, 190, 255, 255), kShade = IM_COL32(0, 0, 0, 110);

ImU32 faint(ImU32 color) { return (color & ~IM_COL32_A_MASK) | (120u << IM_COL32_A_SHIFT); }

// As a screen shows it, at full brightness.
ImU32 colorOf(const Light& light) {
    const float most = std::max({light.intensity.r, light.intensity.g, light.intensity.b, 1e-20f});
    const glm::vec3 shown = glm::pow(light.intensity / most, glm::vec3(1 / 2.2f));
    return ImGui::ColorConvertFloat4ToU32({shown.r, shown.g, shown.b, 1});
}

// Two directions across `axis`.
std::array<glm::vec3, 2> sidesOf(const glm::vec3& axis) {
    const glm::vec3 other = std::fabs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 u = glm::normalize(glm::cross(axis, other));
    return {u, glm::cross(axis, u)};
}

// Lines of the world over the picture, with a shade that parts them from what is bright.
class Pen {
  public:
    Pen(const Camera& camera, const glm::vec2& at, const glm::vec2& size)
        : camera_(camera), at_(at), size_(size), list_(ImGui::GetWindowDrawList()) {}
    ImU32 color = kLamp;
    float width = 1.5f;

    void line(const glm::vec3& a, const glm::vec3& b) {
        // In pieces, as one may reach behind the eye.
        constexpr int kPieces = 8;
        for (int i = 0; i < kPieces; ++i) {
            const auto from = onScreen(glm::mix(a, b, static_cast<float>(i) / kPieces));
            const auto to = onScreen(glm::mix(a, b, static_cast<float>(i + 1) / kPieces));
            if (from && to) flat(*from, *to);
        }
    }
    void ring(const glm::vec3& center, const glm::vec3& normal, float radius) {
        const auto [u, v] = sidesOf(normal);
        ellipse(center, radius * u, radius * v);
    }
    void ellipse(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v) {
        std::optional<glm::vec2> last;
        for (int i = 0; i <= kRingEdges; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / kRingEdges;
            const auto next = onScreen(center + std::cos(angle) * u + std::sin(angle) * v);
            if (last && next) flat(*last, *next);
            last = next;
        }
    }
    void arrow(const glm::vec3& from, const glm::vec3& to) {
        line(from, to);
        const auto a = onScreen(from), b = onScreen(to);
        if (!a || !b || glm::length(*b - *a) < 4) return;
        const glm::vec2 d = glm::normalize(*b - *a), side(-d.y, d.x);
        for (const float turn : {-1.0f, 1.0f}) flat(*b, *b - 7.0f * d + turn * 4.0f * side);
    }
    void flat(const glm::vec2& a, const glm::vec2& b) {
        list_->AddLine({a.x, a.y}, {b.x, b.y}, kShade, width + 1.5f);
        list_->AddLine({a.x, a.y}, {b.x, b.y}, color, width);
    }

  private:
    std::optional<glm::vec2> onScreen(const glm::vec3& point) const {
        const auto part = pictureOf(camera_, size_.x / size_.y, point);
        if (!part) return std::nullopt;
        return at_ + *part * size_;
    }
    const Camera& camera_;
    glm::vec2 at_, size_;
    ImDrawList* list_;
};

void drawShape(Pen& pen, const Light& light, const glm::vec3& place, float diagonal, bool selected) {
    if (light.type == LightType::Rect) {
        const glm::vec3 u = light.halfU, v = light.halfV;
        const glm::vec3 corners[] = {place - u - v, place + u - v, place + u + v, place - u + v};
        for (int i = 0; i < 4; ++i) pen.line(corners[i], corners[(i + 1) % 4]);
        pen.arrow(place, place + std::min(glm::length(u), glm::length(v)) * light.direction);
    } else if (light.type == LightType::Disk) {
        pen.ellipse(place, light.halfU, light.halfV);
        pen.arrow(place,
                  place + std::min(glm::length(light.halfU), glm::length(light.halfV)) * light.direction);
    } else if (light.type == LightType::Sphere) {
        for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
            pen.ring(place, axis, glm::length(light.halfU));
    } else if (light.type == LightType::Spot) {
        float length = kSpotPart * diagonal * (selected ? 1.0f : 0.5f);
        if (light.range > 0) length = std::min(length, light.range);
        const auto [u, v] = sidesOf(light.direction);
        const float along = length * std::cos(light.outerAngle), out = length * std::sin(light.outerAngle);
        const glm::vec3 end = place + along * light.direction;
        pen.ring(end, light.direction, out);
        for (const glm::vec3& side : {u, -u, v, -v}) pen.line(place, end + out * side);
        if (selected)
            pen.ring(place + length * std::cos(light.innerAngle) * light.direction, light.direction,
                     length * std::sin(light.innerAngle));
    } else if (light.type == LightType::Directional) {
        pen.arrow(place, place + 0.15f * diagonal * light.direction);
    } else if (selected && light.range > 0) {
        for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
            pen.ring(place, axis, light.range);
    }
}

// A disc in the light's colour; of a rectangle a square, of points and suns with rays around, of a spot below alone.
void drawIcon(Pen& pen, const Light& light, const glm::vec2& p, bool stands) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float r = stands ? 5.5f : 4.5f;
    const ImU32 fill = light.enabled ? colorOf(light) : IM_COL32(60, 60, 60, 255);
    if (light.type == LightType::Rect) {
        list->AddRectFilled({p.x - r, p.y - r}, {p.x + r, p.y + r}, fill);
        list->AddRect({p.x - r - 1, p.y - r - 1}, {p.x + r + 1, p.y + r + 1}, kShade, 0, 0, 3);
        list->AddRect({p.x - r, p.y - r}, {p.x + r, p.y + r}, pen.color, 0, 0, 1.5f);
        return;
    }
    const int rays = light.type == LightType::Spot ? 3 : hasArea(light.type) ? 0 : 8;
    for (int i = 0; i < rays; ++i) {
        const float angle = light.type == LightType::Spot ? 1.5707963f + 0.7f * static_cast<float>(i - 1)
                                                          : 0.7853982f * static_cast<float>(i);
        const glm::vec2 d(std::cos(angle), std::sin(angle));
        pen.flat(p + (r + 2) * d, p + (r + 5) * d);
    }
    list->AddCircleFilled({p.x, p.y}, r + 1.5f, kShade, 16);
    list->AddCircleFilled({p.x, p.y}, r, fill, 16);
    list->AddCircle({p.x, p.y}, r, pen.color, 16, 1.5f);
}

}  // namespace

void LightShapes::placeIcons(const Session& session, const Aabb& scene) {
    icons_.clear();
    const float aspect = size_.x / size_.y;
    const glm::vec2 edge(kEdge / aspect, kEdge);
    const std::vector<Light>& lights = session.scene().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool far = lights[i].type == LightType::Directional;
        Icon icon{i, {}, lights[i].position};
        if (far) icon.place = scene.center() - 0.5f * glm::length(scene.extent()) * lights[i].direction;
        const auto part = pictureOf(session.camera(), aspect, icon.place);
        if (!part && !far) continue;
        icon.part = part.value_or(glm::vec2(0.5f, 0));
        if (far) icon.part = glm::clamp(icon.part, edge, 1.0f - edge);
        if (icon.part == glm::clamp(icon.part, glm::vec2(0), glm::vec2(1))) icons_.push_back(icon);
    }
}

void LightShapes::draw(const Session& session, MeshBounds& bounds, const glm::vec2& at, const glm::vec2& size,
                       bool hovered) {
    icons_.clear();
    if (!shown || session.scene().lights.empty() || size.x < 1 || size.y < 1) return;
    size_ = size;
    const Aabb scene = bounds.ofScene(session);
    placeIcons(session, scene);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const std::optional<std::size_t> hot =
        hovered ? this->at((glm::vec2(mouse.x, mouse.y) - at) / size) : std::nullopt;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect({at.x, at.y}, {at.x + size.x, at.y + size.y}, true);
    Pen pen(session.camera(), at, size);
    for (const Icon& icon : icons_) {
        const Light& light = session.scene().lights[icon.light];
        const bool selected = session.isSelected({SelectionKind::Light, icon.light});
        const ImU32 color = selected ? kSelected : light.enabled ? kLamp : kOff;
        pen.color = selected ? color : faint(color);
        pen.width = selected ? 2.0f : 1.2f;
        drawShape(pen, light, icon.place, glm::length(scene.extent()), selected);
        pen.color = color;
        const glm::vec2 p = at + icon.part * size;
        drawIcon(pen, light, p, hot == icon.light);
        notePlace("light:" + light.name, p - 3.0f, p + 3.0f);
    }
    list->PopClipRect();
}

std::optional<std::size_t> LightShapes::at(const glm::vec2& part) const {
    std::optional<std::size_t> found;
    float nearest = kReachPx;
    for (const Icon& icon : icons_) {
        const float distance = glm::length((icon.part - part) * size_);
        if (distance > nearest) continue;
        nearest = distance;
        found = icon.light;
    }
    return found;
}

}  // namespace conelight::program
