// SPDX-License-Identifier: MIT
#include "batch/work.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "command.h"
#include "command_line.h"
#include "conelight/error.h"
#include "io/files.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A call of `render` under way.
struct Running {
    pid_t process = 0;
    std::size_t task = 0;
    fs::path partial;
    Clock::time_point since;
};

double secondsFrom(Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
}

// In the child, between fork and exec: only calls that signals may make.
[[noreturn]] void become(const char* program, char* const* words, const char* log, pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(127);
    const int out = ::open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    const int none = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (out < 0 || none < 0) ::_exit(127);
    ::dup2(none, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    ::execv(program, words);
    ::_exit(127);
}

Running start(const BatchTask& task, std::size_t number, BatchFolder& folder) {
    Running running{0, number, folder.makePartial(task), Clock::now()};
    static const std::string program = ownProgram();
    std::vector<std::string> words = {"conelight"};
    words.insert(words.end(), task.words.begin(), task.words.end());
    words.insert(words.end(), {"--output", (running.partial / task.output).string()});
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const std::string log = folder.logOf(task).string();
    const pid_t self = ::getpid();
    running.process = ::fork();
    if (running.process == 0) become(program.c_str(), pointers.data(), log.c_str(), self);
    if (running.process < 0) throw Error(ErrorKind::Runtime, "batch: no process can be started");
    return running;
}

// Why a call failed; empty when it did not.
std::string failureOf(int status, const fs::path& log) {
    if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
    if (WEXITSTATUS(status) == 0) return {};
    const std::string said = lastLine(log);
    return said.empty() ? fmt::format("ended with status {}", WEXITSTATUS(status)) : said;
}

class Work {
  public:
    Work(const std::vector<BatchTask>& tasks, BatchFolder& folder, int jobs)
        : tasks_(tasks), folder_(folder), jobs_(static_cast<std::size_t>(jobs)) {}
    ~Work() { stop(); }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    BatchOutcome run() {
        const StoppableScope stoppable;
        std::size_t next = 0;
        while (next < tasks_.size() || !running_.empty()) {
            while (running_.size() < jobs_ && next < tasks_.size()) {
                if (interrupted()) throw InterruptedError();
                if (folder_.isDone(tasks_[next]))
                    ++outcome_.found;
                else
                    running_.push_back(start(tasks_[next], next, folder_));
                ++next;
            }
            if (interrupted()) throw InterruptedError();
            if (!reap()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return std::move(outcome_);
    }

  private:
    // Takes the results of those that have ended; false when none has.
    bool reap() {
        for (std::size_t i = 0; i < running_.size(); ++i) {
            int status = 0;
            if (::waitpid(running_[i].process, &status, WNOHANG) == 0) continue;
            const Running ended = running_[i];
            running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
            finish(ended, status);
            return true;
        }
        return false;
    }

    void finish(const Running& ended, int status) {
        const BatchTask& task = tasks_[ended.task];
        const double seconds = secondsFrom(ended.since);
        std::string why = failureOf(status, folder_.logOf(task));
        try {
            if (why.empty()) folder_.take(task, ended.partial, seconds);
        } catch (const Error& error) {
            why = error.what();
        }
        std::error_code ignored;
        fs::remove_all(ended.partial, ignored);
        const std::string name = task.files.front();
        if (why.empty())
            ++outcome_.done;
        else
            outcome_.failures.push_back(name + ": " + why);
        const std::size_t count = outcome_.done + outcome_.found + outcome_.failures.size();
        fmt::print("[{}/{}] {}{}, {:.1f} s\n", count, tasks_.size(), name,
                   why.empty() ? "" : " failed: " + why, seconds);
        std::fflush(stdout);
    }

    // Ends what runs, and leaves nothing of it.
    void stop() {
        for (const Running& running : running_) ::kill(running.process, SIGTERM);
        for (const Running& running : running_) {
            const Clock::time_point since = Clock::now();
            while (::waitpid(running.process, nullptr, WNOHANG) == 0) {
                if (secondsFrom(since) > 5) ::kill(running.process, SIGKILL);
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
            std::error_code ignored;
            fs::remove_all(running.partial, ignored);
        }
        running_.clear();
    }

    const std::vector<BatchTask>& tasks_;
    BatchFolder& folder_;
    std::size_t jobs_;
    std::vector<Running> running_;
    BatchOutcome outcome_;
};

}  // namespace

std::string lastLine(const fs::path& log) {
    std::ifstream file(log);
    std::string line, last;
    while (std::getline(file, line))
        if (!line.empty()) last = line;
    constexpr std::string_view kName = "conelight: ";
    if (last.rfind(kName, 0) == 0) last.erase(0, kName.size());
    return io::oneLine(last, 300);
}

std::string ownProgram() {
    std::error_code code;
    const fs::path path = fs::read_symlink("/proc/self/exe", code);
    if (code) throw Error(ErrorKind::Runtime, "batch: /proc/self/exe cannot be read");
    return path.string();
}

BatchOutcome carryOut(const std::vector<BatchTask>& tasks, BatchFolder& folder, int jobs) {
    return Work(tasks, folder, jobs).run();
}

}  // namespace conelight::program
