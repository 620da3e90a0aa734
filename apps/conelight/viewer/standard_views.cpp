// SPDX-License-Identifier: MIT
#include "viewer/standard_views.h"

#include <algorithm>

#include "viewer/camera_control.h"
#include "viewer/focus.h"

namespace conelight::program {

void viewFrom(Session& session, const std::string& side, const glm::ivec2& pictureSize) {
    constexpr float kQuarter = 1.5707963f;
    const float yaw = side == "back"    ? 2 * kQuarter
                      : side == "right" ? kQuarter
                      : side == "left"  ? -kQuarter
                                        : 0;
    const float pitch = side == "top" ? -kMaxPitch : side == "bottom" ? kMaxPitch : 0;
    Camera camera = session.camera();
    camera.up = {0, 1, 0};
    camera.eye = camera.target - viewDirection({yaw, pitch});
    // Parallel rays straight down show no sides; the up vector says which edge of the picture is north.
    if (camera.isOrthographic() && pitch != 0) {
        camera.up = {0, 0, pitch < 0 ? -1 : 1};
        camera.eye = camera.target - glm::vec3(0, pitch < 0 ? -1 : 1, 0);
    }
    focusOn(camera, selectedBounds(session), aspectOf(pictureSize));
    session.jumpCamera(camera, "view from " + side);
}

std::string keepView(Session& session) {
    std::vector<Camera> cameras = session.scene().cameras;
    Camera camera = session.camera();
    const auto taken = [&] {
        return std::any_of(cameras.begin(), cameras.end(),
                           [&](const Camera& one) { return one.name == camera.name; });
    };
    int number = 0;
    do camera.name = "view " + std::to_string(++number);
    while (taken());
    cameras.push_back(camera);
    session.setCameras(cameras, "camera add " + camera.name);
    return camera.name;
}

void nextCamera(Session& session, bool before) {
    const std::vector<Camera>& cameras = session.scene().cameras;
    if (cameras.empty()) return;
    const auto now = std::find(cameras.begin(), cameras.end(), session.camera());
    const std::size_t count = cameras.size();
    // From a view that is none of them to the first or the last.
    const std::size_t last =
        now == cameras.end() ? (before ? 0 : count - 1) : static_cast<std::size_t>(now - cameras.begin());
    const Camera& next = cameras[(last + (before ? count - 1 : 1)) % count];
    session.jumpCamera(next, "camera " + next.name);
}

}  // namespace conelight::program
