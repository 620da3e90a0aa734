// SPDX-License-Identifier: MIT
// main() of every test program: guests of the library first, then the tests.
#include <gtest/gtest.h>

#include "conelight/thesis/settings.h"

int main(int argc, char** argv) {
    conelight::thesis::registerSettings();
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
