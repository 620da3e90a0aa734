// SPDX-License-Identifier: MIT
// An IES file of ours: a wall washer, which throws its light to one side, twice as far at 90 degrees as at 0, with a
// narrow streak. Symmetric to the plane of 90 and 270 degrees as LM-63-1995 has it.
#pragma once

namespace conelight::test {

inline constexpr const char* kWallWasher =
    "IESNA:LM-63-1995\r\n"
    "[TEST] generated\r\n"
    "[MANUFAC] none\r\n"
    "TILT=NONE\r\n"
    "1 1000 2 7 5 1 2 0 0 0\r\n"
    "1.0 0.5 20\r\n"
    "0 15 30 45 60 75 90\r\n"
    "90 135 180 225 270\r\n"
    "400, 500, 900, 300, 600, 100, 0\r\n"
    "400 450 600 250 300 60 0\r\n"
    "400 350 200 100 50\r\n20 0\r\n"
    "400 300 100 50 20 10 0\r\n"
    "400 250 50 20 10 5 0\r\n";

}  // namespace conelight::test
