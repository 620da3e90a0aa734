// SPDX-License-Identifier: MIT
// A pixel's cones and rays as lines over a picture: axes, footprints of cones at their steps, the faces that
// rays met. Points behind surfaces are found by rays from the eye (Picker), piece by piece.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "conelight/inspect.h"
#include "conelight/renderer.h"
#include "conelight/scene.h"

namespace conelight::program {

struct PictureLine {
    glm::vec2 from{0}, to{0};  // in parts of the picture, (0,0) upper left, (1,1) lower right
    glm::vec3 color{1};        // for a screen, 0..1
    float opacity = 1;
};

// Whether the eye sees a point of space.
using SeesPoint = std::function<bool(const glm::vec3&)>;

// `chosen`: the path that stands out, -1 none. Hidden pieces are faint.
std::vector<PictureLine> inspectionLines(const PixelInspection& pixel, const Camera& camera, float aspect,
                                         int chosen, const SeesPoint& sees);
// The line in the picture: points half a pixel apart, each shared between its four pixels.
void drawLine(Image& image, const PictureLine& line, float brightness);
// Where the camera sees a point, in parts of the picture; nothing behind its near plane.
std::optional<glm::vec2> pictureOf(const Camera& camera, float aspect, const glm::vec3& point);

class Picker;
class Session;
// By the session's triangles.
SeesPoint seenFrom(Picker& picker, const Session& session);

}  // namespace conelight::program
