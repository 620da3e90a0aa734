// SPDX-License-Identifier: MIT
// The middle of the window: the picture, or two with a split that can be dragged, the error of one against
// the other laid over; the mouse and keys that move the camera and pick.
//
//   right drag: look round; with it W A S D, Q E: fly    left drag: orbit    middle drag: pan
//   wheel: nearer, farther; with Ctrl: field of view      left click: select and inspect
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>

#include "platform/window.h"
#include "session/session.h"
#include "viewer/picture_slot.h"

namespace conelight::program {

struct Split {
    bool on = false;
    std::string mode = "reference";  // of the right side
    float position = 0.5f;           // of the picture's width
    bool errors = false;             // the right side shows the left one's error against it
    float errorScale = 1.0f;         // error that is white, relative to the mean radiance
};

class PictureView {
  public:
    PictureView(platform::Window& window, std::string shaderDirectory, bool debugGl);
    ~PictureView();
    PictureView(const PictureView&) = delete;
    PictureView& operator=(const PictureView&) = delete;

    // Draws the pictures that are out of date into their textures. `areaPx`: pixels of the picture's place.
    // Returns whether another call soon would improve them.
    bool update(const Session& session, const glm::ivec2& areaPx);
    // The GUI part: shows the textures at the cursor, moves the camera, returns the pixel that was clicked.
    std::optional<glm::ivec2> show(Session& session, const glm::vec2& at, const glm::vec2& size,
                                   float seconds);
    bool moving() const;  // input moved the camera a moment ago: pictures are coarse

    Split split;
    float resolutionScale = 1.0f;  // of the still picture, 0.25..1
    PictureSlot& slot(bool right) { return right ? *right_ : *left_; }
    glm::ivec2 pictureSize() const;  // of the left picture
    void dropShaders();              // after a change of the shader files

  private:
    bool takeInput(Session& session, const glm::vec2& size, bool hovered, float seconds);
    void showErrors();
    glm::ivec2 drawnSize(const glm::ivec2& areaPx) const;

    platform::Window& window_;
    std::unique_ptr<PictureSlot> left_, right_;
    struct Errors;
    std::unique_ptr<Errors> errors_;
    double lastMove_ = -1;
    float movingScale_ = 0.5f;
    bool dragged_ = false;
    bool draggingSplit_ = false;
    glm::dvec2 flyCursor_{0};
};

}  // namespace conelight::program
