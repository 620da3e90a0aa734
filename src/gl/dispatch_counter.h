// SPDX-License-Identifier: MIT
// How much work compute programs are given, by pass: while a counter lives, dispatches on its thread are counted.
// Indirect ones are read back, so that a frame that is counted is none to be timed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace conelight::gl {

struct DispatchCount {
    std::string pass;     // the innermost PassScope
    std::string program;  // ProgramDesc::label()
    std::uint64_t dispatches = 0;
    std::uint64_t invocations = 0;  // whole groups
};

class DispatchCounter {
  public:
    DispatchCounter();
    ~DispatchCounter();
    DispatchCounter(const DispatchCounter&) = delete;
    DispatchCounter& operator=(const DispatchCounter&) = delete;

    // Of this thread, the youngest; null: nothing is counted.
    static DispatchCounter* current();

    void enter(const char* pass) { passes_.push_back(pass); }
    void leave() { passes_.pop_back(); }
    void add(const std::string& program, std::uint64_t invocations);
    const std::vector<DispatchCount>& counts() const { return counts_; }  // in the order in which they began

  private:
    DispatchCounter* outer_;
    std::vector<const char*> passes_;
    std::vector<DispatchCount> counts_;
};

}  // namespace conelight::gl
