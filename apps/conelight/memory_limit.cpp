// SPDX-License-Identifier: MIT
#include "memory_limit.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <fstream>

#include "conelight/memory.h"
#include "platform/headless_context.h"

namespace conelight::program {
namespace {

// Bytes of heap and anonymous memory, which is what RLIMIT_DATA counts (proc(5), statm); 0: unknown.
std::uint64_t dataBytes() {
#ifdef __linux__
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages[6] = {};
    for (std::uint64_t& count : pages) file >> count;
    if (file) return pages[5] * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
#endif
    return 0;
}

}  // namespace

void addMemory(CLI::App& command) {
    command
        .add_option_function<int>(
            "--memory",
            [](const int& megabytes) { setMemoryLimit(static_cast<std::size_t>(megabytes) << 20); },
            "most memory in MB, for OpenGL objects and as much again for the scene and the modes on the CPU: "
            "what "
            "would need more is drawn with smaller shadow maps, fewer voxels and smaller textures, which is "
            "said, or "
            "refused")
        ->type_name("MB")
        ->check(CLI::Range(8, 1 << 20));
}

std::uint64_t texelsWithin(std::uint64_t most) {
    // Four bytes each, a third more with the smaller levels: a third of the memory.
    constexpr std::uint64_t kBytesPerTexel = 16;
    const std::uint64_t limit = memoryLimit();
    return limit == 0 ? most : std::min(most, limit / kBytesPerTexel);
}

HostMemoryLimit::HostMemoryLimit() {
    if (memoryLimit() == 0) return;
#ifdef __linux__
#ifdef __GLIBC__
    // What lies ready for later counts as taken otherwise, and what is put ready next may be too much at once.
    malloc_trim(0);
    constexpr int kReserve = 1 << 20;
    mallopt(M_TOP_PAD, kReserve);
#endif
    const std::uint64_t now = dataBytes();
    rlimit limit{};
    if (now == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
    before_ = limit.rlim_cur;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, now + memoryLimit());
    limits_ = setrlimit(RLIMIT_DATA, &limit) == 0;
#endif
}

HostMemoryLimit::~HostMemoryLimit() {
    if (memoryLimit() == 0) return;
#ifdef __linux__
    rlimit limit{};
    if (limits_ && getrlimit(RLIMIT_DATA, &limit) == 0) {
        limit.rlim_cur = before_;
        setrlimit(RLIMIT_DATA, &limit);
    }
    platform::tuneAllocator();
#endif
}

}  // namespace conelight::program
