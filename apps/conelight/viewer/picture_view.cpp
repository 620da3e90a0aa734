// SPDX-License-Identifier: MIT
#include "viewer/picture_view.h"

#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "conelight/error.h"
#include "conelight/memory.h"
#include "platform/picture_texture.h"
#include "reference/metrics.h"
#include "viewer/camera_control.h"
#include "viewer/imgui_names.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr double kStillAfter = 0.25;      // s without movement until the picture is drawn in full
constexpr double kMovingFrameMs = 100;    // while moving the resolution falls until a frame takes this
constexpr double kUnknownMs = 1e9;        // a picture of unknown cost: movement begins as coarse as it can
constexpr double kSlowFrameMs = 30;       // refinement of pictures that take longer waits for the user
constexpr float kTurnPerPixel = 0.0035f;  // rad; the original's 0.1 degrees at twice the speed, by hand
constexpr float kClickSlop = 4;           // px: a press that moved less is a click

// ImGui's clock stands still within a frame.
double wallSeconds() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(clock::now().time_since_epoch()).count();
}

glm::vec3 moveKeys(const platform::Window& window) {
    const auto axis = [&](int plus, int minus) {
        return static_cast<float>(window.isKeyDown(plus)) - static_cast<float>(window.isKeyDown(minus));
    };
    return {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
}

// Beside a picture of another shape than the area's, one that is drawn for a file: it is not stretched.
glm::vec2 marginOf(const glm::vec2& picture, const glm::vec2& area) {
    constexpr float kRounding = 1.02f;  // of sizes, which are a quarter of the screen's pixels in part
    if (picture.x < 1 || picture.y < 1) return glm::vec2(0);
    const float wider = (picture.x / picture.y) / (area.x / area.y);
    if (wider > kRounding) return {0, 0.5f * area.y * (1 - 1 / wider)};
    if (wider < 1 / kRounding) return {0.5f * area.x * (1 - wider), 0};
    return glm::vec2(0);
}

}  // namespace

float headlightFor(const ImageSettings& image) {
    constexpr float kHalfWhite = 0.5f * 3.1415927f;
    return kHalfWhite / std::exp2(image.exposure.resolve(0));
}

// The error map's texture and what it was made from.
struct PictureView::Errors {
    platform::PictureTexture texture;
    std::uint64_t leftVersion = 0, rightVersion = 0;
    std::string rightMode;
    float scale = 0;
};

PictureView::PictureView(platform::Window& window, const RendererOptions& options)
    : window_(window),
      thread_(window, memoryLimit() == 0),  // which holds for the process, whatever else it does meanwhile
      left_(std::make_unique<PictureSlot>(options, thread_)),
      right_(std::make_unique<PictureSlot>(options, thread_)),
      errors_(std::make_unique<Errors>()),
      movingResolution_(kMovingFrameMs) {}
PictureView::~PictureView() = default;

void PictureView::setRadiosity(const reference::RadiositySettings& settings) {
    left_->setRadiosity(settings);
    right_->setRadiosity(settings);
}

void PictureView::blank() {
    left_->blank();
    right_->blank();
}

void PictureView::halt(const Session& session) {
    left_->drop();
    right_->drop();
    halted_ = keyOf(session.revisions());
}

bool PictureView::moving() const { return lastMove_ >= 0 && ImGui::GetTime() - lastMove_ < kStillAfter; }

glm::ivec2 PictureView::pictureSize() const { return {left_->width(), left_->height()}; }

std::vector<std::string> PictureView::reloadShaders() {
    std::vector<std::string> failures = left_->reloadShaders();
    // Both sides use the same files.
    if (const auto more = right_->reloadShaders(); failures.empty()) failures = more;
    return failures;
}

std::optional<std::string> PictureView::takeError() {
    std::optional<std::string> error = left_->takeError();
    return error ? error : right_->takeError();
}

bool PictureView::showsOwn() const {
    return !moving() && left_->ownPicture() && (!rightIsLive() || right_->ownPicture());
}

bool PictureView::finished() const {
    return !moving() && left_->finished() && (!rightIsLive() || right_->finished());
}

bool PictureView::update(const Session& session, const glm::ivec2& areaPx, bool userActs) {
    if (areaPx.x < 8 || areaPx.y < 8) return false;
    if (halted_ && *halted_ == keyOf(session.revisions())) return false;
    resume();
    // A slider that is dragged changes the scene at each frame, as a camera that moves does. (What only
    // changes the look costs nothing: left_ does not draw it anew.)
    const std::uint64_t edits = session.revisions().sceneTables() + session.revisions().settings;
    if (!wasMoving_) stillMs_ = left_->frameMs() + (split.on ? right_->frameMs() : 0);
    const bool slow = stillMs_ > kSlowFrameMs || (drawing() && left_->version() == 0);
    if (std::exchange(lastEdit_, edits) != edits && ImGui::IsAnyItemActive() && slow &&
        !left_->onlyLook(session))
        lastMove_ = ImGui::GetTime();

    // A hand that holds a handle goes on: a picture in full would hold it up.
    if (gizmo.active() && slow) lastMove_ = ImGui::GetTime();
    if (session.playing() || session.clipState().playing || turntable.turns())
        lastMove_ = lastFlight_ = ImGui::GetTime();

    const bool coarse = moving();
    if (!std::exchange(wasMoving_, coarse) && coarse) beginMovement();
    const auto sizeAt = [&](float scale) {
        return glm::max(glm::ivec2(glm::round(glm::vec2(areaPx) * scale)), glm::ivec2(8));
    };
    fullSize_ = sizeAt(resolutionScale);
    const glm::ivec2 size = coarse ? sizeAt(std::min(movingResolution_.scale(), resolutionScale)) : fullSize_;
    PictureSlot::How how;
    how.still = !coarse;
    how.flying = coarse && lastFlight_ == lastMove_;
    how.onlyChanges = !coarse && userActs && slow;

    for (PictureSlot* side : {left_.get(), right_.get()}) side->setHeadlight(headlight);
    const std::uint64_t before = left_->version();
    bool more = left_->draw(session, session.shownMode(), size.x, size.y, how);
    updateRight(session, size, how, more);
    if (coarse && left_->version() != before) countPicture();
    if (coarse && left_->version() != before && left_->frameMs() > 0)
        movingResolution_.measured(left_->frameMs() + (split.on ? right_->frameMs() : 0));
    if (split.on && split.errors) showErrors();
    return more || moving();
}

void PictureView::beginMovement() {
    movement_ = {};
    movement_.begun = movement_.lastPicture = wallSeconds();
    // Before the first picture is finished nobody knows what one costs.
    const double known = left_->pixelsMs() + (split.on ? right_->pixelsMs() : 0);
    movingResolution_.begin(left_->version() > 0 ? known : kUnknownMs);
}

void PictureView::countPicture() {
    const double now = wallSeconds();
    ++movement_.pictures;
    movement_.seconds = now - movement_.begun;
    movement_.longest = std::max(movement_.longest, now - movement_.lastPicture);
    movement_.lastPicture = now;
    movement_.sizePx = pictureSize();
}

// The right side is freed when the split is closed; when it has no picture of the view, it shows the left
// one.
void PictureView::updateRight(const Session& session, const glm::ivec2& size, const PictureSlot::How& how,
                              bool& more) {
    if (std::exchange(rightInUse_, rightIsLive()) && !rightIsLive()) right_->clear();
    if (!rightIsLive()) return;
    PictureSlot::How right = how;
    right.preview = false;
    more = right_->draw(session, split.mode, size.x, size.y, right) || more;
}

std::uint32_t PictureView::rightTexture(const ImageSettings& look) {
    const bool has = rightIsLive() ? right_->ownPicture() : kept.any();
    if (!has) return left_->texture();
    if (split.errors) return errors_->texture.name();
    return rightIsLive() ? right_->texture() : kept.texture(look);
}

ScopesPanel::Source PictureView::shownPicture() {
    if (kept.shows()) return {"kept", kept.version(), [this]() -> const Image& { return kept.linear(); }};
    return {"live", left_->version(), [this]() -> const Image& { return left_->linear(); }};
}

void PictureView::showErrors() {
    const bool live = rightIsLive();
    if (!left_->ownPicture() || !(live ? right_->ownPicture() : kept.any())) return;
    const std::uint64_t rightVersion = live ? right_->version() : kept.version();
    const bool current = errors_->leftVersion == left_->version() && errors_->rightVersion == rightVersion &&
                         errors_->rightMode == split.mode && errors_->scale == split.errorScale;
    const Image& test = left_->linear();
    const Image& truth = live ? right_->linear() : kept.linear();
    if (current || test.width != truth.width || test.height != truth.height || test.pixels.empty()) return;
    std::vector<float> values;
    try {
        values = reference::errorValues(test, truth, reference::ErrorMap::Signed, {});
    } catch (const Error&) {
        return;  // no pixel is finite in both: there is no error to show
    }
    std::vector<std::uint8_t> rgb(3 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        reference::colorOfError(values[i] / split.errorScale, true, &rgb[3 * i]);
    errors_->texture.update(test.width, test.height, rgb);
    errors_->leftVersion = left_->version();
    errors_->rightVersion = rightVersion;
    errors_->rightMode = split.mode;
    errors_->scale = split.errorScale;
}

std::optional<PictureView::Click> PictureView::show(Session& session, const glm::vec2& at,
                                                    const glm::vec2& size, float seconds) {
    const auto note = [&](const char* key, float x, float y, float w, float h) {
        notePlace(key, {x, y}, {x + w, y + h});
    };
    note("picture", at.x, at.y, size.x, size.y);
    if (split.on) note("split", at.x + split.position * size.x - 3, at.y, 6, size.y);
    ImGui::SetCursorScreenPos({at.x, at.y});
    ImGui::InvisibleButton("picture", {std::max(size.x, 1.0f), std::max(size.y, 1.0f)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    const bool hovered = ImGui::IsItemHovered();
    const bool letGo = ImGui::IsItemDeactivated();  // by a press that began here, not in a panel
    if (kept.shows()) {
        kept.show(session.settings().image, at, size, hovered);
        return std::nullopt;
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 low{at.x, at.y}, high{at.x + size.x, at.y + size.y};
    if (left_->texture() != 0) {
        const glm::vec2 margin = marginOf({left_->width(), left_->height()}, size);
        list->AddImage(textureId(left_->texture()), {low.x + margin.x, low.y + margin.y},
                       {high.x - margin.x, high.y - margin.y});
    }

    if (split.on) {
        const float x = at.x + split.position * size.x;
        const std::uint32_t right = rightTexture(session.settings().image);
        if (right != 0) list->AddImage(textureId(right), {x, low.y}, high, {split.position, 0}, {1, 1});
        list->AddLine({x, low.y}, {x, high.y}, IM_COL32(235, 235, 235, 220), 2);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const bool onHandle = hovered && std::fabs(mouse.x - x) < 6;
        if (onHandle || draggingSplit_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        if (onHandle && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) draggingSplit_ = true;
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) draggingSplit_ = false;
        if (draggingSplit_) split.position = std::clamp((mouse.x - at.x) / size.x, 0.0f, 1.0f);
    }
    // A click that a handle takes neither moves the camera nor selects.
    const bool wasDragging = dragged_ || draggingSplit_ || gizmo.active();
    const bool points = hovered && !draggingSplit_ && !window_.cursorCaptured();
    if (left_->texture() != 0) lights.draw(session, bounds, at, size, points && !gizmo.active());
    gizmo.show(session, bounds, at, size, points);
    if (takeInput(session, size, hovered, seconds)) lastMove_ = lastFlight_ = ImGui::GetTime();

    if (const auto menu = std::exchange(menuAt_, std::nullopt); menu && left_->width() > 0)
        return Click{(*menu - at) / size, false, true};
    // A press and release in place.
    if (hovered && letGo && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !wasDragging &&
        left_->width() > 0) {
        const ImVec2 mouse = ImGui::GetIO().MousePos, from = ImGui::GetIO().MouseClickedPos[0];
        if (std::hypot(mouse.x - from.x, mouse.y - from.y) > kClickSlop) return std::nullopt;
        const bool adds = ImGui::GetIO().KeyCtrl || ImGui::GetIO().KeyShift;
        return Click{{(mouse.x - at.x) / size.x, (mouse.y - at.y) / size.y}, adds};
    }
    return std::nullopt;
}

bool PictureView::takeInput(Session& session, const glm::vec2& size, bool hovered, float seconds) {
    const ImGuiIO& io = ImGui::GetIO();
    Camera camera = session.camera();
    bool moved = false;

    // Flying: while the right button is down the cursor is the camera's.
    const bool rightDown = ImGui::IsMouseDown(ImGuiMouseButton_Right);
    if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        window_.captureCursor(true);
        flyCursor_ = window_.cursor();
        rightFrom_ = {io.MousePos.x, io.MousePos.y};
        flown_ = false;
    }
    if (window_.cursorCaptured()) {
        const glm::dvec2 cursor = window_.cursor();
        const glm::vec3 move = moveKeys(window_);
        // A press that hardly moves is a click.
        flown_ = flown_ || move != glm::vec3(0) || glm::length(cursor - flyCursor_) > double(kClickSlop);
        const glm::vec2 turn = flown_ ? glm::vec2(flyCursor_ - cursor) * kTurnPerPixel : glm::vec2(0);
        if (flown_) flyCursor_ = cursor;
        if (turn != glm::vec2(0) || move != glm::vec3(0)) {
            const float boost = io.KeyShift ? 4.0f : io.KeyCtrl ? 0.25f : 1.0f;
            fly(camera, {move, turn, std::min(seconds, 0.2f), boost * flySpeed(session.scene().bounds())});
            moved = true;
        }
        if (!rightDown && !window_.isKeyDown(GLFW_KEY_LEFT_ALT)) {
            window_.captureCursor(false);
            if (!flown_) menuAt_ = rightFrom_;
        }
    } else if (ImGui::IsItemActive() && !draggingSplit_ && !gizmo.active()) {
        const glm::vec2 delta(io.MouseDelta.x, io.MouseDelta.y);
        if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClickSlop)) dragged_ = true;
        if (dragged_ && delta != glm::vec2(0)) {
            orbit(camera, -delta * kTurnPerPixel * glm::vec2(1, -1) * glm::vec2(1, -1));
            moved = true;
        }
        if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) && delta != glm::vec2(0)) {
            pan(camera, delta, static_cast<int>(size.y));
            moved = true;
        }
    }
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragged_ = false;

    if (hovered && io.MouseWheel != 0) {
        if (io.KeyCtrl && !camera.isOrthographic())
            camera.fovY = std::clamp(camera.fovY - io.MouseWheel * 0.01745f, 0.01745f, 2.6f);
        else
            dolly(camera, std::pow(0.9f, io.MouseWheel));
        moved = true;
    }
    if (moved) session.moveCamera(camera);
    return moved;
}

}  // namespace conelight::program
