// SPDX-License-Identifier: MIT
// main() of all test executables: the guests that the program brings along are there for tests, too; and what
// shaders they asked for is checked at the end.
#include <gtest/gtest.h>

#include "conelight/guests.h"
#include "support/variant_check.h"

int main(int argc, char** argv) {
    conelight::program::registerGuests();
    testing::InitGoogleTest(&argc, argv);
    conelight::test::checkVariantsAtTheEnd();
    return RUN_ALL_TESTS();
}
