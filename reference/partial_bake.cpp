// SPDX-License-Identifier: MIT
// Saved: number of results, bytes of each, one byte for each that says whether it is there, then those that are.
#include "reference/partial_bake.h"

#include <algorithm>
#include <array>

namespace conelight::reference {

double PartialBake::share() const {
    if (done_.empty()) return 0;
    std::size_t count = 0;
    for (const auto& done : done_) count += done.load(std::memory_order_acquire);
    return static_cast<double>(count) / static_cast<double>(done_.size());
}

std::vector<std::uint8_t> PartialBake::saved() const {
    const std::array<std::uint64_t, 2> head = {done_.size(), bytesEach_};
    std::vector<std::uint8_t> bytes(sizeof(head) + done_.size());
    std::memcpy(bytes.data(), head.data(), sizeof(head));
    for (std::size_t i = 0; i < done_.size(); ++i) {
        if (done_[i].load(std::memory_order_acquire) == 0) continue;
        bytes[sizeof(head) + i] = 1;
        const auto from = results_.begin() + static_cast<std::ptrdiff_t>(i * bytesEach_);
        bytes.insert(bytes.end(), from, from + static_cast<std::ptrdiff_t>(bytesEach_));
    }
    return bytes;
}

bool PartialBake::restore(std::span<const std::uint8_t> bytes) {
    std::array<std::uint64_t, 2> head{};
    if (bytes.size() < sizeof(head)) return false;
    std::memcpy(head.data(), bytes.data(), sizeof(head));
    const auto left = static_cast<std::uint64_t>(bytes.size() - sizeof(head));
    if (head[0] > left || head[1] == 0) return false;
    const std::size_t count = head[0], each = head[1];
    const auto flags = bytes.subspan(sizeof(head), count);
    const auto there = static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
    if ((left - count) % each != 0 || (left - count) / each != there) return false;
    done_ = std::vector<std::atomic<std::uint8_t>>(count);
    bytesEach_ = each;
    results_.assign(count * each, 0);
    auto from = bytes.begin() + static_cast<std::ptrdiff_t>(sizeof(head) + count);
    for (std::size_t i = 0; i < count; ++i) {
        if (flags[i] != 1) continue;
        std::copy_n(from, each, results_.begin() + static_cast<std::ptrdiff_t>(i * each));
        from += static_cast<std::ptrdiff_t>(each);
        done_[i].store(1, std::memory_order_release);
    }
    return true;
}

}  // namespace conelight::reference
