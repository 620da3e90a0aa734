// SPDX-License-Identifier: MIT
// A batch job: a JSON file that stands for many calls of `conelight render` (docs/guide/batch.md).
#pragma once

#include <string>
#include <vector>

namespace conelight::program {

// An option of `render`, without its dashes.
struct BatchOption {
    std::string name;
    bool isFlag = false;
    bool isFile = false;
};

// One call: a picture, or neighbouring frames of a film.
struct BatchTask {
    std::vector<std::string> words;   // `render` and its words, without --output
    std::string output;               // --output, below the job's folder of results
    std::vector<std::string> files;   // what it writes there; one, or one a frame
    std::vector<std::string> inputs;  // files that it reads
};

struct BatchJob {
    std::string file;
    std::vector<BatchTask> tasks;  // scenes, then the sweep in the order of the file, then frames
};

// `options`: those that a job may name. Files in the job are as seen from its own folder. Throws
// Error(BadInput) "FILE:LINE: what is wrong; what would be right".
BatchJob readBatchJob(const std::string& file, const std::vector<BatchOption>& options);

}  // namespace conelight::program
