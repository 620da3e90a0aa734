// SPDX-License-Identifier: MIT
#include "platform/render_thread.h"

#include <epoxy/gl.h>
// After epoxy: GLFW must not bring in its own GL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <chrono>
#include <cstring>
#include <exception>
#include <utility>

#include "platform/window.h"

namespace conelight::platform {
namespace {

bool drawsOnProcessor() {
    const char* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name != nullptr &&
           (std::strstr(name, "llvmpipe") != nullptr || std::strstr(name, "softpipe") != nullptr);
}

}  // namespace

RenderThread::RenderThread(Window& window, bool beside) {
    if (!beside || !drawsOnProcessor()) return;
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);  // the other hints are still the window's
    context_ = glfwCreateWindow(16, 16, "pictures", nullptr, window.handle());
    if (context_ != nullptr) thread_ = std::thread([this] { loop(); });
}

RenderThread::~RenderThread() {
    if (context_ == nullptr) return;
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
    glfwDestroyWindow(context_);
}

void RenderThread::run(const std::function<void()>& work) {
    if (context_ == nullptr) return work();
    glFinish();  // the GUI's last frame has read what the work may write
    std::exception_ptr failure;
    bool done = false;
    post([&] {
        try {
            work();
        } catch (...) {
            failure = std::current_exception();
        }
        glFinish();
        const std::lock_guard lock(mutex_);
        done = true;
        changed_.notify_all();
    });
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done; });
    lock.unlock();
    if (failure) std::rethrow_exception(failure);
}

void RenderThread::post(std::function<void()> work) {
    if (context_ == nullptr) return work();
    {
        const std::lock_guard lock(mutex_);
        works_.push_back(std::move(work));
    }
    changed_.notify_all();
}

bool RenderThread::wait(double seconds) {
    std::unique_lock lock(mutex_);
    const bool done = changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                                        [this] { return works_.empty() && !working_; });
    wakes_ = !done;
    return done;
}

void RenderThread::loop() {
    glfwMakeContextCurrent(context_);
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ends_ || !works_.empty(); });
        if (works_.empty()) break;
        std::function<void()> work = std::move(works_.front());
        works_.pop_front();
        working_ = true;
        lock.unlock();
        work();
        work = nullptr;
        glFinish();
        lock.lock();
        working_ = false;
        changed_.notify_all();
        if (works_.empty() && std::exchange(wakes_, false)) Window::wake();
    }
    lock.unlock();
    glfwMakeContextCurrent(nullptr);
}

}  // namespace conelight::platform
