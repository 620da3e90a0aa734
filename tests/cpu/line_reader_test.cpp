// SPDX-License-Identifier: MIT
// Lines of a pipe: whole, in order, at any cut; the end of input costs no processor time.
#include "console/line_reader.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

namespace conelight::program {
namespace {

struct Pipe {
    int ends[2] = {-1, -1};
    Pipe() { EXPECT_EQ(pipe(ends), 0); }
    ~Pipe() {
        closeWriter();
        close(ends[0]);
    }
    void write(const std::string& text) {
        EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    void closeWriter() {
        if (ends[1] >= 0) close(ends[1]);
        ends[1] = -1;
    }
};

void sleepMs(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

// Waits for so many lines, ten seconds at most.
std::vector<std::string> lines(LineReader& reader, std::size_t count) {
    std::vector<std::string> all;
    std::string line;
    for (int i = 0; i < 5000 && all.size() < count; ++i) {
        while (reader.take(line)) all.push_back(line);
        if (all.size() < count) sleepMs(2);
    }
    return all;
}

bool endsSoon(LineReader& reader) {
    for (int i = 0; i < 5000 && !reader.ended(); ++i) sleepMs(2);
    return reader.ended();
}

double threadsCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

TEST(LineReader, LinesComeWholeAndInOrder) {
    Pipe pipe;
    std::atomic<int> woken{0};
    LineReader reader(pipe.ends[0], [&] { ++woken; });
    std::string line;
    EXPECT_FALSE(reader.take(line));
    pipe.write("one\nt");
    EXPECT_EQ(lines(reader, 1), std::vector<std::string>{"one"});
    pipe.write("wo\r\n\nthree\nlast");
    EXPECT_EQ(lines(reader, 3), (std::vector<std::string>{"two", "", "three"}));
    EXPECT_FALSE(reader.ended());
    pipe.closeWriter();
    EXPECT_EQ(lines(reader, 1), std::vector<std::string>{"last"});
    EXPECT_TRUE(endsSoon(reader));
    EXPECT_GE(woken, 5);
}

TEST(LineReader, ManyLinesGetThrough) {
    Pipe pipe;
    LineReader reader(pipe.ends[0]);
    std::thread writer([&] {
        for (int i = 0; i < 20000; ++i) pipe.write(std::to_string(i) + "\n");
        pipe.closeWriter();
    });
    const std::vector<std::string> all = lines(reader, 20000);
    writer.join();
    ASSERT_EQ(all.size(), 20000u);
    for (int i = 0; i < 20000; ++i) ASSERT_EQ(all[static_cast<std::size_t>(i)], std::to_string(i));
}

TEST(LineReader, EndOfInputDoesNotSpin) {
    Pipe pipe;
    LineReader reader(pipe.ends[0]);
    pipe.closeWriter();
    ASSERT_TRUE(endsSoon(reader));
    const double before = threadsCpuMs();
    sleepMs(300);
    EXPECT_LT(threadsCpuMs() - before, 60);  // a thread that spins uses 300
}

TEST(LineReader, EndsWhileNothingIsTyped) {
    Pipe pipe;
    const auto start = std::chrono::steady_clock::now();
    { LineReader reader(pipe.ends[0]); }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace conelight::program
