// SPDX-License-Identifier: MIT
// The middle of the window: the picture, or two with a split that can be dragged, the error of one against
// the other laid over; the mouse and keys that move the camera and pick.
//
//   right drag: look round; with it W A S D, Q E: fly    left drag: orbit    middle drag: pan
//   wheel: nearer, farther; with Ctrl: field of view      left click: select and inspect
//   with Ctrl or Shift: select beside the others          right click: a menu of what is there
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/render_thread.h"
#include "platform/window.h"
#include "session/session.h"
#include "viewer/gizmo.h"
#include "viewer/kept_picture.h"
#include "viewer/light_shapes.h"
#include "viewer/moving_resolution.h"
#include "viewer/picture_key.h"
#include "viewer/picture_slot.h"
#include "viewer/scopes_panel.h"
#include "viewer/turntable.h"
#include "viewer/view_guides.h"

namespace conelight::program {

struct Split {
    bool on = false;
    std::string mode = "reference";  // of the right side; "kept": the picture that was kept
    float position = 0.5f;           // of the picture's width
    bool errors = false;             // the right side shows the left one's error against it
    float errorScale = 1.0f;         // error that is white, relative to the mean radiance
};

// Of the headlight when it is switched on, W/m^2: by it a white wall before the eye is half as bright as white on the
// screen. An exposure that finds itself follows what there is.
float headlightFor(const ImageSettings& image);

class PictureView {
  public:
    PictureView(platform::Window& window, const RendererOptions& options);
    ~PictureView();
    PictureView(const PictureView&) = delete;
    PictureView& operator=(const PictureView&) = delete;

    // Draws the pictures that are out of date into their textures. `areaPx`: pixels of the picture's place.
    // `userActs`: input came a moment ago, so that what only refines a slow picture waits. Returns whether
    // another call soon would improve them. Failures are said by takeError().
    bool update(const Session& session, const glm::ivec2& areaPx, bool userActs);
    void blank();  // shows nothing until the next update
    // Draws no more until something changes that the picture shows, or resume().
    void halt(const Session& session);
    void resume() { halted_.reset(); }
    bool halted() const { return halted_.has_value(); }
    std::optional<std::string> takeError();                           // of update, each once
    void setRadiosity(const reference::RadiositySettings& settings);  // of mode radiosity, before it is shown
    // The GUI part: shows the textures at the cursor, moves the camera, returns where it was clicked.
    struct Click {
        glm::vec2 part{0};  // of the picture's width and height, from the upper left corner
        bool adds = false;  // beside what is selected
        bool menu = false;  // of what is there
    };
    std::optional<Click> show(Session& session, const glm::vec2& at, const glm::vec2& size, float seconds);
    // The movement that runs or ran last: pictures, how long they took together, the longest wait for one.
    struct Movement {
        int pictures = 0;
        double seconds = 0, longest = 0;
        glm::ivec2 sizePx{0};  // of the last one
        double begun = 0, lastPicture = 0;
    };
    const Movement& movement() const { return movement_; }
    bool moving() const;  // input moved the camera or a slider a moment ago: pictures are coarse

    std::string notice;  // what is begun and takes long, said in the middle; empty: nothing
    Split split;
    Gizmo gizmo;
    KeptPicture kept;
    ScopesPanel scopes;
    ScopesPanel::Source
    shownPicture();  // that the scopes are of: the kept one while it is shown, else the left one
    ViewGuides guides;
    Turntable turntable;
    float headlight = 0;  // Renderer::setHeadlight of both sides
    LightShapes lights;
    MeshBounds bounds;
    float resolutionScale = 1.0f;  // of the still picture, 0.25..1
    PictureSlot& slot(bool right) { return right ? *right_ : *left_; }
    glm::ivec2 pictureSize() const;                    // of the left picture
    glm::ivec2 fullSize() const { return fullSize_; }  // of pictures at rest
    std::vector<std::string> reloadShaders();          // messages of those that fail
    bool showsOwn() const;                             // both sides show their mode's picture
    std::uint64_t parts() const { return left_->parts() + right_->parts(); }  // of pictures, so far
    bool drawing() const { return left_->drawing() || right_->drawing(); }  // parts of a picture are to come
    bool works() const { return left_->works() || right_->works(); }        // beside the window
    bool finished() const;  // nothing would refine what is shown
    // The picture on that side of the split, under which a click is looked up.
    PictureSlot& slotAt(float part) { return slot(rightIsLive() && !split.errors && part >= split.position); }

  private:
    bool takeInput(Session& session, const glm::vec2& size, bool hovered, float seconds);
    void showErrors();
    void beginMovement();
    void countPicture();
    bool rightIsLive() const { return split.on && split.mode != "kept"; }
    void updateRight(const Session& session, const glm::ivec2& size, const PictureSlot::How& how, bool& more);
    std::uint32_t rightTexture(const ImageSettings& look);

    platform::Window& window_;
    platform::RenderThread thread_;
    std::unique_ptr<PictureSlot> left_, right_;
    std::optional<PictureKey> halted_;  // the picture that is not drawn on
    struct Errors;
    std::unique_ptr<Errors> errors_;
    double lastMove_ = -1;    // of camera or scene
    double lastFlight_ = -2;  // of the camera
    std::uint64_t lastEdit_ = 0;
    MovingResolution movingResolution_;
    Movement movement_;
    bool wasMoving_ = false;
    double stillMs_ = 0;  // of a picture at rest
    glm::ivec2 fullSize_{0};
    bool dragged_ = false;
    bool draggingSplit_ = false;
    bool rightInUse_ = false;
    glm::dvec2 flyCursor_{0};
    // Of the right button: where it went down, whether it flew since, a click that was no flight.
    glm::vec2 rightFrom_{0};
    bool flown_ = false;
    std::optional<glm::vec2> menuAt_;
};

}  // namespace conelight::program
