// SPDX-License-Identifier: MIT
// The window's preferences as text: read back as written, of later versions, damaged.
#include "session/preferences.h"

#include <gtest/gtest.h>

#include "conelight/error.h"

namespace conelight::program {
namespace {

TEST(PreferencesTest, AreReadBackAsWritten) {
    EXPECT_EQ(preferencesOf(textOf({})), Preferences{});
    const Preferences other{1.25f, true, 31.5f, 4, false, false, 900, 600};
    EXPECT_EQ(preferencesOf(textOf(other)), other);
    EXPECT_EQ(preferencesOf(textOf(other) + "of_a_later_version 7\n"), other);
}

TEST(PreferencesTest, SayWhichLineIsDamaged) {
    const std::string begin = "conelight preferences\n";
    for (const char* line :
         {"ui_scale big", "ui_scale 99", "theme pink", "side_width nan", "window_width 10.5", "console",
          "console_height 10 10", "window_height -5", "\x01\xff"}) {
        try {
            preferencesOf(begin + "theme light\n" + line + "\n");
            ADD_FAILURE() << line;
        } catch (const Error& error) {
            EXPECT_STREQ(error.what(), "line 3 is not usable") << line;
        }
    }
    EXPECT_THROW(preferencesOf("theme light\n"), Error) << "no first line";
    EXPECT_EQ(preferencesOf(""), Preferences{}) << "nothing was kept yet";
}

}  // namespace
}  // namespace conelight::program
