// SPDX-License-Identifier: MIT
// The camera goes round its target until it is stopped, or something else moves it: session + seconds that have gone
// by -> the session's camera.
#pragma once

#include <optional>

#include "session/session.h"
#include "viewer/camera_control.h"

namespace conelight::program {

class Turntable {
  public:
    static constexpr float kSeconds = 12;  // once round, by eye

    void start(const Session& session, float secondsPerTurn = kSeconds) {
        last_ = session.camera();
        secondsPerTurn_ = secondsPerTurn;
    }
    void stop() { last_.reset(); }
    void toggle(const Session& session) { turns() ? stop() : start(session); }
    bool turns() const { return last_.has_value(); }
    void step(Session& session, double seconds) {
        if (!last_) return;
        if (!(*last_ == session.camera())) return stop();
        Camera camera = session.camera();
        orbit(camera, {6.2831853f * static_cast<float>(seconds) / secondsPerTurn_, 0});
        session.moveCamera(camera);
        last_ = session.camera();
    }

  private:
    std::optional<Camera> last_;  // where it has put the camera; nothing: it stands
    float secondsPerTurn_ = kSeconds;
};

}  // namespace conelight::program
