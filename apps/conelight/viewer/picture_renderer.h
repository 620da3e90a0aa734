// SPDX-License-Identifier: MIT
// The renderer of a picture in the window, on the render thread. Work that may take long goes on beside the window,
// one piece at a time: a part of a picture, a scene that is taken over, what a pixel gathers.
#pragma once

#include <exception>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "conelight/renderer.h"
#include "platform/render_thread.h"

namespace conelight::program {

class PictureRenderer {
  public:
    // Its textures have the top row first, as those of files.
    PictureRenderer(RendererOptions options, platform::RenderThread& thread)
        : options_(std::move(options)), thread_(thread) {
        options_.rows = RowOrder::TopFirst;
    }
    ~PictureRenderer() { thread_.wait(kForever), free(); }

    explicit operator bool() const { return renderer_ != nullptr; }
    bool isBeside() const { return thread_.isBeside(); }  // the window; else begin() works at once
    bool make();                                          // unless there is one; returns whether it did
    void free();
    // Of a renderer whose thread rests: what asks no driver.
    const Renderer& resting() const { return *renderer_; }
    // Waits for what was begun, and throws what the work throws.
    void run(const std::function<void(Renderer&)>& work);
    // A piece beside the window; the work returns whether the picture is finished.
    void begin(std::function<bool(Renderer&)> work);
    // Whether the thread rests, after a moment's wait. Throws once what the piece threw.
    bool rests();
    bool takeFinished() {
        return std::exchange(piece_.finished, false);
    }                                         // of a piece that rests() saw ended
    void forget() { piece_.wanted = false; }  // what the piece finds
    bool works() const { return piece_.running; }
    // What the renderer is at, and whether the piece has run for so long, s.
    PictureWork work() const { return renderer_ ? renderer_->work() : PictureWork{}; }
    bool worksSince(double seconds) const;
    std::uint64_t pieces() const { return pieces_; }  // ended so far, of pictures

    void beginInspection(const glm::ivec2& pixel);
    bool inspecting() const { return inspecting_; }
    std::optional<PixelInspection> takeInspection();

  private:
    static constexpr double kForever = 1e6;  // s

    struct Piece {
        bool running = false, wanted = false;  // the window's, as `begun`: by the steady clock, s
        bool finished = false;                 // the thread's, until rests() has seen it end, as what follows
        std::exception_ptr failure;
        double begun = 0;
    };
    RendererOptions options_;
    platform::RenderThread& thread_;
    std::unique_ptr<Renderer> renderer_;
    Piece piece_;
    bool inspecting_ = false;
    std::optional<PixelInspection> inspection_;  // the thread's, while inspecting_ and it does not rest
    std::uint64_t pieces_ = 0;
};

}  // namespace conelight::program
