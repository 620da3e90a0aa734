// SPDX-License-Identifier: MIT
// The counters of lookups behind Frame::lookupCounters: one word per kind (LOOKUPS_* of
// shared/cones.h), and its carries.
#pragma once
#include "shared/cones.h"

#define LOOKUPS_CARRY 4  // word of the first kind's carries
#define LOOKUPS_WORDS 8
