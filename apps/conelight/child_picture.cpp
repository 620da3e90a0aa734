// SPDX-License-Identifier: MIT
#include "child_picture.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>

#include "batch/work.h"
#include "command_line.h"
#include "conelight/error.h"
#include "interrupt.h"
#include "io/files.h"
#include "picture_input.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

pid_t start(std::vector<std::string> words, const fs::path& log) {
    static const std::string program = ownProgram();
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                       0600);
    ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    pid_t process = 0;
    const int failure = ::posix_spawn(&process, program.c_str(), &files, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&files);
    if (failure != 0) throw Error(ErrorKind::Runtime, "compare: no process can be started");
    return process;
}

// The seconds it took; `status` as of waitpid. A signal ends it.
double waitFor(pid_t process, int& status) {
    struct rusage used {};
    while (::wait4(process, &status, 0, &used) < 0) {
        if (errno != EINTR) throw Error(ErrorKind::Runtime, "compare: lost a process of its own");
        if (interrupted()) ::kill(process, SIGTERM);
    }
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace

ScratchFolder::ScratchFolder() {
    std::error_code code;
    std::string name = (fs::temp_directory_path(code) / "conelight-XXXXXX").string();
    if (code || ::mkdtemp(name.data()) == nullptr)
        throw Error(ErrorKind::Runtime, name + ": cannot make this folder");
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

ChildPicture drawInChild(const std::vector<std::string>& words, const ScratchFolder& folder) {
    const fs::path picture = folder.path() / "picture.exr", log = folder.path() / "log.txt";
    std::vector<std::string> all = {"conelight", "render"};
    all.insert(all.end(), words.begin(), words.end());
    ChildPicture result;
    for (const std::string& word : all)
        result.command += (result.command.empty() ? "" : " ") + shellWord(word);
    all.insert(all.end(), {"--output", picture.string()});
    const StoppableScope stoppable;
    int status = 0;
    result.cpuSeconds = waitFor(start(all, log), status);
    if (interrupted()) throw InterruptedError();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: {}", result.command,
                                WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                                    : lastLine(log)));
    result.image = readPicture(picture.string());
    return result;
}

}  // namespace conelight::program
