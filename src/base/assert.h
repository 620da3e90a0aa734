// SPDX-License-Identifier: MIT
// Checks for mistakes of the programmer (ours or the host's): CONELIGHT_ASSERT(condition, "sentence").
// On in every build: a frame makes a few hundred checks, which cost nothing measurable.
#pragma once

#include <cstdio>
#include <cstdlib>

#define CONELIGHT_ASSERT(condition, sentence)                                                              \
    do {                                                                                                   \
        if (!(condition)) {                                                                                \
            std::fprintf(stderr, "%s:%d: conelight: %s (%s)\n", __FILE__, __LINE__, sentence, #condition); \
            std::abort();                                                                                  \
        }                                                                                                  \
    } while (false)
