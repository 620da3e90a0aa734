// SPDX-License-Identifier: MIT
// A comparison as one HTML page that needs nothing but itself: pictures side by side under a slider, error
// maps, the values under the mouse, exposure and tone curve, tables, the command lines that made it.
//
// Report -> text of the page. Pixels travel in the page as base64: as 32-bit floats (16 bytes a pixel) while
// all pictures together stay below kExactBytes, else as 16-bit floats (8 bytes a pixel, 11 bits of mantissa);
// the page says which. FLIP maps travel with 8 bits (1.3 bytes a pixel); other maps are computed in the
// browser.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conelight/renderer.h"
#include "reference/metrics.h"

namespace conelight::program {

// One picture of a view: what a mode drew, or the reference.
struct ReportPicture {
    std::string name;  // "cones", "reference"
    Image image;
    std::optional<reference::Metrics> metrics;  // against the view's reference; none for the reference itself
    std::vector<float> flip, hdrFlip;           // per pixel, as reference::FlipMaps; empty: no such map
};

// Pictures of one size that show the same: a component, a camera. The reference, if any, is among them.
struct ReportView {
    std::string name;  // "full", "indirect"
    std::vector<ReportPicture> pictures;
    std::optional<std::size_t> reference;  // its index; signed and absolute maps are against it
    float exposure = 0;                    // stops with which the page opens
    std::string toneMap = "none";          // and the curve, as image.tone_map names it
};

// A table whose columns can be sorted. A cell is text or a number; numbers are shown with the column's
// format.
struct ReportCell {
    ReportCell(std::string words) : text(std::move(words)) {}
    ReportCell(const char* words) : text(words) {}
    ReportCell(double value) : number(value) {}
    std::string text;
    std::optional<double> number;
};
struct ReportColumn {
    std::string name;
    std::string unit;            // shown under the name; "%" multiplies by 100
    int digits = 3;              // significant digits; for "%" digits after the point
    std::string hint;            // longer words under the mouse
    bool fewerIsBetter = false;  // the best number of the column is marked
    bool moreIsBetter = false;
};
struct ReportTable {
    std::string title;
    std::string note;  // a sentence under the title; may be empty
    std::vector<ReportColumn> columns;
    std::vector<std::vector<ReportCell>> rows;
};

struct Report {
    std::string title;                  // "builtin:cornell: cones, thesis against reference"
    std::string summary;                // one or two sentences
    std::vector<std::string> commands;  // command lines that made it
    std::vector<ReportView> views;
    std::vector<ReportTable> tables;                            // further ones: cost, memory, scores
    std::vector<std::pair<std::string, std::string>> settings;  // key, value; versions and device too
};

// Values above this in base64 make the page too heavy for a browser to open at once; then they travel as
// half.
constexpr std::size_t kExactBytes = std::size_t(48) << 20;

// The whole page. A table of metrics per view is made from the pictures. Throws Error(Usage) when there is no
// picture, when pictures of a view differ in size, or a map has not their size.
std::string reportHtml(const Report& report);

// Writes DIR/index.html, making DIR. Throws Error(Runtime) that names the path.
void writeReport(const std::string& directory, const Report& report);

// Makes DIR and finds out whether the page can be written there, over no file of another kind and none of
// `inputs` (outputs.h): to be called before long work.
void prepareReport(const std::string& directory, const std::vector<std::string>& inputs);

}  // namespace conelight::program
