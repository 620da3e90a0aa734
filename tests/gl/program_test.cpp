// SPDX-License-Identifier: MIT
// Programs: errors with file and line, rebuilding of changed shaders, and the three ways to dispatch.
#include "gl/program.h"

#include <algorithm>
#include <map>
#include <memory>

#include "conelight/error.h"
#include "gl/draw.h"
#include "gl/pass.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

const std::string kHead = "#version 450 core\nlayout(local_size_x = 8) in;\n";

// A provider whose files the test changes.
struct Files {
    std::map<std::string, std::string> texts;
    gl::ShaderProvider provider() {
        return [this](const std::string& path) -> std::optional<std::string> {
            const auto found = texts.find(path);
            return found != texts.end() ? std::optional<std::string>(found->second)
                                        : gl::embeddedShaderProvider()(path);
        };
    }
};

std::string failureOf(Files& files, const gl::ProgramDesc& desc) {
    try {
        const gl::Program program(files.provider(), desc);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        return error.what();
    }
    return "no error";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Writes `value` into word 0 of block Out.
std::string writer(int value) {
    return kHead +
           "layout(std430) buffer Out { uint word; };\nvoid main() { word = " + std::to_string(value) +
           "u; }\n";
}

std::uint32_t run(const gl::Program& program) {
    const gl::Buffer out(16, "out");
    program.dispatch(gl::Inputs().storage("Out", out), 8);
    return out.read<std::uint32_t>(1)[0];
}

class ProgramTest : public GlTest {
  protected:
    Files files;
};

}  // namespace

TEST_F(ProgramTest, CompileErrorNamesFileLineAndText) {
    files.texts["a.comp.glsl"] = kHead + "#include \"lib/broken.glsl\"\nvoid main() { broken(); }\n";
    files.texts["lib/broken.glsl"] = "// head\n\nvoid broken() { int x = undeclaredName; }\n";
    const std::string message = failureOf(files, {{"a.comp.glsl"}, {{"N", "1"}}});
    EXPECT_EQ(message.rfind("a.comp.glsl: does not compile:\nlib/broken.glsl:3: ", 0), 0u) << message;
    EXPECT_TRUE(contains(message, "undeclaredName")) << message;
    EXPECT_TRUE(contains(message, "\n    void broken() { int x = undeclaredName; }")) << message;
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

TEST_F(ProgramTest, LinkErrorNamesTheProgram) {
    files.texts["a.vert.glsl"] =
        "#version 450 core\nlayout(location = 0) out vec2 v;\nvoid main() { v = vec2(0); gl_Position = "
        "vec4(0); }\n";
    files.texts["a.frag.glsl"] =
        "#version 450 core\nlayout(location = 0) in mat4 v;\nlayout(location = 0) out vec4 c;\nvoid main() { "
        "c = v[0]; }\n";
    const std::string message = failureOf(files, {{"a.vert.glsl", "a.frag.glsl"}, {{"B", "2"}}});
    EXPECT_EQ(message.rfind("a.vert.glsl a.frag.glsl[B=2]: does not link: ", 0), 0u) << message;
    EXPECT_GT(message.size(), 60u) << "the driver's reason is missing";
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

TEST_F(ProgramTest, StageComesFromTheName) {
    files.texts["a.glsl"] = "#version 450 core\n";
    EXPECT_EQ(failureOf(files, {{"a.glsl"}, {}}),
              "a.glsl: no stage in the name; .vert .geom .frag or .comp would be right");
    EXPECT_TRUE(
        contains(failureOf(files, {{"none.comp.glsl"}, {}}), "there is no shader file 'none.comp.glsl'"));
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

TEST_F(ProgramTest, LibraryBuildsEachVariantOnce) {
    files.texts["a.comp.glsl"] =
        kHead + "layout(std430) buffer Out { uint word; };\nvoid main() { word = N; }\n";
    gl::ProgramLibrary library(files.provider());
    const gl::Program& three = library.compute("a.comp.glsl", {{"N", "3"}});
    const gl::Program& four = library.compute("a.comp.glsl", {{"N", "4"}});
    EXPECT_EQ(&three, &library.compute("a.comp.glsl", {{"N", "3"}}));
    EXPECT_EQ(gl::liveObjectCount(), 2u);
    EXPECT_EQ(run(three), 3u);
    EXPECT_EQ(run(four), 4u);
    // A variant that fails is not kept: the next request tries again.
    EXPECT_THROW(library.compute("a.comp.glsl"), Error);
    EXPECT_EQ(gl::liveObjectCount(), 2u);
    EXPECT_EQ(library.sourceFiles(), std::vector<std::string>{"a.comp.glsl"});
}

TEST_F(ProgramTest, LibraryKeepsWhatWasAskedForLast) {
    files.texts["a.comp.glsl"] =
        kHead + "layout(std430) buffer Out { uint word; };\nvoid main() { word = N; }\n";
    gl::ProgramLibrary library(files.provider());
    const auto get = [&](int n) -> const gl::Program& {
        return library.compute("a.comp.glsl", {{"N", std::to_string(n)}});
    };
    const auto kept = [] {
        std::string numbers;
        for (const gl::LiveObject& object : gl::liveObjects())
            numbers += object.label.substr(object.label.find('=') + 1, 1);
        std::sort(numbers.begin(), numbers.end());
        return numbers;
    };
    gl::setMostPrograms(3);
    for (const int n : {1, 2, 3, 4, 5}) get(n);
    library.trim();
    EXPECT_EQ(kept(), "12345") << "one picture's programs stay, however many they are";
    get(2);
    get(6);
    library.trim();
    EXPECT_EQ(kept(), "256");
    library.trim();
    EXPECT_EQ(kept(), "256") << "no more than there may be";
    // What comes back is built anew.
    EXPECT_EQ(run(get(1)), 1u);
    library.trim();
    EXPECT_EQ(kept(), "126");
}

TEST_F(ProgramTest, ReloadSwapsOnSuccessAndKeepsOnFailure) {
    files.texts["a.comp.glsl"] = writer(1);
    files.texts["b.comp.glsl"] = writer(10);
    gl::ProgramLibrary library(files.provider());
    const gl::Program& a = library.compute("a.comp.glsl");
    const gl::Program& b = library.compute("b.comp.glsl");
    // Success: the same object runs the new text; programs of other files stay.
    const gl::Name untouched = b.name();
    files.texts["a.comp.glsl"] = writer(2);
    files.texts["b.comp.glsl"] = writer(20);
    EXPECT_TRUE(library.reload({"a.comp.glsl", "unknown.glsl"}).empty());
    EXPECT_EQ(run(a), 2u);
    EXPECT_EQ(b.name(), untouched);
    EXPECT_EQ(run(b), 10u);
    // Failure: the old one runs on, and the message says where.
    // Not at the end of the text, where some drivers name no line.
    files.texts["a.comp.glsl"] = writer(3) + "oops oops;\nint afterwards;\n";
    const std::vector<std::string> failures = library.reload({"a.comp.glsl"});
    ASSERT_EQ(failures.size(), 1u);
    EXPECT_TRUE(contains(failures[0], "a.comp.glsl:5")) << failures[0];
    EXPECT_EQ(run(a), 2u);
    EXPECT_EQ(gl::liveObjectCount(), 2u);
    files.texts["a.comp.glsl"] = writer(4);
    EXPECT_TRUE(library.reload({"a.comp.glsl"}).empty());
    EXPECT_EQ(run(a), 4u);
}

// The fault may sit in a file that the running version does not include.
TEST_F(ProgramTest, ReloadAfterAFailureWatchesNewIncludes) {
    files.texts["a.comp.glsl"] = writer(1);
    gl::ProgramLibrary library(files.provider());
    const gl::Program& a = library.compute("a.comp.glsl");
    files.texts["a.comp.glsl"] = kHead + "#include \"lib/new.glsl\"\n" + writer(2).substr(kHead.size());
    files.texts["lib/new.glsl"] = "oops\n";
    EXPECT_EQ(library.reload({"a.comp.glsl"}).size(), 1u);
    files.texts["lib/new.glsl"] = "// mended\n";
    EXPECT_TRUE(library.reload({"lib/new.glsl"}).empty());
    EXPECT_EQ(run(a), 2u);
    EXPECT_EQ(library.sourceFiles(), (std::vector<std::string>{"a.comp.glsl", "lib/new.glsl"}));
}

TEST_F(ProgramTest, DispatchRoundsUpToWholeGroups) {
    files.texts["a.comp.glsl"] =
        "#version 450 core\nlayout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;\n"
        "layout(std430) buffer Out { uint count; };\nvoid main() { atomicAdd(count, 1u); }\n";
    gl::ProgramLibrary library(files.provider());
    const gl::Program& program = library.compute("a.comp.glsl");
    EXPECT_EQ(program.groupSize(), glm::ivec3(8, 4, 2));
    const auto invocations = [&](int x, int y, int z) {
        const gl::Buffer out(16, "out");
        program.dispatch(gl::Inputs().storage("Out", out), x, y, z);
        return out.read<std::uint32_t>(1)[0];
    };
    EXPECT_EQ(invocations(8, 4, 2), 64u);
    EXPECT_EQ(invocations(9, 4, 3), 256u);
    EXPECT_EQ(invocations(1, 1, 1), 64u);
    EXPECT_EQ(invocations(0, 4, 2), 0u);
    EXPECT_EQ(invocations(8, -1, 2), 0u);
}

// Every index below the count exactly once, none lost where groups fold into a second row.
TEST_F(ProgramTest, LinearDispatchCoversEveryIndexOnce) {
    const auto shader = [](const std::string& size) {
        return "#version 450 core\nlayout(" + size +
               ") in;\n#include \"lib/linear_index.glsl\"\n"
               "layout(std430) buffer Out { uint hits[]; };\n"
               "void main() { uint i = linearIndex(); if (i < hits.length()) atomicAdd(hits[i], 1u); }\n";
    };
    files.texts["a.comp.glsl"] = shader("local_size_x = 8");
    files.texts["b.comp.glsl"] = shader("local_size_x = 8, local_size_y = 2, local_size_z = 2");
    gl::ProgramLibrary library(files.provider());
    for (const char* name : {"a.comp.glsl", "b.comp.glsl"}) {
        const gl::Program& program = library.compute(name);
        const std::size_t row =
            65535u *
            static_cast<std::size_t>(program.groupSize().x * program.groupSize().y * program.groupSize().z);
        for (const std::size_t count : {std::size_t{4}, std::size_t{1000}, row, row + 4, 2 * row + 36}) {
            const std::vector<std::uint32_t> zeros(count, 0);
            gl::Buffer hits(zeros, "hits");
            program.dispatchLinear(gl::Inputs().storage("Out", hits), count);
            EXPECT_EQ(hits.read<std::uint32_t>(count), std::vector<std::uint32_t>(count, 1))
                << name << ", " << count;
        }
        gl::Buffer hits(64, "hits");
        program.dispatchLinear(gl::Inputs().storage("Out", hits), 0);
        EXPECT_EQ(hits.read<std::uint32_t>(16), std::vector<std::uint32_t>(16, 0));
    }
}

TEST_F(ProgramTest, IndirectDispatchReadsCountsThatAShaderWrote) {
    files.texts["count.comp.glsl"] = kHead +
                                     "layout(std430) buffer Groups { uint groups[]; };\n"
                                     "void main() { if (gl_GlobalInvocationID.x < 3u) groups[4u + "
                                     "gl_GlobalInvocationID.x] = gl_GlobalInvocationID.x + 2u; }\n";
    files.texts["work.comp.glsl"] =
        kHead + "layout(std430) buffer Out { uint count; };\nvoid main() { atomicAdd(count, 1u); }\n";
    gl::ProgramLibrary library(files.provider());
    gl::Buffer groups(32, "groups"), out(16, "out");
    library.compute("count.comp.glsl").dispatch(gl::Inputs().storage("Groups", groups), 8);
    gl::barrier(gl::Access::Indirect);
    library.compute("work.comp.glsl").dispatchIndirect(gl::Inputs().storage("Out", out), groups, 16);
    EXPECT_EQ(out.read<std::uint32_t>(1)[0], 2u * 3 * 4 * 8);
    GLint bound = -1;
    glGetIntegerv(GL_DISPATCH_INDIRECT_BUFFER_BINDING, &bound);
    EXPECT_EQ(bound, 0);
}

// Of every kind that a program reads; whatever a pass before has left bound does not count.
TEST_F(ProgramTest, WhatAPassDoesNotGiveIsAnErrorThatNamesIt) {
    files.texts["a.comp.glsl"] =
        kHead +
        "layout(std140) uniform Constants { uvec4 constants; };\n"
        "layout(std430) buffer Out { uint word; };\nuniform usampler2D picture;\n"
        "layout(r32ui) writeonly uniform uimage2D target;\n"
        "void main() { uint x = texelFetch(picture, ivec2(0), 0).x + constants.x; word = x;\n"
        "imageStore(target, ivec2(0), uvec4(x)); }\n";
    gl::ProgramLibrary library(files.provider());
    const gl::Program& program = library.compute("a.comp.glsl");
    const gl::Buffer constants(16, "constants"), out(16, "out");
    const gl::Texture picture({GL_TEXTURE_2D, GL_R32UI, 1, 1}, "picture");
    const gl::Texture target({GL_TEXTURE_2D, GL_R32UI, 1, 1}, "target");
    const auto given = [&](int without) {
        gl::Inputs inputs;
        if (without != 0) inputs.uniform("Constants", constants);
        if (without != 1) inputs.storage("Out", out);
        if (without != 2) inputs.texture("picture", picture);
        if (without != 3) inputs.image("target", target, gl::ImageUse::Write);
        return inputs;
    };
    EXPECT_EQ(program.slots().size(), 4u);
    const char* const missing[] = {"uniform block Constants", "storage block Out", "texture picture",
                                   "image target"};
    for (int i = 0; i < 4; ++i) {
        program.dispatch(given(-1), 8);  // leaves all of them bound
        try {
            program.dispatch(given(i), 8);
            ADD_FAILURE() << missing[i];
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()),
                      "a.comp.glsl: reads " + std::string(missing[i]) + ", which the pass does not give it");
        }
    }
    // What a program does not read may be given.
    program.dispatch(given(-1).storage("Other", out), 8);
    // A buffer under the name of a texture is none.
    EXPECT_THROW(program.dispatch(given(2).storage("picture", out), 8), Error);
}

// Keeps programs in memory.
struct KeptPrograms : ProgramCache {
    std::map<std::string, std::vector<std::uint8_t>> kept;
    bool suits(bool) const override { return true; }
    std::vector<std::uint8_t> load(const std::string& key) override { return kept[key]; }
    void keep(const std::string& key, std::span<const std::uint8_t> bytes) override {
        kept[key].assign(bytes.begin(), bytes.end());
    }
};

// A driver has formats for that if it likes: Mesa's, where it keeps files of its own.
TEST_F(ProgramTest, KeptProgramsNeedNoSources) {
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    const auto cache = std::make_shared<KeptPrograms>();
    std::vector<std::string> log;
    setLogCallback([&](LogLevel, std::string_view line) { log.emplace_back(line); });
    files.texts["a.comp.glsl"] = writer(7);
    struct Made {
        std::uint64_t built, loaded;
        std::uint32_t word;
    };
    // By a library of its own, as at a new start.
    const auto make = [&] {
        const gl::ProgramCounts before = gl::programCounts();
        gl::ProgramLibrary library(files.provider(), cache);
        const std::uint32_t word = run(library.compute("a.comp.glsl"));
        const gl::ProgramCounts after = gl::programCounts();
        return Made{after.built - before.built, after.loaded - before.loaded, word};
    };
    const auto expectMade = [&](std::uint64_t loaded, std::uint32_t word, std::size_t lines) {
        const Made made = make();
        EXPECT_EQ(made.word, word);
        EXPECT_EQ(made.loaded, formats > 0 ? loaded : 0);
        EXPECT_EQ(made.built + made.loaded, 1u);
        EXPECT_EQ(log.size(), formats > 0 ? lines : 0);
    };
    expectMade(0, 7, 0);
    expectMade(1, 7, 0);
    // Another text is another program; the first is still there.
    files.texts["a.comp.glsl"] = writer(8);
    expectMade(0, 8, 0);
    files.texts["a.comp.glsl"] = writer(7);
    expectMade(1, 7, 0);
    // Damage in any place: a line each, and what is built takes its place.
    std::size_t lines = 0;
    const std::vector<std::size_t> places{0, 8, 16, 24, 40};
    for (const std::size_t place : places) {
        for (auto& [key, bytes] : cache->kept)
            if (bytes.size() > place) bytes[place] ^= 0x40;
        // The format is no part of what is checked: a driver that does not list it is not asked.
        expectMade(0, 7, ++lines);
        expectMade(1, 7, lines);
    }
    for (auto& [key, bytes] : cache->kept) bytes.resize(bytes.size() / 2);
    expectMade(0, 7, ++lines);
    setLogCallback({});
    if (formats > 0) {
        EXPECT_EQ(log.front(),
                  "program cache: a.comp.glsl: what was kept is damaged; built from its sources");
        EXPECT_EQ(
            log[3],
            "program cache: a.comp.glsl: what was kept is of no use to this driver; built from its sources");
    }
}

using ProgramDeathTest = ProgramTest;

TEST_F(ProgramDeathTest, MisuseStopsTheProgram) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    files.texts["a.comp.glsl"] = writer(1);
    gl::ProgramLibrary library(files.provider());
    const gl::Program& program = library.compute("a.comp.glsl");
    gl::Buffer groups(16, "groups");
    EXPECT_DEATH(program.dispatch({}, 65536 * 8), "too many groups; dispatchLinear folds them");
    EXPECT_DEATH(program.dispatchIndirect({}, groups, 8), "reaches past the end");
    EXPECT_DEATH(gl::Program().dispatch({}, 8), "not a compute program");
}

}  // namespace conelight::test
