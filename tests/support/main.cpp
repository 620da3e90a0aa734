// SPDX-License-Identifier: MIT
// main() of all test executables: the guests that the program brings along are there for tests, too.
#include <gtest/gtest.h>

#include "conelight/guests.h"

int main(int argc, char** argv) {
    conelight::program::registerGuests();
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
