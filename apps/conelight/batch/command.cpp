// SPDX-License-Identifier: MIT
// `conelight batch JOB -o DIR`: many pictures by one file, cut into shards, each made once.
#include <fmt/core.h>

#include "batch/batch.h"
#include "batch/work.h"
#include "command.h"
#include "command_line.h"
#include "conelight/error.h"
#include "io/files.h"

namespace conelight::program {
namespace {

struct BatchOptions {
    std::string job, out, shard;
    int jobs = 1;
    int slurm = 0;
    bool list = false, collect = false;
};

// Those of `render` that say what a picture shows. Outputs and films are the batch's.
std::vector<BatchOption> renderOptions(const CLI::App& app) {
    std::vector<BatchOption> options;
    for (const CLI::Option* option : app.get_subcommand("render")->get_options()) {
        const std::string name = option->get_single_name();
        bool taken = option->get_positional() || name == "help";
        for (const char* own :
             {"output", "overwrite", "path", "animate", "fps", "turntable", "frames", "bake", "stats", "exec",
              "script", "set", "shader-dir", "gl-debug", "program-cache"})
            taken = taken || name == own;
        if (taken) continue;
        bool isFile = false;
        for (const char* file : {"preset", "cone-set", "environment"}) isFile = isFile || name == file;
        options.push_back({name, option->get_items_expected_max() == 0, isFile});
    }
    return options;
}

void list(const std::vector<BatchTask>& tasks, BatchFolder& folder) {
    for (const BatchTask& task : tasks) {
        std::string line = folder.isDone(task) ? "done   " : "to do  ";
        line += task.files.front();
        if (task.files.size() > 1) line += fmt::format(" and {} more", task.files.size() - 1);
        line += "   conelight";
        for (const std::string& word : task.words) line += " " + shellWord(word);
        fmt::print("{}\n", line);
    }
}

void printScript(const BatchOptions& options) {
    std::error_code code;
    std::filesystem::create_directories(std::filesystem::path(options.out) / "batch" / "slurm", code);
    if (code)
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: cannot be made ({})", io::oneLine(options.out), code.message()));
    const std::string job = std::filesystem::absolute(options.job).lexically_normal().string();
    const std::string out = std::filesystem::absolute(options.out).lexically_normal().string();
    std::string command = shellWord(ownProgram()) + " batch " + shellWord(job) + " -o " + shellWord(out);
    if (options.jobs > 1) command += fmt::format(" --jobs {}", options.jobs);
    fmt::print("{}", slurmScript(job, out, options.slurm, command));
}

void collectAll(const BatchJob& job, BatchFolder& folder) {
    const std::vector<std::string> problems = collect(job, folder);
    if (problems.empty()) {
        fmt::print("written {} and SHA256SUMS, {} tasks\n", folder.at("manifest.json").string(),
                   job.tasks.size());
        return;
    }
    for (const std::string& problem : problems) fmt::print("{}\n", problem);
    throw Error(ErrorKind::Runtime, fmt::format("batch: {} of {} tasks are missing or not as they were made",
                                                problems.size(), job.tasks.size()));
}

void run(const CLI::App& app, const BatchOptions& options) {
    const Shard shard = options.shard.empty() ? Shard{} : parseShard(options.shard);
    const BatchJob job = readBatchJob(options.job, renderOptions(app));
    BatchFolder folder(options.out);
    if (options.slurm > 0) return printScript(options);
    const std::vector<BatchTask> tasks = tasksOf(job, shard);
    if (options.list) return list(tasks, folder);
    if (options.collect) return collectAll(job, folder);
    folder.refuseForeignFiles(tasks);
    const BatchOutcome outcome = carryOut(tasks, folder, options.jobs);
    fmt::print("{} made, {} were there, {} failed\n", outcome.done, outcome.found, outcome.failures.size());
    if (!outcome.failures.empty())
        throw Error(ErrorKind::Runtime,
                    fmt::format("batch: {} of {} tasks failed; the first: {}", outcome.failures.size(),
                                tasks.size(), outcome.failures.front()));
    if (shard.count == 1) collectAll(job, folder);
}

}  // namespace

void addBatch(CLI::App& app) {
    auto options = std::make_shared<BatchOptions>();
    CLI::App* command = app.add_subcommand("batch", "many pictures by one file, on one machine or a cluster");
    command->add_option("job", options->job, "the job, as JSON (docs/guide/batch.md)")->required();
    command->add_option("-o,--output", options->out, "the folder of the results")->required();
    CLI::Option* shard = command->add_option("--shard", options->shard, "only every N-th task, from the I-th")
                             ->type_name("I/N");
    command->add_option("--jobs", options->jobs, "calls of `render` at a time")
        ->capture_default_str()
        ->check(CLI::Range(1, 1024));
    CLI::Option* list = command->add_flag("--list", options->list, "print the tasks, and which are done");
    CLI::Option* collect = command->add_flag("--collect", options->collect,
                                             "check all files, and write manifest.json and SHA256SUMS");
    CLI::Option* slurm =
        command->add_option("--slurm", options->slurm, "print a script for `sbatch`: an array of N shards")
            ->type_name("N")
            ->check(CLI::Range(1, 100000));
    list->excludes(collect);
    list->excludes(slurm);
    collect->excludes(slurm);
    collect->excludes(shard);
    slurm->excludes(shard);
    command->callback([options, &app] { run(app, *options); });
}

}  // namespace conelight::program
