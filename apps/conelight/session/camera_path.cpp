// SPDX-License-Identifier: MIT
#include "session/camera_path.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace conelight::program {
namespace {

glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double w) { return a + w * (b - a); }
glm::dquat mixed(const glm::dquat& a, const glm::dquat& b, double w) { return glm::slerp(a, b, w); }

// The segment i with x[i] <= at < x[i + 1].
std::size_t segmentOf(const std::vector<double>& x, double at) {
    const auto above = std::upper_bound(x.begin(), x.end(), at);
    const auto index = static_cast<std::size_t>(above - x.begin());
    return std::clamp<std::size_t>(index, 1, x.size() - 1) - 1;
}

// Fritsch and Butland's slope: the weighted harmonic mean of both sides' slopes, 0 at an extremum.
double slopeAt(const std::vector<double>& x, const std::vector<double>& y, std::size_t i) {
    const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
    if (i == 0) return secant(0);
    if (i + 1 == x.size()) return secant(i - 1);
    const double left = secant(i - 1), right = secant(i);
    if (left * right <= 0) return 0;
    const double hLeft = x[i] - x[i - 1], hRight = x[i + 1] - x[i];
    const double wLeft = 2 * hRight + hLeft, wRight = hRight + 2 * hLeft;
    return (wLeft + wRight) / (wLeft / left + wRight / right);
}

double monotone(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const std::size_t i = segmentOf(x, at);
    const double h = x[i + 1] - x[i], u = (at - x[i]) / h;
    const double a = slopeAt(x, y, i) * h, b = slopeAt(x, y, i + 1) * h, d = y[i + 1] - y[i];
    return y[i] + u * (a + u * ((3 * d - 2 * a - b) + u * (a + b - 2 * d)));
}

// Curve through `points` at `knot`, which lies in segment i of `knots`. Where a neighbour coincides with its
// point, or there is none, the segment's own continuation stands for it.
template <class T>
T curve(const std::vector<T>& points, const std::vector<double>& knots, std::size_t i, double knot) {
    const double h = knots[i + 1] - knots[i];
    const double least = 1e-9 * knots.back();
    if (!(h > least)) return points[i];
    const T &p1 = points[i], &p2 = points[i + 1];
    T p0 = mixed(p2, p1, 2), p3 = mixed(p1, p2, 2);
    double k0 = knots[i] - h, k3 = knots[i + 1] + h;
    const double k1 = knots[i], k2 = knots[i + 1];
    if (i > 0 && k1 - knots[i - 1] > least) {
        p0 = points[i - 1];
        k0 = knots[i - 1];
    }
    if (i + 2 < points.size() && knots[i + 2] - k2 > least) {
        p3 = points[i + 2];
        k3 = knots[i + 2];
    }
    const T a1 = mixed(p0, p1, (knot - k0) / (k1 - k0));
    const T a2 = mixed(p1, p2, (knot - k1) / (k2 - k1));
    const T a3 = mixed(p2, p3, (knot - k2) / (k3 - k2));
    const T b1 = mixed(a1, a2, (knot - k0) / (k2 - k0));
    const T b2 = mixed(a2, a3, (knot - k1) / (k3 - k1));
    return mixed(b1, b2, (knot - k1) / (k2 - k1));
}

double distanceOf(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b); }
double distanceOf(const glm::dquat& a, const glm::dquat& b) {
    return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

// Centripetal: the parameter grows by the square root of the distance. `times` -> parameter is monotone.
template <class T>
T along(const std::vector<T>& points, const std::vector<double>& times, double seconds) {
    std::vector<double> knots(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        knots[i] = knots[i - 1] + std::sqrt(distanceOf(points[i - 1], points[i]));
    return curve(points, knots, segmentOf(times, seconds), monotone(times, knots, seconds));
}

glm::dquat orientationOf(const Camera& camera) {
    const CameraAxes axes = cameraAxes(camera);
    return glm::normalize(glm::quat_cast(glm::dmat3(axes.right, axes.up, -axes.forward)));
}

double focusOf(const Camera& camera) {
    return glm::distance(glm::dvec3(camera.target), glm::dvec3(camera.eye));
}

std::vector<double> valuesOf(const std::vector<PathKey>& keys,
                             const std::function<double(const Camera&)>& value) {
    std::vector<double> values;
    for (const PathKey& key : keys) values.push_back(value(key.camera));
    return values;
}

// A vector that all keys have in common, but for rounding (1e-5 of the scale).
std::optional<glm::vec3> common(const std::vector<PathKey>& keys, glm::vec3 Camera::*member, double scale) {
    const glm::vec3 first = keys.front().camera.*member;
    for (const PathKey& key : keys)
        if (glm::distance(glm::dvec3(key.camera.*member), glm::dvec3(first)) > 1e-5 * scale)
            return std::nullopt;
    return first;
}

}  // namespace

void CameraPath::add(double seconds, const Camera& camera, std::optional<double> hour) {
    const auto at = std::lower_bound(keys_.begin(), keys_.end(), seconds,
                                     [](const PathKey& key, double s) { return key.seconds < s; });
    if (at == keys_.end() || at->seconds != seconds) {
        keys_.insert(at, {seconds, camera, hour});
        return;
    }
    at->camera = camera;
    if (hour) at->hour = hour;
}

void CameraPath::remove(std::size_t index) {
    keys_.erase(keys_.begin() + static_cast<std::ptrdiff_t>(index));
}

double CameraPath::freeTime(std::size_t index, double seconds, double gap) const {
    const double low = index > 0 ? keys_[index - 1].seconds + gap : 0;
    const double high = index + 1 < keys_.size() ? keys_[index + 1].seconds - gap : std::max(seconds, low);
    return low > high ? keys_[index].seconds : std::clamp(seconds, low, high);
}

// Between keys of both kinds perspective; from one of parallel rays to the next by the height's logarithm.
float CameraPath::orthographicHeightAt(double seconds) const {
    const auto after = std::upper_bound(keys_.begin(), keys_.end(), seconds,
                                        [](double s, const PathKey& key) { return s < key.seconds; });
    if (!(after - 1)->camera.isOrthographic() || !after->camera.isOrthographic()) return 0;
    std::vector<double> times;
    for (const PathKey& key : keys_) times.push_back(key.seconds);
    const auto logOfHeight = [](const Camera& c) {
        return std::log(static_cast<double>(c.heightAt(static_cast<float>(focusOf(c)))));
    };
    return static_cast<float>(std::exp(monotone(times, valuesOf(keys_, logOfHeight), seconds)));
}

Camera CameraPath::at(double seconds) const {
    if (!(seconds > start())) return keys_.front().camera;
    if (seconds >= end()) return keys_.back().camera;
    for (const PathKey& key : keys_)
        if (key.seconds == seconds) return key.camera;

    const std::vector<double> times = [&] {
        std::vector<double> all;
        for (const PathKey& key : keys_) all.push_back(key.seconds);
        return all;
    }();
    std::vector<glm::dvec3> eyes;
    std::vector<glm::dquat> turns;
    for (const PathKey& key : keys_) {
        eyes.emplace_back(key.camera.eye);
        glm::dquat turn = orientationOf(key.camera);
        if (!turns.empty() && glm::dot(turns.back(), turn) < 0) turn = -turn;  // the short way round
        turns.push_back(turn);
    }
    const auto value = [&](const std::function<double(const Camera&)>& of) {
        return monotone(times, valuesOf(keys_, of), seconds);
    };

    const glm::dvec3 eye = along(eyes, times, seconds);
    const glm::dquat turn = along(turns, times, seconds);
    const double focus = std::exp(value([](const Camera& c) { return std::log(focusOf(c)); }));
    Camera camera;
    camera.eye = glm::vec3(eye);
    camera.target = glm::vec3(eye + focus * (turn * glm::dvec3(0, 0, -1)));
    const std::optional<glm::vec3> point = common(keys_, &Camera::target, focus);
    if (point && glm::distance(eye, glm::dvec3(*point)) > 1e-3 * focus) camera.target = *point;
    // Level keys stay level between; not while looking along that vector, which leaves the picture's turn
    // open.
    const std::optional<glm::vec3> up = common(keys_, &Camera::up, 1);
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    camera.up = glm::vec3(turn * glm::dvec3(0, 1, 0));
    if (up && std::abs(glm::dot(forward, glm::normalize(*up))) < 0.999f) camera.up = *up;
    camera.fovY = static_cast<float>(value([](const Camera& c) { return double(c.fovY); }));
    camera.zNear = static_cast<float>(value([](const Camera& c) { return double(c.zNear); }));
    camera.zFar = static_cast<float>(value([](const Camera& c) { return double(c.zFar); }));
    camera.lensDiameter =
        std::max(static_cast<float>(value([](const Camera& c) { return double(c.lensDiameter); })), 0.0f);
    if (std::any_of(keys_.begin(), keys_.end(), [](const auto& key) { return key.camera.focusDistance > 0; }))
        camera.focusDistance =
            std::max(static_cast<float>(value([](const Camera& c) { return double(c.focus()); })), 0.0f);
    camera.orthographicHeight = orthographicHeightAt(seconds);
    return camera;
}

Camera CameraPath::frame(int index, int count) const { return at(frameSeconds(index, count)); }

double CameraPath::frameSeconds(int index, int count) const {
    return count < 2 ? start() : start() + (end() - start()) * index / (count - 1);
}

std::optional<double> CameraPath::hourAt(double seconds) const {
    std::vector<double> times, hours;
    for (const PathKey& key : keys_) {
        if (!key.hour) continue;
        times.push_back(key.seconds);
        hours.push_back(*key.hour);
    }
    if (times.empty()) return {};
    const double hour = seconds <= times.front()  ? hours.front()
                        : seconds >= times.back() ? hours.back()
                                                  : monotone(times, hours, seconds);
    return hour > 24 ? hour - 24 : hour;
}

Camera turntableFrame(const Camera& camera, int index, int count) {
    const float angle = 6.2831853f * static_cast<float>(index) / static_cast<float>(count);
    Camera turned = camera;
    turned.eye = camera.target + glm::vec3(glm::rotate(glm::mat4(1), angle, camera.up) *
                                           glm::vec4(camera.eye - camera.target, 0));
    return turned;
}

}  // namespace conelight::program
