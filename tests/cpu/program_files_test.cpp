// SPDX-License-Identifier: MIT
// Linked programs in a folder: what is kept is there at the next start, the oldest go beyond a bound, and a folder that
// cannot be made changes nothing.
#include "io/program_files.h"

#include <cstdlib>

#include "io_test_support.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

std::size_t filesIn(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ProgramFiles, KeepsWhatWasUsedLast) {
    const fs::path folder = folderOf("programs") / "deeper";
    const std::vector<std::uint8_t> bytes(1000, 7);
    {
        io::ProgramFiles files(folder, false, 4000);
        EXPECT_TRUE(files.suits(false));
        EXPECT_FALSE(files.suits(true));
        EXPECT_TRUE(files.load("a").empty());
        for (const char* key : {"a", "b", "c", "d"}) files.keep(key, bytes);
    }
    // Whole files alone, and nothing else in the folder is touched.
    EXPECT_EQ(filesIn(folder), 4u);
    write(folder / "notes.txt", std::string(9000, 'x'));
    // Of times that are far apart whatever the clock of the disk.
    const fs::file_time_type now = fs::file_time_type::clock::now();
    const char* const keys[] = {"a", "b", "c", "d"};
    for (int i = 0; i < 4; ++i)
        fs::last_write_time(folder / (std::string(keys[i]) + ".program"), now - std::chrono::hours(9 - i));
    io::ProgramFiles files(folder, true, 4000);
    EXPECT_TRUE(files.suits(true));
    EXPECT_EQ(files.load("a"), bytes);
    files.keep("e", std::vector<std::uint8_t>(500, 8));
    // 4500 bytes are too many; 3000 are left at most.
    EXPECT_EQ(files.load("a"), bytes);
    EXPECT_TRUE(files.load("b").empty());
    EXPECT_TRUE(files.load("c").empty());
    EXPECT_EQ(files.load("d"), bytes);
    EXPECT_EQ(files.load("e").size(), 500u);
    EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

TEST(ProgramFiles, AFolderThatCannotBeIsNoError) {
    const fs::path folder = folderOf("none");
    write(folder / "file", "x");
    io::ProgramFiles files(folder / "file" / "programs");
    files.keep("a", std::vector<std::uint8_t>(10, 1));
    EXPECT_TRUE(files.load("a").empty());
}

TEST(ProgramFiles, FolderIsTheUsersCache) {
    const char* const had = std::getenv("XDG_CACHE_HOME");
    const std::string before = had != nullptr ? had : "";
    setenv("XDG_CACHE_HOME", "/somewhere", 1);
    EXPECT_EQ(io::programFolder(), "/somewhere/conelight/programs");
    setenv("XDG_CACHE_HOME", "relative", 1);  // to be ignored, says the standard
    EXPECT_NE(io::programFolder().string().rfind("relative", 0), 0u);
    had != nullptr ? setenv("XDG_CACHE_HOME", before.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace conelight::test
