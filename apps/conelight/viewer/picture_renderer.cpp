// SPDX-License-Identifier: MIT
#include "viewer/picture_renderer.h"

#include <chrono>
#include <utility>

#include "conelight/error.h"

namespace conelight::program {
namespace {

// s that the window waits for a piece before it looks for input again: longer than most pieces.
constexpr double kPatience = 0.05;

double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

bool PictureRenderer::make() {
    if (renderer_) return false;
    thread_.run([this] { renderer_ = std::make_unique<Renderer>(options_); });
    return true;
}

// It ends on its thread, after the piece it works on.
void PictureRenderer::free() {
    forget();
    if (!renderer_) return;
    thread_.post([ended = std::shared_ptr<Renderer>(std::move(renderer_))] {});
}

void PictureRenderer::run(const std::function<void(Renderer&)>& work) {
    thread_.run([&] { work(*renderer_); });
}

void PictureRenderer::begin(std::function<bool(Renderer&)> work) {
    piece_ = {true, true, false, nullptr, steadySeconds()};
    thread_.post([this, renderer = renderer_.get(), work = std::move(work)] {
        try {
            piece_.finished = work(*renderer);
        } catch (...) {
            piece_.failure = std::current_exception();
        }
    });
}

bool PictureRenderer::rests() {
    if (!thread_.wait(kPatience)) return false;
    inspecting_ = false;
    if (!std::exchange(piece_.running, false)) return true;
    ++pieces_;
    piece_.finished = piece_.finished && piece_.wanted;
    const std::exception_ptr failure = std::exchange(piece_.failure, nullptr);
    if (failure && piece_.wanted) std::rethrow_exception(failure);
    return true;
}

bool PictureRenderer::worksSince(double seconds) const {
    return piece_.running && steadySeconds() - piece_.begun >= seconds;
}

void PictureRenderer::beginInspection(const glm::ivec2& pixel) {
    inspection_.reset();
    inspecting_ = true;
    thread_.post([this, pixel, renderer = renderer_.get()] {
        try {
            inspection_ = renderer->inspectPixel(pixel.x, pixel.y);
        } catch (const std::exception&) {
            // The picture changed its size since the click: there is nothing to show.
        }
    });
}

std::optional<PixelInspection> PictureRenderer::takeInspection() {
    if (inspecting_) return std::nullopt;
    return std::exchange(inspection_, std::nullopt);
}

}  // namespace conelight::program
