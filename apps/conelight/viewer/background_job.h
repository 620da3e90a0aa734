// SPDX-License-Identifier: MIT
// Work in a thread of its own that is replaced without waiting: cancelling asks it to end, and what comes
// next starts when it has.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <thread>

namespace conelight::program {

using Cancelled = std::atomic<bool>;

class BackgroundJob {
  public:
    ~BackgroundJob() {
        cancel();
        if (work_.valid()) work_.wait();
    }
    BackgroundJob() = default;
    BackgroundJob(const BackgroundJob&) = delete;
    BackgroundJob& operator=(const BackgroundJob&) = delete;

    // False while the work before is still ending: ask again later. `work` does not throw; `wake` is called
    // from its thread when it is done.
    bool start(std::function<void(const Cancelled&)> work, void (*wake)()) {
        if (busy()) return false;
        cancelled_ = std::make_shared<Cancelled>(false);
        work_ = std::async(std::launch::async, [work = std::move(work), cancelled = cancelled_, wake] {
            work(*cancelled);
            wake();
        });
        return true;
    }
    void cancel() {
        if (cancelled_) *cancelled_ = true;
    }
    bool busy() const {
        return work_.valid() && work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    }
    // Cores for the work: one is left to the window.
    static int threads() { return static_cast<int>(std::max(std::thread::hardware_concurrency(), 2u)) - 1; }

  private:
    std::shared_ptr<Cancelled> cancelled_;
    std::future<void> work_;
};

}  // namespace conelight::program
