// SPDX-License-Identifier: MIT
// A scene that is read in a thread of its own, while the window goes on with the one that it has. What was read is
// swapped in on the window's thread, when that asks for it.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "io/scene_file.h"
#include "viewer/background_job.h"

namespace conelight::program {

class BackgroundLoad {
  public:
    using TakeOver = std::function<void()>;  // swaps in what was read; runs on the window's thread
    // Runs in the background: reads, tells how far it is, and throws what reading throws.
    using Read = std::function<TakeOver(const io::LoadOptions& watched)>;

    // `wake` is called from the thread as it comes on. False while what was stopped is still ending. In a process
    // whose memory is limited it is read before this returns: a limit that holds while OpenGL draws would end it.
    bool start(const std::string& name, Read read, void (*wake)());
    void stop();  // finish() will throw io::LoadStopped
    bool busy() const { return started_; }

    struct Status {
        std::string text;  // "NAME: pictures, 3 of 8"
        double done = -1;  // of the step; < 0: not known
    };
    Status status() const;

    // Once, when the work has ended: swaps in what was read, or throws what went wrong. Returns whether it did.
    bool finish();

  private:
    struct Progress {
        std::string step = "reading";
        std::size_t done = 0, total = 0;
    };
    void run(const Read& read, const Cancelled& cancelled, void (*wake)());
    bool tell(const io::LoadStep& step, const Cancelled& cancelled, void (*wake)());

    std::string name_;
    bool started_ = false, stopped_ = false;

    mutable std::mutex mutex_;  // guards what follows
    Progress progress_;
    std::chrono::steady_clock::time_point told_;
    TakeOver takeOver_;
    std::exception_ptr failure_;

    BackgroundJob job_;  // last: it ends before what it works on does
};

}  // namespace conelight::program
