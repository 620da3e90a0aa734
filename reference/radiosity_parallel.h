// SPDX-License-Identifier: MIT
// A loop on several threads. Each index writes only what is its own, so results do not depend on who runs it.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace conelight::reference {

// body(begin, end) for pieces of [0, count). `threads`: 0 for all cores. `onWait(done)` is called from this thread now and then; when it
// returns false, no more pieces are begun. Returns whether all were done.
inline bool parallelFor(std::size_t count, int threads,
                        const std::function<void(std::size_t, std::size_t)>& body,
                        const std::function<bool(double)>& onWait, std::size_t piece = 32) {
    constexpr int kWaitMs = 200;
    if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (onWait && !onWait(0)) return false;
    std::atomic<std::size_t> next{0};
    std::atomic<bool> cancelled{false};
    std::mutex mutex;
    std::condition_variable changed;
    int running = threads;
    const auto work = [&] {
        for (std::size_t begin = next.fetch_add(piece); begin < count && !cancelled;
             begin = next.fetch_add(piece))
            body(begin, std::min(begin + piece, count));
        const std::lock_guard lock(mutex);
        --running;
        changed.notify_all();
    };
    std::vector<std::thread> workers;
    try {
        while (static_cast<int>(workers.size()) < threads) workers.emplace_back(work);
    } catch (const std::system_error&) {
        const std::lock_guard lock(mutex);
        running -= threads - static_cast<int>(workers.size());
    }
    if (workers.empty()) {
        running = 1;
        work();
    }
    std::unique_lock lock(mutex);
    while (!changed.wait_for(lock, std::chrono::milliseconds(kWaitMs), [&] { return running == 0; })) {
        lock.unlock();
        const double done = static_cast<double>(std::min(next.load(), count)) / static_cast<double>(count);
        if (onWait && !onWait(done)) cancelled = true;
        lock.lock();
    }
    lock.unlock();
    for (std::thread& worker : workers) worker.join();
    return !cancelled;
}

}  // namespace conelight::reference
