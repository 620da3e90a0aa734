// SPDX-License-Identifier: MIT
#include "session/inspection_lines.h"

#include <algorithm>
#include <cmath>

#include "session/picker.h"
#include "session/projection.h"
#include "session/session.h"

namespace conelight::program {
namespace {

constexpr int kPieces = 10;         // per axis, each seen or not
constexpr int kCircle = 20;         // edges of a footprint
constexpr std::size_t kRings = 14;  // footprints per cone at most
constexpr float kHidden = 0.15f;    // opacity of what lies behind surfaces

// One colour per kind, told apart on dark and on light surfaces.
glm::vec3 colorOf(PathKind kind) {
    switch (kind) {
        case PathKind::DiffuseCone:
        case PathKind::CosineRay:
            return {1.0f, 0.75f, 0.2f};
        case PathKind::LightRay:
            return {1.0f, 0.4f, 0.3f};
        case PathKind::SpecularCone:
        case PathKind::SpecularRay:
            return {0.3f, 0.85f, 1.0f};
        case PathKind::CacheFace:
            return {0.5f, 1.0f, 0.5f};
        default:
            return {0.8f, 0.6f, 1.0f};
    }
}

void basis(const glm::vec3& n, glm::vec3& u, glm::vec3& v) {
    const glm::vec3 other = std::fabs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    u = glm::normalize(glm::cross(other, n));
    v = glm::cross(n, u);
}

class Lines {
  public:
    Lines(const Camera& camera, float aspect, const SeesPoint& sees)
        : camera_(camera), aspect_(aspect), sees_(sees) {}

    void line(const glm::vec3& a, const glm::vec3& b, const glm::vec3& color, float opacity) {
        const std::optional<glm::vec2> from = pictureOf(camera_, aspect_, a);
        const std::optional<glm::vec2> to = pictureOf(camera_, aspect_, b);
        if (!from || !to) return;
        const bool seen = !sees_ || sees_(0.5f * (a + b));
        lines_.push_back({*from, *to, color, seen ? opacity : kHidden * opacity});
    }
    void axis(const InspectedPath& path, const glm::vec3& color, float opacity) {
        for (int i = 0; i < kPieces; ++i) {
            const float t0 = path.distance * static_cast<float>(i) / kPieces;
            const float t1 = path.distance * static_cast<float>(i + 1) / kPieces;
            line(path.origin + t0 * path.direction, path.origin + t1 * path.direction, color, opacity);
        }
    }
    void circle(const glm::vec3& center, const glm::vec3& normal, float radius, int edges,
                const glm::vec3& color, float opacity) {
        glm::vec3 u, v;
        basis(normal, u, v);
        glm::vec3 last = center + radius * u;
        for (int i = 1; i <= edges; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(edges);
            const glm::vec3 next = center + radius * (std::cos(angle) * u + std::sin(angle) * v);
            line(last, next, color, opacity);
            last = next;
        }
    }
    std::vector<PictureLine> take() { return std::move(lines_); }

  private:
    const Camera& camera_;
    float aspect_;
    const SeesPoint& sees_;
    std::vector<PictureLine> lines_;
};

}  // namespace

std::optional<glm::vec2> pictureOf(const Camera& camera, float aspect, const glm::vec3& point) {
    const CameraAxes axes = cameraAxes(camera);
    const glm::vec3 d = point - camera.eye;
    const float z = glm::dot(d, glm::vec3(axes.forward));
    if (z < camera.zNear) return std::nullopt;
    const glm::vec2 part =
        glm::vec2(glm::dot(d, glm::vec3(axes.right)), -glm::dot(d, glm::vec3(axes.up))) / camera.heightAt(z);
    return 0.5f + part / glm::vec2(aspect, 1);
}

std::vector<PictureLine> inspectionLines(const PixelInspection& pixel, const Camera& camera, float aspect,
                                         int chosen, const SeesPoint& sees) {
    Lines lines(camera, aspect, sees);
    for (std::size_t i = 0; i < pixel.paths.size(); ++i) {
        const InspectedPath& path = pixel.paths[i];
        if (path.end == PathEnd::Unused) continue;
        // The cone into a lobe that the surface does not have.
        if (partOf(path.kind) == PathPart::Specular && pixel.specular.scale == glm::vec3(0)) continue;
        const bool standsOut = chosen < 0 || static_cast<std::size_t>(chosen) == i;
        const float opacity = standsOut ? 1.0f : 0.25f;
        const glm::vec3 color = colorOf(path.kind);
        lines.axis(path, color, opacity);
        // Footprints; of cones with many steps every so many-th, and always the last.
        const float tanHalf = std::tan(0.5f * path.aperture);
        const std::size_t stride = std::max<std::size_t>(1, (path.steps.size() + kRings - 1) / kRings);
        for (std::size_t s = 0; s < path.steps.size() && path.aperture > 0; ++s) {
            const InspectedStep& step = path.steps[s];
            if (s % stride != 0 && s + 1 != path.steps.size()) continue;
            lines.circle(step.position, path.direction, tanHalf * step.distance, kCircle, color,
                         opacity * (0.25f + 0.75f * std::min(step.opacity, 1.0f)));
        }
        // The face: a square of a voxel's size on its plane.
        if (path.face && !path.steps.empty() && path.kind != PathKind::CacheFace) {
            const InspectedStep& hit = path.steps.back();
            lines.circle(hit.position, path.face->normal, 0.7071f * hit.size, 4, color, opacity);
        }
    }
    return lines.take();
}

SeesPoint seenFrom(Picker& picker, const Session& session) {
    return [&picker, &session](const glm::vec3& point) {
        const ViewRay ray = viewRayTo(session.camera(), point);
        const float distance = glm::distance(point, ray.origin);
        if (distance <= 0) return true;
        const std::optional<Pick> hit =
            picker.along(session, ray.origin, ray.direction, session.camera().zNear);
        // Points on surfaces are seen: half a percent for rounding and for planes of voxels.
        return !hit || hit->distance > 0.995f * distance;
    };
}

void drawLine(Image& image, const PictureLine& line, float brightness) {
    const glm::vec2 size(static_cast<float>(image.width), static_cast<float>(image.height));
    const glm::vec2 from = line.from * size - 0.5f, to = line.to * size - 0.5f;
    const float length = glm::length(to - from);
    // Lines far outside are cut, not walked.
    const int points = std::clamp(static_cast<int>(2 * length), 1, 8 * std::max(image.width, image.height));
    for (int i = 0; i <= points; ++i) {
        const glm::vec2 p = glm::mix(from, to, static_cast<float>(i) / static_cast<float>(points));
        if (!(p.x > -1 && p.y > -1 && p.x < size.x && p.y < size.y)) continue;
        const glm::ivec2 corner(glm::floor(p));
        const glm::vec2 part = p - glm::vec2(corner);
        for (int k = 0; k < 4; ++k) {
            const glm::ivec2 q = corner + glm::ivec2(k & 1, k >> 1);
            if (q.x < 0 || q.y < 0 || q.x >= image.width || q.y >= image.height) continue;
            const float share = ((k & 1) != 0 ? part.x : 1 - part.x) * ((k >> 1) != 0 ? part.y : 1 - part.y);
            glm::vec4& pixel = image.pixels[static_cast<std::size_t>(q.y * image.width + q.x)];
            pixel = glm::mix(pixel, glm::vec4(brightness * line.color, 1), 0.7f * share * line.opacity);
        }
    }
}

}  // namespace conelight::program
