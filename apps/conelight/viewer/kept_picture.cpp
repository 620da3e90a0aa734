// SPDX-License-Identifier: MIT
#include "viewer/kept_picture.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "conelight/error.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr float kZoomStep = 1.25f;
constexpr float kLargestPixel = 256;  // window units
constexpr float kNumbersFrom = 4.2f;  // heights of text: the edge of a pixel that holds its numbers
constexpr ImU32 kGround = IM_COL32(20, 20, 20, 200), kLetters = IM_COL32(230, 230, 230, 255);

ImVec2 vec(const glm::vec2& v) { return {v.x, v.y}; }

}  // namespace

void KeptPicture::keep(const Image& picture, const std::string& label) {
    layers_ = {{"", picture}};
    layer_ = 0;
    label_ = label;
    ++version_;
    showWhole();
}

void KeptPicture::open(const std::string& file, const std::string& layer) {
    std::vector<PictureLayer> read = readLayers(file);
    const auto found =
        std::find_if(read.begin(), read.end(), [&](const PictureLayer& each) { return each.name == layer; });
    if (found == read.end()) {
        std::string known;
        for (std::size_t i = 1; i < read.size(); ++i) known += (i > 1 ? ", " : "") + read[i].name;
        throw Error(ErrorKind::BadInput, fmt::format("{}: has no layer '{}'; {} would be right", file, layer,
                                                     known.empty() ? "none" : known));
    }
    layer_ = static_cast<std::size_t>(found - read.begin());
    layers_ = std::move(read);
    label_ = file;
    ++version_;
    showWhole();
}

void KeptPicture::chooseLayer(std::size_t layer) {
    if (layer >= layers_.size() || layer == layer_) return;
    layer_ = layer;
    ++version_;
}

void KeptPicture::showWhole() {
    zoom_ = 1;
    middle_ = glm::vec2(0.5f);
}

std::uint32_t KeptPicture::texture(const ImageSettings& look) {
    if (!any()) return 0;
    if (textureVersion_ != version_ || look_ != look)
        texture_.update(linear().width, linear().height, toneMapped(linear(), look));
    textureVersion_ = version_;
    look_ = look;
    return texture_.name();
}

std::string KeptPicture::label() const {
    if (!any()) return "A: nothing kept yet";
    const std::string& layer = layers_[layer_].name;
    return "A: " + label_ + (layer.empty() ? "" : "  " + layer);
}

std::string KeptPicture::text() const {
    if (!any()) return "none";
    return fmt::format("{}, layer {} of {}, {} x {} pixels, {}, zoom {:.3g}", label(), layer_ + 1,
                       layers_.size(), linear().width, linear().height, shown ? "shown" : "not shown", zoom_);
}

glm::vec4 KeptPicture::at(const glm::ivec2& pixel) const {
    return linear().pixels[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(linear().width) +
                           static_cast<std::size_t>(pixel.x)];
}

KeptPicture::Frame KeptPicture::frameIn(const glm::vec2& at, const glm::vec2& size) const {
    const glm::vec2 pixels(linear().width, linear().height);
    Frame frame;
    frame.pixel = zoom_ * std::min(size.x / pixels.x, size.y / pixels.y);
    frame.low = at + 0.5f * size - middle_ * pixels * frame.pixel;
    return frame;
}

void KeptPicture::takeMouse(const glm::vec2& at, const glm::vec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 pixels(linear().width, linear().height), mouse(io.MousePos.x, io.MousePos.y);
    if (io.MouseWheel != 0) {
        const Frame before = frameIn(at, size);
        const glm::vec2 under = (mouse - before.low) / before.pixel;
        const float largest = std::max(kLargestPixel * zoom_ / before.pixel, 1.0f);
        zoom_ = std::clamp(zoom_ * std::pow(kZoomStep, io.MouseWheel), 1.0f, largest);
        // What is under the mouse stays there.
        const float pixel = frameIn(at, size).pixel;
        middle_ = (under + (at + 0.5f * size - mouse) / pixel) / pixels;
    }
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1) ||
        ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 1))
        middle_ -= glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / (frameIn(at, size).pixel * pixels);
    if (zoom_ <= 1) middle_ = glm::vec2(0.5f);
    middle_ = glm::clamp(middle_, glm::vec2(0), glm::vec2(1));
}

void KeptPicture::show(const ImageSettings& look, const glm::vec2& at, const glm::vec2& size, bool hovered) {
    if (hovered) takeMouse(at, size);
    const Frame frame = frameIn(at, size);
    const glm::vec2 extent = frame.pixel * glm::vec2(linear().width, linear().height);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect(vec(at), vec(at + size), true);
    list->AddRectFilled(vec(at), vec(at + size), IM_COL32(38, 38, 38, 255));
    list->AddImage((ImTextureID)(static_cast<std::uintptr_t>(texture(look))), vec(frame.low),
                   vec(frame.low + extent));
    notePlace("kept", frame.low, frame.low + extent);
    if (frame.pixel >= kNumbersFrom * ImGui::GetFontSize()) showNumbers(frame, at, size);
    if (hovered) showPixel(frame, at, size);
    list->PopClipRect();
    if (layers_.size() > 1) showLayers(at, size);
}

// Red, green and blue in every pixel.
void KeptPicture::showNumbers(const Frame& frame, const glm::vec2& at, const glm::vec2& size) const {
    const glm::ivec2 last(linear().width - 1, linear().height - 1);
    const glm::ivec2 from = glm::clamp(glm::ivec2((at - frame.low) / frame.pixel), glm::ivec2(0), last);
    const glm::ivec2 to = glm::clamp(glm::ivec2((at + size - frame.low) / frame.pixel), glm::ivec2(0), last);
    const float em = ImGui::GetFontSize();
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            const glm::vec4 value = this->at({x, y});
            const std::string words = fmt::format("{:.3g}\n{:.3g}\n{:.3g}", value.x, value.y, value.z);
            const glm::vec2 place = frame.low + frame.pixel * glm::vec2(x, y) + 0.35f * em;
            // Letters with a shadow are read on every ground.
            list->AddText({place.x + 1, place.y + 1}, IM_COL32(0, 0, 0, 255), words.c_str());
            list->AddText(vec(place), IM_COL32(255, 255, 255, 255), words.c_str());
        }
}

// The numbers of the pixel under the cursor.
void KeptPicture::showPixel(const Frame& frame, const glm::vec2& at, const glm::vec2& size) const {
    const glm::vec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    const glm::ivec2 pixel(glm::floor((mouse - frame.low) / frame.pixel));
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= linear().width || pixel.y >= linear().height) return;
    const glm::vec4 v = this->at(pixel);
    const std::string words =
        fmt::format("{} {}:  {:.5g}  {:.5g}  {:.5g}  alpha {:.3g}", pixel.x, pixel.y, v.x, v.y, v.z, v.w);
    const float em = ImGui::GetFontSize();
    const glm::vec2 low = at + glm::vec2(0.5f * em, size.y - 2 * em);
    const glm::vec2 extent(ImGui::CalcTextSize(words.c_str()).x + em, 1.5f * em);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(vec(low), vec(low + extent), kGround, 4);
    list->AddText(vec(low + glm::vec2(0.5f, 0.25f) * em), kLetters, words.c_str());
    notePlace("kept:pixel", low, low + extent);
}

void KeptPicture::showLayers(const glm::vec2& at, const glm::vec2& size) {
    const float em = ImGui::GetFontSize();
    const float rows = std::min(static_cast<float>(layers_.size()), std::max(size.y / (1.6f * em) - 4, 3.0f));
    ImGui::SetCursorScreenPos({at.x + 0.5f * em, at.y + 2.5f * em});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, kGround);
    ImGui::BeginChild("layers", {11 * em, rows * ImGui::GetTextLineHeightWithSpacing() + 0.5f * em});
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const std::string name = layers_[i].name.empty() ? "picture" : layers_[i].name;
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable((" " + name).c_str(), i == layer_)) chooseLayer(i);
        ImGui::PopID();
        notePlace("layer:" + name);
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

}  // namespace conelight::program
