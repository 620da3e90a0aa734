// SPDX-License-Identifier: MIT
// fork, a pipe, limits and a poll loop: see child_process.h. The limit counts the child's processor time (a
// busy machine does not fail a good file); a wall-clock limit of 20 times as much catches a child that
// sleeps.
#include "io/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <new>

#if defined(__SANITIZE_ADDRESS__)
#define CONELIGHT_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CONELIGHT_ADDRESS_SANITIZER 1
#endif
#endif

namespace conelight::io {

namespace {

constexpr int kAskMs = 100;           // between calls of ChildLimits::goesOn
constexpr double kWallPerCpu = 20.0;  // chosen: eight busy neighbours on two cores still pass

// First byte of what the child sends.
constexpr std::uint8_t kTagBytes = 1;
constexpr std::uint8_t kTagFailure = 2;

bool sendAll(int fd, const void* data, std::size_t size) {
    const auto* at = static_cast<const std::uint8_t*>(data);
    while (size > 0) {
        const ssize_t sent = ::write(fd, at, std::min(size, std::size_t(1) << 20));
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        at += sent;
        size -= std::size_t(sent);
    }
    return true;
}

std::uint64_t addressSpaceBytes() {
    // First number of /proc/self/statm: pages of address space. 0 where there is no such file.
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (file == nullptr) return 0;
    unsigned long long pages = 0;
    const int fields = std::fscanf(file, "%llu", &pages);
    std::fclose(file);
    return fields == 1 ? pages * std::uint64_t(::sysconf(_SC_PAGESIZE)) : 0;
}

void applyLimits(const ChildLimits& limits) {
    // No core file, no signal handlers or timers of the host.
    struct rlimit none {
        0, 0
    };
    ::setrlimit(RLIMIT_CORE, &none);
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGPROF, SIGXCPU})
        ::signal(number, SIG_DFL);
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_UNBLOCK, &all, nullptr);
    if (limits.cpuSeconds > 0.0) {
        // SIGPROF's default action ends the process; the interval timer has a finer grain than RLIMIT_CPU.
        struct itimerval timer {};
        timer.it_value.tv_sec = time_t(limits.cpuSeconds);
        timer.it_value.tv_usec = suseconds_t((limits.cpuSeconds - std::floor(limits.cpuSeconds)) * 1e6);
        ::setitimer(ITIMER_PROF, &timer, nullptr);
    }
#if !defined(CONELIGHT_ADDRESS_SANITIZER)  // the sanitizer reserves terabytes of address space
    const std::uint64_t used = addressSpaceBytes();
    if (limits.extraMemoryBytes > 0 && used > 0) {
        struct rlimit space {};
        ::getrlimit(RLIMIT_AS, &space);
        const rlim_t wanted = rlim_t(used + limits.extraMemoryBytes);
        if (space.rlim_max == RLIM_INFINITY || wanted < space.rlim_max) space.rlim_cur = wanted;
        ::setrlimit(RLIMIT_AS, &space);
    }
#endif
}

[[noreturn]] void childMain(int fd, const std::function<Bytes()>& work, const ChildLimits& limits) {
    applyLimits(limits);
    const int nowhere = ::open("/dev/null", O_RDWR);
    if (nowhere >= 0)
        for (const int standard : {0, 1, 2}) ::dup2(nowhere, standard);
    std::string failure;
    Bytes bytes;
    try {
        bytes = work();
    } catch (const std::bad_alloc&) {
        failure = "needs too much memory";
    } catch (const std::exception& error) {
        failure = error.what();
        if (failure.empty()) failure = "failed without a message";
    } catch (...) {
        failure = "failed without a message";
    }
    const std::uint8_t tag = failure.empty() ? kTagBytes : kTagFailure;
    bool sent = sendAll(fd, &tag, 1);
    if (sent)
        sent = failure.empty() ? sendAll(fd, bytes.data(), bytes.size())
                               : sendAll(fd, failure.data(), failure.size());
    ::_exit(sent ? 0 : 1);  // no destructors, no atexit: they belong to the parent
}

enum class Received { All, TooLate, Stopped };

// Reads until the child closes its end, or the deadline passes, or nobody wants it any more.
Received receiveAll(int fd, const ChildLimits& limits, Bytes& out) {
    const double wallSeconds = limits.cpuSeconds * kWallPerCpu;
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (;;) {
        int wait = -1;
        if (wallSeconds > 0.0) {
            const double left = wallSeconds - std::chrono::duration<double>(Clock::now() - start).count();
            if (left <= 0.0) return Received::TooLate;
            wait = int(std::min(left * 1000.0 + 1.0, 1e9));
        }
        if (limits.goesOn) {
            if (!limits.goesOn()) return Received::Stopped;
            wait = wait < 0 ? kAskMs : std::min(wait, kAskMs);
        }
        struct pollfd poller {
            fd, POLLIN, 0
        };
        const int ready = ::poll(&poller, 1, wait);
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) {
            if (ready < 0) return Received::TooLate;
            continue;
        }
        const std::size_t used = out.size();
        constexpr std::size_t kPiece = std::size_t(1) << 20;
        if (out.capacity() - used < kPiece) out.reserve(std::max(used * 2, used + kPiece));
        out.resize(used + kPiece);
        const ssize_t got = ::read(fd, out.data() + used, kPiece);
        out.resize(used + std::size_t(std::max<ssize_t>(got, 0)));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return Received::All;
    }
}

std::string deathOf(int status, const ChildLimits& limits) {
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        if (number == SIGPROF || number == SIGXCPU)
            return fmt::format("takes longer than the limit of {:.1f} s", limits.cpuSeconds);
        if (number == SIGKILL) return "was stopped from outside, probably for lack of memory";
        return fmt::format("the importer crashed (signal {})", number);
    }
    return fmt::format("the importer ended without a result (status {})",
                       WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

}  // namespace

ChildResult runInChild(const std::function<Bytes()>& work, const ChildLimits& limits) {
    ChildResult result;
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) {
        result.failure = "no pipe: too many open files";
        return result;
    }
    std::fflush(nullptr);  // else the child could hold copies of unwritten output
    const pid_t child = ::fork();
    if (child < 0) {
        ::close(ends[0]);
        ::close(ends[1]);
        result.failure = "no child process: the system refuses one";
        return result;
    }
    if (child == 0) {
        ::close(ends[0]);
        childMain(ends[1], work, limits);
    }
    ::close(ends[1]);
    Bytes received;
    const Received how = receiveAll(ends[0], limits, received);
    ::close(ends[0]);
    if (how != Received::All) ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }

    // Sort out what came: bytes, a message, or a death.
    if (how == Received::Stopped) {
        result.stopped = true;
        result.failure = "stopped";
    } else if (how == Received::TooLate) {
        result.failure = fmt::format("takes longer than the limit of {:.1f} s", limits.cpuSeconds);
    } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || received.empty()) {
        result.failure = deathOf(status, limits);
    } else if (received[0] == kTagFailure) {
        result.failure.assign(received.begin() + 1, received.end());
    } else {
        received.erase(received.begin());
        result.bytes = std::move(received);
    }
    return result;
}

}  // namespace conelight::io
