// SPDX-License-Identifier: MIT
// What shells and desktops know of the program: a scene without a command, completion, the manual page.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>

#include "io/image_file.h"
#include "session/thumbnail_files.h"
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

// The line of a desktop file that begins so, without that.
std::string entryOf(const std::string& file, const std::string& key) {
    std::istringstream lines(bytesOf(CONELIGHT_SOURCE_DIR "/apps/conelight/desktop/" + file));
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(key + "=", 0) == 0) return line.substr(key.size() + 1);
    return {};
}

// What a file manager does: fills in the line, and shows what stands in the file that it named.
TEST(Shell, FileManagersGetThumbnails) {
    const std::string scene = scratchPath("thumb nail.glb"),
                      picture = scratchPath("thumbnail_without_ending");
    std::filesystem::remove(scene);
    std::filesystem::remove(picture);
    ASSERT_EQ(conelight("convert builtin:cornell '" + scene + "'").status, 0);
    std::string line = entryOf("conelight.thumbnailer", "Exec");
    const std::pair<std::string, std::string> values[] = {
        {"%s", "128"}, {"%i", "'" + scene + "'"}, {"%o", "'" + picture + "'"}};
    for (const auto& [name, value] : values) {
        ASSERT_NE(line.find(name), std::string::npos) << line;
        line.replace(line.find(name), 2, value);
    }
    ASSERT_EQ(line.rfind("conelight ", 0), 0u);
    const CommandResult result = conelight(line.substr(10));
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(result.output, "");
    const io::ByteImage image = io::readByteImage(picture);
    EXPECT_EQ(glm::ivec2(image.width, image.height), glm::ivec2(128, 96));
    EXPECT_GT(*std::max_element(image.pixels.begin(), image.pixels.end()), 200);
    // With what desktops look for to know whether it is of the file as it is now.
    const std::string time = std::to_string(
        std::chrono::duration_cast<std::chrono::seconds>(std::filesystem::last_write_time(scene) -
                                                         std::filesystem::file_time_type::clock::now() +
                                                         std::chrono::system_clock::now().time_since_epoch())
            .count());
    int found = 0;
    for (const auto& [key, text] : image.attributes) {
        if (key == "Thumb::URI")
            found += text == program::uriOf(scene) && text.find("thumb%20nail.glb") != std::string::npos;
        if (key == "Thumb::MTime") found += std::abs(std::stoll(text) - std::stoll(time)) <= 1;
    }
    EXPECT_EQ(found, 2);
    expectOneLine(conelight("thumbnail nowhere.glb '" + picture + "'"), 3, "nowhere.glb");
}

TEST(Shell, DesktopFilesNameTheSameTypes) {
    const std::string types = entryOf("conelight.thumbnailer", "MimeType");
    EXPECT_EQ(types, entryOf("conelight.desktop", "MimeType"));
    const std::string known = bytesOf(CONELIGHT_SOURCE_DIR "/apps/conelight/desktop/conelight.xml");
    std::istringstream words(types);
    int count = 0;
    for (std::string type; std::getline(words, type, ';'); ++count)
        EXPECT_NE(known.find("<mime-type type=\"" + type + "\">"), std::string::npos) << type;
    EXPECT_GE(count, 8);
}

// RFC 1321, and the example of the standard of thumbnails.
TEST(Shell, ThumbnailsAreWhereDesktopsLook) {
    EXPECT_EQ(program::md5Of(""), "d41d8cd98f00b204e9800998ecf8427e");
    EXPECT_EQ(
        program::md5Of("12345678901234567890123456789012345678901234567890123456789012345678901234567890"),
        "57edf4a22be3c955ac49da2e2107b67a");
    EXPECT_EQ(program::md5Of("file:///home/jens/photos/me.png"), "c6ee772d9e49320e97ec29a7eb5b1697");
}

}  // namespace
}  // namespace conelight::test
