// SPDX-License-Identifier: MIT
// Fixture of tests that need OpenGL: one context for all tests of the process, whose state each test finds as
// the first did. After each test no GL error has been reported, and no GL object that it made is left.
// Without a usable context the test is skipped, unless CONELIGHT_REQUIRE_GL is set (scripts/test sets it).
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gl/device.h"
#include "gl/gl.h"
#include "gl/host_state.h"
#include "gl/object.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace conelight::test {

class GlTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;
    // Programs of the embedded shaders, plus files of the test itself (path -> text), which win.
    gl::ProgramLibrary& programs();
    // The same, and a profiler that is off.
    gl::Device device() { return {programs(), profiler_}; }
    void addShader(const std::string& path, const std::string& text);

  private:
    std::vector<std::pair<std::string, std::string>> extra_;
    std::optional<gl::ProgramLibrary> programs_;
    gl::Profiler profiler_;
    std::optional<gl::HostStateGuard> fresh_;                    // sets all state back in TearDown
    std::set<std::pair<gl::ObjectType, gl::Name>> aliveBefore_;  // what an earlier test left
};

// The file or folder PATH of the test data that is not ours to ship (CONELIGHT_TEST_DATA, else ../shared
// beside the sources); nothing when absent: GTEST_SKIP then.
std::optional<std::string> testData(const std::string& path);

// The folder for files that the running test writes, fresh for each; removed with all it holds when the
// process ends.
std::string scratchDir();

// Runs a command line, returns exit status and what it printed (stdout and stderr together).
struct CommandResult {
    int status;
    std::string output;
};
CommandResult runCommand(const std::string& commandLine);

}  // namespace conelight::test
