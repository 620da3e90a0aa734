// SPDX-License-Identifier: MIT
// Lines typed before, for the arrow keys: back() and forward() walk through those that begin with what was
// typed; submitted lines are kept once in a row.
#pragma once

#include <string>
#include <vector>

namespace conelight::program {

class History {
  public:
    static constexpr std::size_t kKept = 1000;

    void add(const std::string& line) {
        at_ = npos;
        if (line.empty() || (!lines_.empty() && lines_.back() == line)) return;
        lines_.push_back(line);
        if (lines_.size() > kKept) lines_.erase(lines_.begin());
    }
    // The line before the present one; `typed` again when there is none. `typed` is what stands in the box
    // at the first step.
    std::string back(const std::string& typed) { return step(typed, -1); }
    std::string forward(const std::string& typed) { return step(typed, +1); }
    const std::vector<std::string>& lines() const { return lines_; }

  private:
    static constexpr std::size_t npos = ~std::size_t(0);

    std::string step(const std::string& typed, int direction) {
        if (at_ == npos || typed != (at_ < lines_.size() ? lines_[at_] : prefix_)) {
            prefix_ = typed;
            at_ = lines_.size();
        }
        for (std::size_t i = at_;;) {
            if (direction < 0 && i == 0) return at_ == lines_.size() ? prefix_ : lines_[at_];
            if (direction > 0 && i + 1 >= lines_.size()) {
                at_ = lines_.size();
                return prefix_;
            }
            i = direction < 0 ? i - 1 : i + 1;
            if (lines_[i].compare(0, prefix_.size(), prefix_) != 0) continue;
            at_ = i;
            return lines_[i];
        }
    }

    std::vector<std::string> lines_;
    std::size_t at_ = npos;
    std::string prefix_;
};

}  // namespace conelight::program
