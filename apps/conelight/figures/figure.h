// SPDX-License-Identifier: MIT
// A figure of the thesis as this project draws it: what it is called, what it shows, and what draws it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace conelight::figures {

// Drawings and plots are vectors and need no OpenGL; renders and series are pictures; tables are measured.
enum class Kind { Drawing, Plot, Render, Series, Table };
std::string_view nameOf(Kind kind);

// One file of a figure.
struct Panel {
    std::string label;      // what tells it from the others; empty for a figure of one file
    std::string extension;  // ".svg", ".png", ".md", ".json"
    std::vector<std::uint8_t> bytes;
};

class Studio;  // draws scenes; studio.h

struct Figure {
    std::string_view id;       // "F01" .. "F50", "T1", "T2"; "B01" .. beyond the thesis's
    std::string_view title;    // a few words
    std::string_view caption;  // what the thesis shows there, in our words
    std::string_view seen;     // what is to be seen in ours, a paragraph
    Kind kind;
    std::vector<Panel> (*draw)(Studio&);  // throws what drawing throws
};

// All of them, in the thesis's order: figures, then tables; then those beyond it.
std::span<const Figure> allFigures();

// File of the panel of that number: "F05.svg"; of several "F05a.png", "F05b.png".
std::string fileName(const Figure& figure, std::size_t panel, const std::vector<Panel>& panels);

}  // namespace conelight::figures
