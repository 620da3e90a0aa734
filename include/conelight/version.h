// SPDX-License-Identifier: MIT
// The one place that holds the version of Conelight; CMake reads it from here.
#pragma once
#define CONELIGHT_VERSION_MAJOR 0
#define CONELIGHT_VERSION_MINOR 1
#define CONELIGHT_VERSION_PATCH 0
#define CONELIGHT_VERSION_STRING "0.1.0"
