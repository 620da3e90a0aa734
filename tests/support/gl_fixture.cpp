// SPDX-License-Identifier: MIT
#include "support/gl_fixture.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "conelight/error.h"
#include "gl/debug.h"
#include "gl/object.h"
#include "platform/headless_context.h"

namespace conelight::test {
namespace {

struct SharedContext {
    std::unique_ptr<platform::HeadlessContext> context;
    std::string failure;
    SharedContext() {
        platform::tuneAllocator();
        try {
            platform::HeadlessOptions options;
            options.debug = true;
            context = std::make_unique<platform::HeadlessContext>(options);
            gl::installDebugCallback();
        } catch (const Error& error) {
            failure = error.what();
        }
    }
};

SharedContext& sharedContext() {
    static SharedContext* const shared = new SharedContext;
    return *shared;
}

// Ends the context behind the last test. Mesa writes its kernels to disk in a thread that does not outlive main.
struct ContextEnd : ::testing::Environment {
    void TearDown() override {
        if (used) sharedContext().context.reset();
    }
    static inline bool used = false;
};
const ::testing::Environment* const contextEnd = ::testing::AddGlobalTestEnvironment(new ContextEnd);

}  // namespace

void GlTest::SetUp() {
    ContextEnd::used = true;
    if (!sharedContext().failure.empty()) {
        if (std::getenv("CONELIGHT_REQUIRE_GL") != nullptr) FAIL() << sharedContext().failure;
        GTEST_SKIP() << sharedContext().failure;
    }
    gl::resetDebugErrors();
    // What an earlier test left is that test's failure alone.
    for (const gl::LiveObject& object : gl::liveObjects()) aliveBefore_.emplace(object.type, object.name);
    fresh_.emplace();
}

void GlTest::TearDown() {
    programs_.reset();
    gl::setMostPrograms(gl::kMostPrograms);
    if (!sharedContext().failure.empty()) return;
    EXPECT_EQ(gl::debugErrorCount(), 0) << gl::lastDebugError();
    fresh_.reset();
    for (const gl::LiveObject& object : gl::liveObjects())
        if (!aliveBefore_.contains({object.type, object.name}))
            ADD_FAILURE() << "leaked GL object '" << object.label << "'";
}

gl::ProgramLibrary& GlTest::programs() {
    if (!programs_) {
        programs_.emplace([this, embedded = gl::embeddedShaderProvider()](const std::string& path) {
            for (const auto& [name, text] : extra_)
                if (name == path) return std::optional<std::string>(text);
            return embedded(path);
        });
    }
    return *programs_;
}

void GlTest::addShader(const std::string& path, const std::string& text) { extra_.emplace_back(path, text); }

std::optional<std::string> testData(const std::string& path) {
    const char* root = std::getenv("CONELIGHT_TEST_DATA");
    const std::filesystem::path file =
        (root != nullptr ? std::filesystem::path(root)
                         : std::filesystem::path(CONELIGHT_SOURCE_DIR) / ".." / "shared") /
        path;
    if (!std::filesystem::exists(file)) return std::nullopt;
    return file.lexically_normal().string();
}

std::string scratchDir() {
    struct Dir {
        std::filesystem::path path;
        Dir()
            : path(std::filesystem::temp_directory_path() / ("conelight-test-" + std::to_string(getpid()))) {
            std::filesystem::create_directories(path);
        }
        ~Dir() {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
    };
    static const Dir dir;
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    if (test == nullptr) return dir.path.string();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '.');
    std::filesystem::create_directories(dir.path / name);
    return (dir.path / name).string();
}

CommandResult runCommand(const std::string& commandLine) {
    CommandResult result{-1, ""};
    FILE* pipe = popen((commandLine + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return result;
    char chunk[4096];
    for (std::size_t got; (got = fread(chunk, 1, sizeof chunk, pipe)) > 0;) result.output.append(chunk, got);
    const int status = pclose(pipe);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

}  // namespace conelight::test
