// SPDX-License-Identifier: MIT
// Where the window's pictures are drawn: on a software driver a thread with a context of its own, which shares its
// objects with the window's, so that the window answers while a program is built or a scene taken over. Elsewhere, and
// where the driver gives no second context: the window's own thread and context. Call it on the window's thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

struct GLFWwindow;

namespace conelight::platform {

class Window;

class RenderThread {
  public:
    // `beside`: false keeps the work on the window's thread.
    RenderThread(Window& window, bool beside);
    ~RenderThread();  // when all work is done
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    bool isBeside() const { return context_ != nullptr; }  // a thread of its own
    // Does the work after what was posted, and waits for it. Throws what it throws.
    void run(const std::function<void()>& work);
    // Does it later, in the order of the calls; it does not throw. What it holds is destroyed there.
    void post(std::function<void()> work);
    // Waits for all work, so long at most. Returns whether all is done; if not, the window is woken when it is.
    bool wait(double seconds);

  private:
    void loop();

    GLFWwindow* context_ = nullptr;  // of a window that is never shown
    std::mutex mutex_;               // guards what follows
    std::condition_variable changed_;
    std::deque<std::function<void()>> works_;
    bool working_ = false, ends_ = false, wakes_ = false;
    std::thread thread_;
};

}  // namespace conelight::platform
