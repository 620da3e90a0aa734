// SPDX-License-Identifier: MIT
// Pictures in parts, on software drivers: how long a part lasts, where it may end (rest), and passes over many pixels
// in pieces that are short beside it. How a pass is cut changes no bit of what it writes.
#pragma once

#include <algorithm>
#include <coroutine>
#include <optional>

#include "base/steps.h"
#include "gl/device.h"

namespace conelight::gl {

class Pace {
  public:
    void begin(double milliseconds);  // a part
    bool over();                      // waits for the driver; whether the part has taken its time
    double part() const { return milliseconds_; }
    double worked() const { return before_ + now_; }  // ms, of all parts, by the last over()

  private:
    double milliseconds_ = 0, start_ = 0, now_ = 0, before_ = 0;
};

// The work may rest here, and go no further: `co_await rest(device)`.
struct Rest {
    Pace* pace;
    bool await_ready() const { return pace == nullptr || !pace->over(); }
    void await_suspend(std::coroutine_handle<>) const noexcept {}
    void await_resume() const noexcept {}
};
inline Rest rest(const Device& device) { return {device.pace}; }

// A pass that may rest between its dispatches and draws: one scope where it does not. Nothing else may be open then.
class PassSteps {
  public:
    PassSteps(const Device& device, const char* name) : device_(device), name_(name) { open(); }
    struct Rest {
        PassSteps& pass;
        bool await_ready();
        void await_suspend(std::coroutine_handle<>) const noexcept {}
        void await_resume() { pass.open(); }
    };
    Rest rest() { return {*this}; }

  private:
    void open() {
        if (!scope_) scope_.emplace(device_.profiler, name_);
    }
    const Device& device_;
    const char* name_;
    std::optional<PassScope> scope_;
};

// The pieces of a pass over `total` rows, or whatever: whole multiples of `unit`, as many as take a small part of a
// part's time, with a rest after each. Without a pace: one.
class Pieces {
  public:
    Pieces(const Device& device, int total, int unit)
        : pace_(device.pace), total_(total), unit_(unit), most_(pace_ != nullptr ? unit : total) {}
    // Goes to the next one; false: there is none.
    bool next();
    int first() const { return first_; }
    int count() const { return count_; }

  private:
    Pace* pace_;
    int total_, unit_, most_;
    int first_ = 0, count_ = 0;
    double since_ = 0;
};

}  // namespace conelight::gl
