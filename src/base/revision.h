// SPDX-License-Identifier: MIT
// The state of a value, as a number that no other state of any value in the process has. Who changes a value
// gives it a new revision; who derives something from it keeps the revision it was derived from and compares.
// So nobody has to be told of a change, and none can be missed.
#pragma once

#include <atomic>
#include <cstdint>

namespace conelight::base {

class Revision {
  public:
    Revision() = default;  // of what has not been made: equal to no revision from next()
    static Revision next() {
        static std::atomic<std::uint64_t> last{0};
        return Revision(++last);
    }
    explicit operator bool() const { return value_ != 0; }
    bool operator==(const Revision&) const = default;

  private:
    explicit Revision(std::uint64_t value) : value_(value) {}
    std::uint64_t value_ = 0;
};

}  // namespace conelight::base
