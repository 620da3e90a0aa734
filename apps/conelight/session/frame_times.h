// SPDX-License-Identifier: MIT
// Times of the last frames, oldest first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

namespace conelight::program {

class FrameTimes {
  public:
    static constexpr std::size_t kKept = 100;  // as many as the thesis's program keeps

    void add(double ms) {
        times_.push_back(ms);
        if (times_.size() > kKept) times_.pop_front();
    }
    void clear() { times_.clear(); }
    const std::deque<double>& all() const { return times_; }
    double mean() const {  // 0 without frames
        double sum = 0;
        for (const double time : times_) sum += time;
        return times_.empty() ? 0 : sum / static_cast<double>(times_.size());
    }
    double median() const {  // 0 without frames; the upper one of two in the middle
        std::vector<double> sorted(times_.begin(), times_.end());
        if (sorted.empty()) return 0;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

  private:
    std::deque<double> times_;
};

}  // namespace conelight::program
