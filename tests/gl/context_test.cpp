// SPDX-License-Identifier: MIT
// The context without a display: two at a time and one after the other, choice of a device, what is said when
// there is none; and what the library says of the context it finds.
#include "platform/headless_context.h"

#include <unistd.h>

#include <algorithm>
#include <thread>

#include "conelight/error.h"
#include "gl/buffer.h"
#include "gl/debug.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

// Each test makes contexts of its own, above the one of the process.
using ContextTest = GlTest;

// The kind and message of the Error that `call` throws.
template <class Call>
std::pair<std::optional<ErrorKind>, std::string> failureOf(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return {error.kind(), error.what()};
    }
    return {std::nullopt, "no error"};
}

}  // namespace

TEST_F(ContextTest, OneAfterTheOther) {
    for (int i = 0; i < 2; ++i) {
        const platform::HeadlessContext context;
        // A driver may give 4.6, which has all of 4.5.
        EXPECT_NE(context.description().find("OpenGL 4."), std::string::npos) << context.description();
        gl::requireContext();
        const gl::Buffer buffer(std::vector<std::uint32_t>{7, 8, 9, 10}, "numbers");
        EXPECT_EQ(buffer.read<std::uint32_t>(1, 8)[0], 9u);
    }
}

// The display is shared inside EGL: the end of the inner context must not end the outer one.
TEST_F(ContextTest, NestedContextsGiveTheOuterOneBack) {
    const gl::Buffer outer(std::vector<std::uint32_t>{1, 2, 3, 4}, "outer");
    {
        const platform::HeadlessContext first;
        const gl::Buffer inner(std::vector<std::uint32_t>{5, 6, 7, 8}, "inner");
        // Names repeat between contexts; the list of live objects keeps them apart.
        EXPECT_EQ(gl::liveObjectCount(), 2u);
        {
            const platform::HeadlessContext second;
            gl::requireContext();
        }
        EXPECT_EQ(inner.read<std::uint32_t>(1)[0], 5u);
    }
    EXPECT_EQ(gl::liveObjectCount(), 1u);
    EXPECT_EQ(outer.read<std::uint32_t>(1)[0], 1u);
}

// Calls from any thread, one at a time; each thread has back what was current there.
TEST_F(ContextTest, AReleasedContextIsCurrentWhereItIsAskedFor) {
    const gl::Buffer outer(std::vector<std::uint32_t>{1, 2, 3, 4}, "outer");
    platform::HeadlessContext context;
    context.release();
    EXPECT_EQ(outer.read<std::uint32_t>(1)[0], 1u);
    std::optional<gl::Buffer> inner;
    std::thread([&] {
        {
            const platform::CurrentContext current(context);
            inner.emplace(std::vector<std::uint32_t>{5, 6, 7, 8}, "inner");
        }
        EXPECT_EQ(failureOf([] { gl::requireContext(); }).first, ErrorKind::NoGl);
    }).join();
    {
        const platform::CurrentContext current(context);
        EXPECT_EQ(inner->read<std::uint32_t>(1)[0], 5u);
        std::pair<std::optional<ErrorKind>, std::string> elsewhere;
        std::thread([&] { elsewhere = failureOf([&] { platform::CurrentContext second(context); }); }).join();
        EXPECT_EQ(elsewhere.first, ErrorKind::Runtime) << elsewhere.second;
        inner.reset();
    }
    EXPECT_EQ(outer.read<std::uint32_t>(1)[0], 1u);
}

TEST_F(ContextTest, DevicesAreListedByNumber) {
    const std::vector<std::string> lines = platform::listDevices();
    if (lines.empty()) GTEST_SKIP() << "EGL lists no device; only the surfaceless platform works here";
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].rfind(std::to_string(i) + ": ", 0), 0u) << lines[i];
        EXPECT_TRUE(lines[i].find("software") != std::string::npos ||
                    lines[i].find("hardware") != std::string::npos)
            << lines[i];
    }
}

TEST_F(ContextTest, AnUnknownDeviceIsWrongUsage) {
    const std::size_t count = platform::listDevices().size();
    if (count == 0) GTEST_SKIP() << "EGL lists no device";
    for (const int device : {static_cast<int>(count), 99, -2}) {
        const auto [kind, message] = failureOf([&] { platform::HeadlessContext context({device, false}); });
        EXPECT_EQ(kind, ErrorKind::Usage) << device;
        EXPECT_EQ(message.rfind("--device: there is no EGL device " + std::to_string(device) + "; 0", 0), 0u)
            << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
    gl::requireContext();
}

TEST_F(ContextTest, AThreadWithoutAContextIsAnError) {
    std::pair<std::optional<ErrorKind>, std::string> result;
    std::thread([&] { result = failureOf([] { gl::requireContext(); }); }).join();
    EXPECT_EQ(result.first, ErrorKind::NoGl);
    EXPECT_EQ(result.second,
              "OpenGL: no context is current on this thread; a 4.5 core context would be right");
}

// A child process in which EGL finds no driver: this test program itself, running the test below.
TEST_F(ContextTest, WithoutADriverTheErrorSaysWhatWasTried) {
    // Not a part of the tests, where these are shared out.
    const CommandResult run = runCommand(
        "env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX "
        "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent " +
        std::string("/proc/") + std::to_string(getpid()) +
        "/exe --gtest_also_run_disabled_tests "
        "--gtest_filter='NoDriverTest.*'");
    EXPECT_EQ(run.status, 0) << run.output;
    EXPECT_NE(run.output.find("[  PASSED  ] 1 test."), std::string::npos) << run.output;
}

TEST(NoDriverTest, DISABLED_ThrowsNoGl) {
    EXPECT_TRUE(platform::listDevices().empty());
    const auto [kind, message] = failureOf([] { platform::HeadlessContext context; });
    EXPECT_EQ(kind, ErrorKind::NoGl);
    EXPECT_EQ(message.rfind("OpenGL: no 4.5 core context without a display (", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(failureOf([] { gl::requireContext(); }).first, ErrorKind::NoGl);
    EXPECT_EQ(failureOf([] { platform::HeadlessContext context({0, false}); }).first, ErrorKind::NoGl);
    std::printf("%s\n", message.c_str());
}

TEST_F(ContextTest, TheProgramEndsWithStatusFour) {
    const CommandResult run = runCommand("env __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent " CONELIGHT_PROGRAM
                                         " render builtin:cornell -o " +
                                         scratchDir() + "/picture.png --size 8x8");
    EXPECT_EQ(run.status, 4) << run.output;
    EXPECT_EQ(run.output.rfind("conelight: OpenGL: no 4.5 core context", 0), 0u) << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
}

}  // namespace conelight::test
