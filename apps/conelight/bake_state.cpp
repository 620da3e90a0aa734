// SPDX-License-Identifier: MIT
#include "bake_state.h"

#include <algorithm>
#include <system_error>

#include "conelight/error.h"
#include "interrupt.h"
#include "io/files.h"

namespace conelight::program {
namespace {

constexpr std::chrono::seconds kBetweenSaves(30);

}  // namespace

BakeState::BakeState(const std::filesystem::path& folder, std::string key)
    : file_(folder / "bake.partial"), key_(std::move(key) + "\n"), saved_(std::chrono::steady_clock::now()) {
    std::error_code missing;
    if (!std::filesystem::is_regular_file(file_, missing)) return;
    const io::Bytes bytes = io::readFile(file_);
    if (bytes.size() < key_.size() || !std::equal(key_.begin(), key_.end(), bytes.begin())) return;
    if (partial_.restore({bytes.data() + key_.size(), bytes.size() - key_.size()})) found_ = partial_.share();
}

void BakeState::saveNowAndThen() {
    if (std::chrono::steady_clock::now() - saved_ >= kBetweenSaves) save();
}

void BakeState::save() {
    const std::vector<std::uint8_t> results = partial_.saved();
    io::Bytes bytes(key_.begin(), key_.end());
    bytes.insert(bytes.end(), results.begin(), results.end());
    const WritingScope writing;
    io::writeFile(file_, bytes);
    saved_ = std::chrono::steady_clock::now();
}

void BakeState::remove() {
    std::error_code failed;
    std::filesystem::remove(file_, failed);
}

}  // namespace conelight::program
