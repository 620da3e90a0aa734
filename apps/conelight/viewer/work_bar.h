// SPDX-License-Identifier: MIT
// The bar of work in the window, with its text.
#pragma once

#include <string>

namespace conelight::program {

// `part`: of the work that is done; below 0 nobody knows, and the bar goes to and fro. `width`: below 0: up to so far
// from the right edge.
void showWorkBar(const std::string& text, double part, float width);

}  // namespace conelight::program
