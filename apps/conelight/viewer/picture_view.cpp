// SPDX-License-Identifier: MIT
#include "viewer/picture_view.h"

#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "platform/picture_texture.h"
#include "reference/metrics.h"
#include "viewer/camera_control.h"

namespace conelight::program {
namespace {

constexpr double kStillAfter = 0.25;      // s without movement until the picture is drawn in full
constexpr double kMovingFrameMs = 100;    // while moving the resolution falls until a frame takes this
constexpr float kLeastScale = 0.125f;     // of the resolution
constexpr float kTurnPerPixel = 0.0035f;  // rad; the original's 0.1 degrees at twice the speed, by hand
constexpr float kClickSlop = 4;           // px: a press that moved less is a click

ImTextureID idOf(std::uint32_t texture) {
    return (
        ImTextureID)(static_cast<std::uintptr_t>(texture));  // an integer or a pointer, by ImGui's version
}

glm::vec3 moveKeys(const platform::Window& window) {
    const auto axis = [&](int plus, int minus) {
        return static_cast<float>(window.isKeyDown(plus)) - static_cast<float>(window.isKeyDown(minus));
    };
    return {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
}

}  // namespace

// The error map's texture and what it was made from.
struct PictureView::Errors {
    platform::PictureTexture texture;
    std::uint64_t leftVersion = 0, rightVersion = 0;
    float scale = 0;
};

PictureView::PictureView(platform::Window& window, std::string shaderDirectory, bool debugGl)
    : window_(window),
      left_(std::make_unique<PictureSlot>(shaderDirectory, debugGl)),
      right_(std::make_unique<PictureSlot>(shaderDirectory, debugGl)),
      errors_(std::make_unique<Errors>()) {}
PictureView::~PictureView() = default;

bool PictureView::moving() const { return lastMove_ >= 0 && ImGui::GetTime() - lastMove_ < kStillAfter; }

glm::ivec2 PictureView::pictureSize() const { return {left_->width(), left_->height()}; }

void PictureView::dropShaders() {
    left_->clear();
    right_->clear();
}

glm::ivec2 PictureView::drawnSize(const glm::ivec2& areaPx) const {
    const float scale = moving() ? std::min(movingScale_, resolutionScale) : resolutionScale;
    return glm::max(glm::ivec2(glm::round(glm::vec2(areaPx) * scale)), glm::ivec2(8));
}

bool PictureView::update(const Session& session, const glm::ivec2& areaPx) {
    if (areaPx.x < 8 || areaPx.y < 8) return false;
    const glm::ivec2 size = drawnSize(areaPx);
    const std::uint64_t before = left_->version();
    bool more = left_->draw(session, session.shownMode(), size.x, size.y, !moving());
    if (split.on)
        more = right_->draw(session, split.mode, size.x, size.y, !moving()) || more;
    else
        right_->clear();

    // Steer the resolution of the next moving frame by the time of this one: cost grows with the pixels.
    if (moving() && left_->version() != before && left_->frameMs() > 0) {
        const double cost = left_->frameMs() + (split.on ? right_->frameMs() : 0);
        const float wanted = movingScale_ * static_cast<float>(std::sqrt(kMovingFrameMs / cost));
        movingScale_ = std::clamp(0.5f * (movingScale_ + wanted), kLeastScale, 1.0f);
    }
    if (split.on && split.errors) showErrors();
    return more || moving();
}

void PictureView::showErrors() {
    const bool current = errors_->leftVersion == left_->version() &&
                         errors_->rightVersion == right_->version() && errors_->scale == split.errorScale;
    const Image& test = left_->linear();
    const Image& truth = right_->linear();
    if (current || test.width != truth.width || test.height != truth.height || test.pixels.empty()) return;
    const std::vector<float> values = reference::errorValues(test, truth, reference::ErrorMap::Signed, {});
    std::vector<std::uint8_t> rgb(3 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        reference::colorOfError(values[i] / split.errorScale, true, &rgb[3 * i]);
    errors_->texture.update(test.width, test.height, rgb);
    errors_->leftVersion = left_->version();
    errors_->rightVersion = right_->version();
    errors_->scale = split.errorScale;
}

std::optional<glm::ivec2> PictureView::show(Session& session, const glm::vec2& at, const glm::vec2& size,
                                            float seconds) {
    ImGui::SetCursorScreenPos({at.x, at.y});
    ImGui::InvisibleButton("picture", {std::max(size.x, 1.0f), std::max(size.y, 1.0f)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 low{at.x, at.y}, high{at.x + size.x, at.y + size.y};
    if (left_->texture() != 0) list->AddImage(idOf(left_->texture()), low, high);

    if (split.on) {
        const float x = at.x + split.position * size.x;
        const std::uint32_t right = split.errors ? errors_->texture.name() : right_->texture();
        if (right != 0) list->AddImage(idOf(right), {x, low.y}, high, {split.position, 0}, {1, 1});
        list->AddLine({x, low.y}, {x, high.y}, IM_COL32(235, 235, 235, 220), 2);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const bool onHandle = hovered && std::fabs(mouse.x - x) < 6;
        if (onHandle || draggingSplit_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        if (onHandle && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) draggingSplit_ = true;
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) draggingSplit_ = false;
        if (draggingSplit_) split.position = std::clamp((mouse.x - at.x) / size.x, 0.0f, 1.0f);
    }
    const bool wasDragging = dragged_ || draggingSplit_;
    if (takeInput(session, size, hovered, seconds)) lastMove_ = ImGui::GetTime();

    // A press and release in place.
    if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !wasDragging && left_->width() > 0) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const glm::vec2 part((mouse.x - at.x) / size.x, (mouse.y - at.y) / size.y);
        return glm::clamp(glm::ivec2(part * glm::vec2(pictureSize())), glm::ivec2(0), pictureSize() - 1);
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
    }
    if (window_.cursorCaptured()) {
        const glm::dvec2 cursor = window_.cursor();
        const glm::vec2 turn = glm::vec2(flyCursor_ - cursor) * kTurnPerPixel;
        flyCursor_ = cursor;
        const glm::vec3 move = moveKeys(window_);
        if (turn != glm::vec2(0) || move != glm::vec3(0)) {
            const float boost = io.KeyShift ? 4.0f : io.KeyCtrl ? 0.25f : 1.0f;
            fly(camera, {move, turn, std::min(seconds, 0.2f), boost * flySpeed(session.scene().bounds())});
            moved = true;
        }
        if (!rightDown && !window_.isKeyDown(GLFW_KEY_LEFT_ALT)) window_.captureCursor(false);
    } else if (ImGui::IsItemActive() && !draggingSplit_) {
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
        if (io.KeyCtrl)
            camera.fovY = std::clamp(camera.fovY - io.MouseWheel * 0.01745f, 0.01745f, 2.6f);
        else
            dolly(camera, std::pow(0.9f, io.MouseWheel));
        moved = true;
    }
    if (moved) session.moveCamera(camera);
    return moved;
}

}  // namespace conelight::program
