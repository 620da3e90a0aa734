// SPDX-License-Identifier: MIT
// CONELIGHT_API marks what a shared library of Conelight gives to its hosts; all else in it is hidden.
#pragma once

#if defined(_WIN32)
#define CONELIGHT_API
#else
#define CONELIGHT_API __attribute__((visibility("default")))
#endif
