// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "conelight/settings.h"

namespace conelight::python {

// Of an argument: Settings, a dict of values, or None for the defaults. Throws Error(Usage) for a value.
Settings settingsOf(const pybind11::object& given);

}  // namespace conelight::python
