// SPDX-License-Identifier: MIT
// The file beside a bake's results that keeps what is done: bake.partial. A bake that was stopped, or whose process
// died, goes on from it when the same command is given again.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "reference/partial_bake.h"

namespace conelight::program {

class BakeState {
  public:
    // `key`: of the scene and all options that results depend on. A file of another key is left alone and not used.
    BakeState(const std::filesystem::path& folder, std::string key);

    reference::PartialBake& partial() { return partial_; }
    double found() const { return found_; }  // share of the results that the file had
    // Writes the file when the last time is long ago.
    void saveNowAndThen();
    void save();
    void remove();  // all is done

  private:
    std::filesystem::path file_;
    std::string key_;
    reference::PartialBake partial_;
    double found_ = 0;
    std::chrono::steady_clock::time_point saved_;
};

}  // namespace conelight::program
