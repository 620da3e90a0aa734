// SPDX-License-Identifier: MIT
// What is told of work: passes and programs by their names, and nothing where nobody asks.
#include "gl/work.h"

#include <optional>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "gl/program.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

using WorkTest = GlTest;

TEST_F(WorkTest, ProgramsAreCountedWhileTheyAreBuilt) {
    std::vector<gl::Work::Piece> during;
    gl::Work work;
    gl::ProgramLibrary library([&](const std::string& path) -> std::optional<std::string> {
        if (gl::Work::current() != nullptr) during.push_back(gl::Work::current()->now());
        return "#version 450 core\nlayout(local_size_x = 8) in;\n// " + path + "\nvoid main() {}\n";
    });
    library.compute("alone.comp.glsl");
    EXPECT_TRUE(during.empty()) << "nobody asks";
    {
        const gl::WorkScope told(work);
        gl::Profiler profiler;
        const gl::PassScope pass(profiler, "the pass");
        for (const char* file : {"a.comp.glsl", "b.comp.glsl", "a.comp.glsl"}) library.compute(file);
        EXPECT_EQ(work.now().name, "the pass") << "it goes on behind them";
    }
    EXPECT_EQ(gl::Work::current(), nullptr);
    ASSERT_EQ(during.size(), 2u) << "what is there is not built again";
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(during[i].name, "building programs");
        EXPECT_EQ(during[i].done, i + 1);
        EXPECT_EQ(during[i].total, 0u);
    }
    work.begin();
    EXPECT_EQ(work.now().name, "");
}

}  // namespace
}  // namespace conelight::test
