// SPDX-License-Identifier: MIT
// What `conelight batch` says about a job: its list of tasks, its manifest, its script for Slurm.
#pragma once

#include <string>
#include <vector>

#include "batch/folder.h"

namespace conelight::program {

struct Shard {
    int index = 1;  // from 1
    int count = 1;
};

// "3/8". Throws Error(Usage).
Shard parseShard(const std::string& text);
// Every count-th task, from the index-th: neighbours are alike, so the shards take about as long.
std::vector<BatchTask> tasksOf(const BatchJob& job, const Shard& shard);

// Checks every file against its record, then writes manifest.json and SHA256SUMS, and clears what attempts that were
// killed have left. Returns what is missing or
// not as recorded, one line each; then nothing is written.
std::vector<std::string> collect(const BatchJob& job, BatchFolder& folder);

// A script for `sbatch`: an array of `count` shards. `command`: words in front of ` --shard`.
std::string slurmScript(const std::string& job, const std::string& folder, int count,
                        const std::string& command);

}  // namespace conelight::program
