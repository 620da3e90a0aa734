// SPDX-License-Identifier: MIT
#include "viewer/ground_grid.h"

#include <algorithm>
#include <cmath>

#include "session/lengths.h"
#include "session/projection.h"

namespace conelight::program {
namespace {

constexpr int kCells = 16;         // to each side of what the camera looks at
constexpr int kPiecesPerCell = 2;  // each seen or hidden
constexpr int kEvenPieces = 6;     // that have one opacity
constexpr glm::vec3 kLineColor{0.40f, 0.52f, 0.66f}, kXColor{0.92f, 0.31f, 0.27f},
    kZColor{0.31f, 0.55f, 0.98f};

class GridLines {
  public:
    GridLines(const Camera& camera, float aspect, const SeesPoint& sees, const glm::vec3& middle, float cell)
        : camera_(camera), aspect_(aspect), sees_(sees), middle_(middle), cell_(cell) {}

    // The line along axis 0 or 2 through the multiple `number` of cells on the other one.
    void add(int axis, long number) {
        const int across = 2 - axis;
        glm::vec3 from = middle_, to = middle_;
        from[across] = to[across] = static_cast<float>(number) * cell_;
        from[axis] -= kCells * cell_;
        to[axis] += kCells * cell_;
        const glm::vec3 color = number != 0 ? kLineColor : axis == 0 ? kXColor : kZColor;
        const float opacity = number == 0 ? 0.95f : number % 10 == 0 ? 0.8f : 0.45f;
        constexpr int kPieces = 2 * kCells * kPiecesPerCell;
        const auto at = [&](float place) { return glm::mix(from, to, place / kPieces); };
        for (int i = 0; i < kPieces; i += kEvenPieces) {
            const int end = std::min(i + kEvenPieces, kPieces);
            const float distance =
                glm::length(at(0.5f * static_cast<float>(i + end)) - middle_) / (kCells * cell_);
            const float fade = std::clamp(1.4f - 1.4f * distance, 0.0f, 1.0f);
            if (fade > 0.02f) addSeen(at, i, end, color, opacity * fade);
        }
    }
    std::vector<PictureLine> take() { return std::move(lines_); }

  private:
    // From one place that is seen to the next that is not, which a bisection finds.
    template <class At>
    void addSeen(const At& at, int begin, int end, const glm::vec3& color, float opacity) {
        std::optional<float> from;
        bool before = false;
        for (int i = begin; i <= end; ++i) {
            const auto place = static_cast<float>(i);
            const bool now = isSeen(at(place));
            if (i > begin && now != before) {
                const float turn = turningPoint(at, now ? place : place - 1, now ? place - 1 : place);
                if (now)
                    from = turn;
                else
                    addLine(at(*from), at(turn), color, opacity);
            } else if (now && i == begin) {
                from = place;
            }
            before = now;
        }
        if (before) addLine(at(*from), at(static_cast<float>(end)), color, opacity);
    }
    // In the picture, or near it, and not hidden.
    bool isSeen(const glm::vec3& point) const {
        constexpr float kBeside = 0.1f;
        const auto place = pictureOf(camera_, aspect_, point);
        if (!place || glm::any(glm::lessThan(*place, glm::vec2(-kBeside))) ||
            glm::any(glm::greaterThan(*place, glm::vec2(1 + kBeside))))
            return false;
        return sees_(point);
    }
    template <class At>
    float turningPoint(const At& at, float seen, float hidden) const {
        constexpr int kHalvings = 5;
        for (int i = 0; i < kHalvings; ++i) {
            const float middle = 0.5f * (seen + hidden);
            (isSeen(at(middle)) ? seen : hidden) = middle;
        }
        return seen;
    }
    void addLine(const glm::vec3& a, const glm::vec3& b, const glm::vec3& color, float opacity) {
        const auto from = pictureOf(camera_, aspect_, a), to = pictureOf(camera_, aspect_, b);
        if (from && to) lines_.push_back({*from, *to, color, opacity});
    }

    const Camera& camera_;
    float aspect_;
    const SeesPoint& sees_;
    glm::vec3 middle_;
    float cell_;
    std::vector<PictureLine> lines_;
};

}  // namespace

float gridCell(float distance) { return roundLengthBelow(std::clamp(distance, 1e-6f, 1e9f) / 4); }

const std::vector<PictureLine>& GroundGrid::lines(const Session& session, Picker& picker, float aspect,
                                                  bool edited) {
    const std::uint64_t objects = session.revisions().rayTables(), scene = session.revisions().scene;
    const bool otherScene = objects != objects_ || scene != scene_;
    const Camera& camera = session.camera();
    const bool current = found_ && !otherScene && camera == camera_ && aspect == aspect_;
    if (current || (found_ && edited && otherScene && scene == scene_)) return lines_;
    if (otherScene || !found_) {
        const Aabb bounds = session.scene().bounds();
        height_ = bounds.empty() ? 0 : bounds.min.y;
    }
    const float cell = gridCell(apparentDistance(camera));
    const auto nearest = [&](float x) { return std::lround(x / cell); };
    const long x = nearest(camera.target.x), z = nearest(camera.target.z);
    const glm::vec3 middle(static_cast<float>(x) * cell, height_, static_cast<float>(z) * cell);
    const SeesPoint sees = seenFrom(picker, session);
    GridLines found(camera, aspect, sees, middle, cell);
    for (long i = -kCells; i <= kCells; ++i) {
        found.add(0, z + i);
        found.add(2, x + i);
    }
    lines_ = found.take();
    camera_ = camera;
    aspect_ = aspect;
    objects_ = objects;
    scene_ = scene;
    found_ = true;
    return lines_;
}

}  // namespace conelight::program
