// SPDX-License-Identifier: MIT
// How input moves a camera: flying (the original's keys) and orbiting round a pivot. Pure functions of camera
// and input, so that tests and camera paths use them as the window does.
#pragma once

#include <glm/glm.hpp>

#include "conelight/scene.h"

namespace conelight::program {

// The view direction as two angles: yaw 0 looks along -z, grows to the left; pitch grows upwards. rad.
struct ViewAngles {
    float yaw = 0;
    float pitch = 0;
};
ViewAngles viewAngles(const Camera& camera);
glm::vec3 viewDirection(const ViewAngles& angles);  // unit

// What the camera turns about, unit: +y where its picture is level, else its own up vector, as of a camera that is
// rolled or upside down. The movements below keep it.
glm::vec3 turnAxis(const Camera& camera);

// Steepest pitch: the up vector must not line up with the view. The original's 89 degrees.
constexpr float kMaxPitch = 1.5533430f;

struct FlyInput {
    glm::vec3 move{0};  // right, up, forward; each -1..1
    glm::vec2 turn{0};  // rad: to the left, upwards
    float seconds = 0;
    float speed = 1;  // m/s
};
void fly(Camera& camera, const FlyInput& input);

// Turns round the target; its distance stays.
void orbit(Camera& camera, const glm::vec2& turn);
// Moves eye and target across the view, so that a point at the target's distance follows the cursor.
// `pixels` of a picture `height` pixels high; y down.
void pan(Camera& camera, const glm::vec2& pixels, int height);
// Eye towards the target: factor < 1 nearer. The target is never reached. Of parallel rays the height changes, and the
// eye steps back as far as perspective would, so that nothing is cut off before it.
void dolly(Camera& camera, float factor);
// Keeps the direction, shows the whole of `bounds`.
void focusOn(Camera& camera, const Aabb& bounds, float aspect);
// A speed at which a scene of that size is crossed in about 4 s (the original's 4 m/s in its 2 m scenes is
// too fast to look round; chosen by eye).
float flySpeed(const Aabb& bounds);

}  // namespace conelight::program
