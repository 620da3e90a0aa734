// SPDX-License-Identifier: MIT
// A camera's way through key frames: cameras with times -> the camera at any time between.
// Positions: centripetal Catmull-Rom curves (Yuksel, Schaefer and Keyser 2011: no loops, no cusps within a
// segment), by Barry and Goldman's pyramid of interpolations (1988). Orientations: the same pyramid with
// slerp in place of lerp (Schlag 1991). Time to curve parameter, focus distance and field of view: monotone
// cubics (Fritsch and Butland 1984), which do not overshoot, so that the camera never runs backward. Where
// all keys look at one point, or have one up vector, so does every camera between. A function of keys and
// time alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conelight/scene.h"

namespace conelight::program {

struct PathKey {
    double seconds = 0;
    Camera camera;
    std::optional<double> hour;  // of the day, 0 to 48: above 24 of the next
};

class CameraPath {
  public:
    const std::vector<PathKey>& keys() const { return keys_; }
    bool empty() const { return keys_.empty(); }
    double start() const { return keys_.empty() ? 0 : keys_.front().seconds; }
    double end() const { return keys_.empty() ? 0 : keys_.back().seconds; }

    // In order of time; a key at the same time gets this camera, and the hour if there is one.
    void add(double seconds, const Camera& camera, std::optional<double> hour = {});
    void remove(std::size_t index);
    // To a time between its neighbours, which keep theirs.
    void move(std::size_t index, double seconds) { keys_[index].seconds = seconds; }
    // The time next to `seconds` at which key `index` keeps a gap to its neighbours.
    double freeTime(std::size_t index, double seconds, double gap) const;

    // Before the first key the first, behind the last the last; at a key's time that key's camera, bit for
    // bit. There is a key.
    Camera at(double seconds) const;
    // Frame `index` of `count` from start to end, both included.
    Camera frame(int index, int count) const;
    double frameSeconds(int index, int count) const;
    // Hour of the day, 0 to 24, by a monotone cubic through the keys that have one; before the first of them and behind
    // the last, theirs. None: no key has.
    std::optional<double> hourAt(double seconds) const;

  private:
    float orthographicHeightAt(double seconds) const;
    std::vector<PathKey> keys_;
};

// Angle in 360 degrees round `camera`'s target: frame `index` of `count`, the first where it stands.
Camera turntableFrame(const Camera& camera, int index, int count);

// JSON (docs/reference/camera_path.md). Reading throws Error(BadInput) "FILE:LINE: what is wrong; what would
// be right", writing Error(Runtime), and Error(Usage) when there is a file and not `overwrite`.
CameraPath readCameraPath(const std::string& file);
void writeCameraPath(const std::string& file, const CameraPath& path, bool overwrite);

}  // namespace conelight::program
