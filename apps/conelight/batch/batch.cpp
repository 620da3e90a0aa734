// SPDX-License-Identifier: MIT
#include "batch/batch.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "batch/sha256.h"
#include "command.h"
#include "command_line.h"
#include "conelight/error.h"
#include "io/files.h"
#include "provenance.h"

namespace conelight::program {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

io::Bytes bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

std::string problemOf(const BatchFile& file, const BatchFolder& folder) {
    std::error_code code;
    if (!fs::is_regular_file(folder.at(file.name), code)) return file.name + ": is not there";
    if (sha256OfFile(folder.at(file.name)) != file.sha256)
        return file.name + ": is not as it was made; without it, the same call makes it again";
    return {};
}

}  // namespace

Shard parseShard(const std::string& text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    std::from_chars_result read = std::from_chars(text.data(), end, shard.index);
    const bool parted = read.ec == std::errc() && read.ptr != end && *read.ptr == '/';
    if (parted) read = std::from_chars(read.ptr + 1, end, shard.count);
    if (!parted || read.ec != std::errc() || read.ptr != end || shard.index < 1 || shard.count < shard.index)
        usage(fmt::format("--shard: '{}' is not usable; I/N with I from 1 to N, as in 3/8, would be right",
                          io::oneLine(text, 40)));
    return shard;
}

std::vector<BatchTask> tasksOf(const BatchJob& job, const Shard& shard) {
    std::vector<BatchTask> tasks;
    for (std::size_t i = static_cast<std::size_t>(shard.index) - 1; i < job.tasks.size();
         i += static_cast<std::size_t>(shard.count))
        tasks.push_back(job.tasks[i]);
    return tasks;
}

std::vector<std::string> collect(const BatchJob& job, BatchFolder& folder) {
    std::vector<std::string> problems;
    Json manifest = {
        {"conelight", "batch manifest"},
        {"software", softwareName()},
        {"job", {{"name", fs::path(job.file).filename().string()}, {"sha256", sha256OfFile(job.file)}}},
        {"tasks", Json::array()}};
    std::vector<BatchFile> files;
    for (const BatchTask& task : job.tasks) {
        const std::optional<BatchRecord> record = folder.recordOf(task);
        if (!record || record->fingerprint != folder.fingerprint(task)) {
            problems.push_back(task.files.front() + ": is not made" +
                               (record ? "; what is there is of another job, program or scene" : ""));
            continue;
        }
        Json one = {{"words", task.words}, {"device", record->device}, {"files", Json::array()}};
        for (const BatchFile& file : record->files) {
            if (const std::string problem = problemOf(file, folder); !problem.empty())
                problems.push_back(problem);
            one["files"].push_back({{"name", file.name}, {"sha256", file.sha256}, {"bytes", file.bytes}});
            files.push_back(file);
        }
        manifest["tasks"].push_back(std::move(one));
    }
    if (!problems.empty()) return problems;
    std::sort(files.begin(), files.end(),
              [](const BatchFile& a, const BatchFile& b) { return a.name < b.name; });
    std::string sums;
    for (const BatchFile& file : files) sums += file.sha256 + "  " + file.name + "\n";
    io::writeFiles({{folder.at("manifest.json"), bytesOf(manifest.dump(1) + "\n")},
                    {folder.at("SHA256SUMS"), bytesOf(sums)}});
    std::error_code ignored;
    fs::remove_all(folder.at("batch/partial"), ignored);  // of attempts that were killed
    return {};
}

std::string slurmScript(const std::string& job, const std::string& folder, int count,
                        const std::string& command) {
    const std::string name = fs::path(job).stem().string();
    const std::string logs = (fs::absolute(folder) / "batch" / "slurm").lexically_normal().string();
    return fmt::format(
        "#!/bin/sh\n"
        "#SBATCH --job-name={}\n"
        "#SBATCH --array=1-{}\n"
        "#SBATCH --ntasks=1\n"
        "#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n"
        "#SBATCH --output={}/%a.txt\n"
        "exec {} --shard \"$SLURM_ARRAY_TASK_ID/{}\"\n",
        shellWord(name), count, logs, command, count);
}

}  // namespace conelight::program
