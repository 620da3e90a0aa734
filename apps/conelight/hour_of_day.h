// SPDX-License-Identifier: MIT
// A scene at other hours of the day: generated scenes that have one as a parameter, and scenes under a generated sky.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "command.h"
#include "session/session.h"

namespace conelight::program {

class HourOfDay {
  public:
    // Of the scene that openScene() makes of these. Throws Error(Usage), starting with `from`, where nothing has an hour.
    HourOfDay(const std::string& from, std::string scene, const ViewOptions& view);
    // `hour`: 0 to 24. `scene` is the opened one at any hour; the result has its tables, lit otherwise.
    Scene at(const Scene& scene, double hour) const;

  private:
    std::string scene_;
    ViewOptions view_;
    bool ofScene_ = false, ofSky_ = false;
};

// What a camera path that sets hours needs; none: it sets none. `file`: its own, for errors.
std::optional<HourOfDay> hoursOf(const CameraPath& path, const std::string& file, const std::string& scene,
                                 const ViewOptions& view);

// `beforeFrame` of a film along the session's path, of that file: the scene is lit by the hour of the frame, too.
void addHours(std::function<void(Session&, int frame)>& beforeFrame, const std::string& file,
              const Session& session, const ViewOptions& view, const Request& film);

}  // namespace conelight::program
