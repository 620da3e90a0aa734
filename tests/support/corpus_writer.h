// SPDX-License-Identifier: MIT
// Writes the files of a corpus (corpus.h) into a folder: a valid file and what was done to it.
#pragma once

#include <sys/stat.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cpu/io_test_support.h"
#include "support/corpus.h"

namespace conelight::test {

namespace fs = std::filesystem;

class Corpus {
  public:
    explicit Corpus(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

    void add(const std::string& name, const std::string& text, Expect expect) {
        write(folder_ / name, text);
        files_.push_back({folder_ / name, expect});
    }
    // What a name may be instead of a file of that kind.
    void addSpecial(const std::string& ending) {
        ::mkfifo((folder_ / ("pipe" + ending)).c_str(), 0600);
        fs::create_directory(folder_ / ("folder" + ending));
        fs::create_symlink("/dev/zero", folder_ / ("zero" + ending));
        fs::create_symlink("loop" + ending, folder_ / ("loop" + ending));
        write(folder_ / ("hole" + ending), "");
        fs::resize_file(folder_ / ("hole" + ending), std::uintmax_t(1) << 40);
        for (const char* name : {"pipe", "folder", "zero", "loop", "hole", "missing"})
            files_.push_back({folder_ / (name + ending), Expect::Refused});
        add("empty" + ending, "", Expect::Refused);
        add("zeros" + ending, std::string(4096, '\0'), Expect::Refused);
        add("not utf-8 \xff\xfe name" + ending, "\xff\xfe\x80", Expect::Refused);
    }
    // Cut at several places, and damaged: no more than a crash or a hang can be ruled out.
    void addDamaged(const std::string& name, const std::string& ending, const std::string& text) {
        for (int i = 1; i < 8; ++i)
            add(name + "_cut" + std::to_string(i) + ending, text.substr(0, text.size() * std::size_t(i) / 8),
                Expect::Either);
        std::mt19937 random(17);
        for (int i = 0; i < 8; ++i)
            add(name + "_damaged" + std::to_string(i) + ending, mutated(text, random), Expect::Either);
    }
    const fs::path& folder() const { return folder_; }
    std::vector<CorpusFile> files() { return std::move(files_); }

  private:
    fs::path folder_;
    std::vector<CorpusFile> files_;
};

}  // namespace conelight::test
