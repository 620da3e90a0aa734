// SPDX-License-Identifier: MIT
// Linked programs in a folder (RendererOptions::programs): a file for each, written beside and renamed; several
// processes may share the folder. What cannot be read or written is built anew at each start, without a word.
#pragma once

#include <filesystem>

#include "conelight/program_cache.h"

namespace conelight::io {

class ProgramFiles : public ProgramCache {
  public:
    // A thousand programs and more, should each have 200 KB. Those of llvmpipe have a tenth of that.
    static constexpr std::uint64_t kMostBytes = std::uint64_t(256) << 20;

    // Made when the first program is kept. Beyond `mostBytes` in all, files that were used the longest ago go.
    // Always: on software drivers, too.
    explicit ProgramFiles(std::filesystem::path folder, bool always = false,
                          std::uint64_t mostBytes = kMostBytes);

    bool suits(bool softwareDriver) const override { return always_ || !softwareDriver; }
    std::vector<std::uint8_t> load(const std::string& key) override;
    void keep(const std::string& key, std::span<const std::uint8_t> bytes) override;

  private:
    std::filesystem::path fileOf(const std::string& key) const;
    void trim();

    std::filesystem::path folder_;
    bool always_;
    std::uint64_t mostBytes_;
    std::uint64_t bytes_ = 0;  // of the folder, as far as this process knows
    bool counted_ = false, writable_ = true;
};

// $XDG_CACHE_HOME/conelight/programs, by default ~/.cache/conelight/programs; empty where neither is known.
std::filesystem::path programFolder();

}  // namespace conelight::io
