// SPDX-License-Identifier: MIT
// Parts of pictures by name, and which shape their arrays have.
#pragma once

#include <string>
#include <vector>

#include "arrays.h"
#include "conelight/settings.h"

namespace conelight::python {

// Names from a sequence of texts, or one text; Error(Usage) when there is none.
std::vector<std::string> componentNames(const py::object& given);
Component componentOf(const std::string& name);
// Grey for one number per pixel, else Rgb, or Rgba where alpha is wanted.
Channels channelsOf(const std::string& name, bool alpha);

}  // namespace conelight::python
