// SPDX-License-Identifier: MIT
// Disks that are full, read-only or gone, and programs that are ended from outside: one line, and under the final
// name nothing or the whole file.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

class DiskTest : public GlTest {
  protected:
    // Runs the program with a disk of its own of 64 KiB, which is `made` before. What lies there at the end, but for
    // the file `fill`, is said in a last line.
    static CommandResult onSmallDisk(const std::string& made, const std::string& arguments) {
        const std::string disk = scratchPath("disk");
        fs::create_directories(disk);
        return runCommand("unshare -rm bash -c '" + inShell("mount -t tmpfs -o size=64k none " + disk) +
                          made + "\"" CONELIGHT_PROGRAM "\" " + arguments +
                          "; status=$?; echo left: $(ls -A " + disk + " | grep -v fill); exit $status'");
    }
    static std::string inShell(const std::string& command) { return command + " || exit 99; "; }
    static std::string disk(const std::string& name) { return scratchPath("disk") + "/" + name; }
    static bool disksCanBeMade() { return onSmallDisk("", "--version").status == 0; }

    // Each kind of output; it does not fit.
    void expectRefused(const std::string& made, const std::string& why) {
        const std::string picture = scratchPath("a.png"), small = " --mode phong --size 16x16 --voxels 16 ";
        ASSERT_EQ(conelight("render builtin:furnace" + small + "-o " + picture).status, 0);
        for (const std::string& arguments :
             {"render builtin:furnace" + small + "-o " + disk("o.png"),
              "render builtin:furnace" + small + "-o " + disk("o.exr"),
              "render builtin:furnace" + small + "-o " + disk("o.hdr"),
              "render builtin:furnace" + small + "--turntable --frames 2 -o " + disk("f%d.jpg"),
              "render builtin:furnace" + small + "-o " + scratchPath("b.png") + " --overwrite --stats " +
                  disk("s.json"),
              "convert builtin:furnace " + disk("s.glb"), "convert builtin:furnace " + disk("s.gltf"),
              "convert builtin:furnace " + disk("s.txt"),
              "compare " + picture + " " + picture + " --no-flip --json " + disk("c.json")}) {
            const CommandResult result = onSmallDisk(made, arguments);
            EXPECT_EQ(result.status, 1) << arguments << ": " << result.output;
            EXPECT_NE(result.output.find(why), std::string::npos) << arguments << ": " << result.output;
            EXPECT_NE(result.output.find("left:\n"), std::string::npos) << arguments << ": " << result.output;
        }
    }
};

TEST_F(DiskTest, AFullOneIsOneLine) {
    if (!disksCanBeMade()) GTEST_SKIP() << "no rights to mount a disk (unshare -rm)";
    expectRefused("head -c 1M /dev/zero 2>/dev/null > " + disk("fill") + "; ", "o space left on device");
}

TEST_F(DiskTest, AReadOnlyOneIsOneLine) {
    if (!disksCanBeMade()) GTEST_SKIP() << "no rights to mount a disk (unshare -rm)";
    expectRefused(inShell("mount -o remount,ro none " + scratchPath("disk")), "ead-only file system");
}

// The folder goes while a film is drawn into it, of more frames than anyone waits for.
TEST_F(DiskTest, AFolderThatVanishesIsOneLine) {
    const std::string folder = scratchPath("frames");
    fs::create_directories(folder);
    const std::string log = scratchPath("log.txt");
    const pid_t child = ::fork();
    if (child == 0) {
        const std::string line = "exec '" CONELIGHT_PROGRAM
                                 "' render builtin:furnace --mode phong --size 8x8 --voxels 16 "
                                 "--turntable --frames 90000 -o '" +
                                 folder + "/f%d.png' >'" + log + "' 2>&1 </dev/null";
        ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        ::_exit(127);
    }
    while (!fs::exists(folder + "/f1.png") && ::waitpid(child, nullptr, WNOHANG) == 0) ::usleep(2000);
    // What is written meanwhile may keep the folder alive for a moment.
    std::error_code ignored;
    while (fs::exists(folder)) fs::remove_all(folder, ignored);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    const std::string said = bytesOf(log);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status << said;
    EXPECT_NE(said.find("frames/f"), std::string::npos) << said;
    EXPECT_NE(said.find("cannot be written"), std::string::npos) << said;
    EXPECT_FALSE(fs::exists(folder)) << "it was not made again";
}

// Whenever the signal comes.
TEST_F(DiskTest, KilledItLeavesWholeFilesOrNone) {
    for (const char* name : {"INT", "TERM", "KILL"})
        for (const char* seconds : {"0.05", "0.2", "0.4", "0.8", "1.6"}) {
            const std::string folder = scratchPath("killed"), out = folder + "/o.exr";
            fs::remove_all(folder);
            fs::create_directories(folder);
            const CommandResult result =
                runCommand(std::string("timeout --preserve-status -s ") + name + " " + seconds +
                           " '" CONELIGHT_PROGRAM
                           "' render builtin:cornell --mode phong --size 1200x900 "
                           "--voxels 16 -o '" +
                           out + "'");
            if (fs::exists(out)) {
                EXPECT_EQ(io::readExr(out).width, 1200) << name << seconds;
            }
            // What nobody can clean up behind itself may leave a temporary file.
            if (std::string(name) == "KILL") continue;
            const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
            EXPECT_EQ(files, fs::exists(out) ? 1 : 0) << name << seconds << result.output;
        }
}

}  // namespace
}  // namespace conelight::test
