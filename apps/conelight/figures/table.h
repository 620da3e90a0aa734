// SPDX-License-Identifier: MIT
// Parts of the list of figures.
#pragma once

#include <span>

#include "figures/figure.h"

namespace conelight::figures {

std::span<const Figure> foundationFigures();  // chapters 1 to 3: F01 to F20
std::span<const Figure> methodFigures();      // chapter 4 and the first half of 5: F21 to F37
std::span<const Figure> resultFigures();      // the rest: F38 to F50, T1, T2

std::span<const Figure> beyondFigures();  // of what the thesis names and does not draw: B01, B02

// Any drawing as a figure of one file.
template <std::string (*Draw)()>
std::vector<Panel> vectorFigure(Studio&) {
    const std::string text = Draw();
    return {{"", ".svg", {text.begin(), text.end()}}};
}

}  // namespace conelight::figures
