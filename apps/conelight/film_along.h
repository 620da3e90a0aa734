// SPDX-License-Identifier: MIT
// A session along the camera path of a file, frame by frame: where the camera is, and the scene in the light of the hour.
#pragma once

#include <optional>
#include <string>

#include "command.h"
#include "hour_of_day.h"
#include "session/camera_path.h"
#include "session/session.h"

namespace conelight::program {

class FilmAlong {
  public:
    // `opened`: the scene that openScene() made of `scene` and `view`. Throws what reading the file throws, and Error(Usage) for
    // hours that the scene has none of.
    FilmAlong(const std::string& file, const std::string& scene, const ViewOptions& view,
              const Scene& opened);
    const CameraPath& keys() const { return keys_; }
    // Lights the session's scene, which has only been lit by this film so far, as at that time. Returns the camera.
    Camera show(Session& session, double seconds);

  private:
    CameraPath keys_;
    std::optional<HourOfDay> hours_;
    std::optional<Scene> shown_;  // with hours
};

}  // namespace conelight::program
