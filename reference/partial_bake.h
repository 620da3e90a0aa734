// SPDX-License-Identifier: MIT
// What a bake has done so far, result by result, so that one that was stopped goes on later to the same bits.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace conelight::reference {

class PartialBake {
  public:
    // Makes room; results from before stay where number and size are the same.
    void prepare(std::size_t count, std::size_t bytesEach) {
        if (done_.size() == count && bytesEach_ == bytesEach) return;
        done_ = std::vector<std::atomic<std::uint8_t>>(count);
        bytesEach_ = bytesEach;
        results_.assign(count * bytesEach, 0);
    }

    // Thread-safe for different numbers, and beside saved().
    template <class Result>
    bool take(std::size_t number, Result& result) const {
        static_assert(std::is_trivially_copyable_v<Result>);
        if (done_[number].load(std::memory_order_acquire) == 0) return false;
        std::memcpy(static_cast<void*>(&result), &results_[number * bytesEach_], sizeof(Result));
        return true;
    }
    template <class Result>
    void put(std::size_t number, const Result& result) {
        static_assert(std::is_trivially_copyable_v<Result>);
        std::memcpy(&results_[number * bytesEach_], static_cast<const void*>(&result), sizeof(Result));
        done_[number].store(1, std::memory_order_release);
    }

    double share() const;  // of all results, 0 to 1
    // The results as bytes, and back: false, and nothing is changed, for bytes that saved() has not made.
    std::vector<std::uint8_t> saved() const;
    bool restore(std::span<const std::uint8_t> bytes);

  private:
    std::vector<std::atomic<std::uint8_t>> done_;
    std::size_t bytesEach_ = 0;
    std::vector<std::uint8_t> results_;
};

}  // namespace conelight::reference
