// SPDX-License-Identifier: MIT
// What shells and desktops know of the program: a scene without a command, completion, the manual page.
#include <filesystem>
#include <sstream>

#include "support/program.h"

namespace conelight::test {
namespace {

// Without a display a scene alone is one line, which says what would do; so is what is neither.
TEST(Shell, ASceneAloneIsOpenedInAWindow) {
    const std::string noDisplay = "env -u DISPLAY -u WAYLAND_DISPLAY";
    expectOneLine(conelight("builtin:cornell", noDisplay), 4, "`conelight render`, which needs no display");
    expectOneLine(conelight("nowhere.glb --no-state", noDisplay), 3, "nowhere.glb");
    expectOneLine(conelight("cornell", noDisplay), 2, "no command 'cornell'");
}

// What bash would offer in an empty folder for the words so far; the last is begun.
std::string offered(const std::string& words) {
    const std::string empty = scratchPath("empty");
    std::filesystem::create_directories(empty);
    return runCommand("cd '" + empty +
                      "' && bash -c 'eval \"$(\"" CONELIGHT_PROGRAM
                      "\" completion bash)\"; COMP_WORDS=(conelight " +
                      words + "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _conelight; echo \"${COMPREPLY[*]}\"'")
        .output;
}

TEST(Shell, BashCompletesCommandsOptionsAndWords) {
    if (runCommand("command -v bash").status != 0) GTEST_SKIP() << "bash is not installed";
    EXPECT_EQ(offered("rend"), "render\n");
    EXPECT_EQ(offered("score l"), "leak\n");
    EXPECT_EQ(offered("render scene.glb --mo"), "--mode\n");
    EXPECT_EQ(offered("render --mode pho"), "phong\n");
    EXPECT_EQ(offered("view --quality con"), "converged\n");
    EXPECT_EQ(offered("render --set image.exp"), "image.exposure=\n");
    EXPECT_EQ(offered("compare --max-rel").find("--max-relrmse"), 0u) << "of this command";
    EXPECT_EQ(offered("info --max-rel"), "\n") << "not of others";
    EXPECT_EQ(offered("info " CONELIGHT_SOURCE_DIR "/READ"), CONELIGHT_SOURCE_DIR "/README.md\n");
}

// zsh and fish read what they are given, where they are installed; every option is there in any case.
TEST(Shell, ZshAndFishKnowEveryOption) {
    for (const char* shell : {"zsh", "fish"}) {
        const std::string file = scratchPath(shell);
        ASSERT_EQ(runCommand("'" CONELIGHT_PROGRAM "' completion " + std::string(shell) + " > '" + file + "'")
                      .status,
                  0);
        const std::string script = bytesOf(file);
        for (const char* word : {"render", "converged", "max-relrmse", "image.exposure="})
            EXPECT_NE(script.find(word), std::string::npos) << shell << ": " << word;
        if (runCommand("command -v " + std::string(shell)).status == 0) {
            EXPECT_EQ(runCommand(std::string(shell) + " -n '" + file + "'").output, "") << shell;
        }
    }
    expectOneLine(conelight("completion csh"), 2, "csh");
}

TEST(Shell, TheManualPageHasEveryOptionAndNoWarning) {
    const std::string file = scratchPath("conelight.1");
    ASSERT_EQ(runCommand("'" CONELIGHT_PROGRAM "' manual > '" + file + "'").status, 0);
    std::string page = bytesOf(file);
    for (std::size_t at; (at = page.find("\\-")) != std::string::npos;) page.erase(at, 1);
    for (const char* command : {"render", "view", "compare", "score leak"}) {
        EXPECT_NE(page.find(".SS conelight " + std::string(command)), std::string::npos) << command;
        std::istringstream help(conelight(std::string(command) + " --help").output);
        int options = 0;
        for (std::string line; std::getline(help, line);) {
            const std::size_t at = line.find("--");
            if (at > 8 || line.rfind("  -", 0) != 0) continue;
            const std::string name = line.substr(at, line.find_first_of(" ,={", at) - at);
            EXPECT_NE(page.find("\\fB" + name + "\\fR"), std::string::npos) << command << " " << name;
            ++options;
        }
        EXPECT_GT(options, 5) << command;
    }
    if (runCommand("command -v groff").status != 0) GTEST_SKIP() << "groff is not installed";
    EXPECT_EQ(runCommand("groff -man -Tutf8 -ww '" + file + "' 2>&1 >/dev/null").output, "");
}

}  // namespace
}  // namespace conelight::test
