// SPDX-License-Identifier: MIT
// The folder of a batch's results: pictures, and below batch/ what is known of them. Several processes of
// several machines may work in one folder.
//
//   batch/records/NAME.json  of a finished task: its fingerprint, its files with their SHA-256
//   batch/logs/NAME.txt      what its call of `render` said
//   batch/partial/...        files under way
//   manifest.json, SHA256SUMS  of the whole, by collect()
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "batch/job.h"

namespace conelight::program {

struct BatchFile {
    std::string name;  // below the folder
    std::string sha256;
    std::uint64_t bytes = 0;
};

// What is known of a finished task.
struct BatchRecord {
    std::string fingerprint;
    std::vector<BatchFile> files;
    std::string device;  // of OpenGL, or CPU; "" where the files do not say it
    double seconds = 0;  // of wall time
};

class BatchFolder {
  public:
    explicit BatchFolder(const std::string& path) : path_(path) {}

    // Of what decides over a task's pictures: its words, the bytes of its files, the program's version and
    // commit. Throws Error(BadInput) for a file that cannot be read.
    std::string fingerprint(const BatchTask& task);
    // Recorded with this fingerprint, and its files are there in their sizes.
    bool isDone(const BatchTask& task);
    std::optional<BatchRecord> recordOf(const BatchTask& task) const;

    // Throws Error(Usage) when a file that is no result of a batch stands where one will be.
    void refuseForeignFiles(const std::vector<BatchTask>& tasks) const;

    std::filesystem::path at(const std::string& name) const { return path_ / name; }
    std::filesystem::path logOf(const BatchTask& task) const;
    // A new folder, for one attempt.
    std::filesystem::path makePartial(const BatchTask& task) const;
    // Moves the files of a finished attempt to their places, and records them. Throws Error(Runtime) when one
    // is missing.
    void take(const BatchTask& task, const std::filesystem::path& partial, double seconds);

  private:
    std::filesystem::path recordFile(const BatchTask& task) const;

    std::filesystem::path path_;
    std::map<std::string, std::string> inputs_;  // SHA-256 by name
};

}  // namespace conelight::program
