// SPDX-License-Identifier: MIT
// Pass scopes and their two ways of timing; and what of the driver's messages counts as an error.
#include "gl/pass.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>

#include "base/clock.h"
#include "base/log.h"
#include "conelight/error.h"
#include "gl/debug.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

constexpr char kWork[] =
    "#version 450 core\nlayout(local_size_x = 8) in;\nlayout(std430) buffer Out { uint words[]; "
    "};\n"
    "void main() { uint s = gl_GlobalInvocationID.x; for (int i = 0; i < 2000; ++i) s = s * 1664525u + "
    "1013904223u;\n"
    "    words[gl_GlobalInvocationID.x] = s; }\n";

class PassTest : public GlTest {
  protected:
    // Work for the GPU of more than a millisecond on any software driver.
    void work() {
        if (!out_) {
            addShader("test/work.comp.glsl", kWork);
            out_ = gl::Buffer(4 * 8192, "out");
        }
        programs().compute("test/work.comp.glsl").dispatch(gl::Inputs().storage("Out", out_), 8192);
    }
    void TearDown() override {
        out_.reset();
        GlTest::TearDown();
    }

  private:
    gl::Buffer out_;
};

int groupDepth() {
    GLint depth = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
    return depth;
}

}  // namespace

TEST_F(PassTest, NamesAndTimesInOrder) {
    gl::Profiler profiler;
    profiler.setEnabled(true);
    profiler.setTimer(gl::PassTimer::Cpu);
    work();  // compiles
    profiler.beginFrame();
    {
        const gl::PassScope first(profiler, "first");
        work();
    }
    { const gl::PassScope second(profiler, "second"); }
    { const gl::PassScope again(profiler, "first"); }
    const std::vector<gl::PassTime> times = profiler.endFrame();
    ASSERT_EQ(times.size(), 3u);
    EXPECT_EQ(times[0].name, "first");
    EXPECT_EQ(times[1].name, "second");
    EXPECT_EQ(times[2].name, "first");
    for (const gl::PassTime& time : times) {
        EXPECT_GT(time.cpuMs, 0.0) << time.name;
        EXPECT_GT(time.wallMs, 0.0) << time.name;
        EXPECT_LT(time.gpuMs, 0.0) << time.name;
    }
    // The work is waited for where it was asked for, not in the next pass.
    if (gl::isSoftwareDriver()) {
        EXPECT_GT(times[0].cpuMs, 10 * times[1].cpuMs);
    }
    EXPECT_TRUE(profiler.endFrame().empty());
}

TEST_F(PassTest, NestedScopesCarryTheirPath) {
    gl::Profiler profiler;
    profiler.setEnabled(true);
    profiler.beginFrame();
    const int depth = groupDepth();
    {
        const gl::PassScope outer(profiler, "outer");
        // Enough scopes that the list of passes moves in memory.
        for (int i = 0; i < 40; ++i) {
            const gl::PassScope inner(profiler, "inner");
            EXPECT_EQ(groupDepth(), depth + 2);
        }
        const gl::PassScope a(profiler, "a");
        const gl::PassScope b(profiler, "b");
    }
    EXPECT_EQ(groupDepth(), depth);
    const std::vector<gl::PassTime> times = profiler.endFrame();
    ASSERT_EQ(times.size(), 43u);
    EXPECT_EQ(times[0].name, "outer");
    EXPECT_EQ(times[1].name, "outer/inner");
    EXPECT_EQ(times[41].name, "outer/a");
    EXPECT_EQ(times[42].name, "outer/a/b");
    double inner = 0;
    for (std::size_t i = 1; i <= 41; ++i) inner += times[i].wallMs;
    EXPECT_GE(times[0].wallMs, inner);
}

TEST_F(PassTest, ScopesCloseWhenAPassThrows) {
    gl::Profiler profiler;
    profiler.setEnabled(true);
    profiler.beginFrame();
    const int depth = groupDepth();
    EXPECT_THROW(
        {
            const gl::PassScope outer(profiler, "outer");
            const gl::PassScope inner(profiler, "inner");
            throw std::runtime_error("x");
        },
        std::runtime_error);
    EXPECT_EQ(groupDepth(), depth);
    EXPECT_EQ(profiler.endFrame().size(), 2u);
}

TEST_F(PassTest, DisabledCostsNoObjectsAndNoWaiting) {
    gl::Profiler profiler;
    profiler.beginFrame();
    const int depth = groupDepth();
    {
        const gl::PassScope pass(profiler, "pass");
        EXPECT_EQ(groupDepth(), depth + 1);  // names stay, for debuggers
        EXPECT_EQ(gl::liveObjectCount(), 0u);
    }
    EXPECT_TRUE(profiler.endFrame().empty());
    // Switching on inside a scope begins with the next one.
    {
        const gl::PassScope pass(profiler, "pass");
        profiler.setEnabled(true);
        const gl::PassScope next(profiler, "next");
    }
    const std::vector<gl::PassTime> times = profiler.endFrame();
    ASSERT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].name, "next");
    // It waits for nothing: far cheaper than an enabled one, which does. The least of some rounds each, as
    // other programs may run beside.
    double off = 1e9, on = 1e9;
    for (int round = 0; round < 5; ++round)
        for (const bool enabled : {false, true}) {
            profiler.setEnabled(enabled);
            profiler.beginFrame();
            const double start = base::processCpuMs();
            for (int i = 0; i < 1000; ++i) const gl::PassScope pass(profiler, "pass");
            double& least = enabled ? on : off;
            least = std::min(least, base::processCpuMs() - start);
            profiler.endFrame();
        }
    RecordProperty("disabledScopesMs", std::to_string(off));
    RecordProperty("enabledScopesMs", std::to_string(on));
    EXPECT_LT(2 * off, on);
}

// Values of the timer are wrong on llvmpipe, but they come, and the queries go.
TEST_F(PassTest, QueriesTimeOnAGpu) {
    gl::Profiler profiler;
    profiler.setEnabled(true);
    profiler.setTimer(gl::PassTimer::Gpu);
    profiler.beginFrame();
    {
        const gl::PassScope outer(profiler, "outer");
        work();
        const gl::PassScope inner(profiler, "inner");
        work();
        EXPECT_GE(gl::liveObjectCount(), 4u);
    }
    const std::vector<gl::PassTime> times = profiler.endFrame();
    ASSERT_EQ(times.size(), 2u);
    for (const gl::PassTime& time : times) {
        EXPECT_GE(time.gpuMs, 0.0) << time.name;
        EXPECT_GT(time.cpuMs, 0.0) << time.name;
    }
    EXPECT_GE(times[0].gpuMs, times[1].gpuMs);
    for (const gl::LiveObject& object : gl::liveObjects())
        EXPECT_NE(object.type, gl::ObjectType::Query) << object.label;
}

// Documented: CPU time is that of the process, so what other threads compute meanwhile is in it.
TEST_F(PassTest, CpuTimeIncludesOtherThreads) {
    gl::Profiler profiler;
    profiler.setEnabled(true);
    profiler.setTimer(gl::PassTimer::Cpu);
    std::atomic<bool> stop{false};
    std::atomic<double> threadCpuMs{0};
    profiler.beginFrame();
    {
        const gl::PassScope pass(profiler, "idle here, busy there");
        std::thread busy([&] {
            const auto now = [] {
                timespec time{};
                clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
                return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
            };
            while (!stop) threadCpuMs = now();
        });
        while (threadCpuMs < 20) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stop = true;
        busy.join();
    }
    const std::vector<gl::PassTime> times = profiler.endFrame();
    EXPECT_GE(times.at(0).cpuMs, 20.0);
}

TEST_F(PassTest, BarriersOfAllKindsAreLegal) {
    for (const gl::Access access :
         {gl::Access::ShaderStorage, gl::Access::ImageAccess, gl::Access::TextureFetch, gl::Access::Indirect,
          gl::Access::Uniform, gl::Access::Framebuffer, gl::Access::VertexFetch, gl::Access::Update})
        gl::barrier(access | gl::Access::ShaderStorage);
    EXPECT_EQ(gl::debugErrorCount(), 0) << gl::lastDebugError();
}

TEST_F(PassTest, AWrongCallIsCountedAndLogged) {
    std::vector<std::pair<LogLevel, std::string>> messages;
    setLogCallback([&](LogLevel level, std::string_view text) { messages.emplace_back(level, text); });
    glEnable(GL_TEXTURE_2D_ARRAY);  // no capability
    setLogCallback({});
    EXPECT_EQ(gl::debugErrorCount(), 1);
    EXPECT_FALSE(gl::lastDebugError().empty());
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].first, LogLevel::Error);
    EXPECT_EQ(messages[0].second, "OpenGL: " + gl::lastDebugError());
    gl::resetDebugErrors();
    EXPECT_EQ(gl::debugErrorCount(), 0);
    EXPECT_TRUE(gl::lastDebugError().empty());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_ENUM));
}

TEST_F(PassTest, OtherMessagesAreNoErrors) {
    std::vector<std::pair<LogLevel, std::string>> messages;
    setLogCallback([&](LogLevel level, std::string_view text) { messages.emplace_back(level, text); });
    const auto say = [](GLenum type, GLenum severity, const char* text) {
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, severity, -1, text);
    };
    say(GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_MEDIUM, "slow");
    say(GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_NOTIFICATION, "note");
    say(GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_HIGH, "very slow");
    setLogCallback({});
    EXPECT_EQ(gl::debugErrorCount(), 0);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].first, LogLevel::Warning);
    EXPECT_EQ(messages[0].second, "OpenGL: very slow");
}

// Exceptions must not pass through the driver, which is C.
TEST_F(PassTest, AThrowingLogCallbackIsHarmless) {
    setLogCallback([](LogLevel, std::string_view) { throw std::runtime_error("x"); });
    glEnable(GL_TEXTURE_2D_ARRAY);
    setLogCallback({});
    EXPECT_EQ(gl::debugErrorCount(), 1);
    gl::resetDebugErrors();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_ENUM));
}

TEST_F(PassTest, ALogCallbackMayLogAndChangeTheCallback) {
    int outer = 0, inner = 0;
    setLogCallback([&](LogLevel, std::string_view) {
        ++outer;
        setLogCallback([&](LogLevel, std::string_view) { ++inner; });
        base::log(LogLevel::Info, "from inside");
        ++outer;  // what the callback holds is still alive
    });
    base::log(LogLevel::Info, "from outside");
    setLogCallback({});
    base::log(LogLevel::Info, "to nobody");
    EXPECT_EQ(outer, 2);
    EXPECT_EQ(inner, 1);
}

}  // namespace conelight::test
