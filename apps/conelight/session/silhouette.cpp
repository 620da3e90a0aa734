// SPDX-License-Identifier: MIT
#include "session/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "session/projection.h"

namespace conelight::program {
namespace {

// A corner on the screen: pixels, and what grows as it comes nearer and is linear there.
struct Corner {
    glm::vec2 at{0};
    float nearness = 0;
};

// Points as the camera sees them: m to the right, downwards and along the view.
class EyeSpace {
  public:
    EyeSpace(const Camera& camera, int width, int height)
        : camera_(camera),
          size_(width, height),
          right_(cameraAxes(camera).right),
          down_(-cameraAxes(camera).up),
          forward_(cameraAxes(camera).forward) {}
    glm::vec3 of(const glm::vec3& point) const {
        const glm::vec3 d = point - camera_.eye;
        return {glm::dot(right_, d), glm::dot(down_, d), glm::dot(forward_, d)};
    }
    Corner onScreen(const glm::vec3& p) const {
        const glm::vec2 at = 0.5f * size_ + glm::vec2(p) * (size_.y / camera_.heightAt(p.z));
        return {at, camera_.isOrthographic() ? camera_.zFar - p.z : 1 / p.z};
    }
    float nearest() const { return camera_.zNear; }

  private:
    const Camera& camera_;
    glm::vec2 size_;
    glm::vec3 right_, down_, forward_;
};

class Canvas {
  public:
    Canvas(int width, int height) {
        shape_.width = width;
        shape_.height = height;
        shape_.object.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
        nearness_.assign(shape_.object.size(), 0);
    }
    std::uint32_t object = 0;  // that is drawn
    Silhouette take() { return std::move(shape_); }

    // Pixels whose centres are in it, and that of a corner.
    void triangle(const Corner& a, Corner b, Corner c) {
        const glm::ivec2 corner(glm::floor(glm::clamp(a.at, glm::vec2(-1), glm::vec2(1e6f))));
        if (corner.x >= 0 && corner.y >= 0 && corner.x < shape_.width && corner.y < shape_.height)
            cover(index(corner.x, corner.y), a.nearness);
        float area = cross(b.at - a.at, c.at - a.at);
        if (area == 0 || !std::isfinite(area)) return;
        if (area < 0) std::swap(b, c);
        area = std::abs(area);
        const glm::vec2 low = glm::min(a.at, glm::min(b.at, c.at)),
                        high = glm::max(a.at, glm::max(b.at, c.at));
        const int x0 = first(low.x), y0 = first(low.y);
        const int x1 = last(high.x, shape_.width), y1 = last(high.y, shape_.height);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                const float ab = cross(b.at - a.at, p - a.at), bc = cross(c.at - b.at, p - b.at),
                            ca = cross(a.at - c.at, p - c.at);
                if (ab < 0 || bc < 0 || ca < 0) continue;
                cover(index(x, y), (bc * a.nearness + ca * b.nearness + ab * c.nearness) / area);
            }
    }

  private:
    static float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }
    static int first(float low) { return static_cast<int>(std::ceil(std::clamp(low - 0.5f, 0.0f, 1e6f))); }
    static int last(float high, int size) {
        return static_cast<int>(std::floor(std::clamp(high - 0.5f, -1.0f, static_cast<float>(size - 1))));
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(shape_.width) +
               static_cast<std::size_t>(x);
    }
    void cover(std::size_t pixel, float nearness) {
        if (!(nearness > nearness_[pixel])) return;
        nearness_[pixel] = nearness;
        shape_.object[pixel] = object;
    }
    Silhouette shape_;
    std::vector<float> nearness_;
};

// What of it lies before the near plane is cut off.
void drawTriangle(Canvas& canvas, const std::array<glm::vec3, 3>& corners, const EyeSpace& space) {
    const float nearest = space.nearest();
    std::array<glm::vec3, 4> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 &p = corners[i], &q = corners[(i + 1) % 3];
        if (p.z >= nearest) kept[count++] = p;
        if ((p.z >= nearest) != (q.z >= nearest))
            kept[count++] = glm::mix(p, q, (nearest - p.z) / (q.z - p.z));
    }
    for (std::size_t i = 2; i < count; ++i)
        canvas.triangle(space.onScreen(kept[0]), space.onScreen(kept[i - 1]), space.onScreen(kept[i]));
}

}  // namespace

Silhouette silhouetteOf(const Scene& scene, const std::vector<std::size_t>& instances, const Camera& camera,
                        int width, int height) {
    const EyeSpace space(camera, width, height);
    Canvas canvas(width, height);
    std::vector<glm::vec3> points;
    for (const std::size_t i : instances) {
        ++canvas.object;
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        points.clear();
        for (const glm::vec3& p : mesh.positions)
            points.push_back(space.of(glm::vec3(instance.worldFromObject * glm::vec4(p, 1))));
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3)
            drawTriangle(canvas,
                         {points[mesh.indices[k]], points[mesh.indices[k + 1]], points[mesh.indices[k + 2]]},
                         space);
    }
    return canvas.take();
}

std::vector<std::uint8_t> outlineOf(const Silhouette& silhouette, const glm::u8vec3& color) {
    constexpr int kReach = 2;
    const int width = silhouette.width, height = silhouette.height;
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    std::vector<std::uint8_t> rgba(4 * silhouette.object.size(), 0);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::uint32_t own = silhouette.object[index(x, y)];
            float nearest = kReach + 1;
            for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, height - 1); ++v)
                for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, width - 1); ++u)
                    if (silhouette.object[index(u, v)] > own)
                        nearest = std::min(nearest, glm::length(glm::vec2(u - x, v - y)));
            std::uint8_t* pixel = &rgba[4 * index(x, y)];
            for (int c = 0; c < 3; ++c) pixel[c] = color[c];
            pixel[3] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(2.5f - nearest, 0.0f, 1.0f)));
        }
    return rgba;
}

}  // namespace conelight::program
