// SPDX-License-Identifier: MIT
#include "gl/dispatch_counter.h"

#include <algorithm>
#include <utility>

namespace conelight::gl {
namespace {

thread_local DispatchCounter* youngest = nullptr;

}  // namespace

DispatchCounter::DispatchCounter() : outer_(std::exchange(youngest, this)) {}
DispatchCounter::~DispatchCounter() { youngest = outer_; }
DispatchCounter* DispatchCounter::current() { return youngest; }

void DispatchCounter::add(const std::string& program, std::uint64_t invocations) {
    const std::string pass = passes_.empty() ? "" : passes_.back();
    auto found = std::find_if(counts_.begin(), counts_.end(), [&](const DispatchCount& count) {
        return count.pass == pass && count.program == program;
    });
    if (found == counts_.end()) found = counts_.insert(counts_.end(), {pass, program});
    ++found->dispatches;
    found->invocations += invocations;
}

}  // namespace conelight::gl
