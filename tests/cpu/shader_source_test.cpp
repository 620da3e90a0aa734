// SPDX-License-Identifier: MIT
// The include resolver, its line table and the rewriting of driver logs, on texts of the test itself; and
// that every shader file arrives in the library byte for byte.
#include "gl/shader_source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "conelight/error.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

using Files = std::map<std::string, std::string>;

gl::ShaderProvider from(const Files& files) {
    return [files](const std::string& path) -> std::optional<std::string> {
        const auto found = files.find(path);
        return found != files.end() ? std::optional<std::string>(found->second) : std::nullopt;
    };
}

// The message of the Error that expanding "a.comp.glsl" throws; empty when it throws none.
std::string failureOf(const Files& files) {
    try {
        (void)gl::expandShader(from(files), "a.comp.glsl");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        return error.what();
    }
    return "";
}

std::string readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

void writeFile(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

// The place an expanded line came from, as file:line.
std::string placeOf(const gl::ExpandedShader& shader, std::size_t line) {
    const auto& at = shader.lines.at(line - 1);
    return at.file < 0 ? "define"
                       : shader.files.at(static_cast<std::size_t>(at.file)) + ":" + std::to_string(at.line);
}

}  // namespace

TEST(ShaderSourceTest, IncludesArriveOnceInPlace) {
    const gl::ExpandedShader shader = gl::expandShader(
        from({{"a.comp.glsl", "#version 450 core\n#include \"b.glsl\"\n#include \"c.glsl\"\nmain\n"},
              {"b.glsl", "#include \"c.glsl\"\nb\n"},
              {"c.glsl", "c\n"}}),
        "a.comp.glsl");
    EXPECT_EQ(shader.text, "#version 450 core\nc\nb\nmain\n");
    EXPECT_EQ(shader.files, (std::vector<std::string>{"a.comp.glsl", "b.glsl", "c.glsl"}));
    ASSERT_EQ(shader.lines.size(), 4u);
    EXPECT_EQ(placeOf(shader, 2), "c.glsl:1");
    EXPECT_EQ(placeOf(shader, 3), "b.glsl:2");
    EXPECT_EQ(placeOf(shader, 4), "a.comp.glsl:4");
}

// A file below an #if that is not taken is still there for the next that includes it.
TEST(ShaderSourceTest, AnIncludeBelowAnIfHidesNoLaterOne) {
    const gl::ExpandedShader shader =
        gl::expandShader(from({{"a.comp.glsl",
                                "#version 450 core\n#if 0\n#include \"b.glsl\"\n#endif\n#include \"c.glsl\"\n"
                                "#include \"b.glsl\"\n"},
                               {"b.glsl", "b\n"},
                               {"c.glsl", "#include \"b.glsl\"\nc\n"}}),
                         "a.comp.glsl");
    const std::string guarded = "#ifndef CONELIGHT_FILE_1\n#define CONELIGHT_FILE_1\nb\n#endif\n";
    EXPECT_EQ(shader.text, "#version 450 core\n#if 0\n" + guarded + "#endif\n" + guarded + "c\n");
    EXPECT_EQ(shader.files, (std::vector<std::string>{"a.comp.glsl", "b.glsl", "c.glsl"}));
    EXPECT_EQ(placeOf(shader, 3), "define");
    EXPECT_EQ(placeOf(shader, 5), "b.glsl:1");
    EXPECT_EQ(placeOf(shader, 10), "b.glsl:1");
    EXPECT_EQ(placeOf(shader, 12), "c.glsl:2");
}

TEST(ShaderSourceTest, DefinesFollowTheVersionInOrder) {
    const gl::ExpandedShader shader =
        gl::expandShader(from({{"a.comp.glsl", "// head\n#version 450 core\nx\n"}}), "a.comp.glsl",
                         {{"CONES", "6"}, {"DEBUG", ""}});
    EXPECT_EQ(shader.text, "// head\n#version 450 core\n#define CONES 6\n#define DEBUG \nx\n");
    EXPECT_EQ(placeOf(shader, 2), "a.comp.glsl:2");
    EXPECT_EQ(placeOf(shader, 3), "define");
    EXPECT_EQ(placeOf(shader, 5), "a.comp.glsl:3");
}

TEST(ShaderSourceTest, CycleIsAnErrorThatNamesTheChain) {
    EXPECT_EQ(failureOf({{"a.comp.glsl", "#version 450 core\n#include \"b.glsl\"\n"},
                         {"b.glsl", "b\n#include \"c.glsl\"\n"},
                         {"c.glsl", "#include \"b.glsl\"\n"}}),
              "c.glsl:1: include cycle a.comp.glsl -> b.glsl -> c.glsl -> b.glsl");
    EXPECT_EQ(failureOf({{"a.comp.glsl", "#version 450 core\n#include \"a.comp.glsl\"\n"}}),
              "a.comp.glsl:2: include cycle a.comp.glsl -> a.comp.glsl");
}

TEST(ShaderSourceTest, MissingFileNamesWhoAskedForIt) {
    EXPECT_EQ(
        failureOf({{"a.comp.glsl", "#version 450 core\n\n#include \"lib/none.glsl\"\n"}}),
        "a.comp.glsl:3: there is no shader file 'lib/none.glsl'; paths are relative to the shader root");
    EXPECT_EQ(failureOf({}), "there is no shader file 'a.comp.glsl'; paths are relative to the shader root");
}

TEST(ShaderSourceTest, MalformedIncludesAreErrorsWithTheirLine) {
    for (const char* line : {"#include <b.glsl>", "#include \"b.glsl", "#include b.glsl", "#include",
                             "#include \"\"", "#include \"../b.glsl\"", "#include \"/b.glsl\"",
                             "#include \"lib/../b.glsl\"", "#include \"b.glsl\" b"}) {
        EXPECT_EQ(
            failureOf({{"a.comp.glsl", std::string("#version 450 core\n") + line + "\n"}, {"b.glsl", ""}}),
            "a.comp.glsl:2: malformed include; #include \"folder/file.glsl\" would be right")
            << line;
    }
    EXPECT_EQ(failureOf({{"a.comp.glsl", "#version 450 core\n  #  include \"b.glsl\"  // why\r\n"},
                         {"b.glsl", ""}}),
              "");
}

TEST(ShaderSourceTest, VersionComesFirstAndOnce) {
    EXPECT_EQ(failureOf({{"a.comp.glsl", "void main() {}\n"}}),
              "a.comp.glsl: the first line must be #version 450 core");
    EXPECT_EQ(failureOf({{"a.comp.glsl", "#include \"b.glsl\"\n#version 450 core\n"}, {"b.glsl", ""}}),
              "a.comp.glsl:1: #include before #version; #version 450 core on the first line would be right");
    EXPECT_EQ(failureOf({{"a.comp.glsl", "#version 450 core\n#include \"b.glsl\"\n"},
                         {"b.glsl", "#version 450 core\n"}}),
              "b.glsl:1: a second #version; only the entry file has one");
}

TEST(ShaderSourceTest, CommentedIncludesAreText) {
    const std::string body =
        "#version 450 core\n// #include \"x\"\n/* a\n#include \"x\"\n*/ b // /*\n#define A\n";
    EXPECT_EQ(gl::expandShader(from({{"a.comp.glsl", body}}), "a.comp.glsl").text, body);
}

TEST(ShaderSourceTest, CppBranchesDoNotArrive) {
    const gl::ExpandedShader shader = gl::expandShader(
        from({{"a.comp.glsl",
               "#version 450 core\n"
               "#ifdef __cplusplus\n#include <cstddef>\n#if 1\nint a;\n#else\nint b;\n#endif\n"
               "#else  // GLSL\nint c;\n#ifdef X\nint d;\n#endif\n#endif\n"
               "#ifndef __cplusplus  // GLSL\nint e;\n#else\nint f;\n#endif\n"
               "#pragma once\nint g;\n"}}),
        "a.comp.glsl");
    EXPECT_EQ(shader.text, "#version 450 core\nint c;\n#ifdef X\nint d;\n#endif\nint e;\nint g;\n");
    EXPECT_EQ(placeOf(shader, 2), "a.comp.glsl:10");
    EXPECT_EQ(placeOf(shader, 7), "a.comp.glsl:21");
    EXPECT_EQ(failureOf({{"a.comp.glsl", "#version 450 core\n#ifdef __cplusplus\n"}}),
              "a.comp.glsl: #ifdef __cplusplus without #endif");
}

TEST(ShaderSourceTest, LogsOfThreeDriversNameFileAndLine) {
    const gl::ExpandedShader shader =
        gl::expandShader(from({{"a.comp.glsl", "#version 450 core\n#include \"lib/b.glsl\"\nlast;\n"},
                               {"lib/b.glsl", "\nfirst;\n"}}),
                         "a.comp.glsl", {{"N", "1"}});
    // Expanded: version, define, empty, first, last.
    EXPECT_EQ(shader.mapLog("0:4(3): error: `first' undeclared\n"),
              "lib/b.glsl:2: error: `first' undeclared\n    first;\n");
    EXPECT_EQ(shader.mapLog("ERROR: 0:5: 'last' : undeclared identifier"),
              "a.comp.glsl:3: 'last' : undeclared identifier\n    last;\n");
    EXPECT_EQ(shader.mapLog("0(4) : error C1008: undefined variable \"first\""),
              "lib/b.glsl:2: error C1008: undefined variable \"first\"\n    first;\n");
    EXPECT_EQ(shader.mapLog("0:2(9): warning: odd"),
              "a.comp.glsl: inserted define: warning: odd\n    #define N 1\n");
    // What is no reference into the text stays as it is.
    for (const char* log :
         {"10:4(3): x\n", "0:99(1): x\n", "0:0(0): x\n", "0:99999999999999999999: x\n", "link failed\n"})
        EXPECT_EQ(shader.mapLog(log), log);
    EXPECT_EQ(shader.mapLog(""), "");
}

TEST(ShaderSourceTest, DirectoryWinsOverEmbeddedFiles) {
    const std::filesystem::path root = std::filesystem::path(scratchDir()) / "shaders";
    writeFile(root / "lib/octahedral.glsl", "changed");
    const gl::ShaderProvider provider = gl::directoryShaderProvider(root.string());
    EXPECT_EQ(provider("lib/octahedral.glsl"), "changed");
    EXPECT_EQ(provider("shared/prelude.h"), gl::embeddedShaderProvider()("shared/prelude.h"));
    EXPECT_FALSE(provider("lib").has_value());
    EXPECT_FALSE(provider("lib/none.glsl").has_value());
}

TEST(ShaderSourceTest, EveryShaderFileIsEmbeddedByteForByte) {
    namespace fs = std::filesystem;
    // Folder below the root, and what its paths are relative to.
    const fs::path root = CONELIGHT_SOURCE_DIR;
    const std::pair<fs::path, fs::path> folders[] = {{root / "shaders", root / "shaders"},
                                                     {root / "modes/thesis/shaders", root / "modes"}};
    std::map<std::string, fs::path> onDisk;
    for (const auto& [folder, base] : folders)
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension == ".glsl" || extension == ".h")
                onDisk[fs::relative(entry.path(), base).generic_string()] = entry.path();
        }
    std::set<std::string> embedded, files;
    for (const auto& [path, file] : onDisk) files.insert(path);
    for (const gl::EmbeddedShader& shader : gl::embeddedShaders()) {
        embedded.insert(shader.path);
        EXPECT_EQ(readFile(onDisk[shader.path]), shader.text) << shader.path;
    }
    EXPECT_EQ(files, embedded);
}

// Runs the embedding script on bytes that CMake or C++ could trip over, and reads its raw strings back.
TEST(ShaderSourceTest, EmbeddingKeepsAwkwardBytes) {
    std::string text =
        "// ; [ ] [[ ]] \" ' \\ \\\\ @ @A@ ${} ${B} $ENV{HOME} # ) )\" % \xc3\xa9 ;;\n\\\n\n  trailing  \n";
    while (text.size() < 30000) text += "line " + std::to_string(text.size()) + " \xc3\xa9;[\n";
    text += "no newline at the end";
    const std::filesystem::path dir = std::filesystem::path(scratchDir()) / "embed";
    writeFile(dir / "in.glsl", text);
    const CommandResult run =
        runCommand("cmake -DINPUT=" + (dir / "in.glsl").string() + " -DOUTPUT=" + (dir / "out.cpp").string() +
                   " -DSYMBOL=x -P " CONELIGHT_SOURCE_DIR "/cmake/embed_one.cmake");
    ASSERT_EQ(run.status, 0) << run.output;
    const std::string code = readFile(dir / "out.cpp");
    const std::string open = "R\"__glsl(", close = ")__glsl\"";
    std::string back;
    for (std::size_t at = code.find(open); at != std::string::npos; at = code.find(open, at)) {
        at += open.size();
        const std::size_t end = code.find(close, at);
        ASSERT_NE(end, std::string::npos);
        EXPECT_LT(end - at, 16000u) << "longer than compilers must take";
        back += code.substr(at, end - at);
        at = end + close.size();
    }
    EXPECT_EQ(back, text);
}

}  // namespace conelight::test
