// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace conelight::program {

// `text` with line feeds at spaces, so that lines are at most `room` wide in ImGui's present font; words that
// are wider are broken. (ImGui's own wrapping also breaks behind the point of a number, and lists that draw
// only the lines that are seen need to know them.)
std::string wrappedAtSpaces(const std::string& text, float room);

}  // namespace conelight::program
