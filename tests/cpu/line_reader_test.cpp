// SPDX-License-Identifier: MIT
// Lines of a pipe: whole, in order, at any cut; the end of input costs no processor time.
#include "console/line_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <iterator>
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

// Rounds of 2 ms: only what hangs waits for so many.
constexpr int kPatience = 300000;

// Waits for so many lines.
std::vector<std::string> lines(LineReader& reader, std::size_t count) {
    std::vector<std::string> all;
    std::string line;
    for (int i = 0; i < kPatience && all.size() < count; ++i) {
        while (reader.take(line)) all.push_back(line);
        if (all.size() < count) sleepMs(2);
    }
    return all;
}

bool endsSoon(LineReader& reader) {
    for (int i = 0; i < kPatience && !reader.ended(); ++i) sleepMs(2);
    return reader.ended();
}

// Threads of this process.
std::ptrdiff_t threads() {
    namespace fs = std::filesystem;
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
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

// At the end of input its thread ends: nothing is left that could spin.
TEST(LineReader, EndOfInputDoesNotSpin) {
    Pipe pipe;
    const std::ptrdiff_t before = threads();
    LineReader reader(pipe.ends[0]);
    EXPECT_EQ(threads(), before + 1);
    pipe.closeWriter();
    ASSERT_TRUE(endsSoon(reader));
    for (int i = 0; i < kPatience && threads() > before; ++i) sleepMs(2);
    EXPECT_EQ(threads(), before);
}

TEST(LineReader, EndsWhileNothingIsTyped) {
    Pipe pipe;
    LineReader reader(pipe.ends[0]);  // a destructor that waits for a line would hang here
}

}  // namespace
}  // namespace conelight::program
