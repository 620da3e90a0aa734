// SPDX-License-Identifier: MIT
// What the viewer remembers from one run to the next: scenes that were opened, lines that were typed. Kept in
// $XDG_STATE_HOME/conelight, by default ~/.local/state/conelight; two programs at a time may use them.
#pragma once

#include <string>
#include <vector>

namespace conelight::program {

class StateFiles {
  public:
    static constexpr std::size_t kRecent = 12, kLines = 1000;

    // `keep` off: nothing is read or written. Never throws: what cannot be read or written is not remembered.
    explicit StateFiles(bool keep);

    const std::vector<std::string>& recent() const { return recent_; }  // newest first
    void opened(const std::string& scene);   // a file's path is made absolute; builtin:NAME stays
    std::vector<std::string> lines() const;  // oldest first
    void typed(const std::string& line);
    const std::string& folder() const { return folder_; }  // empty: none

  private:
    std::string folder_;
    std::vector<std::string> recent_;
};

}  // namespace conelight::program
